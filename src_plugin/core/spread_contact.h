// SPDX-License-Identifier: GPL-2.0-or-later
// Where two nearly parallel rods touch, as a continuous function of their poses.
#pragma once

#include "closest_points.h"

namespace spherocylinder {

// The closest point of two rods jumps from one end of their common length to the other when the
// angle between them passes zero, and the torque jumps with it. This rule takes two candidates that
// sit at the two ends of the common length for parallel rods and draw together to the closest point
// s* as the rods turn apart:
//
//   s_A = s* + g (a - s*), s_B = s* + g (b - s*)   g = (1 - q^2)^2, 0 for q >= 1
//   q = H sin(theta) / sqrt(2 reach overlap)
//
// with [a, b] the part of rod i beside rod j, H half its length, and q the ratio of H to the half
// length of the patch in which two crossed rods overlap. Each candidate is half a spring: the
// contact has the mean of their overlaps (0 where the rods do not overlap) and sits at their
// resultant, the mean of the candidates weighted by their overlaps. It stays one contact, with one
// stiffness when the rods are parallel (half of it while a slightly tilted rod touches with one end
// only). Force and torque are continuous; with the candidates at the ends they have an energy,
// (k/4)(overlap_A^2 + overlap_B^2), and where q < 1 moves them, nearly: docs/notes/parallel_rods.md.
//
// `closest`: what closest_points(i, j) gave, nearer than `reach`, the sum of the radii. Returns the
// contact's points on the two axes in the same form, with `delta` scaled to the length
// reach - mean overlap.
ClosestPoints spread_contact(const Segment &i, const Segment &j, double reach,
                             const ClosestPoints &closest);

}  // namespace spherocylinder
