// SPDX-License-Identifier: GPL-2.0-or-later
#include "largest_magnitude.h"

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

// The four quarters side by side: a single maximum would wait for itself from one value to the next.
SPHEROCYLINDER_VECTOR double largest_magnitude(const double *values, int count)
{
  const int quarter = count / 4;
  double first = 0.0, second = 0.0, third = 0.0, fourth = 0.0;
  for (int k = 0; k < quarter; k++) {
    first = larger(first, values[k]);
    second = larger(second, values[quarter + k]);
    third = larger(third, values[2 * quarter + k]);
    fourth = larger(fourth, values[3 * quarter + k]);
  }
  for (int k = 4 * quarter; k < count; k++) first = larger(first, values[k]);
  return larger(larger(first, second), larger(third, fourth));
}

}  // namespace spherocylinder
