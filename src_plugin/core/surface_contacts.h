// SPDX-License-Identifier: GPL-2.0-or-later
// Where a rod touches a surface of triangles.
#pragma once

#include <vector>

#include "core/triangle_surface.h"

namespace spherocylinder {

enum class OnRod { kEndMinus, kEndPlus, kBetween };  // at -u, at +u, in between
enum class OnSurface { kFace, kEdge, kCorner };

struct SurfaceContact {
  OnRod place;
  OnSurface feature;
  int index;        // of the triangle, of the edge in edges(), of the node
  int triangle;     // that bears it
  int part;         // of the triangle: 0 its face, 1 to 3 an edge, 4 to 6 a corner
  double along;     // of the point on the rod's axis, from its centre (m)
  Vec3 normal;      // unit, from the surface to the rod's side of it
  double distance;  // of that point along it, negative once it is through (m)
  double weight;    // of its load, 0 to 1

  Vec3 on_axis(const Segment &rod) const { return rod.at(along); }
  Vec3 on_surface(const Segment &rod) const { return rod.at(along) - distance * normal; }
};

// A contact of the last step: which side the rod is on.
struct RememberedSide {
  OnRod place;
  int triangle, part;  // as in SurfaceContact
  Vec3 normal;
};

// The triangles of one facet near an end, and a rectangle around them, in the facet and along an edge of the
// first: of fine tilings one triangle is asked, not all.
struct NearFacet {
  int first, count;  // in NearFeatures::triangles
  int edge;          // of the first triangle: the rectangle's first side is at right angles to it
  double low[2], high[2];
  mutable int last;  // that held the end's foot (in NearFeatures::triangles)
};

// What of a surface a rod may touch: all whose distance from the axis is at most the radius must be there.
struct NearFeatures {
  std::vector<int> triangles[2];     // near either end
  std::vector<NearFacet> facets[2];  // of them: group_facets()
  std::vector<int> edges, corners;
  std::vector<int> pierced;  // facets that the axis goes through and no contact is remembered of
};

// Once the triangles are known. They may move after that, as one body.
void group_facets(const TriangleSurface &surface, NearFeatures &near);

// A rod is on the side of a face where it was while it touched it, or one that it meets smoothly, in the
// last step; else where its end is; of a pierced facet where its centre is.
//
// Contacts are the places where the surface is nearest to an end, or to the axis between its ends:
//   ends     over a face (its foot in the triangle), at an edge or a corner that stands out towards it;
//            an end in a valley has one for each side; a face whose foot the end does not see has none;
//   between  where the axis passes an edge or a corner that stands out. Over the rim of a facet that the
//            axis leaves there, also when the rod is nearer to the facet farther in, so that a rod on a
//            facet smaller than itself rests on its rims as on its ends: less the more it tilts (none
//            from half the edge's turn on).
// Weights: an end in a smooth valley shares one load among its facets, as their overlaps and as how far its
// feet are from where these meet; facets that do not meet bear one load as far as those on the way between
// them bear it. An end at an edge that the axis is nearest to farther in fades out. Contacts between the ends
// that are nearer to each other along the axis than the rod's radius share one load, all of it where they
// meet, none from a radius on; over a rim near a place where the surface is nearest, and near an end, they
// have what is left, so that a contact that comes to an end goes over into that of the end. Edges within a
// smooth patch bear what stands out over the straight line between the ends' overlaps; two neighbours that the
// rod is pressed into deeper than they turn share one load with the overlap of a round surface through both
// (`distance` is then that of this surface), so that it is the gradient of its energy. So loads change
// continuously with the rod's pose, except where an axis gets parallel to an edge, an end passes the boundary
// of a sharp valley, a face comes into sight, or normals turn at once, and by a little where a tilted rod
// passes a corner or lies nearly along a gentle ridge.
void find_contacts(const Capsule &rod, const TriangleSurface &surface, const NearFeatures &near,
                   const std::vector<RememberedSide> &remembered,
                   std::vector<SurfaceContact> &contacts);

// Whether a rod's axis goes through the triangle.
bool goes_through(const Segment &axis, const TriangleShape &triangle);

}  // namespace spherocylinder
