// SPDX-License-Identifier: GPL-2.0-or-later
// Fixes beside the integrator, and what each leaves to hold.
#include <cmath>

#include <fmt/format.h>

#include "draft.h"

namespace grammar {

namespace {

const double kPi = std::acos(-1.0);

void forget_forces(Effects &effects)
{
  effects.forces_known = false;
  effects.only_internal = false;
  effects.energy_may_grow = true;
  effects.conservative = false;
}

std::string words(const Vec3 &a) { return fmt::format("{:.17g} {:.17g} {:.17g}", a.x, a.y, a.z); }

void make_part(Draft &draft)
{
  std::string ids;
  for (const auto &[id, rod] : draft.rods)
    if (draft.random.chance(0.35)) {
      draft.part.push_back(id);
      ids += fmt::format(" {}", id);
    }
  if (draft.part.empty()) return;
  draft.part_text = "group part id" + ids + "\ngroup rest subtract all part\n";
}

void stop_part(Draft &draft)
{
  for (const int id : draft.part) draft.rods.at(id).v = draft.rods.at(id).omega = {0.0, 0.0, 0.0};
}

void hold_part(Draft &draft)
{
  stop_part(draft);
  draft.effects.still.insert(draft.part.begin(), draft.part.end());
  draft.effects.only_internal = false;
  if (draft.random.chance(0.8)) {
    draft.last_fix_text = "fix hold part freeze\n";  // after all that add forces
  } else {
    draft.integrated = "rest";
  }
}

Driven moved_by(const std::function<Vec3(double)> &way, const std::function<Vec3(double)> &speed)
{
  return [way, speed](const Rod &at_start, double t) {
    Rod rod = at_start;
    rod.x = rod.x + way(t);
    rod.v = speed(t);
    return rod;
  };
}

Driven turned_about(const Vec3 &point, const Vec3 &direction, double rate)
{
  return [=](const Rod &at_start, double t) {
    Rod rod = at_start;
    const Vec3 arm = turned(at_start.x - point, direction, rate * t);
    rod.x = point + arm;
    rod.v = cross(rate * direction, arm);
    rod.axis = turned(at_start.axis, direction, rate * t);
    rod.omega = rate * direction;
    return rod;
  };
}

void move_part(Draft &draft)
{
  Random &random = draft.random;
  const Vec3 along = random.uniform(0.1, 1.0) * random.direction();
  Driven driven;
  std::string text;
  switch (random.integer(0, 3)) {
    case 0:
      text = "fix drive part move linear " + words(along);
      driven = moved_by([along](double t) { return t * along; }, [along](double) { return along; });
      break;
    case 1: {
      const double period = random.uniform(0.005, 0.05), w = 2.0 * kPi / period;
      const Vec3 amplitude = 0.005 * along;
      text = fmt::format("fix drive part move wiggle {} {:.17g}", words(amplitude), period);
      driven = moved_by([=](double t) { return std::sin(w * t) * amplitude; },
                        [=](double t) { return w * std::cos(w * t) * amplitude; });
      break;
    }
    case 2: {
      const double period = random.uniform(0.02, 0.3);
      const Vec3 point = 0.3 * draft.longest() * random.direction(), axis = random.direction();
      text = fmt::format("fix drive part move rotate {} {} {:.17g}", words(point), words(axis),
                         period);
      driven = turned_about(point, axis, 2.0 * kPi / period);
      break;
    }
    default: {
      text = fmt::format("variable way equal {:.17g}*step*dt\nvariable speed equal {:.17g}\n"
                         "variable none equal 0.0\n"
                         "fix drive part move variable v_way v_none v_none v_speed v_none v_none",
                         along.x, along.x);
      const Vec3 x{along.x, 0.0, 0.0};
      driven = moved_by([x](double t) { return t * x; }, [x](double) { return x; });
    }
  }
  stop_part(draft);
  for (const int id : draft.part) draft.effects.driven[id] = driven;
  draft.integrated = "rest";
  draft.fix_text += text + " units box\n";
  draft.effects.only_internal = false;
  draft.effects.energy_may_grow = true;
  draft.can_restart = random.chance(0.5);
}

void add_gravity(Draft &draft)
{
  if (draft.effects.gravity.z != 0.0) return;
  const Vec3 towards = draft.random.chance(0.7) ? Vec3{0.0, 0.0, -1.0} : draft.random.direction();
  draft.effects.gravity = 9.81 * towards;
  draft.fix_text += fmt::format("fix weight all gravity 9.81 vector {}\n", words(towards));
}

void push(Draft &draft)
{
  const bool all = !draft.has_part() || draft.random.chance(0.5);
  const Vec3 force = draft.random.uniform(0.0, 0.5) * draft.random.direction();
  draft.fix_text += fmt::format("fix push{} {} addforce {}\n", draft.fix_text.size(),
                                all ? "all" : "part", words(force));
  draft.effects.only_internal = false;
  draft.effects.energy_may_grow = true;
  const auto add = [&](int id) {
    const auto old = draft.effects.added_force.find(id);
    draft.effects.added_force[id] =
        old == draft.effects.added_force.end() ? force : old->second + force;
  };
  if (all)
    for (const auto &[id, rod] : draft.rods) add(id);
  else
    for (const int id : draft.part) add(id);
  if (draft.rods.empty()) draft.effects.forces_known = false;
}

// Under water altogether: the level is far above.
void float_rods(Draft &draft)
{
  if (draft.effects.gravity.z == 0.0) return;
  draft.fix_text += "fix water all buoyancy level 1000.0 dim z density 1000.0\n";
  draft.effects.only_internal = false;
  draft.effects.energy_may_grow = true;
  if (draft.rods.empty() || draft.effects.gravity.x != 0.0) draft.effects.forces_known = false;
  for (const auto &[id, rod] : draft.rods) {
    const double volume = rod.mass / rod.density;
    Vec3 &force = draft.effects.added_force[id];
    force = force + Vec3{0.0, 0.0, 1000.0 * volume * 9.81};
  }
}

void limit_omega(Draft &draft)
{
  draft.effects.omega_limit = draft.random.pick({1.0, 5.0, 20.0, 100.0});
  draft.effects.conservative = false;
  draft.fix_text += fmt::format("fix slow all limit/omega {}\n", draft.effects.omega_limit);
}

void deform_box(Draft &draft)
{
  const int d = draft.random.integer(0, 2);
  if (draft.boundary[d] != "p" || !draft.effects.driven.empty() || !draft.effects.still.empty())
    return;
  draft.effects.deformed = d;
  draft.effects.rate = draft.random.uniform(-3.0, 3.0);
  draft.effects.every = draft.random.pick({1, 1, 5});
  const std::string remap = draft.random.pick({"x", "v", "none"});
  draft.effects.remaps_x = remap == "x";
  draft.fix_text += fmt::format("fix squeeze all deform {} {} erate {:.17g} remap {}\n",
                                draft.effects.every, "xyz"[d], draft.effects.rate, remap);
  draft.effects.box_changes = true;
  draft.effects.only_internal = false;
  draft.effects.energy_may_grow = true;
}

// Takes momentum or energy in ways of its own.
void add_other_force(Draft &draft)
{
  Random &random = draft.random;
  const bool rest = !draft.effects.driven.empty() || !draft.effects.still.empty();
  const std::string group = rest ? "rest" : draft.has_part() && random.chance(0.5) ? "part" : "all";
  const std::string text = random.pick(
      {"viscous 0.05", "viscous 1.0", "drag 0.0 0.0 0.0 0.5 0.01", "setforce NULL 0.0 NULL",
       "setforce 0.1 0.0 0.0", "spring/self 50.0", "spring tether 20.0 0.0 0.0 0.0 0.0",
       "momentum 10 linear 1 1 1", "momentum 20 linear 1 1 1 angular", "lineforce 1 0 0",
       "planeforce 0 0 1", "aveforce 0.1 0.0 NULL"});
  draft.fix_text += fmt::format("fix other {} {}\n", group, text);
  forget_forces(draft.effects);
  draft.can_restart = false;
}

void add_neutral(Draft &draft)
{
  Random &random = draft.random;
  const long n = draft.unit;
  const std::string text = random.pick<std::string>(
      {fmt::format("check/timestep/spherocylinder {} 0.9", n),
       fmt::format("ave/time {0} 2 {1} c_kinetic c_turning file ave.time", n / 5, n),
       fmt::format("ave/atom {0} 2 {1} vx vz", n / 5, n),
       fmt::format("ave/histo {0} 2 {1} -2 2 10 vx mode vector file ave.histo", n / 5, n),
       fmt::format("ave/histo {0} 2 {1} 0 4 5 c_contacts mode vector file ave.histo", n / 5, n),
       fmt::format("print {} \"at $(step)\" file printed", n), "store/force",
       "store/state 0 x y z vx vy vz", "property/atom mark scalar yes yes no 1.0",
       fmt::format("balance {} 1.05 shift xyz 10 1.02", 2 * n),
       fmt::format("ave/spatial {0} 2 {1} z lower 0.05 vx units box file ave.spatial", n / 5, n)});
  draft.fix_text += fmt::format("fix neutral{} all {}\n", draft.fix_text.size(), text);
}

// Right or refused; what comes of it is only held to the basic rules.
void add_doubtful(Draft &draft)
{
  Random &random = draft.random;
  const std::string group = draft.has_part() && random.chance(0.5) ? "part" : "all";
  // clang-format off
  const std::string text = random.pick({
      "nve", "nve/sphere", "nve/limit 0.001", "nve/noforce", "rigid single", "enforce2d",
      "adapt 10 atom diameter v_grow", "check/timestep/gran 10 0.1 0.1", "wall/reflect zlo EDGE",
      "langevin 1.0 1.0 0.1 10007", "nvt/sphere temp 1.0 1.0 0.1", "efield 1.0 0.0 0.0",
      "heat/gran/conduction initial_temperature 300.0", "wall/lj93 zlo EDGE 1.0 1.0 2.5",
      "dt/reset 10 1.0e-6 1.0e-5 0.001", "cfd/coupling every 10 file", "box/relax iso 0.0",
      "multisphere", "continuum/weighted", "lb/couple/onetoone", "nonsense 1 2 3",
      "ave/euler nevery 10 cell_size_relative 3.0 parallel no", "external pf/callback 1 1"});
  // clang-format on
  draft.fix_text +=
      fmt::format("variable grow equal 0.01+1e-6*step\nfix doubtful {} {}\n", group, text);
  if (text == "heat/gran/conduction initial_temperature 300.0") {
    std::string values;
    const int types = draft.plan.material.types + (draft.setting == Setting::UnusedType ? 1 : 0);
    for (int k = 0; k < types; k++) values += " 100.0";
    draft.fix_text = fmt::format("fix thermalConductivity all property/global thermalConductivity "
                                 "peratomtype{0}\nfix thermalCapacity all property/global "
                                 "thermalCapacity peratomtype{0}\n",
                                 values) +
                     draft.fix_text;
    return;
  }
  forget_forces(draft.effects);
  draft.effects.still.clear();
  draft.effects.driven.clear();
  draft.can_restart = false;
  draft.plan.twin = Setting::Same;
}

}  // namespace

void choose_fixes(Draft &draft)
{
  Random &random = draft.random;
  if (draft.rods.size() > 1 && random.chance(0.4)) make_part(draft);
  if (random.chance(draft.plan.walls.empty() ? 0.2 : 0.6)) add_gravity(draft);
  if (draft.has_part()) {
    const double which = random.uniform(0.0, 1.0);
    if (which < 0.3)
      hold_part(draft);
    else if (which < 0.55)
      move_part(draft);
  }
  if (random.chance(0.12)) push(draft);
  if (random.chance(0.06)) float_rods(draft);
  if (random.chance(0.08)) limit_omega(draft);
  if (random.chance(0.05)) deform_box(draft);
  if (random.chance(0.12)) add_other_force(draft);
  for (int k = random.pick({0, 0, 1, 1, 2}); k > 0; k--) add_neutral(draft);
  if (random.chance(0.08)) add_doubtful(draft);
  draft.fix_text += draft.last_fix_text;
}

}  // namespace grammar
