// SPDX-License-Identifier: GPL-2.0-or-later
// The contact search of two sphero-cylinders in five steps, as it stands in "Discrete element
// modelling of high aspect ratio sphero-cylinder particle packing", section 2.2, to compare with
// closest_points. Not to be used: it misses contacts.
#pragma once

#include "core/closest_points_batch.h"

namespace spherocylinder {

// The points p on i and q on j at which the search looks:
//   1. bounding spheres that are apart: no contact (the lists of pairs have seen to that)
//   2. p and q are the nearest points of the two infinite lines
//   3. both within their segments: cylinder against cylinder, at p and q
//   4. one within: cylinder against sphere, the end of the other segment on the side of its point
//      against this segment
//   5. neither within: sphere against sphere, the nearest two of the ends. Lines that are parallel to
//      the last bit have no p and q, and count here.
//
// Steps 3 and 4 are right: a convex function's minimum over a rectangle is on a side that the
// critical point lies beyond. Step 5 misses the end of one rod on the side of the other. Of the places
// of j's centre in which rods at the angle g, unless nearly parallel, have their axes nearer than d,
// it misses the volume (8/3) d^3 (cot g - (pi/2 - g)): at each of the two obtuse corners of the
// parallelogram of all p - q, two wedges of the half cylinders along its sides, less those of the sphere
// about the corner. The distance found is never less than the right one.
ClosestPoints five_step_points(const Segment &i, const Segment &j);

// The same for a batch: none is uncertain, none is to be spread as nearly parallel.
void five_step_points(SegmentPairs &pairs);

// What closest_points gives for the pairs that the search finds within their reach; the others are as
// far apart as it has them.
void closest_points_in_five_steps(SegmentPairs &pairs);

}  // namespace spherocylinder
