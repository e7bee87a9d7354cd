// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/closest_points.h"
#include "core/numbers.h"
#include "io/rods.h"
#include "solid/capsule_measures.h"
#include "solid/overlap_volume.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

constexpr double kTight = 1e-6;

Capsule rod(const Vec3 &centre, const Vec3 &direction, double half_length, double radius)
{
  return {{centre, (1.0 / norm(direction)) * direction, half_length}, radius};
}

// The lens of two balls, d apart: pi (R + r - d)^2 (d^2 + 2 d (r + R) - 3 (r - R)^2)/(12 d).
double lens(double r, double q, double d)
{
  return pi * (r + q - d) * (r + q - d) * (d * d + 2 * d * (r + q) - 3 * (r - q) * (r - q)) /
         (12 * d);
}

struct Interval {
  double low = 1e300, high = -1e300;
};

// Piece of the line p + s n inside the rod, from the ball at either end and the tube between.
Interval piece_inside(const Capsule &c, const Vec3 &p, const Vec3 &n)
{
  Interval piece;
  const auto add = [&](double low, double high) {
    piece.low = std::min(piece.low, low);
    piece.high = std::max(piece.high, high);
  };
  const Segment &seg = c.segment;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 d = p - seg.at(side * seg.half_length);
    const double b = dot(d, n), rest = b * b - norm_squared(d) + c.radius * c.radius;
    if (rest > 0.0) add(-b - std::sqrt(rest), -b + std::sqrt(rest));
  }
  const Vec3 d = p - seg.centre;
  const Vec3 across_d = d - dot(d, seg.axis) * seg.axis, across_n = n - dot(n, seg.axis) * seg.axis;
  const double a = norm_squared(across_n), b = dot(across_d, across_n);
  const double rest = b * b - a * (norm_squared(across_d) - c.radius * c.radius);
  if (a < 1e-20 || rest <= 0.0) return piece;
  double low = (-b - std::sqrt(rest)) / a, high = (-b + std::sqrt(rest)) / a;
  const double along_n = dot(n, seg.axis), along_d = dot(d, seg.axis);
  if (std::abs(along_n) < 1e-14) {
    if (std::abs(along_d) > seg.half_length) return piece;
  } else {
    const double s1 = (-seg.half_length - along_d) / along_n;
    const double s2 = (seg.half_length - along_d) / along_n;
    low = std::max(low, std::min(s1, s2));
    high = std::min(high, std::max(s1, s2));
  }
  if (low < high) add(low, high);
  return piece;
}

// Independent slow method: midpoints over a square patch of lines along the shortest way between
// the axes. `size`: half the patch, which must cover the overlap.
double volume_by_lines(const Capsule &a, const Capsule &b, double size, int steps)
{
  const ClosestPoints closest = closest_points(a.segment, b.segment);
  const Vec3 p = a.segment.at(closest.s);
  const Vec3 n = (-1.0 / norm(closest.delta)) * closest.delta;
  const Vec3 side = std::abs(n.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 e1 = (1.0 / norm(cross(n, side))) * cross(n, side), e2 = cross(n, e1);
  const double step = 2.0 * size / steps;
  double sum = 0.0;
  for (int i = 0; i < steps; i++)
    for (int j = 0; j < steps; j++) {
      const Vec3 at = p + (step * (i + 0.5) - size) * e1 + (step * (j + 0.5) - size) * e2;
      const Interval in_a = piece_inside(a, at, n), in_b = piece_inside(b, at, n);
      sum += std::max(std::min(in_a.high, in_b.high) - std::max(in_a.low, in_b.low), 0.0);
    }
  return sum * step * step;
}

void expect_volume(const Capsule &a, const Capsule &b, double truth)
{
  for (const auto &[i, j] : {std::pair{a, b}, std::pair{b, a}}) {
    const BoundedVolume found = overlap_volume(i, j, kTight);
    EXPECT_LE(std::abs(found.value - truth), found.error + 1e-9 * truth)
        << "value " << found.value << ", truth " << truth << ", bound " << found.error;
    EXPECT_LE(found.error, 1.01 * kTight * found.value);
  }
}

TEST(OverlapVolume, ApartIsZero)
{
  const BoundedVolume found = overlap_volume(rod({0, 0, 0}, {1, 0, 0}, 1, 0.1),
                                             rod({0, 0, 0.2}, {0, 1, 0}, 1, 0.1), kTight);
  EXPECT_EQ(found.value, 0.0);
  EXPECT_EQ(found.error, 0.0);
}

// Two rods in line, tip to tip, and two spheres, shallow and deep: a lens.
TEST(OverlapVolume, TipsAndSpheres)
{
  for (const double d : {0.499, 0.45, 0.3, 0.15}) {
    expect_volume(rod({0, 0, 0}, {1, 0, 0}, 0.0, 0.3), rod({0, d, 0}, {0, 1, 0}, 0.0, 0.2),
                  lens(0.3, 0.2, d));
    if (d > 0.3)  // else a tip reaches the other rod's tube
      expect_volume(rod({-1, 0, 0}, {1, 0, 0}, 1.0, 0.3), rod({1 + d, 0, 0}, {1, 0, 0}, 1.0, 0.2),
                    lens(0.3, 0.2, d));
  }
}

// Round sections whose axes cross at right angles: Steinmetz's body, 16 r^3/3; at an angle gamma
// 16 r^3/(3 sin gamma).
TEST(OverlapVolume, AxesThatCross)
{
  const double r = 0.1;
  for (const double gamma : {0.5 * pi, 1.0, 0.4}) {
    expect_volume(rod({0, 0, 0}, {1, 0, 0}, 2, r),
                  rod({0.3, 0, 0}, {std::cos(gamma), std::sin(gamma), 0}, 2, r),
                  16.0 * r * r * r / (3.0 * std::sin(gamma)));
  }
}

// Parallel rods of the same length side by side: the lens of two circles times the length of the
// tube, and the lens of two balls.
TEST(OverlapVolume, ParallelRods)
{
  const double r = 0.1, h = 1.0;
  for (const double d : {0.19, 0.1, 0.02}) {
    const double section =
        2.0 * r * r * std::acos(d / (2 * r)) - 0.5 * d * std::sqrt(4 * r * r - d * d);
    expect_volume(rod({0, 0, 0}, {1, 2, 3}, h, r),
                  rod((d / std::sqrt(5.0)) * Vec3{2, -1, 0}, {1, 2, 3}, h, r),
                  2 * h * section + lens(r, r, d));
  }
}

// The same rod twice, and a thin one within a thick one: the smaller one's volume.
TEST(OverlapVolume, OneWithinTheOther)
{
  const Capsule thick = rod({0.1, 0.2, 0.3}, {1, 2, 2}, 1.0, 0.2);
  expect_volume(thick, thick, volume(thick));
  const Capsule thin = rod({0.1, 0.2, 0.32}, {1, 2, 2.05}, 0.5, 0.05);
  expect_volume(thick, thin, volume(thin));
}

// All ways to meet: sides, ends on sides, ends, tips half on the tube; 2 % to 60 % of a radius
// deep.
TEST(OverlapVolume, RandomPairsAgainstLines)
{
  std::mt19937 random(67867967);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto directions = even_directions(400);
  int quick = 0, searched = 0;
  for (int i = 0; i < 120; i++) {
    const double r = 0.1, q = i % 2 ? 0.1 : 0.07;
    const Capsule a = rod({0, 0, 0}, directions[3 * i], 0.4 * std::abs(number(random)), r);
    Capsule b = rod({number(random), number(random), number(random)}, directions[399 - 2 * i],
                    0.4 * std::abs(number(random)), q);
    if (norm(cross(a.segment.axis, b.segment.axis)) < 0.3) continue;  // an overlap beyond the patch
    // Moved along the shortest way until they overlap by so much.
    const ClosestPoints closest = closest_points(a.segment, b.segment);
    const double distance = std::sqrt(closest.distance_squared);
    const double depth = q * std::pow(10.0, -1.0 + 0.8 * number(random));
    b.segment.centre = b.segment.centre + ((distance - (r + q - depth)) / distance) * closest.delta;
    const BoundedVolume found = overlap_volume(a, b, 1e-4);
    // 500 x 500 midpoints of a patch of 4 r: 1e-3 of the shallowest overlaps.
    const double truth = volume_by_lines(a, b, 4.0 * r, 500);
    EXPECT_NEAR(found.value, truth, 1e-2 * truth + found.error + 1e-9) << i;
    (found.error < 1.1e-8 * found.value ? quick : searched) += 1;
  }
  EXPECT_GT(quick, 30);
  EXPECT_GT(searched, 10);
}

}  // namespace
}  // namespace spherocylinder
