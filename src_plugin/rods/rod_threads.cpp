// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/rod_threads.h"

#include <algorithm>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

#include <sched.h>
#include <strings.h>

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

// Processors of this machine that the rank with fewest has for itself. Launchers bind ranks to some of them;
// those that may run on the same ones share them.
int RodThreads::processors_of_a_rank() const
{
  cpu_set_t mine;
  CPU_ZERO(&mine);
  if (sched_getaffinity(0, sizeof mine, &mine) != 0)
    return INT_MAX;  // a machine of more than it has bits for
  MPI_Comm node;
  MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  int ranks = 1;
  MPI_Comm_size(node, &ranks);
  std::vector<cpu_set_t> all(ranks);
  MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, node);
  MPI_Comm_free(&node);
  const auto shares = std::count_if(all.begin(), all.end(), [&](const cpu_set_t &other) {
    cpu_set_t both;
    CPU_AND(&both, &mine, &other);
    return CPU_COUNT(&both) > 0;
  });
  const int share = CPU_COUNT(&mine) / static_cast<int>(shares);
  int least = 0;
  MPI_Allreduce(&share, &least, 1, MPI_INT, MPI_MIN, world);
  return least;
}

// Threads that wait in a loop for one that cannot run make a step take forty times as long.
void RodThreads::begin_run()
{
  count_ = wanted_ == told_ ? told_count_ : wanted_;
  if (count_ == 1 || wanted_ == told_) return;
  const char *policy = getenv("OMP_WAIT_POLICY");
  int wait_without_processor = policy && strcasecmp(policy, "passive") == 0 ? 1 : 0;
  MPI_Bcast(&wait_without_processor, 1, MPI_INT, 0, world);
  const int processors = processors_of_a_rank();
  if (!wait_without_processor) count_ = std::clamp(processors, 1, count_);
  told_ = wanted_;
  told_count_ = count_;
  if (comm->me != 0) return;
  if (count_ < wanted_)
    rod_warning(
        lmp,
        "Rods: %d ranks of %d threads each are more than the processors that they may use here: "
        "%d threads are used (all of them with OMP_WAIT_POLICY passive; mpirun binds a rank to one "
        "processor without --bind-to none or --map-by slot:PE=%d)",
        comm->nprocs, wanted_, count_, wanted_);
  for (FILE *out : {screen, logfile})
    if (out && count_ > 1)
      fprintf(out, "Rods: %d threads for each of %d ranks\n", count_, comm->nprocs);
}
