// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/orientation_statistics.h"

#include <algorithm>
#include <cmath>

#include <vtkMath.h>

#include "core/numbers.h"
#include "core/parallel.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {
namespace {

double edge_of(std::size_t i, std::size_t bins, BinSpacing spacing)
{
  const double part = static_cast<double>(i) / static_cast<double>(bins);
  return spacing == BinSpacing::EqualAngle ? part * 0.5 * pi : std::asin(part);
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
  return axes.size() < 2 ? 0.0 : sin_gamma_of_pairs(axes, most_axes).mean;
}

MeanWithError sin_gamma_of_pairs(const std::vector<Vec3> &axes, std::size_t most_axes)
{
  const std::size_t n = std::min(axes.size(), most_axes);
  if (n < 2) return {none, none};
  std::vector<Vec3> picked(n);
  for (std::size_t i = 0; i < n; i++) picked[i] = axes[i * axes.size() / n];
  std::vector<double> mean_of_axis(n, 0.0), squares(n, 0.0);
  for_each_piece(n, 32, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; i++)
      for (const Vec3 &u : picked) {
        const double sine_squared = norm_squared(cross(picked[i], u));
        mean_of_axis[i] += std::sqrt(sine_squared) / static_cast<double>(n - 1);
        squares[i] += sine_squared;
      }
  });
  const MeanWithError mean = mean_of(mean_of_axis);
  const double pairs = static_cast<double>(n) * static_cast<double>(n - 1);
  double mean_square = 0.0;
  for (const double sum : squares) mean_square += sum / pairs;
  const double of_pairs = std::max(0.0, mean_square - mean.mean * mean.mean);
  // mean.error^2 is the variance of the h_i over n, to which the few partners of each add a part of
  // that of the pairs.
  const double of_axes =
      std::max(0.0, static_cast<double>(n - 1) * static_cast<double>(n) * mean.error * mean.error -
                        of_pairs);
  return {mean.mean, std::sqrt((4.0 * of_axes + 2.0 * of_pairs) / pairs)};
}

NematicTensor nematic_tensor(const std::vector<Vec3> &axes)
{
  NematicTensor q{-0.5, -0.5, -0.5, 0.0, 0.0, 0.0};
  const double part = 1.5 / static_cast<double>(axes.size());
  for (const Vec3 &u : axes) {
    q.xx += part * u.x * u.x;
    q.yy += part * u.y * u.y;
    q.zz += part * u.z * u.z;
    q.xy += part * u.x * u.y;
    q.xz += part * u.x * u.z;
    q.yz += part * u.y * u.z;
  }
  return q;
}

NematicOrder nematic_order(const std::vector<Vec3> &axes)
{
  const NematicTensor t = nematic_tensor(axes);
  double q[3][3] = {{t.xx, t.xy, t.xz}, {t.xy, t.yy, t.yz}, {t.xz, t.yz, t.zz}};
  double *rows[3] = {q[0], q[1], q[2]};
  double vectors[3][3];
  double *vector_rows[3] = {vectors[0], vectors[1], vectors[2]};
  double values[3];  // falling
  vtkMath::Jacobi(rows, values, vector_rows);
  const int pick = std::abs(values[0]) >= std::abs(values[2]) ? 0 : 2;
  const Vec3 found{vectors[0][pick], vectors[1][pick], vectors[2][pick]};
  const Vec3 director = found.z < 0.0 ? -found : found;
  const MeanWithError along =
      mean_of(axes, [&](const Vec3 &u) { return 1.5 * dot(u, director) * dot(u, director) - 0.5; });
  return {values[pick], director, along.error};
}

double unbiased_squared_order(const std::vector<Vec3> &axes)
{
  const double n = static_cast<double>(axes.size());
  if (axes.size() < 2) return none;
  const NematicTensor q = nematic_tensor(axes);
  const double squares =
      q.xx * q.xx + q.yy * q.yy + q.zz * q.zz + 2.0 * (q.xy * q.xy + q.xz * q.xz + q.yz * q.yz);
  return (2.0 / 3.0 * n * squares - 1.0) / (n - 1.0);
}

double isotropic_scatter_of_squared_order(std::size_t axes)
{
  const double n = static_cast<double>(axes);
  return axes < 2 ? none : std::sqrt(0.4 / (n * (n - 1.0)));
}

AzimuthalOrder azimuthal_order(const std::vector<Vec3> &axes)
{
  std::vector<double> headings;  // rad
  for (const Vec3 &u : axes)
    if (u.x != 0.0 || u.y != 0.0) headings.push_back(std::atan2(u.y, u.x));
  const double n = static_cast<double>(headings.size());
  if (headings.empty()) return {none, none, none, none};
  const double x = mean_of(headings, [](double phi) { return std::cos(2.0 * phi); }).mean;
  const double y = mean_of(headings, [](double phi) { return std::sin(2.0 * phi); }).mean;
  const double order = std::hypot(x, y);
  const double twice = std::atan2(y, x);
  const double azimuth = 0.5 * (twice < 0.0 ? twice + 2.0 * pi : twice);
  const MeanWithError along =
      mean_of(headings, [&](double phi) { return std::cos(2.0 * (phi - azimuth)); });
  return {order, azimuth, along.error,
          headings.size() < 2 ? none : (n * order * order - 1.0) / (n - 1.0)};
}

MeanWithError radial_order(const std::vector<Rod> &rods, double axis_x, double axis_y)
{
  std::vector<double> cosines;
  for (const Rod &rod : rods) {
    const Vec3 &u = rod.capsule.segment.axis, &c = rod.capsule.segment.centre;
    const double x = c.x - axis_x, y = c.y - axis_y;
    if (rod.is_sphere() || (u.x == 0.0 && u.y == 0.0) || (x == 0.0 && y == 0.0)) continue;
    cosines.push_back(std::cos(2.0 * (std::atan2(u.y, u.x) - std::atan2(y, x))));
  }
  return mean_of(cosines);
}

std::vector<ElevationBin> elevation_histogram(const std::vector<Vec3> &axes, std::size_t bins,
                                              BinSpacing spacing)
{
  std::vector<ElevationBin> histogram(bins);
  for (std::size_t i = 0; i < bins; i++) {
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
    const double q = bin.isotropic_fraction;
    bin.part = part_of(bin.count, axes.size());
    bin.isotropic_scatter = axes.empty() ? none : std::sqrt(q * (1.0 - q) / n);
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
