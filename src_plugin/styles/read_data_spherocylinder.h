// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "pointers.h"

namespace LAMMPS_NS {

// The command `read_data` for rods: the file is looked through before LIGGGHTS reads it, so that
// each number is one and a mistake is told with its line.
class ReadDataSpherocylinder : protected Pointers {
 public:
  explicit ReadDataSpherocylinder(LAMMPS *lmp) : Pointers(lmp) {}
  void command(int narg, char **arg);

 private:
  std::string fault_of(const std::string &file, int narg, char **arg) const;
};

}  // namespace LAMMPS_NS
