// SPDX-License-Identifier: GPL-2.0-or-later
// Beds and dump files for the tests of the post-processors.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "io/rods.h"

namespace spherocylinder {

struct BedOptions {
  std::size_t rods = 500;
  double diameter = 0.01;  // m
  double length = 0.1;     // total, m
  double vessel_radius = 0.105;
  double height = 0.25;   // centres lie below it (m)
  double flatness = 2.0;  // u_z is scaled by 1/flatness before u is normalised: 1 is isotropic
  unsigned seed = 86028121;
};

// Random sequential addition: rods at random places and directions that overlap neither each
// other nor the vessel. Fewer than asked for if there is no room.
std::vector<Rod> random_bed(const BedOptions &options);

// One frame as LIGGGHTS's `dump custom` writes it: "%g", blanks at the line ends, and a column
// c_contacts and velocities that hold made-up numbers.
std::string dump_text(const std::vector<Rod> &rods, std::int64_t step);

// `count` directions spread evenly over the sphere (Fibonacci lattice): isotropic up to 1/count.
std::vector<Vec3> even_directions(std::size_t count);

// `count` directions at random, uniform on the sphere.
std::vector<Vec3> random_directions(std::size_t count, std::mt19937 &random);

}  // namespace spherocylinder
