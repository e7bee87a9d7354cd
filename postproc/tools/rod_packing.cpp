// SPDX-License-Identifier: GPL-2.0-or-later
// rod_packing: solid volume fractions of a bed of rods in a cylindrical vessel. docs/rod_packing.md
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "analysis/command_line.h"
#include "analysis/csv_file.h"
#include "analysis/frame_choice.h"
#include "analysis/input_error.h"
#include "analysis/orientation_statistics.h"
#include "analysis/packing_measures.h"
#include "analysis/packing_theory.h"

using namespace spherocylinder;

namespace {

constexpr double degrees = 57.295779513082321;  // in a radian
constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Options {
  InputOptions input;
  std::string csv;
  Vessel vessel;
  std::vector<double> centre{0.0, 0.0};
  InnerOverride inner;
  double tolerance = 1e-4;
};

struct AspectRatios {
  double mean, smallest, largest;  // total length over diameter, mean over the rods

  // Wider than the rounding of a dump.
  bool several() const { return largest - smallest > 1e-4 * mean; }
};

struct Result {
  std::int64_t step;
  std::size_t rods, spheres;
  AspectRatios lambda;
  double mean_elevation_deg;  // NaN if all are spheres, as mean_sin_gamma
  double mean_sin_gamma;
  BedHeight height;
  double rods_volume;
  double whole_volume;
  double vf_whole;
  SolidFraction clipped, inner;
};

const std::vector<std::string> column_names{"step",
                                            "rods",
                                            "spheres",
                                            "lambda_mean",
                                            "lambda_min",
                                            "lambda_max",
                                            "mean_elevation_deg",
                                            "mean_sin_gamma",
                                            "z_top_m",
                                            "highest_point_m",
                                            "rods_volume_m3",
                                            "whole_volume_m3",
                                            "vf_whole",
                                            "vf_whole_clipped",
                                            "vf_whole_clipped_error",
                                            "inner_radius_m",
                                            "inner_bottom_m",
                                            "inner_top_m",
                                            "inner_volume_m3",
                                            "vf_inner",
                                            "vf_inner_error",
                                            "vf_parkhouse_kelly",
                                            "vf_random_contact_isotropic",
                                            "vf_random_contact_horizontal",
                                            "vf_random_contact_measured"};

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

UprightCylinder inner_region(const UprightCylinder &whole, const InnerOverride &chosen)
{
  UprightCylinder inner = inner_half(whole);
  inner.radius = chosen.radius.value_or(inner.radius);
  inner.z_low = chosen.bottom.value_or(inner.z_low);
  inner.z_high = chosen.top.value_or(inner.z_high);
  if (inner.radius > whole.radius)
    throw InputError(fmt::format("--inner-radius: must be at most the vessel radius {} (got {})",
                                 whole.radius, inner.radius));
  if (!(inner.z_low < inner.z_high))
    throw InputError(
        fmt::format("--inner-bottom, --inner-top: the top must be above the bottom "
                    "(got bottom {:.6g}, top {:.6g})",
                    inner.z_low, inner.z_high));
  return inner;
}

Result measure(const DumpFrame &frame, const std::vector<Rod> &rods, const Options &options)
{
  const Vessel &vessel = options.vessel;
  if (const std::size_t outside = count_outside(rods, vessel))
    throw InputError(
        fmt::format("{}: step {}: {} of {} rod centres are outside the vessel of radius {} about "
                    "({}, {}) above "
                    "floor {}, wanted none",
                    frame.path, frame.step, outside, rods.size(), vessel.radius, vessel.x, vessel.y,
                    vessel.floor));

  Result result{};
  result.step = frame.step;
  result.height = bed_height(rods);
  if (!(result.height.highest_centre > vessel.floor))
    throw InputError(
        fmt::format("{}: step {}: the highest rod centre is at {}, wanted above the "
                    "floor",
                    frame.path, frame.step, result.height.highest_centre));
  const std::vector<Vec3> axes = axes_of(rods);
  result.rods = rods.size();
  result.spheres = rods.size() - axes.size();
  result.lambda = aspect_ratios(rods);
  result.mean_elevation_deg = axes.empty() ? none : mean_elevation(axes).mean * degrees;
  result.mean_sin_gamma = axes.size() < 2 ? none : mean_sin_gamma(axes);

  const UprightCylinder whole = vessel_up_to(vessel, result.height.highest_centre);
  result.rods_volume = total_volume(rods);
  result.whole_volume = volume(whole);
  result.vf_whole = result.rods_volume / result.whole_volume;
  result.clipped = solid_fraction(rods, whole, options.tolerance);
  result.inner = solid_fraction(rods, inner_region(whole, options.inner), options.tolerance);
  return result;
}

std::vector<double> csv_row(const Result &r)
{
  const UprightCylinder &inner = r.inner.region;
  const double lambda = r.lambda.mean;
  return {static_cast<double>(r.step),
          static_cast<double>(r.rods),
          static_cast<double>(r.spheres),
          lambda,
          r.lambda.smallest,
          r.lambda.largest,
          r.mean_elevation_deg,
          r.mean_sin_gamma,
          r.height.highest_centre,
          r.height.highest_point,
          r.rods_volume,
          r.whole_volume,
          r.vf_whole,
          r.clipped.fraction,
          r.clipped.error,
          inner.radius,
          inner.z_low,
          inner.z_high,
          volume(inner),
          r.inner.fraction,
          r.inner.error,
          parkhouse_kelly_fraction(lambda),
          random_contact_fraction(lambda, isotropic_sin_gamma),
          random_contact_fraction(lambda, horizontal_sin_gamma),
          random_contact_fraction(lambda, r.mean_sin_gamma)};
}

void print_table(const Result &r)
{
  const UprightCylinder &inner = r.inner.region;
  const double lambda = r.lambda.mean;
  fmt::print("step {}: {} rods, lambda {:.4g}", r.step, r.rods, lambda);
  if (r.lambda.several())
    fmt::print(" (number mean; {:.4g} to {:.4g}; theory below is for the mean)", r.lambda.smallest,
               r.lambda.largest);
  if (r.spheres > 0) fmt::print(", {} of them spheres", r.spheres);
  fmt::print("\n");
  if (!std::isnan(r.mean_elevation_deg))
    fmt::print("  mean elevation         {:8.2f} deg   (isotropic {:.2f})\n", r.mean_elevation_deg,
               isotropic_mean_elevation * degrees);
  fmt::print("  highest rod centre     {:8.4g} m     (highest point {:.4g} m)\n",
             r.height.highest_centre, r.height.highest_point);
  fmt::print("  V_f whole vessel       {:8.4f}       up to the highest rod centre\n", r.vf_whole);
  fmt::print("  V_f whole, clipped     {:8.4f}       -+ {:.1e}\n", r.clipped.fraction,
             r.clipped.error);
  fmt::print(
      "  V_f inner cylinder     {:8.4f}       -+ {:.1e}, radius {:.4g} m, z {:.4g} to {:.4g} "
      "m, {:.3g} of the volume\n",
      r.inner.fraction, r.inner.error, inner.radius, inner.z_low, inner.z_high,
      volume(inner) / r.whole_volume);
  fmt::print("  Parkhouse & Kelly      {:8.4f}       2 ln(lambda)/lambda\n",
             parkhouse_kelly_fraction(lambda));
  fmt::print("  random contacts        {:8.4f}       isotropic\n",
             random_contact_fraction(lambda, isotropic_sin_gamma));
  fmt::print("                         {:8.4f}       horizontal\n",
             random_contact_fraction(lambda, horizontal_sin_gamma));
  if (!std::isnan(r.mean_sin_gamma))
    fmt::print("                         {:8.4f}       as measured, <|sin gamma|> = {:.4f}\n",
               random_contact_fraction(lambda, r.mean_sin_gamma), r.mean_sin_gamma);
}

void run(Options &options)
{
  options.vessel.x = options.centre[0];
  options.vessel.y = options.centre[1];
  const FrameChoice choice = parse_frame_choice(options.input.frame);
  std::optional<CsvFile> csv;  // opened only once there is something to write
  for_each_frame(options.input.dump, choice, [&](const DumpFrame &frame) {
    const std::vector<Rod> rods = rods_of(frame);
    if (rods.empty() && choice.kind == FrameChoice::Kind::all) return;
    if (rods.empty())
      throw InputError(
          fmt::format("{}: step {} holds no rods, wanted at least one", frame.path, frame.step));
    const Result result = measure(frame, rods, options);
    if (!csv) csv.emplace(options.csv, column_names);
    print_table(result);
    csv->row(csv_row(result));
  });
  if (!csv)
    throw InputError(
        fmt::format("{}: no step holds any rods, wanted at least one", options.input.dump));
  csv->close();
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Solid volume fractions of a bed of rods in an upright cylindrical vessel.",
               "rod_packing");
  app.footer("Example: rod_packing bed.dump --vessel-radius 0.305 --csv packing.csv");
  add_input_options(app, options.input);
  app.add_option("--vessel-radius", options.vessel.radius, "radius of the vessel (m)")
      ->required()
      ->check(positive_number());
  app.add_option("--centre,--center", options.centre, "X Y of the vessel's axis (m)")
      ->expected(2)
      ->check(finite_number())
      ->capture_default_str();
  app.add_option("--floor", options.vessel.floor, "height Z of the vessel's floor (m)")
      ->check(finite_number())
      ->capture_default_str();
  app.add_option("--inner-radius", options.inner.radius,
                 "radius of the inner cylinder (m), default 2^(-1/3) of the vessel's")
      ->check(positive_number());
  app.add_option("--inner-bottom", options.inner.bottom,
                 "lower end of the inner cylinder (m), default centred at mid-height")
      ->check(finite_number());
  app.add_option("--inner-top", options.inner.top,
                 "upper end of the inner cylinder (m), default centred at mid-height")
      ->check(finite_number());
  app.add_option("--tolerance", options.tolerance, "relative error allowed for clipped volumes")
      ->check(number_between(1e-9, 0.1))
      ->capture_default_str();
  app.add_option("--csv", options.csv, "write the numbers to this CSV file");
  return run_tool(app, argc, argv, [&] { run(options); });
}
