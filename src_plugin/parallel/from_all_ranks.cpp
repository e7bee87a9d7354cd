// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/from_all_ranks.h"

namespace {

template <typename T>
std::vector<T> gathered(MPI_Comm world, const std::vector<T> &mine, MPI_Datatype type)
{
  int ranks = 0;
  MPI_Comm_size(world, &ranks);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(ranks), places(ranks, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int k = 1; k < ranks; k++) places[k] = places[k - 1] + counts[k - 1];
  std::vector<T> all(places.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), places.data(), type, world);
  return all;
}

}  // namespace

std::vector<int> LAMMPS_NS::from_all_ranks(MPI_Comm world, const std::vector<int> &mine)
{
  return gathered(world, mine, MPI_INT);
}

std::vector<double> LAMMPS_NS::from_all_ranks(MPI_Comm world, const std::vector<double> &mine)
{
  return gathered(world, mine, MPI_DOUBLE);
}
