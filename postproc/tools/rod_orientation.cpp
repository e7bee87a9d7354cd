// SPDX-License-Identifier: GPL-2.0-or-later
// rod_orientation: how the rods of a bed are inclined. docs/rod_orientation.md
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "analysis/beds.h"
#include "analysis/close_pairs.h"
#include "analysis/contact_statistics.h"
#include "analysis/input_error.h"
#include "analysis/orientation_statistics.h"
#include "analysis/packing_theory.h"
#include "analysis/result_table.h"

using namespace spherocylinder;

namespace {

constexpr double degrees = 57.295779513082321;  // in a radian
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double most_wall_bins = 10000;
constexpr double packing_tolerance = 1e-4;  // relative, of the rods' volume in the inner cylinder

struct Options {
  BedFiles beds;
  VesselOptions vessel;
  std::size_t bins = 18;
  std::string spacing = "solid-angle";
  std::string wall = "nearest";
  std::optional<double> wall_width;  // m
  double near = 0.1;                 // diameters of the thickest rod
  double half_contacts = half_contacts_per_rod;
  std::string csv, summary_csv, wall_csv, wall_bins_csv;

  BinSpacing bin_spacing() const
  {
    return spacing == "angle" ? BinSpacing::equal_angle : BinSpacing::equal_solid_angle;
  }
};

// What is measured of any set of rods: a bed, or those at some distance from a wall.
struct Order {
  std::size_t rods;  // with an axis
  MeanWithError elevation, abs_uz, uz_squared;
  NematicOrder nematic;
  double squared_order;
  AzimuthalOrder azimuthal;
  MeanWithError radial;  // NaN without a vessel's axis
  MeanWithError sin_gamma;
  MeanWithError random_contact;  // V_f that <|sin gamma|> lets expect
};

struct WallBin {
  double low, high;  // distance of the centre from the wall (m)
  Order order;
  std::vector<ElevationBin> histogram;
};

struct MeasuredFraction {
  double whole, inner;  // as rod_packing gives them
};

struct Result {
  std::int64_t step;
  double lambda;  // number mean of the rods with an axis
  Order order;
  NematicTensor tensor;
  std::vector<ElevationBin> histogram;
  double chi_squared;
  std::size_t near_pairs;
  MeanWithError near_sin_gamma;
  std::optional<MeasuredFraction> measured;
  std::vector<WallBin> by_wall;
};

constexpr OverFiles same = OverFiles::same, sum = OverFiles::sum, mean = OverFiles::mean,
                    error = OverFiles::error, scatter = OverFiles::scatter;

const std::vector<Column> bin_columns{{"step", same},
                                      {"bin", same},
                                      {"elevation_low_deg", same},
                                      {"elevation_high_deg", same},
                                      {"count", sum},
                                      {"fraction", mean},
                                      {"fraction_error", error},
                                      {"isotropic_fraction", same},
                                      {"isotropic_scatter", scatter},
                                      {"density", mean},
                                      {"density_error", error}};

const std::vector<Column> summary_columns{{"step", same},
                                          {"rods", sum},
                                          {"mean_elevation_deg", mean},
                                          {"mean_elevation_error_deg", error},
                                          {"mean_elevation_isotropic_deg", same},
                                          {"mean_abs_uz", mean},
                                          {"mean_abs_uz_error", error},
                                          {"mean_abs_uz_isotropic", same},
                                          {"mean_uz2", mean},
                                          {"mean_uz2_error", error},
                                          {"mean_uz2_isotropic", same},
                                          {"nematic_order", mean},
                                          {"nematic_order_error", error},
                                          {"director_x", same},
                                          {"director_y", same},
                                          {"director_z", same},
                                          {"nematic_order_squared", mean},
                                          {"nematic_order_squared_error", error},
                                          {"nematic_order_squared_isotropic_scatter", scatter},
                                          {"q_xx", mean},
                                          {"q_yy", mean},
                                          {"q_zz", mean},
                                          {"q_xy", mean},
                                          {"q_xz", mean},
                                          {"q_yz", mean},
                                          {"azimuthal_order", mean},
                                          {"azimuthal_order_error", error},
                                          {"azimuthal_order_squared", mean},
                                          {"azimuthal_order_squared_error", error},
                                          {"azimuth_deg", same},
                                          {"radial_order", mean},
                                          {"radial_order_error", error},
                                          {"mean_sin_gamma", mean},
                                          {"mean_sin_gamma_error", error},
                                          {"mean_sin_gamma_isotropic", same},
                                          {"sin_gamma_axes", sum},
                                          {"near_pairs", sum},
                                          {"near_sin_gamma", mean},
                                          {"near_sin_gamma_error", error},
                                          {"lambda_mean", mean},
                                          {"vf_random_contact", mean},
                                          {"vf_random_contact_error", error},
                                          {"vf_random_contact_isotropic", mean},
                                          {"vf_whole", mean},
                                          {"vf_whole_error", error},
                                          {"vf_inner", mean},
                                          {"vf_inner_error", error},
                                          {"half_contacts_of_vf_inner", mean},
                                          {"half_contacts_of_vf_inner_error", error},
                                          {"chi2_isotropic", mean},
                                          {"chi2_degrees_of_freedom", same}};

const std::vector<Column> wall_columns{{"step", same},
                                       {"distance_low_m", same},
                                       {"distance_high_m", same},
                                       {"rods", sum},
                                       {"mean_elevation_deg", mean},
                                       {"mean_elevation_error_deg", error},
                                       {"mean_abs_uz", mean},
                                       {"mean_abs_uz_error", error},
                                       {"mean_uz2", mean},
                                       {"mean_uz2_error", error},
                                       {"nematic_order", mean},
                                       {"nematic_order_error", error},
                                       {"nematic_order_squared", mean},
                                       {"nematic_order_squared_error", error},
                                       {"azimuthal_order", mean},
                                       {"azimuthal_order_error", error},
                                       {"azimuthal_order_squared", mean},
                                       {"azimuthal_order_squared_error", error},
                                       {"radial_order", mean},
                                       {"radial_order_error", error},
                                       {"mean_sin_gamma", mean},
                                       {"mean_sin_gamma_error", error},
                                       {"vf_random_contact", mean},
                                       {"vf_random_contact_error", error}};

std::vector<Column> wall_bin_columns()
{
  std::vector<Column> columns = bin_columns;
  columns.insert(columns.begin() + 1, {{"distance_low_m", same}, {"distance_high_m", same}});
  return columns;
}

double number(std::size_t count) { return static_cast<double>(count); }

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
  constexpr double step = 1e-4;
  const double slope = (at(sin_gamma.mean + step) - at(sin_gamma.mean - step)) / (2.0 * step);
  return {at(sin_gamma.mean), std::abs(slope) * sin_gamma.error};
}

bool has_side(const std::optional<Vessel> &vessel)
{
  return vessel && std::isfinite(vessel->radius);
}

Order order_of(const std::vector<Rod> &rods, const std::optional<Vessel> &vessel,
               double half_contacts)
{
  const std::vector<Vec3> axes = axes_of(rods);
  Order order{};
  order.rods = axes.size();
  order.elevation = mean_elevation(axes);
  order.abs_uz = mean_abs_uz(axes);
  order.uz_squared = mean_uz_squared(axes);
  order.nematic = axes.empty() ? NematicOrder{none, {none, none, none}, none} : nematic_order(axes);
  order.squared_order = unbiased_squared_order(axes);
  order.azimuthal = azimuthal_order(axes);
  order.radial = has_side(vessel) ? radial_order(rods, vessel->x, vessel->y)
                                  : MeanWithError{none, none};
  order.sin_gamma = sin_gamma_of_pairs(axes);
  order.random_contact = random_contact(mean_lambda(rods), order.sin_gamma, half_contacts);
  return order;
}

double wall_distance(const Rod &rod, const Vessel &vessel, const std::string &wall)
{
  const Vec3 &c = rod.capsule.segment.centre;
  const double to_side = vessel.radius - std::hypot(c.x - vessel.x, c.y - vessel.y);
  const double to_floor = c.z - vessel.floor;
  return wall == "side" ? to_side : wall == "floor" ? to_floor : std::min(to_side, to_floor);
}

std::vector<WallBin> by_wall(const std::vector<Rod> &rods, const Vessel &vessel, double width,
                             const Options &options)
{
  std::vector<std::vector<Rod>> rods_of_bin;
  for (const Rod &rod : rods) {
    const double distance = wall_distance(rod, vessel, options.wall);
    if (!(distance / width < most_wall_bins))
      throw InputError(
          fmt::format("--wall-width: {} m make more than {} bins up to a rod {} m from "
                      "the wall, wanted a larger width",
                      width, most_wall_bins, distance));
    const auto bin = static_cast<std::size_t>(distance / width);
    if (bin >= rods_of_bin.size()) rods_of_bin.resize(bin + 1);
    rods_of_bin[bin].push_back(rod);
  }
  std::vector<WallBin> bins;
  for (std::size_t k = 0; k < rods_of_bin.size(); ++k)
    bins.push_back({width * number(k), width * number(k + 1),
                    order_of(rods_of_bin[k], vessel, options.half_contacts),
                    elevation_histogram(axes_of(rods_of_bin[k]), options.bins,
                                        options.bin_spacing())});
  return bins;
}

// The same fractions as rod_packing's, of all particles, spheres too.
MeasuredFraction measured_fraction(const Bed &bed, const Vessel &vessel)
{
  const UprightCylinder whole = vessel_up_to(vessel, bed_height(bed.rods).highest_centre);
  return {total_volume(bed.rods) / volume(whole),
          solid_fraction(bed.rods, inner_half(whole), packing_tolerance).fraction};
}

class Measurement {
 public:
  explicit Measurement(const Options &options)
      : options_(options), vessel_(options.vessel.vessel()), wall_width_(options.wall_width)
  {
    const bool wants_wall = !options.wall_csv.empty() || !options.wall_bins_csv.empty();
    if (wants_wall && !vessel_)
      throw InputError("--wall-csv, --wall-bins-csv: wanted with --vessel-radius or --floor");
    if (options.wall == "side" && vessel_ && !has_side(vessel_))
      throw InputError("--wall: 'side' is wanted with --vessel-radius only");
  }

  Result of(const Bed &bed)
  {
    const std::vector<Rod> rods = without_spheres(bed.rods);
    if (rods.empty())
      throw InputError(
          fmt::format("{}: step {} holds no rods longer than a sphere, wanted at least one",
                      bed.frame.path, bed.frame.step));
    if (vessel_) need_rods_inside(bed, *vessel_);
    Result r{};
    r.step = bed.frame.step;
    r.lambda = mean_lambda(rods);
    r.order = order_of(rods, vessel_, options_.half_contacts);
    const std::vector<Vec3> axes = axes_of(rods);
    r.tensor = nematic_tensor(axes);
    r.histogram = elevation_histogram(axes, options_.bins, options_.bin_spacing());
    r.chi_squared = chi_squared_isotropic(r.histogram, axes.size());
    near_pairs(bed, rods, r);
    if (has_side(vessel_)) r.measured = measured_fraction(bed, *vessel_);
    if (!vessel_) return r;
    // A quarter of a rod, the same for all files.
    if (!wall_width_)
      wall_width_ = 0.25 * mean_of(rods, [](const Rod &rod) { return rod.capsule.length(); }).mean;
    r.by_wall = by_wall(rods, *vessel_, *wall_width_, options_);
    return r;
  }

 private:
  void near_pairs(const Bed &bed, const std::vector<Rod> &rods, Result &r) const
  {
    double diameter = 0.0;
    for (const Rod &rod : rods) diameter = std::max(diameter, 2.0 * rod.capsule.radius);
    const auto pairs = close_pairs(rods, periodicity_of(bed.frame), options_.near * diameter);
    r.near_pairs = pairs.size();
    r.near_sin_gamma = mean_of(pairs, [](const ClosePair &pair) { return pair.sin_gamma; });
  }

  const Options &options_;
  std::optional<Vessel> vessel_;
  std::optional<double> wall_width_;
};

Rows bin_rows(std::int64_t step, const std::vector<ElevationBin> &histogram)
{
  Rows rows;
  for (std::size_t i = 0; i < histogram.size(); ++i) {
    const ElevationBin &bin = histogram[i];
    rows.push_back({static_cast<double>(step), number(i + 1), bin.low * degrees, bin.high * degrees,
                    number(bin.count), bin.fraction, bin.fraction_error, bin.isotropic_fraction,
                    bin.isotropic_scatter, bin.density(), bin.density_error()});
  }
  return rows;
}

std::vector<double> summary_row(const Result &r, double half_contacts)
{
  const Order &o = r.order;
  const double whole = r.measured ? r.measured->whole : none;
  const double inner = r.measured ? r.measured->inner : none;
  // V_f is proportional to the contacts counted.
  const double implied = inner / o.random_contact.mean * half_contacts;
  return {static_cast<double>(r.step),
          number(o.rods),
          o.elevation.mean * degrees,
          o.elevation.error * degrees,
          isotropic_mean_elevation * degrees,
          o.abs_uz.mean,
          o.abs_uz.error,
          isotropic_mean_abs_uz,
          o.uz_squared.mean,
          o.uz_squared.error,
          isotropic_mean_uz_squared,
          o.nematic.order,
          o.nematic.error,
          o.nematic.director.x,
          o.nematic.director.y,
          o.nematic.director.z,
          o.squared_order,
          none,
          isotropic_scatter_of_squared_order(o.rods),
          r.tensor.xx,
          r.tensor.yy,
          r.tensor.zz,
          r.tensor.xy,
          r.tensor.xz,
          r.tensor.yz,
          o.azimuthal.order,
          o.azimuthal.error,
          o.azimuthal.squared_unbiased,
          none,
          o.azimuthal.azimuth * degrees,
          o.radial.mean,
          o.radial.error,
          o.sin_gamma.mean,
          o.sin_gamma.error,
          isotropic_sin_gamma,
          number(std::min(o.rods, most_axes_paired)),
          number(r.near_pairs),
          r.near_sin_gamma.mean,
          r.near_sin_gamma.error,
          r.lambda,
          o.random_contact.mean,
          o.random_contact.error,
          random_contact_fraction(r.lambda, isotropic_sin_gamma, half_contacts),
          whole,
          none,
          inner,
          none,
          implied,
          none,
          r.chi_squared,
          number(r.histogram.size() - 1)};
}

Rows wall_rows(const Result &r)
{
  Rows rows;
  for (const WallBin &bin : r.by_wall) {
    const Order &o = bin.order;
    rows.push_back({static_cast<double>(r.step), bin.low, bin.high, number(o.rods),
                    o.elevation.mean * degrees, o.elevation.error * degrees, o.abs_uz.mean,
                    o.abs_uz.error, o.uz_squared.mean, o.uz_squared.error, o.nematic.order,
                    o.nematic.error, o.squared_order, none, o.azimuthal.order, o.azimuthal.error,
                    o.azimuthal.squared_unbiased, none, o.radial.mean, o.radial.error,
                    o.sin_gamma.mean, o.sin_gamma.error, o.random_contact.mean,
                    o.random_contact.error});
  }
  return rows;
}

Rows wall_bin_rows(const Result &r)
{
  Rows rows;
  for (const WallBin &bin : r.by_wall)
    for (std::vector<double> &row : bin_rows(r.step, bin.histogram)) {
      row.insert(row.begin() + 1, {bin.low, bin.high});
      rows.push_back(row);
    }
  return rows;
}

void print_order(const Result &r)
{
  const Order &o = r.order;
  const double n = number(o.rods);
  fmt::print("                         measured   error   isotropic\n");
  fmt::print("  mean elevation (deg)   {:8.2f} {:7.2f}   {:9.2f}\n", o.elevation.mean * degrees,
             o.elevation.error * degrees, isotropic_mean_elevation * degrees);
  fmt::print("  <|u_z|>                {:8.4f} {:7.4f}   {:9.4f}\n", o.abs_uz.mean, o.abs_uz.error,
             isotropic_mean_abs_uz);
  fmt::print("  <u_z^2>                {:8.4f} {:7.4f}   {:9.4f}\n", o.uz_squared.mean,
             o.uz_squared.error, isotropic_mean_uz_squared);
  const Vec3 &d = o.nematic.director;
  fmt::print(
      "  nematic order          {:8.4f} {:7.4f}   {:9.4f}   (1/sqrt(n)), director ({:.3f}, {:.3f}, "
      "{:.3f})\n",
      o.nematic.order, o.nematic.error, 1.0 / std::sqrt(n), d.x, d.y, d.z);
  fmt::print("    squared, unbiased    {:8.4f}           {:9.4f}   -+ {:.4f}\n", o.squared_order,
             0.0, isotropic_scatter_of_squared_order(o.rods));
  fmt::print(
      "  azimuthal order        {:8.4f} {:7.4f}   {:9.4f}   (1/sqrt(n)), heading {:.1f} deg\n",
      o.azimuthal.order, o.azimuthal.error, 1.0 / std::sqrt(n), o.azimuthal.azimuth * degrees);
  if (!std::isnan(o.radial.mean))
    fmt::print(
        "  radial order           {:8.4f} {:7.4f}   {:9.4f}   (-1 around the axis, 1 towards "
        "it)\n",
        o.radial.mean, o.radial.error, 0.0);
  fmt::print("  <|sin gamma|>          {:8.4f} {:7.4f}   {:9.4f}   {} of {} axes\n",
             o.sin_gamma.mean, o.sin_gamma.error, isotropic_sin_gamma,
             o.rods > most_axes_paired ? "pairs" : "all pairs", std::min(o.rods, most_axes_paired));
  if (r.near_pairs > 0)
    fmt::print("    of near pairs        {:8.4f} {:7.4f}   {:9.4f}   {} pairs\n",
               r.near_sin_gamma.mean, r.near_sin_gamma.error, isotropic_contact_sin_gamma,
               r.near_pairs);
}

void print_table(const Result &r, const Options &options)
{
  fmt::print("step {}: {} rods\n", r.step, r.order.rods);
  print_order(r);
  fmt::print(
      "  V_f by random contacts {:8.4f} {:7.4f}   {:9.4f}   lambda {:.4g}, {:.4g} contacts "
      "counted on each rod\n",
      r.order.random_contact.mean, r.order.random_contact.error,
      random_contact_fraction(r.lambda, isotropic_sin_gamma, options.half_contacts), r.lambda,
      options.half_contacts);
  if (r.measured)
    fmt::print(
        "    as measured          {:8.4f}           inner cylinder ({:.4f} whole vessel): {:.3f} "
        "contacts\n",
        r.measured->inner, r.measured->whole,
        r.measured->inner / r.order.random_contact.mean * options.half_contacts);
  fmt::print("  chi^2 of the bins      {:8.1f}           {:9}\n", r.chi_squared,
             r.histogram.size() - 1);
  fmt::print("  elevation (deg)     count  fraction   error   isotropic  density\n");
  for (const ElevationBin &bin : r.histogram)
    fmt::print("  {:6.2f} - {:6.2f}  {:8}  {:8.4f} {:7.4f}   {:9.4f}  {:7.3f}\n", bin.low * degrees,
               bin.high * degrees, bin.count, bin.fraction, bin.fraction_error,
               bin.isotropic_fraction, bin.density());
  if (r.by_wall.empty()) return;
  fmt::print(
      "  from {} wall (m)    rods  elevation   error  squared order  radial  <|sin gamma|>\n",
      options.wall);
  for (const WallBin &bin : r.by_wall)
    fmt::print("  {:7.4g} - {:7.4g}  {:8}  {:9.2f} {:7.2f}  {:13.4f} {:7.3f}  {:13.4f}\n", bin.low,
               bin.high, bin.order.rods, bin.order.elevation.mean * degrees,
               bin.order.elevation.error * degrees, bin.order.squared_order, bin.order.radial.mean,
               bin.order.sin_gamma.mean);
}

void run(const Options &options)
{
  const bool several = options.beds.several();
  Measurement measurement(options);
  ResultTable bins(options.csv, bin_columns, several);
  ResultTable summary(options.summary_csv, summary_columns, several);
  ResultTable wall(options.wall_csv, wall_columns, several);
  ResultTable wall_bins(options.wall_bins_csv, wall_bin_columns(), several);
  for_each_bed(options.beds, [&](const Bed &bed) {
    const Result result = measurement.of(bed);
    bins.add(bin_rows(result.step, result.histogram));
    summary.add({summary_row(result, options.half_contacts)});
    wall.add(wall_rows(result));
    wall_bins.add(wall_bin_rows(result));
    if (several) fmt::print("{}: ", bed.frame.path);
    print_table(result, options);
  });
  if (several) {
    fmt::print("means of the files\n");
    print_means(summary_columns, summary.combined()[0]);
  }
  for (ResultTable *table : {&bins, &summary, &wall, &wall_bins}) table->finish();
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Distribution of the rods' elevation above the horizontal, and their order.",
               "rod_orientation");
  app.footer("Example: rod_orientation bed.dump --vessel-radius 0.305 --csv elevation.csv");
  add_bed_options(app, options.beds);
  add_vessel_options(app, options.vessel);
  app.add_option("--bins", options.bins, "number of bins from 0 to 90 degrees")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--spacing", options.spacing,
                 "bins of equal 'solid-angle' (an isotropic set fills all alike) or equal 'angle'")
      ->check(CLI::IsMember({"solid-angle", "angle"}))
      ->capture_default_str();
  app.add_option("--wall", options.wall, "wall that distances are taken from")
      ->check(CLI::IsMember({"nearest", "side", "floor"}))
      ->capture_default_str();
  app.add_option("--wall-width", options.wall_width,
                 "width of a bin of the distance (m), default a quarter of a rod")
      ->check(positive_number());
  app.add_option("--near", options.near,
                 "gap of the surfaces below which rods are near, in diameters of the thickest rod")
      ->check(number_between(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--half-contacts", options.half_contacts,
                 "contacts counted on each rod by the random contact equation")
      ->check(positive_number())
      ->capture_default_str();
  app.add_option("--csv", options.csv, "write the bins to this CSV file");
  app.add_option("--summary-csv", options.summary_csv, "write the means to this CSV file");
  app.add_option("--wall-csv", options.wall_csv,
                 "write the means by distance from the wall to this CSV file");
  app.add_option("--wall-bins-csv", options.wall_bins_csv,
                 "write the bins by distance from the wall to this CSV file");
  return run_tool(app, argc, argv, [&] { run(options); });
}
