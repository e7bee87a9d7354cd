// SPDX-License-Identifier: GPL-2.0-or-later
#include "closest_points_reference.h"

#include <cmath>

using spherocylinder::Segment;
using spherocylinder::Vec3;

namespace {

template <class Real>
struct WideVec {
  Real x, y, z;
};

template <class Real>
Real dot(const WideVec<Real> &a, const WideVec<Real> &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
WideVec<Real> widened(const Vec3 &a)
{
  return {Real(a.x), Real(a.y), Real(a.z)};
}

template <class Real>
WideVec<Real> difference(const Vec3 &a, const Vec3 &b)
{
  return {Real(a.x) - Real(b.x), Real(a.y) - Real(b.y), Real(a.z) - Real(b.z)};
}

template <class Real>
Real clamped(Real value, Real limit)
{
  return value > limit ? limit : value < -limit ? -limit : value;
}

// f(s, t) = |w + s u - t v|^2. Its gradient comes from the dot products; its value does not,
// because there the digits of a small distance would cancel.
struct DistanceSquared {
  WideVec<Wide> w, u, v;
  Wide wu, wv, uu, uv, vv;

  DistanceSquared(const Segment &i, const Segment &j)
      : w(difference<Wide>(i.centre, j.centre)),
        u(widened<Wide>(i.axis)),
        v(widened<Wide>(j.axis)),
        wu(dot(w, u)),
        wv(dot(w, v)),
        uu(dot(u, u)),
        uv(dot(u, v)),
        vv(dot(v, v))
  {
  }

  Wide at(Wide s, Wide t) const
  {
    const WideVec<Wide> delta{w.x + s * u.x - t * v.x, w.y + s * u.y - t * v.y,
                              w.z + s * u.z - t * v.z};
    return dot(delta, delta);
  }
  // Where df/dt = 0 for given s, and df/ds = 0 for given t.
  Wide best_t(Wide s) const { return (wv + s * uv) / vv; }
  Wide best_s(Wide t) const { return (t * uv - wu) / uu; }
};

}  // namespace

long double distance_by_faces(const Segment &i, const Segment &j)
{
  const DistanceSquared f(i, j);
  const Wide hi = i.half_length, hj = j.half_length;

  // Edges; the clamp adds the corners.
  Wide least = f.at(-hi, clamped(f.best_t(-hi), hj));
  const auto keep_least = [&least](Wide value) {
    if (value < least) least = value;
  };
  keep_least(f.at(hi, clamped(f.best_t(hi), hj)));
  keep_least(f.at(clamped(f.best_s(-hj), hi), -hj));
  keep_least(f.at(clamped(f.best_s(hj), hi), hj));

  // Inside: grad f = 0, one unknown by Cramer's rule, the other from its own line.
  const Wide determinant = f.uu * f.vv - f.uv * f.uv;
  if (determinant > 0) {
    const Wide s = (f.uv * f.wv - f.vv * f.wu) / determinant;
    const Wide t = f.best_t(s);
    if (s > -hi && s < hi && t > -hj && t < hj) keep_least(f.at(s, t));
  }
  return std::sqrt(static_cast<long double>(least));
}

long double distance_by_search(const Segment &i, const Segment &j)
{
  using Long = long double;
  const WideVec<Long> w = difference<Long>(i.centre, j.centre);
  const WideVec<Long> u = widened<Long>(i.axis), v = widened<Long>(j.axis);
  const Long hj = j.half_length;

  const auto distance_squared_at = [&](Long s) {
    const WideVec<Long> from_j{w.x + s * u.x, w.y + s * u.y, w.z + s * u.z};
    const Long t = clamped(dot(from_j, v) / dot(v, v), hj);
    const WideVec<Long> delta{from_j.x - t * v.x, from_j.y - t * v.y, from_j.z - t * v.z};
    return dot(delta, delta);
  };

  Long low = -static_cast<Long>(i.half_length), high = i.half_length;
  // (2/3)^160 = 7e-29: below the last digit of the interval.
  for (int step = 0; step < 160; step++) {
    const Long third = (high - low) / 3;
    if (distance_squared_at(low + third) < distance_squared_at(high - third))
      high -= third;
    else
      low += third;
  }
  return std::sqrt(distance_squared_at((low + high) / 2));
}
