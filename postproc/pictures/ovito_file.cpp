// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/ovito_file.h"

#include <iterator>

#include <fmt/format.h>

#include "core/numbers.h"
#include "core/rotation.h"
#include "io/input_error.h"
#include "pictures/rod_data.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {

OvitoFile::OvitoFile(const std::string &path) : output_(path), file_(output_.working_path())
{
  if (!file_) throw InputError(fmt::format("{}: cannot be opened for writing", path));
}

void OvitoFile::add(const DumpFrame &frame, const std::vector<Rod> &rods, double time)
{
  if (frame.box_is_tilted)
    throw InputError(fmt::format("{}: step {}: the box is tilted, wanted an orthogonal one for "
                                 "OVITO's cell",
                                 frame.path, frame.step));
  const auto &box = frame.box;
  const auto periodic = [&](int i) { return frame.periodic[i] ? 'T' : 'F'; };
  std::string properties =
      "id:I:1:atom_types:I:1:pos:R:3:orientation:R:4:aspherical_shape:R:3:elevation_deg:R:1";
  const auto vx = frame.find_column("vx"), vy = frame.find_column("vy"),
             vz = frame.find_column("vz");
  const bool has_velocity = vx && vy && vz;
  if (has_velocity) properties += ":velo:R:3";
  std::vector<std::string> said{"x",  "y",  "z",  "xu",  "yu",  "zu",
                                "xs", "ys", "zs", "xsu", "ysu", "zsu"};
  if (has_velocity) said.insert(said.end(), {"vx", "vy", "vz"});
  const std::vector<std::size_t> others = other_columns(frame, said);
  for (const std::size_t column : others)
    properties += fmt::format(":{}:R:1", frame.columns[column]);

  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "{}\nLattice=\"{:.10g} 0 0 0 {:.10g} 0 0 0 {:.10g}\" "
                 "Origin=\"{:.10g} {:.10g} {:.10g}\" pbc=\"{} {} {}\" Time={:.10g} "
                 "Timestep={} Properties={}\n",
                 rods.size(), box[0][1] - box[0][0], box[1][1] - box[1][0], box[2][1] - box[2][0],
                 box[0][0], box[1][0], box[2][0], periodic(0), periodic(1), periodic(2), time,
                 frame.step, properties);
  for (std::size_t row = 0; row < rods.size(); row++) {
    const Rod &rod = rods[row];
    const Segment &segment = rod.capsule.segment;
    // A rod has no head: its axis is read upwards.
    const Quaternion q = orientation_of((segment.axis.z < 0.0 ? -1.0 : 1.0) * segment.axis);
    fmt::format_to(out,
                   "{} {} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g} "
                   "{:.6g}",
                   rod.id, rod.type, segment.centre.x, segment.centre.y, segment.centre.z, q.x, q.y,
                   q.z, q.w, rod.capsule.radius, rod.capsule.radius, 2.0 * segment.half_length,
                   elevation(segment.axis) * degrees);
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
