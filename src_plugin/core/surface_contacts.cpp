// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/surface_contacts.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/surface_finder.h"

namespace spherocylinder {

namespace {

// Of the rectangles along the first triangle's edges the smallest.
NearFacet narrowest(const TriangleSurface &surface, const int *triangles, NearFacet facet)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (int edge = 0; edge < 3; edge++) {
    const Rectangle in(surface.shape(triangles[facet.first]), edge);
    double low[2] = {0.0, 0.0}, high[2] = {0.0, 0.0};
    for (int k = facet.first; k < facet.first + facet.count; k++)
      for (const Vec3 &corner : surface.shape(triangles[k]).corners) {
        const double at[2] = {in.across(corner), in.along(corner)};
        for (int d = 0; d < 2; d++) {
          low[d] = std::min(low[d], at[d]);
          high[d] = std::max(high[d], at[d]);
        }
      }
    const double area = (high[0] - low[0]) * (high[1] - low[1]);
    if (area >= smallest) continue;
    smallest = area;
    facet.edge = edge;
    std::copy_n(low, 2, facet.low);
    std::copy_n(high, 2, facet.high);
  }
  return facet;
}

}  // namespace

void group_facets(const TriangleSurface &surface, NearFeatures &near)
{
  for (int end = 0; end < 2; end++) {
    std::vector<int> &triangles = near.triangles[end];
    std::sort(triangles.begin(), triangles.end(), [&](int a, int b) {
      return std::pair(surface.facet(a), a) < std::pair(surface.facet(b), b);
    });
    near.facets[end].clear();
    const int count = static_cast<int>(triangles.size());
    for (int first = 0, next = 0; first < count; first = next) {
      while (next < count && surface.facet(triangles[next]) == surface.facet(triangles[first]))
        next++;
      near.facets[end].push_back(
          narrowest(surface, triangles.data(), {first, next - first, 0, {}, {}, first}));
    }
  }
}

void find_contacts(const Capsule &rod, const TriangleSurface &surface, const NearFeatures &near,
                   const std::vector<RememberedSide> &remembered,
                   std::vector<SurfaceContact> &contacts)
{
  contacts.clear();
  EndFinder(rod, surface, near, remembered, contacts).find();
  if (rod.segment.half_length > 0.0) BetweenFinder(rod, surface, near, remembered, contacts).find();
  const auto is_nothing = [](const SurfaceContact &contact) { return !(contact.weight > 0.0); };
  contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_nothing), contacts.end());
}

bool goes_through(const Segment &axis, const TriangleShape &triangle)
{
  const double from = triangle.height(axis.at(-axis.half_length));
  const double to = triangle.height(axis.at(axis.half_length));
  if ((from < 0.0) == (to < 0.0) || from == to) return false;
  const double part = from / (from - to);
  return triangle.holds_foot(axis.at((2.0 * part - 1.0) * axis.half_length), 0.0);
}

}  // namespace spherocylinder
