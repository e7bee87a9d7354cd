// SPDX-License-Identifier: GPL-2.0-or-later
// closest_points for a batch of pairs.
#pragma once

#include "core/batch.h"
#include "core/capsule.h"
#include "core/closest_points.h"

namespace spherocylinder {

struct SegmentPairs {
  // In: of each pair (space frame, m).
  Vec3s between;           // centre of j less that of i
  Vec3s axis_i, axis_j;    // unit
  Doubles half_i, half_j;  // half the lengths of the segments
  Doubles reach;           // sum of the radii

  // Out: as in ClosestPoints.
  Doubles s, t;
  Vec3s delta;
  Doubles distance_squared;
  // Not 0 where rounding could have misled the batch: make_certain must be asked.
  Doubles uncertain;
  // Not 0 where spread_contact might move the contact (it decides); always 0 for reach 0.
  Doubles nearly_parallel;

  void set(int k, const Segment &i, const Segment &j, double reach_of_pair)
  {
    between.set(k, j.centre - i.centre);
    axis_i.set(k, i.axis);
    axis_j.set(k, j.axis);
    half_i[k] = i.half_length;
    half_j[k] = j.half_length;
    reach[k] = reach_of_pair;
  }
  ClosestPoints get(int k) const { return {s[k], t[k], delta.get(k), distance_squared[k]}; }
  bool touches(int k) const { return !(distance_squared[k] >= reach[k] * reach[k]); }
};

// Works out all kBatch pairs; those not set since the last call are of no meaning.
//
// The critical point of the lines, clamped to segment i; its projection, clamped, on j; and that of
// the latter on i. For a convex quadratic over a rectangle this ends at the minimum: where the first
// clamp was against the gradient it stays, and a clamp on j is followed by the best s on that side.
void closest_points(SegmentPairs &pairs);

// Sets kBatch pairs at once, from any capsules.
void set_pairs(SegmentPairs &pairs, const Capsule *const (&i)[kBatch],
               const Capsule *const (&j)[kBatch]);

// Closest points of as many pairs as a batch has, as they stand side by side.
struct ClosestLanes {
  const double *s, *t, *delta_x, *delta_y, *delta_z, *distance_squared, *nearly_parallel;
};

// What came out, of those for which `swapped` is not 0 as if i and j had been set the other way round.
void swap_pairs(SegmentPairs &pairs, const Doubles &swapped);

// Pair k, of which the batch is uncertain and which was set from these two segments, by itself.
inline void make_certain(SegmentPairs &pairs, int k, const Segment &i, const Segment &j)
{
  const ClosestPoints points = closest_points(i, j);
  pairs.s[k] = points.s;
  pairs.t[k] = points.t;
  pairs.delta.set(k, points.delta);
  pairs.distance_squared[k] = points.distance_squared;
}

}  // namespace spherocylinder
