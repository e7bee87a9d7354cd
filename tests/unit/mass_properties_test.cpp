// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/mass_properties.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "test_support.h"

using namespace spherocylinder;

namespace {

// The rod cut into discs across its axis. A disc of radius R and thickness dz has mass
// dm = rho pi R^2 dz, axial inertia dm R^2/2 and, about the rod's centre at the distance z,
// transverse inertia dm (R^2/4 + z^2).
MassProperties by_slices(double diameter, double length, double density)
{
  // Five-point Gauss-Legendre rule on [-1, 1] (Abramowitz & Stegun, table 25.4).
  constexpr double kNode[] = {0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr double kWeight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  constexpr int kPieces = 16;

  const double r = 0.5 * diameter;
  const double half_cylinder = 0.5 * (length - diameter);
  MassProperties sum{};

  const auto add_disc = [&](double z, double thickness) {
    const double beyond = std::max(0.0, z - half_cylinder);
    const double disc_radius_squared = r * r - beyond * beyond;
    const double volume = kPi * disc_radius_squared * thickness;
    sum.volume += volume;
    sum.mass += density * volume;
    sum.inertia_axial += density * volume * 0.5 * disc_radius_squared;
    sum.inertia_transverse += density * volume * (0.25 * disc_radius_squared + z * z);
  };
  const auto add_interval = [&](double from, double to) {
    const double half_piece = 0.5 * (to - from) / kPieces;
    for (int piece = 0; piece < kPieces; piece++) {
      const double middle = from + (2 * piece + 1) * half_piece;
      add_disc(middle, kWeight[0] * half_piece);
      for (int k = 1; k < 3; k++) {
        add_disc(middle - kNode[k] * half_piece, kWeight[k] * half_piece);
        add_disc(middle + kNode[k] * half_piece, kWeight[k] * half_piece);
      }
    }
  };
  add_interval(0.0, half_cylinder);
  add_interval(half_cylinder, half_cylinder + r);

  // The other half of the rod is its mirror image.
  sum.volume *= 2.0;
  sum.mass *= 2.0;
  sum.inertia_axial *= 2.0;
  sum.inertia_transverse *= 2.0;
  return sum;
}

void expect_relative(double value, double expected, double tolerance, const char *what)
{
  EXPECT_NEAR(value / expected, 1.0, tolerance) << what;
}

struct TabulatedRod {
  double aspect_ratio, mass, inertia_axial, inertia_transverse;
};

}  // namespace

// Tabulated values of the closed forms for D = 0.01 m and 2700 kg/m^3, to the digits printed there.
TEST(MassProperties, TabulatedRods)
{
  constexpr TabulatedRod kTable[] = {
      {10.0, 0.0204989, 2.5270e-7, 1.61173e-5},
      {20.0, 0.0417046, 5.1777e-7, 1.34737e-4},
      {30.0, 0.0629104, 7.8285e-7, 4.61880e-4},
  };
  for (const TabulatedRod &rod : kTable) {
    const MassProperties p = mass_properties(0.01, rod.aspect_ratio * 0.01, kDensity);
    EXPECT_NEAR(p.mass, rod.mass, 0.51e-7) << rod.aspect_ratio;
    EXPECT_NEAR(p.inertia_axial, rod.inertia_axial, 0.51e-11) << rod.aspect_ratio;
    // Six digits: half a unit of the last one.
    EXPECT_NEAR(p.inertia_transverse / rod.inertia_transverse, 1.0, 5e-6) << rod.aspect_ratio;
  }
}

// Closed form of a sphere, r = D/2: m = rho 4/3 pi r^3, I = 2/5 m r^2 about every axis, 4 pi r^2.
TEST(MassProperties, LengthEqualToDiameterIsSphere)
{
  for (const double diameter : kDiameters) {
    const double r = 0.5 * diameter;
    const double mass = kDensity * 4.0 / 3.0 * kPi * r * r * r;
    const MassProperties p = mass_properties(diameter, diameter, kDensity);
    expect_relative(p.mass, mass, 4 * kEpsilon, "mass");
    expect_relative(p.volume, mass / kDensity, 4 * kEpsilon, "volume");
    expect_relative(p.area, 4.0 * kPi * r * r, 4 * kEpsilon, "area");
    expect_relative(p.inertia_axial, 0.4 * mass * r * r, 8 * kEpsilon, "axial");
    expect_relative(p.inertia_transverse, 0.4 * mass * r * r, 8 * kEpsilon, "transverse");
  }
}

// Expansion of the closed forms in 1/lambda:
//   I_t / (m L^2/12) = 1 - 2/(3 lambda) + O(1/lambda^2)
//   I_a / (m r^2/2)  = 1 - 2/(15 lambda) + O(1/lambda^2)
// and both second coefficients are smaller than 2.
TEST(MassProperties, ThinRodLimit)
{
  for (const double aspect_ratio : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    const double length = 0.1, diameter = length / aspect_ratio, r = 0.5 * diameter;
    const MassProperties p = mass_properties(diameter, length, kDensity);
    const double transverse = p.inertia_transverse / (p.mass * length * length / 12.0);
    const double axial = p.inertia_axial / (0.5 * p.mass * r * r);
    const double remainder = 2.0 / (aspect_ratio * aspect_ratio) + 8 * kEpsilon;
    EXPECT_NEAR(transverse, 1.0 - 2.0 / (3.0 * aspect_ratio), remainder) << aspect_ratio;
    EXPECT_NEAR(axial, 1.0 - 2.0 / (15.0 * aspect_ratio), remainder) << aspect_ratio;
  }
}

// Independent slow method: integration over slices. The rule is exact for the discs' polynomials,
// so that only the rounding of some 200 added terms is left (bound: 200 epsilon, seldom in one
// direction).
TEST(MassProperties, IntegrationBySlices)
{
  double worst = 0.0;
  for (const double diameter : kDiameters)
    for (const double aspect_ratio : {1.0, 1.001, 1.5, 2.0, 5.0, 10.0, 20.0, 30.0, 1000.0}) {
      const double length = aspect_ratio * diameter;
      const MassProperties p = mass_properties(diameter, length, kDensity);
      const MassProperties q = by_slices(diameter, length, kDensity);
      for (const double ratio :
           {p.volume / q.volume, p.mass / q.mass, p.inertia_axial / q.inertia_axial,
            p.inertia_transverse / q.inertia_transverse})
        worst = std::max(worst, std::fabs(ratio - 1.0));
    }
  std::printf("worst relative difference from slices: %.2e\n", worst);
  EXPECT_LT(worst, 200 * kEpsilon);
}

// Surface: cylinder side 2 pi r h and one whole sphere 4 pi r^2.
TEST(MassProperties, AreaIsSidePlusSphere)
{
  for (const double aspect_ratio : {1.0, 2.0, 10.0, 30.0}) {
    const double r = 0.005, h = (aspect_ratio - 1.0) * 2.0 * r;
    const MassProperties p = mass_properties(2.0 * r, h + 2.0 * r, kDensity);
    expect_relative(p.area, 2.0 * kPi * r * h + 4.0 * kPi * r * r, 8 * kEpsilon, "area");
  }
}

// Same shape k times as large: area k^2, volume and mass k^3, inertias k^5; all but the geometry
// proportional to density.
TEST(MassProperties, ScalingWithSizeAndDensity)
{
  for (const double aspect_ratio : {1.0, 2.0, 10.0, 30.0}) {
    const MassProperties one = mass_properties(1.0, aspect_ratio, 1.0);
    for (const double k : kDiameters) {
      const MassProperties p = mass_properties(k, aspect_ratio * k, kDensity);
      expect_relative(p.area, one.area * k * k, 16 * kEpsilon, "area");
      expect_relative(p.volume, one.volume * k * k * k, 16 * kEpsilon, "volume");
      expect_relative(p.mass, kDensity * one.mass * k * k * k, 16 * kEpsilon, "mass");
      const double fifth = kDensity * k * k * k * k * k;
      expect_relative(p.inertia_axial, one.inertia_axial * fifth, 16 * kEpsilon, "axial");
      expect_relative(p.inertia_transverse, one.inertia_transverse * fifth, 16 * kEpsilon,
                      "transverse");
    }
  }
}

// Each undoes the other. Written as differences of axial and transverse parts they lose up to
// I_t/I_a in digits, here 590 for lambda = 30.
TEST(SymmetricTop, AngularVelocityAndMomentumAreInverse)
{
  RandomRods random(7919);
  for (const double diameter : kDiameters)
    for (const double aspect_ratio : {1.0, 2.0, 10.0, 30.0}) {
      const MassProperties p = mass_properties(diameter, aspect_ratio * diameter, kDensity);
      const double tolerance = 8 * kEpsilon * p.inertia_transverse / p.inertia_axial;
      for (int k = 0; k < 1000; k++) {
        const Vec3 axis = random.direction();
        const Vec3 omega = random.log_uniform(1e-3, 1e6) * random.direction();
        const Vec3 momentum = angular_momentum(omega, axis, p.inertia_axial, p.inertia_transverse);
        const Vec3 back = angular_velocity(momentum, axis, p.inertia_axial, p.inertia_transverse);
        ASSERT_LT(norm(back - omega) / norm(omega), tolerance) << aspect_ratio;
        const Vec3 there =
            angular_momentum(angular_velocity(omega, axis, p.inertia_axial, p.inertia_transverse),
                             axis, p.inertia_axial, p.inertia_transverse);
        ASSERT_LT(norm(there - omega) / norm(omega), tolerance) << aspect_ratio;
      }
    }
}

// Principal axes: L = I_a w along the axis and L = I_t w across it.
TEST(SymmetricTop, PrincipalAxes)
{
  const double axial = 2.0, transverse = 8.0;
  const Vec3 axis{0.0, 0.0, 1.0};
  const Vec3 spin = angular_velocity({0.0, 0.0, 6.0}, axis, axial, transverse);
  EXPECT_EQ(spin.x, 0.0);
  EXPECT_EQ(spin.y, 0.0);
  EXPECT_EQ(spin.z, 3.0);
  const Vec3 tumble = angular_velocity({4.0, -2.0, 0.0}, axis, axial, transverse);
  EXPECT_EQ(tumble.x, 0.5);
  EXPECT_EQ(tumble.y, -0.25);
  EXPECT_EQ(tumble.z, 0.0);
}

// Closed form E = I_a w_a^2/2 + I_t w_t^2/2 with w = w_a u + w_t across.
TEST(SymmetricTop, RotationalEnergy)
{
  RandomRods random(7907);
  for (const double diameter : kDiameters)
    for (const double aspect_ratio : {1.0, 2.0, 10.0, 30.0}) {
      const MassProperties p = mass_properties(diameter, aspect_ratio * diameter, kDensity);
      for (int k = 0; k < 1000; k++) {
        const Vec3 axis = random.direction();
        const double spin = random.uniform(-100.0, 100.0), tumble = random.uniform(1.0, 100.0);
        const Vec3 omega = spin * axis + tumble * random.across(axis);
        const Vec3 momentum = angular_momentum(omega, axis, p.inertia_axial, p.inertia_transverse);
        const double expected =
            0.5 * p.inertia_axial * spin * spin + 0.5 * p.inertia_transverse * tumble * tumble;
        const double energy =
            rotational_energy(momentum, axis, p.inertia_axial, p.inertia_transverse);
        // The axial part of L is found to I_t/I_a epsilon when the rod mostly tumbles.
        ASSERT_NEAR(energy / expected, 1.0, 8 * kEpsilon * p.inertia_transverse / p.inertia_axial);
      }
    }
}

// Of a straight fibre the sum of all segments is one rod: volume, mass, surface and axial inertia in closed
// form; with both ends shared a segment is a cylinder, I_t = m (h^2/12 + r^2/4).
TEST(MassProperties, SharedEndsCountOnce)
{
  for (const double diameter : kDiameters)
    for (const double h : {0.5, 1.0, 8.0}) {
      const double r = 0.5 * diameter, length = h * diameter + diameter;
      const MassProperties end = mass_properties(diameter, length, kDensity, 1);
      const MassProperties inner = mass_properties(diameter, length, kDensity, 2);
      const MassProperties whole =
          mass_properties(diameter, 5.0 * h * diameter + diameter, kDensity);
      expect_relative(2.0 * end.volume + 3.0 * inner.volume, whole.volume, 16 * kEpsilon, "volume");
      expect_relative(2.0 * end.mass + 3.0 * inner.mass, whole.mass, 16 * kEpsilon, "mass");
      expect_relative(2.0 * end.area + 3.0 * inner.area, whole.area, 16 * kEpsilon, "area");
      expect_relative(2.0 * end.inertia_axial + 3.0 * inner.inertia_axial, whole.inertia_axial,
                      16 * kEpsilon, "axial");
      const double cylinder = h * h * diameter * diameter / 12.0 + 0.25 * r * r;
      expect_relative(inner.inertia_transverse, inner.mass * cylinder, 16 * kEpsilon, "transverse");
    }
}
