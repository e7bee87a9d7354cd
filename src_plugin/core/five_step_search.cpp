// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/five_step_search.h"

#include <cmath>
#include <initializer_list>

namespace spherocylinder {

namespace {

ClosestPoints nearest_ends(const Segment &i, const Segment &j)
{
  ClosestPoints nearest = points_at(i, i.half_length, j, j.half_length);
  for (const double s : {-i.half_length, i.half_length})
    for (const double t : {-j.half_length, j.half_length}) {
      const ClosestPoints ends = points_at(i, s, j, t);
      if (ends.distance_squared < nearest.distance_squared) nearest = ends;
    }
  return nearest;
}

ClosestPoints five_step_points_of(const SegmentPairs &pairs, int k)
{
  return five_step_points({{0.0, 0.0, 0.0}, pairs.axis_i.get(k), pairs.half_i[k]},
                          {pairs.between.get(k), pairs.axis_j.get(k), pairs.half_j[k]});
}

}  // namespace

ClosestPoints five_step_points(const Segment &i, const Segment &j)
{
  const auto [s_scaled, t_scaled, determinant] = nearest_of_lines(i, j);
  const bool p_within = std::fabs(s_scaled) < i.half_length * determinant;
  const bool q_within = std::fabs(t_scaled) < j.half_length * determinant;

  if (p_within && q_within) {
    const double s = s_scaled / determinant;
    return points_at(i, s, j, closest_position(j, i.at(s)));
  }
  if (p_within) {
    const double t = std::copysign(j.half_length, t_scaled);
    return points_at(i, closest_position(i, j.at(t)), j, t);
  }
  if (q_within) {
    const double s = std::copysign(i.half_length, s_scaled);
    return points_at(i, s, j, closest_position(j, i.at(s)));
  }
  return nearest_ends(i, j);
}

void five_step_points(SegmentPairs &pairs)
{
  for (int k = 0; k < kBatch; k++) {
    const ClosestPoints points = five_step_points_of(pairs, k);
    pairs.s[k] = points.s;
    pairs.t[k] = points.t;
    pairs.delta.set(k, points.delta);
    pairs.distance_squared[k] = points.distance_squared;
    pairs.uncertain[k] = pairs.nearly_parallel[k] = 0.0;
  }
}

void closest_points_in_five_steps(SegmentPairs &pairs)
{
  closest_points(pairs);
  for (int k = 0; k < kBatch; k++) {
    const double distance_squared = five_step_points_of(pairs, k).distance_squared;
    if (distance_squared < pairs.reach[k] * pairs.reach[k]) continue;
    pairs.distance_squared[k] = distance_squared;
    pairs.uncertain[k] = 0.0;
  }
}

}  // namespace spherocylinder
