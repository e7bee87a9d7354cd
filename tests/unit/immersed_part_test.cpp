// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/immersed_part.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "test_support.h"

using namespace spherocylinder;

namespace {

constexpr Vec3 kUp = {0.0, 0.0, 1.0};

double volume_of(const Capsule &rod)
{
  const double r = rod.radius;
  return kPi * r * r * (2.0 * rod.segment.half_length + 4.0 / 3.0 * r);
}

// By lines along `up` on a fine grid: each is a chord of the rod, cut at the surface.
ImmersedPart by_lines(const Capsule &rod, double surface, int lines)
{
  const Segment &s = rod.segment;
  const double reach = s.half_length + rod.radius, cell = 2.0 * reach / lines;
  ImmersedPart sum{0.0, {0.0, 0.0, 0.0}};
  for (int a = 0; a < lines; a++)
    for (int b = 0; b < lines; b++) {
      const Vec3 foot = {-reach + (a + 0.5) * cell, -reach + (b + 0.5) * cell, 0.0};
      const auto inside = [&](double z) {
        const Vec3 p = foot + z * kUp;
        const double t = std::clamp(dot(p, s.axis), -s.half_length, s.half_length);
        return norm(p - t * s.axis) < rod.radius;
      };
      // The rod is convex: the middle of the chord is where the distance to the axis is least.
      double lo = -reach, hi = reach;
      const auto away = [&](double z) {
        const Vec3 p = foot + z * kUp;
        const double t = std::clamp(dot(p, s.axis), -s.half_length, s.half_length);
        return norm(p - t * s.axis);
      };
      for (int k = 0; k < 60; k++) {
        const double m1 = lo + (hi - lo) / 3.0, m2 = hi - (hi - lo) / 3.0;
        (away(m1) < away(m2) ? hi : lo) = away(m1) < away(m2) ? m2 : m1;
      }
      const double middle = 0.5 * (lo + hi);
      if (!inside(middle)) continue;
      const auto edge = [&](double out) {
        double in = middle;
        for (int k = 0; k < 40; k++) {
          const double m = 0.5 * (in + out);
          (inside(m) ? in : out) = m;
        }
        return in;
      };
      const double bottom = edge(-reach), top = std::min(edge(reach), surface - s.centre.z);
      if (top <= bottom) continue;
      const double volume = (top - bottom) * cell * cell;
      sum.volume += volume;
      sum.centroid = sum.centroid + volume * (foot + 0.5 * (top + bottom) * kUp);
    }
  sum.centroid = (1.0 / sum.volume) * sum.centroid;
  return sum;
}

TEST(ImmersedPart, WhollyAboveAndBelow)
{
  const Capsule rod = {{{0.3, 0.2, 0.1}, {0.6, 0.0, 0.8}, 0.04}, 0.005};
  EXPECT_EQ(immersed_part(rod, kUp, 0.06).volume, 0.0);
  const ImmersedPart all = immersed_part(rod, kUp, 0.14);
  EXPECT_NEAR(all.volume, volume_of(rod), 1e-12 * volume_of(rod));
  EXPECT_EQ(norm(all.centroid), 0.0);
}

// A lying rod cut through its axis: a half cylinder, whose centroid lies 4r/(3 pi) deep, and a half
// ball, 3r/8.
TEST(ImmersedPart, HalfALyingRod)
{
  const double r = 0.005, h = 0.04;
  const Capsule rod = {{{0.0, 0.0, 0.5}, {1.0, 0.0, 0.0}, h}, r};
  const ImmersedPart part = immersed_part(rod, kUp, 0.5);
  const double cylinder = kPi * r * r * h, ball = 2.0 / 3.0 * kPi * r * r * r;
  EXPECT_NEAR(part.volume, cylinder + ball, 1e-9 * cylinder);
  EXPECT_NEAR(part.centroid.z,
              -(cylinder * 4.0 * r / (3.0 * kPi) + ball * 0.375 * r) / (cylinder + ball), 1e-9 * r);
  EXPECT_NEAR(part.centroid.x, 0.0, 1e-9 * h);
}

// A standing rod: one half ball and a piece of the cylinder.
TEST(ImmersedPart, AStandingRod)
{
  const double r = 0.005, h = 0.04, depth = 0.02;  // of the cylinder
  for (const double tilt : {0.0, 1e-12, -1e-9}) {
    const Capsule rod = {{{0.0, 0.0, 0.0}, {std::sin(tilt), 0.0, std::cos(tilt)}, h}, r};
    const ImmersedPart part = immersed_part(rod, kUp, -h + depth);
    const double cylinder = kPi * r * r * depth, ball = 2.0 / 3.0 * kPi * r * r * r;
    EXPECT_NEAR(part.volume, cylinder + ball, 1e-9 * cylinder);
    EXPECT_NEAR(part.centroid.z,
                (cylinder * (-h + 0.5 * depth) + ball * (-h - 0.375 * r)) / (cylinder + ball),
                1e-9 * h);
  }
}

// A ball: the cap's volume and its centroid 3 (2 r - c)^2 / (4 (3 r - c)) from the middle, c its
// height.
TEST(ImmersedPart, ABall)
{
  const double r = 0.7;
  for (const double c : {0.01, 0.4, 0.7, 1.2}) {
    const Capsule rod = {{{0.0, 0.0, 0.0}, {0.48, 0.6, 0.64}, 0.0}, r};
    const ImmersedPart part = immersed_part(rod, kUp, c - r);
    const double volume = kPi * c * c * (3.0 * r - c) / 3.0;
    EXPECT_NEAR(part.volume, volume, 1e-8 * volume + 1e-10);
    EXPECT_NEAR(part.centroid.z, -0.75 * (2.0 * r - c) * (2.0 * r - c) / (3.0 * r - c), 1e-8);
    EXPECT_NEAR(std::hypot(part.centroid.x, part.centroid.y), 0.0, 1e-8);
  }
}

TEST(ImmersedPart, AnyPoseAgainstLines)
{
  const double r = 0.1, h = 0.3;
  for (const double tilt : {0.02, 1.1})
    for (const double height : {-0.1, 0.07, 0.2}) {
      const Vec3 axis = {std::sin(tilt) * 0.8, std::sin(tilt) * 0.6, std::cos(tilt)};
      const Capsule rod = {{{0.0, 0.0, height}, axis, h}, r};
      if (std::fabs(height) > 0.9 * (h * axis.z + r)) continue;
      const ImmersedPart part = immersed_part(rod, kUp, 0.0);
      const ImmersedPart slow = by_lines(rod, 0.0, 150);
      EXPECT_NEAR(part.volume, slow.volume, 3e-3 * volume_of(rod)) << tilt << " " << height;
      EXPECT_LT(norm(part.centroid - slow.centroid), 3e-3 * h) << tilt << " " << height;
    }
}

// What is immersed and what is not make up the rod, and their first moments cancel: to what the
// integration promises, from 1e-6 to 1e3 of the size.
TEST(ImmersedPart, BothPartsMakeTheRod)
{
  for (const double scale : {1e-6, 1.0, 1e3})
    for (const double tilt : {0.0, 1e-7, 1e-3, 0.3, 0.9, 1.3, 1.5707, 0.5 * kPi})
      for (double height = -0.39; height < 0.4; height += 0.013) {
        const Capsule rod = {
            {{0.0, 0.0, scale * height}, {std::sin(tilt), 0.0, std::cos(tilt)}, scale * 0.3},
            scale * 0.1};
        const double volume = volume_of(rod);
        const ImmersedPart below = immersed_part(rod, kUp, 0.0);
        const ImmersedPart above = immersed_part(rod, -kUp, 0.0);
        EXPECT_NEAR(below.volume + above.volume, volume, 1e-7 * volume) << tilt << " " << height;
        EXPECT_LT(norm(below.volume * below.centroid + above.volume * above.centroid),
                  1e-7 * volume * scale)
            << tilt << " " << height;
      }
}

}  // namespace
