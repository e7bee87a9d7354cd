// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/overlapping_facets.h"

#include <cmath>
#include <vector>

using namespace spherocylinder;

namespace {

// In nodes' sizes: what is no farther off a plane is in it, what is no farther within a triangle is on its edge.
constexpr double kBeside = 10.0;
constexpr int kPlaces = 16;

}  // namespace

OverlappingFacets spherocylinder::find_overlapping_facets(const TriangleSurface &surface,
                                                          const BoxTree &boxes, int owned)
{
  const double beside = kBeside * surface.one_node();
  std::vector<int> found;
  for (size_t e = 0; e < surface.edges().size(); e++) {
    const SurfaceEdge &edge = surface.edges()[e];
    if (edge.beside.size() != 1) continue;
    const int facet = surface.facet(edge.beside[0].triangle);
    const Segment segment = surface.segment(static_cast<int>(e));
    size_t piece = 0;
    for (int k = 0; k < kPlaces; k++) {
      const double place = (k + 0.5) / kPlaces;
      while (piece + 1 < edge.pieces.size() && edge.pieces[piece].end < place) piece++;
      const int triangle = edge.pieces[piece].beside[0].triangle;
      if (triangle >= owned) continue;
      const Vec3 point = segment.at((2.0 * place - 1.0) * segment.half_length);
      found.clear();
      boxes.find(widened(around(point, point), beside), found);
      for (const int other : found) {
        const TriangleShape &shape = surface.shape(other);
        if (surface.facet(other) == facet || std::fabs(shape.height(point)) > beside ||
            !shape.holds_foot(point, -beside) ||
            norm(cross(shape.normal, surface.shape(triangle).normal)) > kFlatTurn)
          continue;
        return {triangle, other};
      }
    }
  }
  return {-1, -1};
}
