// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/triangle_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "core/box_tree.h"
#include "core/numbers.h"

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
std::int64_t pair_number(int a, int b)
{
  const auto [lower, higher] = ordered(a, b);
  return (static_cast<std::int64_t>(lower) << 32) + higher;
}

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
    weights[k] =
        dot(point - from, shape.inwards[edge]) / dot(shape.corners[k] - from, shape.inwards[edge]);
  }
  return weights;
}

TriangleSurface::TriangleSurface(std::vector<Corners> triangles, double smooth_turn)
{
  shapes_.reserve(triangles.size());
  for (const Corners &corners : triangles) shapes_.push_back(shape_of(corners));
  if (shapes_.empty()) return;
  one_node_ = kOneNode * extent_of(shapes_);
  join_nodes();
  Sides sides = all_sides();
  cut_free_edges(sides);
  find_edges(sides, smooth_turn);
  join_pieces();
}

void TriangleSurface::move_to(const std::vector<Corners> &triangles)
{
  for (size_t t = 0; t < triangles.size(); t++) shapes_[t] = shape_of(triangles[t]);
}

// Cells of many times the distance hold the nodes; a corner near the border of its cell looks beyond it.
void TriangleSurface::join_nodes()
{
  const double nearer = one_node_, cell = 64.0 * nearer;
  struct Hash {
    size_t operator()(const std::array<std::int64_t, 3> &key) const
    {
      const auto part = [&](int d, std::uint64_t factor) {
        return static_cast<std::uint64_t>(key[d]) * factor;
      };
      return static_cast<size_t>(part(0, 73856093) ^ part(1, 19349663) ^ part(2, 83492791));
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

TriangleSurface::Sides TriangleSurface::all_sides() const
{
  Sides sides;
  for (int t = 0; t < count(); t++)
    for (int k = 0; k < 3; k++)
      sides[ordered(nodes_[t][k], nodes_[t][(k + 1) % 3])].push_back({t, k});
  return sides;
}

// A free edge that other free edges end on is cut there: a long triangle beside several short ones.
void TriangleSurface::cut_free_edges(Sides &sides)
{
  through_.resize(node_at_.size());
  std::vector<NodePair> free_edges;
  std::vector<int> free_nodes;
  for (const auto &[pair, beside] : sides) {
    if (beside.size() != 1) continue;
    free_edges.push_back(pair);
    free_nodes.push_back(pair.first);
    free_nodes.push_back(pair.second);
  }
  std::sort(free_nodes.begin(), free_nodes.end());
  free_nodes.erase(std::unique(free_nodes.begin(), free_nodes.end()), free_nodes.end());
  std::vector<Box> boxes;
  for (const int n : free_nodes) boxes.push_back(around(node(n), node(n)));
  const BoxTree tree(boxes);
  for (const NodePair &pair : free_edges) {
    const Vec3 from = node(pair.first), way = node(pair.second) - from;
    std::vector<int> found;
    tree.find(widened(around(from, from + way), one_node_), found);
    std::vector<std::pair<double, int>> cuts;
    for (const int k : found) {
      const int n = free_nodes[k];
      if (n == pair.first || n == pair.second) continue;
      const double part = dot(node(n) - from, way) / norm_squared(way);
      if (part > 0.0 && part < 1.0 && norm(node(n) - (from + part * way)) <= one_node_)
        cuts.push_back({part, n});
    }
    if (cuts.empty()) continue;
    std::sort(cuts.begin(), cuts.end());
    const TrianglePart side = sides[pair].front();
    sides.erase(pair);
    int last = pair.first;
    for (const auto &[part, n] : cuts) {
      sides[ordered(last, n)].push_back(side);
      through_[n].push_back(side);
      last = n;
    }
    sides[ordered(last, pair.second)].push_back(side);
  }
}

void TriangleSurface::find_edges(const Sides &sides, double smooth_turn)
{
  std::vector<Link> links;
  Groups facets(count()), patches(count());
  std::vector<std::vector<int>> all_around(node_at_.size());
  edges_at_.resize(node_at_.size());
  flat_edges_.assign(shapes_.size(), {false, false, false});
  for (const auto &side_of_pair : sides) {
    const std::pair<int, int> &pair = side_of_pair.first;
    const std::vector<TrianglePart> &beside = side_of_pair.second;
    all_around[pair.first].push_back(pair.second);
    all_around[pair.second].push_back(pair.first);
    SurfaceEdge edge{{pair.first, pair.second}, beside, pi, false, {{1.0, beside}}};
    if (beside.size() == 2) {
      const int one = beside[0].triangle, other = beside[1].triangle;
      edge.turn = turn_between(shapes_[one].inwards[beside[0].number],
                               shapes_[other].inwards[beside[1].number]);
      edge.is_smooth = edge.turn <= smooth_turn;
      const bool is_flat = edge.turn <= kFlatTurn;
      if (is_flat) {
        facets.join(one, other);
        for (const TrianglePart &side : beside) flat_edges_[side.triangle][side.number] = true;
      }
      if (is_flat || edge.is_smooth) {
        patches.join(one, other);
        // Two triangles of one orientation run along their common edge in opposite directions.
        const auto way = [&](const TrianglePart &side) {
          const Corners &corners = shapes_[side.triangle].corners;
          return dot(corners[(side.number + 1) % 3] - corners[side.number],
                     node(pair.second) - node(pair.first));
        };
        links.push_back({{one, other}, way(beside[0]) * way(beside[1]) < 0.0 ? 1.0 : -1.0});
      }
      if (is_flat) continue;
    }
    for (const int n : edge.nodes) edges_at_[n].push_back(static_cast<int>(edges_.size()));
    edges_.push_back(std::move(edge));
  }
  facets_.resize(shapes_.size());
  patches_.resize(shapes_.size());
  next_of_facet_.resize(shapes_.size());
  std::vector<int> last_of_facet(shapes_.size(), -1);
  for (int t = 0; t < count(); t++) {
    facets_[t] = facets.of(t);
    patches_[t] = patches.of(t);
    int &last = last_of_facet[facets_[t]];
    next_of_facet_[t] = last < 0 ? t : next_of_facet_[last];
    if (last >= 0) next_of_facet_[last] = t;
    last = t;
  }
  for (const SurfaceEdge &edge : edges_)
    if (edge.is_smooth)
      smooth_pairs_.insert(
          pair_number(facets_[edge.beside[0].triangle], facets_[edge.beside[1].triangle]));
  orient(links);
  around_ = std::move(all_around);
}

bool TriangleSurface::meet_smoothly(int facet, int other) const
{
  return smooth_pairs_.count(pair_number(facet, other)) != 0;
}

// A node with two edges that go on straight between the same facets is within one edge.
void TriangleSurface::join_pieces()
{
  const auto is_within = [&](int n) {
    if (edges_at_[n].size() != 2) return false;
    const SurfaceEdge &one = edges_[edges_at_[n][0]], &other = edges_[edges_at_[n][1]];
    if (one.beside.size() != other.beside.size() || one.beside.size() > 2) return false;
    const auto facets = [&](const SurfaceEdge &edge) {
      const int a = facets_[edge.beside.front().triangle], b = facets_[edge.beside.back().triangle];
      return ordered(a, b);
    };
    if (facets(one) != facets(other)) return false;
    const Vec3 &at = node(n);
    const Vec3 to = node(one.nodes[one.nodes[0] == n ? 1 : 0]) - at;
    const Vec3 from = node(other.nodes[other.nodes[0] == n ? 1 : 0]) - at;
    return dot(to, from) < 0.0 && norm(cross(to, from)) <= kFlatTurn * norm(to) * norm(from);
  };
  std::vector<bool> within(node_at_.size());
  for (size_t n = 0; n < node_at_.size(); n++) within[n] = is_within(static_cast<int>(n));

  std::vector<SurfaceEdge> joined;
  std::vector<bool> is_done(edges_.size(), false);
  const auto begin_at = [&](int edge, int from) {
    SurfaceEdge whole = edges_[edge];
    whole.pieces.clear();
    whole.nodes[0] = from;
    const Vec3 start = node(from);
    double length = 0.0;
    for (int at = from; !is_done[edge];) {
      is_done[edge] = true;
      const SurfaceEdge &piece = edges_[edge];
      const int next = piece.nodes[0] == at ? piece.nodes[1] : piece.nodes[0];
      length = norm(node(next) - start);
      std::vector<TrianglePart> beside = piece.beside;
      if (beside.size() == 2 && facets_[beside[0].triangle] != facets_[whole.beside[0].triangle])
        std::swap(beside[0], beside[1]);
      whole.pieces.push_back({length, beside});
      whole.nodes[1] = at = next;
      if (!within[at]) break;
      edge = edges_at_[at][0] == edge ? edges_at_[at][1] : edges_at_[at][0];
    }
    for (SurfaceEdge::Piece &piece : whole.pieces) piece.end /= length;
    joined.push_back(std::move(whole));
  };
  for (size_t e = 0; e < edges_.size(); e++)
    for (const int n : edges_[e].nodes)
      if (!is_done[e] && !within[n]) begin_at(static_cast<int>(e), n);
  edges_ = std::move(joined);

  for (size_t n = 0; n < node_at_.size(); n++) edges_at_[n].clear();
  for (size_t e = 0; e < edges_.size(); e++)
    for (const int n : edges_[e].nodes) edges_at_[n].push_back(static_cast<int>(e));
  for (size_t n = 0; n < node_at_.size(); n++) {
    if (edges_at_[n].empty())
      around_[n].clear();
    else
      corner_nodes_.push_back(static_cast<int>(n));
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
