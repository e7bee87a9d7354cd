// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/balance.h"

#include <cstdio>

#include "comm.h"
#include "domain.h"
#include "host/rod_error.h"
#include "lists/close_pair_counts.h"
#include "modify.h"
#include "parallel/subdomain_cuts.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;

// The close pairs of the last step, which go with the rods while they change ranks.
void Balance::begin(ClosePairCounts &counts)
{
  counts.begin();
  const int stay = counts.count_if_rods_stay();
  int all_stay = 0;
  MPI_Allreduce(&stay, &all_stay, 1, MPI_INT, MPI_MIN, world);
  if (!all_stay)
    rod_error_all(
        lmp, "Balance command: weight neigh counts the close pairs of the run just before, and "
             "there is none with these rods in these places (expected run 0 before it)");
}

// As write_restart does before it writes: histories from the neighbour lists to their rods, rods to
// their ranks, ghosts anew.
void Balance::command(int narg, char **arg)
{
  if (domain->box_exist == 0)
    rod_error_all(lmp, "Balance command before the simulation box is defined");
  if (modify->fix_restart_in_progress())
    rod_error_all(lmp,
                  "Balance command between read_restart and the first run would lose the restart's "
                  "data of fixes that are yet to come (expected run 0 before it)");
  rods_of(lmp, "Balance command");
  const SubdomainCuts cuts(lmp, "Balance command", narg, arg);
  ClosePairCounts counts(lmp, "balance");
  if (cuts.weighs_pairs()) begin(counts);
  const auto close_pairs = [&] {
    return cuts.weighs_pairs() ? counts.counted() : std::vector<int>();
  };
  lmp->init();
  cuts.init();

  modify->setup_pre_exchange();
  domain->pbc();
  domain->reset_box();
  comm->exchange();

  const double before = cuts.imbalance(close_pairs());
  if (before > cuts.threshold() && cuts.shift(close_pairs())) {
    domain->set_local_box();
    comm->exchange();
  }
  const double after = cuts.imbalance(close_pairs());
  if (cuts.weighs_pairs()) counts.end();
  comm->setup();
  comm->borders();

  if (comm->me != 0) return;
  for (FILE *out : {screen, logfile}) {
    if (!out) continue;
    fprintf(out, "  initial/final imbalance factor = %g %g\n%s", before, after,
            cuts.text().c_str());
  }
}
