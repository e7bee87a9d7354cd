// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/batch.h"

namespace spherocylinder {

namespace {

template <typename Does>
SPHEROCYLINDER_INLINE bool any(int count, Does does)
{
  std::int64_t found = 0;
  for (int k = 0; k < count; k++) found |= does(k) ? 1 : 0;
  return found != 0;
}

}  // namespace

SPHEROCYLINDER_VECTOR bool any_above(const double *values, double limit, int count)
{
  return any(
      count, [=](int k) __attribute__((always_inline)) { return values[k] > limit; });
}

SPHEROCYLINDER_VECTOR bool any_differs(const std::int64_t *values, std::int64_t from, int count)
{
  return any(
      count, [=](int k) __attribute__((always_inline)) { return values[k] != from; });
}

SPHEROCYLINDER_VECTOR bool any_differs(const std::int64_t *values, const std::int64_t *others,
                                       int count)
{
  return any(
      count, [=](int k) __attribute__((always_inline)) { return values[k] != others[k]; });
}

}  // namespace spherocylinder
