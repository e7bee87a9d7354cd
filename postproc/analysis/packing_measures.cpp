// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/packing_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spherocylinder {

BedHeight bed_height(const std::vector<Rod> &rods)
{
  constexpr double lowest = -std::numeric_limits<double>::infinity();
  BedHeight height{lowest, lowest};
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

SolidFraction solid_fraction(const std::vector<Rod> &rods, const UprightCylinder &region,
                             double tolerance)
{
  BoundedVolume solid{0.0, 0.0};
  for (const Rod &rod : rods) {
    const BoundedVolume part = clipped_volume(rod.capsule, region, tolerance);
    solid.value += part.value;
    solid.error += part.error;
  }
  return {region, solid.value / volume(region), solid.error / volume(region)};
}

}  // namespace spherocylinder
