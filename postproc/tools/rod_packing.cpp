// SPDX-License-Identifier: GPL-2.0-or-later
// rod_packing: solid volume fractions of a bed of rods. docs/rod_packing.md
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/bed_packing.h"
#include "cli/beds.h"
#include "cli/command_line.h"
#include "cli/mesh_packing.h"
#include "cli/result_table.h"
#include "core/numbers.h"
#include "io/input_error.h"
#include "measures/orientation_statistics.h"
#include "measures/packing_theory.h"

using namespace spherocylinder;

namespace {

struct Options {
  BedFiles files;
  VesselOptions vessel;
  PackingOptions packing;
  std::string mesh, csv, profiles;
  std::optional<double> bin;
  std::vector<double> box, region;
};

void print_region(const char *name, const RegionPacking &region, double whole_volume)
{
  if (std::isnan(region.fraction)) return;
  fmt::print("  {:<22} {:8.4f}  {:8.4f}   -+ {:.1e}, ", name, region.fraction, region.net_fraction,
             region.error);
  if (!std::isnan(region.radius)) fmt::print("radius {:.4g} m, ", region.radius);
  fmt::print("z {:.4g} to {:.4g} m, ", region.bottom, region.top);
  if (std::isnan(whole_volume))
    fmt::print("{:.4g} m^3\n", region.volume);
  else
    fmt::print("{:.3g} of the volume\n", region.volume / whole_volume);
}

// NaN: that there is no such value, and for what text why.
void print_theory_row(const char *name, double value, const std::string &text)
{
  const std::string number = std::isnan(value) ? "none" : fmt::format("{:.4f}", value);
  fmt::print("  {:<22} {:>8}             {}\n", name, number, text);
}

void print_theory(const BedPacking &p)
{
  const double lambda = p.lambda.mean;
  const double slender = parkhouse_kelly_fraction(lambda);
  print_theory_row("Parkhouse & Kelly", slender,
                   std::isnan(slender)
                       ? fmt::format("2 ln(lambda)/lambda is for slender rods, lambda >= {:.3g}",
                                     kParkhouseKellyFrom)
                       : "2 ln(lambda)/lambda");
  const double isotropic = random_contact_fraction(lambda, kIsotropicSinGamma);
  if (std::isnan(isotropic)) {
    print_theory_row(
        "random contacts", isotropic,
        fmt::format("the equation is for slender rods, lambda >= {:g}", kRandomContactsFrom));
    return;
  }
  print_theory_row("random contacts", isotropic, "isotropic");
  print_theory_row("", random_contact_fraction(lambda, kHorizontalSinGamma), "horizontal");
  if (std::isnan(p.mean_sin_gamma)) return;
  const double measured = random_contact_fraction(lambda, p.mean_sin_gamma);
  std::string text = fmt::format("as measured, <|sin gamma|> = {:.4f}", p.mean_sin_gamma);
  if (std::isnan(measured))
    text += fmt::format(": parallel, above the densest packing, {:.4f}", densest_fraction(lambda));
  print_theory_row("", measured, text);
}

void print_table(const BedPacking &p)
{
  fmt::print("step {}: {} rods, lambda {:.4g}", p.step, p.rods, p.lambda.mean);
  if (p.fibres) fmt::print(" of whole fibres");
  if (p.lambda.several())
    fmt::print(" (number mean; {:.4g} to {:.4g}; theory below is for the mean)", p.lambda.smallest,
               p.lambda.largest);
  if (p.spheres > 0) fmt::print(", {} of them spheres", p.spheres);
  fmt::print("\n");
  if (p.fibres) fmt::print("  {}\n", fibre_count_line(*p.fibres));
  if (!std::isnan(p.mean_elevation_deg))
    fmt::print("  mean elevation         {:8.2f} deg   (isotropic {:.2f})\n", p.mean_elevation_deg,
               kIsotropicMeanElevation * degrees);
  fmt::print("  highest rod centre     {:8.4g} m     (highest point {:.4g} m)\n",
             p.height.highest_centre, p.height.highest_point);
  fmt::print("  overlap                {:8.2e} m^3   -+ {:.1e}, of {} pairs: {:.2e} of the solid\n",
             p.overlap_volume, p.overlap_error, p.overlaps, p.overlap_volume / p.rods_volume);
  fmt::print("  overlap counts        {:>9}  {:>8}\n", "twice", "once");
  print_region("V_f region", p.region, std::nan(""));
  if (std::isnan(p.whole.fraction)) {
    if (p.has_rods()) print_theory(p);
    return;
  }
  fmt::print("  {:<22} {:8.4f}  {:8.4f}   all rods over {:.4g} m^3, z {:.4g} to {:.4g} m\n",
             "V_f whole", p.whole.fraction, p.whole.net_fraction, p.whole.volume, p.whole.bottom,
             p.whole.top);
  print_region("V_f whole, clipped", p.clipped, p.whole.volume);
  if (!p.vessel_is_convex) {
    fmt::print("  {:<22} {:>8}             the vessel is not convex, --region takes a part of it\n",
               "V_f inner and bulk", "none");
    if (p.has_rods()) print_theory(p);
    return;
  }
  print_region("V_f inner", p.inner, p.whole.volume);
  print_region("V_f bulk", p.bulk, p.whole.volume);
  if (std::isnan(p.bulk.fraction))
    fmt::print("  {:<22} {:>8}             nothing is {:.4g} m from wall, floor and top\n",
               "V_f bulk", "none", p.bulk_margin);
  if (p.has_rods()) print_theory(p);
}

void run(Options &options)
{
  const bool several = options.files.several();
  PackingOptions &packing = options.packing;
  if (options.vessel.radius || options.vessel.centre) packing.vessel = options.vessel.vessel();
  packing.floor = options.vessel.floor.value_or(0.0);
  if (!options.box.empty()) {
    if (packing.vessel || options.vessel.floor)
      throw InputError("--box: holds the bed, wanted without --vessel-radius, --centre, --floor");
    packing.box = box_of(options.box, "--box");
  }
  if (!options.mesh.empty()) {
    if (packing.vessel || packing.box || options.vessel.floor)
      throw InputError(
          "--vessel: holds the bed, wanted without --vessel-radius, --centre, --floor, --box");
    packing.mesh = std::make_shared<MeshVessel>(read_vessel(options.mesh));
  }
  if (!options.region.empty()) packing.region = box_of(options.region, "--region");
  if (options.bin && options.profiles.empty())
    throw InputError("--bin: wanted with --profiles only");

  std::optional<ResultTable<BedPacking>> table;  // once it is known whether there are fibres
  const auto profile_table = [&](const char *name) {
    const std::string &prefix = options.profiles;
    return ResultTable<ProfileRow>(prefix.empty() ? "" : prefix + name, profile_fields(), several);
  };
  ResultTable<ProfileRow> height = profile_table("_height.csv");
  std::optional<ResultTable<ProfileRow>> radius, wall;
  for_each_bed(options.files, [&](const Bed &bed) {
    const BedPacking result = measure_packing(bed, packing);
    PackingProfiles profiles;
    if (!options.profiles.empty()) {
      if (!packing.holds_bed(bed.frame))
        throw InputError("--profiles: wanted with --vessel-radius, --vessel or --box");
      if (!options.bin) options.bin = 2.0 * bed.rods[0].capsule.radius;
      profiles = measure_profiles(bed, packing, *options.bin);
    }
    if (several) fmt::print("{}: ", bed.frame.path);
    print_table(result);
    if (!table) table.emplace(options.csv, packing_fields(result.fibres.has_value()), several);
    table->add(result);
    if (options.profiles.empty()) return;
    height.add_all(profile_rows(bed, profiles.height));
    if (!packing.vessel) return;
    if (!radius) radius.emplace(profile_table("_radius.csv"));
    if (!wall) wall.emplace(profile_table("_wall.csv"));
    radius->add_all(profile_rows(bed, profiles.radius));
    wall->add_all(profile_rows(bed, profiles.wall));
  });
  if (several) {
    fmt::print("mean and standard error over {} files\n", options.files.dumps.size());
    table->print_means();
  }
  table->finish();
  height.finish();
  if (radius) radius->finish();
  if (wall) wall->finish();
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  PackingOptions &packing = options.packing;
  CLI::App app(
      "Solid volume fractions of a bed of rods: in an upright cylindrical vessel, in one of any "
      "shape, in a box with walls, in the dump's box if that is periodic in x and y, or in any region of a heap or "
      "drum.",
      "rod_packing");
  app.footer(
      "Example: rod_packing bed.dump --vessel-radius 0.305 --csv packing.csv\n"
      "         rod_packing bed.dump --vessel-radius 0.305 --profiles bed --bin 0.005\n"
      "         rod_packing seed1.dump.gz seed2.dump.gz --vessel-radius 0.305 --csv mean.csv\n"
      "         rod_packing periodic.dump --floor 0\n"
      "         rod_packing bed.dump --vessel hopper.stl\n"
      "         rod_packing heap.dump --region -0.02 0.02 -0.02 0.02 0 0.03");
  add_bed_options(app, options.files);
  add_vessel_options(app, options.vessel);
  app.add_option("--vessel", options.mesh,
                 "STL file: its closed surface, facing outwards, holds the bed (m)");
  app.add_option("--box", options.box,
                 "XLO XHI YLO YHI ZLO ZHI: a box with walls holds the bed (m)")
      ->expected(6)
      ->check(finite_number());
  app.add_option("--region", options.region,
                 "XLO XHI YLO YHI ZLO ZHI: give V_f in this region too (m), whatever holds the bed")
      ->expected(6)
      ->check(finite_number());
  app.add_option("--inner-radius", packing.inner.radius,
                 "radius of the inner cylinder (m), default 2^(-1/3) of the vessel's")
      ->check(positive_number());
  app.add_option("--inner-bottom", packing.inner.bottom,
                 "lower end of the inner cylinder (m), default centred at mid-height")
      ->check(finite_number());
  app.add_option("--inner-top", packing.inner.top,
                 "upper end of the inner cylinder (m), default centred at mid-height")
      ->check(finite_number());
  app.add_option("--bulk-margin", packing.bulk_margin,
                 "distance of the bulk from wall, floor and highest centre (m), default half the "
                 "mean length of the rods")
      ->check(positive_number());
  app.add_option("--tolerance", packing.tolerance, "relative error allowed for clipped volumes")
      ->check(number_between(1e-9, 0.1))
      ->capture_default_str();
  app.add_option("--csv", options.csv, "write the numbers to this CSV file");
  app.add_option("--profiles", options.profiles,
                 "write V_f by height, radius and distance from the walls to PREFIX_height.csv, "
                 "PREFIX_radius.csv and PREFIX_wall.csv");
  app.add_option("--bin", options.bin,
                 "width of the profiles' bins (m), default the diameter of the first rod")
      ->check(positive_number());
  return run_tool(app, argc, argv, [&] { run(options); });
}
