// SPDX-License-Identifier: GPL-2.0-or-later
// The simple integration of a rotation that much DEM code uses, to compare rotate_freely with: half
// step leap-frog of the angular velocity in the body frame, Euler's equations taken explicitly, and an
// Euler step of the quaternion, normalised. Not to be used: a rod without torque gains energy.
#pragma once

#include "core/rotation.h"

namespace spherocylinder {

// A space-frame vector in the frame of a body of orientation q; `rotated` is the way back.
inline Vec3 in_body_frame(const Vec3 &a, const Quaternion &q)
{
  return rotated(a, {q.w, -q.x, -q.y, -q.z});
}

// omega + dt I^-1 (T - omega x I omega), all of it as it was before the kick. Body frame.
//
// Without torque the part across the axis should turn about it by x = (1 - I_a/I_t) omega_z dt. It
// goes straight on instead: turns by atan x and grows by sqrt(1 + x^2).
inline Vec3 kicked_plainly(const Vec3 &omega_body, const Vec3 &torque_body, double inertia_axial,
                           double inertia_transverse, double dt)
{
  const double turning = (1.0 - inertia_axial / inertia_transverse) * omega_body.z;
  const Vec3 rate = {torque_body.x / inertia_transverse + turning * omega_body.y,
                     torque_body.y / inertia_transverse - turning * omega_body.x,
                     torque_body.z / inertia_axial};
  return omega_body + dt * rate;
}

// q + (dt/2) q (0, omega_body), normalised: turned by 2 atan(|omega| dt/2) instead of |omega| dt.
inline Quaternion turned_plainly(const Quaternion &q, const Vec3 &omega_body, double dt)
{
  const Vec3 half = 0.5 * dt * omega_body;
  return normalized(q * Quaternion{1.0, half.x, half.y, half.z});
}

}  // namespace spherocylinder
