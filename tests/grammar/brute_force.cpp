// SPDX-License-Identifier: GPL-2.0-or-later
#include "brute_force.h"

#include <algorithm>
#include <cmath>

namespace grammar {

namespace {

double aspect(const Rod &rod) { return 0.5 * rod.length / rod.radius; }

double pair_stiffness(const Rod &a, const Rod &b, const Material &material)
{
  const double scale =
      material.aspect_scaling ? 2.0 * aspect(a) * aspect(b) / (aspect(a) + aspect(b)) : 1.0;
  return scale * material.pair_kn(a.type, b.type);
}

double mean_radius(const Touch &touch, const State &state)
{
  const double a = state.rods.at(touch.i).radius;
  if (touch.j == 0) return a;
  const double b = state.rods.at(touch.j).radius;
  return a * b / (a + b);
}

// From the wall to the rod's side of it.
Vec3 wall_normal(const Wall &wall, const Vec3 &point, const Vec3 &centre)
{
  Vec3 normal{0.0, 0.0, 0.0};
  if (!wall.cylinder) {
    component(normal, wall.dim) = component(centre, wall.dim) > wall.position ? 1.0 : -1.0;
    return normal;
  }
  Vec3 out = point;
  component(out, wall.dim) = 0.0;
  const double distance = norm(out);
  return distance > 0.0 ? (-1.0 / distance) * out : normal;
}

}  // namespace

Closest closest_by_search(const Rod &a, const Rod &b, const Vec3 &b_from_a)
{
  const double ha = a.half_cylinder(), hb = b.half_cylinder();
  Closest best;
  const auto at = [&](double s) {
    const Vec3 p = s * a.axis;
    const double t = std::max(-hb, std::min(hb, dot(p - b_from_a, b.axis)));
    const Vec3 q = b_from_a + t * b.axis;
    return Closest{norm(p - q), p, t * b.axis};
  };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double lo = -ha, hi = ha;
  for (int k = 0; k < 60; k++) {
    const double width = hi - lo;
    if (at(hi - golden * width).distance < at(lo + golden * width).distance)
      hi = lo + golden * width;
    else
      lo = hi - golden * width;
  }
  best = at(0.5 * (lo + hi));
  for (const double end : {-ha, ha}) {
    const Closest there = at(end);
    if (there.distance < best.distance) best = there;
  }
  return best;
}

// The nearest image of a difference of positions and those beside it.
static std::vector<Vec3> images(const Box &box, const Vec3 &difference)
{
  std::vector<Vec3> all = {box.nearest(difference)};
  for (int d = 0; d < 3; d++) {
    if (!box.periodic[d]) continue;
    const std::vector<Vec3> before = all;
    for (Vec3 image : before) {
      component(image, d) += box.period(d);
      all.push_back(image);
      component(image, d) -= 2.0 * box.period(d);
      all.push_back(image);
    }
  }
  return all;
}

std::vector<Touch> pair_touches(const State &state, const Material &material, double least)
{
  std::vector<Touch> touches;
  for (auto first = state.rods.begin(); first != state.rods.end(); first++)
    for (auto second = std::next(first); second != state.rods.end(); second++) {
      const Rod &a = first->second, &b = second->second;
      const double reach = a.radius + b.radius;
      for (const Vec3 &apart : images(state.box, b.x - a.x)) {
        if (norm(apart) > 0.5 * (a.length + b.length) - least) continue;
        const Closest closest = closest_by_search(a, b, apart);
        if (reach - closest.distance <= least) continue;
        Touch touch;
        touch.i = a.id;
        touch.j = b.id;
        touch.reach = reach;
        touch.overlap = reach - closest.distance;
        const Vec3 from_b = closest.on_a - closest.on_b - apart;
        touch.normal = closest.distance > 0.0 ? (1.0 / closest.distance) * from_b : Vec3{0, 0, 0};
        touch.arm_i = closest.on_a - (a.radius - 0.5 * touch.overlap) * touch.normal;
        touch.arm_j = closest.on_b + (b.radius - 0.5 * touch.overlap) * touch.normal;
        touch.stiffness = pair_stiffness(a, b, material);
        const bool spheres =
            a.half_cylinder() < 1e-3 * a.radius || b.half_cylinder() < 1e-3 * b.radius;
        touch.plain =
            closest.distance > 0.1 * reach && (spheres || norm(cross(a.axis, b.axis)) > 0.02);
        touches.push_back(touch);
      }
    }
  return touches;
}

double wall_gap(const Wall &wall, const Vec3 &point, const Vec3 &centre)
{
  if (!wall.cylinder) {
    const double side = component(centre, wall.dim) > wall.position ? 1.0 : -1.0;
    return side * (component(point, wall.dim) - wall.position);
  }
  Vec3 out = point;
  component(out, wall.dim) = 0.0;
  return wall.radius - norm(out);
}

std::vector<Touch> wall_touches(const State &state, const std::vector<Wall> &walls,
                                const Material &material)
{
  std::vector<Touch> touches;
  for (const Wall &moving : walls)
    for (const auto &[id, rod] : state.rods)
      for (const double end : {-1.0, 1.0}) {
        if (end > 0.0 && rod.half_cylinder() <= 1e-12 * rod.radius) continue;  // a ball has one
        const Wall wall = moving.at(state.step);
        const Vec3 arm = end * rod.half_cylinder() * rod.axis;
        const double gap = wall_gap(wall, rod.x + arm, rod.x);
        if (gap >= rod.radius) continue;
        Touch touch;
        touch.i = id;
        touch.reach = 2.0 * rod.radius;
        touch.overlap = rod.radius - gap;
        touch.normal = wall_normal(wall, rod.x + arm, rod.x);
        touch.arm_i = arm - (rod.radius - 0.5 * touch.overlap) * touch.normal;
        touch.stiffness =
            material.pair_kn(rod.type, wall.type) * (material.aspect_scaling ? aspect(rod) : 1.0);
        touch.plain = gap > 0.05 * rod.radius;
        touches.push_back(touch);
      }
  return touches;
}

bool images_are_plain(const State &state)
{
  if (!state.box.exact) return false;
  double longest = 0.0;
  for (const auto &[id, rod] : state.rods) longest = std::max(longest, rod.length);
  for (int d = 0; d < 3; d++)
    if (state.box.periodic[d] && state.box.period(d) < 2.0 * longest) return false;
  return true;
}

double spring_energy(const std::vector<Touch> &touches, const State &state,
                     const Material &material)
{
  double sum = 0.0;
  for (const Touch &touch : touches) {
    const double delta = touch.overlap;
    if (material.normal == "linear") {
      sum += 0.5 * touch.stiffness * delta * delta;
    } else if (material.normal == "hertz") {
      // F = 4/3 Y sqrt(R) delta^(3/2), Y = E/(2 (1 - nu^2)) for two bodies of one material
      const double Y = material.young / (2.0 * (1.0 - material.poisson * material.poisson));
      sum += 8.0 / 15.0 * Y * std::sqrt(mean_radius(touch, state)) * std::pow(delta, 2.5);
    } else if (material.normal == "hooke/stiffness") {
      sum += 0.5 * material.kn * delta * delta;
    } else {
      return -1.0;
    }
  }
  return sum;
}

}  // namespace grammar
