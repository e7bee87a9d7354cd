// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/velocity_of_rods.h"

#include <cstring>

#include "atom.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "host/rod_error.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

void VelocityOfRods::command(int narg, char **arg)
{
  const bool gives_angmom = narg >= 2 && strcmp(arg[1], "setAngular") == 0;
  if (gives_angmom) {
    check_rods_have_inertia();
    match_angular_momentum();  // to which keyword sum adds
  }
  Velocity::command(narg, arg);
  if (gives_angmom)
    match_omega();
  else
    match_angular_momentum();
}

// Of create_atoms they have none before `set` gives them a size.
void VelocityOfRods::check_rods_have_inertia()
{
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->inertia[i][0] == 0.0)
      rod_error_one(lmp,
                    "Command velocity: setAngular wants the size of rod %d first, by set ... "
                    "diameter D length L density RHO",
                    atom->tag[i]);
}

// `set` and data files may have changed omega since.
void VelocityOfRods::match_angular_momentum()
{
  for (int i = 0; i < atom->nlocal; i++) {
    const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
    sc::store(sc::angular_momentum(sc::load(atom->omega[i]), axis, atom->inertia[i][2],
                                   atom->inertia[i][0]),
              atom->angmom[i]);
  }
}

void VelocityOfRods::match_omega()
{
  for (int i = 0; i < atom->nlocal; i++) {
    const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
    sc::store(sc::angular_velocity(sc::load(atom->angmom[i]), axis, atom->inertia[i][2],
                                   atom->inertia[i][0]),
              atom->omega[i]);
  }
}
