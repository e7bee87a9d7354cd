// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers that stand in a row for each rod, turned into one array a number: four rods at a time, in vector
// registers. In place of a load and a store a number.
#pragma once

#include <cstring>

#include "core/vec3.h"

namespace spherocylinder {

typedef double Four __attribute__((vector_size(4 * sizeof(double))));
constexpr int kFour = 4;

// Of four rods, where numbers of theirs begin.
using FourRows = const double *[kFour];

// columns[c] := numbers c of the rows, each of which has four from `offset` on.
SPHEROCYLINDER_INLINE void load_columns(const FourRows &rows, int offset, Four (&columns)[kFour])
{
  Four a, b, c, d;
  std::memcpy(&a, rows[0] + offset, sizeof a);
  std::memcpy(&b, rows[1] + offset, sizeof b);
  std::memcpy(&c, rows[2] + offset, sizeof c);
  std::memcpy(&d, rows[3] + offset, sizeof d);
  const Four ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Four ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Four cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  columns[0] = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  columns[1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  columns[2] = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  columns[3] = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

SPHEROCYLINDER_INLINE void load_column(const FourRows &rows, int offset, Four &column)
{
  column = Four{rows[0][offset], rows[1][offset], rows[2][offset], rows[3][offset]};
}

SPHEROCYLINDER_INLINE void store_column(const Four &column, double *lanes)
{
  std::memcpy(lanes, &column, sizeof column);
}

}  // namespace spherocylinder
