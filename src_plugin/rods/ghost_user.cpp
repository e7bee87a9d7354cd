// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/ghost_user.h"

#include "fix.h"
#include "lammps.h"
#include "modify.h"

using namespace LAMMPS_NS;

void LAMMPS_NS::add_used_ghosts(LAMMPS *lmp, std::vector<int> &ghosts)
{
  for (int k = 0; k < lmp->modify->nfix; k++)
    if (const auto *user = dynamic_cast<const GhostUser *>(lmp->modify->fix[k]))
      user->add_used_ghosts(ghosts);
}
