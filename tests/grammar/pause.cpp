// SPDX-License-Identifier: GPL-2.0-or-later
#include "pause.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace grammar {

namespace {

std::string words(const Vec3 &a) { return fmt::format("{:.17g} {:.17g} {:.17g}", a.x, a.y, a.z); }

std::string half_space(int d, double cut)
{
  std::string bounds;
  for (int k = 0; k < 3; k++)
    bounds += k == d ? fmt::format(" INF {:.17g}", cut) : std::string(" INF INF");
  return bounds;
}

// displace_atoms puts rods back into the box.
Vec3 wrapped(Vec3 x, const Box &box)
{
  for (int d = 0; d < 3; d++)
    if (box.periodic[d]) {
      double &along = component(x, d);
      along -= box.period(d) * std::floor((along - box.lo[d]) / box.period(d));
    }
  return x;
}

bool everyone(const Rod &) { return true; }

}  // namespace

void Pause::choose()
{
  switch (random_.integer(0, 14)) {
    case 0:
    case 1:
    case 2: delete_some(); break;
    case 3:
    case 4: displace(); break;
    case 5: set_velocity(); break;
    case 6: set_something(); break;
    case 7: change_box(); break;
    case 8: renumber_steps(); break;
    case 9: restart(); break;
    case 10: through_data_file(); break;
    case 11: exclude(); break;
    case 12:
      if (draft_.plan.ranks > 1) add("balance 1.01 shift xyz 10 1.01\n");
      break;
    case 13: do_something_seldom(); break;
    default: do_little();
  }
}

// The deck in one go is the twin of this.
void Pause::restart()
{
  if (!draft_.can_restart) return;
  // An insertion command given again fills its region up again.
  if (draft_.effects.inserting) draft_.plan.most_rods = 100000;
  add("write_restart half\nclear\n" + header(draft_, "read_restart half\n"));
}

void Pause::change(const Has &has, const std::function<void(Rod &)> &what)
{
  run_.changes.push_back([=, box = draft_.box](State &state) {
    for (auto &[id, rod] : state.rods)
      if (has(rod)) {
        const Vec3 x = rod.x;
        what(rod);
        if (norm(rod.x - x) > 0.0) rod.x = wrapped(rod.x, box);
      }
  });
}

bool Pause::driven_or_held() const
{
  return !draft_.effects.driven.empty() || !draft_.effects.still.empty();
}

std::string Pause::name_some(Has &has)
{
  const int which = random_.integer(0, 2);
  const std::string group = fmt::format("some{}", draft_.groups++);
  if (which == 0) {
    const int type = random_.integer(1, draft_.plan.material.types);
    has = [type](const Rod &rod) { return rod.type == type; };
    add(fmt::format("group {} type {}\n", group, type));
  } else if (which == 1 && draft_.ids_known && draft_.has_part()) {
    const std::set<int> ids(draft_.part.begin(), draft_.part.end());
    has = [ids](const Rod &rod) { return ids.count(rod.id) > 0; };
    add(fmt::format("group {} union part\n", group));
  } else {
    const int d = random_.integer(0, 2);
    const double cut = 0.5 * (draft_.box.lo[d] + draft_.box.hi[d]);
    has = [d, cut](const Rod &rod) { return component(rod.x, d) <= cut; };
    add(fmt::format("region in_{0} block{1} units box\ngroup {0} region in_{0}\n", group,
                    half_space(d, cut)));
  }
  return group;
}

std::string Pause::name_some_or_all(Has &has)
{
  has = everyone;
  return random_.chance(0.5) ? name_some(has) : "all";
}

void Pause::forget_ids()
{
  run_.new_ids = true;
  draft_.ids_known = false;
  draft_.can_restart = draft_.can_restart && !draft_.has_part();
  draft_.plan.twin = Setting::Same;
  // Groups keep their rods, but this program no longer knows their numbers.
  if (!draft_.effects.added_force.empty()) draft_.effects.forces_known = false;
  if (driven_or_held()) {
    draft_.effects.forces_known = false;
    draft_.effects.unknown_held = true;
  }
  draft_.effects.added_force.clear();
  draft_.effects.still.clear();
  draft_.effects.driven.clear();
}

void Pause::delete_group(const std::string &compress)
{
  Has gone;
  const std::string group = name_some(gone);
  add(fmt::format("delete_atoms group {}{}\n", group, compress));
  run_.changes.push_back([gone](State &state) {
    for (auto at = state.rods.begin(); at != state.rods.end();)
      at = gone(at->second) ? state.rods.erase(at) : std::next(at);
  });
}

void Pause::delete_some()
{
  const std::string compress = random_.pick({"", "", " compress yes", " compress no"});
  for (int times = random_.pick({1, 1, 2}); times > 0; times--) {
    const double which = random_.uniform(0.0, 1.0);
    if (which < 0.7) {
      delete_group(compress);
    } else {
      if (which < 0.85)
        add(fmt::format("region all_of{0} block INF INF INF INF INF INF units box\n"
                        "delete_atoms porosity all_of{0} 0.3 {1}{2}\n",
                        draft_.groups++, random_.seed(), compress));
      else
        add(fmt::format("delete_atoms overlap 0.01 all all{}\n", compress));
      run_.start_known = false;
      draft_.plan.twin = Setting::Same;
    }
    if (compress != " compress no") forget_ids();
  }
  draft_.plan.fewest_rods = 0;
}

void Pause::rotate(const std::string &group, const Has &has)
{
  if (!draft_.plan.walls.empty() && random_.chance(0.8)) return;
  const Vec3 point = 0.3 * draft_.longest() * random_.direction(), axis = random_.direction();
  const double angle = random_.pick({1.0, 30.0, 90.0, -45.0});
  add(fmt::format("displace_atoms {} rotate {} {} {} units box\n", group, words(point), words(axis),
                  angle));
  const double radians = angle * std::acos(-1.0) / 180.0;
  change(has, [=](Rod &rod) {
    rod.x = point + turned(rod.x - point, axis, radians);
    rod.axis = turned(rod.axis, axis, radians);
    rod.omega = turned(rod.omega, axis, radians);
  });
}

void Pause::displace()
{
  if (driven_or_held()) return;
  Has has;
  const std::string group = name_some_or_all(has);
  const double way = random_.pick({0.001, 0.01, 0.05});
  switch (random_.integer(0, 3)) {
    case 0: {
      const Vec3 by = way * random_.direction();
      add(fmt::format("displace_atoms {} move {} units box\n", group, words(by)));
      change(has, [=](Rod &rod) { rod.x = rod.x + by; });
      break;
    }
    case 1: rotate(group, has); break;
    case 2:
      add(fmt::format("displace_atoms {} random {} {} {} {} units box\n", group, way, way, way,
                      random_.seed()));
      run_.start_known = false;
      break;
    default:
      add(fmt::format("displace_atoms {} ramp x 0.0 {} y {:.17g} {:.17g} units box\n", group, way,
                      draft_.box.lo[1], draft_.box.hi[1]));
      change(has, [=, lo = draft_.box.lo[1], hi = draft_.box.hi[1]](Rod &rod) {
        rod.x.x += way * std::max(0.0, std::min(1.0, (rod.x.y - lo) / (hi - lo)));
      });
  }
}

void Pause::set_velocity()
{
  if (driven_or_held()) return;
  Has has;
  const std::string group = name_some_or_all(has);
  const double which = random_.uniform(0.0, 1.0);
  if (which < 0.5) {
    const Vec3 v = random_.direction();
    add(fmt::format("velocity {} set {} units box\n", group, words(v)));
    change(has, [=](Rod &rod) { rod.v = v; });
  } else if (which < 0.75) {
    add(fmt::format("velocity {} zero linear\n", group));
    run_.changes.push_back([=](State &state) {
      Vec3 sum{0.0, 0.0, 0.0};
      double mass = 0.0;
      for (const auto &[id, rod] : state.rods)
        if (has(rod)) {
          sum = sum + rod.mass * rod.v;
          mass += rod.mass;
        }
      for (auto &[id, rod] : state.rods)
        if (has(rod)) rod.v = rod.v - (1.0 / mass) * sum;
    });
  } else if (which < 0.85) {
    add(fmt::format("velocity {} zero angularIndividual\n", group));
    change(has, [](Rod &rod) { rod.omega = {0.0, 0.0, 0.0}; });
  } else {
    const Vec3 L = 1e-6 * random_.direction();
    add(fmt::format("velocity {} setAngular {}\n", group, words(L)));
    change(has, [L](Rod &rod) {
      const double a = rod.inertia_axial(), t = rod.inertia_transverse();
      rod.omega = (1.0 / t) * L + ((1.0 / a - 1.0 / t) * dot(L, rod.axis)) * rod.axis;
    });
  }
}

void Pause::set_something()
{
  if (driven_or_held()) return;
  Has has;
  const std::string group = name_some(has);
  const auto set = [&](const std::string &words, const std::function<void(Rod &)> &what) {
    add(fmt::format("set group {} {}\n", group, words));
    change(has, what);
  };
  switch (random_.integer(0, 8)) {
    case 0: set("omegax 20.0", [](Rod &rod) { rod.omega.x = 20.0; }); break;
    case 1:
      set("density 5000.0", [](Rod &rod) {
        rod.mass *= 5000.0 / rod.density;
        rod.density = 5000.0;
      });
      break;
    case 2: {
      const int type = draft_.plan.material.types;
      set(fmt::format("type {}", type), [type](Rod &rod) { rod.type = type; });
      break;
    }
    case 3: set("vz -0.5", [](Rod &rod) { rod.v.z = -0.5; }); break;
    case 4: set("axis 0.0 0.6 0.8", [](Rod &rod) { rod.axis = {0.0, 0.6, 0.8}; }); break;
    case 5: set("quat 1 0 0 90", [](Rod &rod) { rod.axis = {0.0, -1.0, 0.0}; }); break;
    case 6: {
      const Kind &kind = draft_.kinds.front();
      set(fmt::format("diameter {:.17g} length {:.17g}", 2.0 * kind.radius, kind.length),
          [kind](Rod &rod) {
            rod.radius = kind.radius;
            rod.length = kind.length;
            rod.mass = rod.density * kind.volume();
          });
      break;
    }
    default:
      add(fmt::format("set group {} {}\n", group,
                      random_.pick({"diameter 0.01", "mass 0.01", "shape 0.005 0.005 0.05",
                                    "quat/random 10007", "volume 1e-6", "angmom 0 0 1e-6",
                                    "blockiness 2 2", "length 0.1", "quat_direct 1 0 0 0"})));
      run_.start_known = false;
  }
}

void Pause::change_box()
{
  const int d = random_.integer(0, 2);
  if (random_.chance(0.2)) {
    add(random_.pick({"change_box all triclinic\n", "change_box all x delta -0.01 0.01 remap\n",
                      "change_box all boundary p p p\n", "change_box all boundary m m m\n"}));
    run_.start_known = false;
    draft_.effects.forces_known = false;
    draft_.effects.box_changes = true;
    draft_.effects.energy_may_grow = true;
    draft_.effects.only_internal = false;
    draft_.effects.driven.clear();
    draft_.effects.still.clear();
    draft_.can_restart = false;
    return;
  }
  if (draft_.boundary[d] != "f") return;
  draft_.box.lo[d] -= 0.01;
  draft_.box.hi[d] += 0.02;
  add(fmt::format("change_box all {} final {:.17g} {:.17g} units box\n", "xyz"[d], draft_.box.lo[d],
                  draft_.box.hi[d]));
}

void Pause::renumber_steps()
{
  if (!draft_.effects.driven.empty()) return;
  for (const Wall &wall : draft_.plan.walls)
    if (wall.way_in_a_step != 0.0) return;
  if (random_.chance(0.5)) {
    draft_.step = 100 * draft_.unit;
    add(fmt::format("reset_timestep {}\n", draft_.step));
  } else {
    draft_.dt *= 0.5;
    add(fmt::format("timestep {}\n", draft_.dt));
  }
}

void Pause::through_data_file()
{
  if (!draft_.can_restart || draft_.rods.empty() || !draft_.effects.driven.empty()) return;
  for (int d = 0; d < 3; d++)
    if (draft_.boundary[d] == "m") return;
  for (const Wall &wall : draft_.plan.walls)
    if (wall.way_in_a_step != 0.0) return;
  add("write_data half.data\nclear\n" + header(draft_, "read_data half.data\n"));
  draft_.step = 0;
  if (!draft_.ids_known) draft_.can_restart = false;
}

void Pause::exclude()
{
  if (!draft_.has_part() || !draft_.ids_known) return;
  add("neigh_modify exclude group part part\n");
  draft_.effects.counts_all_pairs = false;
  draft_.effects.forces_known = false;
  draft_.can_restart = false;
}

// Right or refused: the rods' places, speeds and number are not foreseen, all else must hold.
void Pause::do_something_seldom()
{
  const std::string id = fmt::format("{}", draft_.groups++);
  add(random_.pick<std::string>(
      {"minimize 1.0e-4 1.0e-6 10 10\n",
       "velocity all create 300.0 10007\n",
       "create_atoms 1 single 0.0 0.0 0.0 units box\n",
       fmt::format("region new{0} sphere 0.001 0.002 0.003 0.0001 units box\n"
                   "create_atoms 1 single 0.001 0.002 0.003 units box\ngroup new{0} region new{0}\n"
                   "set group new{0} diameter 0.004 length 0.008 density 2700 axis 1 1 0\n",
                   id),
       "read_dump dump.0 0 x y z\n",
       "read_dump dump.0 0 x y z vx vy vz replace yes\n",
       "read_dump dump.0 0 x y z purge yes add yes\n",
       "replicate 2 1 1 offset 1.0 1.0 1.0\n",
       "rerun dump.0 dump x y z\n",
       "atom_modify sort 0 0.0\n",
       "processors * * 1\n",
       "communicate multi\n",
       "communicate single vel no\n",
       "newton on\n",
       "dimension 2\n",
       "atom_style sphere\n",
       "pair_style none\n",
       "neigh_modify exclude type 1 1\n",
       "neigh_modify include all\n",
       "write_restart a_file\n",
       "write_data a_file\n",
       "fix motion all nve\n",
       "unfix motion\n",
       "pair_coeff 1 1\n",
       "nonsense\n"}));
  run_.start_known = false;
  draft_.plan.most_rods *= 3;
  draft_.plan.fewest_rods = 0;
  draft_.plan.twin = Setting::Same;
  draft_.can_restart = false;
  draft_.effects.counts_all_pairs = false;
  draft_.effects.forces_known = false;
  draft_.effects.energy_may_grow = true;
  draft_.effects.driven.clear();
  draft_.effects.still.clear();
}

void Pause::do_little()
{
  const std::string text = random_.pick({"run 0\n", "neigh_modify every 1 delay 0 check yes\n",
                                         "neigh_modify every 2 delay 4\n", "print \"a pause\"\n",
                                         "fix weight all gravity 0.0 vector 0 0 -1\n"});
  const bool weight = text.find("gravity") != std::string::npos;
  if (weight && draft_.fix_text.find("buoyancy") != std::string::npos) return;
  add(text);
  if (!weight) return;
  draft_.effects.gravity = {0.0, 0.0, 0.0};
  draft_.can_restart = false;
}

}  // namespace grammar
