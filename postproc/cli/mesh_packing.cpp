// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/mesh_packing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/numbers.h"
#include "io/input_error.h"
#include "io/mesh_file.h"

namespace spherocylinder {
namespace {

void need_rods_inside(const Bed &bed, const MeshVessel &vessel)
{
  const auto outside = std::count_if(bed.rods.begin(), bed.rods.end(), [&](const Rod &rod) {
    return vessel.mesh.distance(rod.capsule.segment.centre) > 0.0;
  });
  if (outside > 0)
    throw InputError(
        fmt::format("{}: step {}: {} of {} rod centres are outside the vessel {}, wanted "
                    "none",
                    bed.frame.path, bed.frame.step, outside, bed.rods.size(), vessel.path));
}

bool is_as_thick(const UprightBox &bounds, double thinnest)
{
  return std::min({bounds.x_high - bounds.x_low, bounds.y_high - bounds.y_low,
                   bounds.z_high - bounds.z_low}) >= thinnest;
}

}  // namespace

MeshVessel read_vessel(const std::string &path)
{
  const auto mesh = read_mesh(path);
  if (const auto fault = fault_of_surface(mesh))
    throw InputError(fmt::format("{}: the vessel {}", path, *fault));
  return {path, ClosedMesh(mesh)};
}

RegionPacking pack_part(const BedSolid &solid, const MeshVessel &vessel, const UprightBox &window,
                        double tolerance)
{
  const auto part = vessel.mesh.part_within(window);
  if (!part)
    throw InputError(fmt::format(
        "--region: nothing of the vessel {} is in {} {} {} {} {} {}, wanted a part of it",
        vessel.path, window.x_low, window.x_high, window.y_low, window.y_high, window.z_low,
        window.z_high));
  return pack_mesh(solid, *part, tolerance);
}

void measure_in_mesh(const BedSolid &solid, const PackingOptions &options, double thinnest,
                     BedPacking &p)
{
  const Bed &bed = solid.bed;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const MeshVessel &vessel = *options.mesh;
  if (options.inner.radius || options.inner.bottom || options.inner.top)
    throw InputError(
        "--inner-radius, --inner-bottom, --inner-top: wanted without --vessel, of which --region "
        "takes a part");
  need_rods_inside(bed, vessel);
  const UprightBox bounds = vessel.mesh.bounds();
  const double top = p.height.highest_centre;
  need_height(bed, {0.0, 0.0, 0.0, bounds.z_low, top});
  const auto whole = vessel.mesh.part_within({-kFar, kFar, -kFar, kFar, -kFar, top});
  if (!whole)
    throw InputError(
        fmt::format("{}: step {}: the highest rod centre is at {}, wanted above the floor, {}",
                    bed.frame.path, bed.frame.step, top, bounds.z_low));
  p.clipped = pack_mesh(solid, *whole, options.tolerance);
  p.whole = p.clipped;
  p.whole.fraction = p.rods_volume / p.whole.volume;
  p.whole.net_fraction = (p.rods_volume - p.overlap_volume) / p.whole.volume;
  p.whole.error = 0.0;

  p.vessel_is_convex = whole->is_convex();
  if (!p.vessel_is_convex) return;
  p.inner = pack_mesh(solid, whole->scaled(std::cbrt(0.5)), options.tolerance);
  const auto bulk = whole->inset(p.bulk_margin);
  if (bulk && is_as_thick(bulk->bounds(), thinnest))
    p.bulk = pack_mesh(solid, *bulk, options.tolerance);
}

}  // namespace spherocylinder
