// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_limit_omega.h"

#include <cstring>

#include "atom.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "force.h"
#include "rod_checks.h"

using namespace LAMMPS_NS;
using namespace FixConst;
namespace sc = spherocylinder;

FixLimitOmega::FixLimitOmega(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  rods_of(lmp, "Fix limit/omega");
  if (narg < 4) rod_error_all(lmp, "Fix limit/omega (id %s): expected a limit in rad/s", id);
  limit_ = force->numeric(FLERR, arg[3]);
  if (!(limit_ > 0.0))
    rod_error_all(lmp, "Fix limit/omega (id %s): omega must be > 0 (got %s)", id, arg[3]);

  for (int i = 4; i < narg; i += 2) {
    if (strcmp(arg[i], "component") != 0)
      rod_error_all(lmp, "Fix limit/omega (id %s): unknown keyword %s (expected component)", id,
                    arg[i]);
    const char *value = i + 1 < narg ? arg[i + 1] : "nothing";
    if (strcmp(value, "total") == 0)
      component_ = Component::Total;
    else if (strcmp(value, "transverse") == 0)
      component_ = Component::Transverse;
    else if (strcmp(value, "axial") == 0)
      component_ = Component::Axial;
    else
      rod_error_all(lmp,
                    "Fix limit/omega (id %s): component must be total, transverse or axial "
                    "(got %s)",
                    id, value);
  }

  vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extvector = 1;
}

int FixLimitOmega::setmask() { return END_OF_STEP; }

void FixLimitOmega::end_of_step()
{
  acted_last_ = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) limit_rod(i);
  actions_ += acted_last_;
}

void FixLimitOmega::limit_rod(int i)
{
  const sc::Vec3 omega = sc::load(atom->omega[i]);
  // |omega| bounds each of its parts: most rods end here.
  if (sc::norm_squared(omega) <= limit_ * limit_) return;

  const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
  const sc::Vec3 axial = sc::dot(omega, axis) * axis;
  const sc::Vec3 limited_part = component_ == Component::Total   ? omega
                                : component_ == Component::Axial ? axial
                                                                 : omega - axial;
  const double magnitude = sc::norm(limited_part);
  if (magnitude <= limit_) return;

  const sc::Vec3 new_omega = omega - (1.0 - limit_ / magnitude) * limited_part;
  const double inertia_transverse = atom->inertia[i][0], inertia_axial = atom->inertia[i][2];
  const sc::Vec3 old_angmom = sc::load(atom->angmom[i]);
  const sc::Vec3 new_angmom =
      sc::angular_momentum(new_omega, axis, inertia_axial, inertia_transverse);
  energy_removed_ +=
      sc::rotational_energy(old_angmom, axis, inertia_axial, inertia_transverse) -
      sc::rotational_energy(new_angmom, axis, inertia_axial, inertia_transverse);
  acted_last_ += 1.0;
  sc::store(new_omega, atom->omega[i]);
  sc::store(new_angmom, atom->angmom[i]);
}

// 1: rods limited, summed over all steps; 2: energy removed (J); 3: rods limited in the last step
double FixLimitOmega::compute_vector(int n)
{
  const double local = n == 0 ? actions_ : n == 1 ? energy_removed_ : acted_last_;
  double total = 0.0;
  MPI_Allreduce(&local, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  return total;
}
