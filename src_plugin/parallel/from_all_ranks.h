// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include <mpi.h>

namespace LAMMPS_NS {

// Every rank's numbers one after the other, the same on all ranks, which must all call it.
std::vector<int> from_all_ranks(MPI_Comm world, const std::vector<int> &mine);
std::vector<double> from_all_ranks(MPI_Comm world, const std::vector<double> &mine);

}  // namespace LAMMPS_NS
