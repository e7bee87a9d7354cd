// SPDX-License-Identifier: GPL-2.0-or-later
// A start for gases: rods at random, clear of each other, in random motion.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/capsule.h"

namespace spherocylinder {

struct RodGasOptions {
  double lambda = 10.0;                                   // length / diameter, 1 or more
  double diameter = 0.01, density = 2700.0, speed = 0.5;  // m, kg/m^3, m/s
  double solid = 0.05;                                    // part of the cube's volume
  std::size_t rods = 2000;                                // placed in a cube
  std::array<int, 3> copies{1, 1, 1};                     // of the cube in x, y and z
  bool floor = false;
  unsigned long seed = 86028121;
  int segments = 1;  // of each rod, which is a fibre if there are more
};

struct GasRod {
  Segment segment;
  Vec3 velocity, omega;
};

struct RodGas {
  double side;                // of the cube, m
  std::array<double, 3> box;  // upper bounds, the lower ones are 0; periodic but for z with a floor
  std::vector<GasRod> rods;
};

// Rods are placed in a cube one after the other (random sequential addition: a trial that touches a
// rod already there is thrown away). The box is that cube repeated; each copy has velocities of its
// own. Large and small gases so have the same surroundings a rod. With a floor the box is a rod's
// length higher, and all rods are above z = 0. They come in random order, as an insertion would
// leave them.
//
// Directions: each as likely; where lambda times the solid fraction is above 3.34, those of
// Onsager's nematic along z. Each component of a velocity is normal with the standard deviation
// `speed`; omega gives a thin rod as much energy in each direction of turning, and nothing about
// its axis.
//
// Throws InputError if there is no room for all.
RodGas rod_gas(const RodGasOptions &options);

// The gas as a file for read_data of atom_style spherocylinder. With more than one segment each rod is
// a straight fibre, in a section Fibres, whose segments move as the rod does. Throws InputError for
// joints nearer than a radius.
std::string gas_data_file(const RodGasOptions &options, const RodGas &gas);

}  // namespace spherocylinder
