// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/from_all_ranks.h"

std::vector<int> LAMMPS_NS::from_all_ranks(MPI_Comm world, const std::vector<int> &mine)
{
  int ranks = 0;
  MPI_Comm_size(world, &ranks);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(ranks), places(ranks, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int k = 1; k < ranks; k++) places[k] = places[k - 1] + counts[k - 1];
  std::vector<int> all(places.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, MPI_INT, all.data(), counts.data(), places.data(), MPI_INT,
                 world);
  return all;
}
