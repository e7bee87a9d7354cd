// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/rod_driver.h"

#include <cstring>

#include "fix.h"
#include "lammps.h"
#include "modify.h"

using namespace LAMMPS_NS;

namespace {

int groups_of(LAMMPS *lmp, bool centres_only)
{
  int groups = 0;
  for (int k = 0; k < lmp->modify->nfix; k++) {
    const Fix *fix = lmp->modify->fix[k];
    const auto *driver = dynamic_cast<const RodDriver *>(fix);
    if (driver && (!centres_only || driver->drives_centres())) groups |= fix->groupbit;
  }
  return groups;
}

}  // namespace

int LAMMPS_NS::driven_groups(LAMMPS *lmp) { return groups_of(lmp, false); }

int LAMMPS_NS::groups_with_driven_centres(LAMMPS *lmp) { return groups_of(lmp, true); }

int LAMMPS_NS::frozen_groups(LAMMPS *lmp)
{
  int groups = 0;
  for (int k = 0; k < lmp->modify->nfix; k++)
    if (strcmp(lmp->modify->fix[k]->style, "freeze") == 0) groups |= lmp->modify->fix[k]->groupbit;
  return groups;
}
