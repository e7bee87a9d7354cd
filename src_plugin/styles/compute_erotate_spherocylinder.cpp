// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/compute_erotate_spherocylinder.h"

#include "atom.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "force.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

ComputeErotateSpherocylinder::ComputeErotateSpherocylinder(LAMMPS *lmp, int &iarg, int narg,
                                                           char **arg)
    : Compute(lmp, iarg, narg, arg)
{
  if (narg != iarg)
    rod_error_all(lmp, "Compute %s (id %s): unexpected argument %s", style, id, arg[iarg]);
  rods_of(lmp, "Compute erotate/spherocylinder");
  scalar_flag = 1;
  extscalar = 1;
}

void ComputeErotateSpherocylinder::init() {}

double ComputeErotateSpherocylinder::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  double local = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    // From omega, which input may have set since angmom was last worked out.
    const sc::Vec3 omega = sc::load(atom->omega[i]);
    const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
    local += 0.5 * sc::dot(omega, sc::angular_momentum(omega, axis, atom->inertia[i][2],
                                                       atom->inertia[i][0]));
  }
  MPI_Allreduce(&local, &scalar, 1, MPI_DOUBLE, MPI_SUM, world);
  scalar *= force->mvv2e;
  return scalar;
}
