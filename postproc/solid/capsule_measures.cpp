// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/capsule_measures.h"

#include <cmath>

#include "core/mass_properties.h"

namespace spherocylinder {

double elevation(const Vec3 &axis)
{
  return std::atan2(std::abs(axis.z), std::hypot(axis.x, axis.y));
}

double highest_point(const Capsule &capsule)
{
  const Segment &segment = capsule.segment;
  return segment.centre.z + std::abs(segment.axis.z) * segment.half_length + capsule.radius;
}

double volume(const Capsule &capsule)
{
  return mass_properties(2.0 * capsule.radius, capsule.length(), 1.0).volume;
}

}  // namespace spherocylinder
