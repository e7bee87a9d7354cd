// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "lists/touching_rod_pairs.h"

namespace LAMMPS_NS {

// Where two touching rods push each other, and how deep. Space frame.
struct RodPairGeometry {
  double s, t;                  // of the contact's points on the axes of i and j (m)
  spherocylinder::Vec3 normal;  // unit, towards rod i
  double distance;              // of the points along it, negative once the axes have passed (m)
  double overlap;               // that the contact feels (m)
  double share;                 // of the stiffness, see spherocylinder::RodContact
  // Beside the models' forces, over the stiffness: see spherocylinder::RodContact.
  spherocylinder::Vec3 sideways;            // m
  spherocylinder::Vec3 couple_i, couple_j;  // m^2
};

// What a history keeps of a contact's place: the normal, and in its length the overlap over the sum of
// the radii (0 to 2, beyond 1 once the axes have passed each other). Never zero.
inline spherocylinder::Vec3 remembered_side(const spherocylinder::Vec3 &normal, double depth)
{
  return (3.0 - depth) * normal;
}

// Of such a side; 3 of none.
inline double remembered_depth(const spherocylinder::Vec3 &side)
{
  return 3.0 - spherocylinder::norm(side);
}

// From such a side, where p - q was then. `reach`: sum of the radii (m).
inline spherocylinder::Vec3 remembered_delta(const spherocylinder::Vec3 &side, double reach)
{
  const double length = norm(side);
  return (reach * (length - 2.0) / length) * side;
}

// `side`: what was remembered in the last step, null without a history, zero for a new contact. `spread`: nearly
// parallel rods are spread over (core/spread_contact.h).
//
// The normal points along p - q. Where the pair was in contact before, it must not turn round:
// p - q does so when two axes are driven past each other, and the distance then counts as negative,
// so that the overlap goes on growing and the rods are pushed back the way they came. Where the
// axes meet exactly the last normal serves, or without one the common perpendicular.
RodPairGeometry geometry_of(const TouchingRodPairs::Touch &touch,
                            const std::vector<spherocylinder::Capsule> &rods, const int *tag,
                            const double *side, bool spread);

}  // namespace LAMMPS_NS
