// SPDX-License-Identifier: GPL-2.0-or-later
// What must hold from the first to the last state of a run.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "brute_force.h"
#include "judge.h"

namespace grammar {

namespace {

struct Totals {
  Vec3 momentum{0.0, 0.0, 0.0}, angular{0.0, 0.0, 0.0};
  double mass = 0.0, kinetic = 0.0;
  double momentum_scale = 0.0, angular_scale = 0.0;
};

Totals totals(const State &state)
{
  Totals sum;
  for (const auto &[id, rod] : state.rods) {
    const Vec3 p = rod.mass * rod.v, own = rod.angular_momentum();
    sum.momentum = sum.momentum + p;
    sum.angular = sum.angular + cross(rod.x, p) + own;
    sum.mass += rod.mass;
    sum.kinetic += rod.kinetic_energy();
    sum.momentum_scale += norm(p);
    sum.angular_scale += norm(rod.x) * norm(p) + norm(own);
  }
  return sum;
}

bool same_rods(const State &a, const State &b)
{
  if (a.rods.size() != b.rods.size()) return false;
  for (const auto &[id, rod] : a.rods)
    if (!b.rods.count(id)) return false;
  return true;
}

Vec3 way_of(const Rod &from, const Rod &to, const Box &box)
{
  Vec3 way = to.x - from.x;
  for (int d = 0; d < 3; d++) component(way, d) += (to.image[d] - from.image[d]) * box.period(d);
  return way;
}

// A rod may be gone only if it could have left through a face that is not periodic.
void check_count(const Run &run, const State &from, const State &to, double time)
{
  for (const auto &[id, rod] : to.rods)
    if (!from.rods.count(id) && !run.effects.inserting)
      throw Wrong(fmt::format("rod {} came from nowhere by step {}", id, to.step));
  for (const auto &[id, rod] : from.rods) {
    if (to.rods.count(id)) continue;
    double reach = time * norm(run.effects.gravity) * time;
    for (const auto &[other_id, other] : from.rods)
      reach = std::max(reach, 4.0 * (norm(other.v) + norm(other.omega) * other.length) * time);
    bool near = !run.effects.forces_known || run.effects.box_changes;
    for (int d = 0; d < 3; d++)
      near = near || (from.box.fixed[d] &&
                      std::min(component(rod.x, d) - from.box.lo[d],
                               from.box.hi[d] - component(rod.x, d)) < reach + rod.length);
    if (!near) throw Wrong(fmt::format("rod {} is gone by step {}", id, to.step));
  }
}

void check_momentum(const Run &run, const State &from, const State &to, double time)
{
  const Totals a = totals(from), b = totals(to);
  const Vec3 fall = (a.mass * time) * run.effects.gravity;
  const double scale = a.momentum_scale + b.momentum_scale + norm(fall);
  const double miss = norm(b.momentum - a.momentum - fall);
  if (miss > 1e-9 * scale)
    throw Wrong(fmt::format("momentum changed by {:.3g} of {:.3g} from step {} to {}", miss, scale,
                            from.step, to.step));
  held().momentum++;
  const Box &box = from.box;
  if (box.periodic[0] || box.periodic[1] || box.periodic[2]) return;
  if (norm(run.effects.gravity) > 0.0 || run.effects.omega_limit > 0.0) return;
  const double turn = norm(b.angular - a.angular);
  if (turn > 1e-8 * (a.angular_scale + b.angular_scale))
    throw Wrong(fmt::format("angular momentum changed by {:.3g} of {:.3g} from step {} to {}", turn,
                            a.angular_scale, from.step, to.step));
  held().angular_momentum++;
}

double largest_overlap(const std::vector<Touch> &touches)
{
  double largest = 0.0;
  for (const Touch &touch : touches) largest = std::max(largest, touch.overlap / touch.reach);
  return largest;
}

std::vector<Touch> all_touches(const Plan &plan, const State &state)
{
  std::vector<Touch> touches = pair_touches(state, plan.material);
  for (const Touch &touch : wall_touches(state, plan.walls, plan.material))
    touches.push_back(touch);
  return touches;
}

// Kinetic energy and what springs hold, less the work of weight, must not grow. A spring along the
// contact holds at most (mu F)^2/(2 kt), with kt >= 2/7 kn 3.5 mu^2 times the normal one's.
void check_energy(const Plan &plan, const Run &run, const State &from, const State &to,
                  bool springs_at_start)
{
  const Material &m = plan.material;
  const std::vector<Touch> first = all_touches(plan, from), last = all_touches(plan, to);
  if (!m.cohesion.empty() || std::max(largest_overlap(first), largest_overlap(last)) > 0.4) return;
  const double before = spring_energy(first, from, m), after = spring_energy(last, to, m);
  if (before < 0.0 || after < 0.0) return;
  double work = 0.0, scale = 0.0;
  for (const auto &[id, rod] : from.rods) {
    const double along = dot(rod.mass * run.effects.gravity, way_of(rod, to.rods.at(id), to.box));
    if (run.effects.still.count(id)) continue;
    work += along;
    scale += std::fabs(along);
  }
  const bool stored = springs_at_start && m.tangential == "history";
  const double extra = (stored ? 3.5 * m.friction * m.friction : 0.0) + (m.rolling.empty() ? 0 : 1);
  const double start = totals(from).kinetic + before, end = totals(to).kinetic;
  const double tolerance = 0.05 * (start + scale) + 1e-12;
  if (end > start + extra * before + work + tolerance)
    throw Wrong(fmt::format("kinetic energy {:.4g} at step {}, at most {:.4g} (kinetic and of "
                            "springs at step {}) and work {:.3g}",
                            end, to.step, start + extra * before, from.step, work));
  held().energy++;
  const bool closed = m.elastic() && m.tangential == "off" && m.rolling.empty() && !m.spread &&
                      run.effects.conservative;
  if (closed && end + after < start + work - tolerance)
    throw Wrong(fmt::format("energy {:.4g} at step {} of elastic rods, {:.4g} at step {}, work "
                            "{:.3g}",
                            end + after, to.step, start, from.step, work));
  held().energy_kept += closed;
}

// How far a point of the rod may come in a time; forces that are small beside its motion included.
double reach_of(const Rod &a, const Rod &b, const Vec3 &pull, double time)
{
  const double speed =
      std::max(norm(a.v) + norm(a.omega) * a.length, norm(b.v) + norm(b.omega) * b.length);
  return 1.1 * speed * time + norm(pull) * time * time;
}

// Rods that cannot have met anything fly and turn as a free rod does.
void check_flight(const Plan &plan, const Run &run, const State &from, const State &to, double time)
{
  double farthest = 0.0;
  std::map<int, Vec3> pulls;
  for (const auto &[id, rod] : from.rods) {
    const auto added = run.effects.added_force.find(id);
    pulls[id] = run.effects.gravity;
    if (added != run.effects.added_force.end())
      pulls[id] = pulls[id] + (1.0 / rod.mass) * added->second;
    farthest = std::max(farthest, reach_of(rod, to.rods.at(id), pulls[id], time));
  }
  std::set<int> near;
  for (const Touch &touch : pair_touches(from, plan.material, -2.0 * farthest)) {
    near.insert(touch.i);
    near.insert(touch.j);
  }
  for (const auto &[id, rod] : from.rods) {
    const Rod &now = to.rods.at(id);
    for (const Wall &wall : plan.walls)
      for (const double end : {-1.0, 1.0})
        if (wall_gap(wall.at(from.step), rod.x + end * rod.half_cylinder() * rod.axis, rod.x) <
            rod.radius + farthest +
                std::fabs(wall.way_in_a_step) * static_cast<double>(to.step - from.step))
          near.insert(id);
    if (near.count(id) || run.effects.still.count(id) || run.effects.driven.count(id)) continue;
    const Vec3 wanted_v = rod.v + time * pulls[id];
    const Vec3 way = time * rod.v + (0.5 * time * time) * pulls[id];
    const double size = norm(way) + rod.length;
    const double other_v = norm(now.v - wanted_v), off = norm(way_of(rod, now, from.box) - way);
    if (other_v > 1e-9 * (norm(wanted_v) + norm(rod.v)) + 1e-14 || off > 1e-9 * size)
      throw Wrong(fmt::format("rod {} met nobody, but to step {} its velocity is off by {:.3g} and "
                              "its place by {:.3g}",
                              id, to.step, other_v, off));
    held().flights++;
    const Vec3 J = rod.angular_momentum();
    if (run.effects.omega_limit > 0.0 || norm(J) == 0.0) continue;
    if (norm(now.angular_momentum() - J) > 1e-8 * norm(J))
      throw Wrong(fmt::format("rod {} met nobody, but its angular momentum changed to step {}", id,
                              to.step));
    const Vec3 axis =
        turned(rod.axis, (1.0 / norm(J)) * J, norm(J) * time / rod.inertia_transverse());
    if (norm(now.axis - axis) > 1e-7)
      throw Wrong(fmt::format("rod {} met nobody, but its axis at step {} is not that of a free "
                              "rod",
                              id, to.step));
  }
}

// A moving wall goes through what is held.
void check_walls(const Plan &plan, const Effects &effects, const State &from, const State &to)
{
  for (const Wall &wall : plan.walls)
    for (const auto &[id, rod] : from.rods) {
      if (effects.still.count(id)) continue;
      const Rod &now = to.rods.at(id);
      const double then = wall.at(from.step).position, at = wall.at(to.step).position;
      const bool through =
          wall.cylinder ? wall_gap(wall, now.x, now.x) < 0.0 && wall_gap(wall, rod.x, rod.x) > 0.0
                        : (component(rod.x, wall.dim) > then) != (component(now.x, wall.dim) > at);
      if (through)
        throw Wrong(fmt::format("rod {} went through wall {} by step {}", id, wall.id, to.step));
    }
}

}  // namespace

void check_motion(const Plan &plan, const Run &run, const std::vector<State> &states,
                  bool springs_at_start)
{
  const Effects &effects = run.effects;
  for (size_t k = 1; k < states.size(); k++) {
    const State &from = states[k - 1], &to = states[k];
    const double time = run.dt * static_cast<double>(to.step - from.step);
    check_count(run, from, to, time);
    if (!same_rods(from, to) || effects.inserting || effects.box_changes) continue;
    if (effects.only_internal) check_momentum(run, from, to, time);
    if (effects.forces_known) check_flight(plan, run, from, to, time);
    if (effects.driven.empty() && effects.forces_known) check_walls(plan, effects, from, to);
    if (effects.omega_limit > 0.0 && !effects.unknown_held)
      for (const auto &[id, rod] : to.rods)
        if (!effects.driven.count(id) && norm(rod.omega) > effects.omega_limit * (1.0 + 1e-9))
          throw Wrong(fmt::format("rod {} turns with {} at step {}, limit {}", id, norm(rod.omega),
                                  to.step, effects.omega_limit));
  }
  const State &from = states.front(), &to = states.back();
  if (!same_rods(from, to) || effects.inserting || effects.box_changes) return;
  if (!effects.energy_may_grow && images_are_plain(to) && effects.counts_all_pairs)
    check_energy(plan, run, from, to, springs_at_start);
}

void check_driven(const Plan &plan, const Run &run, const std::vector<State> &states)
{
  for (const State &state : states)
    for (const auto &[id, rod] : state.rods) {
      const auto start = plan.start.find(id);
      if (start == plan.start.end()) continue;
      const auto driven = run.effects.driven.find(id);
      const bool still = run.effects.still.count(id) > 0;
      held().driven += still || driven != run.effects.driven.end();
      if (!still && driven == run.effects.driven.end()) continue;
      const double time = run.dt * static_cast<double>(state.step);
      const Rod wanted = still ? start->second : driven->second(start->second, time);
      if (norm(state.box.nearest(rod.x - wanted.x)) > 1e-7 * rod.length ||
          norm(cross(rod.axis, wanted.axis)) > 1e-7)
        throw Wrong(fmt::format("{} rod {} is not where it should be at step {}",
                                still ? "held" : "driven", id, state.step));
      if (state.step > 0 && norm(rod.v - wanted.v) > 1e-6 * (1e-3 + norm(wanted.v)))
        throw Wrong(fmt::format("{} rod {} has another speed at step {}", still ? "held" : "driven",
                                id, state.step));
      if (state.step > 0 && norm(rod.omega - wanted.omega) > 1e-6 * (1.0 + norm(wanted.omega)))
        throw Wrong(fmt::format("{} rod {} turns with another speed at step {}",
                                still ? "held" : "driven", id, state.step));
    }
}

}  // namespace grammar
