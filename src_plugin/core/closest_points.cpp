// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/closest_points.h"

namespace spherocylinder {

namespace {

void keep_nearer(ClosestPoints &best, const ClosestPoints &candidate)
{
  if (candidate.distance_squared < best.distance_squared) best = candidate;
}

ClosestPoints end_of_i(const Segment &i, double s, const Segment &j)
{
  return points_at(i, s, j, closest_position(j, i.at(s)));
}

ClosestPoints end_of_j(const Segment &i, const Segment &j, double t)
{
  return points_at(i, closest_position(i, j.at(t)), j, t);
}

ClosestPoints best_end(const Segment &i, const Segment &j)
{
  const double hi = i.half_length, hj = j.half_length;
  ClosestPoints best = end_of_i(i, -hi, j);
  keep_nearer(best, end_of_i(i, hi, j));
  keep_nearer(best, end_of_j(i, j, -hj));
  keep_nearer(best, end_of_j(i, j, hj));
  return best;
}

}  // namespace

ClosestPoints closest_points(const Segment &i, const Segment &j)
{
  const auto [s_scaled, t_scaled, determinant] = nearest_of_lines(i, j);
  const double hi = i.half_length, hj = j.half_length;

  // How far outside its segment each coordinate is, times the determinant.
  const double s_outside = std::fabs(s_scaled) - hi * determinant;
  const double t_outside = std::fabs(t_scaled) - hj * determinant;

  // Strict: a zero determinant fails both tests and leaves the ends to decide.
  if (s_outside < 0.0 && t_outside < 0.0) {
    // For nearly parallel rods s is uncertain along a valley where the distance hardly changes.
    // Projecting onto the partner keeps the pair at the bottom of that valley.
    const double t = closest_position(j, i.at(s_scaled / determinant));
    const double s = closest_position(i, j.at(t));
    return points_at(i, s, j, t);
  }

  // The minimum on the rim is on a side that the critical point lies beyond: from any other side
  // one could step towards the critical point, inside the rectangle and downhill. Where rounding
  // could have put the critical point on the wrong side, all four ends are asked.
  const Vec3 between = j.centre - i.centre;
  const double size = std::fabs(between.x) + std::fabs(between.y) + std::fabs(between.z) + hi + hj;
  const double uncertain = kClosestPointsRounding * size;
  if (std::fabs(s_outside) <= uncertain || std::fabs(t_outside) <= uncertain) return best_end(i, j);
  if (t_outside < 0.0) return end_of_i(i, std::copysign(hi, s_scaled), j);
  if (s_outside < 0.0) return end_of_j(i, j, std::copysign(hj, t_scaled));
  ClosestPoints best = end_of_i(i, std::copysign(hi, s_scaled), j);
  keep_nearer(best, end_of_j(i, j, std::copysign(hj, t_scaled)));
  return best;
}

}  // namespace spherocylinder
