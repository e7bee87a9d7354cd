// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <istream>
#include <string>

namespace LAMMPS_NS {

// The first thing that is wrong in an STL file of text, as "line 12: a vertex must have three numbers (got
// x y)"; empty if nothing is. LIGGGHTS reads numbers by atof, which takes a word for 0, reads beyond the
// end of a line that is too short, and takes a file that breaks off for a whole one. What it refuses itself
// is left to it, as are binary files.
std::string fault_of_stl_file(std::istream &file);

}  // namespace LAMMPS_NS
