// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/replicate_rods.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <mpi.h>

#include "atom.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "host/rod_error.h"
#include "modify.h"
#include "pair_gran.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/fibre_segments.h"
#include "styles/fix_contact_history_spherocylinder.h"
#include "styles/fix_fibres_spherocylinder.h"

using namespace LAMMPS_NS;

int ReplicateRods::highest_id() const
{
  const int *tags = atom->tag;
  const int mine = atom->nlocal > 0 ? *std::max_element(tags, tags + atom->nlocal) : 0;
  int highest = 0;
  MPI_Allreduce(&mine, &highest, 1, MPI_INT, MPI_MAX, world);
  return highest;
}

int ReplicateRods::highest_fibre() const
{
  const auto &segments = rods_of(lmp, "Replicate").attached<FibreSegments>();
  int mine = 0, highest = 0;
  for (int i = 0; i < atom->nlocal && segments.rows; i++) mine = std::max(mine, segments.fibre(i));
  MPI_Allreduce(&mine, &highest, 1, MPI_INT, MPI_MAX, world);
  return highest;
}

void ReplicateRods::command(int narg, char **arg)
{
  if (modify->fix_restart_in_progress())
    rod_error_all(
        lmp, "Replicate must come after the first run (run 0 will do) when rods with contacts have "
             "been read from a restart file");
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *fix = modify->fix[k];
    if (strcmp(fix->style, "spring/self") == 0 || strcmp(fix->style, "store/state") == 0)
      rod_error_all(
          lmp,
          "Replicate: fix %s (id %s) keeps where each rod was, and of a copy its original's "
          "place; define it after replicate",
          fix->style, fix->id);
  }
  bring_histories_to_rods(lmp);
  const std::vector<int> ids(atom->tag, atom->tag + atom->nlocal);
  const int highest = highest_id();
  int grid[3] = {1, 1, 1};
  for (int d = 0; d < 3 && narg >= 3; d++) grid[d] = force->inumeric(FLERR, arg[d]);
  const bigint copies = bigint{grid[0]} * grid[1] * grid[2];
  const int fibres = highest_fibre();
  for (const int id : {highest, fibres})
    if (copies * id > MAXTAGINT)
      rod_error_all(lmp,
                    "Replicate: " BIGINT_FORMAT
                    " times ids up to %d need ids beyond the greatest one, %d",
                    copies, id, MAXTAGINT);
  std::vector<FibreChains::Periods> periods;
  if (find_fibres(lmp)) periods = periods_of_fibres(grid, narg, arg);
  Replicate::command(narg, arg);
  number_copies(ids, highest);
  if (find_fibres(lmp)) number_fibres(periods, grid, fibres);
}

// A fibre that lies across a periodic boundary goes on in the next copy, which must be a period away.
std::vector<FibreChains::Periods> ReplicateRods::periods_of_fibres(const int *grid, int narg,
                                                                   char **arg) const
{
  if (domain->triclinic)
    rod_error_all(lmp,
                  "Replicate: fibres of a triclinic box cannot be copied, wanted xy, xz and yz 0");
  std::vector<FibreChains::Periods> periods = FibreChains(lmp, "Replicate").periods_beyond_first();
  for (int d = 0; d < 3; d++) {
    int mine = 0, any = 0;
    for (const FibreChains::Periods &of_rod : periods) mine = mine || of_rod.number[d] != 0;
    MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
    if (!any || grid[d] == 1 || narg < 7) continue;
    constexpr double kSamePeriod = 1e-9;
    const double offset = force->numeric(FLERR, arg[4 + d]);
    if (std::fabs(offset - domain->prd[d]) > kSamePeriod * domain->prd[d])
      rod_error_all(lmp,
                    "Replicate: fibres lie across the periodic boundary along %c and want copies a "
                    "period %g apart (got offset %g)",
                    "xyz"[d], domain -> prd[d], offset);
  }
  return periods;
}

// The copies of a fibre in the order of the rods': which copy a segment belongs to follows from the copy of the
// box that it is in and from where its fibre began.
void ReplicateRods::number_fibres(const std::vector<FibreChains::Periods> &periods, const int *grid,
                                  int highest)
{
  auto &segments = rods_of(lmp, "Replicate").attached<FibreSegments>();
  const int originals = static_cast<int>(periods.size());
  const auto within = [](int number, int size) { return ((number % size) + size) % size; };
  for (int i = 0; i < atom->nlocal; i++) {
    if (!segments.is_segment(i)) continue;
    const int box = i / originals;
    const int copy[3] = {box / (grid[1] * grid[2]), box / grid[2] % grid[1], box % grid[2]};
    int number = 0;
    for (int d = 0; d < 3; d++)
      number = number * grid[d] + within(copy[d] + periods[i % originals].number[d], grid[d]);
    segments.rows[i][FibreSegments::kFibre] += static_cast<double>(number) * highest;
  }
  segments.changes++;
}

// LIGGGHTS has put the copies behind the originals, one whole copy of this rank's rods after the other, in
// the same order on all ranks.
void ReplicateRods::number_copies(const std::vector<int> &ids, int highest)
{
  auto *pair = dynamic_cast<PairGran *>(force->pair);
  auto *histories =
      pair ? dynamic_cast<FixContactHistorySpherocylinder *>(pair->get_fix_history()) : nullptr;
  const int originals = static_cast<int>(ids.size());
  for (int i = 0; i < atom->nlocal; i++) {
    const int original = i % originals, shift = i / originals * highest;
    atom->tag[i] = ids[original] + shift;
    if (histories && shift > 0) histories->copy_contacts(original, i, shift);
  }
  if (!atom->map_style) return;
  atom->map_init();
  atom->map_set();
}
