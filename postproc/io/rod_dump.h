// SPDX-License-Identifier: GPL-2.0-or-later
// The capsules of glued rods as a dump of true ones, which every post-processor reads, or as a
// start for the plug-in.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "io/dump_frame.h"
#include "io/glued_rods.h"
#include "io/output_file.h"

namespace spherocylinder {

class RodDump {
 public:
  explicit RodDump(const std::string &path);  // throws InputError if it cannot be written

  // A frame as `dump custom` writes it: id type x y z shapex shapey shapez quat1..4, vx vy vz and
  // omegax omegay omegaz if `frame` has velocities, density if it has that, and of each rod
  // spheres, deviation and spacing (largest). Places are named as in `frame`, but for scaled ones.
  // Numbers have the digits of `frame`, so that what is worked out from their roundings holds. A
  // capsule's quaternion is the shortest turn: its spheres do not tell how far it has turned about
  // its axis.
  void add(const DumpFrame &frame, const std::vector<GluedRod> &rods);

  void close();  // throws InputError if it did not reach the disk

 private:
  OutputFile output_;
  std::ofstream file_;
};

// The same rods as a file for read_data of atom_style spherocylinder. `density` (kg/m^3) is that of
// all rods; without it each has its own. Throws InputError where there is none.
std::string rod_data_file(const DumpFrame &frame, const std::vector<GluedRod> &rods,
                          std::optional<double> density);

}  // namespace spherocylinder
