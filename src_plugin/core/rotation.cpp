// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/free_rotation.h"

namespace spherocylinder {

namespace {

CosineAndSinc cosine_and_sinc(double x_squared)
{
  if (x_squared < kSeriesReaches) return cosine_and_sinc_by_series(x_squared);
  const double x = std::sqrt(x_squared);
  return {std::cos(x), std::sin(x) / x};
}

// A product of unit quaternions is off by rounding only.
Quaternion renormalized(const Quaternion &q)
{
  const double squared = norm_squared(q);
  return std::fabs(squared - 1.0) > kNearlyUnit ? normalized(q) : nearly_unit(q, squared);
}

}  // namespace

Quaternion normalized(const Quaternion &q)
{
  const double scale = 1.0 / std::sqrt(norm_squared(q));
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
  const HalfAngles half =
      half_angles(q, angular_momentum, 1.0 / inertia_axial, 1.0 / inertia_transverse, dt);
  return renormalized(turned(q, half, cosine_and_sinc(norm_squared(half.precession)),
                             cosine_and_sinc(half.spin * half.spin)));
}

}  // namespace spherocylinder
