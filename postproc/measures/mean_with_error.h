// SPDX-License-Identifier: GPL-2.0-or-later
// Mean of a sample and the standard error of that mean.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/numbers.h"

namespace spherocylinder {

struct MeanWithError {
  double mean;   // NaN for an empty sample
  double error;  // sample deviation / sqrt(n), values taken as independent; NaN for a single value
};

// Of quantity(item) over a range of items.
template <class Items, class Quantity>
MeanWithError mean_of(const Items &items, Quantity quantity)
{
  const double n = static_cast<double>(items.size());
  if (n == 0.0) {
    return {none, none};
  }
  double mean = 0.0;
  for (const auto &item : items) mean += quantity(item) / n;
  double squares = 0.0;
  for (const auto &item : items) squares += (quantity(item) - mean) * (quantity(item) - mean);
  return {mean, n > 1.0 ? std::sqrt(squares / (n * (n - 1.0))) : none};
}

template <class Numbers>
MeanWithError mean_of(const Numbers &values)
{
  return mean_of(values, [](double value) { return value; });
}

// The part that `count` of n make, and its standard error sqrt(p (1 - p)/n) with
// p = (count + 1)/(n + 2) (Laplace), so that neither none nor all claims to be certain.
inline MeanWithError part_of(std::size_t count, std::size_t n)
{
  if (n == 0) {
    return {none, none};
  }
  const double k = static_cast<double>(count), all = static_cast<double>(n);
  const double p = (k + 1.0) / (all + 2.0);
  return {k / all, std::sqrt(p * (1.0 - p) / all)};
}

}  // namespace spherocylinder
