// SPDX-License-Identifier: GPL-2.0-or-later
// How much of a rod lies inside an upright cylinder or box, with a bound on the error.
#pragma once

#include "core/capsule.h"
#include "solid/convex_integral.h"

namespace spherocylinder {

// Solid cylinder with a vertical axis (along z).
struct UprightCylinder {
  double x, y;  // of its axis
  double radius;
  double z_low, z_high;
};

// Solid box with faces across x, y and z.
struct UprightBox {
  UprightBox(double x_low_, double x_high_, double y_low_, double y_high_, double z_low_,
             double z_high_)
      : x_low(x_low_),
        x_high(x_high_),
        y_low(y_low_),
        y_high(y_high_),
        z_low(z_low_),
        z_high(z_high_)
  {
  }

  double x_low, x_high, y_low, y_high, z_low, z_high;
};

double volume(const UprightCylinder &cylinder);
double volume(const UprightBox &box);

// Whether the rod lies wholly inside.
bool holds(const UprightCylinder &cylinder, const Capsule &rod);
bool holds(const UprightBox &box, const Capsule &rod);

// Whether the rod is certainly outside; not all rods outside are found.
bool misses(const UprightCylinder &cylinder, const Capsule &rod);
bool misses(const UprightBox &box, const Capsule &rod);

// Volume that the rod and the cylinder or box have in common.
//
// Cut both by the vertical planes parallel to the rod's axis, x being the offset of the plane
// from it. The rod's section is a stadium, the other's an upright rectangle, and the area they
// share has a closed form. The common body is convex: convex_volume integrates the areas to within
//   2 tolerance max(volume found, 1e-3 of the rod).
// Rods wholly inside or outside cost nothing and are exact, as are those that only the top and the
// bottom cut, or two other opposite faces of a box.
BoundedVolume clipped_volume(const Capsule &capsule, const UprightCylinder &cylinder,
                             double tolerance);
BoundedVolume clipped_volume(const Capsule &capsule, const UprightBox &box, double tolerance);

}  // namespace spherocylinder
