// SPDX-License-Identifier: GPL-2.0-or-later
// The convex body that planes enclose.
#pragma once

#include <vector>

#include "solid/prism_volume.h"

namespace spherocylinder {

// The points with dot(normal, point) <= offset.
struct HalfSpace {
  Vec3 normal;  // unit
  double offset;
};

// The surface of what they have in common within about `reach` of `middle`, facing outwards; empty
// if they have nothing in common. Each face is a wide square clipped by all other planes, so that
// faces are right wherever planes meet (vtkHull loses some where more than three do); faces that
// touch may differ by round-off at their edge.
std::vector<Triangle> common_body(const std::vector<HalfSpace> &half_spaces, const Vec3 &middle,
                                  double reach);

}  // namespace spherocylinder
