// SPDX-License-Identifier: GPL-2.0-or-later
// Near pairs of rods, and what is measured of contacts.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "analysis/close_pairs.h"
#include "analysis/input_error.h"
#include "core/closest_points.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

constexpr double pi = 3.14159265358979323846;

Rod rod(const Vec3 &centre, const Vec3 &axis, double half_length, double radius)
{
  return {1, 1, {{centre, axis, half_length}, radius}};
}

std::vector<Vec3> random_axes(std::size_t count, std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  std::vector<Vec3> axes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 u{normal(random), normal(random), normal(random)};
    axes.push_back((1.0 / norm(u)) * u);
  }
  return axes;
}

// Rods at random places and directions that know nothing of each other.
std::vector<Rod> ideal_gas(std::size_t count, double side, double half_length, double radius,
                           unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, side);
  std::vector<Rod> rods;
  for (const Vec3 &axis : random_axes(count, random))
    rods.push_back(
        rod({place(random), place(random), place(random)}, axis, half_length, radius));
  return rods;
}

using Found = std::tuple<std::uint32_t, std::uint32_t, double, double, double>;

// All pairs of all rods with all images of all others, one by one.
std::vector<Found> pairs_by_brute_force(const std::vector<Rod> &rods, const Periodicity &box,
                                        double gap)
{
  std::vector<Found> found;
  const auto images = [&](int d) { return box.side[d] > 0.0 ? 2 : 0; };
  for (std::uint32_t i = 0; i < rods.size(); ++i)
    for (std::uint32_t j = i + 1; j < rods.size(); ++j)
      for (int x = -images(0); x <= images(0); ++x)
        for (int y = -images(1); y <= images(1); ++y)
          for (int z = -images(2); z <= images(2); ++z) {
            Segment moved = rods[j].capsule.segment;
            moved.centre =
                moved.centre + Vec3{x * box.side[0], y * box.side[1], z * box.side[2]};
            const ClosestPoints points = closest_points(rods[i].capsule.segment, moved);
            const double g = std::sqrt(points.distance_squared) - rods[i].capsule.radius -
                             rods[j].capsule.radius;
            if (g < gap) found.push_back({i, j, g, points.s, points.t});
          }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Found> pairs_found(const std::vector<Rod> &rods, const Periodicity &box, double gap)
{
  std::vector<Found> found;
  for (const ClosePair &pair : close_pairs(rods, box, gap))
    found.push_back({pair.i, pair.j, pair.gap, pair.s, pair.t});
  std::sort(found.begin(), found.end());
  return found;
}

void expect_same_pairs(const std::vector<Rod> &rods, const Periodicity &box, double gap,
                       std::size_t least)
{
  const auto found = pairs_found(rods, box, gap), wanted = pairs_by_brute_force(rods, box, gap);
  EXPECT_GE(wanted.size(), least);
  ASSERT_EQ(found.size(), wanted.size());
  const double length = rods[0].capsule.length();
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(std::get<0>(found[k]), std::get<0>(wanted[k]));
    EXPECT_EQ(std::get<1>(found[k]), std::get<1>(wanted[k]));
    // Round-off of coordinates of the size of the box.
    EXPECT_NEAR(std::get<2>(found[k]), std::get<2>(wanted[k]), 1e-13);
    EXPECT_NEAR(std::get<3>(found[k]), std::get<3>(wanted[k]), 1e-9 * length);
    EXPECT_NEAR(std::get<4>(found[k]), std::get<4>(wanted[k]), 1e-9 * length);
  }
}

TEST(ClosePairs, AreThoseOfAllPairs)
{
  for (const double half : {0.0, 0.01, 0.045, 0.3}) {
    SCOPED_TRACE(half);
    expect_same_pairs(ideal_gas(300, 0.4, half, 0.005, 11), {}, 0.002, half > 0.02 ? 100 : 0);
    expect_same_pairs(ideal_gas(300, 0.1, half, 0.005, 12), {}, 0.0, 100);
  }
}

TEST(ClosePairs, AreThoseOfAllPairsAndImages)
{
  Periodicity box{{0.12, 0.0, 0.2}};
  auto rods = ideal_gas(120, 0.12, 0.05, 0.005, 13);
  expect_same_pairs(rods, box, 0.001, 500);
  // Rods may lie outside the box: unwrapped coordinates, up to a box away here.
  for (std::size_t i = 0; i < rods.size(); i += 3) rods[i].capsule.segment.centre.x -= 0.12;
  expect_same_pairs(rods, box, 0.001, 500);
}

TEST(ClosePairs, OfMixedSizesAndOneFarAway)
{
  auto rods = ideal_gas(200, 0.1, 0.03, 0.004, 14);
  const auto balls = ideal_gas(100, 0.1, 0.0, 0.011, 15);
  rods.insert(rods.end(), balls.begin(), balls.end());
  rods.push_back(rod({1e7, -1e6, 5.0}, {0, 0, 1}, 0.1, 0.01));
  expect_same_pairs(rods, {}, 0.0, 100);
}

// Side by side, at the same height: any point of the common length is a closest one; the pair must
// come once all the same.
TEST(ClosePairs, ParallelRodsComeOnce)
{
  std::vector<Rod> rods;
  for (int i = 0; i < 20; ++i)
    rods.push_back(rod({0.01 * i, 0, 0.003 * (i % 4)}, {0, 0, 1}, 0.15, 0.005));
  EXPECT_EQ(close_pairs(rods, {}, 1e-6).size(), 19u);
  EXPECT_EQ(close_pairs(rods, {}, 0.0101).size(), 19u + 18u);
  EXPECT_EQ(close_pairs(rods, {{0.2, 0, 0}}, 1e-6).size(), 20u);  // and the last with the first
}

TEST(ClosePairs, NormalPointsToTheFirst)
{
  // Crossed at right angles, j 0.009 above i: they overlap by 0.001, touching at s = 0.02, t = -0.01.
  const std::vector<Rod> rods{rod({0, 0, 0}, {1, 0, 0}, 0.05, 0.005),
                              rod({0.02, 0.01, 0.009}, {0, 1, 0}, 0.05, 0.005)};
  const auto pairs = close_pairs(rods, {}, 0.0);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].gap, -0.001, 1e-15);
  EXPECT_NEAR(pairs[0].s, 0.02, 1e-15);
  EXPECT_NEAR(pairs[0].t, -0.01, 1e-15);
  EXPECT_NEAR(pairs[0].normal.z, -1.0, 1e-15);
  EXPECT_NEAR(pairs[0].sin_gamma, 1.0, 1e-15);
}

TEST(ClosePairs, BoxesThatAreTooSmall)
{
  const std::vector<Rod> rods{rod({0, 0, 0}, {1, 0, 0}, 0.05, 0.005)};
  EXPECT_NO_THROW(close_pairs(rods, {{0.11, 0, 0}}, 0.0));
  EXPECT_THROW(close_pairs(rods, {{0.1099, 0, 0}}, 0.0), InputError);
  const std::vector<Rod> ball{rod({0, 0, 0}, {1, 0, 0}, 0.0, 0.005)};
  EXPECT_NO_THROW(close_pairs(ball, {{0.035, 0, 0}}, 0.0));
  EXPECT_THROW(close_pairs(ball, {{0.034, 0, 0}}, 0.0), InputError);
}

}  // namespace
}  // namespace spherocylinder
