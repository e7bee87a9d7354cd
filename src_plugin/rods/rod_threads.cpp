// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/rod_threads.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <strings.h>
#include <unistd.h>

#include "comm.h"
#include "core/parallel.h"
#include "error.h"
#include "host/rod_error.h"

using namespace LAMMPS_NS;

RodThreads::RodThreads(LAMMPS *lmp) : Pointers(lmp)
{
  // All ranks have as many as the first: launchers do not always hand a variable on.
  if (comm->me == 0) of_environment_ = from_environment();
  MPI_Bcast(&of_environment_, 1, MPI_INT, 0, world);
  wanted_ = of_environment_;
}

int RodThreads::from_environment() const
{
  const char *wanted = getenv("OMP_NUM_THREADS");
  if (!wanted || !*wanted) return 1;
  const std::optional<int> count = spherocylinder::threads_in(wanted);
  if (!count)
    rod_error_one(lmp, "OMP_NUM_THREADS must be a whole number from 1 to %d (got %s)", kMost,
                  wanted);
  return *count;
}

// Threads that wait in a loop for one that cannot run make a step take forty times as long.
void RodThreads::begin_run()
{
  if (wanted_ == count_ && told_) return;
  count_ = wanted_;
  if (count_ == 1) return;
  MPI_Comm node;
  MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  int ranks = 1;
  MPI_Comm_size(node, &ranks);
  MPI_Comm_free(&node);
  MPI_Bcast(&ranks, 1, MPI_INT, 0, world);
  int processors = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  MPI_Bcast(&processors, 1, MPI_INT, 0, world);
  const char *policy = getenv("OMP_WAIT_POLICY");
  int wait_without_processor = policy && strcasecmp(policy, "passive") == 0 ? 1 : 0;
  MPI_Bcast(&wait_without_processor, 1, MPI_INT, 0, world);

  const bool are_too_many = static_cast<long>(ranks) * count_ > processors;
  if (are_too_many && !wait_without_processor) count_ = std::max(1, processors / ranks);
  if (told_) return;
  told_ = true;
  if (comm->me != 0) return;
  if (are_too_many && !wait_without_processor)
    rod_warning(
        lmp,
        "Rods: %d ranks of %d threads each are more than the %d processors of this machine: "
        "%d threads are used (all of them with OMP_WAIT_POLICY passive)",
        ranks, wanted_, processors, count_);
  for (FILE *out : {screen, logfile})
    if (out && count_ > 1)
      fprintf(out, "Rods: %d threads for each of %d ranks\n", count_, comm->nprocs);
}
