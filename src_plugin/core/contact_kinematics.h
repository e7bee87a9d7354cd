// SPDX-License-Identifier: GPL-2.0-or-later
// What a point of a rod does: its velocity, and the inertia it shows to a push.
#pragma once

#include "capsule.h"

namespace spherocylinder {

// Velocity of the rod's material point at centre + arm (m/s, space frame).
inline Vec3 velocity_at(const Vec3 &velocity, const Vec3 &omega, const Vec3 &arm)
{
  return velocity + cross(omega, arm);
}

// 1/m + (a x n)^T I^-1 (a x n), in 1/kg: the acceleration of the point at `arm` along the unit
// vector `normal` per unit force along it. For a point on the axis a x n is at right angles to the
// axis, so that only the transverse inertia takes part. The effective mass of a contact is the
// inverse of the sum over its two bodies; a wall adds nothing.
inline double inverse_effective_mass(double mass, double inertia_transverse,
                                     const Vec3 &arm_on_axis, const Vec3 &normal)
{
  return 1.0 / mass + norm_squared(cross(arm_on_axis, normal)) / inertia_transverse;
}

}  // namespace spherocylinder
