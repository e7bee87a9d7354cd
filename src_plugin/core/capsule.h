// SPDX-License-Identifier: GPL-2.0-or-later
// A rod as geometry: all points nearer than `radius` to a straight segment (a sphero-cylinder or
// capsule). A segment of zero length is a sphere. Space frame, any consistent unit of length.
#pragma once

#include "core/prefetch.h"
#include "core/vec3.h"

namespace spherocylinder {

struct Segment {
  Vec3 centre;
  Vec3 axis;           // unit vector; its sign carries no meaning
  double half_length;  // half the cylinder part h, >= 0

  // The point at signed distance s from the centre along the axis.
  Vec3 at(double s) const { return centre + s * axis; }
};

struct alignas(kCacheLine) Capsule {
  Segment segment;
  double radius;  // > 0

  double length() const { return 2.0 * (segment.half_length + radius); }  // L = h + 2 r
  double aspect_ratio() const { return length() / (2.0 * radius); }       // lambda = L / D
};

// Any surface point of a rod moves at most as far as its centre plus its axis's end; a spin about the
// axis moves no surface. (a + b)^2 <= 2 a^2 + 2 b^2 saves the roots. Returns twice a^2 + b^2 (m^2).
inline double twice_shift_squared(const Segment &now, const Segment &then)
{
  return 2.0 * (norm_squared(now.centre - then.centre) +
                now.half_length * now.half_length * norm_squared(now.axis - then.axis));
}

}  // namespace spherocylinder
