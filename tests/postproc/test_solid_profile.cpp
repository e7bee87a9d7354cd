// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "core/numbers.h"
#include "core/parallel.h"
#include "io/input_error.h"
#include "measures/packing_measures.h"
#include "measures/solid_profile.h"
#include "solid/capsule_measures.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

std::vector<Rod> bed()
{
  BedOptions options;
  options.rods = 60;
  return random_bed(options);
}

double sum_of(const std::vector<ProfileBin> &bins)
{
  double sum = 0.0;
  for (const ProfileBin &bin : bins) sum += bin.solid;
  return sum;
}

double region_of(const std::vector<ProfileBin> &bins)
{
  double sum = 0.0;
  for (const ProfileBin &bin : bins) sum += bin.region;
  return sum;
}

TEST(SolidProfile, BinEdges)
{
  EXPECT_EQ(bin_edges(0.0, 1.0, 0.25), (std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0}));
  EXPECT_EQ(bin_edges(0.0, 1.1, 0.5), (std::vector<double>{0.0, 0.5, 1.0, 1.1}));
  EXPECT_EQ(bin_edges(0.0, 1.0 + 1e-9, 0.5).size(), 3u);
  EXPECT_EQ(bin_edges(0.0, 0.1, 0.5), (std::vector<double>{0.0, 0.1}));
  EXPECT_THROW(bin_edges(0.0, 1.0, 1e-9), InputError);
}

// Layers add up to all rods, each with what clipped_volume finds in it.
TEST(SolidProfile, Heights)
{
  const auto rods = bed();
  const auto bins = height_profile(rods, 2.0, -0.1, bin_edges(0.0, 0.6, 0.03));
  const double all = total_volume(rods);
  EXPECT_NEAR(sum_of(bins), all, 1e-13 * all);
  for (const ProfileBin &bin : bins) {
    EXPECT_NEAR(bin.region, 2.0 * (bin.high - bin.low), 1e-15);
    const SolidFraction layer =
        solid_fraction(rods, {0, 0, 10, bin.low - 0.1, bin.high - 0.1}, 1e-6);
    const double space = volume(layer.region);
    EXPECT_NEAR(bin.solid, layer.fraction * space, layer.error * space + 1e-12 * all);
  }
}

// Shells add up to what the vessel holds, and each agrees with the bounds of clipped_volume.
TEST(SolidProfile, ShellsAgainstBounds)
{
  const auto rods = bed();
  const UprightCylinder vessel{0.01, -0.02, 0.1, 0.02, 0.2};
  const SolidFraction whole = solid_fraction(rods, vessel, 1e-6);
  const double space = volume(vessel), solid = whole.fraction * space;
  constexpr double kTolerance = 1e-4;
  const auto radius = radius_profile(rods, vessel, bin_edges(0.0, 0.1, 0.01), kTolerance);
  const auto wall = wall_profile(rods, vessel, bin_edges(0.0, 0.1, 0.01), kTolerance);
  EXPECT_NEAR(region_of(radius), space, 1e-14);
  EXPECT_NEAR(region_of(wall), space, 1e-14);
  EXPECT_NEAR(sum_of(radius), solid, 1e-4 * solid);
  EXPECT_NEAR(sum_of(wall), solid, 1e-4 * solid);
  double inner = 0.0;
  for (const ProfileBin &bin : radius) {
    const UprightCylinder within{vessel.x, vessel.y, bin.high, vessel.z_low, vessel.z_high};
    const SolidFraction found = solid_fraction(rods, within, 1e-6);
    const double outer = found.fraction * volume(within);
    // 1e-5: the other method's own bounds.
    EXPECT_NEAR(bin.solid, outer - inner, bin.error + 1e-5 * bin.solid) << bin.low;
    EXPECT_LE(bin.error, 1.01 * kTolerance * bin.solid) << bin.low;
    inner = outer;
  }
  double outer = solid;
  for (const ProfileBin &bin : wall) {
    const UprightCylinder beyond{vessel.x, vessel.y, vessel.radius - bin.high,
                                 vessel.z_low + bin.high, vessel.z_high};
    double rest = 0.0;
    if (&bin != &wall.back()) {
      const SolidFraction found = solid_fraction(rods, beyond, 1e-6);
      rest = found.fraction * volume(beyond);
    }
    EXPECT_NEAR(bin.solid, outer - rest, bin.error + 1e-5 * bin.solid) << bin.low;
    outer = rest;
  }
}

// A tube of radius r upright on the axis fills all shells up to r and nothing beyond.
TEST(SolidProfile, UprightRodOnTheAxis)
{
  const std::vector<Rod> rods{{1, 1, {{{0, 0, 0}, {0, 0, 1}, 5.0}, 0.3}}};
  const auto bins = radius_profile(rods, {0, 0, 1, -1, 1}, {0.0, 0.1, 0.2, 0.3, 0.5, 1.0}, 1e-4);
  for (const ProfileBin &bin : bins)
    EXPECT_NEAR(bin.fraction(), bin.high <= 0.3 ? 1.0 : 0.0, 1e-3) << bin.low;
  EXPECT_NEAR(sum_of(bins), pi * 0.09 * 2.0, 1e-12);  // the outer shells hold the rod whole
}

// Rods of no thickness to speak of, spread evenly: the same fraction in every bin.
TEST(SolidProfile, EvenFillIsFlat)
{
  std::vector<Rod> rods;
  const int n = 40;
  for (int i = -n; i <= n; i++)
    for (int j = -n; j <= n; j++)
      rods.push_back({1, 1, {{{0.05 * i, 0.05 * j, 0.0}, {0, 0, 1}, 5.0}, 0.005}});
  const double even = pi * 0.005 * 0.005 / (0.05 * 0.05);
  for (const ProfileBin &bin :
       wall_profile(rods, {0, 0, 1.7, 0, 2}, bin_edges(0.0, 1.7, 0.425), 1e-4))
    EXPECT_NEAR(bin.fraction(), even, 0.03 * even) << bin.low;  // a grid's rods in a ring
}

// OMP_NUM_THREADS may hold a list; what cannot be meant is as if it were not there, and refused by the tools.
TEST(Parallel, AsManyThreadsAsAskedFor)
{
  const char *before = std::getenv("OMP_NUM_THREADS");
  const std::string kept = before ? before : "";
  for (const auto &[text, threads] : std::map<std::string, std::size_t>{{"1", 1}, {"3,2", 3}}) {
    setenv("OMP_NUM_THREADS", text.c_str(), 1);
    EXPECT_EQ(thread_count(), threads);
    std::mutex mutex;
    std::set<std::thread::id> seen;
    for_each_piece(100, 1, [&](std::size_t, std::size_t) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
    EXPECT_LE(seen.size(), threads);
    EXPECT_GE(seen.size(), std::min<std::size_t>(threads, 2));
  }
  for (const char *wrong : {"0", "-2", "two", "2.5", "", "1025", "3;2"})
    EXPECT_FALSE(threads_in(wrong)) << wrong;
  setenv("OMP_NUM_THREADS", "two", 1);
  EXPECT_EQ(thread_count(), std::max(std::thread::hardware_concurrency(), 1u));
  unsetenv("OMP_NUM_THREADS");
  if (before) setenv("OMP_NUM_THREADS", kept.c_str(), 1);
}

// An earlier piece's exception wins, whatever thread it was in.
TEST(Parallel, PiecesAndExceptions)
{
  std::vector<int> hits(1000, 0);
  for_each_piece(hits.size(), 7, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) hits[i]++;
  });
  EXPECT_EQ(hits, std::vector<int>(1000, 1));
  for_each_piece(0, 7, [](std::size_t, std::size_t) { FAIL(); });
  try {
    for_each_piece(100, 10, [](std::size_t begin, std::size_t) {
      if (begin >= 30) throw static_cast<int>(begin);
    });
    FAIL();
  } catch (int begin) {
    EXPECT_EQ(begin, 30);
  }
}

}  // namespace
}  // namespace spherocylinder
