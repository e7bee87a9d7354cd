// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/bed_orientation.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "cli/region_packing.h"
#include "core/numbers.h"
#include "io/input_error.h"
#include "measures/close_pairs.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {
namespace {

constexpr double kMostWallBins = 10000;
constexpr std::size_t kMostAxesOfBin = 2000;  // of a bin of the distance, paired
constexpr double kPackingTolerance = 1e-4;    // relative, of the rods' volume in the inner cylinder

constexpr OverFiles kSame = OverFiles::Same, kSum = OverFiles::Sum, kMean = OverFiles::Mean,
                    kError = OverFiles::Error, kScatter = OverFiles::Scatter;

std::vector<Rod> without_spheres(const std::vector<Rod> &rods)
{
  std::vector<Rod> found;
  for (const Rod &rod : rods)
    if (!rod.is_sphere()) found.push_back(rod);
  return found;
}

double mean_lambda(const std::vector<Rod> &rods)
{
  return mean_of(rods, [](const Rod &rod) { return rod.capsule.aspect_ratio(); }).mean;
}

// The error of <|sin gamma|> carried over by the slope.
MeanWithError random_contact(double lambda, const MeanWithError &sin_gamma, double half_contacts)
{
  const auto at = [&](double s) { return random_contact_fraction(lambda, s, half_contacts); };
  constexpr double kStep = 1e-4;
  const double slope = (at(sin_gamma.mean + kStep) - at(sin_gamma.mean - kStep)) / (2.0 * kStep);
  return {at(sin_gamma.mean), std::abs(slope) * sin_gamma.error};
}

bool has_side(const std::optional<Vessel> &vessel)
{
  return vessel && std::isfinite(vessel->radius);
}

// `lambda`: of whole fibres, else that of the rods.
Order order_of(const std::vector<Rod> &rods, const OrientationOptions &options,
               std::size_t most_axes, const std::optional<double> &lambda)
{
  const std::optional<Vessel> &vessel = options.vessel;
  const std::vector<Vec3> axes = axes_of(rods);
  Order order{};
  order.rods = axes.size();
  order.elevation = mean_elevation(axes);
  order.abs_uz = mean_abs_uz(axes);
  order.uz_squared = mean_uz_squared(axes);
  order.nematic = axes.empty() ? NematicOrder{none, {none, none, none}, none} : nematic_order(axes);
  order.squared_order = unbiased_squared_order(axes);
  order.azimuthal = azimuthal_order(axes);
  order.radial =
      has_side(vessel) ? radial_order(rods, vessel->x, vessel->y) : MeanWithError{none, none};
  order.sin_gamma = sin_gamma_of_pairs(axes, most_axes);
  order.random_contact =
      random_contact(lambda ? *lambda : mean_lambda(rods), order.sin_gamma, options.half_contacts);
  return order;
}

double wall_distance(const Rod &rod, const Vessel &vessel, NearWall wall)
{
  const Vec3 &c = rod.capsule.segment.centre;
  const double to_side = vessel.radius - std::hypot(c.x - vessel.x, c.y - vessel.y);
  const double to_floor = c.z - vessel.floor;
  switch (wall) {
    case NearWall::Side: return to_side;
    case NearWall::Floor: return to_floor;
    case NearWall::Nearest: break;
  }
  return std::min(to_side, to_floor);
}

std::vector<WallBin> by_wall(const std::vector<Rod> &rods, double width,
                             const OrientationOptions &options, const std::optional<double> &lambda)
{
  std::vector<std::vector<Rod>> rods_of_bin;
  for (const Rod &rod : rods) {
    const double distance = wall_distance(rod, *options.vessel, options.wall);
    if (!(distance / width < kMostWallBins))
      throw InputError(
          fmt::format("--wall-width: {} m make more than {} bins up to a rod {} m from "
                      "the wall, wanted a larger width",
                      width, kMostWallBins, distance));
    const auto bin = static_cast<std::size_t>(distance / width);
    if (bin >= rods_of_bin.size()) rods_of_bin.resize(bin + 1);
    rods_of_bin[bin].push_back(rod);
  }
  std::vector<WallBin> bins;
  for (std::size_t k = 0; k < rods_of_bin.size(); k++)
    bins.push_back({width * static_cast<double>(k), width * static_cast<double>(k + 1),
                    order_of(rods_of_bin[k], options, kMostAxesOfBin, lambda),
                    elevation_histogram(axes_of(rods_of_bin[k]), options.bins, options.spacing)});
  return bins;
}

// Of all particles, spheres too. V_f is proportional to the contacts counted.
MeasuredFraction measured_fraction(const Bed &bed, const OrientationOptions &options, double lambda,
                                   double sin_gamma)
{
  const UprightCylinder whole = vessel_up_to(*options.vessel, height_of(bed).highest_centre);
  need_height(bed, whole);
  const UprightCylinder half = inner_half(whole);
  const BedSolid solid(bed);
  const double inner = solid_within(solid, half, kPackingTolerance).value / volume(half);
  return {solid.volume() / volume(whole), inner,
          inner / random_contact_fraction(lambda, sin_gamma, 1.0)};
}

// Of segments those that never touch are left out; of fibres each pair counts once.
void measure_near_pairs(const Bed &bed, const std::vector<Rod> &rods,
                        const OrientationOptions &options, BedOrientation &found)
{
  const double gap = options.near * largest_diameter(rods);
  if (!bed.fibres.are_there()) {
    const auto pairs = close_pairs(rods, periodicity_of(bed.frame), gap);
    found.near_pairs = pairs.size();
    found.near_sin_gamma = mean_of(pairs, [](const ClosePair &pair) { return pair.sin_gamma; });
    return;
  }
  const std::vector<Rod> &segments = bed.rods;
  const std::vector<std::uint32_t> body = bodies_of_rods(bed.fibres);
  std::set<std::pair<std::uint32_t, std::uint32_t>> bodies;
  std::vector<double> sines;
  for (const ClosePair &pair : close_pairs(segments, periodicity_of(bed.frame), gap)) {
    if (segments[pair.i].is_sphere() || segments[pair.j].is_sphere()) continue;
    if (options.by == AxisOf::Segment) {
      if (!bed.fibres.never_touch(pair.i, pair.j, segments)) sines.push_back(pair.sin_gamma);
      continue;
    }
    const Rod &a = bed.stretched[body[pair.i]], &b = bed.stretched[body[pair.j]];
    if (body[pair.i] == body[pair.j] || !has_axis(bed, body[pair.i]) ||
        !has_axis(bed, body[pair.j]))
      continue;
    if (bodies.insert(std::minmax(body[pair.i], body[pair.j])).second)
      sines.push_back(norm(cross(a.capsule.segment.axis, b.capsule.segment.axis)));
  }
  found.near_pairs = sines.size();
  found.near_sin_gamma = mean_of(sines);
}

std::vector<ElevationRow> rows_of(std::int64_t step, const std::vector<ElevationBin> &histogram,
                                  double low, double high)
{
  std::vector<ElevationRow> rows;
  for (const ElevationBin &bin : histogram) rows.push_back({step, rows.size() + 1, bin, low, high});
  return rows;
}

// An unbiased square, whose error only several beds tell.
template <class Item, class Value>
void add_square(Fields<Item> &fields, const std::string &name, Value value)
{
  fields.add_mean(name, [value](const Item &item) { return MeanWithError{value(item), none}; });
}

MeanWithError in_degrees(const MeanWithError &angle)
{
  return {angle.mean * degrees, angle.error * degrees};
}

Fields<Order> order_fields()
{
  using O = Order;
  Fields<O> fields;
  fields.add("rods", kSum, [](const O &o) { return o.rods; });
  fields.add_mean(
      "mean_elevation", [](const O &o) { return in_degrees(o.elevation); }, "_deg");
  fields.add_mean("mean_abs_uz", [](const O &o) { return o.abs_uz; });
  fields.add_mean("mean_uz2", [](const O &o) { return o.uz_squared; });
  fields.add_mean("nematic_order", [](const O &o) {
    return MeanWithError{o.nematic.order, o.nematic.error};
  });
  add_square(fields, "nematic_order_squared", [](const O &o) { return o.squared_order; });
  fields.add_mean("azimuthal_order", [](const O &o) {
    return MeanWithError{o.azimuthal.order, o.azimuthal.error};
  });
  add_square(fields, "azimuthal_order_squared",
             [](const O &o) { return o.azimuthal.squared_unbiased; });
  fields.add_mean("radial_order", [](const O &o) { return o.radial; });
  fields.add_mean("mean_sin_gamma", [](const O &o) { return o.sin_gamma; });
  fields.add_mean("vf_random_contact", [](const O &o) { return o.random_contact; });
  return fields;
}

template <class Number>  // of the measured fractions
auto of_measured(Number number)
{
  return [number](const BedOrientation &b) {
    return MeanWithError{b.measured ? number(*b.measured) : none, none};
  };
}

template <class Number>  // of the shapes of fibres
auto of_shapes(Number number)
{
  return [number](const BedOrientation &b) {
    return b.fibres ? static_cast<double>(number(*b.fibres)) : none;
  };
}

template <class Mean>
auto mean_of_shapes(Mean mean)
{
  return [mean](const BedOrientation &b) {
    return b.fibres ? mean(*b.fibres) : MeanWithError{none, none};
  };
}

void add_fibre_fields(Fields<BedOrientation> &fields)
{
  using S = FibreShapes;
  fields.add("fibres", kSum, of_shapes([](const S &s) { return s.fibres; }));
  fields.add("segments", kSum, of_shapes([](const S &s) { return s.segments; }));
  fields.add("rings", kSum, of_shapes([](const S &s) { return s.rings; }));
  fields.add("parts_of_fibres", kSum, of_shapes([](const S &s) { return s.parts; }));
  fields.add_mean("segments_per_fibre",
                  mean_of_shapes([](const S &s) { return s.segments_a_fibre; }));
  fields.add_mean("contour_length", mean_of_shapes([](const S &s) { return s.contour; }), "_m");
  fields.add_mean("end_to_end_over_contour", mean_of_shapes([](const S &s) { return s.stretch; }));
  fields.add_mean("mean_curvature", mean_of_shapes([](const S &s) { return s.curvature; }),
                  "_per_m");
  fields.add_mean("persistence_length", mean_of_shapes([](const S &s) {
                    return MeanWithError{s.persistence, none};
                  }),
                  "_m");
}

void add_elevation_fields(Fields<ElevationRow> &fields)
{
  using R = ElevationRow;
  fields.add("bin", kSame, [](const R &r) { return r.number; });
  fields.add("elevation_low_deg", kSame, [](const R &r) { return r.bin.low * degrees; });
  fields.add("elevation_high_deg", kSame, [](const R &r) { return r.bin.high * degrees; });
  fields.add("count", kSum, [](const R &r) { return r.bin.count; });
  fields.add_mean("fraction", [](const R &r) { return r.bin.part; });
  fields.add("isotropic_fraction", kSame, [](const R &r) { return r.bin.isotropic_fraction; });
  fields.add("isotropic_scatter", kScatter, [](const R &r) { return r.bin.isotropic_scatter; });
  fields.add_mean("density", [](const R &r) { return r.bin.density(); });
}

}  // namespace

BedOrientation measure_orientation(const Bed &bed, OrientationOptions &options)
{
  const bool by_fibre = options.by == AxisOf::Fibre;
  if (by_fibre && !bed.fibres.are_there())
    throw InputError(fmt::format(
        "--by: 'fibre' is wanted of a dump with columns of fibre and place, f_fibres[1] and "
        "f_fibres[2] or those of --fibre-columns, which {} lacks",
        bed.frame.path));
  const std::vector<Rod> rods = by_fibre ? bodies_with_axis(bed) : without_spheres(bed.rods);
  if (rods.empty())
    throw InputError(
        fmt::format("{}: step {} holds no {} longer than a sphere, wanted at least one",
                    bed.frame.path, bed.frame.step, by_fibre ? "open fibres or rods" : "rods"));
  std::optional<double> lambda;  // of whole fibres
  if (bed.fibres.are_there()) lambda = mean_lambda(without_spheres(bed.stretched));
  if (options.vessel) need_rods_inside(bed, *options.vessel);
  const std::vector<Vec3> axes = axes_of(rods);
  BedOrientation found{};
  found.step = bed.frame.step;
  found.lambda = lambda ? *lambda : mean_lambda(rods);
  if (bed.fibres.are_there()) found.fibres = fibre_shapes(bed.rods, bed.fibres);
  found.order = order_of(rods, options, kMostAxesPaired, lambda);
  found.tensor = nematic_tensor(axes);
  found.histogram = elevation_histogram(axes, options.bins, options.spacing);
  found.chi_squared = chi_squared_isotropic(found.histogram, axes.size());
  measure_near_pairs(bed, rods, options, found);
  found.random_contact_isotropic =
      random_contact_fraction(found.lambda, kIsotropicSinGamma, options.half_contacts);
  if (has_side(options.vessel))
    found.measured = measured_fraction(bed, options, found.lambda, found.order.sin_gamma.mean);
  if (!options.vessel) return found;
  if (!options.wall_width)
    options.wall_width =
        0.25 * mean_of(rods, [](const Rod &rod) { return rod.capsule.length(); }).mean;
  found.by_wall = by_wall(rods, *options.wall_width, options, lambda);
  return found;
}

Fields<BedOrientation> orientation_fields(bool with_fibres)
{
  using B = BedOrientation;
  Fields<B> fields;
  const auto add_constant = [&](const std::string &name, double value) {
    fields.add(name, kSame, [value](const B &) { return value; });
  };
  fields.add("step", kSame, [](const B &b) { return b.step; });
  fields.add_part(order_fields(), [](const B &b) { return b.order; });
  add_constant("mean_elevation_isotropic_deg", kIsotropicMeanElevation * degrees);
  add_constant("mean_abs_uz_isotropic", kIsotropicMeanAbsUz);
  add_constant("mean_uz2_isotropic", kIsotropicMeanUzSquared);
  add_constant("mean_sin_gamma_isotropic", kIsotropicSinGamma);
  fields.add("nematic_order_squared_isotropic_scatter", kScatter,
             [](const B &b) { return isotropic_scatter_of_squared_order(b.order.rods); });
  fields.add("director_x", kSame, [](const B &b) { return b.order.nematic.director.x; });
  fields.add("director_y", kSame, [](const B &b) { return b.order.nematic.director.y; });
  fields.add("director_z", kSame, [](const B &b) { return b.order.nematic.director.z; });
  fields.add("q_xx", kMean, [](const B &b) { return b.tensor.xx; });
  fields.add("q_yy", kMean, [](const B &b) { return b.tensor.yy; });
  fields.add("q_zz", kMean, [](const B &b) { return b.tensor.zz; });
  fields.add("q_xy", kMean, [](const B &b) { return b.tensor.xy; });
  fields.add("q_xz", kMean, [](const B &b) { return b.tensor.xz; });
  fields.add("q_yz", kMean, [](const B &b) { return b.tensor.yz; });
  fields.add("azimuth_deg", kSame, [](const B &b) { return b.order.azimuthal.azimuth * degrees; });
  fields.add("sin_gamma_axes", kSum,
             [](const B &b) { return std::min(b.order.rods, kMostAxesPaired); });
  fields.add("near_pairs", kSum, [](const B &b) { return b.near_pairs; });
  fields.add_mean("near_sin_gamma", [](const B &b) { return b.near_sin_gamma; });
  fields.add("lambda_mean", kMean, [](const B &b) { return b.lambda; });
  fields.add("vf_random_contact_isotropic", kMean,
             [](const B &b) { return b.random_contact_isotropic; });
  using M = MeasuredFraction;
  fields.add_mean("vf_whole", of_measured([](const M &m) { return m.whole; }));
  fields.add_mean("vf_inner", of_measured([](const M &m) { return m.inner; }));
  fields.add_mean("half_contacts_of_vf_inner",
                  of_measured([](const M &m) { return m.half_contacts; }));
  fields.add("chi2_isotropic", kMean, [](const B &b) { return b.chi_squared; });
  fields.add("chi2_degrees_of_freedom", kSame, [](const B &b) { return b.histogram.size() - 1; });
  if (with_fibres) add_fibre_fields(fields);
  return fields;
}

Fields<CorrelationRow> correlation_fields()
{
  using R = CorrelationRow;
  Fields<R> fields;
  fields.add("step", kSame, [](const R &r) { return r.step; });
  fields.add("places_apart", kSame, [](const R &r) { return r.correlation.places; });
  fields.add("distance_m", kMean, [](const R &r) { return r.correlation.distance; });
  fields.add("pairs", kSum, [](const R &r) { return r.correlation.pairs; });
  fields.add_mean("cosine", [](const R &r) { return r.correlation.cosine; });
  return fields;
}

std::vector<CorrelationRow> correlation_rows(const BedOrientation &bed)
{
  std::vector<CorrelationRow> rows;
  if (!bed.fibres) return rows;
  for (const TangentCorrelation &correlation : bed.fibres->correlation)
    rows.push_back({bed.step, correlation});
  return rows;
}

Fields<ElevationRow> elevation_fields()
{
  Fields<ElevationRow> fields;
  fields.add("step", kSame, [](const ElevationRow &r) { return r.step; });
  add_elevation_fields(fields);
  return fields;
}

Fields<ElevationRow> wall_elevation_fields()
{
  using R = ElevationRow;
  Fields<R> fields;
  fields.add("step", kSame, [](const R &r) { return r.step; });
  fields.add("distance_low_m", kSame, [](const R &r) { return r.low; });
  fields.add("distance_high_m", kSame, [](const R &r) { return r.high; });
  add_elevation_fields(fields);
  return fields;
}

Fields<WallRow> wall_fields()
{
  using R = WallRow;
  Fields<R> fields;
  fields.add("step", kSame, [](const R &r) { return r.step; });
  fields.add("distance_low_m", kSame, [](const R &r) { return r.bin.low; });
  fields.add("distance_high_m", kSame, [](const R &r) { return r.bin.high; });
  fields.add_part(order_fields(), [](const R &r) { return r.bin.order; });
  return fields;
}

std::vector<ElevationRow> elevation_rows(const BedOrientation &bed)
{
  return rows_of(bed.step, bed.histogram, none, none);
}

std::vector<WallRow> wall_rows(const BedOrientation &bed)
{
  std::vector<WallRow> rows;
  for (const WallBin &bin : bed.by_wall) rows.push_back({bed.step, bin});
  return rows;
}

std::vector<ElevationRow> wall_elevation_rows(const BedOrientation &bed)
{
  std::vector<ElevationRow> rows;
  for (const WallBin &bin : bed.by_wall)
    for (const ElevationRow &row : rows_of(bed.step, bin.histogram, bin.low, bin.high))
      rows.push_back(row);
  return rows;
}

}  // namespace spherocylinder
