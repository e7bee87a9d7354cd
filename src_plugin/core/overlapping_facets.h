// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/box_tree.h"
#include "core/triangle_surface.h"

namespace spherocylinder {

// A triangle with a free edge that lies, in part, within a triangle of another facet in the same plane: there
// a rod touches both, and the surface is twice as stiff. -1, -1 if none is found.
struct OverlappingFacets {
  int triangle, within;
};

// Of free edges of the first `owned` triangles. `boxes`: those of the triangles. Edges are looked at in 16
// places each.
OverlappingFacets find_overlapping_facets(const TriangleSurface &surface, const BoxTree &boxes,
                                          int owned);

}  // namespace spherocylinder
