// SPDX-License-Identifier: GPL-2.0-or-later
// What of a contact near a joint of a fibre is one segment's, where both have the shared hemisphere.
#pragma once

#include "core/capsule.h"

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

// The part of a contact at a joint that is the first rod's, 0 to 1. `own`, `next`: patches on the line out of
// the first rod and, outwards of the second, on that out of the second. Patches longer than `radius` count
// as so long. It is how much of the patch lies before the joint, 3 y^2 - 2 y^3 of its length, and
//   - on a straight fibre, and on the outside of a bent one, both go by the mean of both patches: their parts add
//     up to 1 if it is no longer than the radius;
//   - on the inside of a bent one, where both are touched for themselves, each goes by its own.
// Of a patch longer than the radius each rod has all of its contact as soon as a radius of it is its own.
double share_at_joint(const LinePatch &own, const LinePatch &next, double radius);

// Whether `own` lies so far before the joint that its rod has all of it, whatever the other's is.
bool is_all_before_joint(const LinePatch &own, double radius);

}  // namespace spherocylinder
