// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "pointers.h"
#include "styles/data_file_check.h"

namespace LAMMPS_NS {

// The command `read_data` for rods: the file is looked through before LIGGGHTS reads it, so that
// each number is one and a mistake is told with its line; its section Fibres is read, too.
class ReadDataSpherocylinder : protected Pointers {
 public:
  explicit ReadDataSpherocylinder(LAMMPS *lmp) : Pointers(lmp) {}
  void command(int narg, char **arg);

 private:
  DataFileVerdict look_through(const std::string &file, int narg, char **arg) const;
  void read_with_fibres(int narg, char **arg);
};

}  // namespace LAMMPS_NS
