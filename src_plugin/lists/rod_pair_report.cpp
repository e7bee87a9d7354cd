// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/rod_pair_report.h"

#include <cinttypes>
#include <cstdio>

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "lists/close_rod_pairs.h"
#include "lists/lists_in_use.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;

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
  if (lmp->comm->me != 0) return;
  for (FILE *out : {lmp->screen, lmp->logfile}) {
    if (!out) continue;
    fprintf(out,
            "Rod pairs: listed = %" PRId64 ", close = %" PRId64 ", touching = %" PRId64 "\n"
            "Rod pair list builds = %" PRId64 " (skin %g), close pair refreshes = %" PRId64
            " (skin %g)\n",
            sums[0], sums[1], sums[2], peaks[0], counts.list_skin, peaks[1], counts.close_skin);
  }
}
