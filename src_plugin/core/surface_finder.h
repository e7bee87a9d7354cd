// SPDX-License-Identifier: GPL-2.0-or-later
// How find_contacts() is made: what its two halves, of a rod's ends and of what is between them, share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/surface_contacts.h"

namespace spherocylinder {

// Where features meet, both are asked as far as this (over the rod's radius) beyond their own bounds, so
// that neither rounding nor the turn of flat facets leaves a gap: what both find is one contact.
constexpr double kSeam = kFlatTurn;
// Two seams to either side: places nearer to each other than this many of them are one.
constexpr double kOnePlace = 4.0;

// Coordinates in a triangle's plane.
struct Rectangle {
  Vec3 origin, across_edge, along_edge;

  Rectangle(const TriangleShape &shape, int edge)
      : origin(shape.corners[0]),
        across_edge(shape.inwards[edge]),
        along_edge(cross(shape.inwards[edge], shape.normal))
  {
  }
  double across(const Vec3 &point) const { return dot(point - origin, across_edge); }
  double along(const Vec3 &point) const { return dot(point - origin, along_edge); }
};

// A rod, what of a surface is near it, and the contacts found so far.
class SurfaceFinder {
 public:
  SurfaceFinder(const Capsule &rod, const TriangleSurface &surface, const NearFeatures &near,
                const std::vector<RememberedSide> &remembered,
                std::vector<SurfaceContact> &contacts)
      : rod_(rod),
        axis_(rod.segment),
        surface_(surface),
        near_(near),
        remembered_(remembered),
        contacts_(contacts),
        seam_(std::max(kSeam * rod.radius, surface.one_node()))
  {
  }

 protected:
  const Capsule &rod_;
  const Segment &axis_;
  const TriangleSurface &surface_;
  const NearFeatures &near_;
  const std::vector<RememberedSide> &remembered_;
  std::vector<SurfaceContact> &contacts_;
  const double seam_;  // m

  // What bears a contact: of an edge or a corner one of its triangles.
  struct Bearer {
    OnSurface feature;
    int index, triangle, part;
  };
  static Bearer face(int triangle) { return {OnSurface::kFace, triangle, triangle, 0}; }
  Bearer corner(int node) const
  {
    return {OnSurface::kCorner, node, surface_.triangle_at(node), 4 + surface_.own_corner_at(node)};
  }
  // `place`: over the edge's length; `nth`: of the facets beside it.
  Bearer edge(int index, double place, int nth = 0) const
  {
    const auto &pieces = surface_.edges()[index].pieces;
    size_t k = 0;
    while (k + 1 < pieces.size() && place > pieces[k].end) k++;
    const TrianglePart &part = pieces[k].beside[nth];
    return {OnSurface::kEdge, index, part.triangle, 1 + part.number};
  }

  void add(OnRod place, const Bearer &bearer, double along, const Vec3 &normal, double distance,
           double weight = 1.0)
  {
    contacts_.push_back({place, bearer.feature, bearer.index, bearer.triangle, bearer.part, along,
                         normal, distance, weight});
  }

  // Adds a contact whose surface point is `way` away from the rod's, on the remembered side.
  void add_by_way(OnRod place, const Bearer &bearer, double along, const Vec3 &way, bool passed)
  {
    const double distance = norm(way);
    if (distance == 0.0) return;
    const double sign = passed ? -1.0 : 1.0;
    add(place, bearer, along, (sign / distance) * way, sign * distance);
  }

  // Whether the rod's point has gone through the edge or corner that it touched in the last step.
  bool has_passed(OnRod place, const Bearer &bearer, const Vec3 &way) const
  {
    for (const RememberedSide &memory : remembered_)
      if (memory.place == place && memory.triangle == bearer.triangle && memory.part == bearer.part)
        return dot(memory.normal, way) < 0.0;
    return false;
  }

  // Whether from here the surface falls away on all sides of an edge's point: `way` leads from it.
  bool stands_out(const SurfaceEdge &edge, const Vec3 &way) const
  {
    for (const TrianglePart &side : edge.beside)
      if (dot(way, inwards_of(side)) > seam_) return false;
    return true;
  }
  bool corner_stands_out(int corner, const Vec3 &way) const
  {
    const Vec3 &at = surface_.node(corner);
    for (const int other : surface_.nodes_around(corner)) {
      const Vec3 along = surface_.node(other) - at;
      if (dot(way, along) > seam_ * norm(along)) return false;
    }
    for (const TrianglePart &side : surface_.triangles_through(corner))
      if (dot(way, inwards_of(side)) > seam_) return false;
    return true;
  }
  const Vec3 &inwards_of(const TrianglePart &side) const
  {
    return surface_.shape(side.triangle).inwards[side.number];
  }

  // Of contacts at one point of the surface that with the largest weight stays, of equal ones the nearest, of
  // equal ones the first.
  void drop_twins(size_t first)
  {
    for (size_t a = first; a < contacts_.size(); a++)
      for (size_t b = a + 1; b < contacts_.size(); b++) {
        SurfaceContact &one = contacts_[a], &other = contacts_[b];
        if (!(one.weight > 0.0) || !(other.weight > 0.0)) continue;
        const Vec3 between = one.on_surface(axis_) - other.on_surface(axis_);
        if (norm(between) > kOnePlace * seam_ ||
            std::fabs(one.along - other.along) > kOnePlace * seam_)
          continue;
        const bool other_stays =
            other.weight != one.weight ? other.weight > one.weight : other.distance < one.distance;
        (other_stays ? one : other).weight = 0.0;
      }
  }
};

// The contacts of both ends.
class EndFinder : SurfaceFinder {
 public:
  using SurfaceFinder::SurfaceFinder;
  void find();

 private:
  void find_of_end(OnRod place);
  // The facet's triangle over which the end is, -1 if none.
  int holder_of_foot(const NearFacet &facet, const int *triangles, const Vec3 &end) const;
  // Only within a facet there may be a gap: edges are asked as far as the seam themselves.
  std::array<double, 3> margins(int triangle, double margin) const;
  // 1 or -1 along the face's normal, 0 if nothing is known.
  double side_of_memory(OnRod place, int triangle) const;
  bool is_pierced(int triangle) const;
  void add_over_face(OnRod place, int triangle, double along, const Vec3 &end);
  void add_at_edge(OnRod place, int index, double along, const Vec3 &end);
  void add_at_corner(OnRod place, int node, double along, const Vec3 &end);
  // A face that another one hides from the end, as the far side of a thin plate, does not touch it. Once
  // the end is through one, nothing is told of what it sees.
  void drop_hidden(size_t first, int which);
  bool is_hidden(const SurfaceContact &contact, int which) const;
  // Facets in a valley share one load: as their overlaps, and as how far each one's foot is from where it
  // meets the next. One that hardly touches changes nothing for the others.
  void share_valley(size_t first);
  double overlap(size_t k) const { return rod_.radius - contacts_[k].distance; }
  // 0 where this one's foot is where it meets the other, 1 if the other does not touch.
  double part_beside(size_t a, size_t b) const;
  // A foot's height over the other facet over the sine of the turn.
  double from_valley(size_t a, size_t b) const;
  bool is_face(size_t k) const;
  bool make_a_valley(size_t a, size_t b) const;
  // Faces of one patch that hardly turn from one to the other, though what lies between them touches nothing.
  bool are_of_one_bowl(size_t a, size_t b) const;
};

// Those between the ends; the ends' contacts are there.
class BetweenFinder : SurfaceFinder {
 public:
  using SurfaceFinder::SurfaceFinder;
  void find();

 private:
  // Of an end's contact with this normal, where the axis comes nearer farther in.
  double kept_of_end(const Vec3 &normal, double along) const;
  bool is_between(double along) const { return std::fabs(along) < axis_.half_length; }
  void add_between_at_edge(int index);
  // The axis comes from beyond the edge and goes down over this facet: its load at the rim.
  void add_over_rim(int index, int nth, const Segment &segment);
  void add_between_at_corner(int node);
  // An end at an edge or corner that the axis is nearest to, and one over a facet beside it: there it has what it
  // had at the edge, a radius from the edge its whole load.
  void fade_ends(size_t ends);
  // Of an end's foot from the edge, over the radius: 0 at it, 1 from a radius on or anywhere else.
  double way_from(const SurfaceContact &between, const SurfaceContact &end) const;
  // Where facets meet smoothly the surface is one, and its edges bear nothing by themselves.
  bool is_smooth(const SurfaceContact &contact) const;
  // Of such edges: 1 of hardly any turn, 0 of one at which ends and what is between them are told apart.
  double gentleness(const SurfaceContact &contact) const;
  template <typename See>
  void for_each_edge_of(const SurfaceContact &contact, See see) const;
  // Two neighbouring edges of a smooth patch share one load: by how much the facet between them leans, from
  // wholly one to wholly the other over half the turn. Their common overlap is then that of a round
  // surface through both, and the load the gradient of its energy.
  void join_neighbours(size_t ends);
  void join(size_t nearest, size_t rim);
  double inclination_of_common_facet(const SurfaceContact &a, const SurfaceContact &b) const;
  // At such an edge, of its load, 0 to 1: by how much the surface there stands out over the straight line
  // between what the two ends are in it, over the overlap. On a flat floor nothing.
  double standing_out(size_t k, size_t ends) const;
  double overlap_at_end(const SurfaceContact &contact, OnRod end, size_t ends) const;
  // How far two contacts are one, 0 to 1: by their distance along the axis, and by their normals.
  double nearness(const SurfaceContact &a, const SurfaceContact &b) const;
  double nearness_of_normals(const SurfaceContact &a, const SurfaceContact &b) const
  {
    return std::max(0.0, dot(a.normal, b.normal));
  }
  // Of contacts of one kind, nearest or over a rim, each has its part; those over rims have what the nearest
  // leave.
  void share_between(size_t ends);
  // Over a rim a contact has less than its whole weight from the start.
  bool is_nearest(size_t k) const { return is_nearest_[k - ends_]; }
  // As found, before neighbours were joined.
  double overlap(size_t k) const { return overlaps_[k - ends_]; }
  // Of the load of a contact between the ends: what those of the ends do not bear already.
  double left_by_ends(const SurfaceContact &contact, size_t ends) const;
  bool are_at_one_edge(const SurfaceContact &a, const SurfaceContact &b) const;
  size_t ends_ = 0;  // contacts of the ends; then those between
  std::vector<char> is_nearest_;
  std::vector<double> overlaps_;
  std::vector<double> bears_;        // see standing_out, 1 if sharp
  std::vector<int> joined_to_;       // the other, -1 if none
  std::vector<double> joined_;       // how far, 0 to 1
  std::vector<int> nearest_within_;  // edges that the axis is nearest to between both's ends
};

}  // namespace spherocylinder
