// SPDX-License-Identifier: GPL-2.0-or-later
// rod_orientation: how the rods of a bed are inclined. docs/rod_orientation.md
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/bed_orientation.h"
#include "cli/beds.h"
#include "core/numbers.h"
#include "io/input_error.h"
#include "io/text.h"
#include "measures/contact_statistics.h"

using namespace spherocylinder;

namespace {

const std::map<std::string, BinSpacing> kSpacings{{"solid-angle", BinSpacing::EqualSolidAngle},
                                                  {"angle", BinSpacing::EqualAngle}};
const std::map<std::string, AxisOf> kAxes{{"segment", AxisOf::Segment}, {"fibre", AxisOf::Fibre}};
const std::map<std::string, NearWall> kWalls{{"nearest", NearWall::Nearest},
                                             {"side", NearWall::Side},
                                             {"floor", NearWall::Floor}};

struct Options {
  BedFiles beds;
  VesselOptions vessel;
  OrientationOptions measured;
  std::string spacing = "solid-angle";
  std::optional<std::string> wall;  // nearest
  std::string by = "segment";
  std::string csv, summary_csv, wall_csv, wall_bins_csv, fibre_csv;
};

// A line of the table: measured, its error, what isotropic axes give, a note.
void print_line(const std::string &name, const MeanWithError &value, double isotropic, int decimals,
                const std::string &note = "")
{
  fmt::print("  {:<22} {} {}   {}{}\n", name, cell(value.mean, 8, decimals),
             cell(value.error, 7, decimals), cell(isotropic, 9, decimals),
             note.empty() ? "" : "   " + note);
}

void print_order(const BedOrientation &b)
{
  const Order &o = b.order;
  const double of_chance = 1.0 / std::sqrt(static_cast<double>(o.rods));
  fmt::print("                         measured   error   isotropic\n");
  print_line("mean elevation (deg)", {o.elevation.mean * degrees, o.elevation.error * degrees},
             kIsotropicMeanElevation * degrees, 2);
  print_line("<|u_z|>", o.abs_uz, kIsotropicMeanAbsUz, 4);
  print_line("<u_z^2>", o.uz_squared, kIsotropicMeanUzSquared, 4);
  const Vec3 &d = o.nematic.director;
  print_line("nematic order", {o.nematic.order, o.nematic.error}, of_chance, 4,
             fmt::format("(1/sqrt(n)), director ({:.3f}, {:.3f}, {:.3f})", d.x, d.y, d.z));
  print_line("  squared, unbiased", {o.squared_order, none}, 0.0, 4,
             fmt::format("-+ {}", cell(isotropic_scatter_of_squared_order(o.rods), 0, 4)));
  print_line("azimuthal order", {o.azimuthal.order, o.azimuthal.error}, of_chance, 4,
             fmt::format("(1/sqrt(n)), heading {} deg", cell(o.azimuthal.azimuth * degrees, 0, 1)));
  if (!std::isnan(o.radial.mean))
    print_line("radial order", o.radial, 0.0, 4, "(-1 around the axis, 1 towards it)");
  print_line("<|sin gamma|>", o.sin_gamma, kIsotropicSinGamma, 4,
             fmt::format("{} of {} axes", o.rods > kMostAxesPaired ? "pairs" : "all pairs",
                         std::min(o.rods, kMostAxesPaired)));
  if (b.near_pairs > 0)
    print_line("  of near pairs", b.near_sin_gamma, kIsotropicContactSinGamma, 4,
               fmt::format("{} pairs", b.near_pairs));
}

void print_fibres(const FibreShapes &s)
{
  const auto measured = [](const char *name, const MeanWithError &value, const std::string &unit) {
    fmt::print("  {:<22} {:8.4g} {:>7}   {}\n", name, value.mean,
               std::isnan(value.error) ? "-" : fmt::format("{:.2g}", value.error), unit);
  };
  fmt::print("  {}\n", fibre_count_line(s));
  if (s.fibres == 0) return;
  measured("contour length", s.contour, "m");
  if (!std::isnan(s.stretch.mean)) measured("end to end / contour", s.stretch, "");
  if (std::isnan(s.curvature.mean)) return;
  measured("mean curvature", s.curvature, "1/m");
  measured("persistence length", {s.persistence, none}, "m");
}

void print_table(const BedOrientation &b, const Options &options)
{
  const double half_contacts = options.measured.half_contacts;
  fmt::print("step {}: {} {}\n", b.step, b.order.rods,
             options.measured.by == AxisOf::Fibre ? "fibres from end to end" : "rods");
  if (b.fibres) print_fibres(*b.fibres);
  print_order(b);
  print_line("V_f by random contacts", b.order.random_contact, b.random_contact_isotropic, 4,
             std::isnan(b.random_contact_isotropic)
                 ? fmt::format("lambda {:.4g}: the equation is for slender rods, lambda >= {:g}",
                               b.lambda, kRandomContactsFrom)
                 : fmt::format("lambda {:.4g}, {:.4g} contacts counted on each rod", b.lambda,
                               half_contacts));
  if (b.measured)
    fmt::print(
        "    as measured          {:8.4f}           inner cylinder ({:.4f} whole vessel): {} "
        "contacts\n",
        b.measured->inner, b.measured->whole, cell(b.measured->half_contacts, 0, 3));
  fmt::print("  chi^2 of the bins      {:8.1f}           {:9}\n", b.chi_squared,
             b.histogram.size() - 1);
  fmt::print("  elevation (deg)     count  fraction   error   isotropic  density\n");
  for (const ElevationBin &bin : b.histogram)
    fmt::print("  {:6.2f} - {:6.2f}  {:8}  {:8.4f} {:7.4f}   {:9.4f}  {:7.3f}\n", bin.low * degrees,
               bin.high * degrees, bin.count, bin.part.mean, bin.part.error, bin.isotropic_fraction,
               bin.density().mean);
  if (b.by_wall.empty()) return;
  fmt::print(
      "  from {} wall (m)    rods  elevation   error  squared order  radial  <|sin gamma|>\n",
      options.wall.value_or("nearest"));
  for (const WallBin &bin : b.by_wall)
    fmt::print("  {:7.4g} - {:7.4g}  {:8}  {} {}  {} {}  {}\n", bin.low, bin.high, bin.order.rods,
               cell(bin.order.elevation.mean * degrees, 9, 2),
               cell(bin.order.elevation.error * degrees, 7, 2),
               cell(bin.order.squared_order, 13, 4), cell(bin.order.radial.mean, 7, 3),
               cell(bin.order.sin_gamma.mean, 13, 4));
}

void need_vessel_for_walls(const Options &options)
{
  const auto &vessel = options.measured.vessel;
  if (!vessel && (options.wall || options.measured.wall_width))
    throw InputError("--wall, --wall-width: wanted with --vessel-radius or --floor");
  if (!vessel && !(options.wall_csv.empty() && options.wall_bins_csv.empty()))
    throw InputError("--wall-csv, --wall-bins-csv: wanted with --vessel-radius or --floor");
  if (options.measured.wall == NearWall::Side && vessel && !std::isfinite(vessel->radius))
    throw InputError("--wall: 'side' is wanted with --vessel-radius only");
}

void run(Options &options)
{
  const bool several = options.beds.several();
  options.measured.vessel = options.vessel.vessel();
  options.measured.spacing = kSpacings.at(options.spacing);
  options.measured.wall = kWalls.at(options.wall.value_or("nearest"));
  options.measured.by = kAxes.at(options.by);
  need_vessel_for_walls(options);
  ResultTable<ElevationRow> bins(options.csv, elevation_fields(), several);
  std::optional<ResultTable<BedOrientation>> summary;  // once it is known whether there are fibres
  ResultTable<CorrelationRow> correlation(options.fibre_csv, correlation_fields(), several);
  ResultTable<WallRow> wall(options.wall_csv, wall_fields(), several);
  ResultTable<ElevationRow> wall_bins(options.wall_bins_csv, wall_elevation_fields(), several);
  for_each_bed(options.beds, [&](const Bed &bed) {
    const BedOrientation found = measure_orientation(bed, options.measured);
    bins.add_all(elevation_rows(found));
    if (!summary)
      summary.emplace(options.summary_csv, orientation_fields(found.fibres.has_value()), several);
    summary->add(found);
    if (!options.fibre_csv.empty()) {
      if (!found.fibres)
        throw InputError(fmt::format(
            "--fibre-csv: wanted of a dump with columns of fibre and place, which {} lacks",
            bed.frame.path));
      correlation.add_all(correlation_rows(found));
    }
    wall.add_all(wall_rows(found));
    wall_bins.add_all(wall_elevation_rows(found));
    if (several) fmt::print("{}: ", bed.frame.path);
    print_table(found, options);
  });
  if (several) {
    fmt::print("means of the files\n");
    summary->print_means();
  }
  bins.finish();
  summary->finish();
  correlation.finish();
  wall.finish();
  wall_bins.finish();
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Distribution of the rods' elevation above the horizontal, and their order.",
               "rod_orientation");
  app.footer(
      "Example: rod_orientation bed.dump --vessel-radius 0.305 --csv elevation.csv\n"
      "         rod_orientation bed.dump --vessel-radius 0.305 --wall side --wall-csv wall.csv\n"
      "         rod_orientation seed1.dump.gz seed2.dump.gz --summary-csv means.csv");
  add_bed_options(app, options.beds);
  add_vessel_options(app, options.vessel);
  app.add_option("--bins", options.measured.bins, "number of bins from 0 to 90 degrees")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--spacing", options.spacing,
                 "bins of equal 'solid-angle' (an isotropic set fills all alike) or equal 'angle'")
      ->check(CLI::IsMember(kSpacings))
      ->capture_default_str();
  app.add_option("--wall", options.wall, "wall that distances are taken from, default nearest")
      ->check(CLI::IsMember(kWalls));
  app.add_option("--wall-width", options.measured.wall_width,
                 "width of a bin of the distance (m), default a quarter of a rod")
      ->check(positive_number());
  app.add_option("--near", options.measured.near,
                 "gap of the surfaces below which rods are near, in diameters of the thickest rod")
      ->check(number_between(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--half-contacts", options.measured.half_contacts,
                 "contacts counted on each rod by the random contact equation")
      ->check(number_between(0.1, 100.0))
      ->capture_default_str();
  app.add_option("--by", options.by,
                 "axes of fibres: of each 'segment', or of the 'fibre' from end to end")
      ->check(CLI::IsMember(kAxes))
      ->capture_default_str();
  app.add_option("--fibre-csv", options.fibre_csv,
                 "write how segments' axes are correlated along fibres to this CSV file");
  app.add_option("--csv", options.csv, "write the bins to this CSV file");
  app.add_option("--summary-csv", options.summary_csv, "write the means to this CSV file");
  app.add_option("--wall-csv", options.wall_csv,
                 "write the means by distance from the wall to this CSV file");
  app.add_option("--wall-bins-csv", options.wall_bins_csv,
                 "write the bins by distance from the wall to this CSV file");
  return run_tool(app, argc, argv, [&] { run(options); });
}
