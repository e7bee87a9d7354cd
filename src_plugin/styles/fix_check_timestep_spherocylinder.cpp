// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_check_timestep_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "contacts/contact_state.h"
#include "core/capsule.h"
#include "force.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "modify.h"
#include "rods/atom_vec_spherocylinder.h"
#include "styles/fix_hinge_spherocylinder.h"
#include "styles/fix_joint_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
namespace sc = spherocylinder;

FixCheckTimestepSpherocylinder::FixCheckTimestepSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), rates_(lmp)
{
  rods_of(lmp, "Fix check/timestep/spherocylinder");
  if (narg < 5)
    rod_error_all(lmp,
                  "Fix %s (id %s): expected an interval in steps and a fraction of the stable "
                  "step",
                  style, id);
  nevery = deck_whole_number(lmp, fix_and_id(arg), "the interval", arg[3]);
  if (nevery < 1)
    rod_error_all(lmp, "Fix %s (id %s): the interval must be >= 1 step (got %s)", style, id,
                  arg[3]);
  allowed_fraction_ = deck_number(lmp, fix_and_id(arg), "the fraction", arg[4]);
  if (!(allowed_fraction_ > 0.0 && allowed_fraction_ <= 1.0))
    rod_error_all(lmp, "Fix %s (id %s): the fraction must be > 0 and <= 1 (got %s)", style, id,
                  arg[4]);
  parse_options(narg, arg);

  vector_flag = 1;
  size_vector = 4;
  global_freq = nevery;
  extvector = 0;
}

void FixCheckTimestepSpherocylinder::parse_options(int narg, char **arg)
{
  for (int i = 5; i < narg; i += 2) {
    bool *option = strcmp(arg[i], "warn") == 0    ? &warn_
                   : strcmp(arg[i], "error") == 0 ? &stop_
                                                  : nullptr;
    if (!option)
      rod_error_all(lmp, "Fix %s (id %s): unknown keyword %s (expected warn or error)", style, id,
                    arg[i]);
    const char *value = i + 1 < narg ? arg[i + 1] : "nothing";
    if (strcmp(value, "yes") != 0 && strcmp(value, "no") != 0)
      rod_error_all(lmp, "Fix %s (id %s): %s must be yes or no (got %s)", style, id, arg[i], value);
    *option = strcmp(value, "yes") == 0;
  }
}

// A run that an error has ended in the midst of a step leaves it joined; with `clear` the rods go first.
FixCheckTimestepSpherocylinder::~FixCheckTimestepSpherocylinder()
{
  if (ContactState *state = contacts()) state->leave(rates_);
}

ContactState *FixCheckTimestepSpherocylinder::contacts()
{
  auto *rods = dynamic_cast<AtomVecSpherocylinder *>(atom->avec);
  return rods ? &rods->attached<ContactState>() : nullptr;
}

int FixCheckTimestepSpherocylinder::setmask() { return PRE_FORCE | END_OF_STEP; }

void FixCheckTimestepSpherocylinder::init() { warned_ = false; }

void FixCheckTimestepSpherocylinder::pre_force(int)
{
  if (update->ntimestep % nevery != 0) return;
  rates_.start();
  contacts()->join(rates_);
}

void FixCheckTimestepSpherocylinder::end_of_step()
{
  contacts()->leave(rates_);
  const auto *joints = dynamic_cast<const FixJointSpherocylinder *>(
      modify->find_fix_style_strict("joint/spherocylinder", 0));
  std::vector<const FixHingeSpherocylinder *> hinges;
  for (int k = 0; k < modify->nfix; k++)
    if (const auto *hinge = dynamic_cast<const FixHingeSpherocylinder *>(modify->fix[k]))
      hinges.push_back(hinge);
  double local[3] = {0.0, 0.0, largest_surface_move()}, all[3];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double of_joints = joints ? joints->squared_frequency(i) : 0.0;
    for (const FixHingeSpherocylinder *hinge : hinges) of_joints += hinge->squared_frequency(i);
    local[0] = std::max(local[0], rates_.squared_frequency(i) + of_joints);
    local[1] = std::max(local[1], static_cast<double>(rates_.contacts(i)));
  }
  MPI_Allreduce(local, all, 3, MPI_DOUBLE, MPI_MAX, world);
  stable_step_ = all[0] > 0.0 ? 2.0 / std::sqrt(all[0]) : 0.0;
  fraction_ = all[0] > 0.0 ? update->dt / stable_step_ : 0.0;
  most_contacts_ = all[1];
  largest_move_ = all[2];

  if (fraction_ <= allowed_fraction_) return;
  if (stop_)
    rod_error_all(lmp,
                  "Fix %s (id %s): time step %g is %g of the stable step %g at step " BIGINT_FORMAT
                  ", allowed is %g of it",
                  style, id, update->dt, fraction_, stable_step_, update->ntimestep,
                  allowed_fraction_);
  if (!warn_ || warned_) return;
  warned_ = true;
  if (comm->me == 0)
    rod_warning(lmp,
                "Fix %s (id %s): time step %g is %g of the stable step %g at step " BIGINT_FORMAT
                ", allowed is %g of it",
                style, id, update->dt, fraction_, stable_step_, update->ntimestep,
                allowed_fraction_);
}

double FixCheckTimestepSpherocylinder::largest_surface_move() const
{
  double largest = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double speed =
        sc::norm(sc::load(atom->v[i])) + atom->shape[i][2] * sc::norm(sc::load(atom->omega[i]));
    largest = std::max(largest, speed * update->dt / (2.0 * atom->shape[i][0]));
  }
  return largest;
}

// 1: time step / stable step; 2: stable step (s); 3: most contacts of one rod; 4: largest move of a
// rod's surface in one step over its diameter. 1 and 2 are 0 while nothing touches and without joints.
double FixCheckTimestepSpherocylinder::compute_vector(int n)
{
  const double values[4] = {fraction_, stable_step_, most_contacts_, largest_move_};
  return values[n];
}
