// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/rod_dump.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/rotation.h"
#include "io/frame_columns.h"
#include "io/input_error.h"

namespace spherocylinder {
namespace {

constexpr int kAllDigits = 17;  // of a double

int digits_of(const DumpFrame &frame, std::initializer_list<const char *> names)
{
  int digits = kLeastDigits;
  for (const char *name : names)
    if (const auto column = frame.find_column(name))
      digits = std::max(digits, digits_of_column(frame, *column));
  return digits;
}

void put(fmt::memory_buffer &text, const Vec3 &a, int digits)
{
  fmt::format_to(std::back_inserter(text), " {:.{}g} {:.{}g} {:.{}g}", a.x, digits, a.y, digits,
                 a.z, digits);
}

}  // namespace

RodDump::RodDump(const std::string &path) : output_(path), file_(output_.working_path())
{
  if (!file_) throw InputError(fmt::format("{}: cannot be opened for writing", path));
}

void RodDump::add(const DumpFrame &frame, const std::vector<GluedRod> &rods)
{
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "ITEM: TIMESTEP\n{}\n", frame.step);
  if (frame.time) fmt::format_to(out, "ITEM: TIME\n{}\n", *frame.time);
  fmt::format_to(out, "ITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS", rods.size());
  for (const bool periodic : frame.periodic) fmt::format_to(out, " {}", periodic ? "pp" : "ff");
  for (const auto &bounds : frame.box) fmt::format_to(out, "\n{} {}", bounds[0], bounds[1]);
  fmt::format_to(out, "\nITEM: ATOMS id type");
  const PlaceColumns places(frame);
  int place_digits = kLeastDigits;
  for (int d = 0; d < 3; d++) {
    const std::string &name = frame.columns[places.column(d)];
    fmt::format_to(out, " {}{}", "xyz"[d], name.back() == 'u' ? "u" : "");
    place_digits = std::max(place_digits, digits_of_column(frame, places.column(d)));
  }
  const bool moves = frame.find_column("vx") || frame.find_column("omegax");
  const int motion_digits = digits_of(frame, {"vx", "vy", "vz", "omegax", "omegay", "omegaz"});
  const bool weighs = frame.find_column("density").has_value();
  fmt::format_to(out,
                 " shapex shapey shapez quat1 quat2 quat3 quat4{}{} spheres deviation spacing\n",
                 moves ? " vx vy vz omegax omegay omegaz" : "", weighs ? " density" : "");
  for (const GluedRod &g : rods) {
    const Segment &s = g.rod.capsule.segment;
    const double r = g.rod.capsule.radius;
    const Quaternion q = orientation_of(s.axis);
    fmt::format_to(out, "{} {}", g.rod.id, g.rod.type);
    put(text, s.centre, place_digits);
    put(text, {r, r, r + s.half_length}, place_digits);
    fmt::format_to(out, " {:.{}g}", q.w, place_digits);
    put(text, {q.x, q.y, q.z}, place_digits);
    if (moves) {
      put(text, g.velocity, motion_digits);
      put(text, g.omega, motion_digits);
    }
    if (weighs) fmt::format_to(out, " {}", g.density);
    fmt::format_to(out, " {} {:.4g} {:.6g}\n", g.spheres, g.deviation, g.largest_spacing);
  }
  file_.write(text.data(), static_cast<std::streamsize>(text.size()));
}

std::string rod_data_file(const DumpFrame &frame, const std::vector<GluedRod> &rods,
                          std::optional<double> density)
{
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  int types = 1;
  for (const GluedRod &g : rods) types = std::max(types, g.rod.type);
  fmt::format_to(out, "Rods of {}, step {}\n\n{} atoms\n{} atom types\n\n", frame.path, frame.step,
                 rods.size(), types);
  for (int d = 0; d < 3; d++)
    fmt::format_to(out, "{0} {1} {2}lo {2}hi\n", frame.box[d][0], frame.box[d][1], "xyz"[d]);
  fmt::format_to(out, "\nAtoms\n\n");
  for (const GluedRod &g : rods) {
    const Capsule &c = g.rod.capsule;
    const double rho = density.value_or(g.density);
    if (!(rho > 0.0))
      throw InputError(fmt::format("{}: step {}: rod {} has no density, wanted --density or a "
                                   "column 'density' of numbers > 0",
                                   frame.path, frame.step, g.rod.id));
    fmt::format_to(out, "{} {} {} {} {}", g.rod.id, g.rod.type, 2.0 * c.radius, c.length(), rho);
    put(text, c.segment.centre, kAllDigits);
    put(text, c.segment.axis, kAllDigits);
    text.push_back('\n');
  }
  fmt::format_to(out, "\nVelocities\n\n");
  for (const GluedRod &g : rods) {
    fmt::format_to(out, "{}", g.rod.id);
    put(text, g.velocity, kAllDigits);
    put(text, g.omega, kAllDigits);
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

void RodDump::close()
{
  file_.close();
  if (!file_) throw InputError(fmt::format("{}: could not be written to its end", output_.path()));
  output_.finish();
}

}  // namespace spherocylinder
