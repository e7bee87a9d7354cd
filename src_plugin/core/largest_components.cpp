// SPDX-License-Identifier: GPL-2.0-or-later
#include "largest_components.h"

#include <cmath>

#include "batch.h"

namespace spherocylinder {

namespace {

SPHEROCYLINDER_INLINE double larger(double largest, double value)
{
  const double magnitude = std::fabs(value);
  return magnitude > largest ? magnitude : largest;
}

}  // namespace

SPHEROCYLINDER_VECTOR Vec3 largest_components(const double *rows, int count)
{
  double x = 0.0, y = 0.0, z = 0.0;
  for (int k = 0; k < count; k++) {
    x = larger(x, rows[3 * k]);
    y = larger(y, rows[3 * k + 1]);
    z = larger(z, rows[3 * k + 2]);
  }
  return {x, y, z};
}

}  // namespace spherocylinder
