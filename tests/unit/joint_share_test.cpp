// SPDX-License-Identifier: GPL-2.0-or-later
// Shares of contacts at joints: patches against a slow search along the line, sums of shares on straight and bent
// fibres, their slope against differences.
#include "core/joint_share.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/closest_points.h"

using namespace spherocylinder;

namespace {

Vec3 unit(const Vec3 &a) { return (1.0 / norm(a)) * a; }

double distance_to(const Segment &other, const Vec3 &point)
{
  return norm(point - other.at(closest_position(other, point)));
}

// Independent: steps along the line, halved at both ends of the patch.
LinePatch slow_patch(const EndLine &line, const Segment &other, double within)
{
  const auto at = [&](double s) { return distance_to(other, line.from + s * line.outward); };
  double nearest = 0.0;
  for (double step = 8.0, from = -40.0, to = 40.0; step > 1e-9; step *= 0.1) {
    for (double s = from; s <= to; s += step)
      if (at(s) < at(nearest)) nearest = s;
    from = nearest - step;
    to = nearest + step;
  }
  if (at(nearest) >= within) return {nearest, 0.0};
  double ends[2];
  for (const int side : {0, 1}) {
    double in = nearest, out = nearest + (side ? 50.0 : -50.0);
    for (int k = 0; k < 100; k++) {
      const double middle = 0.5 * (in + out);
      (at(middle) < within ? in : out) = middle;
    }
    ends[side] = in;
  }
  return {0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0])};
}

TEST(JointShare, PatchesAgainstASlowSearch)
{
  std::mt19937 random(982451653);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int long_ones = 0;
  for (int n = 0; n < 300; n++) {
    const double h = n % 3 == 0 ? 0.0 : n % 3 == 1 ? 0.5 : 8.0;
    EndLine line = {{any(random), any(random), any(random)}, {1.0, 0.0, 0.0}};
    Segment other = {{3.0 * any(random), 0.8 * any(random), 0.8 * any(random)},
                     unit({any(random), any(random), any(random)}),
                     h};
    if (n % 4 == 0) other.axis = unit({1.0, 0.05 * any(random), 0.05 * any(random)});
    if (n % 16 == 0) other.axis = line.outward;
    const double reach = 2.0;
    const LinePatch patch = patch_on_line(line, other, reach);
    // What is given up of the deepest overlap, from the formula in the header.
    const LinePatch nearest = slow_patch(line, other, 0.0);
    const double distance = distance_to(other, line.from + nearest.centre * line.outward);
    if (distance >= reach) {
      EXPECT_EQ(patch.half, 0.0);
      continue;
    }
    const double overlap = reach - distance, cosine = dot(line.outward, other.axis);
    const double part = std::pow(cosine, 8) * h * h / (h * h + 2.0 * reach * overlap);
    const LinePatch slow =
        slow_patch(line, other, distance + (1.0 / 16.0 + 15.0 / 16.0 * part) * overlap);
    EXPECT_NEAR(patch.centre, slow.centre, 1e-6);
    EXPECT_NEAR(patch.half, slow.half, 1e-6);
    long_ones += patch.half > 4.0;
  }
  EXPECT_GT(long_ones, 10);
}

// Two rods joined at the origin, the second turned by `bend` towards -z, and a crossed rod at (x, z).
struct Pair {
  LinePatch own, next;
};

Pair patches_of(double bend, double x, double z, double reach)
{
  const Segment other = {{x, 0.0, z}, unit({0.3, 1.0, 0.0}), 10.0};
  const Vec3 ahead = {std::cos(bend), 0.0, -std::sin(bend)};
  return {patch_on_line({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, other, reach),
          patch_on_line({{0.0, 0.0, 0.0}, -ahead}, other, reach)};
}

constexpr double kReach = 2.0, kLongest = 3.0;

TEST(JointShare, AddsUpToOneOnStraightFibresAndOutside)
{
  for (const double bend : {0.0, 1e-3, 0.05, 0.5, 1.0})
    for (int k = -200; k <= 200; k++) {
      // On a circle about the joint, from above the first rod to above the second.
      const double angle = bend == 0.0 ? 0.0 : bend * (0.5 + 0.5 * k / 200.0);
      const double x = bend == 0.0 ? 1e-3 * k : 1.99 * std::sin(angle);
      const Pair pair = patches_of(bend, x, 1.99 * std::cos(angle), kReach);
      const double first = share_at_joint(pair.own, pair.next, kLongest);
      const double second = share_at_joint(pair.next, pair.own, kLongest);
      EXPECT_NEAR(first + second, 1.0, 1e-12) << bend << " " << k;
    }
}

TEST(JointShare, IsWholeOnBothSidesInside)
{
  for (const double bend : {-0.1, -0.5, -1.0}) {
    // As far from both axes.
    const Pair pair = patches_of(bend, -1.99 * std::tan(-0.5 * bend), 1.99, kReach);
    EXPECT_EQ(share_at_joint(pair.own, pair.next, kLongest), 1.0);
    EXPECT_EQ(share_at_joint(pair.next, pair.own, kLongest), 1.0);
  }
}

TEST(JointShare, WithoutASpotIsTheNearers)
{
  const LinePatch before = {-0.1, 0.0}, beyond = {0.1, 0.0};
  EXPECT_EQ(share_at_joint(before, beyond, 1.0), 1.0);
  EXPECT_EQ(share_at_joint(beyond, before, 1.0), 0.0);
  EXPECT_EQ(share_at_joint({0.0, 0.0}, {0.0, 0.0}, 1.0), 0.5);
}

TEST(JointShare, SlopeAgainstDifferences)
{
  const double step = 1e-6;
  for (const double x : {-0.15, -0.05, 0.0, 0.1, 0.18}) {
    const Pair pair = patches_of(0.0, x, 1.95, kReach);
    const auto share = [&](double way) {
      return share_at_joint({pair.own.centre + way, pair.own.half},
                            {pair.next.centre - way, pair.next.half}, kLongest);
    };
    const ShareSlope slope = slope_of_share(pair.own, pair.next, kLongest);
    EXPECT_NEAR(slope.fall, -(share(step) - share(-step)) / (2.0 * step), 1e-6);
    EXPECT_LT(slope.by_own, 1e-6);
  }
}

// How the place moves where a line and another axis are nearest: differences.
TEST(JointShare, AdvanceAgainstDifferences)
{
  const Segment line = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 100.0};
  const Segment other = {{0.4, 0.2, 1.5}, unit({0.7, 0.6, 0.2}), 10.0};
  const Vec3 advance = advance_on_line(line.axis, other, {0.0, 0.1}, false);
  const double step = 1e-5;
  for (const Vec3 &way : {Vec3{step, 0.0, 0.0}, Vec3{0.0, step, 0.0}, Vec3{0.0, 0.0, step}}) {
    Segment there = other, back = other;
    there.centre = there.centre + way;
    back.centre = back.centre - way;
    const double moved = closest_points(line, there).s - closest_points(line, back).s;
    EXPECT_NEAR(dot(advance, way), 0.5 * moved, 1e-9);
  }
  for (const double half : {20.0, 1e3})
    EXPECT_EQ(norm(advance_on_line(line.axis, other, {0.0, half}, false) - line.axis), 0.0);
  EXPECT_EQ(norm(advance_on_line(line.axis, {other.centre, line.axis, 1.0}, {0.0, 0.1}, false) -
                 line.axis),
            0.0);
}

}  // namespace
