// SPDX-License-Identifier: GPL-2.0-or-later
// Rods of a data file, placed by rejection, or templates and an insertion command.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

void place_rods(Draft &draft)
{
  Random &random = draft.random;
  const double fastest = random.pick({0.0, 0.3, 1.0, 1.0, 3.0});
  const double deepest = random.pick({0.0, 0.0, 0.05, 0.2});
  const bool gaps_in_ids = random.chance(0.15);
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
      if (!fits(draft, rod, deepest)) continue;
      id += gaps_in_ids ? random.integer(1, 4) : 1;
      rod.id = id;
      draft.rods[id] = rod;
      break;
    }
  draft.plan.fewest_rods = draft.plan.most_rods = static_cast<int>(draft.rods.size());
}

std::string templates(Draft &draft)
{
  std::string text, names;
  for (size_t k = 0; k < draft.kinds.size(); k++) {
    const Kind &kind = draft.kinds[k];
    text += fmt::format(
        "fix template{} all particletemplate/spherocylinder {} atom_type {} density constant {} "
        "radius constant {:.17g} length constant {:.17g}\n",
        k, draft.random.seed(), kind.type, kind.density, kind.radius, kind.length);
    names += fmt::format(" template{} {:.9g}", k, 1.0 / static_cast<double>(draft.kinds.size()));
  }
  return text + fmt::format("fix mixture all particledistribution/discrete {} {}{}\n",
                            draft.random.seed(), draft.kinds.size(), names);
}

std::string feed_region(const Draft &draft)
{
  std::string bounds;
  for (int d = 0; d < 3; d++) {
    const double middle = 0.5 * (draft.inside_lo[d] + draft.inside_hi[d]);
    double half = 0.5 * (draft.inside_hi[d] - draft.inside_lo[d]) - 0.55 * draft.longest();
    for (const Wall &wall : draft.plan.walls)  // a square in the circle
      if (wall.cylinder && wall.dim != d) half *= 0.6;
    half = std::max(half, 0.02 * draft.box.period(d));
    bounds += fmt::format(" {:.9g} {:.9g}", middle - half, middle + half);
  }
  return "region feed block" + bounds + " units box\n";
}

void choose_insertion(Draft &draft)
{
  Random &random = draft.random;
  draft.plan.most_rods = std::min(draft.plan.most_rods, 30);
  const int rods = draft.plan.most_rods;
  std::string text = templates(draft) + feed_region(draft);
  const std::string orientation =
      random.chance(0.8) ? "orientation random "
                         : random.pick({"orientation constant 0.70710678 0.70710678 0 0 ",
                                        "orientation constant 0.7071 0.7071 0 0 "});
  const std::string common = fmt::format(
      "seed {} distributiontemplate mixture maxattempt 400 overlapcheck yes all_in no {}"
      "vel constant {:.3g} 0.0 {:.3g}",
      random.seed(), orientation, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  const long every = draft.unit * random.integer(1, 3);
  draft.plan.fewest_rods = 0;
  switch (draft.making) {
    case Making::Pack:
      text += fmt::format("fix pour all insert/pack {} insert_every once region feed "
                          "particles_in_region {}\n", common, rods);
      draft.plan.fewest_rods = rods;
      break;
    case Making::RefilledPack:
      text += fmt::format("fix pour all insert/pack {} insert_every {} region feed {}\n", common,
                          every,
                          random.chance(0.5) ? fmt::format("particles_in_region {}", rods)
                                             : std::string("volumefraction_region 0.01"));
      draft.plan.most_rods = 100000;
      break;
    default:
      text += fmt::format("fix pour all insert/rate/region {} nparticles {} particlerate {:.6g} "
                          "insert_every {} region feed\n", common, rods,
                          rods / (draft.dt * static_cast<double>(every) * 2.0), every);
  }
  draft.effects.inserting = true;
  draft.can_restart = random.chance(0.3);
  draft.fix_text += text;
}

}  // namespace

void choose_rods(Draft &draft)
{
  using M = Making;
  draft.making = draft.random.pick({M::DataFile, M::DataFile, M::DataFile, M::DataFile,
                                    M::DataFile, M::Pack, M::Pack, M::RefilledPack, M::Rate});
  if (draft.making == M::DataFile)
    place_rods(draft);
  else
    choose_insertion(draft);
}

}  // namespace grammar
