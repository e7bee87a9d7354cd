// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_freeze_spherocylinder.h"

#include "atom.h"
#include "core/vec3.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_driver.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

FixFreezeSpherocylinder::FixFreezeSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixFreeze(lmp, narg, arg)
{
  rods_of(lmp, "Fix freeze");
}

void FixFreezeSpherocylinder::init()
{
  FixFreeze::init();
  driven_ = driven_groups(lmp);
  stop_rods();  // before a run's first ghosts get their velocities
}

// Rods that join the group in a run, by insertion, are stopped here.
void FixFreezeSpherocylinder::post_force(int vflag)
{
  FixFreeze::post_force(vflag);
  stop_rods();
}

void FixFreezeSpherocylinder::stop_rods()
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || (atom->mask[i] & driven_)) continue;
    for (double **motion : {atom->v, atom->omega, atom->angmom})
      sc::store(sc::Vec3{0.0, 0.0, 0.0}, motion[i]);
  }
}
