// SPDX-License-Identifier: GPL-2.0-or-later
// What must hold at one time step.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "brute_force.h"
#include "judge.h"

namespace grammar {

namespace {

// Overlaps nearer to 0 than this share of the radii may go either way.
constexpr double kGrazing = 1e-8;
// Search finds closest points to 1e-9 of a length; of forces and torques then this is left.
constexpr double kForceError = 1e-5;

void check_rod(const Rod &rod, long step)
{
  const auto wrong = [&](const std::string &what) {
    throw Wrong(fmt::format("rod {} at step {}: {}", rod.id, step, what));
  };
  for (const Vec3 &a : {rod.x, rod.v, rod.omega, rod.axis, rod.force, rod.torque})
    if (!finite(a)) wrong("a number that is none");
  if (std::fabs(rod.quaternion_norm - 1.0) > 1e-9)
    wrong(fmt::format("norm of the quaternion {:.12g}", rod.quaternion_norm));
  if (rod.half_cylinder() < -1e-12 * rod.radius)
    wrong(fmt::format("length {} below diameter {}", rod.length, 2.0 * rod.radius));
  const double pi = std::acos(-1.0);
  const double volume =
      pi * rod.radius * rod.radius * (2.0 * rod.half_cylinder() + 4.0 / 3.0 * rod.radius);
  if (std::fabs(rod.mass - rod.density * volume) > 1e-9 * rod.mass)
    wrong(fmt::format("mass {:.9g} instead of {:.9g}", rod.mass, rod.density * volume));
}

void check_contacts(const State &state, const std::vector<Touch> &pairs)
{
  std::map<int, int> least, most;
  for (const Touch &touch : pairs)
    for (const int id : {touch.i, touch.j}) {
      most[id]++;
      if (touch.overlap > kGrazing * touch.reach) least[id]++;
    }
  for (const auto &[id, rod] : state.rods)
    if (rod.contacts < least[id] || rod.contacts > most[id])
      throw Wrong(fmt::format("contacts of rod {} at step {}: {}, by search {}", id, state.step,
                              rod.contacts, most[id]));
}

Vec3 body_force(const Effects &effects, const Rod &rod)
{
  Vec3 force = rod.mass * effects.gravity;
  const auto added = effects.added_force.find(rod.id);
  return added == effects.added_force.end() ? force : force + added->second;
}

struct Load {
  Vec3 force{0.0, 0.0, 0.0}, torque{0.0, 0.0, 0.0};
  double scale = 0.0, arm = 0.0;
  int touches = 0;
  bool plain = true;
};

void add(Load &load, const Touch &touch, const Vec3 &arm, const Vec3 &force)
{
  load.force = load.force + force;
  load.torque = load.torque + cross(arm, force);
  load.scale += norm(force);
  load.arm = std::max(load.arm, norm(arm));
  load.touches++;
  load.plain = load.plain && touch.plain;
}

void check_load(const Load &load, const Rod &rod, const Vec3 &body, long step)
{
  const double scale = load.scale + norm(body);
  const Vec3 wanted = load.force + body;
  if (norm(rod.force - wanted) > kForceError * scale + 1e-12)
    throw Wrong(fmt::format(
        "force on rod {} at step {}: {:.9g} {:.9g} {:.9g}, by search {:.9g} {:.9g} {:.9g}", rod.id,
        step, rod.force.x, rod.force.y, rod.force.z, wanted.x, wanted.y, wanted.z));
  if (norm(rod.torque - load.torque) > kForceError * load.scale * (load.arm + rod.length) + 1e-14)
    throw Wrong(fmt::format(
        "torque on rod {} at step {}: {:.9g} {:.9g} {:.9g}, by search {:.9g} {:.9g} {:.9g}", rod.id,
        step, rod.torque.x, rod.torque.y, rod.torque.z, load.torque.x, load.torque.y,
        load.torque.z));
}

// Rods that touch nothing feel their body forces; where forces follow from poses, all do.
void check_forces(const Plan &plan, const Run &run, const State &state,
                  const std::vector<Touch> &pairs)
{
  std::map<int, Load> loads;
  for (const Touch &touch : pairs) {
    const Vec3 force = touch.stiffness * touch.overlap * touch.normal;
    add(loads[touch.i], touch, touch.arm_i, force);
    add(loads[touch.j], touch, touch.arm_j, -force);
  }
  for (const Touch &touch : wall_touches(state, plan.walls, plan.material))
    add(loads[touch.i], touch, touch.arm_i, touch.stiffness * touch.overlap * touch.normal);
  for (const auto &[id, rod] : state.rods) {
    if (run.effects.still.count(id) || run.effects.driven.count(id)) continue;
    const Load &load = loads[id];
    if (load.touches == 0 || (load.plain && plan.material.forces_by_pose()))
      check_load(load, rod, body_force(run.effects, rod), state.step);
    else
      continue;
    (load.touches == 0 ? held().rods_alone : held().forces_by_pose)++;
  }
}

}  // namespace

void check_state(const Plan &plan, const Run &run, const State &state)
{
  for (const auto &[id, rod] : state.rods) check_rod(rod, state.step);
  if (static_cast<int>(state.rods.size()) > plan.most_rods)
    throw Wrong(fmt::format("{} rods at step {}, at most {} were made", state.rods.size(),
                            state.step, plan.most_rods));
  if (!images_are_plain(state)) return;
  const std::vector<Touch> pairs = pair_touches(state, plan.material, 0.0);
  held().states++;
  // Counted at output, where a box that takes the rods along has already done so.
  if (run.effects.counts_all_pairs && !run.effects.remaps_x) check_contacts(state, pairs);
  if (run.effects.counts_all_pairs) held().contacts += static_cast<long>(pairs.size());
  if (run.effects.forces_known) check_forces(plan, run, state, pairs);
}

void check_start(const Run &run, State before, const State &first)
{
  if (!run.start_known || run.effects.box_changes || !first.box.exact) return;
  for (const auto &change : run.changes) change(before);
  const auto wrong = [&](const Rod &rod, const std::string &what) {
    throw Wrong(
        fmt::format("rod {} at the start of the run from step {}: {}", rod.id, first.step, what));
  };
  std::set<int> found;
  for (const auto &[old_id, rod] : before.rods) {
    const Rod *now = nullptr;
    for (const auto &[id, other] : first.rods)
      if ((run.new_ids || id == old_id) &&
          norm(first.box.nearest(other.x - rod.x)) < 1e-9 + 1e-9 * norm(rod.x))
        now = &other;
    if (!now) {
      if (first.rods.count(old_id) && !run.new_ids) {
        const Rod &there = first.rods.at(old_id);
        wrong(rod, fmt::format("at {:.9g} {:.9g} {:.9g} instead of {:.9g} {:.9g} {:.9g}, off by "
                               "{:.3g}",
                               there.x.x, there.x.y, there.x.z, rod.x.x, rod.x.y, rod.x.z,
                               norm(first.box.nearest(there.x - rod.x))));
      }
      bool outside = false;
      for (int d = 0; d < 3; d++)
        outside = outside || (!first.box.periodic[d] && (component(rod.x, d) < first.box.lo[d] ||
                                                         component(rod.x, d) >= first.box.hi[d]));
      if (!outside) wrong(rod, "gone");
      continue;
    }
    found.insert(now->id);
    if (norm(cross(now->axis, rod.axis)) > 1e-7) wrong(rod, "its axis has turned");
    if (now->type != rod.type) wrong(rod, "its type has changed");
    if (std::fabs(now->mass - rod.mass) > 1e-9 * rod.mass) wrong(rod, "its mass has changed");
    if (run.effects.driven.count(old_id) || run.effects.still.count(old_id) ||
        run.effects.unknown_held)
      continue;
    if (norm(now->v - rod.v) > 1e-9 * (1.0 + norm(rod.v))) wrong(rod, "its velocity has changed");
    if (norm(now->omega - rod.omega) > 1e-8 * (1.0 + norm(rod.omega)))
      wrong(rod, "its angular velocity has changed");
  }
  held().starts++;
  if (run.effects.inserting) return;
  for (const auto &[id, rod] : first.rods)
    if (!found.count(id)) wrong(rod, "came from nowhere");
}

}  // namespace grammar
