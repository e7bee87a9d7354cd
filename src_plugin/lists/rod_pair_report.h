// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {

class LAMMPS;

// Writes to screen and log file, after a run with rods, what the lists of rod pairs held and how often
// they were made again. All ranks have to call it.
void report_rod_pairs(LAMMPS *lmp);

}  // namespace LAMMPS_NS
