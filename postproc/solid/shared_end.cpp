// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/shared_end.h"

#include <algorithm>
#include <cmath>

#include "core/numbers.h"
#include "solid/overlap_volume.h"

namespace spherocylinder {
namespace {

// Radii that ends may be apart for the closed form.
constexpr double kNear = 0.02;

// Relative, of joints without a closed form.
constexpr double kTolerance = 1e-4;

// Ends d apart across the axis cut a rim of some d times as much from discs whose depth is
// sqrt(2 r d): found to be less than r^3 (d/r)^(3/2).
constexpr double kRim = 1.0;

}  // namespace

double bend_angle(const Vec3 &axis, const Vec3 &next)
{
  return std::atan2(norm(cross(axis, next)), dot(axis, next));
}

BoundedVolume shared_end_volume(const Capsule &a, const Capsule &b)
{
  const Segment &s = a.segment, &t = b.segment;
  const double r = a.radius, angle = bend_angle(s.axis, t.axis);
  const Vec3 apart = t.at(-t.half_length) - s.at(s.half_length);
  const double distance = norm(apart), half_tangent = std::tan(0.5 * angle);
  const bool has_room = r * half_tangent <= 2.0 * std::min(s.half_length, t.half_length);
  if (!(has_room && distance <= kNear * r)) return overlap_volume(a, b, kTolerance);
  const Vec3 mean = s.axis + t.axis;  // not zero: there is room
  const double along = dot(apart, mean) / norm(mean);
  const double cube = 4.0 / 3.0 * r * r * r;
  const double part = distance / r;
  return {cube * (pi - 0.5 * angle + half_tangent) - pi * r * r * along,
          kRim * r * r * r * part * std::sqrt(part)};
}

}  // namespace spherocylinder
