// SPDX-License-Identifier: GPL-2.0-or-later
#include "rotation.h"

namespace spherocylinder {

namespace {

struct CosineAndSinc {
  double cosine, sinc;  // of an angle x: cos x and sin(x)/x
};

// By Taylor's series where its next term, x^10/10!, is below 3e-17; it needs no root of x^2.
CosineAndSinc cosine_and_sinc(double x_squared)
{
  constexpr double kSeries = 0.01;
  const double y = x_squared;
  if (y < kSeries)
    return {1.0 - y / 2.0 * (1.0 - y / 12.0 * (1.0 - y / 30.0 * (1.0 - y / 56.0))),
            1.0 - y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0 * (1.0 - y / 72.0)))};
  const double x = std::sqrt(y);
  return {std::cos(x), std::sin(x) / x};
}

// A product of unit quaternions is off by rounding only: one step of Newton's method for 1/sqrt.
Quaternion renormalized(const Quaternion &q)
{
  const double squared = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  if (std::fabs(squared - 1.0) > 1e-8) return normalized(q);
  const double scale = 1.5 - 0.5 * squared;
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}

}  // namespace

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
  // Half the angle of the precession is |L| half_step / I_t, that of the spin has a sign.
  const double half_step = 0.5 * dt, by_transverse = half_step / inertia_transverse;
  const CosineAndSinc turn =
      cosine_and_sinc(norm_squared(angular_momentum) * by_transverse * by_transverse);
  const Vec3 vector = (by_transverse * turn.sinc) * angular_momentum;
  const Quaternion precession = {turn.cosine, vector.x, vector.y, vector.z};

  const double half_spin =
      dot(angular_momentum, axis_of(q)) * (half_step / inertia_axial - by_transverse);
  const CosineAndSinc own = cosine_and_sinc(half_spin * half_spin);
  const Quaternion spin = {own.cosine, 0.0, 0.0, half_spin * own.sinc};
  return renormalized(precession * q * spin);
}

}  // namespace spherocylinder
