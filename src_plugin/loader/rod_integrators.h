// SPDX-License-Identifier: GPL-2.0-or-later
// Which fix moves which rod: exactly one of fix nve/spherocylinder and fix move, or fix freeze keeps
// it where it is.
#pragma once

namespace LAMMPS_NS {

class LAMMPS;

// Called by all ranks at the start of each run. Returns the groups whose rods are moved or frozen
// (all groups where nothing runs).
int check_each_rod_is_integrated_once(LAMMPS *lmp);

// Rods that have come in during the run must be in one of those groups, too.
void check_new_rods_are_integrated(LAMMPS *lmp, int groups);

}  // namespace LAMMPS_NS
