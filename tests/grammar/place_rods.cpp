// SPDX-License-Identifier: GPL-2.0-or-later
// Rods of a data file or made by hand, placed by rejection.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "brute_force.h"
#include "draft.h"

namespace grammar {

namespace {

Rod rod_of(const Kind &kind)
{
  Rod rod;
  rod.radius = kind.radius;
  rod.length = kind.length;
  rod.density = kind.density;
  rod.mass = kind.density * kind.volume();
  rod.type = kind.type;
  return rod;
}

bool fits(const Draft &draft, const Rod &rod, double deepest)
{
  for (const Wall &wall : draft.plan.walls)
    for (const double end : {-1.0, 1.0}) {
      const Vec3 point = rod.x + end * rod.half_cylinder() * rod.axis;
      if (wall_gap(wall, point, rod.x) < rod.radius * (1.0 - deepest)) return false;
    }
  State two;
  two.box = draft.box;
  two.rods[0] = rod;
  for (const auto &[id, other] : draft.rods) {
    two.rods[1] = other;
    two.rods[1].id = 1;
    for (const Touch &touch : pair_touches(two, draft.plan.material))
      if (touch.overlap > deepest * touch.reach) return false;
  }
  return true;
}

// Beside a rod that is there already: it touches, or nearly, where the common perpendicular of the
// axes goes through both.
void put_beside(Random &random, const Rod &other, double deepest, Rod &rod)
{
  const Vec3 across = cross(other.axis, rod.axis);
  if (norm(across) < 0.05) return;
  const Vec3 normal = ((random.chance(0.5) ? 1.0 : -1.0) / norm(across)) * across;
  const double reach = other.radius + rod.radius;
  const double apart = reach * (1.0 - random.uniform(-0.05, 0.95 * deepest));
  rod.x = other.x + random.uniform(-1.0, 1.0) * other.half_cylinder() * other.axis +
          apart * normal - random.uniform(-1.0, 1.0) * rod.half_cylinder() * rod.axis;
}

// With one end in the wall, or nearly.
void put_at_wall(Random &random, const Wall &wall, double deepest, Rod &rod)
{
  if (wall.cylinder) return;
  double lower = 1e30;
  for (const double end : {-1.0, 1.0})
    lower = std::min(lower, wall_gap(wall, rod.x + end * rod.half_cylinder() * rod.axis, rod.x));
  const double inwards = component(rod.x, wall.dim) > wall.position ? 1.0 : -1.0;
  component(rod.x, wall.dim) +=
      inwards * (rod.radius * (1.0 - random.uniform(-0.05, 0.95 * deepest)) - lower);
}

bool in_box(const Box &box, const Vec3 &x)
{
  for (int d = 0; d < 3; d++)
    if (component(x, d) < box.lo[d] || component(x, d) >= box.hi[d]) return false;
  return true;
}

}  // namespace

void place_rods(Draft &draft)
{
  Random &random = draft.random;
  const double fastest = random.pick({0.0, 0.3, 1.0, 1.0, 3.0});
  const double deepest = random.pick({0.0, 0.02, 0.05, 0.2});
  const double crowded = random.pick({0.0, 0.5, 0.9});
  const bool gaps_in_ids = draft.making == Making::DataFile && random.chance(0.15);
  int id = 0;
  for (int k = 0; k < draft.plan.most_rods; k++)
    for (int attempt = 0; attempt < 60; attempt++) {
      const int kinds = static_cast<int>(draft.kinds.size());
      Rod rod = rod_of(draft.kinds[draft.rods.empty() ? 0 : random.integer(0, kinds - 1)]);
      rod.axis = random.chance(0.1) ? Vec3{1.0, 0.0, 0.0} : random.direction();
      for (int d = 0; d < 3; d++)
        component(rod.x, d) = random.uniform(draft.inside_lo[d], draft.inside_hi[d]);
      rod.v = random.uniform(0.0, fastest) * random.direction();
      rod.omega = random.uniform(0.0, 2.0 * fastest / rod.length) * random.direction();
      if (!draft.rods.empty() && random.chance(crowded))
        put_beside(random,
                   std::next(draft.rods.begin(),
                             random.integer(0, static_cast<int>(draft.rods.size()) - 1))
                       ->second,
                   deepest, rod);
      else if (!draft.plan.walls.empty() && random.chance(crowded))
        put_at_wall(
            random,
            draft.plan.walls[random.integer(0, static_cast<int>(draft.plan.walls.size()) - 1)],
            deepest, rod);
      if (!in_box(draft.box, rod.x) || !fits(draft, rod, deepest)) continue;
      id += gaps_in_ids ? random.integer(1, 4) : 1;
      rod.id = id;
      draft.rods[id] = rod;
      break;
    }
  draft.plan.fewest_rods = draft.plan.most_rods = static_cast<int>(draft.rods.size());
}

// create_atoms and set, one rod after the other.
std::string rods_by_hand(const Draft &draft)
{
  std::string text;
  for (const auto &[id, rod] : draft.rods) {
    text += fmt::format("create_atoms {} single {:.17g} {:.17g} {:.17g} units box\n", rod.type,
                        rod.x.x, rod.x.y, rod.x.z);
    text += fmt::format("set atom {} diameter {:.17g} length {:.17g} density {:.17g} axis {:.17g} "
                        "{:.17g} {:.17g}\n",
                        id, 2.0 * rod.radius, rod.length, rod.density, rod.axis.x, rod.axis.y,
                        rod.axis.z);
    text +=
        fmt::format("set atom {} vx {:.17g} vy {:.17g} vz {:.17g} omegax {:.17g} omegay {:.17g} "
                    "omegaz {:.17g}\n",
                    id, rod.v.x, rod.v.y, rod.v.z, rod.omega.x, rod.omega.y, rod.omega.z);
  }
  return text;
}

}  // namespace grammar
