// SPDX-License-Identifier: GPL-2.0-or-later
// make_bed FILE RODS LENGTH VESSEL_RADIUS HEIGHT: writes a random bed as a dump of two steps, for
// trying the post-processors by hand.
#include <cstdlib>
#include <fstream>

#include "test_bed.h"

int main(int argc, char **argv)
{
  using namespace spherocylinder;
  if (argc != 6) return 2;
  BedOptions options;
  options.rods = std::strtoul(argv[2], nullptr, 10);
  options.length = std::atof(argv[3]);
  options.vessel_radius = std::atof(argv[4]);
  options.height = std::atof(argv[5]);
  const auto rods = random_bed(options);
  std::ofstream(argv[1]) << dump_text({rods.begin(), rods.begin() + rods.size() / 2}, 0)
                         << dump_text(rods, 1000);
}
