// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// What a data file is read into.
struct DataFileSurroundings {
  bool adds = false;  // `read_data FILE add`: types and box are those that are there
  int types = 0;
  double lo[3] = {-0.5, -0.5, -0.5};  // LIGGGHTS's default for a box
  double hi[3] = {0.5, 0.5, 0.5};
  bool periodic[3] = {false, false, false};
  std::vector<std::string> fix_headers, fix_sections;  // that fixes read themselves
};

struct DataFileVerdict {
  std::string fault;        // empty if there is none
  bool has_fibres = false;  // a section Fibres
};

// The first thing that is wrong in a data file of rods, as "line 12, atom 3: x must be a number
// (got abc)", and what is in it. LIGGGHTS reads numbers by atof and atoi, which take a word for
// 0, and lines by their count. What LIGGGHTS itself refuses by name, such as an unknown section, is
// left to it.
DataFileVerdict look_through_data_file(FILE *file, const DataFileSurroundings &surroundings);

}  // namespace LAMMPS_NS
