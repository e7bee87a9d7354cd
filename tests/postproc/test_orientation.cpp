// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "core/numbers.h"
#include "measures/orientation_statistics.h"
#include "measures/packing_theory.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

// Directions at even angles in the horizontal plane.
std::vector<Vec3> horizontal_directions(std::size_t count)
{
  std::vector<Vec3> axes;
  for (std::size_t i = 0; i < count; i++) {
    const double angle = pi * static_cast<double>(i) / static_cast<double>(count);
    axes.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  return axes;
}

// Isotropic: P(elevation < a) = sin a, hence mean pi/2 - 1, <|u_z|> = 1/2, <u_z^2> = 1/3, Q = 0,
// <|sin gamma|> = pi/4 (closed_forms, isotropic null).
TEST(Orientation, EvenDirectionsAreIsotropic)
{
  const auto axes = even_directions(4000);
  EXPECT_NEAR(kIsotropicMeanElevation, pi / 2 - 1, 1e-15);
  EXPECT_NEAR(mean_elevation(axes).mean, pi / 2 - 1, 1e-3);
  EXPECT_NEAR(mean_abs_uz(axes).mean, 0.5, 1e-3);
  EXPECT_NEAR(mean_uz_squared(axes).mean, 1.0 / 3.0, 1e-3);
  EXPECT_NEAR(nematic_order(axes).order, 0.0, 1e-3);
  EXPECT_NEAR(mean_sin_gamma(axes), kIsotropicSinGamma, 1e-3);
  for (const ElevationBin &bin : elevation_histogram(axes, 20, BinSpacing::EqualSolidAngle)) {
    EXPECT_NEAR(bin.isotropic_fraction, 0.05, 1e-12);
    EXPECT_NEAR(bin.part.mean, 0.05, 1e-3);
    EXPECT_NEAR(bin.density().mean, 1.0, 0.02);
  }
}

// All at right angles to z, even in the plane: order -1/2 with director z, <|sin gamma|> = 2/pi.
TEST(Orientation, HorizontalDirections)
{
  const auto axes = horizontal_directions(1000);
  EXPECT_EQ(mean_elevation(axes).mean, 0.0);
  EXPECT_EQ(mean_elevation(axes).error, 0.0);
  EXPECT_NEAR(nematic_order(axes).order, -0.5, 1e-12);
  EXPECT_NEAR(nematic_order(axes).director.z, 1.0, 1e-12);
  EXPECT_NEAR(mean_sin_gamma(axes), kHorizontalSinGamma, 1e-3);
  const auto bins = elevation_histogram(axes, 9, BinSpacing::EqualAngle);
  EXPECT_EQ(bins.front().count, 1000u);
  EXPECT_EQ(bins.back().count, 0u);
  EXPECT_GT(bins.back().part.error, 0.0);  // an empty bin is not certain
}

// All along one direction, half of them turned round: a sign carries no meaning.
TEST(Orientation, ParallelDirections)
{
  const Vec3 u{0.48, 0.6, 0.64};
  std::vector<Vec3> axes(10, u);
  for (std::size_t i = 0; i < 5; i++) axes[i] = -u;
  const NematicOrder found = nematic_order(axes);
  EXPECT_NEAR(found.order, 1.0, 1e-12);
  EXPECT_NEAR(dot(found.director, u), 1.0, 1e-12);
  EXPECT_NEAR(mean_elevation(axes).mean, std::asin(0.64), 1e-12);
  EXPECT_NEAR(mean_sin_gamma(axes), 0.0, 1e-12);
}

TEST(Orientation, HistogramEdges)
{
  // Horizontal falls in the first bin, vertical in the last; sin(elevation) = 0.5 is an edge.
  const std::vector<Vec3> axes{{1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {std::sqrt(0.75), 0, 0.5001}};
  const auto bins = elevation_histogram(axes, 2, BinSpacing::EqualSolidAngle);
  EXPECT_NEAR(bins[0].high, pi / 6, 1e-12);  // asin(1/2)
  EXPECT_EQ(bins[0].count, 1u);
  EXPECT_EQ(bins[1].count, 3u);
  // (1 - 2)^2/2 + (3 - 2)^2/2
  EXPECT_NEAR(chi_squared_isotropic(bins, axes.size()), 1.0, 1e-9);
  // Laplace: p = 4/6, sqrt(p (1 - p)/4); binomial scatter of the null sqrt(1/4 / 4).
  EXPECT_NEAR(bins[1].part.error, std::sqrt(4.0 / 6.0 * 2.0 / 6.0 / 4.0), 1e-12);
  EXPECT_NEAR(bins[1].isotropic_scatter, 0.25, 1e-12);
}

TEST(Orientation, StandardErrorOfTheMean)
{
  // u_z^2 = 0 and 1: mean 1/2, sample deviation sqrt(1/2), over sqrt(2).
  const MeanWithError found = mean_uz_squared({{1, 0, 0}, {0, 0, 1}});
  EXPECT_DOUBLE_EQ(found.mean, 0.5);
  EXPECT_NEAR(found.error, 0.5, 1e-15);
}

// A part `aligned` of the axes lies along n, the others are isotropic: <P_2(u.n)> = aligned.
std::vector<Vec3> partly_aligned(std::size_t count, double aligned, const Vec3 &n,
                                 std::mt19937 &random)
{
  std::uniform_real_distribution<double> part(0.0, 1.0);
  auto axes = random_directions(count, random);
  for (Vec3 &u : axes)
    if (part(random) < aligned) u = n;
  return axes;
}

// All axes on a cone of half angle a about n, at even angles: Q has the eigenvalue P_2(cos a).
TEST(Orientation, OrderOfACone)
{
  const Vec3 n{0.48, 0.6, 0.64}, v{0.8, 0.0, -0.6}, w = cross(n, v);
  for (const double a : {0.0, 0.3, 0.8, 1.2, 0.5 * pi}) {
    std::vector<Vec3> axes;
    for (int k = 0; k < 60; k++) {
      const double phi = 2.0 * pi * k / 60;
      axes.push_back(std::cos(a) * n + std::sin(a) * (std::cos(phi) * v + std::sin(phi) * w));
    }
    const double order = 1.5 * std::cos(a) * std::cos(a) - 0.5;
    const NematicOrder found = nematic_order(axes);
    EXPECT_NEAR(found.order, order, 1e-12) << a;
    EXPECT_NEAR(std::abs(dot(found.director, n)), 1.0, 1e-9) << a;
    EXPECT_NEAR(found.error, 0.0, 1e-7) << a;  // all have the same angle to n
    // <P_2> over different axes: (n^2 S^2 - n)/(n^2 - n).
    EXPECT_NEAR(unbiased_squared_order(axes), (60 * order * order - 1) / 59, 1e-12) << a;
    const NematicTensor q = nematic_tensor(axes);
    EXPECT_NEAR(q.xx + q.yy + q.zz, 0.0, 1e-13);
    EXPECT_NEAR(q.xy, 1.5 * order * n.x * n.y, 1e-12);  // 3/2 S (n n - 1/3)
  }
}

// Of 40 axes the order itself is 1/sqrt(40) where it should be 0; its unbiased square is right on
// average and scatters as stated.
TEST(Orientation, SquaredOrderHasNoBias)
{
  std::mt19937 random(20220101);
  constexpr std::size_t kAxes = 40, kDraws = 4000;
  for (const double aligned : {0.0, 0.5}) {
    std::vector<double> squared, raw;
    for (std::size_t k = 0; k < kDraws; k++) {
      const auto set = partly_aligned(kAxes, aligned, {0.48, 0.6, 0.64}, random);
      squared.push_back(unbiased_squared_order(set));
      raw.push_back(std::pow(nematic_order(set).order, 2));
    }
    const MeanWithError found = mean_of(squared);
    EXPECT_NEAR(found.mean, aligned * aligned, 4.0 * found.error) << aligned;
    EXPECT_LT(found.error, 0.003) << aligned;
    if (aligned > 0.0) continue;
    EXPECT_GT(mean_of(raw).mean, 0.5 / kAxes);
    // The scatter of a scatter: 1/sqrt(2 draws) and some for the long tail.
    EXPECT_NEAR(found.error * std::sqrt(kDraws) / isotropic_scatter_of_squared_order(kAxes), 1.0,
                0.08);
  }
}

// The stated errors are the scatter over many sets: of the order along the director, of the heading
// and of <|sin gamma|>, whose pairs are not independent.
TEST(Orientation, ErrorsAreTheScatter)
{
  std::mt19937 random(20220102);
  constexpr std::size_t kAxes = 60, kDraws = 1500;
  for (const double aligned : {0.0, 0.6}) {
    std::vector<double> order, order_error, heading, heading_error, sine, sine_variance;
    for (std::size_t k = 0; k < kDraws; k++) {
      const auto set = partly_aligned(kAxes, aligned, {0.6, 0.8, 0.0}, random);
      order.push_back(nematic_order(set).order);
      order_error.push_back(nematic_order(set).error);
      heading.push_back(azimuthal_order(set).order);
      heading_error.push_back(azimuthal_order(set).error);
      const MeanWithError sin_gamma = sin_gamma_of_pairs(set);
      sine.push_back(sin_gamma.mean);
      sine_variance.push_back(sin_gamma.error * sin_gamma.error);
    }
    const auto scatter = [&](const std::vector<double> &values) {
      return mean_of(values).error * std::sqrt(static_cast<double>(kDraws));
    };
    // Where nothing is aligned the variance estimate is cut off at its smallest value, so that it
    // is up to a third too large there.
    EXPECT_NEAR(std::sqrt(mean_of(sine_variance).mean) / scatter(sine), aligned > 0.0 ? 1.0 : 1.15,
                aligned > 0.0 ? 0.08 : 0.2)
        << aligned;
    if (aligned == 0.0) continue;
    EXPECT_NEAR(mean_of(order_error).mean / scatter(order), 1.0, 0.08);
    EXPECT_NEAR(mean_of(heading_error).mean / scatter(heading), 1.0, 0.08);
  }
}

TEST(Orientation, AzimuthalOrder)
{
  // One heading, 20 degrees, at any elevation and of either sign.
  std::vector<Vec3> axes;
  const double phi = 20.0 * pi / 180.0;
  for (const double elevation : {0.1, 0.5, 1.0, 1.5})
    for (const double sign : {-1.0, 1.0})
      axes.push_back(sign * Vec3{std::cos(elevation) * std::cos(phi),
                                 std::cos(elevation) * std::sin(phi), std::sin(elevation)});
  EXPECT_NEAR(azimuthal_order(axes).order, 1.0, 1e-12);
  EXPECT_NEAR(azimuthal_order(axes).azimuth, phi, 1e-12);
  EXPECT_NEAR(azimuthal_order(axes).squared_unbiased, 1.0, 1e-12);
  axes.push_back({0, 0, 1});  // has no heading
  EXPECT_NEAR(azimuthal_order(axes).order, 1.0, 1e-12);

  const AzimuthalOrder even = azimuthal_order(horizontal_directions(100));
  EXPECT_NEAR(even.order, 0.0, 1e-12);
  EXPECT_NEAR(even.squared_unbiased, -1.0 / 99.0, 1e-12);
  // Two headings at right angles cancel, three of four do not: |1 + 1 + 1 - 1|/4.
  EXPECT_NEAR(azimuthal_order({{1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}).order, 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(azimuthal_order({{0, 0, 1}}).order));
}

// Rods on a circle about (1, 2): towards the axis, around it, and at 45 degrees to both.
TEST(Orientation, RadialOrder)
{
  for (const auto &[turn, wanted] : {std::pair{0.0, 1.0}, {0.5 * pi, -1.0}, {0.25 * pi, 0.0}}) {
    std::vector<Rod> rods;
    for (int k = 0; k < 12; k++) {
      const double phi = 2.0 * pi * k / 12 + 0.1;
      const Vec3 centre{1 + std::cos(phi), 2 + std::sin(phi), 0.3};
      const Vec3 axis{0.6 * std::cos(phi + turn), 0.6 * std::sin(phi + turn), 0.8};
      rods.push_back({k + 1, 1, {{centre, axis, 0.1}, 0.01}});
    }
    EXPECT_NEAR(radial_order(rods, 1, 2).mean, wanted, 1e-12) << turn;
    EXPECT_NEAR(radial_order(rods, 1, 2).error, 0.0, 1e-12) << turn;
  }
  EXPECT_TRUE(std::isnan(radial_order({}, 0, 0).mean));
}

TEST(Orientation, PartOfManyAxesStandsForAll)
{
  const auto axes = even_directions(4000);
  EXPECT_NEAR(mean_sin_gamma(axes, 1000), kIsotropicSinGamma, 5e-3);
  EXPECT_EQ(mean_sin_gamma({{0, 0, 1}}), 0.0);
  EXPECT_TRUE(std::isnan(sin_gamma_of_pairs({{0, 0, 1}}).mean));
}

TEST(Orientation, SpheresHaveNoAxis)
{
  const Rod sphere{1, 1, {{{0, 0, 0}, {0, 0, 1}, 0.0}, 0.5}};
  const Rod rod{2, 1, {{{0, 0, 0}, {0, 0, 1}, 1.0}, 0.5}};
  EXPECT_EQ(axes_of({sphere, rod, sphere}).size(), 1u);
}

}  // namespace
}  // namespace spherocylinder
