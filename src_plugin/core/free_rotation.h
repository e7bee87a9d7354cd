// SPDX-License-Identifier: GPL-2.0-or-later
// The pieces of rotate_freely, for one rod and for a batch alike.
#pragma once

#include "core/rotation.h"

namespace spherocylinder {

struct CosineAndSinc {
  double cosine, sinc;  // of an angle x: cos x and sin(x)/x
};

// Below this x^2 Taylor's series suffices: its next term, x^10/10!, is below 3e-17.
constexpr double kSeriesReaches = 0.01;

// One term of Horner's scheme and all that follow it.
SPHEROCYLINDER_INLINE double from_term(double divisor, double y, double rest)
{
  return 1.0 - (1.0 / divisor) * y * rest;
}

// Needs no root of x^2.
SPHEROCYLINDER_INLINE CosineAndSinc cosine_and_sinc_by_series(double x_squared)
{
  const double y = x_squared;
  return {from_term(2.0, y, from_term(12.0, y, from_term(30.0, y, from_term(56.0, y, 1.0)))),
          from_term(6.0, y, from_term(20.0, y, from_term(42.0, y, from_term(72.0, y, 1.0))))};
}

SPHEROCYLINDER_INLINE double norm_squared(const Quaternion &q)
{
  return q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
}

// Of a quaternion whose square is 1 but for this, one step of Newton's method for 1/sqrt makes a
// unit one to the last bit.
constexpr double kNearlyUnit = 1e-8;

SPHEROCYLINDER_INLINE Quaternion nearly_unit(const Quaternion &q, double squared)
{
  const double scale = 1.5 - 0.5 * squared;
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}

// Half the angles of one step: of the precession as a vector along L (space frame), of the spin
// about body z with a sign.
struct HalfAngles {
  Vec3 precession;
  double spin;
};

SPHEROCYLINDER_INLINE HalfAngles half_angles(const Quaternion &q, const Vec3 &angular_momentum,
                                             double inverse_axial, double inverse_transverse,
                                             double dt)
{
  const double by_axial = 0.5 * dt * inverse_axial, by_transverse = 0.5 * dt * inverse_transverse;
  return {by_transverse * angular_momentum,
          dot(angular_momentum, axis_of(q)) * (by_axial - by_transverse)};
}

// q between the precession, in the space frame, and the spin, in the body's.
SPHEROCYLINDER_INLINE Quaternion turned(const Quaternion &q, const HalfAngles &half,
                                        const CosineAndSinc &precession, const CosineAndSinc &spin)
{
  const double c = spin.cosine, s = half.spin * spin.sinc;
  const Quaternion spun = {c * q.w - s * q.z, c * q.x + s * q.y, c * q.y - s * q.x,
                           c * q.z + s * q.w};
  const Vec3 vector = precession.sinc * half.precession;
  return Quaternion{precession.cosine, vector.x, vector.y, vector.z} * spun;
}

}  // namespace spherocylinder
