// SPDX-License-Identifier: GPL-2.0-or-later
// The grid search against the test of every pair.
#include "core/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/closest_points.h"
#include "core/skin.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

using Pairs = std::vector<std::pair<int, int>>;

Pairs by_grid(NearPairs &near, const std::vector<Capsule> &rods, int owned, double gap)
{
  near.find(rods, owned, gap);
  Pairs pairs;
  for (int i = 0; i < owned; i++)
    for (int k = near.first(i); k < near.first(i + 1); k++)
      pairs.emplace_back(i, near.partners()[k]);
  return pairs;
}

Pairs by_trying_all(const std::vector<Capsule> &rods, int owned, double gap)
{
  Pairs pairs;
  for (int i = 0; i < owned; i++)
    for (int j = i + 1; j < static_cast<int>(rods.size()); j++) {
      const double reach = rods[i].radius + rods[j].radius + gap;
      if (closest_points(rods[i].segment, rods[j].segment).distance_squared < reach * reach)
        pairs.emplace_back(i, j);
    }
  return pairs;
}

struct Bed {
  const char *name;
  double aspect_ratio;  // of the longest
  double box;           // edge, in lengths of the longest
  double thinnest;      // of the diameters, as a part of the thickest
  bool spheres_too, lattice;
};

void PrintTo(const Bed &bed, std::ostream *out) { *out << bed.name; }

std::vector<Capsule> make(const Bed &bed, double diameter, int count, RandomRods &random)
{
  std::vector<Capsule> rods;
  const double length = bed.aspect_ratio * diameter;
  for (int k = 0; k < count; k++) {
    Capsule rod;
    rod.radius = 0.5 * diameter * random.uniform(bed.thinnest, 1.0);
    rod.segment.half_length =
        bed.spheres_too && k % 3 == 0 ? 0.0 : 0.5 * (length - diameter) * random.uniform(0.3, 1.0);
    rod.segment.centre = random.vector(0.5 * bed.box * length);
    rod.segment.axis = random.direction();
    if (bed.lattice) {
      // Along the edges of the grid's cells, at whole diameters: nothing rounds to one side.
      const int dimension = random.below(3);
      rod.segment.axis = {dimension == 0 ? 1.0 : 0.0, dimension == 1 ? 1.0 : 0.0,
                          dimension == 2 ? 1.0 : 0.0};
      const auto whole = [&](double place) { return std::round(place / diameter) * diameter; };
      rod.segment.centre = {whole(rod.segment.centre.x), whole(rod.segment.centre.y),
                            whole(rod.segment.centre.z)};
    }
    rods.push_back(rod);
  }
  return rods;
}

class NearPairsOf : public testing::TestWithParam<Bed> {};

}  // namespace

// The same pairs in the same order, at all scales, for gaps from none to many diameters, with half of
// the rods as partners only. Distances of the two methods differ by rounding, which random rods do not
// meet and which the gaps of the lattice, odd parts of a diameter, keep away from.
TEST_P(NearPairsOf, AreThoseOfTheSlowSearch)
{
  RandomRods random(15487469);
  NearPairs near;
  size_t found = 0;
  for (const double diameter : kDiameters)
    for (const double gap : {0.0, 0.13, 1.37, 6.11})
      for (const bool ghosts : {false, true}) {
        const std::vector<Capsule> rods = make(GetParam(), diameter, 300, random);
        const int owned = ghosts ? 150 : 300;
        const Pairs slow = by_trying_all(rods, owned, gap * diameter);
        ASSERT_EQ(by_grid(near, rods, owned, gap * diameter), slow)
            << "diameter " << diameter << ", gap " << gap;
        found += slow.size();
      }
  EXPECT_GT(found, 1000u);
}

// Some rods and ghosts move, again and again: their pairs, and only theirs, each once. Far moves leave the
// grid, which all are entered in anew then.
TEST_P(NearPairsOf, AreFoundAgainOfRodsThatMoved)
{
  RandomRods random(32452843);
  NearPairs near;
  size_t found = 0;
  int again = 0, anew = 0;
  for (const bool ghosts : {false, true}) {
    std::vector<Capsule> rods = make(GetParam(), 1.0, 300, random);
    const int owned = ghosts ? 150 : 300;
    constexpr double kGap = 1.37;
    near.find(rods, owned, kGap);
    for (int turn = 0; turn < 24; turn++) {
      std::vector<int> moved;
      for (int i = random.below(20); i < 300; i += 1 + random.below(40)) moved.push_back(i);
      const double far = turn % 12 == 11 ? 100.0 : 2.0;
      for (const int i : moved) {
        rods[i].segment.centre = rods[i].segment.centre + random.vector(far);
        rods[i].segment.axis = random.direction();
      }
      if (!near.find_again(rods, moved)) {
        anew++;
        near.find(rods, owned, kGap);
        continue;
      }
      again++;
      Pairs pairs, slow;
      for (const NearPairs::Pair &pair : near.found()) pairs.emplace_back(pair.i, pair.j);
      std::sort(pairs.begin(), pairs.end());
      const auto has_moved = [&](int i) {
        return std::binary_search(moved.begin(), moved.end(), i);
      };
      for (const auto &[i, j] : by_trying_all(rods, owned, kGap))
        if (has_moved(i) || has_moved(j)) slow.emplace_back(i, j);
      ASSERT_EQ(pairs, slow) << "turn " << turn;
      found += slow.size();
    }
  }
  EXPECT_GT(found, 200u);
  EXPECT_GT(again, 10);
  EXPECT_GT(anew, 1);
}

INSTANTIATE_TEST_SUITE_P(Beds, NearPairsOf,
                         testing::Values(Bed{"Spheres", 1.0, 8.0, 1.0, false, false},
                                         Bed{"SpheresOfManySizes", 1.0, 8.0, 0.05, false, false},
                                         Bed{"ShortRods", 3.0, 4.0, 1.0, false, false},
                                         Bed{"LongRods", 30.0, 1.2, 1.0, false, false},
                                         Bed{"NeedlesAndSpheres", 100.0, 0.6, 0.2, true, false},
                                         Bed{"SandAndStones", 10.0, 1.5, 0.01, true, false},
                                         Bed{"LatticeOfRods", 10.0, 1.5, 1.0, false, true}),
                         [](const auto &info) { return std::string(info.param.name); });

// Rods few and far between: the grid may not have a cell for each place.
TEST(NearPairs, OfAFewRodsInAHugeSpace)
{
  NearPairs near;
  const Segment x = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.05};
  std::vector<Capsule> rods = {{x, 0.005}, {x, 0.005}, {x, 0.005}, {x, 0.005}};
  rods[1].segment.centre = {0.03, 0.011, 0.0};
  rods[2].segment.centre = {1e9, -1e9, 1e9};
  rods[3].segment.centre = {1e9, -1e9 + 0.25, 1e9};
  EXPECT_EQ(by_grid(near, rods, 4, 0.0), Pairs{});
  EXPECT_EQ(by_grid(near, rods, 4, 0.002), (Pairs{{0, 1}}));
  EXPECT_EQ(by_grid(near, rods, 4, 0.3), (Pairs{{0, 1}, {2, 3}}));
}

TEST(NearPairs, OfNoRodsAreNone)
{
  NearPairs near;
  EXPECT_EQ(by_grid(near, {}, 0, 0.1), Pairs{});
  const Segment x = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.05};
  EXPECT_EQ(by_grid(near, {{x, 0.005}, {x, 0.005}}, 0, 0.1), Pairs{});
}

// A pose that is not a number is near nothing and spoils nothing else.
TEST(NearPairs, OfARodWithoutAPlaceAreNone)
{
  NearPairs near;
  const Segment x = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.05};
  std::vector<Capsule> rods = {{x, 0.005}, {x, 0.005}, {x, 0.005}};
  for (const size_t lost : {0, 1, 2}) {
    std::vector<Capsule> with_lost = rods;
    with_lost[lost].segment.centre.y = std::nan("");
    EXPECT_EQ(by_grid(near, with_lost, 3, 0.1).size(), 1u);
  }
  for (Capsule &rod : rods) rod.segment.centre.x = std::nan("");
  EXPECT_EQ(by_grid(near, rods, 3, 0.1), Pairs{});
}

// Where costs are a (D + s) and b/(s - s0), the choice converges to the least of their sum, found by
// trying all.
TEST(Skin, ConvergesToTheCheapest)
{
  const double a = 3.0, b = 0.02, diameter = 0.01, least = 0.003;
  const auto per_pair = [&](double skin) { return a * (diameter + skin); };
  const auto per_move = [&](double skin) { return b * 1e-4 / (skin - least); };
  double cheapest = 0.0, lowest = 1e300;
  for (int k = 1; k < 100000; k++) {
    const double skin = least + 1e-7 * k, cost = per_pair(skin) + per_move(skin);
    if (cost >= lowest) continue;
    lowest = cost;
    cheapest = skin;
  }
  for (double skin : {0.0031, 0.01, 0.5}) {
    for (int k = 0; k < 20; k++)
      skin = better_skin(skin, least, diameter, per_pair(skin), per_move(skin));
    EXPECT_NEAR(skin, cheapest, 2e-7);
  }
}

TEST(Skin, StaysWhereNothingWasDone)
{
  EXPECT_EQ(better_skin(0.4, 0.1, 1.0, 0.0, 0.0), 0.4);
  EXPECT_EQ(better_skin(0.0, 0.0, 0.0, 0.0, 0.0), 0.0);  // no rods
}
