// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_nve_spherocylinder.h"

#include <cstring>

#include "atom.h"
#include "core/mass_properties.h"
#include "core/plain_rotation.h"
#include "core/rotation.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_threads.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

// Of a thread: fewer are moved sooner than others are told.
constexpr int kFewestRods = 100;

}  // namespace

FixNVESpherocylinder::FixNVESpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixNVE(lmp, narg, arg)
{
  for (int k = 3; k < narg; k += 2) {
    if (strcmp(arg[k], "rotation") != 0)
      rod_error_all(lmp, "Fix %s (id %s): unknown keyword %s (expected rotation)", style, id,
                    arg[k]);
    const char *value = k + 1 < narg ? arg[k + 1] : "nothing";
    plain_ = strcmp(value, "plain") == 0;
    if (!plain_ && strcmp(value, "exact") != 0)
      rod_error_all(lmp, "Fix %s (id %s): rotation must be exact or plain (got %s)", style, id,
                    value);
  }
  threads_ = &rods_of(lmp, "Fix nve/spherocylinder").attached<RodThreads>();
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
// momentum, `finish(batch)` ends a batch.
template <typename Move, typename Finish>
void FixNVESpherocylinder::for_each_batch(Move move, Finish finish)
{
  const int *mask = atom->mask;
  const int group = groupbit;
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  double **inertia = atom->inertia, **quaternion = atom->quaternion, **angmom = atom->angmom;
  const double half = dtf, *const *torque = atom->torque;
  // Copies, which no store into the rods' arrays may change.
  threads_->run_over(nlocal, kFewestRods, [=](int first, int last) {
    Batch batch;
    for (int i = first; i < last; i++) {
      if (!(mask[i] & group)) continue;
      move(i);
      const sc::Vec3 momentum = sc::load(angmom[i]) + half * sc::load(torque[i]);
      sc::store(momentum, angmom[i]);
      batch.rotations.set(batch.count, momentum, inertia[i], quaternion[i]);
      batch.rods[batch.count++] = i;
      if (batch.count < sc::kBatch) continue;
      finish(batch);
      batch.count = 0;
    }
    if (batch.count > 0) finish(batch);
  });
}

void FixNVESpherocylinder::initial_integrate(int)
{
  if (plain_) return half_step_plainly(true);
  double **x = atom->x, **v = atom->v, **f = atom->f;
  const double *mass = atom->rmass, half = dtf, step = dtv;
  for_each_batch(
      [=](int i) {
        const double dtfm = half / mass[i];
        for (int d = 0; d < 3; d++) {
          v[i][d] += dtfm * f[i][d];
          x[i][d] += step * v[i][d];
        }
      },
      [&](Batch &batch) {
        sc::rotate_freely(batch.rotations, dtv);
        // The forces of this step see the half-step velocities, as with LIGGGHTS's other
        // integrators.
        for (int k = 0; k < batch.count; k++) {
          const int i = batch.rods[k];
          if (batch.rotations.uncertain[k] != 0.0) {
            rotate_one(i);
            continue;
          }
          sc::store(batch.rotations.after(k), atom->quaternion[i]);
          sc::store(batch.rotations.omega.get(k), atom->omega[i]);
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
  if (plain_) return half_step_plainly(false);
  double **v = atom->v, **f = atom->f;
  const double *mass = atom->rmass, half = dtf;
  for_each_batch(
      [=](int i) {
        const double dtfm = half / mass[i];
        for (int d = 0; d < 3; d++) v[i][d] += dtfm * f[i][d];
      },
      [&](Batch &batch) {
        sc::angular_velocities(batch.rotations);
        for (int k = 0; k < batch.count; k++)
          sc::store(batch.rotations.omega.get(k), atom->omega[batch.rods[k]]);
      });
}

// What is carried from one half step to the next is the angular velocity; the angular momentum
// follows from it, for whoever asks.
void FixNVESpherocylinder::half_step_plainly(bool drift)
{
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  threads_->run_over(nlocal, kFewestRods, [this, drift](int first, int last) {
    for (int i = first; i < last; i++)
      if (atom->mask[i] & groupbit) move_plainly(i, drift);
  });
}

void FixNVESpherocylinder::move_plainly(int i, bool drift)
{
  const double dtfm = dtf / atom->rmass[i];
  sc::add_to(atom->v[i], dtfm * sc::load(atom->f[i]));
  const double axial = atom->inertia[i][2], transverse = atom->inertia[i][0];
  sc::Quaternion q = sc::load_quaternion(atom->quaternion[i]);
  const sc::Vec3 omega_body =
      sc::kicked_plainly(sc::in_body_frame(sc::load(atom->omega[i]), q),
                         sc::in_body_frame(sc::load(atom->torque[i]), q), axial, transverse, dtf);
  if (drift) {
    sc::add_to(atom->x[i], dtv * sc::load(atom->v[i]));
    q = sc::turned_plainly(q, omega_body, dtv);
    sc::store(q, atom->quaternion[i]);
  }
  const sc::Vec3 omega = sc::rotated(omega_body, q);
  sc::store(omega, atom->omega[i]);
  sc::store(sc::angular_momentum(omega, sc::axis_of(q), axial, transverse), atom->angmom[i]);
}
