// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pointers.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;

// The command `set` for rods. What makes up a rod (size, density, orientation, spin) is set here,
// together and with all that follows from it; every other keyword is handed to LIGGGHTS's own Set.
class SetSpherocylinder : protected Pointers {
 public:
  explicit SetSpherocylinder(LAMMPS *lmp);
  void command(int narg, char **arg);

 private:
  // A number, or an equal- or atom-style variable as it stands when the command begins.
  struct Value {
    double constant = 0.0;
    std::vector<double> per_rod;
    double at(int i) const { return per_rod.empty() ? constant : per_rod[i]; }
  };
  struct Setting {
    std::string keyword;
    std::vector<Value> values;
  };

  AtomVecSpherocylinder &rods_;

  std::vector<int> chosen(const char *style, const char *id) const;
  Value value_of(const char *keyword, const char *word) const;
  void apply(const std::vector<Setting> &settings, const std::vector<int> &chosen);
  void apply_size(const std::vector<Setting> &settings, int i);
  void apply_orientation(const Setting &setting, int i);
  void report(const Setting &setting, const std::vector<int> &chosen) const;
};

}  // namespace LAMMPS_NS
