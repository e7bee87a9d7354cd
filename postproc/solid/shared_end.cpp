// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/shared_end.h"

#include <algorithm>
#include <cmath>

#include "core/numbers.h"
#include "solid/overlap_volume.h"

namespace spherocylinder {
namespace {

// Of r^3: with a larger error the volume is left to overlap_volume.
constexpr double kLargestError = 1e-3;

// Relative, of joints without a closed form.
constexpr double kTolerance = 1e-4;

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
  const double part = distance / r, error = part * (std::sqrt(part) + 2.0 * angle);
  if (!(has_room && error <= kLargestError)) return overlap_volume(a, b, kTolerance);
  const Vec3 mean = s.axis + t.axis;  // not zero: there is room
  const double along = dot(apart, mean) / norm(mean);
  const double cube = 4.0 / 3.0 * r * r * r;
  const double section = 0.5 * pi * r * r * (1.0 + std::hypot(1.0, half_tangent));
  return {cube * (pi - 0.5 * angle + half_tangent) - section * along, error * r * r * r};
}

}  // namespace spherocylinder
