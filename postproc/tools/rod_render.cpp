// SPDX-License-Identifier: GPL-2.0-or-later
// rod_render: a picture of a bed of rods. docs/rod_render.md
#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <vtkColor.h>
#include <vtkNamedColors.h>
#include <vtkNew.h>

#include "analysis/command_line.h"
#include "analysis/frame_choice.h"
#include "analysis/input_error.h"
#include "analysis/packing_measures.h"
#include "analysis/text.h"
#include "pictures/bed_picture.h"
#include "pictures/display.h"

using namespace spherocylinder;

namespace {

struct Options {
  InputOptions input;
  std::string out;
  std::string size = "1200x900";
  std::vector<double> centre{0.0, 0.0};
  std::optional<double> vessel_radius, vessel_height, timestep;
  double floor = 0.0;
  std::string colour = "elevation";
  std::vector<double> range;
  std::string view = "oblique";
  std::string background = "white";
  int resolution = 16;
};

void set_size(PictureOptions &picture, const std::string &size)
{
  constexpr int smallest = 200, largest = 8000;  // pixels
  const auto cross = size.find('x');
  const auto width = to_number<int>(std::string_view(size).substr(0, cross));
  const auto height = cross == std::string::npos
                          ? std::nullopt
                          : to_number<int>(std::string_view(size).substr(cross + 1));
  for (const auto &pixels : {width, height})
    if (!pixels || *pixels < smallest || *pixels > largest)
      throw InputError(fmt::format("--size: must be WIDTHxHEIGHT, each from {} to {} (got {})",
                                   smallest, largest, shown(size)));
  picture.width = *width;
  picture.height = *height;
}

void set_background(PictureOptions &picture, const std::string &name)
{
  vtkNew<vtkNamedColors> names;
  const bool is_code = name.size() == 7 && name[0] == '#' &&
                       name.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!names->ColorExists(name) && !is_code)
    throw InputError(fmt::format(
        "--background: must be a colour's name such as white, or #rrggbb (got {})", shown(name)));
  const vtkColor4ub colour = names->HTMLColorToRGBA(name);
  for (int i = 0; i < 3; ++i) picture.background[i] = colour[i] / 255.0;
}

View view_of(const std::string &name)
{
  return name == "side" ? View::side : name == "top" ? View::top : View::oblique;
}

std::string caption_of(const DumpFrame &frame, const std::vector<Rod> &rods,
                       const std::optional<double> &timestep)
{
  double low = rods.front().capsule.aspect_ratio(), high = low;
  for (const Rod &rod : rods) {
    low = std::min(low, rod.capsule.aspect_ratio());
    high = std::max(high, rod.capsule.aspect_ratio());
  }
  const bool several = high - low > 1e-4 * high;  // wider than the rounding of a dump
  std::string caption = several ? fmt::format("lambda = {:.3g} to {:.3g}", low, high)
                                : fmt::format("lambda = {:.4g}", high);
  caption += fmt::format(",  {} rods,  ", rods.size());
  if (frame.time) return caption + fmt::format("t = {:.4g} s", *frame.time);
  if (timestep)
    return caption + fmt::format("t = {:.4g} s", static_cast<double>(frame.step) * *timestep);
  return caption + fmt::format("step {}", frame.step);
}

// Only the part of the vessel that holds rods, and a little more, is drawn.
UprightCylinder vessel_around(const std::vector<Rod> &rods, const Options &options)
{
  const double bed = bed_height(rods).highest_point - options.floor;
  double height = 1.1 * std::max(bed, 0.25 * *options.vessel_radius);
  if (options.vessel_height) height = std::min(height, *options.vessel_height);
  return {options.centre[0], options.centre[1], *options.vessel_radius, options.floor,
          options.floor + height};
}

void run(const Options &options, char **argv)
{
  PictureOptions picture;
  set_size(picture, options.size);
  set_background(picture, options.background);
  picture.view = view_of(options.view);
  picture.resolution = options.resolution;
  const FrameChoice choice = parse_frame_choice(options.input.frame);
  if (choice.kind == FrameChoice::Kind::all)
    throw InputError("--frame: must be first, last or a step for a single picture (got 'all')");

  for_each_frame(options.input.dump, choice, [&](const DumpFrame &frame) {
    const std::vector<Rod> rods = rods_of(frame);
    if (rods.empty())
      throw InputError(
          fmt::format("{}: step {} holds no rods, wanted at least one", frame.path, frame.step));
    RodQuantity colour = rod_quantity(frame, rods, options.colour);
    if (!options.range.empty()) {
      colour.low = options.range[0];
      colour.high = options.range[1];
      if (!(colour.low < colour.high))
        throw InputError(fmt::format("--range: the upper end must be above the lower (got {} {})",
                                     colour.low, colour.high));
    }
    picture.caption = caption_of(frame, rods, options.timestep);
    if (options.vessel_radius) picture.vessel = vessel_around(rods, options);
    if (!std::ofstream(options.out, std::ios::app))
      throw InputError(fmt::format("{}: cannot be opened for writing", options.out));
    need_display(argv);  // last: whatever is wrong with the input is said before
    write_bed_picture(options.out, rods, colour, picture);
  });
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Picture of a bed of rods.", "rod_render");
  app.footer("Example: rod_render bed.dump --out bed.png --vessel-radius 0.305 --view side");
  add_input_options(app, options.input);
  app.add_option("--out", options.out, "PNG file to write")->required();
  app.add_option("--size", options.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  app.add_option("--view", options.view, "side, top or oblique")
      ->check(CLI::IsMember({"side", "top", "oblique"}))
      ->capture_default_str();
  app.add_option("--colour,--color", options.colour,
                 "colour by elevation, speed, spin, id, contacts or any column of the dump")
      ->capture_default_str();
  app.add_option("--range", options.range, "LOW HIGH ends of the colour map")
      ->expected(2)
      ->check(finite_number());
  app.add_option("--vessel-radius", options.vessel_radius, "draw a vessel of this radius (m)")
      ->check(positive_number());
  app.add_option("--vessel-height", options.vessel_height,
                 "height of the vessel (m); only the part with rods in it is drawn")
      ->check(positive_number());
  app.add_option("--floor", options.floor, "height Z of the vessel's floor (m)")
      ->check(finite_number())
      ->capture_default_str();
  app.add_option("--centre,--center", options.centre, "X Y of the vessel's axis (m)")
      ->expected(2)
      ->check(finite_number())
      ->capture_default_str();
  app.add_option("--timestep", options.timestep, "seconds a step, to show the time")
      ->check(positive_number());
  app.add_option("--background", options.background, "colour's name or #rrggbb")
      ->capture_default_str();
  app.add_option("--resolution", options.resolution, "corners around a rod")
      ->check(CLI::Range(8, 200))
      ->capture_default_str();
  return run_tool(app, argc, argv, [&] { run(options, argv); });
}
