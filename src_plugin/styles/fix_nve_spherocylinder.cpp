// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_nve_spherocylinder.h"

#include "atom.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "rod_checks.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

FixNVESpherocylinder::FixNVESpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixNVE(lmp, narg, arg)
{
  if (narg > 3)
    rod_error_all(lmp, "Illegal fix %s command (id %s): unexpected argument %s", style, id, arg[3]);
  rods_of(lmp, "Fix nve/spherocylinder");
  time_integrate = 1;
}

// Input, restarts and `set` give omega; the angular momentum follows from it.
void FixNVESpherocylinder::setup(int)
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
    sc::store(sc::angular_momentum(sc::load(atom->omega[i]), axis, atom->inertia[i][2],
                                   atom->inertia[i][0]),
              atom->angmom[i]);
  }
}

void FixNVESpherocylinder::initial_integrate(int)
{
  const int *mask = atom->mask;
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;

  for (int i = 0; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    double *v = atom->v[i], *x = atom->x[i], *quaternion = atom->quaternion[i];
    const double *f = atom->f[i], *inertia = atom->inertia[i];
    const double dtfm = dtf / atom->rmass[i];
    for (int d = 0; d < 3; d++) {
      v[d] += dtfm * f[d];
      x[d] += dtv * v[d];
    }

    const sc::Vec3 angmom = sc::load(atom->angmom[i]) + dtf * sc::load(atom->torque[i]);
    const sc::Quaternion turned =
        sc::rotate_freely(sc::load_quaternion(quaternion), angmom, inertia[2], inertia[0], dtv);
    sc::store(turned, quaternion);
    sc::store(angmom, atom->angmom[i]);
    // The forces of this step see the half-step velocities, as with LIGGGHTS's other integrators.
    sc::store(sc::angular_velocity(angmom, sc::axis_of(turned), inertia[2], inertia[0]),
              atom->omega[i]);
  }
}

void FixNVESpherocylinder::final_integrate()
{
  const int *mask = atom->mask;
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;

  for (int i = 0; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    double *v = atom->v[i];
    const double *f = atom->f[i], *inertia = atom->inertia[i];
    const double dtfm = dtf / atom->rmass[i];
    for (int d = 0; d < 3; d++) v[d] += dtfm * f[d];

    const sc::Vec3 angmom = sc::load(atom->angmom[i]) + dtf * sc::load(atom->torque[i]);
    sc::store(angmom, atom->angmom[i]);
    sc::store(sc::angular_velocity(angmom, sc::axis_of(sc::load_quaternion(atom->quaternion[i])),
                                   inertia[2], inertia[0]),
              atom->omega[i]);
  }
}
