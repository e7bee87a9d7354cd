// SPDX-License-Identifier: GPL-2.0-or-later
// place_rods: rods at random in a periodic box, in random motion, as a data file.
// docs/place_rods.md
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command_line.h"
#include "io/output_file.h"
#include "measures/rod_gas.h"

using namespace spherocylinder;

int main(int argc, char **argv)
{
  RodGasOptions options;
  std::vector<int> copies{1, 1, 1};
  std::string out = "gas.data";
  CLI::App app("Rods at random in a periodic box, in random motion, as a file for read_data.",
               "place_rods");
  app.footer(
      "Example: place_rods --lambda 10 --solid 0.05 --rods 2000 --out gas.data\n"
      "         place_rods --lambda 30 --solid 0.15 --rods 2000 --copies 5 2 1 --floor\n"
      "         place_rods --lambda 30 --solid 0.05 --rods 500 --segments 8 --out fibres.data");
  constexpr double kMost = 1e6;
  app.add_option("--lambda", options.lambda, "aspect ratio of the rods, length / diameter")
      ->check(number_between(1.0, kMost))
      ->capture_default_str();
  app.add_option("--solid", options.solid, "part of the volume that is rods")
      ->check(number_between(1e-12, 0.7))
      ->capture_default_str();
  app.add_option("--rods", options.rods, "rods that are placed")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  app.add_option("--copies", copies, "of the cube they lie in, in x, y and z")
      ->expected(3)
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--diameter", options.diameter, "of a rod (m)")
      ->check(number_between(1e-12, kMost))
      ->capture_default_str();
  app.add_option("--density", options.density, "of a rod (kg/m^3)")
      ->check(positive_number())
      ->capture_default_str();
  app.add_option("--speed", options.speed,
                 "standard deviation of each component of a velocity (m/s)")
      ->check(number_between(0.0, kMost))
      ->capture_default_str();
  app.add_flag("--floor", options.floor,
               "not periodic in z: the box is a rod's length higher, all rods above z = 0");
  app.add_option("--segments", options.segments,
                 "of each rod: more than one make it a straight fibre for fix joint/spherocylinder")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the random numbers")
      ->check(CLI::NonNegativeNumber)  // a sign would be wrapped around
      ->check(CLI::Range(0ul, std::numeric_limits<unsigned long>::max()))
      ->capture_default_str();
  app.add_option("--out", out, "FILE to write")->capture_default_str();
  return run_tool(app, argc, argv, [&] {
    for (int d = 0; d < 3; d++) options.copies[d] = copies[d];
    const RodGas gas = rod_gas(options);
    write_file(out, gas_data_file(options, gas));
    fmt::print("{} {} in a box of {:.6g} x {:.6g} x {:.6g} m: {}\n", gas.rods.size(),
               options.segments == 1 ? "rods"
                                     : fmt::format("fibres of {} segments", options.segments),
               gas.box[0], gas.box[1], gas.box[2], out);
  });
}
