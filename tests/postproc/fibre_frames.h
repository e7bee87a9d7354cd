// SPDX-License-Identifier: GPL-2.0-or-later
// Fibres as frames and dumps for the tests of the post-processors.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/rotation.h"
#include "io/dump_frame.h"
#include "io/rods.h"

namespace spherocylinder {

// Rods with the fibre and place of each; no fibre: 0.
struct FibreBed {
  std::vector<Rod> rods;
  std::vector<std::int64_t> fibre, place;

  void add(const Capsule &capsule, std::int64_t of_fibre = 0, std::int64_t at_place = 0)
  {
    rods.push_back({static_cast<std::int64_t>(rods.size()) + 1, 1, capsule});
    fibre.push_back(of_fibre);
    place.push_back(at_place);
  }

  // Segments between the points, which are the centres of the ends.
  void add_chain(std::int64_t id, const std::vector<Vec3> &points, double radius)
  {
    for (std::size_t k = 1; k < points.size(); k++) {
      const Vec3 d = points[k] - points[k - 1];
      add({{0.5 * (points[k] + points[k - 1]), (1.0 / norm(d)) * d, 0.5 * norm(d)}, radius}, id,
          static_cast<std::int64_t>(k));
    }
  }

  // All digits; `columns` names those of fibre and place, empty leaves them out.
  std::string dump(const std::string &columns = "f_fibres[1] f_fibres[2]",
                   const std::string &box = "ff ff ff\n-1 1\n-1 1\n-1 11", int step = 7) const
  {
    std::string text = fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}\nITEM: ATOMS id x y z "
        "shapex shapez quat1 quat2 quat3 quat4 {}\n",
        step, rods.size(), box, columns);
    for (std::size_t k = 0; k < rods.size(); k++) {
      const auto &[s, r] = rods[k].capsule;
      const Quaternion q = orientation_of(s.axis);
      text += fmt::format(
          "{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", rods[k].id,
          s.centre.x, s.centre.y, s.centre.z, r, r + s.half_length, q.w, q.x, q.y, q.z);
      if (!columns.empty()) text += fmt::format(" {} {}", fibre[k], place[k]);
      text += "\n";
    }
    return text;
  }

  // The same as read from it. Rods are those of the bed.
  DumpFrame frame(const std::array<bool, 3> &periodic = {},
                  const std::array<std::array<double, 2>, 3> &box = {
                      {{-1, 1}, {-1, 1}, {-1, 1}}}) const
  {
    DumpFrame f;
    f.path = "fibres.dump";
    f.header_line = 9;
    f.periodic = periodic;
    f.box = box;
    f.rows = rods.size();
    f.columns = {"id",    "x",     "y",     "z",     "shapex",      "shapez",
                 "quat1", "quat2", "quat3", "quat4", "f_fibres[1]", "f_fibres[2]"};
    for (std::size_t k = 0; k < rods.size(); k++) {
      const auto &[s, r] = rods[k].capsule;
      const Quaternion q = orientation_of(s.axis);
      for (const double value :
           {double(rods[k].id), s.centre.x, s.centre.y, s.centre.z, r, r + s.half_length, q.w, q.x,
            q.y, q.z, double(fibre[k]), double(place[k])})
        f.values.push_back(value);
    }
    return f;
  }
};

// Ends of a chain in line: n segments of length h from `tail` along `axis`.
inline std::vector<Vec3> points_in_line(const Vec3 &tail, const Vec3 &axis, double h, int n)
{
  std::vector<Vec3> points;
  for (int k = 0; k <= n; k++) points.push_back(tail + k * h * axis);
  return points;
}

// Ends of a chain in the plane of x and z that turns by `bend` at each joint.
inline std::vector<Vec3> points_on_arc(const Vec3 &tail, double h, int n, double bend)
{
  std::vector<Vec3> points{tail};
  for (int k = 0; k < n; k++)
    points.push_back(points.back() + h * Vec3{std::cos(k * bend), 0.0, std::sin(k * bend)});
  return points;
}

}  // namespace spherocylinder
