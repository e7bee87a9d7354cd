// SPDX-License-Identifier: GPL-2.0-or-later
// What of a contact near a joint of a fibre is one segment's, where both have the shared hemisphere.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/capsule.h"
#include "core/closest_points.h"

namespace spherocylinder {

// A line that leaves a rod through one of its ends' centres.
struct EndLine {
  Vec3 from;     // the end's centre
  Vec3 outward;  // unit, along the axis, away from the rod
};

inline EndLine line_through_end(const Segment &rod, bool head)
{
  const double sign = head ? 1.0 : -1.0;
  return {rod.at(sign * rod.half_length), sign * rod.axis};
}

// Where a line is pressed into something: from centre - half to centre + half, by the distance outwards from
// the end (m).
struct LinePatch {
  double centre, half;
};

// Of all of the line that is nearer than `reach` to the axis of `other`, the part where the overlap is at
// least a share of the deepest: all but 1/16 for crossed axes, so that the patch is a quarter as long as the
// contact; any for parallel ones, which touch along all of their common length. A line that is farther away has
// a patch of no length where it is nearest.
LinePatch patch_on_line(const EndLine &line, const Segment &other, double reach);

// Half the length of a patch beyond which two rods on either side of a joint have contacts of their own. Of
// half lengths and the fibre's radius.
inline double longest_shared(double own, double next, double other, double radius)
{
  return 0.5 * (std::min({own, next, other}) + radius);
}

// The part of a contact at a joint that is the first rod's, 0 to 1. `own`, `next`: patches on the line out of
// the first rod and, outwards of the second, on that out of the second. Patches longer than twice `longest`
// count as so long. It is how much of the patch lies before the joint, 3 y^2 - 2 y^3 of its length, and
//   - on a straight fibre, and on the outside of a bent one, both go by the mean of both patches: their parts add
//     up to 1 if it is no longer than that;
//   - on the inside of a bent one, where both are touched for themselves, each goes by its own.
// Of a longer patch each rod has all of its contact as soon as so much of it is its own: two rods, side by side
// with a third, bear as two.
double share_at_joint(const LinePatch &own, const LinePatch &next, double longest);

// By how much it falls with the distance of the patch outwards (1/m), and how far that is the rod's own patch, 1,
// or the mean of both, 0: without a step where a joint turns from one side to the other.
struct ShareSlope {
  double fall, by_own;
};
ShareSlope slope_of_share(const LinePatch &own, const LinePatch &next, double longest);

// How a patch on the line moves with the other axis, along the line: no motion of a crossed axis along itself
// counts; a patch that is as long as the other rod, or where that one ends (`at_end`), moves as it does.
Vec3 advance_on_line(const Vec3 &line, const Segment &other, const LinePatch &patch, bool at_end);

// Whether `own` lies so far before the joint that its rod has all of it, whatever the other's is.
bool is_all_before_joint(const LinePatch &own, double longest);

// How far beyond its end the first rod's contact may be, where `within` of the second is nearest: so far as the
// patch reaches, that on a straight fibre both rods are touched at the same point. Nothing for long patches. Of a
// bent joint no farther than where the line has left the second's axis by a sixteenth of the overlap at the end:
// beside that axis the fibre is not.
double reach_beyond_joint(const LinePatch &own, const LinePatch &next, double longest,
                          double within, double bend_sine, double overlap);

// With one end so much farther out, the head if `beyond` is positive, the tail if negative.
inline Segment extended(const Segment &rod, double beyond)
{
  if (beyond == 0.0) return rod;
  return {rod.at(0.5 * beyond), rod.axis, rod.half_length + 0.5 * std::fabs(beyond)};
}

// Closest points of extended segments, as positions on the rods.
inline ClosestPoints on_rods(const ClosestPoints &points, double beyond_i, double beyond_j)
{
  return {points.s + 0.5 * beyond_i, points.t + 0.5 * beyond_j, points.delta,
          points.distance_squared};
}

}  // namespace spherocylinder
