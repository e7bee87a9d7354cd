// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/numbers.h"
#include "io/rods.h"
#include "solid/capsule_measures.h"
#include "solid/clipped_volume.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

constexpr double kTight = 1e-8;  // tolerance asked for
constexpr double kHuge = 1e3;    // bounds of a cylinder that are out of reach of unit-size rods

Capsule rod(const Vec3 &centre, const Vec3 &direction, double half_length, double radius)
{
  return {{centre, (1.0 / norm(direction)) * direction, half_length}, radius};
}

// The true volume must lie within the bound that came with the value, and the bound must be as
// tight as asked for. 1e-12: round-off of the sum over sections.
void expect_volume(const BoundedVolume &found, double truth, double rod_volume)
{
  EXPECT_LE(std::abs(found.value - truth), found.error + 1e-12 * rod_volume)
      << "value " << found.value << ", truth " << truth << ", bound " << found.error;
  EXPECT_LE(found.error, kTight * std::max(found.value, 1e-3 * rod_volume) * 1.01);
}

// Independent slow method: midpoint sums over chords parallel to the axis, offset (rho, phi) inside
// the round section; a chord is cut by the capsule, by the infinite cylinder (a quadratic) and by
// the slab (linear), all intervals.
double volume_by_chords(const Capsule &capsule, const UprightCylinder &cylinder, int steps)
{
  const Vec3 &u = capsule.segment.axis;
  const Vec3 &c = capsule.segment.centre;
  const Vec3 side = std::abs(u.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 e1 = (1.0 / norm(cross(u, side))) * cross(u, side);
  const Vec3 e2 = cross(u, e1);
  double sum = 0.0;
  for (int i = 0; i < steps; i++) {
    const double rho = capsule.radius * (i + 0.5) / steps;
    for (int j = 0; j < steps; j++) {
      const double phi = 2.0 * pi * (j + 0.5) / steps;
      const Vec3 p = c + (rho * std::cos(phi)) * e1 + (rho * std::sin(phi)) * e2;
      const double reach =
          capsule.segment.half_length + std::sqrt(capsule.radius * capsule.radius - rho * rho);
      double low = -reach, high = reach;
      const double a = u.x * u.x + u.y * u.y;
      const double dx = p.x - cylinder.x, dy = p.y - cylinder.y;
      const double b = u.x * dx + u.y * dy;
      const double k = dx * dx + dy * dy - cylinder.radius * cylinder.radius;
      if (a < 1e-24) {
        if (k > 0.0) continue;
      } else {
        if (b * b - a * k <= 0.0) continue;
        const double root = std::sqrt(b * b - a * k);
        low = std::max(low, (-b - root) / a);
        high = std::min(high, (-b + root) / a);
      }
      if (std::abs(u.z) < 1e-12) {
        if (p.z < cylinder.z_low || p.z > cylinder.z_high) continue;
      } else {
        const double s1 = (cylinder.z_low - p.z) / u.z, s2 = (cylinder.z_high - p.z) / u.z;
        low = std::max(low, std::min(s1, s2));
        high = std::min(high, std::max(s1, s2));
      }
      if (high > low) sum += (high - low) * rho;
    }
  }
  return sum * (capsule.radius / steps) * (2.0 * pi / steps);
}

TEST(ClippedVolume, WholeRodInsideIsExact)
{
  const Capsule capsule = rod({0.1, -0.2, 0.3}, {1, 2, 3}, 0.5, 0.05);
  const BoundedVolume found = clipped_volume(capsule, {0, 0, 2, -2, 2}, kTight);
  // pi r^2 h + 4/3 pi r^3
  EXPECT_NEAR(found.value, pi * 0.0025 * 1.0 + 4.0 / 3.0 * pi * 0.000125, 1e-15);
  EXPECT_EQ(found.error, 0.0);
}

TEST(ClippedVolume, RodOutsideIsExactlyZero)
{
  const UprightCylinder cylinder{0, 0, 1, 0, 1};
  const Capsule outside[] = {
      rod({2, 0, 0.5}, {0, 1, 0}, 5.0, 0.1),    // passes beside
      rod({0, 0, 1.2}, {1, 0, 0}, 5.0, 0.1),    // passes above
      rod({0, 0, -0.2}, {1, 1, 0}, 0.5, 0.1),   // below
      rod({0, 1.3, 1.3}, {1, 0, 0}, 3.0, 0.4),  // past the rim, nearer than r to wall and top alone
  };
  for (const Capsule &capsule : outside) {
    const BoundedVolume found = clipped_volume(capsule, cylinder, kTight);
    EXPECT_EQ(found.value, 0.0);
    EXPECT_EQ(found.error, 0.0);
  }
}

// A plane through the centre halves a rod, whatever its direction (symmetry).
TEST(ClippedVolume, PlaneThroughTheCentreHalves)
{
  for (const Vec3 &direction : even_directions(25)) {
    const Capsule capsule = rod({0.3, 0.1, 0.7}, direction, 0.4, 0.07);
    expect_volume(clipped_volume(capsule, {0, 0, kHuge, 0.7, kHuge}, kTight), 0.5 * volume(capsule),
                  volume(capsule));
  }
}

// Cap of height a cut off a sphere: pi a^2 (3 r - a)/3.
TEST(ClippedVolume, SphereCap)
{
  const Capsule sphere = rod({0, 0, 0}, {1, 0, 1}, 0.0, 0.5);
  for (const double a : {0.001, 0.1, 0.5, 0.9})
    expect_volume(clipped_volume(sphere, {0, 0, kHuge, 0.5 - a, kHuge}, kTight),
                  pi * a * a * (1.5 - a) / 3.0, volume(sphere));
}

// Lying rod cut by a horizontal plane at height a below its top: h times the circular segment
// r^2 acos((r-a)/r) - (r-a) sqrt(2 r a - a^2), plus a sphere's cap.
TEST(ClippedVolume, LyingRodCutByAPlane)
{
  const double r = 0.1, half = 1.5, a = 0.06;
  const double segment = r * r * std::acos((r - a) / r) - (r - a) * std::sqrt(2 * r * a - a * a);
  const double truth = 2.0 * half * segment + pi * a * a * (3 * r - a) / 3.0;
  const Capsule capsule = rod({0.2, 0.3, 0.0}, {1, 1, 0}, half, r);
  expect_volume(clipped_volume(capsule, {0, 0, kHuge, r - a, kHuge}, kTight), truth,
                volume(capsule));
}

// Standing rod on the axis of a thinner cylinder of radius R: pi R^2 h plus twice what a bore of
// radius R takes from a half sphere, 2 pi/3 (r^3 - (r^2 - R^2)^(3/2)).
TEST(ClippedVolume, StandingRodAroundAThinnerCylinder)
{
  const double r = 0.5, R = 0.3, half = 1.0;
  const double truth =
      pi * R * R * 2.0 * half + 4.0 * pi / 3.0 * (r * r * r - std::pow(r * r - R * R, 1.5));
  const Capsule capsule = rod({1, 2, 3}, {0, 0, 1}, half, r);
  expect_volume(clipped_volume(capsule, {1, 2, R, -kHuge, kHuge}, kTight), truth, volume(capsule));
}

// Standing rod, both round sections offset by d: the cylinder part shares the lens
// r^2 acos((d^2+r^2-R^2)/(2dr)) + R^2 acos((d^2+R^2-r^2)/(2dR)) - sqrt(...)/2 of two circles.
TEST(ClippedVolume, StandingRodAcrossTheWallOfACylinder)
{
  const double r = 0.2, R = 1.0, d = 0.95;
  const double lens = r * r * std::acos((d * d + r * r - R * R) / (2 * d * r)) +
                      R * R * std::acos((d * d + R * R - r * r) / (2 * d * R)) -
                      0.5 * std::sqrt((-d + r + R) * (d + r - R) * (d - r + R) * (d + r + R));
  const Capsule capsule = rod({d * 0.6, d * 0.8, 0}, {0, 0, -1}, 3.0, r);
  expect_volume(clipped_volume(capsule, {0, 0, R, -1.0, 1.5}, kTight), 2.5 * lens, volume(capsule));
}

// A sphere that the wall and the top cut both, at the rim: no closed form.
TEST(ClippedVolume, SphereAtTheEdgeAgainstChords)
{
  const Capsule sphere = rod({1.02, 0.1, 0.95}, {0.3, 0.2, 1.0}, 0.0, 0.2);
  const UprightCylinder cylinder{0, 0, 1, 0, 1};
  const BoundedVolume found = clipped_volume(sphere, cylinder, kTight);
  // 2000 x 2000 midpoints of a function with kinks: about 1e-6 of the sphere.
  EXPECT_NEAR(found.value, volume_by_chords(sphere, cylinder, 2000), 2e-6 * volume(sphere));
}

TEST(ClippedVolume, RandomRodsAgainstChords)
{
  std::mt19937 random(15485863);
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  const UprightCylinder cylinder{0, 0, 1, -0.5, 0.5};
  int cut = 0;
  for (const Vec3 &direction : even_directions(60)) {
    const Capsule capsule = rod({place(random), place(random), 0.6 * place(random)}, direction,
                                0.8 * std::abs(place(random)), 0.1);
    const BoundedVolume found = clipped_volume(capsule, cylinder, 1e-6);
    // 400 x 400 midpoints: kinks leave about 1e-5 of the rod, jumps (near-vertical rods) more.
    EXPECT_NEAR(found.value, volume_by_chords(capsule, cylinder, 400), 3e-4 * volume(capsule));
    cut += found.error > 0.0;
  }
  EXPECT_GT(cut, 20);  // else the test does not test much
}

// A coarse answer and a fine one may differ by no more than the sum of their bounds.
TEST(ClippedVolume, CoarseBoundContainsFineValue)
{
  std::mt19937 random(32452843);
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  const UprightCylinder cylinder{0, 0, 1, -0.5, 0.5};
  for (const Vec3 &direction : even_directions(200)) {
    const Capsule capsule = rod({place(random), place(random), 0.6 * place(random)}, direction,
                                std::abs(place(random)), 0.05);
    const BoundedVolume fine = clipped_volume(capsule, cylinder, 1e-7);
    for (const double tolerance : {0.1, 1e-2, 1e-3, 1e-4}) {
      const BoundedVolume coarse = clipped_volume(capsule, cylinder, tolerance);
      EXPECT_LE(std::abs(coarse.value - fine.value),
                coarse.error + fine.error + 1e-12 * volume(capsule));
      EXPECT_LE(coarse.error, 1.01 * tolerance * std::max(coarse.value, 1e-3 * volume(capsule)));
    }
  }
}

// Two slabs that share a face add up to the whole.
TEST(ClippedVolume, SlabsAddUp)
{
  for (const Vec3 &direction : even_directions(20)) {
    const Capsule capsule = rod({0.5, 0.2, 0.1}, direction, 0.6, 0.1);
    const double lower = clipped_volume(capsule, {0, 0, 0.9, -kHuge, 0.15}, kTight).value;
    const double upper = clipped_volume(capsule, {0, 0, 0.9, 0.15, kHuge}, kTight).value;
    const double both = clipped_volume(capsule, {0, 0, 0.9, -kHuge, kHuge}, kTight).value;
    EXPECT_NEAR(lower + upper, both, 4.0 * kTight * volume(capsule));
  }
}

// The scene scaled by s: volumes scale by s^3.
TEST(ClippedVolume, ScalesWithTheScene)
{
  const Capsule unit = rod({0.8, 0.3, 0.45}, {1, 0.5, 0.4}, 0.7, 0.06);
  const UprightCylinder cylinder{0.1, 0.05, 1, -0.5, 0.5};
  const double truth = clipped_volume(unit, cylinder, kTight).value;
  for (const double s : {1e-6, 1e-3, 1.0, 1e3}) {
    const Capsule scaled = rod(s * unit.segment.centre, unit.segment.axis,
                               s * unit.segment.half_length, s * unit.radius);
    const UprightCylinder around{s * cylinder.x, s * cylinder.y, s, -0.5 * s, 0.5 * s};
    EXPECT_NEAR(clipped_volume(scaled, around, kTight).value, s * s * s * truth,
                4.0 * kTight * s * s * s * truth);
  }
}

// Grazing contacts of all kinds end quickly and give next to nothing, not a NaN or a hang.
TEST(ClippedVolume, GrazingRods)
{
  const UprightCylinder cylinder{0, 0, 1, 0, 1};
  for (const double depth : {1e-15, 1e-12, 1e-9, 1e-6}) {
    const Capsule grazing[] = {
        rod({1.1 - depth, 0, 0.5}, {0, 1, 0}, 3.0, 0.1),
        rod({1.1 - depth, 0, 0.5}, {0, 0, 1}, 3.0, 0.1),
        rod({0, 0, 1.1 - depth}, {1, 0, 0}, 0.3, 0.1),
        rod({0.1, 0, 1.5 + 0.1 - depth}, {0, 0, 1}, 0.5, 0.1),
    };
    for (const Capsule &capsule : grazing) {
      const BoundedVolume found = clipped_volume(capsule, cylinder, 1e-4);
      EXPECT_GE(found.value, 0.0);
      // What is cut off is thinner than `depth` and no larger than the rod's shadow.
      EXPECT_LE(found.value - found.error, 20.0 * depth * volume(capsule));
      EXPECT_LE(found.error, 1e-4 * 1e-3 * volume(capsule));
    }
  }
}

// Independent slow method for boxes: the chords of volume_by_chords, each cut by three slabs.
double volume_by_chords(const Capsule &capsule, const UprightBox &box, int steps)
{
  const Vec3 &u = capsule.segment.axis;
  const Vec3 side = std::abs(u.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 e1 = (1.0 / norm(cross(u, side))) * cross(u, side);
  const Vec3 e2 = cross(u, e1);
  double sum = 0.0;
  for (int i = 0; i < steps; i++) {
    const double rho = capsule.radius * (i + 0.5) / steps;
    for (int j = 0; j < steps; j++) {
      const double phi = 2.0 * pi * (j + 0.5) / steps;
      const Vec3 p =
          capsule.segment.centre + (rho * std::cos(phi)) * e1 + (rho * std::sin(phi)) * e2;
      const double reach =
          capsule.segment.half_length + std::sqrt(capsule.radius * capsule.radius - rho * rho);
      double low = -reach, high = reach;
      const auto cut = [&](double at, double slope, double from, double to) {
        if (std::abs(slope) < 1e-12) {
          if (at < from || at > to) high = low;
          return;
        }
        const double s1 = (from - at) / slope, s2 = (to - at) / slope;
        low = std::max(low, std::min(s1, s2));
        high = std::min(high, std::max(s1, s2));
      };
      cut(p.x, u.x, box.x_low, box.x_high);
      cut(p.y, u.y, box.y_low, box.y_high);
      cut(p.z, u.z, box.z_low, box.z_high);
      if (high > low) sum += (high - low) * rho;
    }
  }
  return sum * (capsule.radius / steps) * (2.0 * pi / steps);
}

// Rods in any pose, in, out, across faces, edges and corners, longer than the box is wide.
TEST(ClippedVolume, BoxesAgainstChords)
{
  const UprightBox box(-0.4, 0.5, -0.3, 0.6, -0.2, 0.7);
  std::mt19937 random(86028121);
  std::uniform_real_distribution<double> place(-0.9, 1.1);
  int cut = 0;
  for (const Vec3 &direction : random_directions(300, random)) {
    for (const double half_length : {0.0, 0.2, 1.5}) {
      const Capsule capsule =
          rod({place(random), place(random), place(random)}, direction, half_length, 0.15);
      const BoundedVolume found = clipped_volume(capsule, box, 1e-5);
      const double whole = volume(capsule), slow = volume_by_chords(capsule, box, 60);
      EXPECT_NEAR(found.value, slow, 2e-3 * whole + found.error);
      EXPECT_LE(found.error, 1.01e-5 * std::max(found.value, 1e-3 * whole));
      if (found.value > 0.0 && found.value < 0.999 * whole) cut++;
    }
  }
  EXPECT_GT(cut, 200);
}

// Faces through the centre: a half, a quarter and an eighth of rods along an axis, by symmetry; of
// any rod a half; eight boxes that meet in a point share a rod out.
TEST(ClippedVolume, BoxesShareARod)
{
  const auto expect = [](const BoundedVolume &found, double truth) {
    EXPECT_NEAR(found.value, truth, found.error + 1e-14);
    EXPECT_LE(found.error, 1.01e-6 * truth);
  };
  const auto in_box = [](const Capsule &capsule, const UprightBox &box) {
    return clipped_volume(capsule, box, 1e-6);
  };
  for (const Vec3 &direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Capsule capsule = rod({0.1, 0.2, 0.3}, direction, 0.4, 0.07);
    const double whole = volume(capsule);
    expect(in_box(capsule, UprightBox(0.1, kHuge, -kHuge, kHuge, -kHuge, kHuge)), whole / 2);
    expect(in_box(capsule, UprightBox(0.1, kHuge, -kHuge, 0.2, -kHuge, kHuge)), whole / 4);
    expect(in_box(capsule, UprightBox(-kHuge, 0.1, -kHuge, 0.2, 0.3, kHuge)), whole / 8);
  }
  for (const Vec3 &direction : even_directions(25)) {
    const Capsule capsule = rod({0.1, 0.2, 0.3}, direction, 0.4, 0.07);
    const double whole = volume(capsule);
    expect(in_box(capsule, UprightBox(0.1, kHuge, -kHuge, kHuge, -kHuge, kHuge)), whole / 2);
    expect(in_box(capsule, UprightBox(-kHuge, kHuge, 0.2, kHuge, -kHuge, kHuge)), whole / 2);
    expect(in_box(capsule, UprightBox(-kHuge, kHuge, -kHuge, kHuge, 0.3, kHuge)), whole / 2);
    double sum = 0.0, error = 0.0;
    for (const double x : {-kHuge, 0.15})
      for (const double y : {-kHuge, 0.22})
        for (const double z : {-kHuge, 0.27}) {
          const UprightBox part(x, x < 0 ? 0.15 : kHuge, y, y < 0 ? 0.22 : kHuge, z,
                                z < 0 ? 0.27 : kHuge);
          const BoundedVolume found = clipped_volume(capsule, part, 1e-5);
          sum += found.value;
          error += found.error;
        }
    EXPECT_NEAR(sum, whole, error + 1e-12 * whole);
  }
}

}  // namespace
}  // namespace spherocylinder
