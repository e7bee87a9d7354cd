// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/replicate_rods.h"

#include <algorithm>
#include <cstring>

#include <mpi.h>

#include "atom.h"
#include "fix.h"
#include "force.h"
#include "host/rod_error.h"
#include "modify.h"
#include "pair_gran.h"
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

void ReplicateRods::command(int narg, char **arg)
{
  if (modify->fix_restart_in_progress())
    rod_error_all(
        lmp, "Replicate must come after the first run (run 0 will do) when rods with contacts have "
             "been read from a restart file");
  if (find_fibres(lmp))
    rod_error_all(lmp,
                  "Replicate: copies of fibres would have the fibre ids of their originals; join "
                  "the copies instead (fix joint/spherocylinder ... join after replicate)");
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
  const bigint copies = narg < 3
                            ? 1
                            : bigint{force->inumeric(FLERR, arg[0])} *
                                  force->inumeric(FLERR, arg[1]) * force->inumeric(FLERR, arg[2]);
  if (copies * highest > MAXTAGINT)
    rod_error_all(
        lmp, "Replicate: " BIGINT_FORMAT " times ids up to %d need ids beyond the greatest one, %d",
        copies, highest, MAXTAGINT);
  Replicate::command(narg, arg);
  number_copies(ids, highest);
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
