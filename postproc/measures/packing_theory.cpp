// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/packing_theory.h"

#include <cmath>

#include "core/numbers.h"

namespace spherocylinder {

namespace {

// Of rods that are as long as this or, by the rounding of a dump, a little shorter.
bool is_at_least(double aspect_ratio, double from)
{
  constexpr double kRounding = 1e-4;
  return aspect_ratio >= (1.0 - kRounding) * from;
}

}  // namespace

double densest_fraction(double aspect_ratio)
{
  const double x = aspect_ratio - 1.0;
  return pi / std::sqrt(12.0) * (x + 2.0 / 3.0) / (x + std::sqrt(2.0 / 3.0));
}

double parkhouse_kelly_fraction(double aspect_ratio)
{
  if (!is_at_least(aspect_ratio, kParkhouseKellyFrom)) return none;
  return 2.0 * std::log(aspect_ratio) / aspect_ratio;
}

double random_contact_fraction(double aspect_ratio, double mean_sin_gamma, double half_contacts)
{
  if (!is_at_least(aspect_ratio, kRandomContactsFrom)) return none;
  const double x = aspect_ratio - 1.0;
  const double rod = x / 4.0 + 1.0 / 6.0;
  const double excluded = (2.0 * mean_sin_gamma / pi) * x * x + 2.0 * x + 4.0 / 3.0;
  const double fraction = 2.0 * half_contacts * rod / excluded;
  return fraction <= densest_fraction(aspect_ratio) ? fraction : none;
}

}  // namespace spherocylinder
