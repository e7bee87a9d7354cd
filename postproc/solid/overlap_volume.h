// SPDX-License-Identifier: GPL-2.0-or-later
// How much two rods that overlap have in common.
#pragma once

#include "core/capsule.h"
#include "solid/convex_integral.h"

namespace spherocylinder {

// Volume common to both rods, to within 2 tolerance max(volume found, 1e-8 of the smaller rod).
//
// Planes parallel to both axes cut both in stadia, whose common area has a closed form; the common
// body is convex, see convex_volume. The common cases need no search:
// - Two round ends: two caps of balls.
// - A round end on a straight side: a ball and a tube, one integral.
// - Sides that cross clear of the ends, at an angle gamma and with the axes g apart: the sections
//   are bands 2 sqrt(r^2 - x^2) and 2 sqrt(r'^2 - (g - x)^2) wide that share a parallelogram,
//     V = 4/sin(gamma) integral of sqrt((r^2 - x^2)(r'^2 - (g - x)^2)) dx from g - r' to r,
//   an elliptic integral, by Gauss-Chebyshev quadrature.
BoundedVolume overlap_volume(const Capsule &a, const Capsule &b, double tolerance);

}  // namespace spherocylinder
