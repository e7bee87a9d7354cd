// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

namespace LAMMPS_NS {

class LAMMPS;

// What fix wall/gran of rods understands beyond LIGGGHTS: the position of a plane or the radius of
// a cylinder as a variable, and a plane that turns about a normal of its. LIGGGHTS is given the rest.
struct WallArguments {
  std::vector<char *> others;  // for LIGGGHTS
  std::string variable;        // without v_, empty if the position or radius is a number
  bool turns = false;
  double turning = 0.0;           // rad/s
  double centre[2] = {0.0, 0.0};  // of it, in the plane (m): y z, z x or x y

  WallArguments(LAMMPS *lmp, int narg, char **arg);
};

}  // namespace LAMMPS_NS
