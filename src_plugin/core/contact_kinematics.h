// SPDX-License-Identifier: GPL-2.0-or-later
// What a point of a rod does: its velocity, and the inertia it shows to a push.
#pragma once

#include "core/capsule.h"

namespace spherocylinder {

// Velocity of the rod's material point at centre + arm (m/s, space frame).
SPHEROCYLINDER_INLINE Vec3 velocity_at(const Vec3 &velocity, const Vec3 &omega, const Vec3 &arm)
{
  return velocity + cross(omega, arm);
}

// The same half a step ago, for an integrator that hands over velocities of the middle of the step
// with the positions of its end. With the arm of the end, two rods that turn together at W would
// seem to slip at W^2 dt/2 times the distance of their centres across the normal, and a contact at
// rest in the turning frame would load its spring without end.
SPHEROCYLINDER_INLINE Vec3 velocity_half_a_step_ago(const Vec3 &velocity, const Vec3 &omega,
                                                    const Vec3 &arm, double dt)
{
  return velocity_at(velocity, omega, arm - 0.5 * dt * cross(omega, arm));
}

// Reciprocals, worked out once a rod and step and used once a contact.
struct InverseInertia {
  double mass;             // 1/m, 1/kg
  double transverse;       // 1/I_t, 1/(kg m^2)
  bool is_driven = false;  // moved by hand, whatever pushes it
};

// What a rod shows to the other of a contact: a driven one does not give way to one that can move.
// (Two driven rods, or a driven and an immovable one, keep their own masses for the damping.)
inline InverseInertia shown_to(const InverseInertia &other, const InverseInertia &rod)
{
  const bool stands = rod.is_driven && !other.is_driven && other.mass > 0.0;
  return stands ? InverseInertia{0.0, 0.0} : rod;
}

// 1/m + (a x n)^T I^-1 (a x n), in 1/kg: the acceleration of the point at `arm` along the unit
// vector `normal` per unit force along it. For a point on the axis a x n is at right angles to the
// axis, so that only the transverse inertia takes part. The effective mass of a contact is the
// inverse of the sum over its two bodies; a wall adds nothing.
SPHEROCYLINDER_INLINE double inverse_effective_mass(const InverseInertia &inverse,
                                                    const Vec3 &arm_on_axis, const Vec3 &normal)
{
  return inverse.mass + inverse.transverse * norm_squared(cross(arm_on_axis, normal));
}

// What a unit push along n2 at arm2 adds, in 1/kg, to the acceleration along n1 of the point at arm1
// of the same rod: n1.n2/m + (a1 x n1)^T I^-1 (a2 x n2).
inline double mass_coupling(const InverseInertia &inverse, const Vec3 &arm_on_axis1,
                            const Vec3 &normal1, const Vec3 &arm_on_axis2, const Vec3 &normal2)
{
  return inverse.mass * dot(normal1, normal2) +
         inverse.transverse * dot(cross(arm_on_axis1, normal1), cross(arm_on_axis2, normal2));
}

inline double inverse_effective_mass(double mass, double inertia_transverse,
                                     const Vec3 &arm_on_axis, const Vec3 &normal)
{
  return inverse_effective_mass(InverseInertia{1.0 / mass, 1.0 / inertia_transverse}, arm_on_axis,
                                normal);
}

}  // namespace spherocylinder
