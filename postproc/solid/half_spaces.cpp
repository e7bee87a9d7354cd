// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/half_spaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solid/section_area.h"

namespace spherocylinder {
namespace {

constexpr double kParallel = 1e-9;  // sine of the angle between two planes that never cross

// A plane of its own coordinates.
struct PlaneFrame {
  PlaneFrame(const HalfSpace &plane, const Vec3 &middle)
      : origin(middle + (plane.offset - dot(plane.normal, middle)) * plane.normal)
  {
    const Vec3 &n = plane.normal;
    const Vec3 e = cross(std::abs(n.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0}, n);
    across = (1.0 / norm(e)) * e;
    aside = cross(n, across);
  }

  Vec3 place(const Point2 &p) const { return origin + p.t * across + p.z * aside; }

  Vec3 origin, across, aside;  // counter-clockwise as seen from outside
};

Polygon face_of(std::size_t i, const PlaneFrame &frame, const std::vector<HalfSpace> &half_spaces,
                double reach)
{
  const HalfSpace &plane = half_spaces[i];
  const double wide = 2.0 * reach;
  Polygon face{{-wide, -wide}, {wide, -wide}, {wide, wide}, {-wide, wide}};
  for (std::size_t j = 0; j < half_spaces.size() && face.size() > 2; j++) {
    if (j == i) continue;
    const HalfSpace &other = half_spaces[j];
    const Point2 trace{dot(other.normal, frame.across), dot(other.normal, frame.aside)};
    const double room = other.offset - dot(other.normal, frame.origin);
    if (trace.t * trace.t + trace.z * trace.z > kParallel * kParallel) {
      const auto is_outside = [&](const Point2 &p) { return trace.t * p.t + trace.z * p.z > room; };
      if (std::any_of(face.begin(), face.end(), is_outside)) face = clip(face, trace, room);
      continue;
    }
    // Of planes that are the same the first has the face.
    const bool is_same =
        dot(other.normal, plane.normal) > 0.0 && std::abs(room) <= kParallel * reach;
    if (is_same ? j < i : room < 0.0) return {};
  }
  return face;
}

}  // namespace

std::vector<Triangle> common_body(const std::vector<HalfSpace> &half_spaces, const Vec3 &middle,
                                  double reach)
{
  std::vector<Triangle> surface;
  for (std::size_t i = 0; i < half_spaces.size(); i++) {
    const PlaneFrame frame(half_spaces[i], middle);
    const Polygon face = face_of(i, frame, half_spaces, reach);
    for (std::size_t k = 2; k < face.size(); k++)
      surface.push_back({frame.place(face[0]), frame.place(face[k - 1]), frame.place(face[k])});
  }
  return surface;
}

}  // namespace spherocylinder
