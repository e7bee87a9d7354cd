// SPDX-License-Identifier: GPL-2.0-or-later
// The five-step search against the right distance, by a slow method and by closest_points: where it
// is right, and how much it misses, in closed form.
#include "core/five_step_search.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "closest_points_reference.h"
#include "segment_families.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

constexpr double kRoundOff = 4.0 * kEpsilon;  // of the coordinates, as closest_points_test.cpp

double distance_of(const ClosestPoints &points) { return std::sqrt(points.distance_squared); }

double distance_in_five_steps(const Pair &pair)
{
  return distance_of(five_step_points(pair.i, pair.j));
}

double nearest_ends(const Pair &pair)
{
  double nearest = HUGE_VAL;
  for (const double s : {-pair.i.half_length, pair.i.half_length})
    for (const double t : {-pair.j.half_length, pair.j.half_length})
      nearest = std::min(nearest, norm(pair.i.at(s) - pair.j.at(t)));
  return nearest;
}

// Segments of length 10 in the plane z = 0 and 0.3 above it: i along x about the origin.
Pair planar(double x, double y, double angle)
{
  return {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 5.0},
          {{x, y, 0.3}, {std::cos(angle), std::sin(angle), 0.0}, 5.0}};
}

class FiveStepSearchOf : public testing::TestWithParam<Family> {};

}  // namespace

// It looks at points of the axes, so that it finds no contact that is not there; and what it finds is
// the right distance or that of two ends. (Of lines parallel but for rounding, that picks the step.)
TEST_P(FiveStepSearchOf, IsRightOrTakesTwoEnds)
{
  RandomRods random(15485867);
  for (int k = 0; k < 20000; k++) {
    const Pair pair = any_size(GetParam(), random).pair;
    const double rounding = kRoundOff * scale_of(pair);
    const double found = distance_in_five_steps(pair);
    const auto right = static_cast<double>(distance_by_faces(pair.i, pair.j));
    ASSERT_GE(found, right - rounding);
    const bool rounding_decides = norm(cross(pair.i.axis, pair.j.axis)) < 1e-6;
    if (found > right + rounding && !rounding_decides) {
      ASSERT_NEAR(found, nearest_ends(pair), rounding);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, FiveStepSearchOf, testing::ValuesIn(families()),
                         [](const auto &info) { return std::string(info.param.name); });

// One pose for each step, the distance by hand: sqrt(0.09 + that in the plane squared).
TEST(FiveStepSearch, TakesItsSteps)
{
  const auto in_plane = [](const Pair &pair) {
    return std::sqrt(five_step_points(pair.i, pair.j).distance_squared - 0.09);
  };
  const double right_angle = 0.5 * kPi;
  EXPECT_NEAR(in_plane(planar(1.0, 2.0, right_angle)), 0.0, 1e-7);   // cylinders cross
  EXPECT_NEAR(in_plane(planar(1.0, 6.0, right_angle)), 1.0, 1e-12);  // end on a side
  EXPECT_NEAR(in_plane(planar(5.4, 1.0, right_angle)), 0.4, 1e-12);  // side on an end
  EXPECT_NEAR(in_plane(planar(8.0, 9.0, right_angle)), 5.0, 1e-12);  // ends: 3 and 4
  EXPECT_NEAR(in_plane(planar(10.5, 0.0, 0.0)), 0.5, 1e-12);         // parallel, in line
  EXPECT_NEAR(in_plane(planar(0.25, 0.0, 0.0)), 0.25, 1e-12);        // parallel, abreast
}

// The end of j lies over the side of i, 0.5 away, and both lines are nearest beyond their segments;
// two parallel rods lie side by side, half a length apart along them.
TEST(FiveStepSearch, MissesAnEndOnASide)
{
  const double slope = std::atan2(-0.5, 7.0);
  const Pair leaning = planar(3.0 - 5.0 * std::cos(slope), 0.5 - 5.0 * std::sin(slope), slope);
  EXPECT_NEAR(distance_of(closest_points(leaning.i, leaning.j)), std::hypot(0.5, 0.3), 1e-12);
  EXPECT_NEAR(distance_in_five_steps(leaning), std::hypot(2.0, 0.5, 0.3), 1e-12);
  const Pair shifted = planar(5.0, 0.5, 0.0);
  EXPECT_NEAR(distance_of(closest_points(shifted.i, shifted.j)), std::hypot(0.5, 0.3), 1e-12);
  EXPECT_NEAR(distance_in_five_steps(shifted), std::hypot(5.0, 0.5, 0.3), 1e-12);
}

// Of places of j's centre, even in a box, those nearer than d: closed form of all, the parallelogram
// of side l swollen by d, V = 2 d l^2 sin g + 2 pi d^2 l + 4/3 pi d^3, and of the missed ones, (8/3) d^3
// (cot g - (pi/2 - g)); the counts scatter by their root.
TEST(FiveStepSearch, MissesTheClosedFormsVolume)
{
  constexpr int kTries = 1000000;
  const double d = 1.0, l = 10.0;
  RandomRods random(86028157);
  for (const double angle : {0.2, 0.4, 0.8, 1.2, 0.5 * kPi}) {
    const Vec3 across = {std::cos(angle), std::sin(angle), 0.0};
    const double box[3] = {0.5 * l * (1.0 + across.x) + d, 0.5 * l * across.y + d, d};
    int touching = 0, missed = 0;
    for (int k = 0; k < kTries; k++) {
      const Vec3 centre = {random.uniform(-box[0], box[0]), random.uniform(-box[1], box[1]),
                           random.uniform(-box[2], box[2])};
      const Pair pair = {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.5 * l}, {centre, across, 0.5 * l}};
      if (closest_points(pair.i, pair.j).distance_squared >= d * d) continue;
      touching++;
      missed += five_step_points(pair.i, pair.j).distance_squared >= d * d;
    }
    const double tries_per_volume = kTries / (8.0 * box[0] * box[1] * box[2]);
    const double all =
        2.0 * d * l * l * std::sin(angle) + 2.0 * kPi * d * d * l + 4.0 / 3.0 * kPi * d * d * d;
    const double lost =
        8.0 / 3.0 * d * d * d * (std::cos(angle) / std::sin(angle) - (0.5 * kPi - angle));
    std::printf("rods at %.2f rad: %.2f %% of the contacts missed, closed form %.2f %%\n", angle,
                100.0 * missed / touching, 100.0 * lost / all);
    EXPECT_NEAR(touching, all * tries_per_volume, 4.0 * std::sqrt(all * tries_per_volume));
    EXPECT_NEAR(missed, lost * tries_per_volume, 4.0 * std::sqrt(lost * tries_per_volume));
  }
}

// The batch has j's centre relative to i's, as a pair about the origin has it.
TEST(FiveStepSearch, BatchIsTheSame)
{
  RandomRods random(49979693);
  SegmentPairs batch{};
  Pair pairs[kBatch];
  for (const Family &family : families()) {
    for (int k = 0; k < kBatch; k++) {
      pairs[k] = any_size(family, random).pair;
      pairs[k].j.centre = pairs[k].j.centre - pairs[k].i.centre;
      pairs[k].i.centre = {0.0, 0.0, 0.0};
      batch.set(k, pairs[k].i, pairs[k].j, 1.0);
    }
    five_step_points(batch);
    for (int k = 0; k < kBatch; k++) {
      const ClosestPoints one = five_step_points(pairs[k].i, pairs[k].j), same = batch.get(k);
      EXPECT_EQ(one.s, same.s);
      EXPECT_EQ(one.t, same.t);
      EXPECT_EQ(norm(one.delta - same.delta), 0.0);
      EXPECT_EQ(batch.uncertain[k] + batch.nearly_parallel[k], 0.0);
    }
  }
}

// What it finds within reach is where closest_points has it; what it does not is out of reach.
TEST(FiveStepSearch, FoundPairsHaveTheirClosestPoints)
{
  RandomRods random(67867979);
  SegmentPairs exact{}, found{};
  int missed = 0, touching = 0;
  for (const Family &family : families())
    for (int n = 0; n < 200; n++) {
      Pair pairs[kBatch];
      for (int k = 0; k < kBatch; k++) {
        const SizedPair sized = any_size(family, random);
        pairs[k] = sized.pair;
        exact.set(k, pairs[k].i, pairs[k].j, sized.diameter);
      }
      found = exact;
      closest_points(exact);
      closest_points_in_five_steps(found);
      for (int k = 0; k < kBatch; k++) {
        const double reach_squared = exact.reach[k] * exact.reach[k];
        const bool is_missed = found.distance_squared[k] >= reach_squared;
        EXPECT_GE(found.distance_squared[k], (1.0 - 1e-9) * exact.distance_squared[k]);
        missed += is_missed && exact.distance_squared[k] < reach_squared;
        if (is_missed) continue;
        touching++;
        EXPECT_EQ(found.distance_squared[k], exact.distance_squared[k]);
        EXPECT_EQ(found.s[k], exact.s[k]);
        EXPECT_EQ(found.uncertain[k], exact.uncertain[k]);
        EXPECT_EQ(found.nearly_parallel[k], exact.nearly_parallel[k]);
      }
    }
  EXPECT_GT(missed, 100);
  EXPECT_GT(touching, 10000);
}
