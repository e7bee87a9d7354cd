// SPDX-License-Identifier: GPL-2.0-or-later
// How much of a rod lies inside an upright cylinder, with a bound on the error.
#pragma once

#include "core/capsule.h"

namespace spherocylinder {

// Solid cylinder with a vertical axis (along z).
struct UprightCylinder {
  double x, y;  // of its axis
  double radius;
  double z_low, z_high;
};

double volume(const UprightCylinder &cylinder);

struct BoundedVolume {
  double value;  // m^3
  double error;  // the true volume is within value -+ error (round-off apart), m^3
};

// Volume that the rod and the cylinder have in common.
//
// Cut both by the vertical planes parallel to the rod's axis, x being the offset of the plane
// from it. The rod's section is a stadium, the cylinder's an upright rectangle, and the area A(x)
// they share has a closed form. The common body is convex, so by the Brunn-Minkowski theorem
// sqrt(A) is a concave function of x: between two samples it lies above their chord and below the
// neighbouring chords prolonged. The two give a lower and an upper bound on the integral of A;
// intervals are halved until the bounds are closer than
//   2 tolerance max(volume found, 1e-3 of the rod).
// Rods wholly inside or outside are exact and cost nothing.
BoundedVolume clipped_volume(const Capsule &capsule, const UprightCylinder &cylinder,
                             double tolerance);

}  // namespace spherocylinder
