// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles as the surface that they make: which belong to one flat facet, where edges and corners stand
// out, what goes on smoothly.
#pragma once

#include <array>
#include <vector>

#include "core/capsule.h"

namespace spherocylinder {

using Corners = std::array<Vec3, 3>;

// A triangle in space (m). Its edge k goes from corner k to the next.
struct TriangleShape {
  Corners corners;
  Vec3 normal;      // unit, by the right hand round the corners; either side may be a rod's
  Vec3 inwards[3];  // unit, in the plane and at right angles to edge k, into the triangle

  // Signed, along the normal (m).
  double height(const Vec3 &point) const { return dot(point - corners[0], normal); }
  // Whether a point's foot in the plane is in the triangle, or no farther from it than `margin` (m).
  bool holds_foot(const Vec3 &point, double margin) const
  {
    return dot(point - corners[0], inwards[0]) >= -margin &&
           dot(point - corners[1], inwards[1]) >= -margin &&
           dot(point - corners[2], inwards[2]) >= -margin;
  }
};

TriangleShape shape_of(const Corners &corners);
// Weights of the corners at a point of the plane; they sum to 1.
std::array<double, 3> barycentric(const TriangleShape &shape, const Vec3 &point);

// Triangles that turn less than this (rad) are one facet. Files with single precision bend flat faces by
// some 1e-7 of their size over that of a triangle.
constexpr double kFlatTurn = 1e-5;

// Where a facet ends: between two facets, or at nothing.
struct SurfaceEdge {
  int nodes[2];
  // Beside it, one or two of a surface that is not branched; and which of its own edges it is of each.
  std::vector<int> triangles, own_edges;
  double turn;                 // between their normals, 0 to pi; pi at a free edge (rad)
  bool is_smooth;              // not sharper than what the surface was told to be
};

class TriangleSurface {
 public:
  TriangleSurface() = default;
  // `smooth_turn` (rad): facets that meet at no more than this are one smooth patch. Corners nearer than
  // about 1e-7 of the surface's size are one node; an edge may meet several shorter ones.
  TriangleSurface(std::vector<Corners> triangles, double smooth_turn);

  // The same triangles elsewhere, moved as one body.
  void move_to(const std::vector<Corners> &triangles);

  int count() const { return static_cast<int>(shapes_.size()); }
  const TriangleShape &shape(int triangle) const { return shapes_[triangle]; }
  int facet(int triangle) const { return facets_[triangle]; }  // a number for each
  int patch(int triangle) const { return patches_[triangle]; }
  // 1 or -1: times the normal, the same side of the whole patch (unless it has but one).
  double orientation(int triangle) const { return orientations_[triangle]; }

  // Those between facets, and free ones.
  const std::vector<SurfaceEdge> &edges() const { return edges_; }
  Segment segment(int edge) const;

  // Nodes at the ends of such edges: `corner_nodes`; others only within facets.
  const std::vector<int> &corner_nodes() const { return corner_nodes_; }
  const Vec3 &node(int node) const { return shapes_[node_at_[node][0]].corners[node_at_[node][1]]; }
  const std::vector<int> &nodes_around(int node) const { return around_[node]; }
  int triangle_at(int node) const { return node_at_[node][0]; }
  int own_corner_at(int node) const { return node_at_[node][1]; }  // of that triangle
  const std::vector<int> &edges_at(int node) const { return edges_at_[node]; }

  // Whether two triangles share a node.
  bool are_neighbours(int a, int b) const;

 private:
  std::vector<TriangleShape> shapes_;
  std::vector<std::array<int, 3>> nodes_;  // of each triangle
  std::vector<std::array<int, 2>> node_at_;  // a triangle and its corner
  std::vector<int> facets_, patches_;
  std::vector<double> orientations_;
  std::vector<SurfaceEdge> edges_;
  std::vector<int> corner_nodes_;
  std::vector<std::vector<int>> around_, edges_at_;  // of corner nodes, else empty

  void join_nodes();
  void find_edges(double smooth_turn);
  struct Link {
    int triangles[2];
    double orientation;  // 1 if both have their normal on the same side
  };
  void orient(const std::vector<Link> &links);
};

}  // namespace spherocylinder
