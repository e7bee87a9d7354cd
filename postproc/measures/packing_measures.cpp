// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/packing_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {

BedHeight bed_height(const std::vector<Rod> &rods)
{
  constexpr double kLowest = -std::numeric_limits<double>::infinity();
  BedHeight height{kLowest, kLowest};
  for (const Rod &rod : rods) {
    const Segment &segment = rod.capsule.segment;
    const double tip = segment.half_length * std::abs(segment.axis.z) + rod.capsule.radius;
    height.highest_centre = std::max(height.highest_centre, segment.centre.z);
    height.highest_point = std::max(height.highest_point, segment.centre.z + tip);
  }
  return height;
}

std::size_t count_outside(const std::vector<Rod> &rods, const Vessel &vessel)
{
  return std::count_if(rods.begin(), rods.end(), [&](const Rod &rod) {
    const Vec3 &c = rod.capsule.segment.centre;
    return std::hypot(c.x - vessel.x, c.y - vessel.y) > vessel.radius || c.z < vessel.floor;
  });
}

double total_volume(const std::vector<Rod> &rods)
{
  double sum = 0.0;
  for (const Rod &rod : rods) sum += volume(rod.capsule);
  return sum;
}

UprightCylinder vessel_up_to(const Vessel &vessel, double top)
{
  return {vessel.x, vessel.y, vessel.radius, vessel.floor, top};
}

UprightCylinder inner_half(const UprightCylinder &whole)
{
  const double scale = std::cbrt(0.5);
  const double middle = 0.5 * (whole.z_low + whole.z_high);
  const double half_height = 0.5 * scale * (whole.z_high - whole.z_low);
  return {whole.x, whole.y, scale * whole.radius, middle - half_height, middle + half_height};
}

namespace {

template <class Region>
BoundedVolume solid_of_rods(const std::vector<Rod> &rods, const Region &region, double tolerance)
{
  // The few rods that are cut may each be off by more than the tolerance if the sum is not.
  constexpr double kLoosest = 0.05;
  double inside = 0.0, cut = 0.0;
  for (const Rod &rod : rods) {
    if (misses(region, rod.capsule)) continue;
    (holds(region, rod.capsule) ? inside : cut) += volume(rod.capsule);
  }
  const double for_cut =
      cut > 0.0 ? std::clamp(tolerance * inside / cut, tolerance, std::max(tolerance, kLoosest))
                : tolerance;

  constexpr std::size_t kRodsAPiece = 1024;
  std::vector<BoundedVolume> parts((rods.size() + kRodsAPiece - 1) / kRodsAPiece);
  for_each_piece(rods.size(), kRodsAPiece, [&](std::size_t begin, std::size_t end) {
    BoundedVolume sum{0.0, 0.0};
    for (std::size_t i = begin; i < end; i++) {
      const BoundedVolume part = clipped_volume(rods[i].capsule, region, for_cut);
      sum.value += part.value;
      sum.error += part.error;
    }
    parts[begin / kRodsAPiece] = sum;
  });
  BoundedVolume solid{0.0, 0.0};
  for (const BoundedVolume &part : parts) {
    solid.value += part.value;
    solid.error += part.error;
  }
  return solid;
}

}  // namespace

BoundedVolume solid_within(const std::vector<Rod> &rods, const UprightCylinder &region,
                           double tolerance)
{
  return solid_of_rods(rods, region, tolerance);
}

BoundedVolume solid_within(const std::vector<Rod> &rods, const UprightBox &region, double tolerance)
{
  return solid_of_rods(rods, region, tolerance);
}

SolidFraction solid_fraction(const std::vector<Rod> &rods, const UprightCylinder &region,
                             double tolerance)
{
  const BoundedVolume solid = solid_within(rods, region, tolerance);
  return {region, solid.value / volume(region), solid.error / volume(region)};
}

}  // namespace spherocylinder
