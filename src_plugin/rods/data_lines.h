// SPDX-License-Identifier: GPL-2.0-or-later
// A rod's lines in a data file, read_data's and write_data's:
//   Atoms:       id type diameter length density x y z ux uy uz [image flags]   (length in all)
//   Velocities:  id vx vy vz wx wy wz                                           (space frame)
#pragma once

#include <cstdio>

#include "core/vec3.h"

namespace LAMMPS_NS {

class Atom;

constexpr int kAtomsLineValues = 11, kVelocitiesLineValues = 7;
constexpr int kFirstOfPosition = 6;  // the column of x, from 1

struct AtomsLine {
  int id, type;
  double diameter, total_length, density;
  spherocylinder::Vec3 axis;  // of length 1
};

// `values` as ReadDataSpherocylinder has checked them.
AtomsLine read_atoms_line(char **values);
void read_velocities_line(Atom &atom, int i, char **values);

// LIGGGHTS gathers the values of all ranks, then writes.
void pack_atoms_line(const Atom &atom, int i, int tag_offset, double *values);
void write_atoms_line(FILE *file, const double *values);
void pack_velocities_line(const Atom &atom, int i, int tag_offset, double *values);
void write_velocities_line(FILE *file, const double *values);

}  // namespace LAMMPS_NS
