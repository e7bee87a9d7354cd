// SPDX-License-Identifier: GPL-2.0-or-later
// Three-component vectors for the rod geometry. Plain values, no allocation, no frame of their own.
#pragma once

#include <cmath>

// Inlined wherever they stand, also in functions compiled once per kind of processor (batch.h).
#if defined(__GNUC__)
#define SPHEROCYLINDER_INLINE inline __attribute__((always_inline))
#else
#define SPHEROCYLINDER_INLINE inline
#endif

namespace spherocylinder {

struct Vec3 {
  double x, y, z;
};
constexpr Vec3 kZero = {0.0, 0.0, 0.0};

SPHEROCYLINDER_INLINE Vec3 operator+(const Vec3 &a, const Vec3 &b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

SPHEROCYLINDER_INLINE Vec3 operator-(const Vec3 &a, const Vec3 &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

SPHEROCYLINDER_INLINE Vec3 operator-(const Vec3 &a) { return {-a.x, -a.y, -a.z}; }
SPHEROCYLINDER_INLINE Vec3 operator*(double s, const Vec3 &a)
{
  return {s * a.x, s * a.y, s * a.z};
}

SPHEROCYLINDER_INLINE double dot(const Vec3 &a, const Vec3 &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

SPHEROCYLINDER_INLINE Vec3 cross(const Vec3 &a, const Vec3 &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

SPHEROCYLINDER_INLINE double norm_squared(const Vec3 &a) { return dot(a, a); }
SPHEROCYLINDER_INLINE double norm(const Vec3 &a) { return std::sqrt(dot(a, a)); }

// A LIGGGHTS per-atom row (x[i], v[i], ...) as a vector.
SPHEROCYLINDER_INLINE Vec3 load(const double *row) { return {row[0], row[1], row[2]}; }

SPHEROCYLINDER_INLINE void store(const Vec3 &a, double *row)
{
  row[0] = a.x;
  row[1] = a.y;
  row[2] = a.z;
}

SPHEROCYLINDER_INLINE void add_to(double *row, const Vec3 &a)
{
  row[0] += a.x;
  row[1] += a.y;
  row[2] += a.z;
}

}  // namespace spherocylinder
