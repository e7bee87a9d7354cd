// SPDX-License-Identifier: GPL-2.0-or-later
// How the axes of a set of rods point. Spheres have no axis: leave them out with axes_of.
#pragma once

#include <cstddef>
#include <vector>

#include "io/rods.h"
#include "measures/mean_with_error.h"

namespace spherocylinder {

std::vector<Vec3> axes_of(const std::vector<Rod> &rods);

// Axes that point anywhere with equal chance have P(elevation < a) = sin a, so that the mean
// elevation is integral_0^(pi/2) a cos a da = pi/2 - 1.
constexpr double kIsotropicMeanElevation = 0.57079632679489662;  // rad, 32.70 degrees
constexpr double kIsotropicMeanAbsUz = 0.5;
constexpr double kIsotropicMeanUzSquared = 1.0 / 3.0;

MeanWithError mean_elevation(const std::vector<Vec3> &axes);  // rad
MeanWithError mean_abs_uz(const std::vector<Vec3> &axes);
MeanWithError mean_uz_squared(const std::vector<Vec3> &axes);

// <|sin gamma|> over all pairs of axes. For more than `most_axes` an evenly spread part of that
// many stands for all, since the work grows with the square. 0 for a single axis.
constexpr std::size_t kMostAxesPaired = 10000;
double mean_sin_gamma(const std::vector<Vec3> &axes, std::size_t most_axes = kMostAxesPaired);

// The same with its standard error for independent axes. n axes make n^2/2 pairs, but these are not
// independent: the variance of the mean is
//   (4 (n - 2) V_1 + 2 V_2)/(n (n - 1)),
// V_2 the variance of sin gamma over pairs and V_1 that of its mean h_i over all partners of axis
// i, 0 for isotropic axes (Hoeffding, Ann. Math. Stat. 19 (1948) 293). (n - 2) V_1 is estimated
// from the h_i found, (n - 1) var(h) - V_2. NaN for a single axis.
MeanWithError sin_gamma_of_pairs(const std::vector<Vec3> &axes,
                                 std::size_t most_axes = kMostAxesPaired);

// Q = <3/2 u u - 1/2 I>: symmetric, without trace.
struct NematicTensor {
  double xx, yy, zz, xy, xz, yz;
};

NematicTensor nematic_tensor(const std::vector<Vec3> &axes);

// Eigenvalue of largest magnitude of Q and its eigenvector n (with z >= 0): 1 all parallel, 0
// isotropic, -1/2 all at right angles to the director. To first order an eigenvalue changes as
// <P_2(u.n)> along n, whose standard error it is given.
struct NematicOrder {
  double order;
  Vec3 director;
  double error;
};

NematicOrder nematic_order(const std::vector<Vec3> &axes);

// The square of the order without the part that the finite number n of axes makes: <P_2(u_i.u_j)>
// over different axes, which is (2/3 n Q:Q - 1)/(n - 1). On average 0 for isotropic axes and S^2
// for axes about one director, whatever n, while the magnitude of the order itself is 1/sqrt(n)
// where it should be 0. NaN for a single axis.
double unbiased_squared_order(const std::vector<Vec3> &axes);

// Its standard deviation for n isotropic axes: n(n-1)/2 pairs with <P_2^2> = 1/5.
double isotropic_scatter_of_squared_order(std::size_t axes);

// How far the headings agree, whatever the elevation. phi is the angle of an axis in the horizontal
// plane; the order is |<exp(2 i phi)>|, 0 for any headings and 1 for one. Of n axes without a
// common heading it is 1/sqrt(n); `squared_unbiased` is <cos 2(phi_i - phi_j)> over different axes,
// (n order^2 - 1)/(n - 1). Vertical axes have no heading and are left out.
struct AzimuthalOrder {
  double order;
  double azimuth;  // of the common heading, 0 to pi from x (rad)
  double error;    // standard error of the order
  double squared_unbiased;
};

AzimuthalOrder azimuthal_order(const std::vector<Vec3> &axes);

// <cos 2(phi - phi_r)>, phi_r the direction of the rod's centre from the vessel's axis: 1 if all
// rods point at the axis, -1 if all lie around it, 0 if neither. NaN if none has a heading.
MeanWithError radial_order(const std::vector<Rod> &rods, double axis_x, double axis_y);

enum class BinSpacing {
  EqualSolidAngle,  // equal steps of sin(elevation): an isotropic set fills all bins alike
  EqualAngle,
};

struct ElevationBin {
  double low, high;  // rad
  std::size_t count;
  MeanWithError part;         // of all axes; NaN if there are none
  double isotropic_fraction;  // sin(high) - sin(low)
  double isotropic_scatter;   // standard deviation of the part of as many isotropic axes

  MeanWithError density() const  // 1 if isotropic
  {
    return {part.mean / isotropic_fraction, part.error / isotropic_fraction};
  }
};

// Elevation of the axes from 0 to pi/2 in `bins` bins; an axis on an edge counts in the upper bin.
std::vector<ElevationBin> elevation_histogram(const std::vector<Vec3> &axes, std::size_t bins,
                                              BinSpacing spacing);

// Sum of (count - expected)^2/expected against isotropic; its degrees of freedom are bins - 1.
double chi_squared_isotropic(const std::vector<ElevationBin> &histogram, std::size_t axes);

}  // namespace spherocylinder
