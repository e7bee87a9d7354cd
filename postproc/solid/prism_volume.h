// SPDX-License-Identifier: GPL-2.0-or-later
// How much of a rod lies inside a closed surface of triangles: the rod's parts behind each of them.
#pragma once

#include <vector>

#include "core/capsule.h"
#include "solid/convex_integral.h"

namespace spherocylinder {

// Corners counter-clockwise as seen from outside the surface (m).
struct Triangle {
  Vec3 a, b, c;
};

// Volume that the rod and the body inside the surface have in common.
//
// Behind a triangle are the points from which the way along the rod's axis u, in its sense, leads
// through it. A point is inside the body if, of the triangles it is behind, one more faces along u
// than against it, else as many do. So the common volume is the sum over the triangles of the
// rod's volume behind each, less where it faces against u. What is behind a triangle is a prism,
// convex as the rod is: cut by the planes parallel to u, the rod leaves a stadium and the prism a
// trapezoid, and convex_volume integrates the area they share. A triangle in whose shadow the whole
// rod is cuts it by one plane, in closed form. The body need not be convex. The error is the sum of
// the prisms' bounds, each at most 2 tolerance max(volume, 1e-3 of the rod).
BoundedVolume volume_inside(const std::vector<Triangle> &surface, const Capsule &capsule,
                            double tolerance);

}  // namespace spherocylinder
