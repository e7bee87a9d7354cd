// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles as the surface that they make: which belong to one flat facet, where edges and corners stand
// out, what goes on smoothly.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/capsule.h"

namespace spherocylinder {

using Corners = std::array<Vec3, 3>;

// A triangle in space (m). Its edge k goes from corner k to the next.
struct TriangleShape {
  Corners corners;
  Vec3 normal;      // unit, by the right hand round the corners; either side may be a rod's
  Vec3 inwards[3];  // unit, in the plane and at right angles to edge k, into the triangle

  Vec3 centre() const { return (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]); }
  // Signed, along the normal (m).
  double height(const Vec3 &point) const { return dot(point - corners[0], normal); }
  // Whether a point's foot in the plane is in the triangle, or no farther beyond an edge than its margin (m).
  bool holds_foot(const Vec3 &point, const std::array<double, 3> &margins) const
  {
    return dot(point - corners[0], inwards[0]) >= -margins[0] &&
           dot(point - corners[1], inwards[1]) >= -margins[1] &&
           dot(point - corners[2], inwards[2]) >= -margins[2];
  }
  bool holds_foot(const Vec3 &point, double margin) const
  {
    return holds_foot(point, {margin, margin, margin});
  }
};

TriangleShape shape_of(const Corners &corners);
// Weights of the corners at a point of the plane; they sum to 1.
std::array<double, 3> barycentric(const TriangleShape &shape, const Vec3 &point);

// Triangles that turn less than this (rad) are one facet. Files with single precision bend flat faces by
// some 1e-7 of their size over that of a triangle.
constexpr double kFlatTurn = 1e-5;

// A triangle and which of its edges, or of its corners.
struct TrianglePart {
  int triangle, number;
};

// Where a facet ends: between two facets, or at nothing. Straight, however many triangles lie along it.
struct SurfaceEdge {
  int nodes[2];
  // Beside it, one of each facet: one or two of a surface that is not branched.
  std::vector<TrianglePart> beside;
  double turn;     // between their normals, 0 to pi; pi at a free edge (rad)
  bool is_smooth;  // not sharper than what the surface was told to be

  // Its pieces from nodes[0] to nodes[1]: where each ends, over the whole length, and what is beside it, in
  // the order of `beside`.
  struct Piece {
    double end;
    std::vector<TrianglePart> beside;
  };
  std::vector<Piece> pieces;
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
  // Each has the number of one of its triangles.
  int facet(int triangle) const { return facets_[triangle]; }
  // All triangles of a facet, each followed by another one; the last by the first.
  int next_of_facet(int triangle) const { return next_of_facet_[triangle]; }
  int patch(int triangle) const { return patches_[triangle]; }
  // 1 or -1: times the normal, the same side of the whole patch (unless it has but one).
  double orientation(int triangle) const { return orientations_[triangle]; }

  // Those between facets, and free ones.
  const std::vector<SurfaceEdge> &edges() const { return edges_; }
  Segment segment(int edge) const;

  // Whether edge k of a triangle goes on within its facet, all along or in part.
  const std::array<bool, 3> &flat_edges(int triangle) const { return flat_edges_[triangle]; }
  // Whether two facets meet at a smooth edge.
  bool meet_smoothly(int facet, int other) const;
  // Corners nearer than this are one (m).
  double one_node() const { return one_node_; }

  // Nodes at the ends of such edges: `corner_nodes`; others only within facets.
  const std::vector<int> &corner_nodes() const { return corner_nodes_; }
  const Vec3 &node(int node) const { return shapes_[node_at_[node][0]].corners[node_at_[node][1]]; }
  const std::vector<int> &nodes_around(int node) const { return around_[node]; }
  int triangle_at(int node) const { return node_at_[node][0]; }
  int own_corner_at(int node) const { return node_at_[node][1]; }  // of that triangle
  const std::vector<int> &edges_at(int node) const { return edges_at_[node]; }
  // Triangles that have the node within an edge.
  const std::vector<TrianglePart> &triangles_through(int node) const { return through_[node]; }

  // Whether two triangles share a node.
  bool are_neighbours(int a, int b) const;

 private:
  std::vector<TriangleShape> shapes_;
  std::vector<std::array<int, 3>> nodes_;    // of each triangle
  std::vector<std::array<int, 2>> node_at_;  // a triangle and its corner
  std::vector<int> facets_, next_of_facet_, patches_;
  std::vector<double> orientations_;
  std::vector<SurfaceEdge> edges_;
  std::vector<int> corner_nodes_;
  std::vector<std::vector<int>> around_, edges_at_;  // of corner nodes, else empty
  std::vector<std::vector<TrianglePart>> through_;
  std::vector<std::array<bool, 3>> flat_edges_;
  std::unordered_set<std::int64_t> smooth_pairs_;  // of facets
  double one_node_ = 0.0;

  // Each piece of an edge, by its nodes, and what is beside it.
  using Sides = std::map<std::pair<int, int>, std::vector<TrianglePart>>;
  void join_nodes();
  Sides all_sides() const;
  void cut_free_edges(Sides &sides);
  void find_edges(const Sides &sides, double smooth_turn);
  void join_pieces();
  struct Link {
    int triangles[2];
    double orientation;  // 1 if both have their normal on the same side
  };
  void orient(const std::vector<Link> &links);
};

}  // namespace spherocylinder
