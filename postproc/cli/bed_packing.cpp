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
void measure_in_box(const BedSolid &solid, const PackingOptions &options, double thinnest,
                    BedPacking &p)
{
  const Bed &bed = solid.bed;
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
  p.clipped = pack_box(solid, whole, options.tolerance);

  const double cut = 0.5 * (1.0 - std::cbrt(0.5));  // off each side, leaves half the volume
  UprightBox inner = shrunk(cut * (whole.x_high - whole.x_low), cut * (whole.y_high - whole.y_low),
                            cut * (whole.z_high - whole.z_low));
  inner.z_low = options.inner.bottom.value_or(inner.z_low);
  inner.z_high = options.inner.top.value_or(inner.z_high);
  need_inner_heights(whole.z_low, inner.z_low, inner.z_high);
  p.inner = pack_box(solid, inner, options.tolerance);

  const UprightBox bulk = shrunk(p.bulk_margin, p.bulk_margin, p.bulk_margin);
  if (std::min({bulk.x_high - bulk.x_low, bulk.y_high - bulk.y_low, bulk.z_high - bulk.z_low}) >=
      thinnest)
    p.bulk = pack_box(solid, bulk, options.tolerance);
}

std::vector<Rod> balls_of(const std::vector<SharedEnd> &shared)
{
  std::vector<Rod> balls;
  for (const SharedEnd &end : shared) balls.push_back(end.ball);
  return balls;
}

void take_off(const std::vector<ProfileBin> &part, std::vector<ProfileBin> &bins)
{
  for (std::size_t k = 0; k < bins.size(); k++) {
    bins[k].solid -= part[k].solid;
    bins[k].error += part[k].error;
  }
}

// What is shared beside the balls counts in the bin of their centres; it is an error in all bins that
// share it. The last bin holds all beyond it, as of the distance from walls.
template <class Coordinate>  // of a place: as the edges have it
void take_off_beyond(const std::vector<SharedEnd> &shared, const std::vector<double> &edges,
                     Coordinate coordinate, std::vector<ProfileBin> &bins)
{
  const auto bin_of = [&](double at) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), at) - edges.begin();
    return std::clamp<std::ptrdiff_t>(above - 1, -1, static_cast<std::ptrdiff_t>(bins.size()));
  };
  const auto last = static_cast<std::ptrdiff_t>(bins.size()) - 1;
  for (const SharedEnd &end : shared) {
    const double at = coordinate(end.ball.capsule.segment.centre);
    const std::ptrdiff_t first = bin_of(at - end.reach), to = bin_of(at + end.reach);
    const std::ptrdiff_t own = bin_of(at);
    if (own >= 0 && own <= last) {
      bins[own].solid -= end.beyond.value;
      bins[own].error += end.beyond.error;
    }
    if (first == to) continue;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(first, 0); k <= std::min(to, last); k++)
      bins[k].error += std::abs(end.beyond.value);
  }
}

auto height_above(double floor)
{
  return [floor](const Vec3 &place) { return place.z - floor; };
}

// Layers, the ends that segments share counted once.
std::vector<ProfileBin> height_bins(const std::vector<Rod> &rods,
                                    const std::vector<SharedEnd> &shared, double section,
                                    double floor, const std::vector<double> &edges)
{
  std::vector<ProfileBin> bins = height_profile(rods, section, floor, edges);
  if (shared.empty()) return bins;
  take_off(height_profile(balls_of(shared), section, floor, edges), bins);
  take_off_beyond(shared, edges, height_above(floor), bins);
  return bins;
}

std::vector<SharedEnd> ends_between(const std::vector<SharedEnd> &shared, double low, double high)
{
  std::vector<SharedEnd> found;
  for (const SharedEnd &end : shared) {
    const double z = end.ball.capsule.segment.centre.z;
    if (z >= low && z <= high) found.push_back(end);
  }
  return found;
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

  RegionPacking pack(const UprightCylinder &region, const BedSolid &solid) const
  {
    if (!(region.z_high > region.z_low && region.radius > 0.0))
      return {none, none, none, none, none, none, none};
    const double space = volume(region);
    if (has_wall()) {
      const BoundedVolume found = solid_within(solid, region, tolerance_);
      return {region.radius,       region.z_low,        region.z_high, space,
              found.value / space, found.error / space, none};
    }
    const auto layer =
        height_bins(bed_.rods, solid.shared, 1.0, 0.0, {region.z_low, region.z_high})[0];
    return {none, region.z_low, region.z_high, space, layer.solid / space, layer.error / space,
            none};
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
std::vector<Rod> with_images(std::vector<Rod> rods, const DumpFrame &frame)
{
  const std::size_t count = rods.size();
  const auto [low, high] = frame.box[2];
  const double side = high - low;
  for (std::size_t i = 0; i < count; i++) {
    Rod rod = rods[i];
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

std::vector<SharedEnd> with_images(std::vector<SharedEnd> ends, const DumpFrame &frame)
{
  const std::size_t count = ends.size();
  for (std::size_t k = 0; k < count; k++) {
    Rod whole = ends[k].ball;
    whole.capsule.radius = ends[k].reach;
    const std::vector<Rod> images = with_images({whole}, frame);
    for (std::size_t i = 1; i < images.size(); i++) {
      ends.push_back(ends[k]);
      ends.back().ball.capsule.segment.centre = images[i].capsule.segment.centre;
    }
  }
  return ends;
}

}  // namespace

BedPacking measure_packing(const Bed &bed, const PackingOptions &options)
{
  const std::vector<Rod> &rods = bed.rods;
  BedPacking p{};
  p.step = bed.frame.step;
  p.height = height_of(bed);
  const std::vector<Vec3> axes = axes_of(bodies_with_axis(bed));
  p.rods = rods.size();
  p.spheres = rods.size() - axes_of(rods).size();
  p.has_axes = !axes.empty();
  p.lambda = aspect_ratios(bed.bodies());
  if (bed.fibres.are_there()) p.fibres = fibre_shapes(rods, bed.fibres);
  p.mean_elevation_deg = axes.empty() ? none : mean_elevation(axes).mean * degrees;
  p.mean_sin_gamma = axes.size() < 2 ? none : mean_sin_gamma(axes);

  const BedSolid solid(bed, overlaps_of(bed));
  p.rods_volume = solid.volume();
  p.overlaps = solid.overlaps.size();
  for (const Overlap &overlap : solid.overlaps) {
    p.overlap_volume += overlap.volume.value;
    p.overlap_error += overlap.volume.error;
  }
  p.bulk_margin = options.bulk_margin.value_or(mean_half_length(bed.bodies()));
  const RegionPacking nowhere{none, none, none, none, none, none, none};
  p.whole = p.clipped = p.inner = p.bulk = p.region = nowhere;
  if (options.region) {
    if (bed.frame.box_is_tilted) periodicity_of(bed.frame);  // refused if it is periodic too
    p.region = options.mesh ? pack_part(solid, *options.mesh, *options.region, options.tolerance)
                            : pack_box(solid, *options.region, options.tolerance);
    if (!options.holds_bed(bed.frame)) return p;
  }
  if (options.box) {
    measure_in_box(solid, options, mean_diameter(rods), p);
    return p;
  }
  if (options.mesh) {
    measure_in_mesh(solid, options, mean_diameter(rods), p);
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
  p.clipped = container.pack(whole, solid);
  p.inner = container.pack(inner_region(container, options.inner), solid);
  p.bulk = container.pack(bulk_region(container, p.bulk_margin, mean_diameter(rods)), solid);
  for (RegionPacking *region : {&p.clipped, &p.inner, &p.bulk})
    container.take_off(solid.overlaps, *region);
  return p;
}

Fields<BedPacking> packing_fields(bool with_fibres)
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
  if (!with_fibres) return fields;
  fields.add("fibres", OverFiles::Sum, [](const P &p) { return p.fibres ? p.fibres->fibres : 0; });
  fields.add("segments", OverFiles::Sum,
             [](const P &p) { return p.fibres ? p.fibres->segments : 0; });
  fields.add("rings", OverFiles::Sum, [](const P &p) { return p.fibres ? p.fibres->rings : 0; });
  fields.add("parts_of_fibres", OverFiles::Sum,
             [](const P &p) { return p.fibres ? p.fibres->parts : 0; });
  return fields;
}

PackingProfiles measure_profiles(const Bed &bed, const PackingOptions &options, double width)
{
  const BedHeight height = height_of(bed);
  const std::vector<SharedEnd> shared = shared_ends(bed.rods, bed.fibres);
  const auto top_bin = [&](double floor) {
    return width * std::ceil((height.highest_point - floor) / width);
  };
  if (options.box) {
    const UprightBox &box = *options.box;
    const double section = (box.x_high - box.x_low) * (box.y_high - box.y_low);
    return {height_bins(bed.rods, shared, section, box.z_low,
                        bin_edges(0.0, top_bin(box.z_low), width)),
            {},
            {}};
  }
  if (options.mesh) {
    const ClosedMesh &mesh = options.mesh->mesh;
    const double floor = mesh.bounds().z_low, top = mesh.bounds().z_high;
    const double last = width * std::ceil((std::min(height.highest_point, top) - floor) / width);
    const std::vector<double> edges = bin_edges(0.0, last, width);
    PackingProfiles of_mesh{height_profile(bed.rods, mesh, edges), {}, {}};
    if (!shared.empty()) {
      take_off(height_profile(balls_of(shared), mesh, edges), of_mesh.height);
      take_off_beyond(shared, edges, height_above(floor), of_mesh.height);
    }
    return of_mesh;
  }
  const Container container(bed, options, height);
  const UprightCylinder &whole = container.whole();
  const double section = volume(whole) / (whole.z_high - whole.z_low);
  PackingProfiles profiles;
  if (container.is_closed()) {
    const std::vector<double> edges = bin_edges(0.0, whole.z_high - whole.z_low, width);
    profiles.height = height_profile(with_images(bed.rods, bed.frame), section, whole.z_low, edges);
    if (!shared.empty()) {
      const std::vector<SharedEnd> images = with_images(shared, bed.frame);
      take_off(height_profile(balls_of(images), section, whole.z_low, edges), profiles.height);
      take_off_beyond(images, edges, height_above(whole.z_low), profiles.height);
    }
    return profiles;
  }
  profiles.height = height_bins(bed.rods, shared, section, whole.z_low,
                                bin_edges(0.0, top_bin(whole.z_low), width));
  if (!container.has_wall()) return profiles;
  const std::vector<double> radii = bin_edges(0.0, whole.radius, width);
  const double furthest = std::min(whole.radius, whole.z_high - whole.z_low);
  const std::vector<double> distances = bin_edges(0.0, furthest, width);
  profiles.radius = radius_profile(bed.rods, whole, radii, options.tolerance);
  profiles.wall = wall_profile(bed.rods, whole, distances, options.tolerance);
  if (shared.empty()) return profiles;
  const std::vector<Rod> balls = balls_of(shared);
  take_off(radius_profile(balls, whole, radii, options.tolerance), profiles.radius);
  take_off(wall_profile(balls, whole, distances, options.tolerance), profiles.wall);
  const std::vector<SharedEnd> within = ends_between(shared, whole.z_low, whole.z_high);
  const auto from_axis = [&](const Vec3 &p) { return std::hypot(p.x - whole.x, p.y - whole.y); };
  take_off_beyond(within, radii, from_axis, profiles.radius);
  take_off_beyond(
      within, distances,
      [&](const Vec3 &p) { return std::min(whole.radius - from_axis(p), p.z - whole.z_low); },
      profiles.wall);
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
