// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/ovito_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "analysis/input_error.h"
#include "analysis/numbers.h"

namespace spherocylinder {
namespace {

bool is_said_otherwise(const std::string &column)
{
  constexpr std::array said{"id",     "type",   "x",      "y",     "z",     "xu",    "yu",
                            "zu",     "xs",     "ys",     "zs",    "vx",    "vy",    "vz",
                            "shapex", "shapey", "shapez", "quat1", "quat2", "quat3", "quat4"};
  return std::find(said.begin(), said.end(), column) != said.end();
}

// Rotation by the shortest way from z to the axis, read upwards: (z x u, 1 + z.u), normalised.
std::array<double, 4> quaternion_to(Vec3 axis)
{
  if (axis.z < 0.0) axis = -1.0 * axis;
  const double norm = std::sqrt(2.0 * (1.0 + axis.z));
  return {-axis.y / norm, axis.x / norm, 0.0, (1.0 + axis.z) / norm};
}

}  // namespace

OvitoFile::OvitoFile(const std::string &path) : output_(path), file_(output_.working_path())
{
}

void OvitoFile::add(const DumpFrame &frame, const std::vector<Rod> &rods, double time)
{
  const auto &box = frame.box;
  std::string properties =
      "id:I:1:atom_types:I:1:pos:R:3:orientation:R:4:aspherical_shape:R:3:elevation_deg:R:1";
  const auto vx = frame.find_column("vx"), vy = frame.find_column("vy"),
             vz = frame.find_column("vz");
  const bool has_velocity = vx && vy && vz;
  if (has_velocity) properties += ":velo:R:3";
  std::vector<std::size_t> others;
  for (std::size_t column = 0; column < frame.columns.size(); ++column) {
    if (is_said_otherwise(frame.columns[column])) continue;
    others.push_back(column);
    properties += fmt::format(":{}:R:1", frame.columns[column]);
  }

  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "{}\nLattice=\"{:.10g} 0 0 0 {:.10g} 0 0 0 {:.10g}\" "
                 "Origin=\"{:.10g} {:.10g} {:.10g}\" pbc=\"F F F\" Time={:.10g} Timestep={} "
                 "Properties={}\n",
                 rods.size(), box[0][1] - box[0][0], box[1][1] - box[1][0], box[2][1] - box[2][0],
                 box[0][0], box[1][0], box[2][0], time, frame.step, properties);
  for (std::size_t row = 0; row < rods.size(); ++row) {
    const Rod &rod = rods[row];
    const Segment &segment = rod.capsule.segment;
    const auto q = quaternion_to(segment.axis);
    fmt::format_to(out,
                   "{} {} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} "
                   "{:.6g}",
                   rod.id, rod.type, segment.centre.x, segment.centre.y, segment.centre.z, q[0],
                   q[1], q[2], q[3], rod.capsule.radius, rod.capsule.radius,
                   2.0 * segment.half_length, elevation(segment.axis) * degrees);
    if (has_velocity)
      fmt::format_to(out, " {:.8g} {:.8g} {:.8g}", frame.value(row, *vx), frame.value(row, *vy),
                     frame.value(row, *vz));
    for (const std::size_t column : others)
      fmt::format_to(out, " {:.8g}", frame.value(row, column));
    text.push_back('\n');
  }
  file_.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void OvitoFile::close()
{
  file_.close();
  if (!file_) throw InputError(fmt::format("{}: could not be written to its end", output_.path()));
  output_.finish();
}

}  // namespace spherocylinder
