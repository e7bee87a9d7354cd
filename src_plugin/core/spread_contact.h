// SPDX-License-Identifier: GPL-2.0-or-later
// Where two nearly parallel rods touch, as a continuous function of their poses.
#pragma once

#include "closest_points.h"

namespace spherocylinder {

// The closest point of two rods jumps from one end of their common length to the other when the
// angle between them passes zero, and the torque jumps with it. This rule puts the contact at the
// mean of two candidates, weighted by their overlaps, that sit at the two ends of the common length
// for parallel rods and draw together to the closest point as the rods cross:
//
//   s_A = s* + g (a - s*), s_B = s* + g (b - s*)   g = 1 / (1 + q^2),
//   q = H sin(theta) / sqrt(2 reach overlap)
//
// with s* the closest point, [a, b] the part of rod i beside rod j, H half its length, and q the
// ratio of H to the half length of the patch in which two crossed rods overlap. Weights are the
// candidates' overlaps (none if they do not overlap), divided by their sum: there is still one
// contact with one stiffness. Two parallel rods touch at the middle of their common length, and
// tilting them by less than overlap / H moves the contact along it in proportion.
//
// `closest`: what closest_points(i, j) gave, nearer than `reach`, the sum of the radii. Returns the
// contact's points on the two axes in the same form.
ClosestPoints spread_contact(const Segment &i, const Segment &j, double reach,
                             const ClosestPoints &closest);

}  // namespace spherocylinder
