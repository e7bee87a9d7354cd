// SPDX-License-Identifier: GPL-2.0-or-later
// The table of host_styles.h put into force: nothing that it refuses is done to rods.
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace spherocylinder {

// Before and after Input executes a command with its words.
void check_command_before(LAMMPS_NS::LAMMPS *lmp, const char *command, int narg, char **arg);
void check_command_after(LAMMPS_NS::LAMMPS *lmp);

// What the commands could not see: styles that LIGGGHTS has added itself, that came before the atom
// style or through the library.
void check_styles_at_run_start(LAMMPS_NS::LAMMPS *lmp);

}  // namespace spherocylinder
