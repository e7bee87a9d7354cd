// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/largest_shift.h"

#include <cmath>

#include "core/batch.h"

namespace spherocylinder {

namespace {

SPHEROCYLINDER_INLINE double larger(double largest, double a, double b)
{
  const double difference = std::fabs(a - b);
  return difference > largest ? difference : largest;
}

SPHEROCYLINDER_INLINE double of_positions(const double *a, const double *b, int count)
{
  double x = 0.0, y = 0.0, z = 0.0;
  for (int k = 0; k < count; k++) {
    x = larger(x, a[3 * k], b[3 * k]);
    y = larger(y, a[3 * k + 1], b[3 * k + 1]);
    z = larger(z, a[3 * k + 2], b[3 * k + 2]);
  }
  return std::sqrt(x * x + y * y + z * z);
}

SPHEROCYLINDER_INLINE double of_quaternions(const double *a, const double *b, int count)
{
  double w = 0.0, x = 0.0, y = 0.0, z = 0.0;
  for (int k = 0; k < count; k++) {
    w = larger(w, a[4 * k], b[4 * k]);
    x = larger(x, a[4 * k + 1], b[4 * k + 1]);
    y = larger(y, a[4 * k + 2], b[4 * k + 2]);
    z = larger(z, a[4 * k + 3], b[4 * k + 3]);
  }
  return std::sqrt(w * w + x * x + y * y + z * z);
}

}  // namespace

SPHEROCYLINDER_VECTOR LargestShift largest_shift(const double *positions,
                                                 const double *positions_before,
                                                 const double *quaternions,
                                                 const double *quaternions_before, int count)
{
  return {of_positions(positions, positions_before, count),
          2.0 * of_quaternions(quaternions, quaternions_before, count)};
}

}  // namespace spherocylinder
