// SPDX-License-Identifier: GPL-2.0-or-later
// multisphere_to_rods: rods glued or bonded of spheres as the dump of true ones.
// docs/multisphere_to_rods.md
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command_line.h"
#include "cli/frame_choice.h"
#include "io/csv_file.h"
#include "io/glued_rods.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "io/rod_dump.h"

using namespace spherocylinder;

namespace {

struct Options {
  InputOptions input{"", "all"};
  GluedRodOptions bodies;
  std::string out, csv, data;
  std::optional<double> density;
};

// How far the bodies of one or more frames are from straight rods of evenly placed spheres.
struct Straightness {
  std::size_t bodies = 0, least_spheres = SIZE_MAX, most_spheres = 0;
  double deviation = 0.0, least_spacing = INFINITY, largest_spacing = 0.0;  // radii
  double least_lambda = INFINITY, largest_lambda = 0.0;
  std::int64_t worst_body = 0, worst_step = 0;  // of the deviation

  void add(const GluedRod &g, std::int64_t step)
  {
    bodies++;
    least_spheres = std::min(least_spheres, g.spheres);
    most_spheres = std::max(most_spheres, g.spheres);
    if (worst_body == 0 || g.deviation > deviation) {
      worst_body = g.rod.id;
      worst_step = step;
    }
    deviation = std::max(deviation, g.deviation);
    least_spacing = std::min(least_spacing, g.least_spacing);
    largest_spacing = std::max(largest_spacing, g.largest_spacing);
    least_lambda = std::min(least_lambda, g.rod.capsule.aspect_ratio());
    largest_lambda = std::max(largest_lambda, g.rod.capsule.aspect_ratio());
  }
};

std::string range(double low, double high)
{
  const std::string a = fmt::format("{:.4g}", low), b = fmt::format("{:.4g}", high);
  return a == b ? a : a + " to " + b;
}

void run(const Options &options)
{
  const FrameChoice choice = parse_frame_choice(options.input.frame);
  RodDump dump(options.out);
  CsvFile csv(options.csv,
              {"step", "bodies", "spheres_min", "spheres_max", "deviation_radii", "worst_body",
               "spacing_min_radii", "spacing_max_radii", "lambda_min", "lambda_max"});
  std::string data;
  Straightness whole;
  std::size_t frames = 0;
  for_each_frame(options.input.dump, choice, [&](const DumpFrame &frame) {
    frames++;
    const std::vector<GluedRod> rods = glued_rods(frame, options.bodies);
    dump.add(frame, rods);
    if (!options.data.empty()) data = rod_data_file(frame, rods, options.density);
    Straightness now;
    for (const GluedRod &rod : rods) {
      now.add(rod, frame.step);
      whole.add(rod, frame.step);
    }
    if (rods.empty()) return;
    csv.row({static_cast<double>(frame.step), static_cast<double>(now.bodies),
             static_cast<double>(now.least_spheres), static_cast<double>(now.most_spheres),
             now.deviation, static_cast<double>(now.worst_body), now.least_spacing,
             now.largest_spacing, now.least_lambda, now.largest_lambda});
  });
  if (whole.bodies == 0)
    throw InputError(
        fmt::format("{}: no step holds any spheres, wanted at least one", options.input.dump));
  if (!options.data.empty()) write_file(options.data, data);  // refused if it is one of the others
  dump.close();
  csv.close();
  fmt::print("{} frames, {} rods in them: {}\n", frames, whole.bodies, options.out);
  fmt::print("  spheres a rod          {}\n", range(static_cast<double>(whole.least_spheres),
                                                    static_cast<double>(whole.most_spheres)));
  fmt::print("  aspect ratio           {}\n", range(whole.least_lambda, whole.largest_lambda));
  fmt::print("  off a straight line    {:.3g} radii at most (body {}, step {})\n", whole.deviation,
             whole.worst_body, whole.worst_step);
  fmt::print("  spacing                {} radii\n",
             range(whole.least_spacing, whole.largest_spacing));
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Rods glued or bonded of spheres as the dump of the capsules they make up.",
               "multisphere_to_rods");
  app.footer("Example: multisphere_to_rods spheres.dump --out rods.dump\n"
             "         multisphere_to_rods fibres.dump --body f_fibre --tolerance 0.5 --frame last "
             "--out rods.dump --csv straightness.csv");
  add_input_options(app, options.input);
  app.add_option("--out", options.out, "dump to write")->required();
  app.add_option("--body", options.bodies.body, "COLUMN that tells a sphere's body")
      ->capture_default_str();
  app.add_option("--tolerance", options.bodies.tolerance,
                 "radii that a sphere may lie off the axis, and a gap between spheres may be wide")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  CLI::Option *data =
      app.add_option("--data", options.data,
                     "write the last of the frames to this file, for the plug-in's read_data");
  app.add_option("--density", options.density,
                 "of the rods in it (kg/m^3); else the dump's column `density`")
      ->needs(data)
      ->check(positive_number());
  app.add_option("--csv", options.csv,
                 "write how straight the rods are, a line a frame, to this file");
  return run_tool(app, argc, argv, [&] { run(options); });
}
