// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/packing_theory.h"

#include <cmath>

#include "analysis/numbers.h"

namespace spherocylinder {

double parkhouse_kelly_fraction(double aspect_ratio)
{
  return 2.0 * std::log(aspect_ratio) / aspect_ratio;
}

double random_contact_fraction(double aspect_ratio, double mean_sin_gamma, double half_contacts)
{
  const double x = aspect_ratio - 1.0;
  const double rod = x / 4.0 + 1.0 / 6.0;
  const double excluded = (2.0 * mean_sin_gamma / pi) * x * x + 2.0 * x + 4.0 / 3.0;
  return 2.0 * half_contacts * rod / excluded;
}

}  // namespace spherocylinder
