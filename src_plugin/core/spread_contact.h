// SPDX-License-Identifier: GPL-2.0-or-later
// Where two nearly parallel rods touch, as a continuous function of their poses.
#pragma once

#include "core/closest_points.h"

namespace spherocylinder {

// Lengths (m) and, for couples, m^2: what acts over the stiffness of the contact's spring.
struct RodContact {
  ClosestPoints points;  // where on the two axes it sits
  double overlap;        // that the contact feels: its force is one stiffness times this
  // overlap over that of the closest point, about 1/2 to 1: the contact is as stiff as this share of
  // its stiffness, and must be damped for that.
  double share = 1.0;
  // What of the force on i is across the normal. It acts at p on i, its opposite at q on j.
  Vec3 sideways = {0.0, 0.0, 0.0};
  Vec3 couple_i = {0.0, 0.0, 0.0}, couple_j = {0.0, 0.0, 0.0};  // beside forces at p and q
};

// The same contact with the rods in the other order.
RodContact swapped(const RodContact &contact);

// Of segments whose centres are so far from their rods': as positions on the rods. Couples are beside forces
// at the contact's points, which stay where they are.
inline RodContact moved(RodContact contact, double s, double t)
{
  contact.points.s += s;
  contact.points.t += t;
  return contact;
}

// The closest point of two rods jumps from one end of their common length to the other when the
// angle between them passes zero, and the torque jumps with it. This rule shares one contact among
// three points: half a spring at each end of the common length, and the closest point. Its energy is
//
//   E = k/2 [ (1 - g) overlap*^2 + g (overlap_A^2 + overlap_B^2)/2 ]
//   g = (1 - q^2)^2 m f,  q^2 = h^2 sin^2(theta) (1 + (10 overlap*/reach)^2) / (2 reach overlap*)
//
// overlap* is that of the closest point, A and B are the ends of the part of one rod beside the other
// (an end that does not overlap gives 0), h is half the length of the shorter segment, and q for small
// overlaps the ratio of h to the half length of the patch in which two crossed rods overlap. From q =
// 1 on the closest point is all. With H_i and H_j half the length side by side on either rod and x =
// min(H_i, H_j)/max(H_i, H_j), 1 for parallel rods, m = x^2 (3 - 2 x) lets the rule fade in where rods
// come to lie side by side; f is 1 up to an overlap of a tenth of the reach and falls smoothly to 0 at
// the reach, where the axes meet. The stiffness is that of one contact, half of it while a slightly
// tilted rod touches with one end only. Each of A and B is taken on both rods and averaged, so that the
// rule does not depend on which rod is i.
//
// Force and torque are all of the derivatives of E, so that a motion without friction and damping keeps
// its energy: three forces along the gaps at the closest point, A and B,
//   (1 - g) overlap* + (dE/dg)(dg/d overlap*)/k  and  g overlap_A/2, g overlap_B/2,
// forces along the axes where A or B lies where the other rod ends, since it moves with that, and
// couples along u_i x u_j of the angle. The contact is their resultant; what it leaves is given as
// `sideways` and couples (docs/notes/parallel_rods.md).
//
// `closest`: what closest_points(i, j) gave, nearer than `reach`, the sum of the radii.
RodContact spread_contact(const Segment &i, const Segment &j, double reach,
                          const ClosestPoints &closest);

}  // namespace spherocylinder
