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
  if (cuts_.weighs_pairs()) counts_.emplace(lmp, id);
}

void FixBalance::post_create()
{
  if (counts_) counts_->begin();
}

void FixBalance::pre_delete(bool unfixed)
{
  if (counts_ && unfixed) counts_->end();
}

int FixBalance::setmask() { return PRE_EXCHANGE | POST_RUN; }

void FixBalance::init() { cuts_.init(); }

// What comes between runs may move rods.
void FixBalance::post_run()
{
  if (counts_) counts_->count();
}

// By what the run before knew of the rods; before the first run they have no close pairs.
void FixBalance::setup_pre_exchange()
{
  if (counts_) counts_->count_if_rods_stay();
  balance();
}

void FixBalance::pre_exchange()
{
  if (nevery != 0 && update->ntimestep < next_reneighbor) return;
  if (counts_) counts_->count();
  balance();
}

// The integrator goes on with Domain::reset_box, Comm::setup and Comm::exchange (box_change_domain).
void FixBalance::balance()
{
  if (nevery > 0) next_reneighbor = (update->ntimestep / nevery + 1) * nevery;
  const std::vector<int> pairs = counts_ ? counts_->counted() : std::vector<int>();
  imbalance_before_ = cuts_.imbalance(pairs);
  if (imbalance_before_ > cuts_.threshold() && cuts_.shift(pairs)) shifts_ += 1.0;
}

std::vector<int> FixBalance::pairs_now() const
{
  return counts_ ? counts_->now() : std::vector<int>();
}

// The imbalance now.
double FixBalance::compute_scalar() { return cuts_.imbalance(pairs_now()); }

// 1: what the rank costs that has most to do, in rods, now; 2: how often the cuts have moved; 3: the
// imbalance when they were last looked at, before they moved
double FixBalance::compute_vector(int n)
{
  if (n == 1) return shifts_;
  if (n == 2) return imbalance_before_;
  return cuts_.largest_cost(pairs_now());
}
