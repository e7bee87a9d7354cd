// SPDX-License-Identifier: GPL-2.0-or-later
#include "rotation.h"

namespace spherocylinder {

Quaternion operator*(const Quaternion &a, const Quaternion &b)
{
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
          a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quaternion normalized(const Quaternion &q)
{
  const double scale = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}

Quaternion rotation_about(const Vec3 &direction, double angle)
{
  const double s = std::sin(0.5 * angle);
  return {std::cos(0.5 * angle), s * direction.x, s * direction.y, s * direction.z};
}

Quaternion orientation_of(const Vec3 &axis)
{
  // q = (1 + z.u, z x u) normalized.
  if (axis.z >= 0.0) return normalized({1.0 + axis.z, -axis.y, axis.x, 0.0});

  // 1 + u_z = (u_x^2 + u_y^2) / (1 - u_z) cancels near -z: divide q by |z x u| instead.
  const double sine = std::hypot(axis.x, axis.y);
  if (sine == 0.0) return {0.0, 1.0, 0.0, 0.0};
  return normalized({sine / (1.0 - axis.z), -axis.y / sine, axis.x / sine, 0.0});
}

Quaternion rotate_freely(const Quaternion &q, const Vec3 &angular_momentum, double inertia_axial,
                         double inertia_transverse, double dt)
{
  const double magnitude = norm(angular_momentum);
  if (magnitude == 0.0) return q;
  const double along = dot(angular_momentum, axis_of(q));
  const Quaternion precession =
      rotation_about((1.0 / magnitude) * angular_momentum, magnitude / inertia_transverse * dt);
  const Quaternion spin =
      rotation_about({0.0, 0.0, 1.0}, along * (1.0 / inertia_axial - 1.0 / inertia_transverse) * dt);
  return normalized(precession * q * spin);
}

}  // namespace spherocylinder
