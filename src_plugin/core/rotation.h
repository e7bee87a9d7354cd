// SPDX-License-Identifier: GPL-2.0-or-later
// Orientation of a rod and its exact torque-free rotation.
#pragma once

#include "core/vec3.h"

namespace spherocylinder {

// Unit quaternion (w, x, y, z) that turns the body frame into the space frame; the rod's axis is
// body z. Same component order as LIGGGHTS's atom->quaternion.
struct Quaternion {
  double w, x, y, z;
};

SPHEROCYLINDER_INLINE Quaternion operator*(const Quaternion &a, const Quaternion &b)
{
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quaternion normalized(const Quaternion &q);

// Rotation by `angle` (rad) about the unit vector `direction`.
Quaternion rotation_about(const Vec3 &direction, double angle);

// The rod's axis in the space frame: body z turned by q.
SPHEROCYLINDER_INLINE Vec3 axis_of(const Quaternion &q)
{
  return {2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x),
          q.w * q.w - q.x * q.x - q.y * q.y + q.z * q.z};
}

// A vector turned by q.
SPHEROCYLINDER_INLINE Vec3 rotated(const Vec3 &a, const Quaternion &q)
{
  const Vec3 v = {q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(v, a);
  return a + q.w * t + cross(v, t);
}

// Shortest rotation that takes body z to the unit vector `axis` (half a turn about x for -z).
Quaternion orientation_of(const Vec3 &axis);

// A homogeneous rod's orientation after the time dt with no torque: exact for any dt.
//
// A symmetric top's angular momentum L stays fixed in space. Its axis precesses about L at the
// constant rate |L| / I_t while the body spins about its own axis, relative to that precession,
// at L.u (1/I_a - 1/I_t) (Landau & Lifshitz, Mechanics, section 33).
Quaternion rotate_freely(const Quaternion &q, const Vec3 &angular_momentum, double inertia_axial,
                         double inertia_transverse, double dt);

inline Quaternion load_quaternion(const double *row) { return {row[0], row[1], row[2], row[3]}; }

inline void store(const Quaternion &q, double *row)
{
  row[0] = q.w;
  row[1] = q.x;
  row[2] = q.y;
  row[3] = q.z;
}

}  // namespace spherocylinder
