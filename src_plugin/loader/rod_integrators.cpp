// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/rod_integrators.h"

#include <algorithm>
#include <climits>
#include <cstring>

#include "atom.h"
#include "fix.h"
#include "group.h"
#include "host/rod_error.h"
#include "lammps.h"
#include "modify.h"
#include "rods/rod_driver.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

constexpr int kAllGroups = -1;

bool turns_rods(const Fix *fix)
{
  return strcmp(fix->style, "nve/spherocylinder") == 0 || strcmp(fix->style, "move") == 0;
}

bigint count_rods(LAMMPS *lmp, int all_of)
{
  const Atom *atom = lmp->atom;
  bigint local = 0, total = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & all_of) == all_of) local++;
  MPI_Allreduce(&local, &total, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  return total;
}

// Two integrators of the same rod: by group if there are no rods yet, by rod otherwise.
void check_against_earlier(LAMMPS *lmp, int at)
{
  const Fix *fix = lmp->modify->fix[at];
  for (int k = 0; k < at; k++) {
    const Fix *other = lmp->modify->fix[k];
    if (!other->time_integrate) continue;
    const bigint twice = count_rods(lmp, fix->groupbit | other->groupbit);
    if (fix->groupbit == other->groupbit || twice > 0)
      rod_error_all(lmp,
                    "Fix %s (id %s) integrates group %s, of which " BIGINT_FORMAT
                    " rods are also integrated by fix %s (id %s); a rod wants exactly one "
                    "integrator",
                    fix->style, fix->id, lmp->group->names[fix->igroup], twice, other->style,
                    other->id);
  }
}

// The lowest id of the rods in none of the groups, INT_MAX if there is none; `count` of them here.
int first_still(LAMMPS *lmp, int groups, bigint &count)
{
  const Atom *atom = lmp->atom;
  int first = INT_MAX;
  count = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->mask[i] & groups) continue;
    count++;
    first = std::min(first, atom->tag[i]);
  }
  return first;
}

}  // namespace

int LAMMPS_NS::check_each_rod_is_integrated_once(LAMMPS *lmp)
{
  if (lmp->update->whichflag != 1 || lmp->update->nsteps == 0) return kAllGroups;

  const Modify *modify = lmp->modify;
  int groups = frozen_groups(lmp);
  for (int i = 0; i < modify->nfix; i++) {
    const Fix *fix = modify->fix[i];
    if (!fix->time_integrate) continue;
    if (!turns_rods(fix))
      rod_error_all(
          lmp,
          "Fix %s (id %s) does not turn the axes of rods (expected fix "
          "nve/spherocylinder, fix move for driven rods or fix freeze for rods that stay)",
          fix->style, fix->id);
    check_against_earlier(lmp, i);
    groups |= fix->groupbit;
  }
  if (!groups)
    rod_error_all(lmp, "Atom style spherocylinder: no integrator is defined, rods would not move "
                       "(expected fix ID group nve/spherocylinder)");

  bigint local = 0, still = 0;
  const int mine = first_still(lmp, groups, local);
  int first = mine;
  MPI_Allreduce(&local, &still, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, lmp->world);
  if (still > 0)
    rod_error_all(lmp,
                  "Atom style spherocylinder: " BIGINT_FORMAT
                  " rods (the first is rod %d) are in no integrator's group (expected fix "
                  "nve/spherocylinder, fix move for driven rods or fix freeze for rods that stay)",
                  still, first);
  return groups;
}

void LAMMPS_NS::check_new_rods_are_integrated(LAMMPS *lmp, int groups)
{
  // Between runs rods may wait for their group and integrator.
  if (lmp->update->whichflag != 1) return;
  bigint count = 0;
  const int first = first_still(lmp, groups, count);
  if (count > 0)
    rod_error_one(
        lmp,
        "Atom style spherocylinder: at step " BIGINT_FORMAT
        " rod %d has come into the run and is in no integrator's group (expected fix "
        "nve/spherocylinder, fix move or fix freeze for a group that it is inserted into)",
        lmp->update->ntimestep, first);
}
