// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/data_lines.h"

#include <cstdlib>

#include "atom.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "host/buffer_values.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

AtomsLine LAMMPS_NS::read_atoms_line(char **values)
{
  const sc::Vec3 axis = {atof(values[8]), atof(values[9]), atof(values[10])};
  return {atoi(values[0]), atoi(values[1]), atof(values[2]),
          atof(values[3]), atof(values[4]), (1.0 / sc::norm(axis)) * axis};
}

void LAMMPS_NS::read_velocities_line(Atom &atom, int i, char **values)
{
  for (int d = 0; d < 3; d++) {
    atom.v[i][d] = atof(values[d]);
    atom.omega[i][d] = atof(values[3 + d]);
  }
  const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom.quaternion[i]));
  sc::store(
      sc::angular_momentum(sc::load(atom.omega[i]), axis, atom.inertia[i][2], atom.inertia[i][0]),
      atom.angmom[i]);
}

void LAMMPS_NS::pack_atoms_line(const Atom &atom, int i, int tag_offset, double *values)
{
  values[0] = as_sent(atom.tag[i] + tag_offset);
  values[1] = as_sent(atom.type[i]);
  values[2] = 2.0 * atom.shape[i][0];
  values[3] = 2.0 * atom.radius[i];
  values[4] = atom.density[i];
  sc::store(sc::load(atom.x[i]), &values[5]);
  sc::store(sc::axis_of(sc::load_quaternion(atom.quaternion[i])), &values[8]);
  values[11] = as_sent((atom.image[i] & IMGMASK) - IMGMAX);
  values[12] = as_sent((atom.image[i] >> IMGBITS & IMGMASK) - IMGMAX);
  values[13] = as_sent((atom.image[i] >> IMG2BITS) - IMGMAX);
}

void LAMMPS_NS::write_atoms_line(FILE *file, const double *values)
{
  fprintf(file, "%d %d", whole_number(values[0]), whole_number(values[1]));
  for (int k = 2; k < 11; k++) fprintf(file, " %-1.16e", values[k]);
  fprintf(file, " %d %d %d\n", whole_number(values[11]), whole_number(values[12]),
          whole_number(values[13]));
}

void LAMMPS_NS::pack_velocities_line(const Atom &atom, int i, int tag_offset, double *values)
{
  values[0] = as_sent(atom.tag[i] + tag_offset);
  sc::store(sc::load(atom.v[i]), &values[1]);
  sc::store(sc::load(atom.omega[i]), &values[4]);
}

void LAMMPS_NS::write_velocities_line(FILE *file, const double *values)
{
  fprintf(file, "%d", whole_number(values[0]));
  for (int k = 1; k < 7; k++) fprintf(file, " %-1.16e", values[k]);
  fprintf(file, "\n");
}
