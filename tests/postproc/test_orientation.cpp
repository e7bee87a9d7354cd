// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "analysis/orientation_statistics.h"
#include "analysis/packing_theory.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

constexpr double pi = 3.14159265358979323846;

// Directions at even angles in the horizontal plane.
std::vector<Vec3> horizontal_directions(std::size_t count)
{
  std::vector<Vec3> axes;
  for (std::size_t i = 0; i < count; ++i) {
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
  EXPECT_NEAR(isotropic_mean_elevation, pi / 2 - 1, 1e-15);
  EXPECT_NEAR(mean_elevation(axes).mean, pi / 2 - 1, 1e-3);
  EXPECT_NEAR(mean_abs_uz(axes).mean, 0.5, 1e-3);
  EXPECT_NEAR(mean_uz_squared(axes).mean, 1.0 / 3.0, 1e-3);
  EXPECT_NEAR(nematic_order(axes).order, 0.0, 1e-3);
  EXPECT_NEAR(mean_sin_gamma(axes), isotropic_sin_gamma, 1e-3);
  for (const ElevationBin &bin : elevation_histogram(axes, 20, BinSpacing::equal_solid_angle)) {
    EXPECT_NEAR(bin.isotropic_fraction, 0.05, 1e-12);
    EXPECT_NEAR(bin.fraction, 0.05, 1e-3);
    EXPECT_NEAR(bin.density(), 1.0, 0.02);
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
  EXPECT_NEAR(mean_sin_gamma(axes), horizontal_sin_gamma, 1e-3);
  const auto bins = elevation_histogram(axes, 9, BinSpacing::equal_angle);
  EXPECT_EQ(bins.front().count, 1000u);
  EXPECT_EQ(bins.back().count, 0u);
  EXPECT_GT(bins.back().fraction_error, 0.0);  // an empty bin is not certain
}

// All along one direction, half of them turned round: a sign carries no meaning.
TEST(Orientation, ParallelDirections)
{
  const Vec3 u{0.48, 0.6, 0.64};
  std::vector<Vec3> axes(10, u);
  for (std::size_t i = 0; i < 5; ++i) axes[i] = -u;
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
  const auto bins = elevation_histogram(axes, 2, BinSpacing::equal_solid_angle);
  EXPECT_NEAR(bins[0].high, pi / 6, 1e-12);  // asin(1/2)
  EXPECT_EQ(bins[0].count, 1u);
  EXPECT_EQ(bins[1].count, 3u);
  // (1 - 2)^2/2 + (3 - 2)^2/2
  EXPECT_NEAR(chi_squared_isotropic(bins, axes.size()), 1.0, 1e-9);
  // Laplace: p = 4/6, sqrt(p (1 - p)/4); binomial scatter of the null sqrt(1/4 / 4).
  EXPECT_NEAR(bins[1].fraction_error, std::sqrt(4.0 / 6.0 * 2.0 / 6.0 / 4.0), 1e-12);
  EXPECT_NEAR(bins[1].isotropic_scatter, 0.25, 1e-12);
}

TEST(Orientation, StandardErrorOfTheMean)
{
  // u_z^2 = 0 and 1: mean 1/2, sample deviation sqrt(1/2), over sqrt(2).
  const MeanWithError found = mean_uz_squared({{1, 0, 0}, {0, 0, 1}});
  EXPECT_DOUBLE_EQ(found.mean, 0.5);
  EXPECT_NEAR(found.error, 0.5, 1e-15);
}

TEST(Orientation, PartOfManyAxesStandsForAll)
{
  const auto axes = even_directions(4000);
  EXPECT_NEAR(mean_sin_gamma(axes, 1000), isotropic_sin_gamma, 5e-3);
  EXPECT_EQ(mean_sin_gamma({{0, 0, 1}}), 0.0);
}

TEST(Orientation, SpheresHaveNoAxis)
{
  const Rod sphere{1, 1, {{{0, 0, 0}, {0, 0, 1}, 0.0}, 0.5}};
  const Rod rod{2, 1, {{{0, 0, 0}, {0, 0, 1}, 1.0}, 0.5}};
  EXPECT_EQ(axes_of({sphere, rod, sphere}).size(), 1u);
}

}  // namespace
}  // namespace spherocylinder
