// SPDX-License-Identifier: GPL-2.0-or-later
// Mass properties of a homogeneous rod, exact for cylinder plus two hemispheres.
#pragma once

#include "core/vec3.h"

namespace spherocylinder {

struct MassProperties {
  double volume;              // m^3
  double area;                // surface, m^2
  double mass;                // kg
  double inertia_axial;       // about the axis, kg m^2
  double inertia_transverse;  // about any line through the centre at right angles to it, kg m^2
};

// diameter > 0, length >= diameter (total length L = h + 2 r; L = D is a sphere), density in
// kg/m^3. With m_c = rho pi r^2 h and m_s = rho 4/3 pi r^3 (both hemispheres together):
//   I_a = m_c r^2/2 + 2/5 m_s r^2
//   I_t = m_c (h^2/12 + r^2/4) + m_s (2 r^2/5 + h^2/4 + 3 h r/8)
// where the last bracket is a hemisphere's own inertia moved from its centroid (3r/8 from the flat
// face) to the rod's centre.
//
// `shared_ends`: of a segment of a fibre, whose hemisphere there lies in its neighbour's cylinder and is
// left out, from 0 to 2. With one, what is left of m_s is spread over both ends: the centre of mass stays
// the centre of the rod.
MassProperties mass_properties(double diameter, double length, double density, int shared_ends = 0);

// Angular velocity of a symmetric top from its angular momentum, both in the space frame; from the
// reciprocals of its inertias.
SPHEROCYLINDER_INLINE Vec3 angular_velocity_by_inverse(const Vec3 &angular_momentum,
                                                       const Vec3 &axis, double inverse_axial,
                                                       double inverse_transverse)
{
  const double along = dot(angular_momentum, axis);
  return inverse_transverse * angular_momentum +
         (along * (inverse_axial - inverse_transverse)) * axis;
}

inline Vec3 angular_velocity(const Vec3 &angular_momentum, const Vec3 &axis, double inertia_axial,
                             double inertia_transverse)
{
  return angular_velocity_by_inverse(angular_momentum, axis, 1.0 / inertia_axial,
                                     1.0 / inertia_transverse);
}

// Angular momentum of a symmetric top from its angular velocity, both in the space frame.
inline Vec3 angular_momentum(const Vec3 &omega, const Vec3 &axis, double inertia_axial,
                             double inertia_transverse)
{
  return inertia_transverse * omega +
         (inertia_axial - inertia_transverse) * dot(omega, axis) * axis;
}

// Rotational kinetic energy L.omega/2.
inline double rotational_energy(const Vec3 &angular_momentum, const Vec3 &axis,
                                double inertia_axial, double inertia_transverse)
{
  return 0.5 * dot(angular_momentum,
                   angular_velocity(angular_momentum, axis, inertia_axial, inertia_transverse));
}

}  // namespace spherocylinder
