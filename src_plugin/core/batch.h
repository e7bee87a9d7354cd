// SPDX-License-Identifier: GPL-2.0-or-later
// Loops over many pairs at once, written as plain loops over arrays that the compiler turns into
// vector instructions: eight pairs at a time where the processor has AVX-512, four where it has AVX2,
// chosen when the library is loaded, two on any x86-64.
#pragma once

#include <cstdint>

#include "core/vec3.h"

// Fused multiply-adds stay off, so that every processor gives the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__)
#define SPHEROCYLINDER_VECTOR __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define SPHEROCYLINDER_VECTOR
#endif

namespace spherocylinder {

// Pairs a batch. Its arrays (some 60 doubles a pair) stay in the first-level cache.
constexpr int kBatch = 32;

using Doubles = double[kBatch];

// One vector a pair.
struct Vec3s {
  Doubles x, y, z;

  SPHEROCYLINDER_INLINE Vec3 get(int k) const { return {x[k], y[k], z[k]}; }
  SPHEROCYLINDER_INLINE void set(int k, const Vec3 &a)
  {
    x[k] = a.x;
    y[k] = a.y;
    z[k] = a.z;
  }
};

// Whether any of the first `count` does: so that what is rare costs no branch a pair.
bool any_above(const double *values, double limit, int count);
bool any_differs(const std::int64_t *values, std::int64_t from, int count);
bool any_differs(const std::int64_t *values, const std::int64_t *others, int count);

}  // namespace spherocylinder
