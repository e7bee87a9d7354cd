// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_balance.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixBalance::FixBalance(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg),
      cuts_(lmp, std::string("Fix balance (id ") + arg[0] + ")", narg - 4, arg + 4)
{
  rods_of(lmp, fix_and_id(arg).c_str());
  nevery = deck_whole_number(lmp, fix_and_id(arg), "Nevery", arg[3]);
  if (nevery < 0)
    rod_error_all(lmp, "Fix balance (id %s): Nevery must be >= 0 (got %s)", id, arg[3]);
  if (igroup != 0)
    rod_error_all(lmp, "Fix balance (id %s): group must be all, ranks own every rod (got %s)", id,
                  arg[1]);

  box_change_domain = 1;
  if (nevery > 0) {
    force_reneighbor = 1;
    next_reneighbor = (update->ntimestep / nevery + 1) * nevery;
  }
  scalar_flag = vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extscalar = extvector = 0;
}

int FixBalance::setmask() { return PRE_EXCHANGE; }

void FixBalance::init() { cuts_.init(); }

void FixBalance::setup_pre_exchange() { balance(); }

void FixBalance::pre_exchange()
{
  if (nevery == 0 || update->ntimestep >= next_reneighbor) balance();
}

// The integrator goes on with Domain::reset_box, Comm::setup and Comm::exchange (box_change_domain).
void FixBalance::balance()
{
  if (nevery > 0) next_reneighbor = (update->ntimestep / nevery + 1) * nevery;
  imbalance_before_ = cuts_.imbalance();
  if (imbalance_before_ > cuts_.threshold() && cuts_.shift()) shifts_ += 1.0;
}

// The imbalance now.
double FixBalance::compute_scalar() { return cuts_.imbalance(); }

// 1: rods of the rank that has most, now; 2: how often the cuts have moved; 3: the imbalance when
// they were last looked at, before they moved
double FixBalance::compute_vector(int n)
{
  if (n == 1) return shifts_;
  if (n == 2) return imbalance_before_;
  const double mine = atom->nlocal;
  double most = 0.0;
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);
  return most;
}
