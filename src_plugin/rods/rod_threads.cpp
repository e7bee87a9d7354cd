// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/rod_threads.h"

#include <cstdio>
#include <cstdlib>

#include <unistd.h>

#include "comm.h"
#include "error.h"
#include "host/rod_error.h"

using namespace LAMMPS_NS;

RodThreads::RodThreads(LAMMPS *lmp) : Pointers(lmp)
{
  of_environment_ = from_environment();
  // All ranks have as many as the first: launchers do not always hand a variable on.
  MPI_Bcast(&of_environment_, 1, MPI_INT, 0, world);
  count_ = of_environment_;
}

// The variable may be a list, of which the first is meant for the outermost level.
int RodThreads::from_environment() const
{
  const char *wanted = getenv("OMP_NUM_THREADS");
  if (!wanted || !*wanted) return 1;
  char *end = nullptr;
  const long count = strtol(wanted, &end, 10);
  if (end == wanted || (*end != '\0' && *end != ',') || count < 1 || count > kMost)
    rod_error_all(lmp, "OMP_NUM_THREADS must be a whole number from 1 to %d (got %s)", kMost,
                  wanted);
  return static_cast<int>(count);
}

void RodThreads::tell()
{
  if (told_ || count_ == 1) return;
  told_ = true;
  MPI_Comm node;
  MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  int ranks = 1;
  MPI_Comm_size(node, &ranks);
  MPI_Comm_free(&node);
  if (comm->me == 0)
    for (FILE *out : {screen, logfile})
      if (out) fprintf(out, "Rods: %d threads for each of %d ranks\n", count_, comm->nprocs);
  const long processors = sysconf(_SC_NPROCESSORS_ONLN);
  if (comm->me == 0 && static_cast<long>(ranks) * count_ > processors)
    rod_warning(lmp,
                "Rods: %d ranks of %d threads each are more than the %ld processors of this "
                "machine: use fewer (OMP_NUM_THREADS, or threads of pair_style), or let them wait "
                "without taking a processor (OMP_WAIT_POLICY passive)",
                ranks, count_, processors);
}
