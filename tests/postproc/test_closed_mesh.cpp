// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies given by a closed surface of triangles: volumes, parts, and what they leave of a rod.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/numbers.h"
#include "meshes.h"
#include "solid/capsule_measures.h"
#include "solid/closed_mesh.h"
#include "solid/plane_volume.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

constexpr double kTolerance = 1e-5;
const UprightBox kBox(-0.1, 0.2, -0.1, 0.1, 0.0, 0.3);

ClosedMesh mesh_of(const Triangles &triangles) { return ClosedMesh(poly_data_of(triangles)); }

// Rods about a box of 0.4 m, many of them cut.
std::vector<Capsule> some_rods(std::size_t count, double half_length = 0.06, double radius = 0.01)
{
  std::mt19937 random(32452843);
  std::uniform_real_distribution<double> place(-0.25, 0.35);
  std::vector<Capsule> rods;
  for (const Vec3 &u : random_directions(count, random))
    rods.push_back({{{place(random), place(random), place(random)}, u, half_length}, radius});
  return rods;
}

// A rod through a wall at its middle: half of it, and through the edge of a box a quarter.
TEST(ClosedMesh, HalfARod)
{
  const Triangles box = box_mesh(kBox);
  const Capsule across{{{0.2, 0, 0.1}, {1, 0, 0}, 0.05}, 0.01};
  EXPECT_NEAR(volume_inside(box, across, kTolerance).value, 0.5 * volume(across), 1e-15);
  const Capsule along{{{0.2, 0, 0.1}, {0, 0, 1}, 0.05}, 0.01};
  BoundedVolume found = volume_inside(box, along, kTolerance);
  EXPECT_NEAR(found.value, 0.5 * volume(along), found.error);
  EXPECT_LT(found.error, 1e-3 * volume(along));
  const Capsule at_edge{{{0.2, 0.1, 0.1}, {0, 0, 1}, 0.05}, 0.01};
  found = volume_inside(box, at_edge, kTolerance);
  EXPECT_NEAR(found.value, 0.25 * volume(at_edge), found.error);
  const Capsule sphere{{{0.2, 0.1, 0.3}, {0, 0, 1}, 0.0}, 0.01};
  found = volume_inside(box, sphere, kTolerance);
  EXPECT_NEAR(found.value, 0.125 * volume(sphere), found.error + 1e-20);
}

// Against the box's own sections, for rods anywhere; all sizes of length.
TEST(ClosedMesh, BoxAsClippedVolumeHasIt)
{
  int cut = 0;
  for (const double scale : {1e-6, 1.0, 1e3}) {
    const UprightBox box(scale * kBox.x_low, scale * kBox.x_high, scale * kBox.y_low,
                         scale * kBox.y_high, scale * kBox.z_low, scale * kBox.z_high);
    const Triangles mesh = box_mesh(box);
    for (Capsule rod : some_rods(300)) {
      rod.segment.centre = scale * rod.segment.centre;
      rod.segment.half_length *= scale;
      rod.radius *= scale;
      const BoundedVolume wanted = clipped_volume(rod, box, kTolerance);
      const BoundedVolume found = volume_inside(mesh, rod, kTolerance);
      EXPECT_NEAR(found.value, wanted.value, found.error + wanted.error + 1e-12 * volume(rod));
      EXPECT_LE(found.error, 20 * kTolerance * volume(rod));
      cut += wanted.value > 0.0 && wanted.value < 0.999 * volume(rod);
    }
  }
  EXPECT_GT(cut, 100);
}

// A cylinder of many facets lies in the round one, and holds the one of its sides' distance.
TEST(ClosedMesh, CylinderOfManyFacets)
{
  const double R = 0.15;
  const int facets = 90;
  const Triangles mesh = cone_mesh(R, R, 0.0, 0.3, facets);
  EXPECT_NEAR(mesh_of(mesh).volume(), 0.5 * facets * std::sin(2 * pi / facets) * R * R * 0.3,
              1e-15);
  for (const Capsule &rod : some_rods(300)) {
    const BoundedVolume outer = clipped_volume(rod, UprightCylinder{0, 0, R, 0, 0.3}, kTolerance);
    const BoundedVolume inner =
        clipped_volume(rod, UprightCylinder{0, 0, R * std::cos(pi / facets), 0, 0.3}, kTolerance);
    const BoundedVolume found = volume_inside(mesh, rod, kTolerance);
    EXPECT_GE(found.value, inner.value - inner.error - found.error - 1e-12 * volume(rod));
    EXPECT_LE(found.value, outer.value + outer.error + found.error + 1e-12 * volume(rod));
  }
}

// No convex body: what the hollow holds is missing.
TEST(ClosedMesh, BoxWithAHollow)
{
  const UprightBox hollow(-0.05, 0.1, -0.05, 0.05, 0.1, 0.2);
  const Triangles triangles = both(box_mesh(kBox), turned_over(box_mesh(hollow)));
  const ClosedMesh mesh = mesh_of(triangles);
  EXPECT_NEAR(mesh.volume(), volume(kBox) - volume(hollow), 1e-15);
  EXPECT_FALSE(mesh.is_convex());
  EXPECT_EQ(fault_of_surface(poly_data_of(triangles)), std::nullopt);
  for (const Capsule &rod : some_rods(300)) {
    const BoundedVolume outer = clipped_volume(rod, kBox, kTolerance);
    const BoundedVolume inner = clipped_volume(rod, hollow, kTolerance);
    const BoundedVolume found = volume_inside(triangles, rod, kTolerance);
    EXPECT_NEAR(found.value, outer.value - inner.value,
                outer.error + inner.error + found.error + 1e-12 * volume(rod));
  }
}

// Where a rod is said to lie its volume is.
TEST(ClosedMesh, PlaceOfARod)
{
  const ClosedMesh mesh =
      mesh_of(both(box_mesh(kBox), turned_over(box_mesh({-0.05, 0.1, -0.05, 0.05, 0.1, 0.2}))));
  int inside = 0, outside = 0;
  for (const Capsule &rod : some_rods(1000, 0.03)) {
    const double part = volume_inside(mesh.triangles(), rod, kTolerance).value / volume(rod);
    const auto place = mesh.place_of(rod);
    if (place == ClosedMesh::Place::Inside) EXPECT_NEAR(part, 1.0, 1e-3);
    if (place == ClosedMesh::Place::Outside) EXPECT_NEAR(part, 0.0, 1e-3);
    inside += place == ClosedMesh::Place::Inside;
    outside += place == ClosedMesh::Place::Outside;
  }
  EXPECT_GT(inside, 10);
  EXPECT_GT(outside, 100);
}

TEST(ClosedMesh, PartsOfABox)
{
  const ClosedMesh box = mesh_of(box_mesh(kBox));
  EXPECT_TRUE(box.is_convex());
  const auto part = box.part_within({0.0, 0.1, -0.2, 0.05, 0.1, 9.0});
  EXPECT_NEAR(part->volume(), 0.1 * 0.15 * 0.2, 1e-12);
  EXPECT_EQ(part->bounds().z_low, 0.1);
  EXPECT_EQ(part->bounds().z_high, 0.3);
  EXPECT_TRUE(part->is_convex());
  // Faces of the window in those of the box, and beyond it.
  EXPECT_NEAR(box.part_within({-0.1, 0.2, -0.1, 0.1, 0.0, 0.15})->volume(), 0.3 * 0.2 * 0.15,
              1e-12);
  EXPECT_NEAR(box.part_within({-9, 9, -9, 9, -9, 9})->volume(), volume(kBox), 1e-12);
  EXPECT_FALSE(box.part_within({-9, 9, -9, 9, 0.3, 9}));
  const auto inset = box.inset(0.02);
  EXPECT_NEAR(inset->volume(), 0.26 * 0.16 * 0.26, 1e-12);
  EXPECT_FALSE(box.inset(0.11));
  const ClosedMesh half = box.scaled(std::cbrt(0.5));
  EXPECT_NEAR(half.volume(), 0.5 * volume(kBox), 1e-12);
  EXPECT_NEAR(half.bounds().z_low, 0.15 * (1.0 - std::cbrt(0.5)), 1e-12);
}

// A hopper of n facets: A(z) = n/2 sin(2 pi/n) R(z)^2, R from 0.05 to 0.15 over 0.2.
TEST(ClosedMesh, PartOfAHopper)
{
  const int n = 40;
  const ClosedMesh hopper = mesh_of(cone_mesh(0.05, 0.15, 0.0, 0.2, n));
  constexpr double kFar = 1e9;
  for (const double z : {0.03, 0.1, 0.19}) {
    const double R = 0.05 + 0.5 * z, r = 0.05;
    const double wanted = 0.5 * n * std::sin(2 * pi / n) * z * (R * R + R * r + r * r) / 3.0;
    const auto part = hopper.part_within({-kFar, kFar, -kFar, kFar, -kFar, z});
    EXPECT_NEAR(part->volume(), wanted, 1e-9 * wanted);
    EXPECT_TRUE(part->is_convex());
  }
}

// A ball of n rings, cut anywhere, through rings of corners too: the two parts make up the whole.
TEST(ClosedMesh, PartsOfABall)
{
  const int n = 12;
  Triangles triangles;
  const auto at = [&](int ring, int i) {
    const double polar = pi * ring / n, angle = pi * (i % (2 * n)) / n;
    const double across = ring % n == 0 ? 0.0 : std::sin(polar);
    return Vec3{across * std::cos(angle), across * std::sin(angle), -std::cos(polar)};
  };
  for (int ring = 0; ring < n; ring++)
    for (int i = 0; i < 2 * n; i++) {
      const Vec3 a = at(ring, i), b = at(ring, i + 1), c = at(ring + 1, i + 1), d = at(ring + 1, i);
      if (ring > 0) triangles.push_back({a, b, c});
      if (ring < n - 1) triangles.push_back({a, c, d});
    }
  ASSERT_EQ(fault_of_surface(poly_data_of(triangles)), std::nullopt);
  const ClosedMesh ball = mesh_of(triangles);
  EXPECT_TRUE(ball.is_convex());
  EXPECT_NEAR(ball.volume(), 4.0 / 3.0 * pi, 0.15);
  // All faces are the same way further in: where many planes meet in the poles too.
  const double from_middle = std::cos(pi / (2 * n));  // of the widest faces; others a little less
  for (const double margin : {0.1, 0.5}) {
    const double scale = 1.0 - margin / from_middle;
    const double found = ball.inset(margin)->volume();
    EXPECT_NEAR(found, scale * scale * scale * ball.volume(), 0.02 * found);
  }
  const double rings[] = {-std::cos(pi / n), -std::cos(5 * pi / n), 0.0, 0.1, 0.731, 0.999};
  for (const double z : rings) {
    const auto below = ball.part_within({-2, 2, -2, 2, -2, z});
    const auto above = ball.part_within({-2, 2, -2, 2, z, 2});
    EXPECT_NEAR(below->volume() + above->volume(), ball.volume(), 1e-9) << z;
    EXPECT_NEAR(ball.part_within({-2, z, -2, 2, -2, 2})->volume() +
                    ball.part_within({z, 2, -2, 2, -2, 2})->volume(),
                ball.volume(), 1e-9)
        << z;
  }
  double octants = 0.0;
  for (int k = 0; k < 8; k++)
    octants += ball.part_within({k & 1 ? 0.0 : -2.0, k & 1 ? 2.0 : 0.0, k & 2 ? 0.0 : -2.0,
                                 k & 2 ? 2.0 : 0.0, k & 4 ? 0.0 : -2.0, k & 4 ? 2.0 : 0.0})
                   ->volume();
  EXPECT_NEAR(octants, ball.volume(), 1e-9);
}

TEST(ClosedMesh, Distance)
{
  const ClosedMesh box = mesh_of(box_mesh(kBox));
  EXPECT_NEAR(box.distance({0, 0, 0.03}), -0.03, 1e-9);
  EXPECT_NEAR(box.distance({0.23, 0.14, 0.1}), 0.05, 1e-9);
}

TEST(ClosedMesh, FaultsAreSaid)
{
  const auto fault = [](const Triangles &mesh) {
    return fault_of_surface(poly_data_of(mesh)).value_or("");
  };
  const Triangles box = box_mesh({0, 1, 0, 1, 0, 1});
  EXPECT_EQ(fault(box), "");
  Triangles open = box;
  open.pop_back();
  EXPECT_EQ(
      fault(open).find("is not closed: 3 edges belong to one triangle only, one of them at ("), 0u)
      << fault(open);
  Triangles turned = box;
  std::swap(turned[3].a, turned[3].b);
  EXPECT_EQ(
      fault(turned),
      "has 3 edges of which one triangle faces inwards and the other outwards, wanted all outwards");
  EXPECT_EQ(
      fault(turned_over(box)),
      "has triangles that face inwards: they enclose -1 m^3, wanted > 0, all facing outwards");
  const Triangles touching = both(box, box_mesh({1, 2, 1, 2, 0, 1}));
  EXPECT_EQ(fault(touching).find(
                "has 1 edges that belong to more than two triangles, one of them at (1, 1, "),
            0u)
      << fault(touching);
}

}  // namespace
}  // namespace spherocylinder
