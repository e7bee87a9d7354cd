// SPDX-License-Identifier: GPL-2.0-or-later
// How much of a rod lies inside an upright cylinder, with a bound on the error.
#pragma once

#include "analysis/convex_integral.h"
#include "core/capsule.h"

namespace spherocylinder {

// Solid cylinder with a vertical axis (along z).
struct UprightCylinder {
  double x, y;  // of its axis
  double radius;
  double z_low, z_high;
};

double volume(const UprightCylinder &cylinder);

// Whether the rod lies wholly inside.
bool holds(const UprightCylinder &cylinder, const Capsule &rod);

// Whether the rod is certainly outside; not all rods outside are found.
bool misses(const UprightCylinder &cylinder, const Capsule &rod);

// Volume that the rod and the cylinder have in common.
//
// Cut both by the vertical planes parallel to the rod's axis, x being the offset of the plane
// from it. The rod's section is a stadium, the cylinder's an upright rectangle, and the area they
// share has a closed form. The common body is convex: convex_volume integrates the areas to within
//   2 tolerance max(volume found, 1e-3 of the rod).
// Rods wholly inside or outside cost nothing and are exact, as are those that only the top and the
// bottom cut.
BoundedVolume clipped_volume(const Capsule &capsule, const UprightCylinder &cylinder,
                             double tolerance);

}  // namespace spherocylinder
