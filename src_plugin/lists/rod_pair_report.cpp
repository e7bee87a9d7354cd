// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/rod_pair_report.h"

#include <cinttypes>
#include <cstdio>
#include <string>

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "lists/close_rod_pairs.h"
#include "lists/lists_in_use.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;

namespace {

// Between ranks; those of new ghosts included.
void report_ghosts(LAMMPS *lmp, NeededGhosts &ghosts, int64_t steps)
{
  const int64_t local[3] = {lmp->atom->nghost, ghosts.counts().poses, ghosts.counts().bytes};
  int64_t sums[3];
  MPI_Reduce(local, sums, 3, MPI_INT64_T, MPI_SUM, 0, lmp->world);
  if (lmp->comm->me != 0) return;
  const double steps_and_ranks = static_cast<double>(steps) * lmp->comm->nprocs;
  const std::string &reader = ghosts.reader();
  for (FILE *out : {lmp->screen, lmp->logfile}) {
    if (!out) continue;
    fprintf(
        out,
        "Rod ghosts of a rank: held = %.0f, sent in a step = %.1f, bytes sent in a step = %.0f, "
        "asked for = %" PRId64 "\n",
        static_cast<double>(sums[0]) / lmp->comm->nprocs,
        static_cast<double>(sums[1]) / steps_and_ranks,
        static_cast<double>(sums[2]) / steps_and_ranks, ghosts.counts().asked);
    if (!reader.empty()) fprintf(out, "Rod ghosts: all are sent, for %s\n", reader.c_str());
  }
}

}  // namespace

// Pairs are summed over the ranks, one across a border or the periodic box counts twice, as it does in
// LIGGGHTS's own number of neighbours. Renewals and refreshes are those of the rank with most.
void LAMMPS_NS::report_rod_pairs(LAMMPS *lmp)
{
  auto *rods = dynamic_cast<AtomVecSpherocylinder *>(lmp->atom->avec);
  if (!rods) return;
  const RodPairCounts *found = rods->attached<ListsInUse>().counts;
  if (!found || found->steps == 0) return;
  const RodPairCounts &counts = *found;
  const int64_t local_sums[3] = {counts.listed, counts.close, counts.touching};
  const int64_t local_peaks[2] = {counts.renewals, counts.refreshes};
  int64_t sums[3], peaks[2];
  MPI_Allreduce(local_sums, sums, 3, MPI_INT64_T, MPI_SUM, lmp->world);
  MPI_Allreduce(local_peaks, peaks, 2, MPI_INT64_T, MPI_MAX, lmp->world);
  for (FILE *out : {lmp->screen, lmp->logfile}) {
    if (!out || lmp->comm->me != 0) continue;
    fprintf(out,
            "Rod pairs: listed = %" PRId64 ", close = %" PRId64 ", touching = %" PRId64 "\n"
            "Rod pair list builds = %" PRId64 " (skin %g), close pair refreshes = %" PRId64
            " (skin %g)\n",
            sums[0], sums[1], sums[2], peaks[0], counts.list_skin, peaks[1], counts.close_skin);
  }
  if (lmp->comm->nprocs > 1) report_ghosts(lmp, rods->ghosts(), counts.steps);
}
