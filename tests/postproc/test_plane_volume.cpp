// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "io/rods.h"
#include "solid/capsule_measures.h"
#include "solid/plane_volume.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

using Real = long double;
const Real kPi = std::acos(Real(-1));

// Disc of radius rho on the side y <= b of a chord.
Real disc_part(Real rho, Real b)
{
  if (b <= -rho) return 0;
  if (b >= rho) return kPi * rho * rho;
  return rho * rho * std::acos(-b / rho) + b * std::sqrt((rho - b) * (rho + b));
}

// Independent slow method in extended precision: slices at right angles to the rod's axis, discs
// cut by the plane's line, added up along the axis. Pieces between the places where the integrand
// has a kink or a root (the rims of the tube, the points where the plane enters or leaves it), each
// with q = middle - half cos(theta), which takes roots away; midpoint rule in theta.
Real volume_by_slices(const Capsule &rod, double height)
{
  const Real r = rod.radius, h = rod.segment.half_length;
  const Real c = std::abs(static_cast<Real>(rod.segment.axis.z));
  const Real s =
      std::hypot(static_cast<Real>(rod.segment.axis.x), static_cast<Real>(rod.segment.axis.y));
  const Real d = static_cast<Real>(height) - rod.segment.centre.z;
  std::vector<Real> cuts{-h - r, -h, h, h + r};
  const auto add = [&](Real q) {
    if (std::abs(q) < h + r) cuts.push_back(q);
  };
  for (const int side : {-1, 1}) {
    if (c > 0) add((d + side * s * r) / c);
    // Where the plane's line touches the round end's disc: q - (+-h) = e with
    // (d -+ h c - e c)^2 = s^2 (r^2 - e^2), a quadratic.
    const Real k = d - side * h * c;
    const Real root = s * s * (r * r - k * k);
    if (root < 0) continue;
    add(side * h + k * c + std::sqrt(root));
    add(side * h + k * c - std::sqrt(root));
  }
  std::sort(cuts.begin(), cuts.end());
  constexpr int kSteps = 2000;
  Real sum = 0;
  for (std::size_t i = 1; i < cuts.size(); i++) {
    const Real middle = (cuts[i] + cuts[i - 1]) / 2, half = (cuts[i] - cuts[i - 1]) / 2;
    for (int k = 0; k < kSteps; k++) {
      const Real theta = kPi * (k + Real(0.5)) / kSteps;
      const Real q = middle - half * std::cos(theta);
      const Real beyond = std::max(std::abs(q) - h, Real(0));
      const Real rho = std::sqrt(std::max((r - beyond) * (r + beyond), Real(0)));
      const Real level = d - q * c;
      const Real part = s > 0 ? disc_part(rho, level / s) : (level >= 0 ? kPi * rho * rho : 0);
      sum += part * half * std::sin(theta) * kPi / kSteps;
    }
  }
  return sum;
}

// Of the rod; midpoints leave about 1e-7 where two kinks fall together.
constexpr double kSlicesError = 1e-6;

TEST(PlaneVolume, AnyPoseAgainstSlices)
{
  std::mt19937 random(49979687);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  int cut = 0;
  for (const Vec3 &direction : even_directions(150)) {
    const Capsule rod{{{0.3, -0.2, number(random)}, direction, std::abs(number(random))}, 0.2};
    const double height = number(random);
    const double found = volume_below(rod, height);
    EXPECT_NEAR(found, static_cast<double>(volume_by_slices(rod, height)),
                kSlicesError * volume(rod));
    cut += found > 0.0 && found < volume(rod);
  }
  EXPECT_GT(cut, 50);
}

// Axes horizontal or upright but for 1e-15 to 1e-1, on both sides of the change of formula.
TEST(PlaneVolume, NearlyHorizontalAndUprightAgainstSlices)
{
  for (const double h : {0.0, 0.1, 3.0})
    for (double tilt = 1e-15; tilt < 0.5; tilt *= 10.0)
      for (const double height : {-0.19, -0.05, 0.0, 0.1, 0.199}) {
        const double rest = std::sqrt((1.0 - tilt) * (1.0 + tilt));
        for (const Vec3 &axis : {Vec3{rest, 0.0, tilt}, Vec3{0.0, -tilt, -rest}}) {
          const Capsule rod{{{0.0, 0.0, 0.0}, axis, h}, 0.2};
          EXPECT_NEAR(volume_below(rod, height), static_cast<double>(volume_by_slices(rod, height)),
                      kSlicesError * volume(rod))
              << "h " << h << " tilt " << tilt << " axis z " << axis.z << " height " << height;
        }
      }
}

// What lies below and, of the rod turned over, above make up the rod.
TEST(PlaneVolume, BelowAndAboveAddUp)
{
  for (const Vec3 &u : even_directions(200))
    for (const double height : {-1.1, -0.7, -0.2, 0.05, 0.4, 0.9}) {
      const Capsule rod{{{0.0, 0.0, 0.1}, u, 0.8}, 0.3};
      const Capsule turned{{{0.0, 0.0, -0.1}, {u.x, u.y, -u.z}, 0.8}, 0.3};
      EXPECT_NEAR(volume_below(rod, height) + volume_below(turned, -height), volume(rod),
                  1e-9 * volume(rod));
    }
}

// An upright rod loses a cap, pi a^2 (3 r - a)/3; half way up a lying rod is half of it.
TEST(PlaneVolume, ClosedForms)
{
  const Capsule upright{{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 2.0}, 0.5};
  const double tight = 1e-14 * volume(upright), p = std::acos(-1.0);
  EXPECT_NEAR(volume_below(upright, -2.2), p * 0.09 * (1.5 - 0.3) / 3.0, tight);
  EXPECT_NEAR(volume_below(upright, 1.0), p * 0.25 * 3.0 + 2.0 / 3.0 * p * 0.125, tight);
  EXPECT_EQ(volume_below(upright, 2.5), volume(upright));
  EXPECT_EQ(volume_below(upright, -2.5), 0.0);
  const Capsule lying{{{0.0, 0.0, 7.0}, {0.6, 0.8, 0.0}, 2.0}, 0.5};
  EXPECT_NEAR(volume_below(lying, 7.0), 0.5 * volume(lying), tight);
}

TEST(PlaneVolume, ScalesWithTheScene)
{
  for (const double scale : {1e-6, 1e-3, 1e3}) {
    const Capsule unit{{{0.0, 0.0, 0.1}, {0.6, 0.0, 0.8}, 0.8}, 0.3};
    const Capsule scaled{{{0.0, 0.0, 0.1 * scale}, {0.6, 0.0, 0.8}, 0.8 * scale}, 0.3 * scale};
    const double cube = scale * scale * scale;
    EXPECT_NEAR(volume_below(scaled, 0.3 * scale), cube * volume_below(unit, 0.3), 1e-12 * cube);
  }
}

}  // namespace
}  // namespace spherocylinder
