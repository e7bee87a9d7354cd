// SPDX-License-Identifier: GPL-2.0-or-later
// Insertion goes on from a restart file with the random numbers that it would have drawn: LIGGGHTS's part has
// those of some fixes of the first rank, and begins the regions' anew.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace spherocylinder {

// A line for each stream of random numbers, with its state on each rank. By all ranks.
std::vector<std::string> random_lines(LAMMPS_NS::LAMMPS *lmp);

bool is_random_line(const std::string &line);

// Sets the streams that the lines name and that are there, if as many ranks wrote them.
void set_random_streams(LAMMPS_NS::LAMMPS *lmp, const std::vector<std::string> &lines);

}  // namespace spherocylinder
