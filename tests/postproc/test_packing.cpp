// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "core/numbers.h"
#include "measures/packing_measures.h"
#include "measures/packing_theory.h"
#include "solid/capsule_measures.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

Rod rod(const Vec3 &centre, const Vec3 &axis, double half_length, double radius)
{
  return {1, 1, {{centre, axis, half_length}, radius}};
}

// 2 ln(lambda)/lambda as tabulated for the paper's rods.
TEST(PackingTheory, ParkhouseKelly)
{
  EXPECT_NEAR(parkhouse_kelly_fraction(10), 0.4605, 5e-5);
  EXPECT_NEAR(parkhouse_kelly_fraction(20), 0.2996, 5e-5);
  EXPECT_NEAR(parkhouse_kelly_fraction(30), 0.2267, 5e-5);
}

// Values worked out by hand from the same equation for c = 5.25, total length over diameter.
TEST(PackingTheory, RandomContact)
{
  EXPECT_NEAR(random_contact_fraction(10, kIsotropicSinGamma), 0.4241, 5e-5);
  EXPECT_NEAR(random_contact_fraction(20, kIsotropicSinGamma), 0.2348, 5e-5);
  EXPECT_NEAR(random_contact_fraction(30, kIsotropicSinGamma), 0.1623, 5e-5);
  EXPECT_NEAR(random_contact_fraction(10, kHorizontalSinGamma), 0.487, 6e-4);
  EXPECT_NEAR(random_contact_fraction(20, kHorizontalSinGamma), 0.278, 6e-4);
  EXPECT_NEAR(random_contact_fraction(30, kHorizontalSinGamma), 0.195, 6e-4);
  EXPECT_NEAR(random_contact_fraction(10, kIsotropicSinGamma, 5.4), 0.436, 6e-4);
}

// pi/sqrt 18, the densest packing of spheres, pi/sqrt 12, that of parallel cylinders, between them
// more the longer the rod.
TEST(PackingTheory, DensestPacking)
{
  EXPECT_NEAR(densest_fraction(1), pi / std::sqrt(18.0), 1e-14);
  EXPECT_NEAR(densest_fraction(1e9), pi / std::sqrt(12.0), 1e-9);
  for (double lambda = 1; lambda < 100; lambda *= 1.1)
    EXPECT_LT(densest_fraction(lambda), densest_fraction(1.1 * lambda));
}

// Nothing for short rods and nothing above the densest packing, for any ratio, direction and number
// of contacts.
TEST(PackingTheory, IsForSlenderRods)
{
  EXPECT_TRUE(std::isnan(parkhouse_kelly_fraction(2.7)));
  EXPECT_NEAR(parkhouse_kelly_fraction(std::exp(1.0)), 2 / std::exp(1.0), 1e-14);
  for (const double lambda : {1.0, 1.5, 2.0, 3.0, 4.99}) {
    EXPECT_TRUE(std::isnan(random_contact_fraction(lambda, kIsotropicSinGamma)));
    EXPECT_TRUE(std::isnan(random_contact_fraction(lambda, kIsotropicSinGamma, 2.0)));
  }
  // 10.5 (1 + 1/6) / (8 + 8 + 4/3), also of a dump with six digits.
  EXPECT_NEAR(random_contact_fraction(5.0, kIsotropicSinGamma), 0.70673, 5e-6);
  EXPECT_NEAR(random_contact_fraction(4.9999, kIsotropicSinGamma), 0.7067, 5e-5);
  for (double lambda = 5.0; lambda < 200.0; lambda *= 1.07)
    for (double sin_gamma = 0.0; sin_gamma <= 1.0; sin_gamma += 0.02)
      for (const double half_contacts : {1.0, 5.25, 8.0}) {
        const double x = lambda - 1.0;
        const double equation = 2.0 * half_contacts * (x / 4.0 + 1.0 / 6.0) /
                                (2.0 * sin_gamma / pi * x * x + 2.0 * x + 4.0 / 3.0);
        const double found = random_contact_fraction(lambda, sin_gamma, half_contacts);
        if (equation > densest_fraction(lambda)) {
          EXPECT_TRUE(std::isnan(found)) << lambda << " " << sin_gamma;
        } else {
          EXPECT_NEAR(found, equation, 1e-14) << lambda << " " << sin_gamma;
        }
      }
}

TEST(PackingMeasures, InnerCylinderHoldsHalf)
{
  const UprightCylinder whole = vessel_up_to({0.1, 0.2, 0.3, -1.0}, 0.5);
  const UprightCylinder inner = inner_half(whole);
  EXPECT_NEAR(volume(whole), pi * 0.09 * 1.5, 1e-15);
  EXPECT_NEAR(volume(inner) / volume(whole), 0.5, 1e-14);
  EXPECT_NEAR(inner.z_low + inner.z_high, whole.z_low + whole.z_high, 1e-14);
  EXPECT_NEAR(inner.radius / whole.radius,
              (inner.z_high - inner.z_low) / (whole.z_high - whole.z_low), 1e-14);
}

TEST(PackingMeasures, HeightAndCount)
{
  const std::vector<Rod> rods{rod({0, 0, 1}, {0, 0, 1}, 0.5, 0.1),
                              rod({0, 0, 1.2}, {1, 0, 0}, 0.5, 0.1),
                              rod({2, 0, 0.5}, {1, 0, 0}, 0.5, 0.1)};
  EXPECT_DOUBLE_EQ(bed_height(rods).highest_centre, 1.2);
  EXPECT_DOUBLE_EQ(bed_height(rods).highest_point, 1.6);  // tip of the upright one
  EXPECT_EQ(count_outside(rods, {0, 0, 1.0, 0.0}), 1u);   // one beyond the wall
  EXPECT_EQ(count_outside(rods, {0, 0, 3.0, 0.7}), 1u);   // one below the floor
  EXPECT_EQ(count_outside(rods, {0, 0, 3.0, 0.0}), 0u);
}

// Rods as standing bars through a region: each adds pi r^2 of its cross-section, V_f = n r^2/R^2.
TEST(PackingMeasures, StandingBars)
{
  std::vector<Rod> rods;
  for (int i = 0; i < 5; i++) rods.push_back(rod({0.1 * i - 0.2, 0, 0}, {0, 0, 1}, 3.0, 0.04));
  const SolidFraction found = solid_fraction(rods, {0, 0, 0.5, -1, 1}, 1e-6);
  EXPECT_NEAR(found.fraction, 5 * 0.04 * 0.04 / 0.25, found.error + 1e-14);
  EXPECT_LE(found.error, 1e-6 * found.fraction);
}

// Volumes in a region and in the rest of the space add up to all rods: checks the sum over a
// random bed with a region that holds everything, and halves of it.
TEST(PackingMeasures, HalvesOfABed)
{
  BedOptions options;
  options.rods = 60;
  const auto rods = random_bed(options);
  const auto solid = [&](double low, double high) {
    const SolidFraction part = solid_fraction(rods, {0, 0, 1, low, high}, 1e-5);
    return part.fraction * volume(part.region);
  };
  const double all = total_volume(rods);
  EXPECT_NEAR(solid(-1, 2), all, 1e-12 * all);
  EXPECT_NEAR(solid(-1, 0.1) + solid(0.1, 2), all, 2e-5 * all);
}

}  // namespace
}  // namespace spherocylinder
