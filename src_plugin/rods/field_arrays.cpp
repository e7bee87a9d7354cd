// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/field_arrays.h"

#include <algorithm>
#include <string>

#include "memory.h"

using namespace LAMMPS_NS;

namespace {

template <typename T>
void grow_array(Memory &memory, T *&array, int rows, int, const char *name)
{
  memory.grow(array, rows, name);
}
void grow_array(Memory &memory, double **&array, int rows, int width, const char *name)
{
  memory.grow(array, rows, width, name);
}

int copies(const RodField &field, int threads) { return field.travel & kReverse ? threads : 1; }

}  // namespace

void LAMMPS_NS::grow_rod_fields(Atom &atom, Memory &memory, int rods, int threads)
{
  for (const RodField &field : rod_fields()) {
    const int rows = rods * copies(field, threads);
    const std::string name = std::string("atom:") + field.name;
    std::visit(
        [&](auto array) { grow_array(memory, atom.*array, rows, field.width, name.c_str()); },
        field.array);
  }
}

void LAMMPS_NS::copy_rod_fields(Atom &atom, int i, int j)
{
  for_each_field(atom, ~kReverse, [&](auto *rows, const RodField &field) {
    std::copy_n(rows + static_cast<size_t>(field.width) * i, field.width,
                rows + static_cast<size_t>(field.width) * j);
  });
}

bigint LAMMPS_NS::rod_field_bytes(Atom &atom, int rods, int threads)
{
  bigint bytes = 0;
  for (const RodField &field : rod_fields()) {
    if (!atom.memcheck(field.name)) continue;
    const bigint values = static_cast<bigint>(rods) * field.width * copies(field, threads);
    const bool is_whole_number = std::holds_alternative<RodField::WholeNumbers>(field.array);
    bytes += values * (is_whole_number ? sizeof(int) : sizeof(double));
  }
  return bytes;
}
