// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/beds.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "cli/frame_choice.h"
#include "io/input_error.h"
#include "measures/mean_with_error.h"

namespace spherocylinder {

void add_bed_options(CLI::App &app, BedFiles &options)
{
  app.add_option("DUMP", options.dumps,
                 "LIGGGHTS 'dump custom' text file; of several (beds of other seeds) the means and "
                 "their standard errors are given")
      ->required();
  app.add_option("--frame", options.frame, "frame to work on: first, last, all or a time step")
      ->capture_default_str();
  add_fibre_options(app, options.fibres);
}

namespace {

void need_different(const std::vector<std::string> &dumps)
{
  for (std::size_t i = 0; i < dumps.size(); i++)
    for (std::size_t j = 0; j < i; j++) {
      std::error_code unknown;  // said when they are opened
      if (dumps[i] == dumps[j] || std::filesystem::equivalent(dumps[i], dumps[j], unknown))
        throw InputError(fmt::format("{}: is given twice, wanted each bed once", dumps[i]));
    }
}

// Means are over beds of the same rods: their mean diameter and aspect ratio, to a thousandth.
struct KindOfRods {
  explicit KindOfRods(const std::vector<Rod> &rods)
      : diameter(mean_of(rods, [](const Rod &rod) { return 2.0 * rod.capsule.radius; }).mean),
        aspect_ratio(mean_of(rods, [](const Rod &rod) { return rod.capsule.aspect_ratio(); }).mean)
  {
  }

  bool is_like(const KindOfRods &other) const
  {
    constexpr double kRounding = 1e-3;
    return std::abs(diameter - other.diameter) <= kRounding * diameter &&
           std::abs(aspect_ratio - other.aspect_ratio) <= kRounding * aspect_ratio;
  }

  double diameter, aspect_ratio;
};

}  // namespace

void for_each_bed(const BedFiles &options, const std::function<void(const Bed &)> &work)
{
  const FrameChoice choice = parse_frame_choice(options.frame);
  const bool all = choice.kind == FrameChoice::Kind::All;
  if (all && options.several())
    throw InputError(fmt::format("--frame: must be first, last or a step for {} files (got 'all')",
                                 options.dumps.size()));
  need_different(options.dumps);
  std::optional<KindOfRods> first;
  for (std::size_t file = 0; file < options.dumps.size(); file++) {
    bool any = false;
    for_each_frame(options.dumps[file], choice, [&](const DumpFrame &frame) {
      Bed bed{frame, rods_of(frame), file, {}, {}};
      if (bed.rods.empty() && all) return;
      if (bed.rods.empty())
        throw InputError(
            fmt::format("{}: step {} holds no rods, wanted at least one", frame.path, frame.step));
      any = true;
      bed.fibres = fibres_of(frame, bed.rods, options.fibres);
      if (bed.fibres.are_there()) bed.stretched = fibre_bodies(bed.rods, bed.fibres, Rings::Kept);
      if (options.several()) {
        const KindOfRods kind(bed.bodies());
        if (!first) first = kind;
        if (!kind.is_like(*first))
          throw InputError(fmt::format(
              "{}: its rods are {:.4g} m thick, aspect ratio {:.4g}, those of {} {:.4g} m, {:.4g}: "
              "wanted beds of the same rods",
              frame.path, kind.diameter, kind.aspect_ratio, options.dumps[0], first->diameter,
              first->aspect_ratio));
      }
      work(bed);
    });
    if (!any)
      throw InputError(
          fmt::format("{}: no step holds any rods, wanted at least one", options.dumps[file]));
  }
}

std::optional<Vessel> VesselOptions::vessel() const
{
  if (centre && !radius) throw InputError("--centre: wanted with --vessel-radius only");
  if (!radius && !floor) return std::nullopt;
  const std::vector<double> at = centre.value_or(std::vector<double>{0.0, 0.0});
  return Vessel{at[0], at[1], radius.value_or(std::numeric_limits<double>::infinity()),
                floor.value_or(0.0)};
}

std::optional<Vessel> VesselOptions::walled_vessel() const
{
  if (floor && !radius) throw InputError("--floor: wanted with --vessel-radius only");
  return vessel();
}

void add_vessel_options(CLI::App &app, VesselOptions &options)
{
  app.add_option("--vessel-radius", options.radius, "radius of the vessel (m)")
      ->check(positive_number());
  app.add_option("--centre,--center", options.centre, "X Y of the vessel's axis (m), default 0 0")
      ->expected(2)
      ->check(finite_number());
  app.add_option("--floor", options.floor,
                 "height Z of the floor (m), default 0 with --vessel-radius, else there is none")
      ->check(finite_number());
}

UprightBox box_of(const std::vector<double> &bounds, const std::string &option)
{
  for (const std::size_t k : {0, 2, 4})
    if (!(bounds[k] < bounds[k + 1]))
      throw InputError(fmt::format("{}: the upper bound in {} must be above the lower (got {} {})",
                                   option, "xyz"[k / 2], bounds[k], bounds[k + 1]));
  return {bounds[0], bounds[1], bounds[2], bounds[3], bounds[4], bounds[5]};
}

BedHeight height_of(const Bed &bed)
{
  BedHeight height = bed_height(bed.rods);
  if (bed.fibres.are_there()) height.highest_centre = bed_height(bed.bodies()).highest_centre;
  return height;
}

std::string fibre_count_line(const FibreShapes &shapes)
{
  std::string line =
      fmt::format("{:<22} {:8}       of {} segments", "fibres", shapes.fibres, shapes.segments);
  if (shapes.rings > 0)
    line += fmt::format(", {} of them {}", shapes.rings, shapes.rings == 1 ? "a ring" : "rings");
  if (shapes.parts > 0)
    line += fmt::format(", {} of them parts of fibres that are cut", shapes.parts);
  return line;
}

std::vector<std::uint32_t> bodies_of_rods(const Fibres &fibres)
{
  std::vector<std::uint32_t> bodies = fibres.of_rod;
  auto next = static_cast<std::uint32_t>(fibres.all.size());
  for (std::uint32_t &body : bodies)
    if (body == kNoFibre) body = next++;
  return bodies;
}

bool has_axis(const Bed &bed, std::uint32_t body)
{
  if (bed.stretched[body].is_sphere()) return false;
  return body >= bed.fibres.all.size() || norm(end_to_end(bed.fibres.all[body], bed.rods)) > 0.0;
}

std::vector<Rod> bodies_with_axis(const Bed &bed)
{
  std::vector<Rod> found;
  for (const Rod &body :
       bed.fibres.are_there() ? fibre_bodies(bed.rods, bed.fibres, Rings::LeftOut) : bed.rods)
    if (!body.is_sphere()) found.push_back(body);
  return found;
}

void need_rods_inside(const Bed &bed, const UprightBox &box)
{
  const auto is_outside = [&](const Rod &rod) {
    const Vec3 &c = rod.capsule.segment.centre;
    return c.x < box.x_low || c.x > box.x_high || c.y < box.y_low || c.y > box.y_high ||
           c.z < box.z_low || c.z > box.z_high;
  };
  const auto outside = std::count_if(bed.rods.begin(), bed.rods.end(), is_outside);
  if (outside > 0)
    throw InputError(fmt::format(
        "{}: step {}: {} of {} rod centres are outside the box {} {} {} {} {} {}, wanted none",
        bed.frame.path, bed.frame.step, outside, bed.rods.size(), box.x_low, box.x_high, box.y_low,
        box.y_high, box.z_low, box.z_high));
}

void need_height(const Bed &bed, const UprightCylinder &whole)
{
  if (!(whole.z_high > whole.z_low))
    throw InputError(
        fmt::format("{}: step {}: the highest rod centre is at {}, wanted above the floor, {}",
                    bed.frame.path, bed.frame.step, whole.z_high, whole.z_low));
}

void need_rods_inside(const Bed &bed, const Vessel &vessel)
{
  const std::size_t outside = count_outside(bed.rods, vessel);
  if (outside == 0) return;
  const std::string walls =
      std::isfinite(vessel.radius)
          ? fmt::format("outside the vessel of radius {} about ({}, {}) above floor {}",
                        vessel.radius, vessel.x, vessel.y, vessel.floor)
          : fmt::format("below the floor {}", vessel.floor);
  throw InputError(fmt::format("{}: step {}: {} of {} rod centres are {}, wanted none",
                               bed.frame.path, bed.frame.step, outside, bed.rods.size(), walls));
}

}  // namespace spherocylinder
