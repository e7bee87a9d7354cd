// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/triangle_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "core/box_tree.h"

namespace spherocylinder {

namespace {

// Corners nearer than this, over the surface's extent, are one: single precision is 6e-8 of a number.
constexpr double kOneNode = 2e-7;

// Groups of things that are joined two by two.
class Groups {
 public:
  explicit Groups(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  int of(int k)
  {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  // The group's number is that of its lowest member.
  void join(int a, int b)
  {
    const int lower = std::min(of(a), of(b)), higher = std::max(of(a), of(b));
    parent_[higher] = lower;
  }

 private:
  std::vector<int> parent_;
};

using NodePair = std::pair<int, int>;
NodePair ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

double extent_of(const std::vector<TriangleShape> &shapes)
{
  Box all = around(shapes[0].corners[0], shapes[0].corners[0]);
  for (const TriangleShape &shape : shapes)
    for (const Vec3 &corner : shape.corners) all = united(all, around(corner, corner));
  return norm(all.high - all.low);
}

// Between the normals of two triangles at their common edge, whichever way they are oriented: 0 where they
// go on flat, pi where they are folded on each other.
double turn_between(const Vec3 &inwards_a, const Vec3 &inwards_b)
{
  return std::atan2(norm(cross(inwards_a, inwards_b)), -dot(inwards_a, inwards_b));
}

}  // namespace

TriangleShape shape_of(const Corners &corners)
{
  TriangleShape shape{corners, kZero, {kZero, kZero, kZero}};
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  shape.normal = (1.0 / norm(normal)) * normal;
  for (int k = 0; k < 3; k++) {
    const Vec3 across = cross(shape.normal, corners[(k + 1) % 3] - corners[k]);
    shape.inwards[k] = (1.0 / norm(across)) * across;
  }
  return shape;
}

std::array<double, 3> barycentric(const TriangleShape &shape, const Vec3 &point)
{
  std::array<double, 3> weights;
  for (int k = 0; k < 3; k++) {  // the edge opposite of corner k
    const int edge = (k + 1) % 3;
    const Vec3 &from = shape.corners[edge];
    weights[k] = dot(point - from, shape.inwards[edge]) /
                 dot(shape.corners[k] - from, shape.inwards[edge]);
  }
  return weights;
}

TriangleSurface::TriangleSurface(std::vector<Corners> triangles, double smooth_turn)
{
  shapes_.reserve(triangles.size());
  for (const Corners &corners : triangles) shapes_.push_back(shape_of(corners));
  if (shapes_.empty()) return;
  join_nodes();
  find_edges(smooth_turn);
}

void TriangleSurface::move_to(const std::vector<Corners> &triangles)
{
  for (size_t t = 0; t < triangles.size(); t++) shapes_[t] = shape_of(triangles[t]);
}

// Cells of many times the distance hold the nodes; a corner near the border of its cell looks beyond it.
void TriangleSurface::join_nodes()
{
  const double nearer = kOneNode * extent_of(shapes_), cell = 64.0 * nearer;
  struct Hash {
    size_t operator()(const std::array<std::int64_t, 3> &key) const
    {
      return static_cast<size_t>(key[0] * 73856093 ^ key[1] * 19349663 ^ key[2] * 83492791);
    }
  };
  std::unordered_map<std::array<std::int64_t, 3>, std::vector<int>, Hash> cells;
  const auto cell_of = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
  const auto find = [&](const Vec3 &at) {
    for (std::int64_t x = cell_of(at.x - nearer); x <= cell_of(at.x + nearer); x++)
      for (std::int64_t y = cell_of(at.y - nearer); y <= cell_of(at.y + nearer); y++)
        for (std::int64_t z = cell_of(at.z - nearer); z <= cell_of(at.z + nearer); z++) {
          const auto found = cells.find({x, y, z});
          if (found == cells.end()) continue;
          for (const int n : found->second)
            if (norm(node(n) - at) <= nearer) return n;
        }
    return -1;
  };

  nodes_.resize(shapes_.size());
  for (int t = 0; t < count(); t++)
    for (int k = 0; k < 3; k++) {
      const Vec3 &at = shapes_[t].corners[k];
      int n = find(at);
      if (n < 0) {
        n = static_cast<int>(node_at_.size());
        node_at_.push_back({t, k});
        cells[{cell_of(at.x), cell_of(at.y), cell_of(at.z)}].push_back(n);
      }
      nodes_[t][k] = n;
    }
}

void TriangleSurface::find_edges(double smooth_turn)
{
  struct Side {
    int triangle, edge;
  };
  std::map<NodePair, std::vector<Side>> sides;
  for (int t = 0; t < count(); t++)
    for (int k = 0; k < 3; k++)
      sides[ordered(nodes_[t][k], nodes_[t][(k + 1) % 3])].push_back({t, k});

  // A free edge that other free edges end on is cut there: a long triangle beside several short ones.
  std::vector<NodePair> free_edges;
  for (const auto &[pair, beside] : sides)
    if (beside.size() == 1) free_edges.push_back(pair);
  std::vector<int> free_nodes;
  for (const NodePair &pair : free_edges) {
    free_nodes.push_back(pair.first);
    free_nodes.push_back(pair.second);
  }
  std::sort(free_nodes.begin(), free_nodes.end());
  free_nodes.erase(std::unique(free_nodes.begin(), free_nodes.end()), free_nodes.end());
  std::vector<Box> boxes;
  for (const int n : free_nodes) boxes.push_back(around(node(n), node(n)));
  const BoxTree tree(boxes);
  const double nearer = kOneNode * extent_of(shapes_);
  for (const NodePair &pair : free_edges) {
    const Vec3 from = node(pair.first), way = node(pair.second) - from;
    std::vector<int> found;
    tree.find(widened(around(from, from + way), nearer), found);
    std::vector<std::pair<double, int>> cuts;
    for (const int k : found) {
      const int n = free_nodes[k];
      if (n == pair.first || n == pair.second) continue;
      const double part = dot(node(n) - from, way) / norm_squared(way);
      if (part > 0.0 && part < 1.0 && norm(node(n) - (from + part * way)) <= nearer)
        cuts.push_back({part, n});
    }
    if (cuts.empty()) continue;
    std::sort(cuts.begin(), cuts.end());
    const Side side = sides[pair].front();
    sides.erase(pair);
    int last = pair.first;
    for (const auto &[part, n] : cuts) {
      sides[ordered(last, n)].push_back(side);
      last = n;
    }
    sides[ordered(last, pair.second)].push_back(side);
  }

  std::vector<Link> links;
  Groups facets(count()), patches(count());
  std::vector<std::vector<int>> all_around(node_at_.size());
  edges_at_.resize(node_at_.size());
  for (const auto &[pair, beside] : sides) {
    all_around[pair.first].push_back(pair.second);
    all_around[pair.second].push_back(pair.first);
    constexpr double kHalfTurn = 3.14159265358979323846;
    SurfaceEdge edge{{pair.first, pair.second}, {}, {}, kHalfTurn, false};
    for (const Side &side : beside) {
      edge.triangles.push_back(side.triangle);
      edge.own_edges.push_back(side.edge);
    }
    if (beside.size() == 2) {
      edge.turn = turn_between(shapes_[beside[0].triangle].inwards[beside[0].edge],
                               shapes_[beside[1].triangle].inwards[beside[1].edge]);
      edge.is_smooth = edge.turn <= smooth_turn;
      if (edge.turn <= kFlatTurn) facets.join(edge.triangles[0], edge.triangles[1]);
      if (edge.turn <= kFlatTurn || edge.is_smooth) {
        patches.join(edge.triangles[0], edge.triangles[1]);
        // Two triangles of one orientation run along their common edge in opposite directions.
        const auto way = [&](const Side &side) {
          const Corners &corners = shapes_[side.triangle].corners;
          return dot(corners[(side.edge + 1) % 3] - corners[side.edge],
                     node(pair.second) - node(pair.first));
        };
        const bool opposite = way(beside[0]) * way(beside[1]) < 0.0;
        links.push_back({{edge.triangles[0], edge.triangles[1]}, opposite ? 1.0 : -1.0});
      }
      if (edge.turn <= kFlatTurn) continue;
    }
    for (const int n : edge.nodes) edges_at_[n].push_back(static_cast<int>(edges_.size()));
    edges_.push_back(std::move(edge));
  }
  facets_.resize(shapes_.size());
  patches_.resize(shapes_.size());
  for (int t = 0; t < count(); t++) {
    facets_[t] = facets.of(t);
    patches_[t] = patches.of(t);
  }
  orient(links);
  around_.resize(node_at_.size());
  for (size_t n = 0; n < node_at_.size(); n++) {
    if (edges_at_[n].empty()) continue;
    corner_nodes_.push_back(static_cast<int>(n));
    around_[n] = std::move(all_around[n]);
  }
}

void TriangleSurface::orient(const std::vector<Link> &links)
{
  std::vector<std::vector<const Link *>> at(shapes_.size());
  for (const Link &link : links)
    for (const int triangle : link.triangles) at[triangle].push_back(&link);
  orientations_.assign(shapes_.size(), 0.0);
  std::vector<int> open;
  for (int first = 0; first < count(); first++) {
    if (orientations_[first] != 0.0) continue;
    orientations_[first] = 1.0;
    open.push_back(first);
    while (!open.empty()) {
      const int triangle = open.back();
      open.pop_back();
      for (const Link *link : at[triangle]) {
        const int other = link->triangles[link->triangles[0] == triangle ? 1 : 0];
        if (orientations_[other] != 0.0) continue;
        orientations_[other] = link->orientation * orientations_[triangle];
        open.push_back(other);
      }
    }
  }
}

Segment TriangleSurface::segment(int edge) const
{
  const Vec3 &from = node(edges_[edge].nodes[0]), &to = node(edges_[edge].nodes[1]);
  const double length = norm(to - from);
  return {0.5 * (from + to), (1.0 / length) * (to - from), 0.5 * length};
}

bool TriangleSurface::are_neighbours(int a, int b) const
{
  for (const int n : nodes_[a])
    if (std::find(nodes_[b].begin(), nodes_[b].end(), n) != nodes_[b].end()) return true;
  return false;
}

}  // namespace spherocylinder
