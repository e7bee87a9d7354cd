// SPDX-License-Identifier: GPL-2.0-or-later
// How the axes of a set of rods point. Spheres have no axis: leave them out with axes_of.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/mean_with_error.h"
#include "analysis/rods.h"

namespace spherocylinder {

std::vector<Vec3> axes_of(const std::vector<Rod> &rods);

// Axes that point anywhere with equal chance have P(elevation < a) = sin a, so that the mean
// elevation is integral_0^(pi/2) a cos a da = pi/2 - 1.
constexpr double isotropic_mean_elevation = 0.57079632679489662;  // rad, 32.70 degrees
constexpr double isotropic_mean_abs_uz = 0.5;
constexpr double isotropic_mean_uz_squared = 1.0 / 3.0;

MeanWithError mean_elevation(const std::vector<Vec3> &axes);  // rad
MeanWithError mean_abs_uz(const std::vector<Vec3> &axes);
MeanWithError mean_uz_squared(const std::vector<Vec3> &axes);

// <|sin gamma|> over all pairs of axes. For more than `most_axes` an evenly spread part of that
// many stands for all, since the work grows with the square.
double mean_sin_gamma(const std::vector<Vec3> &axes, std::size_t most_axes = 10000);

// Eigenvalue of largest magnitude of Q = <3/2 u u - 1/2 I> and its eigenvector (with z >= 0):
// 1 all parallel, 0 isotropic, -1/2 all at right angles to the director.
struct NematicOrder {
  double order;
  Vec3 director;
};

NematicOrder nematic_order(const std::vector<Vec3> &axes);

enum class BinSpacing {
  equal_solid_angle,  // equal steps of sin(elevation): an isotropic set fills all bins alike
  equal_angle,
};

struct ElevationBin {
  double low, high;  // rad
  std::size_t count;
  double fraction;
  double fraction_error;      // standard error of the fraction
  double isotropic_fraction;  // sin(high) - sin(low)
  double isotropic_scatter;   // standard deviation of the fraction of as many isotropic axes

  double density() const { return fraction / isotropic_fraction; }  // 1 if isotropic
  double density_error() const { return fraction_error / isotropic_fraction; }
};

// Elevation of the axes from 0 to pi/2 in `bins` bins; an axis on an edge counts in the upper bin.
// The standard error is sqrt(p (1 - p)/n) with p = (count + 1)/(n + 2) (Laplace), so that an empty
// bin does not claim to be certain.
std::vector<ElevationBin> elevation_histogram(const std::vector<Vec3> &axes, std::size_t bins,
                                              BinSpacing spacing);

// Sum of (count - expected)^2/expected against isotropic; its degrees of freedom are bins - 1.
double chi_squared_isotropic(const std::vector<ElevationBin> &histogram, std::size_t axes);

}  // namespace spherocylinder
