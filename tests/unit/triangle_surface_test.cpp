// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles as a surface: facets, edges, corners and patches of shapes whose numbers are known.
#include "core/triangle_surface.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "surface_reference.h"

using namespace spherocylinder;

namespace {

int facets_of(const TriangleSurface &surface)
{
  std::set<int> all;
  for (int t = 0; t < surface.count(); t++) all.insert(surface.facet(t));
  return static_cast<int>(all.size());
}
int patches_of(const TriangleSurface &surface)
{
  std::set<int> all;
  for (int t = 0; t < surface.count(); t++) all.insert(surface.patch(t));
  return static_cast<int>(all.size());
}
int free_edges_of(const TriangleSurface &surface)
{
  return static_cast<int>(
      std::count_if(surface.edges().begin(), surface.edges().end(),
                    [](const SurfaceEdge &edge) { return edge.beside.size() == 1; }));
}

Mesh mapped(const Mesh &mesh, double scale, const Vec3 &shift)
{
  Mesh all;
  for (const auto &[a, b, c] : mesh)
    all.push_back({scale * a + shift, scale * b + shift, scale * c + shift});
  return all;
}

// Two triangles at an edge along y of length 2, bent by `turn`.
Mesh hinge(double turn)
{
  const Vec3 a = {0.0, -1.0, 0.0}, b = {0.0, 1.0, 0.0};
  return {{a, b, {-1.0, 0.0, 0.0}}, {a, b, {std::cos(turn), 0.0, std::sin(turn)}}};
}

// Pieces of equal length, and beside each a triangle of each facet, in the order of the whole edge.
void expect_pieces(const TriangleSurface &surface, const SurfaceEdge &edge, int count)
{
  ASSERT_EQ(static_cast<int>(edge.pieces.size()), count);
  for (int k = 0; k < count; k++) {
    EXPECT_NEAR(edge.pieces[k].end, (k + 1.0) / count, 1e-12);
    const Vec3 from = surface.node(edge.nodes[0]), to = surface.node(edge.nodes[1]);
    const Vec3 middle = from + ((k + 0.5) / count) * (to - from);
    ASSERT_EQ(edge.pieces[k].beside.size(), edge.beside.size());
    for (size_t side = 0; side < edge.beside.size(); side++) {
      const auto &[triangle, number] = edge.pieces[k].beside[side];
      EXPECT_EQ(surface.facet(triangle), surface.facet(edge.beside[side].triangle));
      const Corners &corners = surface.shape(triangle).corners;
      const Vec3 along = corners[(number + 1) % 3] - corners[number];
      const double size = norm(along);
      EXPECT_LT(norm(cross(middle - corners[number], along)), 1e-6 * size * size);
      EXPECT_LT(nearest_on_triangle(corners, middle).distance, 1e-6 * size);
    }
  }
}

void add_rectangle(Mesh &mesh, const Vec3 &at, const Vec3 &a, const Vec3 &b)
{
  mesh.push_back({at, at + a, at + a + b});
  mesh.push_back({at, at + a + b, at + b});
}

}  // namespace

// Closed form: a right triangle in the plane z = 2.
TEST(TriangleShape, OfARightTriangle)
{
  const TriangleShape shape = shape_of({Vec3{0.0, 0.0, 2.0}, {3.0, 0.0, 2.0}, {0.0, 4.0, 2.0}});
  EXPECT_DOUBLE_EQ(shape.normal.z, 1.0);
  EXPECT_DOUBLE_EQ(shape.inwards[0].y, 1.0);
  EXPECT_DOUBLE_EQ(shape.inwards[1].x, -0.8);
  EXPECT_DOUBLE_EQ(shape.inwards[1].y, -0.6);
  EXPECT_DOUBLE_EQ(shape.inwards[2].x, 1.0);
  EXPECT_DOUBLE_EQ(shape.height({7.0, 8.0, -1.0}), -3.0);
  EXPECT_TRUE(shape.holds_foot({1.0, 1.0, 9.0}, 0.0));
  EXPECT_TRUE(shape.holds_foot({0.0, 0.0, -9.0}, 0.0));
  EXPECT_FALSE(shape.holds_foot({-0.1, 1.0, 2.0}, 0.0));
  EXPECT_TRUE(shape.holds_foot({-0.1, 1.0, 2.0}, 0.11));
  EXPECT_FALSE(shape.holds_foot({-0.1, 1.0, 2.0}, -0.11));
}

// Closed form: weights w with sum w = 1 and sum w_k corner_k = the point.
TEST(TriangleShape, BarycentricWeightsRebuildThePoint)
{
  RandomRods random(15485863);
  for (int k = 0; k < 10000; k++) {
    const double size = random.log_uniform(1e-6, 1e3);
    const Corners c = {random.vector(size), random.vector(size), random.vector(size)};
    double longest = 0.0;
    for (int i = 0; i < 3; i++) longest = std::max(longest, norm(c[(i + 1) % 3] - c[i]));
    const double height = norm(cross(c[1] - c[0], c[2] - c[0])) / longest;
    const double u = random.uniform(-1.0, 2.0), v = random.uniform(-1.0, 2.0);
    const Vec3 point = c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]);
    const std::array<double, 3> w = barycentric(shape_of(c), point);
    const double bound = 100.0 * kEpsilon * (size / height) * (longest / height);
    EXPECT_NEAR(w[0], 1.0 - u - v, bound);
    EXPECT_NEAR(w[1], u, bound);
    EXPECT_NEAR(w[2], v, bound);
    EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, bound);
  }
}

TEST(TriangleSurface, OfNothingHasNothing)
{
  EXPECT_EQ(TriangleSurface().count(), 0);
  const TriangleSurface surface({}, 0.1);
  EXPECT_EQ(surface.count(), 0);
  EXPECT_TRUE(surface.edges().empty());
  EXPECT_TRUE(surface.corner_nodes().empty());
}

// Known: 6 faces, 12 edges, 8 corners, all at right angles; of any size, anywhere, in any order of
// corners, finely cut or not.
TEST(TriangleSurface, OfABox)
{
  RandomRods random(104729);
  for (const double size : kDiameters)
    for (const double away : {0.0, 100.0}) {
      Mesh mesh = mapped(box_mesh({1.0, 2.0, 3.0}), size, away * size * Vec3{1.0, -2.0, 0.7});
      for (Corners &corners : mesh)
        if (random.below(2)) std::swap(corners[0], corners[2]);
      const TriangleSurface surface(mesh, 1.0);
      EXPECT_EQ(surface.count(), 12);
      EXPECT_EQ(facets_of(surface), 6);
      EXPECT_EQ(patches_of(surface), 6);
      ASSERT_EQ(surface.edges().size(), 12u);
      EXPECT_EQ(surface.corner_nodes().size(), 8u);
      for (const SurfaceEdge &edge : surface.edges()) {
        EXPECT_NEAR(edge.turn, 0.5 * kPi, 1e-12);
        EXPECT_FALSE(edge.is_smooth);
        ASSERT_EQ(edge.beside.size(), 2u);
        EXPECT_NE(surface.facet(edge.beside[0].triangle), surface.facet(edge.beside[1].triangle));
        EXPECT_TRUE(surface.are_neighbours(edge.beside[0].triangle, edge.beside[1].triangle));
      }
      for (const int corner : surface.corner_nodes()) {
        EXPECT_EQ(surface.edges_at(corner).size(), 3u);
        EXPECT_GE(surface.nodes_around(corner).size(), 3u);  // and over diagonals
        EXPECT_LE(surface.nodes_around(corner).size(), 6u);
        const Corners &corners = surface.shape(surface.triangle_at(corner)).corners;
        EXPECT_TRUE(std::any_of(corners.begin(), corners.end(), [&](const Vec3 &at) {
          return norm(at - surface.node(corner)) == 0.0;
        }));
      }
      const TriangleSurface finer(four_for_one(mesh), 1.0);
      EXPECT_EQ(facets_of(finer), 6);
      EXPECT_EQ(finer.edges().size(), 12u);  // of two pieces each: their middles are no corners
      EXPECT_EQ(finer.corner_nodes().size(), 8u);
      for (const SurfaceEdge &edge : finer.edges()) expect_pieces(finer, edge, 2);
    }
}

// Closed form: the segment of an edge goes from one of its nodes to the other.
TEST(TriangleSurface, SegmentsJoinTheirNodes)
{
  RandomRods random(15487469);
  const TriangleSurface surface(hull_mesh(random, 12), 0.0);
  for (size_t e = 0; e < surface.edges().size(); e++) {
    const Segment segment = surface.segment(static_cast<int>(e));
    const auto &nodes = surface.edges()[e].nodes;
    EXPECT_LT(norm(segment.at(-segment.half_length) - surface.node(nodes[0])), 1e-14);
    EXPECT_LT(norm(segment.at(segment.half_length) - surface.node(nodes[1])), 1e-14);
    EXPECT_NEAR(norm(segment.axis), 1.0, 1e-14);
  }
}

// Euler: a closed surface of V corners has 3 V - 6 edges and 2 V - 4 triangles.
TEST(TriangleSurface, OfConvexPolyhedra)
{
  RandomRods random(32452843);
  for (int k = 0; k < 100; k++) {
    const int points = 4 + random.below(12);
    const TriangleSurface surface(hull_mesh(random, points), 0.0);
    EXPECT_EQ(surface.count(), 2 * points - 4);
    EXPECT_EQ(static_cast<int>(surface.edges().size()), 3 * points - 6);
    EXPECT_EQ(static_cast<int>(surface.corner_nodes().size()), points);
    EXPECT_EQ(free_edges_of(surface), 0);
  }
}

// Closed form: n seams that turn by 2 pi/n and n free edges at either end; smooth from there on.
TEST(TriangleSurface, OfATubeIsSmoothFromItsTurnOn)
{
  for (const int n : {6, 16, 64}) {
    const double turn = 2.0 * kPi / n;
    const TriangleSurface sharp(tube_mesh(n, 1.0, 0.1), 0.999 * turn),
        smooth(tube_mesh(n, 1.0, 0.1), 1.001 * turn);
    EXPECT_EQ(facets_of(smooth), n);
    EXPECT_EQ(patches_of(sharp), n);
    EXPECT_EQ(patches_of(smooth), 1);
    ASSERT_EQ(static_cast<int>(smooth.edges().size()), 3 * n);
    EXPECT_EQ(free_edges_of(smooth), 2 * n);
    for (const SurfaceEdge &edge : smooth.edges()) {
      const bool is_free = edge.beside.size() == 1;
      EXPECT_NEAR(edge.turn, is_free ? kPi : turn, 1e-12);
      EXPECT_EQ(edge.is_smooth, !is_free);
    }
  }
}

// Closed form: the angle of the hinge, whichever way the triangles are oriented.
TEST(TriangleSurface, TurnIsThatOfTheHinge)
{
  for (const double turn : {1e-4, 0.1, 1.0, 2.0, 3.0, 3.14})
    for (const bool flip : {false, true}) {
      Mesh mesh = hinge(turn);
      if (flip) std::swap(mesh[1][0], mesh[1][1]);
      const TriangleSurface surface(mesh, 0.0);
      ASSERT_EQ(surface.edges().size(), 5u);
      EXPECT_EQ(facets_of(surface), 2);
      double found = kPi;
      for (const SurfaceEdge &edge : surface.edges()) found = std::min(found, edge.turn);
      EXPECT_NEAR(found, turn, 1e-12);
    }
}

// What single precision bends stays one facet; its middle edge is none.
TEST(TriangleSurface, FacetsThatHardlyTurnAreOne)
{
  for (const double turn : {0.0, 1e-7, 5e-6}) {
    const TriangleSurface surface(hinge(turn), 0.0);
    EXPECT_EQ(facets_of(surface), 1);
    EXPECT_EQ(patches_of(surface), 1);
    EXPECT_EQ(surface.edges().size(), 4u);
  }
  EXPECT_EQ(facets_of(TriangleSurface(hinge(2e-5), 0.0)), 2);
}

// Corners nearer than some 1e-7 of the surface's size are one, those ten times farther are not.
TEST(TriangleSurface, NearCornersAreOneNode)
{
  RandomRods random(49979687);
  for (const double size : kDiameters)
    for (const double off : {0.0, 1e-8, 5e-8, 3e-6}) {
      Mesh mesh = mapped(box_mesh({1.0, 1.0, 1.0}), size, {3.0 * size, 0.0, size});
      for (Corners &corners : mesh)
        for (Vec3 &corner : corners)
          corner = corner + 0.5 * off * size * std::sqrt(12.0) * random.direction();
      const TriangleSurface surface(mesh, 0.0);
      if (off < 1e-6) {
        EXPECT_EQ(surface.corner_nodes().size(), 8u);
        EXPECT_EQ(surface.edges().size(), 12u);
        EXPECT_EQ(free_edges_of(surface), 0);
      } else {
        EXPECT_GT(free_edges_of(surface), 0);
      }
    }
}

// A floor of strips cut into 1, 7, 5 and 1 rectangles: one facet, its edges those of the rim.
TEST(TriangleSurface, TJunctionsOfAFlatFloorAreNoEdges)
{
  for (const double size : kDiameters) {
    Mesh mesh;
    const int pieces[] = {1, 7, 5, 1};
    for (int strip = 0; strip < 4; strip++)
      for (int k = 0; k < pieces[strip]; k++) {
        const double step = 20.0 / pieces[strip];
        add_rectangle(mesh, {3.0 * strip, step * k, 0.0}, {3.0, 0.0, 0.0}, {0.0, step, 0.0});
      }
    const TriangleSurface surface(mapped(mesh, size, {0.0, 0.0, size}), 0.0);
    EXPECT_EQ(facets_of(surface), 1);
    EXPECT_EQ(surface.edges().size(), 4u);  // two of one piece, two of four
    EXPECT_EQ(free_edges_of(surface), 4);
    for (const SurfaceEdge &edge : surface.edges())
      for (const int n : edge.nodes) {
        const Vec3 at = (1.0 / size) * surface.node(n);
        const bool on_rim = at.x == 0.0 || std::fabs(at.x - 12.0) < 1e-9 || at.y == 0.0 ||
                            std::fabs(at.y - 20.0) < 1e-9;
        EXPECT_TRUE(on_rim) << at.x << " " << at.y;
      }
  }
}

// A floor of one rectangle above a wall of three: the ridge between both is one edge of three
// pieces.
TEST(TriangleSurface, TJunctionsOfARidgeArePieces)
{
  Mesh mesh;
  add_rectangle(mesh, {0.0, 0.0, 0.0}, {-5.0, 0.0, 0.0}, {0.0, 9.0, 0.0});
  for (int k = 0; k < 3; k++)
    add_rectangle(mesh, {0.0, 3.0 * k, 0.0}, {0.0, 0.0, -4.0}, {0.0, 3.0, 0.0});
  const TriangleSurface surface(mesh, 0.0);
  EXPECT_EQ(facets_of(surface), 2);
  int at_ridge = 0;
  for (const SurfaceEdge &edge : surface.edges()) {
    if (edge.beside.size() != 2) continue;
    at_ridge++;
    EXPECT_NEAR(edge.turn, 0.5 * kPi, 1e-12);
    EXPECT_NEAR(norm(surface.node(edge.nodes[0]) - surface.node(edge.nodes[1])), 9.0, 1e-12);
    expect_pieces(surface, edge, 3);
  }
  EXPECT_EQ(at_ridge, 1);
  EXPECT_EQ(free_edges_of(surface), 3 + 3);
  int within = 0;
  for (int n = 0; n < 10; n++) within += surface.triangles_through(n).empty() ? 0 : 1;
  EXPECT_EQ(within, 2);
}

// Three triangles at one edge: it is sharp and all bear it.
TEST(TriangleSurface, BranchedEdgesHaveAllTriangles)
{
  Mesh mesh = hinge(0.1);
  mesh.push_back({mesh[0][0], mesh[0][1], {0.0, 0.0, 1.0}});
  const TriangleSurface surface(mesh, 1.0);
  size_t most = 0;
  for (const SurfaceEdge &edge : surface.edges()) {
    most = std::max(most, edge.beside.size());
    EXPECT_FALSE(edge.is_smooth);
  }
  EXPECT_EQ(most, 3u);
  EXPECT_EQ(patches_of(surface), 3);
}

// Moved as one body: what was found stays, places are the new ones.
TEST(TriangleSurface, MovesAsOneBody)
{
  RandomRods random(15485863);
  const Mesh mesh = hull_mesh(random, 9);
  TriangleSurface surface(mesh, 0.0);
  const Vec3 about = random.direction(), shift = random.vector(10.0);
  Mesh moved;
  for (const Corners &corners : mesh) {
    Corners there;
    for (int k = 0; k < 3; k++) there[k] = turned(corners[k], about, 1.3L) + shift;
    moved.push_back(there);
  }
  const TriangleSurface before = surface;
  surface.move_to(moved);
  ASSERT_EQ(surface.edges().size(), before.edges().size());
  for (int t = 0; t < surface.count(); t++) {
    EXPECT_EQ(norm(surface.shape(t).normal - shape_of(moved[t]).normal), 0.0);
    EXPECT_EQ(surface.facet(t), before.facet(t));
  }
  for (const int n : surface.corner_nodes())
    EXPECT_LT(norm(surface.node(n) - (turned(before.node(n), about, 1.3L) + shift)), 1e-14);
}

// A sparse hash of whole numbers: a small surface far away has large ones (a run under the
// sanitizer of undefined behaviour says whether they fit).
TEST(TriangleSurface, MayBeSmallAndFarAway)
{
  const double size = 1e-6;
  const TriangleSurface surface(mapped(box_mesh({1.0, 1.0, 1.0}), size, {1000.0, -500.0, 20.0}),
                                0.0);
  EXPECT_EQ(surface.corner_nodes().size(), 8u);
  EXPECT_EQ(surface.edges().size(), 12u);
}
