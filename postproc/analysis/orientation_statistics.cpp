// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/orientation_statistics.h"

#include <algorithm>
#include <cmath>

#include <vtkMath.h>

namespace spherocylinder {
namespace {

double edge_of(std::size_t i, std::size_t bins, BinSpacing spacing)
{
  constexpr double right_angle = 1.57079632679489662;
  const double part = static_cast<double>(i) / static_cast<double>(bins);
  return spacing == BinSpacing::equal_angle ? part * right_angle : std::asin(part);
}

}  // namespace

std::vector<Vec3> axes_of(const std::vector<Rod> &rods)
{
  std::vector<Vec3> axes;
  axes.reserve(rods.size());
  for (const Rod &rod : rods)
    if (!rod.is_sphere()) axes.push_back(rod.capsule.segment.axis);
  return axes;
}

MeanWithError mean_elevation(const std::vector<Vec3> &axes)
{
  return mean_of(axes, [](const Vec3 &u) { return elevation(u); });
}

MeanWithError mean_abs_uz(const std::vector<Vec3> &axes)
{
  return mean_of(axes, [](const Vec3 &u) { return std::abs(u.z); });
}

MeanWithError mean_uz_squared(const std::vector<Vec3> &axes)
{
  return mean_of(axes, [](const Vec3 &u) { return u.z * u.z; });
}

double mean_sin_gamma(const std::vector<Vec3> &axes, std::size_t most_axes)
{
  const std::size_t n = std::min(axes.size(), most_axes);
  if (n < 2) return 0.0;
  const auto picked = [&](std::size_t i) -> const Vec3 & { return axes[i * axes.size() / n]; };
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) sum += norm(cross(picked(i), picked(j)));
  return sum / (0.5 * static_cast<double>(n) * static_cast<double>(n - 1));
}

NematicOrder nematic_order(const std::vector<Vec3> &axes)
{
  double q[3][3] = {{-0.5, 0.0, 0.0}, {0.0, -0.5, 0.0}, {0.0, 0.0, -0.5}};
  for (const Vec3 &axis : axes) {
    const double u[3] = {axis.x, axis.y, axis.z};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) q[i][j] += 1.5 * u[i] * u[j] / static_cast<double>(axes.size());
  }
  double *rows[3] = {q[0], q[1], q[2]};
  double vectors[3][3];
  double *vector_rows[3] = {vectors[0], vectors[1], vectors[2]};
  double values[3];  // falling
  vtkMath::Jacobi(rows, values, vector_rows);
  const int pick = std::abs(values[0]) >= std::abs(values[2]) ? 0 : 2;
  const Vec3 director{vectors[0][pick], vectors[1][pick], vectors[2][pick]};
  return {values[pick], director.z < 0.0 ? -director : director};
}

std::vector<ElevationBin> elevation_histogram(const std::vector<Vec3> &axes, std::size_t bins,
                                              BinSpacing spacing)
{
  std::vector<ElevationBin> histogram(bins);
  for (std::size_t i = 0; i < bins; ++i) {
    histogram[i] = {};
    histogram[i].low = edge_of(i, bins, spacing);
    histogram[i].high = edge_of(i + 1, bins, spacing);
    histogram[i].isotropic_fraction = std::sin(histogram[i].high) - std::sin(histogram[i].low);
  }
  for (const Vec3 &u : axes) {
    const auto above =
        std::upper_bound(histogram.begin(), histogram.end(), elevation(u),
                         [](double angle, const ElevationBin &bin) { return angle < bin.low; });
    ++(above - 1)->count;
  }
  const double n = static_cast<double>(axes.size());
  for (ElevationBin &bin : histogram) {
    const double count = static_cast<double>(bin.count);
    const double p = (count + 1.0) / (n + 2.0);
    const double q = bin.isotropic_fraction;
    bin.fraction = count / n;
    bin.fraction_error = std::sqrt(p * (1.0 - p) / n);
    bin.isotropic_scatter = std::sqrt(q * (1.0 - q) / n);
  }
  return histogram;
}

double chi_squared_isotropic(const std::vector<ElevationBin> &histogram, std::size_t axes)
{
  double sum = 0.0;
  for (const ElevationBin &bin : histogram) {
    const double expected = bin.isotropic_fraction * static_cast<double>(axes);
    const double excess = static_cast<double>(bin.count) - expected;
    sum += excess * excess / expected;
  }
  return sum;
}

}  // namespace spherocylinder
