// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_limit_omega.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "atom.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "force.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "memory.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_driver.h"

using namespace LAMMPS_NS;
using namespace FixConst;
namespace sc = spherocylinder;

namespace {

// A rod held at the limit is beyond it by rounding half of the time: that is no action.
constexpr double kRounding = 1e-12;

}  // namespace

FixLimitOmega::FixLimitOmega(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  rods_of(lmp, "Fix limit/omega");
  if (narg < 4) rod_error_all(lmp, "Fix limit/omega (id %s): expected a limit in rad/s", id);
  limit_ = deck_number(lmp, fix_and_id(arg), "omega", arg[3]);
  if (!(limit_ > 0.0) || std::isinf(limit_))
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
  size_vector = 5;
  global_freq = 1;
  extvector = 0;  // sums over the run, not to be divided by the number of rods

  create_attribute = 1;  // inserted rods begin at 0
  peratom_flag = 1;
  size_peratom_cols = kPerRod;
  peratom_freq = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
}

FixLimitOmega::~FixLimitOmega()
{
  atom->delete_callback(id, 0);
  memory->destroy(of_rod_);
}

int FixLimitOmega::setmask() { return END_OF_STEP; }

void FixLimitOmega::init() { driven_ = driven_groups(lmp); }

void FixLimitOmega::end_of_step()
{
  acted_last_ = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && !(atom->mask[i] & driven_)) limit_rod(i);
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
  if (magnitude <= limit_ * (1.0 + kRounding)) return;

  const sc::Vec3 new_omega = omega - (1.0 - limit_ / magnitude) * limited_part;
  const double inertia_transverse = atom->inertia[i][0], inertia_axial = atom->inertia[i][2];
  const sc::Vec3 old_angmom = sc::load(atom->angmom[i]);
  const sc::Vec3 new_angmom =
      sc::angular_momentum(new_omega, axis, inertia_axial, inertia_transverse);
  const double energy = sc::rotational_energy(old_angmom, axis, inertia_axial, inertia_transverse) -
                        sc::rotational_energy(new_angmom, axis, inertia_axial, inertia_transverse);
  energy_removed_ += energy;
  acted_last_ += 1.0;
  of_rod_[i][0] += 1.0;
  of_rod_[i][1] += energy;
  sc::store(new_omega, atom->omega[i]);
  sc::store(new_angmom, atom->angmom[i]);
}

// How often the rod was limited that was so most often, and which it is (the lowest id of equals);
// 0 and 0 if none was.
void FixLimitOmega::most_limited(double &times, double &id_of_rod) const
{
  double most = 0.0;
  for (int i = 0; i < atom->nlocal; i++) most = std::max(most, of_rod_[i][0]);
  MPI_Allreduce(&most, &times, 1, MPI_DOUBLE, MPI_MAX, world);

  double lowest = std::numeric_limits<double>::max();
  if (times > 0.0)
    for (int i = 0; i < atom->nlocal; i++)
      if (of_rod_[i][0] == times) lowest = std::min(lowest, static_cast<double>(atom->tag[i]));
  MPI_Allreduce(&lowest, &id_of_rod, 1, MPI_DOUBLE, MPI_MIN, world);
  if (times == 0.0) id_of_rod = 0.0;
}

// 1: rods limited, summed over all steps; 2: energy removed (J); 3: rods limited in the last step;
// 4: times the rod most often limited was so; 5: its id
double FixLimitOmega::compute_vector(int n)
{
  if (n >= 3) {
    double times = 0.0, id_of_rod = 0.0;
    most_limited(times, id_of_rod);
    return n == 3 ? times : id_of_rod;
  }
  const double local = n == 0 ? actions_ : n == 1 ? energy_removed_ : acted_last_;
  double total = 0.0;
  MPI_Allreduce(&local, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  return total;
}

void FixLimitOmega::grow_arrays(int nmax)
{
  memory->grow(of_rod_, nmax, kPerRod, "limit/omega:of_rod");
  array_atom = of_rod_;
}

void FixLimitOmega::copy_arrays(int from, int to, int)
{
  for (int k = 0; k < kPerRod; k++) of_rod_[to][k] = of_rod_[from][k];
}

void FixLimitOmega::set_arrays(int i)
{
  for (int k = 0; k < kPerRod; k++) of_rod_[i][k] = 0.0;
}

int FixLimitOmega::pack_exchange(int i, double *buffer)
{
  for (int k = 0; k < kPerRod; k++) buffer[k] = of_rod_[i][k];
  return kPerRod;
}

int FixLimitOmega::unpack_exchange(int i, double *buffer)
{
  for (int k = 0; k < kPerRod; k++) of_rod_[i][k] = buffer[k];
  return kPerRod;
}

double FixLimitOmega::memory_usage() { return sizeof(double) * kPerRod * atom->nmax; }
