// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's arrays of the rods' fields (rod_fields.h) in memory.
#pragma once

#include <variant>

#include "atom.h"
#include "rods/rod_fields.h"

namespace LAMMPS_NS {

class Memory;

// LIGGGHTS's arrays are in one piece: of ghosts by the thousand, their rows are worked out rather
// than looked up.
template <typename T>
T *first_row(T *array)
{
  return array;
}
inline double *first_row(double **array) { return array ? array[0] : nullptr; }

// Calls `action(rows, field)` for the fields that travel so, in their order.
template <typename Action>
void for_each_field(Atom &atom, unsigned travel, Action action)
{
  for (const RodField &field : rod_fields())
    if (field.travel & travel)
      std::visit([&](auto array) { action(first_row(atom.*array), field); }, field.array);
}

// Room for `rods` of them; for what is added up, once for each thread.
void grow_rod_fields(Atom &atom, Memory &memory, int rods, int threads);

// Rod j becomes what rod i is.
void copy_rod_fields(Atom &atom, int i, int j);

// Of the arrays that LIGGGHTS has not counted yet.
bigint rod_field_bytes(Atom &atom, int rods, int threads);

}  // namespace LAMMPS_NS
