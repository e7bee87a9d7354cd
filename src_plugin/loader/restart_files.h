// SPDX-License-Identifier: GPL-2.0-or-later
// Restart files that are whole or refused. They are written beside their place and put there when the
// disk has all of them, with a closing mark (host/closing_mark.h); read only if the mark is right.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace spherocylinder {

// By all ranks: `write` writes LIGGGHTS's part under the name it is given.
void write_whole_restart(LAMMPS_NS::LAMMPS *lmp, const std::string &name,
                         const std::function<void(const std::string &)> &write);

// Before the command read_restart, whose last word `unchecked` is taken away: refuses a file that is not
// whole. The lines of its mark go to what follows.
std::vector<std::string> check_restart_before_it_is_read(LAMMPS_NS::LAMMPS *lmp, int &narg,
                                                         char **arg);
void restart_was_read(LAMMPS_NS::LAMMPS *lmp, const std::vector<std::string> &lines);

// After the command write_data.
void say_what_a_data_file_lacks(LAMMPS_NS::LAMMPS *lmp);

// The deck's words about contacts, which go into restart files.
void keep_models(LAMMPS_NS::LAMMPS *lmp, const char *command, int narg, char **arg);

// When a run begins after a restart was read: says which models and walls are others than the file's.
void say_which_models_differ(LAMMPS_NS::LAMMPS *lmp);

// When that run begins, and when it is set up: its first step takes the forces of the file, if it was written
// within a run and neither rods nor what acts on them is another now.
void look_at_restarted_rods(LAMMPS_NS::LAMMPS *lmp);
void go_on_with_forces(LAMMPS_NS::LAMMPS *lmp);

// When the first run is set up, and nothing is drawn before its first step.
void go_on_with_random_numbers(LAMMPS_NS::LAMMPS *lmp);

}  // namespace spherocylinder
