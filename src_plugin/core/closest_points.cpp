// SPDX-License-Identifier: GPL-2.0-or-later
#include "closest_points.h"

namespace spherocylinder {

namespace {

ClosestPoints pair_at(const Segment &i, double s, const Segment &j, double t)
{
  const Vec3 delta = i.at(s) - j.at(t);
  return {s, t, delta, norm_squared(delta)};
}

void keep_nearer(ClosestPoints &best, const ClosestPoints &candidate)
{
  if (candidate.distance_squared < best.distance_squared) best = candidate;
}

}  // namespace

ClosestPoints closest_points(const Segment &i, const Segment &j)
{
  // Critical point of the lines: s = (r x v).n / |n|^2, t = (r x u).n / |n|^2, n = u x v.
  // Written with cross products because 1 - (u.v)^2 loses all digits for nearly parallel rods.
  const Vec3 between = j.centre - i.centre;
  const Vec3 normal = cross(i.axis, j.axis);
  const double determinant = norm_squared(normal);
  const double s_scaled = dot(cross(between, j.axis), normal);
  const double t_scaled = dot(cross(between, i.axis), normal);

  // Strict: a zero determinant fails both tests and leaves the rim to decide.
  if (std::fabs(s_scaled) < i.half_length * determinant &&
      std::fabs(t_scaled) < j.half_length * determinant) {
    // For nearly parallel rods s is uncertain along a valley where the distance hardly changes.
    // Projecting onto the partner keeps the pair at the bottom of that valley.
    const double t = closest_position(j, i.at(s_scaled / determinant));
    const double s = closest_position(i, j.at(t));
    return pair_at(i, s, j, t);
  }

  const double hi = i.half_length, hj = j.half_length;
  ClosestPoints best = pair_at(i, -hi, j, closest_position(j, i.at(-hi)));
  keep_nearer(best, pair_at(i, hi, j, closest_position(j, i.at(hi))));
  keep_nearer(best, pair_at(i, closest_position(i, j.at(-hj)), j, -hj));
  keep_nearer(best, pair_at(i, closest_position(i, j.at(hj)), j, hj));
  return best;
}

}  // namespace spherocylinder
