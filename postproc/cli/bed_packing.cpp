// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/bed_packing.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "cli/mesh_packing.h"
#include "core/numbers.h"
#include "io/input_error.h"
#include "measures/close_pairs.h"
#include "measures/orientation_statistics.h"
#include "measures/packing_theory.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {
namespace {

AspectRatios aspect_ratios(const std::vector<Rod> &rods)
{
  AspectRatios ratios{0.0, rods[0].capsule.aspect_ratio(), rods[0].capsule.aspect_ratio()};
  for (const Rod &rod : rods) {
    const double ratio = rod.capsule.aspect_ratio();
    ratios.mean += ratio / static_cast<double>(rods.size());
    ratios.smallest = std::min(ratios.smallest, ratio);
    ratios.largest = std::max(ratios.largest, ratio);
  }
  return ratios;
}

void need_inner_heights(double floor, double bottom, double top)
{
  if (bottom < floor)
    throw InputError(
        fmt::format("--inner-bottom: must be at least the floor {} (got {})", floor, bottom));
  if (!(bottom < top))
    throw InputError(fmt::format("--inner-bottom, --inner-top: the top must be above the bottom "
                                 "(got bottom {:.6g}, top {:.6g})",
                                 bottom, top));
}

// What holds the bed, as box with walls if it is one.
void measure_in_box(const Bed &bed, const PackingOptions &options,
                    const std::vector<Overlap> &overlaps, double thinnest, BedPacking &p)
{
  if (options.inner.radius) throw InputError("--inner-radius: wanted with --vessel-radius only");
  need_rods_inside(bed, *options.box);
  UprightBox whole = *options.box;
  whole.z_high = p.height.highest_centre;
  need_height(bed, {0.0, 0.0, 0.0, whole.z_low, whole.z_high});
  const auto shrunk = [&](double dx, double dy, double dz) {
    return UprightBox(whole.x_low + dx, whole.x_high - dx, whole.y_low + dy, whole.y_high - dy,
                      whole.z_low + dz, whole.z_high - dz);
  };
  const double space = volume(whole);
  p.whole = {none,
             whole.z_low,
             whole.z_high,
             space,
             p.rods_volume / space,
             0.0,
             (p.rods_volume - p.overlap_volume) / space};
  p.clipped = pack_box(bed, whole, overlaps, options.tolerance);

  const double cut = 0.5 * (1.0 - std::cbrt(0.5));  // off each side, leaves half the volume
  UprightBox inner = shrunk(cut * (whole.x_high - whole.x_low), cut * (whole.y_high - whole.y_low),
                            cut * (whole.z_high - whole.z_low));
  inner.z_low = options.inner.bottom.value_or(inner.z_low);
  inner.z_high = options.inner.top.value_or(inner.z_high);
  need_inner_heights(whole.z_low, inner.z_low, inner.z_high);
  p.inner = pack_box(bed, inner, overlaps, options.tolerance);

  const UprightBox bulk = shrunk(p.bulk_margin, p.bulk_margin, p.bulk_margin);
  if (std::min({bulk.x_high - bulk.x_low, bulk.y_high - bulk.y_low, bulk.z_high - bulk.z_low}) >=
      thinnest)
    p.bulk = pack_box(bed, bulk, overlaps, options.tolerance);
}

// A vessel with a wall, or a box periodic in x and y, from the floor up to the highest centre.
class Container {
 public:
  Container(const Bed &bed, const PackingOptions &options, const BedHeight &height)
      : bed_(bed), tolerance_(options.tolerance)
  {
    if (options.vessel) {
      need_rods_inside(bed, *options.vessel);
      whole_ = vessel_up_to(*options.vessel, height.highest_centre);
    } else {
      need_periodic_sides();
      const bool upright = bed.frame.periodic[2];
      const auto &box = bed.frame.box;
      sides_area_ = (box[0][1] - box[0][0]) * (box[1][1] - box[1][0]);
      whole_.radius = std::sqrt(sides_area_ / pi);  // as a vessel of that cross-section
      whole_.z_low = upright ? box[2][0] : options.floor;
      whole_.z_high = upright ? box[2][1] : height.highest_centre;
    }
    need_height(bed, whole_);
  }

  bool has_wall() const { return sides_area_ == 0.0; }
  bool is_closed() const { return !has_wall() && bed_.frame.periodic[2]; }  // periodic in z too
  const UprightCylinder &whole() const { return whole_; }

  RegionPacking pack(const UprightCylinder &region) const
  {
    if (!(region.z_high > region.z_low && region.radius > 0.0))
      return {none, none, none, none, none, none, none};
    const double space = volume(region);
    if (has_wall()) {
      const SolidFraction found = solid_fraction(bed_.rods, region, tolerance_);
      return {region.radius, region.z_low, region.z_high, space, found.fraction, found.error, none};
    }
    const auto below = volumes_below(bed_.rods, {region.z_low, region.z_high});
    return {none, region.z_low, region.z_high, space, (below[1] - below[0]) / space, 0.0, none};
  }

  // The overlaps in the region taken off once.
  void take_off(const std::vector<Overlap> &overlaps, RegionPacking &region) const
  {
    double volume = 0.0;
    for (const Overlap &overlap : overlaps) {
      const Vec3 &at = overlap.place;
      const bool inside =
          at.z >= region.bottom && at.z <= region.top &&
          (!has_wall() || std::hypot(at.x - whole_.x, at.y - whole_.y) <= region.radius);
      if (inside) volume += overlap.volume.value;
    }
    region.net_fraction = region.fraction - volume / region.volume;
  }

 private:
  void need_periodic_sides() const
  {
    const DumpFrame &frame = bed_.frame;
    if (!frame.periodic[0] || !frame.periodic[1])
      throw InputError(fmt::format(
          "{}: step {}: the box is not periodic in x and y, wanted --vessel-radius, --vessel, "
          "--box or --region",
          frame.path, frame.step));
    periodicity_of(frame);  // refuses a tilted or flat box
  }

  const Bed &bed_;
  double tolerance_;
  UprightCylinder whole_{};
  double sides_area_ = 0.0;  // m^2, 0 for a vessel with a wall
};

UprightCylinder inner_region(const Container &container, const InnerOverride &chosen)
{
  const UprightCylinder &whole = container.whole();
  UprightCylinder inner = inner_half(whole);
  if (!container.has_wall()) {
    if (chosen.radius) throw InputError("--inner-radius: wanted with --vessel-radius only");
    const double quarter = 0.25 * (whole.z_high - whole.z_low);
    inner = {whole.x, whole.y, whole.radius, whole.z_low + quarter, whole.z_high - quarter};
  }
  inner.radius = chosen.radius.value_or(inner.radius);
  inner.z_low = chosen.bottom.value_or(inner.z_low);
  inner.z_high = chosen.top.value_or(inner.z_high);
  if (inner.radius > whole.radius)
    throw InputError(fmt::format("--inner-radius: must be at most the vessel radius {} (got {})",
                                 whole.radius, inner.radius));
  need_inner_heights(whole.z_low, inner.z_low, inner.z_high);
  return inner;
}

// Of no height or radius if less than `thinnest` is left either way: a thinner slice is no bulk.
UprightCylinder bulk_region(const Container &container, double margin, double thinnest)
{
  UprightCylinder bulk = container.whole();
  if (container.has_wall()) bulk.radius -= margin;
  bulk.z_low += margin;
  bulk.z_high -= margin;
  if (bulk.z_high - bulk.z_low < thinnest || 2.0 * bulk.radius < thinnest) bulk.radius = 0.0;
  return bulk;
}

double mean_half_length(const std::vector<Rod> &rods)
{
  return mean_of(rods, [](const Rod &rod) { return 0.5 * rod.capsule.length(); }).mean;
}

double mean_diameter(const std::vector<Rod> &rods)
{
  return mean_of(rods, [](const Rod &rod) { return 2.0 * rod.capsule.radius; }).mean;
}

// Rods of a box periodic in z, and the images of those that reach over its top or bottom.
std::vector<Rod> with_images(const Bed &bed)
{
  std::vector<Rod> rods = bed.rods;
  const auto [low, high] = bed.frame.box[2];
  const double side = high - low;
  for (Rod rod : bed.rods) {
    Segment &segment = rod.capsule.segment;
    const double up = segment.half_length * std::abs(segment.axis.z) + rod.capsule.radius;
    const double z = segment.centre.z;
    const int first = static_cast<int>(std::ceil((low - up - z) / side));
    const int last = static_cast<int>(std::floor((high + up - z) / side));
    for (int image = first; image <= last; image++) {
      segment.centre.z = z + image * side;
      if (image != 0) rods.push_back(rod);
    }
  }
  return rods;
}

}  // namespace

BedPacking measure_packing(const Bed &bed, const PackingOptions &options)
{
  const std::vector<Rod> &rods = bed.rods;
  BedPacking p{};
  p.step = bed.frame.step;
  p.height = bed_height(rods);
  const std::vector<Vec3> axes = axes_of(rods);
  p.rods = rods.size();
  p.spheres = rods.size() - axes.size();
  p.lambda = aspect_ratios(rods);
  p.mean_elevation_deg = axes.empty() ? none : mean_elevation(axes).mean * degrees;
  p.mean_sin_gamma = axes.size() < 2 ? none : mean_sin_gamma(axes);

  p.rods_volume = total_volume(rods);
  const std::vector<Overlap> overlaps = overlaps_of(bed);
  p.overlaps = overlaps.size();
  for (const Overlap &overlap : overlaps) {
    p.overlap_volume += overlap.volume.value;
    p.overlap_error += overlap.volume.error;
  }
  p.bulk_margin = options.bulk_margin.value_or(mean_half_length(rods));
  const RegionPacking nowhere{none, none, none, none, none, none, none};
  p.whole = p.clipped = p.inner = p.bulk = p.region = nowhere;
  if (options.region) {
    if (bed.frame.box_is_tilted) periodicity_of(bed.frame);  // refused if it is periodic too
    p.region = options.mesh
                   ? pack_part(bed, *options.mesh, *options.region, overlaps, options.tolerance)
                   : pack_box(bed, *options.region, overlaps, options.tolerance);
    if (!options.holds_bed(bed.frame)) return p;
  }
  if (options.box) {
    measure_in_box(bed, options, overlaps, mean_diameter(rods), p);
    return p;
  }
  if (options.mesh) {
    measure_in_mesh(bed, options, overlaps, mean_diameter(rods), p);
    return p;
  }
  const Container container(bed, options, p.height);
  const UprightCylinder &whole = container.whole();
  const double space = volume(whole);
  p.whole = {container.has_wall() ? whole.radius : none,
             whole.z_low,
             whole.z_high,
             space,
             p.rods_volume / space,
             0.0,
             (p.rods_volume - p.overlap_volume) / space};
  if (container.is_closed()) return p;  // no wall, floor or surface to keep clear of
  p.clipped = container.pack(whole);
  p.inner = container.pack(inner_region(container, options.inner));
  p.bulk = container.pack(bulk_region(container, p.bulk_margin, mean_diameter(rods)));
  for (RegionPacking *region : {&p.clipped, &p.inner, &p.bulk})
    container.take_off(overlaps, *region);
  return p;
}

Fields<BedPacking> packing_fields()
{
  using P = BedPacking;
  Fields<P> fields;
  const auto add = [&](const std::string &name, auto value) {
    fields.add(name, OverFiles::Mean, value);
  };
  // With its standard error over several beds.
  const auto add_measured = [&](const std::string &name, auto value, const std::string &unit = "") {
    fields.add_mean(
        name,
        [value](const P &p) {
          return MeanWithError{value(p), none};
        },
        unit);
  };
  fields.add("step", OverFiles::Same, [](const P &p) { return p.step; });
  fields.add("rods", OverFiles::Sum, [](const P &p) { return p.rods; });
  fields.add("spheres", OverFiles::Sum, [](const P &p) { return p.spheres; });
  add("lambda_mean", [](const P &p) { return p.lambda.mean; });
  add("lambda_min", [](const P &p) { return p.lambda.smallest; });
  add("lambda_max", [](const P &p) { return p.lambda.largest; });
  add_measured(
      "mean_elevation", [](const P &p) { return p.mean_elevation_deg; }, "_deg");
  add_measured("mean_sin_gamma", [](const P &p) { return p.mean_sin_gamma; });
  add_measured(
      "z_top", [](const P &p) { return p.height.highest_centre; }, "_m");
  add("highest_point_m", [](const P &p) { return p.height.highest_point; });
  add("rods_volume_m3", [](const P &p) { return p.rods_volume; });
  add("whole_volume_m3", [](const P &p) { return p.whole.volume; });
  add_measured("vf_whole", [](const P &p) { return p.whole.fraction; });
  add_measured("vf_whole_net", [](const P &p) { return p.whole.net_fraction; });
  add_measured("vf_whole_clipped", [](const P &p) { return p.clipped.fraction; });
  add("vf_whole_clipped_integration_error", [](const P &p) { return p.clipped.error; });
  add("inner_radius_m", [](const P &p) { return p.inner.radius; });
  add("inner_bottom_m", [](const P &p) { return p.inner.bottom; });
  add("inner_top_m", [](const P &p) { return p.inner.top; });
  add("inner_volume_m3", [](const P &p) { return p.inner.volume; });
  add_measured("vf_inner", [](const P &p) { return p.inner.fraction; });
  add_measured("vf_inner_net", [](const P &p) { return p.inner.net_fraction; });
  add("vf_inner_integration_error", [](const P &p) { return p.inner.error; });
  add("bulk_margin_m", [](const P &p) { return p.bulk_margin; });
  add("bulk_volume_m3", [](const P &p) { return p.bulk.volume; });
  add_measured("vf_bulk", [](const P &p) { return p.bulk.fraction; });
  add_measured("vf_bulk_net", [](const P &p) { return p.bulk.net_fraction; });
  add("vf_bulk_integration_error", [](const P &p) { return p.bulk.error; });
  add("region_volume_m3", [](const P &p) { return p.region.volume; });
  add_measured("vf_region", [](const P &p) { return p.region.fraction; });
  add_measured("vf_region_net", [](const P &p) { return p.region.net_fraction; });
  add("vf_region_integration_error", [](const P &p) { return p.region.error; });
  add("overlap_pairs", [](const P &p) { return p.overlaps; });
  add("overlap_volume_m3", [](const P &p) { return p.overlap_volume; });
  add("overlap_volume_integration_error_m3", [](const P &p) { return p.overlap_error; });
  const auto random_contacts = [](double sin_gamma) {
    return [=](const P &p) {
      return p.has_rods() ? random_contact_fraction(p.lambda.mean, sin_gamma) : none;
    };
  };
  add("vf_parkhouse_kelly",
      [](const P &p) { return p.has_rods() ? parkhouse_kelly_fraction(p.lambda.mean) : none; });
  add("vf_random_contact_isotropic", random_contacts(kIsotropicSinGamma));
  add("vf_random_contact_horizontal", random_contacts(kHorizontalSinGamma));
  add("vf_random_contact_measured",
      [](const P &p) { return random_contact_fraction(p.lambda.mean, p.mean_sin_gamma); });
  return fields;
}

PackingProfiles measure_profiles(const Bed &bed, const PackingOptions &options, double width)
{
  const BedHeight height = bed_height(bed.rods);
  const auto top_bin = [&](double floor) {
    return width * std::ceil((height.highest_point - floor) / width);
  };
  if (options.box) {
    const UprightBox &box = *options.box;
    const double section = (box.x_high - box.x_low) * (box.y_high - box.y_low);
    return {height_profile(bed.rods, section, box.z_low, bin_edges(0.0, top_bin(box.z_low), width)),
            {},
            {}};
  }
  if (options.mesh) {
    const ClosedMesh &mesh = options.mesh->mesh;
    const double floor = mesh.bounds().z_low, top = mesh.bounds().z_high;
    const double last = width * std::ceil((std::min(height.highest_point, top) - floor) / width);
    return {height_profile(bed.rods, mesh, bin_edges(0.0, last, width)), {}, {}};
  }
  const Container container(bed, options, height);
  const UprightCylinder &whole = container.whole();
  const double section = volume(whole) / (whole.z_high - whole.z_low);
  PackingProfiles profiles;
  if (container.is_closed()) {
    profiles.height = height_profile(with_images(bed), section, whole.z_low,
                                     bin_edges(0.0, whole.z_high - whole.z_low, width));
    return profiles;
  }
  profiles.height =
      height_profile(bed.rods, section, whole.z_low, bin_edges(0.0, top_bin(whole.z_low), width));
  if (!container.has_wall()) return profiles;
  profiles.radius =
      radius_profile(bed.rods, whole, bin_edges(0.0, whole.radius, width), options.tolerance);
  const double furthest = std::min(whole.radius, whole.z_high - whole.z_low);
  profiles.wall = wall_profile(bed.rods, whole, bin_edges(0.0, furthest, width), options.tolerance);
  return profiles;
}

Fields<ProfileRow> profile_fields()
{
  using R = ProfileRow;
  Fields<R> fields;
  fields.add("step", OverFiles::Same, [](const R &r) { return r.step; });
  fields.add("low_m", OverFiles::Same, [](const R &r) { return r.bin.low; });
  fields.add("high_m", OverFiles::Same, [](const R &r) { return r.bin.high; });
  fields.add("region_m3", OverFiles::Mean, [](const R &r) { return r.bin.region; });
  fields.add("solid_m3", OverFiles::Mean, [](const R &r) { return r.bin.solid; });
  fields.add_mean("vf", [](const R &r) { return MeanWithError{r.bin.fraction(), none}; });
  fields.add("vf_integration_error", OverFiles::Mean,
             [](const R &r) { return r.bin.error / r.bin.region; });
  return fields;
}

std::vector<ProfileRow> profile_rows(const Bed &bed, const std::vector<ProfileBin> &bins)
{
  std::vector<ProfileRow> rows;
  for (const ProfileBin &bin : bins) rows.push_back({bed.frame.step, bin});
  return rows;
}

}  // namespace spherocylinder
