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

// The loop over the rods that both halves of a step share: `move(i)` gives rod i's new angular
// momentum, `finish(count)` ends a batch.
template <typename Move, typename Finish>
void FixNVESpherocylinder::for_each_batch(Move move, Finish finish)
{
  const int *mask = atom->mask;
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  double **inertia = atom->inertia, **quaternion = atom->quaternion, **angmom = atom->angmom;
  int count = 0;
  for (int i = 0; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    move(i);
    const sc::Vec3 momentum = sc::load(angmom[i]) + dtf * sc::load(atom->torque[i]);
    sc::store(momentum, angmom[i]);
    rotations_.set(count, momentum, inertia[i], quaternion[i]);
    rods_[count++] = i;
    if (count < sc::kBatch) continue;
    finish(count);
    count = 0;
  }
  if (count > 0) finish(count);
}

void FixNVESpherocylinder::initial_integrate(int)
{
  double **x = atom->x, **v = atom->v, **f = atom->f;
  const double *mass = atom->rmass;
  for_each_batch(
      [&](int i) {
        const double dtfm = dtf / mass[i];
        for (int d = 0; d < 3; d++) {
          v[i][d] += dtfm * f[i][d];
          x[i][d] += dtv * v[i][d];
        }
      },
      [&](int count) {
        sc::rotate_freely(rotations_, dtv);
        // The forces of this step see the half-step velocities, as with LIGGGHTS's other
        // integrators.
        for (int k = 0; k < count; k++) {
          const int i = rods_[k];
          if (rotations_.uncertain[k] != 0.0) {
            rotate_one(i);
            continue;
          }
          sc::store(rotations_.after(k), atom->quaternion[i]);
          sc::store(rotations_.omega.get(k), atom->omega[i]);
        }
      });
}

void FixNVESpherocylinder::rotate_one(int i)
{
  const double *inertia = atom->inertia[i];
  const sc::Vec3 angmom = sc::load(atom->angmom[i]);
  const sc::Quaternion turned = sc::rotate_freely(sc::load_quaternion(atom->quaternion[i]), angmom,
                                                  inertia[2], inertia[0], dtv);
  sc::store(turned, atom->quaternion[i]);
  sc::store(sc::angular_velocity(angmom, sc::axis_of(turned), inertia[2], inertia[0]),
            atom->omega[i]);
}

void FixNVESpherocylinder::final_integrate()
{
  double **v = atom->v, **f = atom->f;
  const double *mass = atom->rmass;
  for_each_batch(
      [&](int i) {
        const double dtfm = dtf / mass[i];
        for (int d = 0; d < 3; d++) v[i][d] += dtfm * f[i][d];
      },
      [&](int count) {
        sc::angular_velocities(rotations_);
        for (int k = 0; k < count; k++)
          sc::store(rotations_.omega.get(k), atom->omega[rods_[k]]);
      });
}
