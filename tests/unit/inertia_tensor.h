// SPDX-License-Identifier: GPL-2.0-or-later
// The whole 3 x 3 inertia tensor of a rod in long double: the slow way to effective masses.
#pragma once

#include <array>

#include "core/mass_properties.h"

using Matrix = std::array<std::array<long double, 3>, 3>;

// I_t (1 - u u^T) + I_a u u^T.
inline Matrix inertia_tensor(const spherocylinder::Vec3 &axis,
                             const spherocylinder::MassProperties &p)
{
  const long double u[] = {axis.x, axis.y, axis.z};
  Matrix tensor;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++)
      tensor[a][b] =
          p.inertia_transverse * (a == b) + (p.inertia_axial - p.inertia_transverse) * u[a] * u[b];
  return tensor;
}

// Adjugate over determinant.
inline Matrix inverse(const Matrix &m)
{
  const auto minor = [&m](int a, int b) {
    const int a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
    return m[a1][b1] * m[a2][b2] - m[a1][b2] * m[a2][b1];
  };
  const long double determinant =
      m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix result;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) result[b][a] = minor(a, b) / determinant;
  return result;
}

// x^T M x, of a vector in double or long double.
template <typename Vector>
long double contracted(const Matrix &m, const Vector &vector)
{
  const long double x[] = {vector.x, vector.y, vector.z};
  long double sum = 0.0L;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) sum += x[a] * m[a][b] * x[b];
  return sum;
}
