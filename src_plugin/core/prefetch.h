// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

#include "core/vec3.h"

namespace spherocylinder {

constexpr std::size_t kCacheLine = 64;  // bytes

// Asks for an object that is read soon, in no order of memory: where another core has written it last, that
// takes as long as a dozen contacts' arithmetic.
template <typename Object>
SPHEROCYLINDER_INLINE void fetch_early(const Object &object)
{
#ifdef __GNUC__
  const char *bytes = reinterpret_cast<const char *>(&object);
  for (std::size_t at = 0; at < sizeof(Object); at += kCacheLine) __builtin_prefetch(bytes + at);
#endif
}

// A number of a row that is written soon.
SPHEROCYLINDER_INLINE void fetch_early_to_write(const double *number)
{
#ifdef __GNUC__
  __builtin_prefetch(number, 1);
#endif
}

}  // namespace spherocylinder
