// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/closest_points_batch.h"

#include <cmath>

#include "core/columns.h"

namespace spherocylinder {

namespace {

SPHEROCYLINDER_INLINE double clamp(double value, double bound)
{
  const double below = value < bound ? value : bound;
  return below > -bound ? below : -bound;
}

SPHEROCYLINDER_INLINE double smaller(double a, double b) { return a < b ? a : b; }
SPHEROCYLINDER_INLINE double larger(double a, double b) { return a > b ? a : b; }

// Half the length of a segment beside another one (negative if there is none).
SPHEROCYLINDER_INLINE double half_beside(double middle, double half, double other_half)
{
  return 0.5 * (smaller(half, middle + other_half) - larger(-half, middle - other_half));
}

}  // namespace

SPHEROCYLINDER_VECTOR void closest_points(SegmentPairs &pairs)
{
  for (int k = 0; k < kBatch; k++) {
    const Vec3 between = pairs.between.get(k);
    const Vec3 u = pairs.axis_i.get(k), v = pairs.axis_j.get(k);
    const double hi = pairs.half_i[k], hj = pairs.half_j[k], reach = pairs.reach[k];

    const Vec3 normal = cross(u, v);
    const double determinant = norm_squared(normal);
    const double s_scaled = dot(cross(between, v), normal);
    const double t_scaled = dot(cross(between, u), normal);
    const double s_outside = std::fabs(s_scaled) - hi * determinant;
    const double t_outside = std::fabs(t_scaled) - hj * determinant;
    const double size =
        std::fabs(between.x) + std::fabs(between.y) + std::fabs(between.z) + hi + hj;
    const double margin = kClosestPointsRounding * size;

    const double inside = s_scaled / determinant;
    const double at_end = std::copysign(hi, s_scaled);
    const double start = s_outside < 0.0 ? inside : at_end;
    const double t = clamp(dot(start * u - between, v), hj);
    const double s = clamp(dot(t * v + between, u), hi);
    const Vec3 delta = s * u - t * v - between;
    const double distance_squared = norm_squared(delta);

    pairs.s[k] = s;
    pairs.t[k] = t;
    pairs.delta.set(k, delta);
    pairs.distance_squared[k] = distance_squared;
    const double nearest = smaller(std::fabs(s_outside), std::fabs(t_outside));
    pairs.uncertain[k] = nearest <= margin ? 1.0 : 0.0;

    // q^2 < 1 of spread_contact, without the term that makes q larger for deep overlaps.
    const double cosine = std::fabs(dot(u, v));
    const double on_i = half_beside(dot(between, u), hi, hj * cosine);
    const double on_j = half_beside(-dot(between, v), hj, hi * cosine);
    const double overlap = reach - std::sqrt(distance_squared);
    const double shorter = smaller(hi, hj);
    const double limit = 2.0 * reach * overlap;
    const double below = shorter * shorter * determinant < limit ? 1.0 : 0.0;
    pairs.nearly_parallel[k] = smaller(on_i, on_j) > 0.0 ? below : 0.0;
  }
}

SPHEROCYLINDER_VECTOR void set_pairs(SegmentPairs &pairs, const Capsule *const (&i)[kBatch],
                                     const Capsule *const (&j)[kBatch])
{
  // Centre and axis, half length, radius of a capsule, as eight numbers.
  static_assert(sizeof(Capsule) == 8 * sizeof(double));
  for (int k = 0; k < kBatch; k += kFour) {
    FourRows rows_i, rows_j;
    for (int row = 0; row < kFour; row++) {
      rows_i[row] = &i[k + row]->segment.centre.x;
      rows_j[row] = &j[k + row]->segment.centre.x;
    }
    Four head_i[kFour], head_j[kFour], tail_i[kFour], tail_j[kFour];
    load_columns(rows_i, 0, head_i);
    load_columns(rows_j, 0, head_j);
    load_columns(rows_i, 4, tail_i);
    load_columns(rows_j, 4, tail_j);
    store_column(head_j[0] - head_i[0], pairs.between.x + k);
    store_column(head_j[1] - head_i[1], pairs.between.y + k);
    store_column(head_j[2] - head_i[2], pairs.between.z + k);
    store_column(head_i[3], pairs.axis_i.x + k);
    store_column(tail_i[0], pairs.axis_i.y + k);
    store_column(tail_i[1], pairs.axis_i.z + k);
    store_column(head_j[3], pairs.axis_j.x + k);
    store_column(tail_j[0], pairs.axis_j.y + k);
    store_column(tail_j[1], pairs.axis_j.z + k);
    store_column(tail_i[2], pairs.half_i + k);
    store_column(tail_j[2], pairs.half_j + k);
    store_column(tail_i[3] + tail_j[3], pairs.reach + k);
  }
}

SPHEROCYLINDER_VECTOR void swap_pairs(SegmentPairs &pairs, const Doubles &swapped)
{
  for (int k = 0; k < kBatch; k++) {
    const bool swap = swapped[k] != 0.0;
    const double s = pairs.s[k], t = pairs.t[k];
    const Vec3 delta = pairs.delta.get(k);
    pairs.s[k] = swap ? t : s;
    pairs.t[k] = swap ? s : t;
    pairs.delta.x[k] = swap ? -delta.x : delta.x;
    pairs.delta.y[k] = swap ? -delta.y : delta.y;
    pairs.delta.z[k] = swap ? -delta.z : delta.z;
  }
}

}  // namespace spherocylinder
