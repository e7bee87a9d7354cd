// SPDX-License-Identifier: GPL-2.0-or-later
// Where two nearly parallel rods touch, as a continuous function of their poses.
#pragma once

#include "closest_points.h"

namespace spherocylinder {

struct RodContact {
  ClosestPoints points;  // where on the two axes it sits
  double overlap;        // that the contact feels: its force is one stiffness times this
  // overlap over that of the closest point, from 1/2 to 1: the contact is as stiff as this share of
  // its stiffness, and must be damped for that.
  double share = 1.0;
};

// The closest point of two rods jumps from one end of their common length to the other when the
// angle between them passes zero, and the torque jumps with it. This rule shares one contact among
// three points: half a spring at each end of the common length, and the closest point,
//
//   overlap = (1 - g) overlap* + g (overlap_A + overlap_B)/2
//   g = (1 - q^2)^2 m f,  q^2 = H_i H_j sin^2(theta) (1 + (10 overlap*/reach)^2) / (2 reach overlap*)
//
// and sits at the resultant of their forces. overlap* is that of the closest point, A and B are the
// ends of the part of one rod beside the other (an end that does not overlap gives 0), H_i and H_j
// half that length on either rod, and q for small overlaps the ratio of H to the half length of the
// patch in which two crossed rods overlap. From q = 1 on the closest point is all. m = min(H_i,
// H_j)/max(H_i, H_j) is 1 for parallel rods and lets the rule fade in where rods come to lie side by
// side; f is 1 up to an overlap of a tenth of the reach and falls smoothly to 0 at the reach, where
// the axes meet. The weights sum to 1: the stiffness is that of one contact, half of it while a slightly tilted rod touches with
// one end only. Each of A and B is taken on both rods and averaged, so that the rule does not
// depend on which rod is i.
//
// Force and torque are continuous in the pose. While q is small they are those of two springs and
// conserve energy; where g changes they do so only nearly: docs/notes/parallel_rods.md.
//
// `closest`: what closest_points(i, j) gave, nearer than `reach`, the sum of the radii.
RodContact spread_contact(const Segment &i, const Segment &j, double reach,
                          const ClosestPoints &closest);

}  // namespace spherocylinder
