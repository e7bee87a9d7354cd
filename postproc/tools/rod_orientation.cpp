// SPDX-License-Identifier: GPL-2.0-or-later
// rod_orientation: how the rods of a bed are inclined. docs/rod_orientation.md
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "analysis/command_line.h"
#include "analysis/csv_file.h"
#include "analysis/frame_choice.h"
#include "analysis/input_error.h"
#include "analysis/orientation_statistics.h"

using namespace spherocylinder;

namespace {

constexpr double degrees = 57.295779513082321;  // in a radian

struct Options {
  InputOptions input;
  std::string csv, summary_csv;
  std::size_t bins = 18;
  std::string spacing = "solid-angle";
};

struct Result {
  std::int64_t step;
  std::size_t rods;
  MeanWithError elevation, abs_uz, uz_squared;
  NematicOrder nematic;
  std::vector<ElevationBin> histogram;
  double chi_squared;
};

const std::vector<std::string> bin_columns{"step",
                                           "bin",
                                           "elevation_low_deg",
                                           "elevation_high_deg",
                                           "count",
                                           "fraction",
                                           "fraction_error",
                                           "isotropic_fraction",
                                           "isotropic_scatter",
                                           "density",
                                           "density_error"};

const std::vector<std::string> summary_columns{"step",
                                               "rods",
                                               "mean_elevation_deg",
                                               "mean_elevation_error_deg",
                                               "mean_elevation_isotropic_deg",
                                               "mean_abs_uz",
                                               "mean_abs_uz_error",
                                               "mean_abs_uz_isotropic",
                                               "mean_uz2",
                                               "mean_uz2_error",
                                               "mean_uz2_isotropic",
                                               "nematic_order",
                                               "director_x",
                                               "director_y",
                                               "director_z",
                                               "chi2_isotropic",
                                               "chi2_degrees_of_freedom"};

Result measure(const DumpFrame &frame, const std::vector<Vec3> &axes, const Options &options)
{
  Result result{};
  result.step = frame.step;
  result.rods = axes.size();
  result.elevation = mean_elevation(axes);
  result.abs_uz = mean_abs_uz(axes);
  result.uz_squared = mean_uz_squared(axes);
  result.nematic = nematic_order(axes);
  result.histogram = elevation_histogram(
      axes, options.bins,
      options.spacing == "angle" ? BinSpacing::equal_angle : BinSpacing::equal_solid_angle);
  result.chi_squared = chi_squared_isotropic(result.histogram, axes.size());
  return result;
}

std::vector<double> bin_row(const Result &r, std::size_t i)
{
  const ElevationBin &bin = r.histogram[i];
  return {static_cast<double>(r.step),
          static_cast<double>(i + 1),
          bin.low * degrees,
          bin.high * degrees,
          static_cast<double>(bin.count),
          bin.fraction,
          bin.fraction_error,
          bin.isotropic_fraction,
          bin.isotropic_scatter,
          bin.density(),
          bin.density_error()};
}

std::vector<double> summary_row(const Result &r)
{
  return {static_cast<double>(r.step),
          static_cast<double>(r.rods),
          r.elevation.mean * degrees,
          r.elevation.error * degrees,
          isotropic_mean_elevation * degrees,
          r.abs_uz.mean,
          r.abs_uz.error,
          isotropic_mean_abs_uz,
          r.uz_squared.mean,
          r.uz_squared.error,
          isotropic_mean_uz_squared,
          r.nematic.order,
          r.nematic.director.x,
          r.nematic.director.y,
          r.nematic.director.z,
          r.chi_squared,
          static_cast<double>(r.histogram.size() - 1)};
}

void print_table(const Result &r)
{
  fmt::print("step {}: {} rods\n", r.step, r.rods);
  fmt::print("                         measured   error   isotropic\n");
  fmt::print("  mean elevation (deg)   {:8.2f} {:7.2f}   {:9.2f}\n", r.elevation.mean * degrees,
             r.elevation.error * degrees, isotropic_mean_elevation * degrees);
  fmt::print("  <|u_z|>                {:8.4f} {:7.4f}   {:9.4f}\n", r.abs_uz.mean, r.abs_uz.error,
             isotropic_mean_abs_uz);
  fmt::print("  <u_z^2>                {:8.4f} {:7.4f}   {:9.4f}\n", r.uz_squared.mean,
             r.uz_squared.error, isotropic_mean_uz_squared);
  const Vec3 &n = r.nematic.director;
  fmt::print(
      "  nematic order          {:8.4f}           {:9.4f}   director ({:.3f}, {:.3f}, {:.3f})\n",
      r.nematic.order, 0.0, n.x, n.y, n.z);
  fmt::print("  chi^2 of the bins      {:8.1f}           {:9}\n", r.chi_squared,
             r.histogram.size() - 1);
  fmt::print("  elevation (deg)     count  fraction   error   isotropic  density\n");
  for (const ElevationBin &bin : r.histogram)
    fmt::print("  {:6.2f} - {:6.2f}  {:8}  {:8.4f} {:7.4f}   {:9.4f}  {:7.3f}\n", bin.low * degrees,
               bin.high * degrees, bin.count, bin.fraction, bin.fraction_error,
               bin.isotropic_fraction, bin.density());
}

void run(const Options &options)
{
  const FrameChoice choice = parse_frame_choice(options.input.frame);
  std::optional<CsvFile> csv, summary_csv;  // opened only once there is something to write
  for_each_frame(options.input.dump, choice, [&](const DumpFrame &frame) {
    const std::vector<Vec3> axes = axes_of(rods_of(frame));
    if (axes.empty() && choice.kind == FrameChoice::Kind::all) return;
    if (axes.empty())
      throw InputError(
          fmt::format("{}: step {} holds no rods longer than a sphere, wanted at "
                      "least one",
                      frame.path, frame.step));
    const Result result = measure(frame, axes, options);
    if (!csv) {
      csv.emplace(options.csv, bin_columns);
      summary_csv.emplace(options.summary_csv, summary_columns);
    }
    print_table(result);
    for (std::size_t i = 0; i < result.histogram.size(); ++i) csv->row(bin_row(result, i));
    summary_csv->row(summary_row(result));
  });
  if (!csv)
    throw InputError(
        fmt::format("{}: no step holds any rods longer than a sphere, wanted at least "
                    "one",
                    options.input.dump));
  csv->close();
  summary_csv->close();
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Distribution of the rods' elevation above the horizontal, and their order.",
               "rod_orientation");
  app.footer("Example: rod_orientation bed.dump --bins 18 --csv elevation.csv");
  add_input_options(app, options.input);
  app.add_option("--bins", options.bins, "number of bins from 0 to 90 degrees")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--spacing", options.spacing,
                 "bins of equal 'solid-angle' (an isotropic set fills all alike) or equal 'angle'")
      ->check(CLI::IsMember({"solid-angle", "angle"}))
      ->capture_default_str();
  app.add_option("--csv", options.csv, "write the bins to this CSV file");
  app.add_option("--summary-csv", options.summary_csv, "write the means to this CSV file");
  return run_tool(app, argc, argv, [&] { run(options); });
}
