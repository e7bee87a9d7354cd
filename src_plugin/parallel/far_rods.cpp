// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/far_rods.h"

#include <algorithm>
#include <cstdlib>

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "host/host_limits.h"
#include "host/rod_error.h"
#include "irregular.h"
#include "lammps.h"

using namespace LAMMPS_NS;

namespace {

// The part of the box along one dimension that holds x, counted from the part `from`.
int part_of(double x, double lo, double length, const double *splits, int parts, int from)
{
  int part = from;
  while (part > 0 && x < lo + length * splits[part]) part--;
  while (part < parts - 1 && x >= lo + length * splits[part + 1]) part++;
  return part;
}

// The first part is beside the last, whether the box is periodic or not: so are their ranks.
bool any_is_far(LAMMPS *lmp)
{
  const Comm &comm = *lmp->comm;
  const Domain &domain = *lmp->domain;
  const bool lamda = domain.triclinic != 0;  // positions are in lamda coordinates then
  const double *const lo = lamda ? domain.boxlo_lamda : domain.boxlo;
  const double *const length = lamda ? domain.prd_lamda : domain.prd;
  const double *const splits[3] = {comm.xsplit, comm.ysplit, comm.zsplit};
  for (int d = 0; d < 3; d++) {
    const int parts = comm.procgrid[d], mine = comm.myloc[d];
    if (parts <= 3) continue;
    for (int i = 0; i < lmp->atom->nlocal; i++) {
      const int part = part_of(lmp->atom->x[i][d], lo[d], length[d], splits[d], parts, mine);
      const int way = std::abs(part - mine);
      if (std::min(way, parts - way) > 1) return true;
    }
  }
  return false;
}

}  // namespace

void LAMMPS_NS::hand_over_far_rods(LAMMPS *lmp)
{
  const int *grid = lmp->comm->procgrid;
  if (std::max({grid[0], grid[1], grid[2]}) <= 3) return;
  const int mine[2] = {any_is_far(lmp), lmp->comm->maxexchange_fix};
  int most[2] = {0, 0};  // whether any is far, numbers of a rod's contacts
  MPI_Allreduce(mine, most, 2, MPI_INT, MPI_MAX, lmp->world);
  if (!most[0]) return;
  if (most[1] > kRoomForContacts)
    rod_error_all(
        lmp,
        "Atom style spherocylinder: a rod would go past the next rank while rods have up to "
        "%d numbers in their contact histories, wanted at most %d; use fewer processors",
        most[1], kRoomForContacts);
  Irregular(lmp).migrate_atoms();
}
