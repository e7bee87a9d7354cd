// SPDX-License-Identifier: GPL-2.0-or-later
// Gases of rods: clear of each other by search over all pairs and images, directions and velocities
// by their distributions.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "core/closest_points.h"
#include "core/numbers.h"
#include "io/input_error.h"
#include "measures/rod_gas.h"

namespace spherocylinder {
namespace {

RodGasOptions small_gas(double lambda, double solid, std::size_t rods)
{
  RodGasOptions options;
  options.lambda = lambda;
  options.solid = solid;
  options.rods = rods;
  return options;
}

double least_distance(const RodGas &gas, bool periodic_z)
{
  double least = INFINITY;
  for (std::size_t i = 0; i < gas.rods.size(); i++)
    for (std::size_t j = 0; j < i; j++)
      for (int a = -1; a <= 1; a++)
        for (int b = -1; b <= 1; b++)
          for (int c = -periodic_z; c <= periodic_z; c++) {
            Segment other = gas.rods[j].segment;
            other.centre = other.centre + Vec3{a * gas.box[0], b * gas.box[1], c * gas.box[2]};
            least = std::min(least, closest_points(gas.rods[i].segment, other).distance_squared);
          }
  return std::sqrt(least);
}

TEST(RodGas, RodsAreClearOfEachOther)
{
  for (const double lambda : {1.0, 3.0, 15.0}) {
    const RodGasOptions options = small_gas(lambda, 0.1, 200);
    const RodGas gas = rod_gas(options);
    ASSERT_EQ(gas.rods.size(), 200u);
    EXPECT_GE(least_distance(gas, true), options.diameter);
    const double r = options.diameter / 2, h = (lambda - 1) * options.diameter;
    const double rod = pi * r * r * h + 4.0 / 3.0 * pi * r * r * r;
    EXPECT_NEAR(200 * rod / (gas.box[0] * gas.box[1] * gas.box[2]), 0.1, 1e-13);
  }
}

// Copies have the same places a cube apart and velocities of their own; with a floor all lie above
// it.
TEST(RodGas, CopiesAndFloor)
{
  RodGasOptions options = small_gas(5.0, 0.05, 40);
  options.copies = {2, 1, 3};
  options.floor = true;
  const RodGas gas = rod_gas(options);
  ASSERT_EQ(gas.rods.size(), 240u);
  EXPECT_NEAR(gas.box[0], 2 * gas.side, 1e-15);
  EXPECT_NEAR(gas.box[2], 3 * gas.side + 0.05, 1e-15);
  EXPECT_GE(least_distance(gas, false), options.diameter);
  for (const GasRod &rod : gas.rods) {
    const double reach = std::abs(rod.segment.axis.z) * rod.segment.half_length + 0.005;
    EXPECT_GE(rod.segment.centre.z, reach - 1e-15);
    EXPECT_LE(rod.segment.centre.z, gas.box[2] - reach + 1e-15);
    int copies = 0;
    for (const GasRod &other : gas.rods) {
      const Vec3 d = (1.0 / gas.side) * (other.segment.centre - rod.segment.centre);
      const Vec3 off = d - Vec3{std::round(d.x), std::round(d.y), std::round(d.z)};
      if (norm(off) > 1e-9) continue;
      copies++;
      if (&other != &rod) {
        EXPECT_NE(other.velocity.x, rod.velocity.x);
      }
    }
    EXPECT_EQ(copies, 6);
  }
}

// Means and variances within four standard errors. Nematic order of f ~ cosh(a cos theta):
// <P2> = 1 + 3/a^2 - 3 coth(a)/a (Onsager 1949); those that find room are more aligned than those
// drawn.
TEST(RodGas, DirectionsAndVelocities)
{
  for (const bool nematic : {false, true}) {
    RodGasOptions options = nematic ? small_gas(40.0, 0.1, 3000) : small_gas(10.0, 0.02, 3000);
    options.speed = 0.3;
    const RodGas gas = rod_gas(options);
    const double n = 3000.0;
    double p2 = 0.0, p2_squared = 0.0, v = 0.0, v_squared = 0.0, turn = 0.0;
    Vec3 mean_axis{0, 0, 0};
    for (const GasRod &rod : gas.rods) {
      const Vec3 &u = rod.segment.axis;
      EXPECT_NEAR(norm(u), 1.0, 1e-14);
      EXPECT_NEAR(dot(rod.omega, u), 0.0, 1e-11);
      const double order = 1.5 * u.z * u.z - 0.5;
      p2 += order / n;
      p2_squared += order * order / n;
      mean_axis = mean_axis + (1.0 / n) * Vec3{u.x, u.y, 0.0};
      v += rod.velocity.x / n;
      v_squared += norm_squared(rod.velocity) / n;
      turn += norm_squared(rod.omega) / n;
    }
    const double a = 18.58, error = 4.0 * std::sqrt((p2_squared - p2 * p2) / n);
    const double drawn = nematic ? 1.0 + 3.0 / (a * a) - 3.0 / (a * std::tanh(a)) : 0.0;
    EXPECT_GE(p2, drawn - error) << nematic;
    EXPECT_LE(p2, nematic ? 0.95 : error) << nematic;
    EXPECT_NEAR(mean_axis.x, 0.0, 4.0 / std::sqrt(3.0 * n));
    EXPECT_NEAR(v, 0.0, 4.0 * 0.3 / std::sqrt(n));
    // Three squares of normal numbers: mean 3, variance 6; across the axis two: mean 2, variance 4.
    EXPECT_NEAR(v_squared / (0.3 * 0.3), 3.0, 4.0 * std::sqrt(6.0 / n));
    const double length = options.lambda * options.diameter;
    EXPECT_NEAR(turn * length * length / (12.0 * 0.3 * 0.3), 2.0, 4.0 * std::sqrt(4.0 / n));
  }
}

TEST(RodGas, SeedsTellGasesApart)
{
  RodGasOptions options = small_gas(5.0, 0.05, 20);
  const std::string first = gas_data_file(options, rod_gas(options));
  EXPECT_EQ(gas_data_file(options, rod_gas(options)), first);
  options.seed = 86028157;
  EXPECT_NE(gas_data_file(options, rod_gas(options)), first);
  EXPECT_NE(first.find("\n20 atoms\n1 atom types\n"), std::string::npos);
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 2 + 3 + 3 + 3 + 20 + 3 + 20);
}

TEST(RodGas, NoRoomIsSaid)
{
  const auto sentence = [](const RodGasOptions &options) -> std::string {
    try {
      rod_gas(options);
    } catch (const InputError &error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(sentence(small_gas(30.0, 0.05, 10)).find("wanted more than a rod and a diameter"),
            std::string::npos);
}

}  // namespace
}  // namespace spherocylinder
