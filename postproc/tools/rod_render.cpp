// SPDX-License-Identifier: GPL-2.0-or-later
// rod_render: pictures of a bed of rods, and films. docs/rod_render.md
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <vtkColor.h>
#include <vtkNamedColors.h>
#include <vtkNew.h>

#include "cli/command_line.h"
#include "cli/frame_choice.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "io/text.h"
#include "measures/fibre_measures.h"
#include "pictures/bed_picture.h"
#include "pictures/display.h"
#include "pictures/film.h"
#include "pictures/font.h"
#include "pictures/shown_part.h"

using namespace spherocylinder;

namespace {

struct Options {
  InputOptions input;
  FibreOptions fibres;
  bool segments = false;
  std::string out;
  std::string size = "1200x900";
  PartOptions part;
  std::optional<double> timestep;
  std::string film;
  double rate = 10.0;
  std::string colour = "elevation";
  std::vector<double> range;
  bool auto_range = false;
  std::string view = "oblique";
  std::string background = "white";
  int resolution = 16;
  int font_size = 0;
  bool no_bar = false;
};

void set_size(PictureOptions &picture, const std::string &size)
{
  constexpr int kSmallest = 200, kLargest = 4000;  // pixels
  const auto cross = size.find('x');
  const auto width = to_number<int>(std::string_view(size).substr(0, cross));
  const auto height = cross == std::string::npos
                          ? std::nullopt
                          : to_number<int>(std::string_view(size).substr(cross + 1));
  for (const auto &pixels : {width, height})
    if (!pixels || *pixels < kSmallest || *pixels > kLargest)
      throw InputError(fmt::format("--size: must be WIDTHxHEIGHT, each from {} to {} (got {})",
                                   kSmallest, kLargest, shown(size)));
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
  for (int i = 0; i < 3; i++) picture.background[i] = colour[i] / 255.0;
}

CLI::Validator picture_name()
{
  const auto check = [](const std::string &path) {
    if (std::filesystem::path(path).extension() == ".png") return std::string();
    return fmt::format("must end in .png (got '{}')", path);
  };
  return CLI::Validator(check, "");
}

View view_of(const std::string &name)
{
  return name == "side" ? View::Side : name == "top" ? View::Top : View::Oblique;
}

// Of rods and whole fibres.
std::string caption_of(const DumpFrame &frame, const std::vector<Rod> &all, const Fibres &fibres,
                       std::size_t shown, const std::optional<double> &timestep)
{
  const std::vector<Rod> rods = fibres.are_there() ? fibre_bodies(all, fibres, Rings::Kept) : all;
  double low = rods.front().capsule.aspect_ratio(), high = low;
  for (const Rod &rod : rods) {
    low = std::min(low, rod.capsule.aspect_ratio());
    high = std::max(high, rod.capsule.aspect_ratio());
  }
  const bool several = high - low > 1e-4 * high;  // wider than the rounding of a dump
  std::string caption =
      several ? fmt::format("λ = {:.3g} to {:.3g}", low, high) : fmt::format("λ = {:.4g}", high);
  std::string kind = "rods";
  if (fibres.are_there()) {
    caption += fmt::format(",  {} {}", rods.size(),
                           fibres.all.size() == rods.size() ? "fibres" : "fibres and rods");
    kind = "segments";
  }
  caption += shown == all.size() ? fmt::format(",  {} {},  ", all.size(), kind)
                                 : fmt::format(",  {} of {} {},  ", shown, all.size(), kind);
  if (frame.time) return caption + fmt::format("t = {:.4g} s", *frame.time);
  if (timestep)
    return caption + fmt::format("t = {:.4g} s", static_cast<double>(frame.step) * *timestep);
  return caption + fmt::format("step {}", frame.step);
}

void check(const Options &options, bool several)
{
  const bool fixed_range = !options.range.empty() || options.colour == "elevation";
  if (several && (!fixed_range || options.auto_range))
    throw InputError(fmt::format(
        "--frame all: needs --range, so that colours by '{}' mean the same in all pictures",
        options.colour));
  if (!several && !options.film.empty())
    throw InputError(
        fmt::format("--film: needs --frame all (got --frame {})", options.input.frame));
  if (!options.range.empty() && !(options.range[0] < options.range[1]))
    throw InputError(fmt::format("--range: the upper end must be above the lower (got {} {})",
                                 options.range[0], options.range[1]));
}

// PREFIX_0001.png and so on for PREFIX.png.
std::string numbered(const std::string &path, std::size_t number)
{
  std::filesystem::path name(path);
  name.replace_filename(
      fmt::format("{}_{:04}{}", name.stem().string(), number, name.extension().string()));
  return name;
}

// Draws one frame. `part` has looked at it.
void draw(const DumpFrame &frame, const std::vector<Rod> &rods, const ShownPart &part,
          const std::string &path, const Options &options, PictureOptions picture, char **argv)
{
  const Fibres fibres = fibres_of(frame, rods, options.fibres);
  RodQuantity colour = rod_quantity(frame, rods, options.colour, fibres);
  if (!options.range.empty()) {
    colour.low = options.range[0];
    colour.high = options.range[1];
  }
  std::vector<Rod> shown;
  std::vector<double> values;
  const std::vector<std::size_t> kept = part.rods_shown(rods);
  for (const std::size_t i : kept) {
    shown.push_back(rods[i]);
    values.push_back(colour.values[i]);
  }
  colour.values = std::move(values);
  if (options.auto_range) set_range_of_most(colour);
  if (shown.empty() && !part.may_be_empty())
    throw InputError(fmt::format("{}: step {}: {} leaves none of its {} rods", frame.path,
                                 frame.step, part.left_out_by(), rods.size()));
  picture.caption = caption_of(frame, rods, fibres, shown.size(), options.timestep);
  part.set(picture, frame);
  {
    const OutputFile probe(path);  // can it be written?
  }
  need_display(argv);  // may start the program again: all is said, no file is open
  write_bed_picture(path, shown, options.segments ? Fibres{} : fibres_among(fibres, kept), colour,
                    picture);
}

// One picture of the frame chosen.
void draw_one(const Options &options, const FrameChoice &choice, const PictureOptions &picture,
              char **argv)
{
  ShownPart part(options.part, picture.view, false);
  for_each_frame(options.input.dump, choice, [&](const DumpFrame &frame) {
    const std::vector<Rod> rods = rods_of(frame);
    if (rods.empty())
      throw InputError(
          fmt::format("{}: step {} holds no rods, wanted at least one", frame.path, frame.step));
    part.look_at(frame, rods);
    draw(frame, rods, part, options.out, options, picture, argv);
  });
}

// A picture of each frame with rods: all are read beforehand, so that all show the same part.
void draw_all(const Options &options, const FrameChoice &choice, const PictureOptions &picture,
              char **argv)
{
  ShownPart part(options.part, picture.view, true);
  bool any = false;
  for_each_frame(options.input.dump, choice, [&](const DumpFrame &frame) {
    const std::vector<Rod> rods = rods_of(frame);
    any = any || !rods.empty();
    part.look_at(frame, rods);
  });
  if (!any)
    throw InputError(
        fmt::format("{}: no step holds any rods, wanted at least one", options.input.dump));
  if (!part.may_be_empty())
    throw InputError(
        fmt::format("{}: {} leaves no rods of any step", options.input.dump, part.left_out_by()));
  std::size_t pictures = 0;
  for_each_frame(options.input.dump, choice, [&](const DumpFrame &frame) {
    const std::vector<Rod> rods = rods_of(frame);
    if (rods.empty()) return;
    const std::string path = numbered(options.out, ++pictures);
    draw(frame, rods, part, path, options, picture, argv);
    fmt::print("{}\n", path);
  });
  if (!options.film.empty()) write_film(options.film, options.out, options.rate);
}

void run(const Options &options, char **argv)
{
  PictureOptions picture;
  set_size(picture, options.size);
  set_background(picture, options.background);
  picture.view = view_of(options.view);
  picture.resolution = options.resolution;
  picture.blend = options.colour != "id" && options.colour != "type";
  picture.font_size = options.font_size;
  picture.colour_bar = !options.no_bar;
  const FrameChoice choice = parse_frame_choice(options.input.frame);
  const bool several = choice.kind == FrameChoice::Kind::All;
  check(options, several);
  need_font();
  (several ? draw_all : draw_one)(options, choice, picture, argv);
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Pictures of a bed of rods, and films of them.", "rod_render");
  app.footer("Example: rod_render bed.dump --out bed.png --vessel-radius 0.305 --view side\n"
             "         rod_render pour.dump.gz --out speed.png --colour speed --range 0 0.1\n"
             "         rod_render bed.dump --out inside.png --vessel-radius 0.305 --cut\n"
             "         rod_render pour.dump --frame all --out pour.png --film pour.mp4\n"
             "         rod_render drum.dump --out drum.png --vessel-radius 0.2 --vessel-axis y\n"
             "         rod_render mill.dump --frame all --out mill.png --mesh drum.stl --body "
             "'blade_*.stl'");
  add_input_options(app, options.input);
  add_fibre_options(app, options.fibres);
  app.add_option("--out", options.out,
                 "PNG file to write; with --frame all NAME_0001.png and so on")
      ->required()
      ->check(picture_name());
  app.add_option("--size", options.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  app.add_option("--view", options.view, "side, top or oblique")
      ->check(CLI::IsMember({"side", "top", "oblique"}))
      ->capture_default_str();
  app.add_option(
         "--colour,--color", options.colour,
         "colour by elevation, speed, spin, id, contacts or any column of the dump; of fibres also fibre, place and curvature")
      ->capture_default_str();
  app.add_option("--range", options.range, "LOW HIGH ends of the colour map")
      ->expected(2)
      ->check(finite_number());
  app.add_flag("--auto-range", options.auto_range,
               "ends of the colour map that leave out the lowest and the highest tenth of the "
               "values shown")
      ->excludes("--range");
  add_vessel_options(app, options.part.vessel);
  app.get_option("--floor")->description(
      "height Z of the floor (m), default 0 with --vessel-radius, else there is none; without a "
      "vessel a plane is drawn below the rods");
  add_vessel_axis_option(app, options.part.vessel_axis);
  app.add_option("--vessel-height", options.part.vessel_height,
                 "height of the vessel (m), or its length along another axis; of an upright one "
                 "only the part with rods in it is drawn")
      ->check(positive_number());
  app.add_option("--box", options.part.box,
                 "XLO XHI YLO YHI ZLO ZHI: show this box (m) and the rods centred in it")
      ->expected(6)
      ->check(finite_number());
  app.add_option("--mesh", options.part.meshes,
                 "STL or VTK file of walls to draw (m), repeatable; a * in its name stands for the "
                 "step")
      ->allow_extra_args(false);
  app.add_option("--body", options.part.bodies,
                 "the same of what is seen from outside, such as a blade")
      ->allow_extra_args(false);
  app.add_option("--top", options.part.top,
                 "leave out rods that reach above this height Z (m); an upright vessel is shown up "
                 "to it")
      ->check(finite_number());
  app.add_flag("--cut", options.part.cut,
               "leave out the rods in front of the vessel's axis, or of the middle of what is "
               "shown");
  app.add_option("--film", options.film,
                 "with --frame all: also join the pictures to this .mp4 or .webm (needs ffmpeg)")
      ->check(film_name());
  app.add_option("--rate", options.rate, "pictures a second of the film")
      ->check(number_between(0.1, 120.0))
      ->capture_default_str();
  app.add_option("--timestep", options.timestep, "seconds a step, to show the time")
      ->check(positive_number());
  app.add_option("--background", options.background, "colour's name or #rrggbb")
      ->capture_default_str();
  app.add_option("--font-size", options.font_size,
                 "height of the letters in pixels, by default a 45th of the picture's height or "
                 "what fits")
      ->check(CLI::Range(6, 400));
  app.add_flag("--no-colour-bar,--no-color-bar", options.no_bar, "leave out the colour bar");
  app.add_flag("--segments", options.segments, "draw each segment of a fibre as a rod");
  app.add_option("--resolution", options.resolution, "corners around a rod")
      ->check(CLI::Range(8, 200))
      ->capture_default_str();
  return run_tool(app, argc, argv, [&] { run(options, argv); });
}
