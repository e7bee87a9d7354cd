// SPDX-License-Identifier: GPL-2.0-or-later
// Sizes of rods, the box, its boundaries and walls.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draft.h"

namespace grammar {

namespace {

const char kNames[] = {'x', 'y', 'z'};

void choose_kinds(Draft &draft)
{
  Random &random = draft.random;
  const int count = random.pick({1, 1, 1, 2, 2, 3});
  const double diameter = random.pick({0.01, 0.01, 0.006, 0.016});
  for (int k = 0; k < count; k++) {
    Kind kind;
    kind.radius = 0.5 * diameter * (random.chance(0.2) ? random.uniform(0.7, 1.4) : 1.0);
    const double aspect = random.pick({1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 10.0, 10.0, 20.0, 40.0});
    kind.length = 2.0 * kind.radius * aspect;
    kind.density = random.pick({2700.0, 2700.0, 1000.0, 7800.0});
    // LIGGGHTS wants rods of type 1.
    kind.type = k == 0 && random.chance(0.97) ? 1 : random.integer(1, draft.plan.material.types);
    draft.kinds.push_back(kind);
  }
  draft.unit = random.pick({10, 20, 20, 50});
}

// The box holds the rods at a chosen solid fraction, and more than a rod's length.
void choose_box(Draft &draft, int rods)
{
  Random &random = draft.random;
  double volume = 0.0;
  for (const Kind &kind : draft.kinds)
    volume += rods * kind.volume() / static_cast<double>(draft.kinds.size());
  const double side = std::cbrt(volume / random.pick({0.003, 0.03, 0.1, 0.2, 0.3}));
  for (int d = 0; d < 3; d++) {
    const double least =
        draft.longest() * (random.chance(0.1) ? random.uniform(1.05, 2.0) : 2.1) + 0.02;
    const double length = std::max(least, side * random.uniform(0.8, 1.4));
    draft.box.lo[d] = -0.5 * length * (random.chance(0.5) ? 1.0 : random.uniform(0.5, 1.2));
    draft.box.hi[d] = draft.box.lo[d] + length;
    draft.inside_lo[d] = draft.box.lo[d];
    draft.inside_hi[d] = draft.box.hi[d];
  }
}

void set_boundary(Draft &draft, int d, const std::string &kind)
{
  draft.boundary[d] = kind;
  draft.box.periodic[d] = kind == "p";
}

// What a plane of normal d does, seldom: slides, turns about a normal, moves along its normal.
struct PlaneMotion {
  std::string words;
  double way_in_a_step = 0.0;
};

PlaneMotion choose_motion(Draft &draft, int d)
{
  Random &random = draft.random;
  PlaneMotion motion;
  if (!random.chance(0.12)) return motion;
  draft.effects.energy_may_grow = true;
  const int which = random.integer(0, 2);
  if (which == 0)
    motion.words = fmt::format(" shear {} {:.4g}", kNames[(d + random.integer(1, 2)) % 3],
                               random.uniform(-1.0, 1.0));
  else if (which == 1)
    motion.words = fmt::format(" turn {:.4g} 0.0 0.01", random.uniform(-20.0, 20.0));
  else
    motion.way_in_a_step = draft.dt * random.uniform(-0.5, 0.5);
  return motion;
}

void add_plane(Draft &draft, int d, double position)
{
  const PlaneMotion motion = choose_motion(draft, d);
  Wall wall;
  wall.id = fmt::format("plane{}", draft.plan.walls.size());
  wall.dim = d;
  wall.position = position;
  wall.way_in_a_step = motion.way_in_a_step;
  wall.type = draft.random.integer(1, draft.plan.material.types);
  std::string place = fmt::format("{:.17g}", position);
  if (motion.way_in_a_step != 0.0) {
    draft.wall_text += fmt::format("variable place_{} equal {}+({:.17g})*step\n", wall.id, place,
                                   wall.way_in_a_step);
    place = "v_place_" + wall.id;
  }
  draft.wall_text +=
      fmt::format("fix {} all wall/gran {} primitive type {} {}plane {}{}{}\n", wall.id,
                  draft.models, wall.type, kNames[d], place, motion.words, draft.keywords);
  draft.plan.walls.push_back(wall);
}

// Planes a little inside the box, so that a rod which leans on one stays in it.
void close_by_planes(Draft &draft, int d)
{
  const double gap = 0.02 * draft.box.period(d);
  draft.inside_lo[d] += gap;
  draft.inside_hi[d] -= gap;
  set_boundary(draft, d, draft.random.pick({"f", "f", "m"}));
  add_plane(draft, d, draft.inside_lo[d]);
  add_plane(draft, d, draft.inside_hi[d]);
}

void add_cylinder(Draft &draft)
{
  const int d = draft.random.integer(0, 2), e = (d + 1) % 3, f = (d + 2) % 3;
  Wall wall;
  wall.id = "side";
  wall.cylinder = true;
  wall.dim = d;
  wall.type = draft.random.integer(1, draft.plan.material.types);
  wall.radius = 0.45 * std::min(draft.box.period(e), draft.box.period(f));
  for (const int across : {e, f}) {
    const double half = 0.5 * draft.box.period(across);
    draft.box.lo[across] = -half;
    draft.box.hi[across] = half;
    draft.inside_lo[across] = -wall.radius;
    draft.inside_hi[across] = wall.radius;
    set_boundary(draft, across, "f");
  }
  std::string motion;
  if (draft.random.chance(0.2)) {
    motion = fmt::format(" shear {} {:.4g}", kNames[draft.random.integer(0, 2)],
                         draft.random.uniform(-2.0, 2.0));
    draft.effects.energy_may_grow = true;
  }
  draft.wall_text +=
      fmt::format("fix side all wall/gran {} primitive type {} {}cylinder {:.17g} 0.0 0.0{}{}\n",
                  draft.models, wall.type, kNames[d], wall.radius, motion, draft.keywords);
  draft.plan.walls.push_back(wall);
  if (draft.random.chance(0.7))
    close_by_planes(draft, d);
  else
    set_boundary(draft, d, "p");
}

void choose_surroundings(Draft &draft)
{
  Random &random = draft.random;
  using S = Surroundings;
  draft.surroundings =
      random.pick({S::Periodic, S::Periodic, S::Periodic, S::Open, S::Open, S::Vessel, S::Vessel,
                   S::Vessel, S::Cylinder, S::Cylinder, S::Floor});
  for (int d = 0; d < 3; d++) set_boundary(draft, d, "p");
  switch (draft.surroundings) {
    case S::Periodic: break;
    case S::Open:
      for (int d = 0; d < 3; d++) set_boundary(draft, d, random.pick({"f", "f", "m", "p"}));
      break;
    case S::Vessel:
      for (int d = 0; d < 3; d++)
        if (d == 2 || random.chance(0.6)) close_by_planes(draft, d);
      break;
    case S::Cylinder: add_cylinder(draft); break;
    case S::Floor:
      for (int d = 0; d < 2; d++) set_boundary(draft, d, random.pick({"f", "p"}));
      set_boundary(draft, 2, random.pick({"f", "m"}));
      draft.inside_lo[2] += 0.02 * draft.box.period(2);
      add_plane(draft, 2, draft.inside_lo[2]);
      break;
  }
  if (!draft.plan.walls.empty()) draft.effects.only_internal = false;
}

}  // namespace

double Kind::volume() const
{
  const double pi = std::acos(-1.0);
  return pi * radius * radius * (length - 2.0 * radius + 4.0 / 3.0 * radius);
}

double Draft::longest() const
{
  double longest = 0.0;
  for (const Kind &kind : kinds) longest = std::max(longest, kind.length);
  return longest;
}

void choose_scene(Draft &draft)
{
  Random &random = draft.random;
  choose_kinds(draft);
  draft.plan.most_rods = random.pick({1, 2, 4, 8, 12, 16, 20, 30, 40, 60});
  choose_box(draft, draft.plan.most_rods);
  choose_surroundings(draft);
  draft.plan.ranks = random.pick({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 4});
  draft.skin = random.pick({0.005, 0.01, 0.01, 0.02, 0.04});
  draft.sorted = random.chance(0.2);
  draft.hash = random.chance(0.2);
}

}  // namespace grammar
