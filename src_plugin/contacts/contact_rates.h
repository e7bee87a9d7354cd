// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/contact_kinematics.h"

namespace LAMMPS_NS {

class LAMMPS;

// Collects, in the steps somebody asks for, an upper bound on the highest frequency of the spring
// network of all contacts.
//
// A contact's spring k stretches by the difference of its two points' displacements, and
// (x_i - x_j)^2 <= 2 x_i^2 + 2 x_j^2. With that the network's stiffness is bounded by springs that
// hold each rod on its own, and a rod's highest omega^2 by the trace of I^-1 K:
//   omega^2 <= max_i sum_c f k_c / m_ic,   1/m_ic = what rod i shows at contact c,
// with f = 2 for a contact with another rod and 1 for a wall, over the normal and both tangential
// directions. Velocity Verlet is stable below 2/omega.
struct ContactRates {
  explicit ContactRates(LAMMPS *) {}

  std::vector<double> squared_frequency;  // bound on omega^2 of each rod, 1/s^2
  std::vector<int> contacts;              // of each rod, walls included
  bool active = false;

  void start(int rods)
  {
    active = true;
    squared_frequency.assign(rods, 0.0);
    contacts.assign(rods, 0);
  }
  void stop() { active = false; }

  // `arm`: from the rod's centre to the point on its axis; `depth`: from there to the contact
  // point, along -normal. `kt` is 0 without a tangential model.
  void add(int i, double factor, double kn, double kt,
           const spherocylinder::InverseInertia &inverse, double inverse_axial,
           const spherocylinder::Vec3 &axis, const spherocylinder::Vec3 &arm, double depth,
           const spherocylinder::Vec3 &normal)
  {
    using namespace spherocylinder;
    const Vec3 contact_arm = arm - depth * normal;
    const Vec3 turn = cross(axis, contact_arm);
    const double about_normal = norm_squared(cross(contact_arm, normal));
    // Sums over two tangents t of |a x t|^2 and ((a x t).u)^2, from those over all directions.
    const double squares = 2.0 * norm_squared(contact_arm) - about_normal;
    const double along = dot(turn, normal);
    const double axial = norm_squared(turn) - along * along;
    const double tangential =
        2.0 * inverse.mass + inverse.transverse * (squares - axial) + inverse_axial * axial;
    squared_frequency[i] +=
        factor * (kn * inverse_effective_mass(inverse, arm, normal) + kt * tangential);
    contacts[i]++;
  }
};

}  // namespace LAMMPS_NS
