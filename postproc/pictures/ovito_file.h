// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "io/dump_frame.h"
#include "io/output_file.h"
#include "io/rods.h"

namespace spherocylinder {

// All frames in one extended XYZ file as OVITO reads it: the box and in which directions it is
// periodic, `aspherical_shape` (radius, radius, length of the cylinder part) and `orientation`
// (quaternion x, y, z, w that turns z to the rod's axis), id, type, velocity if the dump has it,
// elevation_deg, and every other column of the dump by its own name. Space frame, metres. (OVITO
// halves shapex of LIGGGHTS's own dumps, which it takes for a diameter, and takes half the total
// length for the height.)
class OvitoFile {
 public:
  // Throws InputError if the file cannot be written.
  explicit OvitoFile(const std::string &path);

  // Throws InputError if the box is tilted.
  void add(const DumpFrame &frame, const std::vector<Rod> &rods, double time);

  // Call when all is written: throws InputError if some of it did not reach the disk.
  void close();

 private:
  OutputFile output_;
  std::ofstream file_;
};

}  // namespace spherocylinder
