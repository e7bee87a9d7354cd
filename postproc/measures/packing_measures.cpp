// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/packing_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "solid/capsule_measures.h"
#include "solid/closed_mesh.h"

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

// Of rods wholly inside, `inside` is the volume; cut_volume(rod, tolerance) gives that of one that is cut.
template <class CutVolume>
BoundedVolume solid_of_rods(double inside, const std::vector<Capsule> &cut, double tolerance,
                            CutVolume cut_volume)
{
  // The few rods that are cut may each be off by more than the tolerance if the sum is not.
  constexpr double kLoosest = 0.05;
  double whole = 0.0;
  for (const Capsule &rod : cut) whole += volume(rod);
  const double for_cut =
      whole > 0.0 ? std::clamp(tolerance * inside / whole, tolerance, std::max(tolerance, kLoosest))
                  : tolerance;

  constexpr std::size_t kRodsAPiece = 16;
  std::vector<BoundedVolume> parts((cut.size() + kRodsAPiece - 1) / kRodsAPiece);
  for_each_piece(cut.size(), kRodsAPiece, [&](std::size_t begin, std::size_t end) {
    BoundedVolume sum{0.0, 0.0};
    for (std::size_t i = begin; i < end; i++) {
      const BoundedVolume part = cut_volume(cut[i], for_cut);
      sum.value += part.value;
      sum.error += part.error;
    }
    parts[begin / kRodsAPiece] = sum;
  });
  BoundedVolume solid{inside, 0.0};
  for (const BoundedVolume &part : parts) {
    solid.value += part.value;
    solid.error += part.error;
  }
  return solid;
}

template <class Region>
BoundedVolume solid_in_region(const std::vector<Rod> &rods, const Region &region, double tolerance)
{
  double inside = 0.0;
  std::vector<Capsule> cut;
  for (const Rod &rod : rods) {
    if (misses(region, rod.capsule)) continue;
    if (holds(region, rod.capsule))
      inside += volume(rod.capsule);
    else
      cut.push_back(rod.capsule);
  }
  return solid_of_rods(inside, cut, tolerance, [&](const Capsule &rod, double for_cut) {
    return clipped_volume(rod, region, for_cut);
  });
}

}  // namespace

BoundedVolume solid_within(const std::vector<Rod> &rods, const UprightCylinder &region,
                           double tolerance)
{
  return solid_in_region(rods, region, tolerance);
}

BoundedVolume solid_within(const std::vector<Rod> &rods, const UprightBox &region, double tolerance)
{
  return solid_in_region(rods, region, tolerance);
}

BoundedVolume solid_within(const std::vector<Rod> &rods, const ClosedMesh &region, double tolerance)
{
  double inside = 0.0;
  std::vector<Capsule> cut;
  for (const Rod &rod : rods) {
    const ClosedMesh::Place place = region.place_of(rod.capsule);
    if (place == ClosedMesh::Place::Inside) inside += volume(rod.capsule);
    if (place == ClosedMesh::Place::Cut) cut.push_back(rod.capsule);
  }
  return solid_of_rods(inside, cut, tolerance, [&](const Capsule &rod, double for_cut) {
    return volume_inside(region.triangles(), rod, for_cut);
  });
}

SolidFraction solid_fraction(const std::vector<Rod> &rods, const UprightCylinder &region,
                             double tolerance)
{
  const BoundedVolume solid = solid_within(rods, region, tolerance);
  return {region, solid.value / volume(region), solid.error / volume(region)};
}

}  // namespace spherocylinder
