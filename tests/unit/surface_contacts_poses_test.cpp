// SPDX-License-Identifier: GPL-2.0-or-later
// Poses whose contacts can be told by hand: over edges, corners and seams, on floors however tiled,
// in boxes and tubes. Radius 1 if nothing else is said.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/surface_contacts.h"
#include "surface_contacts_support.h"
#include "surface_reference.h"

using namespace spherocylinder;

namespace {

struct Expected {
  OnRod place;
  Vec3 surface_point, normal;
  double distance, weight;
};

Expected at(OnRod place, const Vec3 &point, const Vec3 &normal, double distance,
            double weight = 1.0)
{
  return {place, point, normal, distance, weight};
}

// Empty if the contacts are those, else what they are.
std::string difference(const Contacts &contacts, const Capsule &rod,
                       const std::vector<Expected> &expected, double tolerance)
{
  bool same = contacts.size() == expected.size();
  for (const Expected &one : expected) {
    int found = 0;
    for (const SurfaceContact &c : contacts)
      if (c.place == one.place && norm(c.normal - one.normal) <= tolerance &&
          norm(c.on_surface(rod.segment) - one.surface_point) <= tolerance &&
          std::fabs(c.distance - one.distance) <= tolerance &&
          std::fabs(c.weight - one.weight) <= tolerance)
        found++;
    same = same && found == 1;
  }
  return same ? "" : text_of(rod) + text_of(contacts);
}

Vec3 unit(const Vec3 &a) { return RandomRods::unit(a); }

constexpr Vec3 kUp = {0.0, 0.0, 1.0};
constexpr OnRod kMinus = OnRod::kEndMinus, kPlus = OnRod::kEndPlus, kBetween = OnRod::kBetween;

struct Pose {
  const char *name;
  Capsule rod;
  std::vector<Expected> expected;
};
void PrintTo(const Pose &pose, std::ostream *out) { *out << pose.name; }

// On a cube of half edge 5, its top at z = 5 with a diagonal along x = y; overlap 0.1.
const std::vector<Pose> &poses_on_cube()
{
  const auto standing = [](double x, double y) -> Capsule {
    return {{{x, y, 8.9}, kUp, 3.0}, 1.0};
  };
  const auto lying = [](double x, double y, const Vec3 &axis, double half) -> Capsule {
    return {{{x, y, 5.9}, unit(axis), half}, 1.0};
  };
  const auto on_top = [](OnRod place, double x, double y) {
    return at(place, {x, y, 5.0}, kUp, 0.9);
  };
  const Vec3 x = {1.0, 0.0, 0.0}, y = {0.0, 1.0, 0.0}, out = unit({1.0, 0.0, 1.0});
  const double s = 3.0 / std::sqrt(2.0);
  const auto on_ridge = [&](double place) -> Capsule {  // across it, as steep to either side
    return {{Vec3{5.0, place, 5.0} + 0.9 * out, unit({1.0, 0.0, -1.0}), 3.0}, 1.0};
  };
  static const std::vector<Pose> all = {
      {"StandingOnFace", standing(1.0, 0.3), {on_top(kMinus, 1.0, 0.3)}},
      {"StandingOnDiagonal", standing(2.0, 2.0), {on_top(kMinus, 2.0, 2.0)}},
      {"StandingOnEdge", standing(5.0, 0.3), {on_top(kMinus, 5.0, 0.3)}},
      {"StandingOnCorner", standing(5.0, 5.0), {on_top(kMinus, 5.0, 5.0)}},
      {"StandingOnCornerWithDiagonal", standing(-5.0, -5.0), {on_top(kMinus, -5.0, -5.0)}},
      {"LyingOnFace",
       lying(0.5, 1.0, x, 3.0),
       {on_top(kMinus, -2.5, 1.0), on_top(kPlus, 3.5, 1.0)}},
      {"LyingAlongDiagonal",
       lying(0.0, 0.0, {1.0, 1.0, 0.0}, 3.0),
       {on_top(kMinus, -s, -s), on_top(kPlus, s, s)}},
      {"LyingAcrossDiagonal",
       lying(0.0, 0.0, {1.0, -1.0, 0.0}, 3.0),
       {on_top(kMinus, -s, s), on_top(kPlus, s, -s)}},
      {"LyingAlongEdge",
       lying(5.0, 0.0, y, 3.0),
       {on_top(kMinus, 5.0, -3.0), on_top(kPlus, 5.0, 3.0)}},
      {"LyingAlongLongerThanEdge",
       lying(5.0, 0.0, y, 8.0),
       {on_top(kBetween, 5.0, -5.0), on_top(kBetween, 5.0, 5.0)}},
      {"LyingAcrossWholeFace",
       lying(1.0, 0.5, y, 8.0),
       {on_top(kBetween, 1.0, -5.0), on_top(kBetween, 1.0, 5.0)}},
      {"LyingAcrossEdge",
       lying(5.0, 0.0, x, 3.0),
       {on_top(kMinus, 2.0, 0.0), on_top(kBetween, 5.0, 0.0)}},
      {"LyingEndOverEdge",
       lying(2.0, 0.0, x, 3.0),
       {on_top(kMinus, -1.0, 0.0), on_top(kPlus, 5.0, 0.0)}},
      {"LyingEndOverEdgeFromOutside", lying(8.0, 0.0, x, 3.0), {on_top(kMinus, 5.0, 0.0)}},
      {"LyingEndOverCorner",
       lying(2.0, 5.0, x, 3.0),
       {on_top(kMinus, -1.0, 5.0), on_top(kPlus, 5.0, 5.0)}},
      {"LyingAlongEdgePastCorner",
       lying(5.0, 5.0, x, 3.0),
       {on_top(kMinus, 2.0, 5.0), on_top(kBetween, 5.0, 5.0)}},
      {"LyingAcrossCorner", lying(5.0, 5.0, {1.0, -1.0, 0.0}, 3.0), {on_top(kBetween, 5.0, 5.0)}},
      {"LyingOutOverCorner",
       lying(5.0, 5.0, {1.0, 1.0, 0.0}, 3.0),
       {on_top(kMinus, 5.0 - s, 5.0 - s), on_top(kBetween, 5.0, 5.0)}},
      {"AcrossRidge", on_ridge(0.3), {at(kBetween, {5.0, 0.3, 5.0}, out, 0.9)}},
      {"AcrossRidgeAtItsEnd", on_ridge(5.0), {at(kBetween, {5.0, 5.0, 5.0}, out, 0.9)}},
      {"AcrossRidgeHardlyBeforeItsEnd",
       on_ridge(5.0 - 1e-7),
       {at(kBetween, {5.0, 5.0 - 1e-7, 5.0}, out, 0.9)}},
  };
  return all;
}

class OnCube : public testing::TestWithParam<Pose> {
 protected:
  const TriangleSurface surface_{box_mesh({5.0, 5.0, 5.0}), 0.0};
};

}  // namespace

// Closed form: read off the figure; one contact at a place, and none missing.
TEST_P(OnCube, HasTheContactsOfThePose)
{
  const auto &[name, rod, expected] = GetParam();
  EXPECT_EQ(difference(contacts_of(rod, surface_), rod, expected, 1e-7), "");
  // A cube whose faces are of eight triangles.
  const TriangleSurface finer(four_for_one(box_mesh({5.0, 5.0, 5.0})), 0.0);
  EXPECT_EQ(difference(contacts_of(rod, finer), rod, expected, 1e-7), "") << "of more triangles";
}

// And nearly the same load anywhere near: it changes by no more than a few times the way.
TEST_P(OnCube, LoadIsContinuous)
{
  RandomRods random(15485863);
  const Capsule rod = GetParam().rod;
  for (const SurfaceEdge &edge : surface_.edges()) {  // an axis that gets parallel to one may jump
    const Vec3 a = surface_.node(edge.nodes[0]), b = surface_.node(edge.nodes[1]);
    const double distance = norm(cross(rod.segment.centre - a, unit(b - a)));
    if (norm(cross(rod.segment.axis, unit(b - a))) == 0.0 && distance <= rod.radius) return;
  }
  const Load load = load_of(contacts_of(rod, surface_), rod);
  Failures jumps;
  for (int k = 0; k < 1000; k++) {
    const double way = random.log_uniform(1e-12, 1e-6);
    Capsule moved = rod;
    moved.segment.centre = rod.segment.centre + way * random.direction();
    moved.segment.axis = unit(rod.segment.axis + way * random.direction());
    const Contacts contacts = contacts_of(moved, surface_);
    const double change = difference(load_of(contacts, moved), load, rod);
    jumps.add(change > 100.0 * way + 1e-4, text_of(moved) + text_of(contacts) + "\nbefore" +
                                               text_of(contacts_of(rod, surface_)));
  }
  EXPECT_EQ(jumps.count(), 0) << jumps.text();
}

INSTANTIATE_TEST_SUITE_P(Poses, OnCube, testing::ValuesIn(poses_on_cube()),
                         [](const auto &info) { return std::string(info.param.name); });

// ---- floors -------------------------------------------------------------------------------------

namespace {

void add_rectangle(Mesh &mesh, double x0, double x1, double y0, double y1)
{
  mesh.push_back({Vec3{x0, y0, 0.0}, Vec3{x1, y0, 0.0}, Vec3{x1, y1, 0.0}});
  mesh.push_back({Vec3{x0, y0, 0.0}, Vec3{x1, y1, 0.0}, Vec3{x0, y1, 0.0}});
}

Mesh two_triangles()
{
  Mesh mesh;
  add_rectangle(mesh, -10.0, 10.0, -10.0, 10.0);
  return mesh;
}

Mesh fan(int count)
{
  Mesh mesh;
  const auto rim = [&](int k) -> Vec3 {
    const double angle = 2.0 * kPi * (k % count) / count;
    return {10.0 * std::cos(angle), 10.0 * std::sin(angle), 0.0};
  };
  for (int k = 0; k < count; k++) mesh.push_back({Vec3{0.3, 0.2, 0.0}, rim(k), rim(k + 1)});
  return mesh;
}

// Triangles that are cut at a point in them, again and again.
Mesh random_triangles(RandomRods &random, int count)
{
  Mesh mesh = two_triangles();
  while (static_cast<int>(mesh.size()) < count) {
    Corners &chosen = mesh[random.below(static_cast<int>(mesh.size()))];
    const auto [a, b, c] = chosen;
    const double u = random.uniform(0.1, 0.8), v = random.uniform(0.05, 0.9 - u);
    const Vec3 point = a + u * (b - a) + v * (c - a);
    double longest = 0.0;
    for (const Vec3 &side : {b - a, c - b, a - c}) longest = std::max(longest, norm(side));
    if (norm(cross(b - a, c - a)) < 1e-3 * longest) continue;  // thinner than this
    chosen = {a, b, point};
    mesh.push_back({b, c, point});
    mesh.push_back({c, a, point});
  }
  return mesh;
}

// Long edges beside several short ones: two wide strips, one of seven and one of five pieces.
Mesh with_t_junctions()
{
  Mesh mesh;
  add_rectangle(mesh, -10.0, -2.0, -10.0, 10.0);
  for (int k = 0; k < 7; k++)
    add_rectangle(mesh, -2.0, 1.0, -10.0 + 20.0 * k / 7, -10.0 + 20.0 * (k + 1) / 7);
  for (int k = 0; k < 5; k++)
    add_rectangle(mesh, 1.0, 4.0, -10.0 + 20.0 * k / 5, -10.0 + 20.0 * (k + 1) / 5);
  add_rectangle(mesh, 4.0, 10.0, -10.0, 10.0);
  return mesh;
}

Mesh slivers()
{
  Mesh mesh;
  for (int k = 0; k < 20; k++) {
    add_rectangle(mesh, -10.0 + k, -9.0 + k - 1e-4, -10.0, 10.0);
    add_rectangle(mesh, -9.0 + k - 1e-4, -9.0 + k, -10.0, 10.0);
  }
  return mesh;
}

std::vector<std::pair<const char *, Mesh>> floors()
{
  RandomRods random(104729);
  return {{"two triangles", two_triangles()},
          {"a fan", fan(40)},
          {"1000 triangles", random_triangles(random, 1000)},
          {"T-junctions", with_t_junctions()},
          {"slivers", slivers()}};
}

// Both ends that are no higher than the radius.
std::vector<Expected> on_plane(const Capsule &rod)
{
  std::vector<Expected> expected;
  for (const OnRod place : {kMinus, kPlus}) {
    if (rod.segment.half_length == 0.0 && place == kPlus) continue;
    const Vec3 end =
        rod.segment.at(place == kMinus ? -rod.segment.half_length : rod.segment.half_length);
    if (end.z <= rod.radius) expected.push_back(at(place, {end.x, end.y, 0.0}, kUp, end.z));
  }
  return expected;
}

}  // namespace

// Closed form: an end's distance from a plane is its height; the rod is nowhere nearer in between.
TEST(ContactsOnFloor, AreThoseOfThePlaneHoweverItIsTiled)
{
  RandomRods random(15487469);
  for (const auto &[name, mesh] : floors()) {
    const TriangleSurface surface(mesh, 0.0);
    Failures differ;
    for (int k = 0; k < 1000; k++) {
      const double half = k % 4 == 0 ? 0.0 : random.uniform(0.0, 3.0);
      Vec3 low = random.vector(3.0), high = random.direction();
      low.z = random.uniform(0.01, 1.1);
      if (k % 3 == 0) low.x = random.below(2) ? -2.0 : 1.0;  // over the seams of some
      if (k % 5 == 0) high.z = 0.0;                          // lying
      high = unit({high.x, high.y, std::fabs(high.z)});
      if (k % 7 == 0) high = {0.0, 1.0, 0.0};  // along a seam
      const Capsule rod = {{low + half * high, high, half}, 1.0};
      const std::string text = difference(contacts_of(rod, surface), rod, on_plane(rod), 1e-12);
      differ.add(!text.empty(), text);
    }
    EXPECT_EQ(differ.count(), 0) << name << ": " << differ.text();
  }
}

// Ends exactly over the nodes and over the middles of the edges.
TEST(ContactsOnFloor, AreThoseOfThePlaneOverNodesAndSeams)
{
  RandomRods random(15487469);
  for (const auto &[name, mesh] : floors()) {
    const TriangleSurface surface(mesh, 0.0);
    Failures differ;
    for (int k = 0; k < 1000; k++) {
      const Corners &corners = mesh[random.below(static_cast<int>(mesh.size()))];
      const Vec3 a = corners[random.below(3)], b = corners[random.below(3)];
      const Vec3 foot = 0.5 * (a + b);  // a node if they are the same
      if (std::fabs(foot.x) > 6.0 || std::fabs(foot.y) > 6.0) continue;
      for (const Vec3 &axis : {kUp, Vec3{1.0, 0.0, 0.0}, unit({1.0, 2.0, 0.5})}) {
        const Capsule rod = {{foot + 0.95 * kUp + 2.0 * axis, axis, 2.0}, 1.0};
        const std::string text = difference(contacts_of(rod, surface), rod, on_plane(rod), 1e-12);
        differ.add(!text.empty(), text);
      }
    }
    EXPECT_EQ(differ.count(), 0) << name << ": " << differ.text();
  }
}

// A T-junction whose node is off the long edge by 3e-8 of the floor's width, as rounding to single
// precision leaves it; it is joined all the same. Over the gap a small end has one contact, as
// beside it.
TEST(ContactsOnFloor, HaveNoGapAtARoundedTJunction)
{
  Mesh mesh;
  add_rectangle(mesh, -10.0, 0.0, -10.0, 10.0);
  const double gap = 1e-6;
  const Vec3 node = {gap, 0.0, 0.0}, far = {10.0, 0.0, 0.0};
  const Vec3 ends[] = {{0.0, -10.0, 0.0}, {0.0, 10.0, 0.0}};
  mesh.push_back({ends[0], far, node});
  mesh.push_back({node, far, ends[1]});
  mesh.push_back({ends[0], {10.0, -10.0, 0.0}, far});
  mesh.push_back({far, {10.0, 10.0, 0.0}, ends[1]});
  const TriangleSurface surface(mesh, 0.0);
  for (size_t e = 0; e < surface.edges().size(); e++) {  // the floor's rim only
    const Vec3 middle = surface.segment(static_cast<int>(e)).centre;
    EXPECT_GT(std::max(std::fabs(middle.x), std::fabs(middle.y)), 4.9);
  }
  for (const double radius : {1.0, 0.1, 0.02, 0.005})
    for (const double x : {-gap, 0.0, 0.25 * gap, 0.5 * gap, gap, 2.0 * gap}) {
      const Capsule rod = {{{x, 0.01, 0.95 * radius}, kUp, 0.0}, radius};
      const Contacts contacts = contacts_of(rod, surface);
      EXPECT_EQ(contacts.size(), 1u) << text_of(rod) << text_of(contacts);
    }
}

// A rod pushed through a floor, remembered nowhere: its centre's side is taken, also where the foot
// of the end and the place where the axis goes through are on two triangles.
TEST(ContactsOnFloor, OfARodThroughItAreOnItsCentresSide)
{
  RandomRods random(49979687);
  for (const auto &[name, mesh] : floors()) {
    const TriangleSurface surface(mesh, 0.0);
    Failures differ;
    for (int k = 0; k < 500; k++) {
      const Vec3 axis = unit({1.0, 0.3, random.uniform(0.1, 2.0)});
      Vec3 low = random.vector(3.0);
      low.z = random.uniform(-0.9, -0.01);
      const Capsule rod = {{low + 3.0 * axis, axis, 3.0}, 1.0};
      if (rod.segment.centre.z < 0.01) continue;
      const std::string text = difference(contacts_of(rod, surface), rod, on_plane(rod), 1e-12);
      differ.add(!text.empty(), text);
    }
    EXPECT_EQ(differ.count(), 0) << name << ": " << differ.text();
  }
}

// Of the remembered side: the distance along its normal, negative once the end is through.
TEST(ContactsOnFloor, OfARememberedSideGoThroughIt)
{
  RandomRods random(15485863);
  const TriangleSurface surface(two_triangles(), 0.0);
  for (const double side : {1.0, -1.0})
    for (const double height : {0.5, 0.01, -0.01, -0.5, -0.99}) {
      const Vec3 up = side * kUp;
      // Also with the centre through it; the axis does not go through anything if it lies.
      for (const Vec3 &axis : {kUp, -kUp, Vec3{1.0, 0.0, 0.0}}) {
        const Capsule rod = {{height * up + Vec3{0.3, 1.0, 0.0} + 2.0 * axis, axis, 2.0}, 1.0};
        for (const int triangle : {0, 1}) {
          const Contacts contacts =
              contacts_of(rod, surface, {{kMinus, triangle, 0, up}, {kPlus, triangle, 0, up}});
          bool found = false;
          for (const SurfaceContact &c : contacts)
            if (c.place == kMinus) {
              found = true;
              EXPECT_EQ(c.feature, OnSurface::kFace);
              EXPECT_NEAR(c.distance, height, 1e-12);
              EXPECT_NEAR(dot(c.normal, up), 1.0, 1e-12);
            }
          EXPECT_TRUE(found) << text_of(rod) << text_of(contacts);
        }
      }
    }
}

// ---- boxes and tubes from inside ----------------------------------------------------------------

// Closed form: the distances of an end from the six planes.
TEST(ContactsInABox, AreThoseOfItsPlanes)
{
  RandomRods random(104729);
  const Vec3 half = {1.0, 1.5, 0.8};
  const double size[] = {half.x, half.y, half.z};
  for (const Mesh &mesh : {box_mesh(half), four_for_one(box_mesh(half))}) {
    const TriangleSurface surface(mesh, 0.0);
    Failures differ;
    for (int k = 0; k < 3000; k++) {
      const Vec3 share_a = random.vector(0.99), share_b = random.vector(0.99);
      const Vec3 a = {half.x * share_a.x, half.y * share_a.y, half.z * share_a.z};
      const Vec3 b = {half.x * share_b.x, half.y * share_b.y, half.z * share_b.z};
      const Capsule rod = {{0.5 * (a + b), unit(b - a), 0.5 * norm(b - a)}, 0.3};
      std::vector<Expected> expected;
      for (const OnRod place : {kMinus, kPlus}) {
        const Vec3 end = place == kMinus ? a : b;
        const double coordinates[] = {end.x, end.y, end.z};
        for (int d = 0; d < 3; d++)
          for (const double side : {-1.0, 1.0}) {
            const double distance = size[d] - side * coordinates[d];
            const Vec3 out = {d == 0 ? side : 0.0, d == 1 ? side : 0.0, d == 2 ? side : 0.0};
            if (distance <= rod.radius)
              expected.push_back(at(place, end + distance * out, -out, distance));
          }
      }
      const std::string text = difference(contacts_of(rod, surface), rod, expected, 1e-12);
      differ.add(!text.empty(), text);
    }
    EXPECT_EQ(differ.count(), 0) << differ.text();
  }
}

namespace {

struct TubeErrors {
  double force, direction;  // over the overlap with the cylinder, rad
};

// Of spheres in a tube of radius 1 and `facets` flat ones, smooth, pressed 0.01 into the true
// cylinder; at random angles, over seams, and in the middle of facets.
TubeErrors worst_in_tube(int facets, double radius)
{
  RandomRods random(15485863);
  const double overlap = 0.01, phase = 0.1;
  const TriangleSurface surface(tube_mesh(facets, 1.0, phase), 2.1 * kPi / facets);
  TubeErrors worst{0.0, 0.0};
  for (int k = 0; k < 300; k++) {
    double angle = random.uniform(-kPi, kPi);
    if (k % 3) angle = phase + (k % 3 == 1 ? 2.0 : 1.0) * kPi * random.below(facets) / facets;
    const Vec3 out = {std::cos(angle), std::sin(angle), 0.0};
    const Capsule rod = {
        {(1.0 - radius + overlap) * out + random.uniform(-0.5, 0.5) * kUp, kUp, 0.0},
        radius};
    const Contacts contacts = contacts_of(rod, surface);
    double weights = 0.0;
    for (const SurfaceContact &c : contacts) weights += c.weight;
    EXPECT_NEAR(weights, 1.0, 1e-12) << text_of(rod) << text_of(contacts);
    const Vec3 force = radius * load_of(contacts, rod).force;
    worst.force = std::max(worst.force, norm(force + overlap * out));
    worst.direction = std::max(worst.direction, norm(cross(force, out)) / norm(force));
  }
  return worst;
}

}  // namespace

// Convergence to the true cylinder: an end's load there is the overlap times the direction to the
// axis. Closed form: facets are nearer than the cylinder by up to 1 - cos(pi/n) < pi^2/(2 n^2), and
// they turn by 2 pi/n, so that no weights of theirs point farther off than pi/n (of a small end by
// little less, where its foot is on one facet only).
TEST(ContactsInATube, ForceConvergesToThatOfTheCylinder)
{
  for (const double radius : {0.1, 0.3, 0.7})
    for (const int facets : {16, 64, 256}) {
      const TubeErrors worst = worst_in_tube(facets, radius);
      const double nearer = 0.5 * kPi * kPi / facets / facets;
      EXPECT_LE(worst.direction, 1.01 * kPi / facets) << radius << ", " << facets;
      EXPECT_LE(worst.force, nearer + (0.01 + nearer) * kPi / facets) << radius << ", " << facets;
    }
}

// ---- rods over smooth surfaces ------------------------------------------------------------------

namespace {

Vec3 sum_of_overlaps(const Contacts &contacts, const Capsule &rod)
{
  Vec3 sum = {0.0, 0.0, 0.0};
  for (const SurfaceContact &c : contacts)
    sum = sum + (c.weight * (rod.radius - c.distance)) * c.normal;
  return sum;
}

// Over the overlap with the true cylinder, of rods of radius 0.15 and half length 3 across a cylinder of
// radius 1: at random angles round it, over seams and over middles of facets, up to 0.5 rad askew.
struct Range {
  double least = 1e300, most = 0.0;
};

Range loads_across_roller(int facets)
{
  RandomRods random(15485863);
  const double overlap = 0.01, radius = 0.15, phase = 0.1;
  const TriangleSurface surface(tube_mesh(facets, 1.0, phase), 2.1 * kPi / facets);
  Range range;
  for (int k = 0; k < 300; k++) {
    double angle = random.uniform(-kPi, kPi);
    if (k % 3) angle = phase + (k % 3 == 1 ? 2.0 : 1.0) * kPi * random.below(facets) / facets;
    const double askew = random.uniform(-0.5, 0.5);
    const Vec3 out = {std::cos(angle), std::sin(angle), 0.0};
    const Vec3 axis = std::cos(askew) * Vec3{-out.y, out.x, 0.0} + std::sin(askew) * kUp;
    const Vec3 centre = (1.0 + radius - overlap) * out + random.uniform(-0.2, 0.2) * axis;
    const Capsule rod = {{centre, axis, 3.0}, radius};
    const double load = norm(sum_of_overlaps(contacts_of(rod, surface), rod)) / overlap;
    range.least = std::min(range.least, load);
    range.most = std::max(range.most, load);
  }
  return range;
}

}  // namespace

// Convergence to the true cylinder, second order: facets inscribed in it lie lower by up to 1 - cos(pi/n), and
// edges that share a load bear no more than one, but for the turn of their normals.
TEST(ContactsAcrossARoller, LoadConvergesToThatOfTheCylinder)
{
  for (const int facets : {48, 96, 192, 384, 768}) {
    const Range loads = loads_across_roller(facets);
    const double lower = (1.0 - std::cos(kPi / facets)) / 0.01;
    // Of 48 some are still pressed in by less than their turn, and are edges of a polygon.
    EXPECT_LE(loads.most, 1.0 + (facets > 48 ? 0.1 : 0.4) * lower) << facets;
    EXPECT_GE(loads.least, 1.0 - 1.5 * lower) << facets;
  }
}

namespace {

// Pairs of triangles in squares, from -10 to 10.
Mesh floor_of_squares(int squares)
{
  Mesh mesh;
  const double size = 20.0 / squares;
  for (int i = 0; i < squares; i++)
    for (int j = 0; j < squares; j++) {
      const double x = -10.0 + i * size, y = -10.0 + j * size;
      const Vec3 a = {x, y, 0.0}, b = {x + size, y, 0.0}, c = {x + size, y + size, 0.0},
                 d = {x, y + size, 0.0};
      mesh.push_back({a, b, c});
      mesh.push_back({a, c, d});
    }
  return mesh;
}

}  // namespace

// A flat floor whose nodes a file has rounded: gentle ridges and valleys all over it, within one smooth patch.
// Closed form: of the flat floor, two ends; what stands out of it adds its part of the overlap.
TEST(ContactsOnARoughFloor, AreTwoEndsHoweverFineItsTiles)
{
  for (const int tiles : {10, 20, 40})
    for (const double noise : {1e-6, 1e-5, 1e-4}) {
      RandomRods random(15487469);
      Mesh mesh = floor_of_squares(tiles);
      std::map<std::pair<long, long>, double> heights;  // by place, in thousandths
      for (Corners &corners : mesh)
        for (Vec3 &corner : corners) {
          const auto [found, is_new] =
              heights.try_emplace({std::lround(1e3 * corner.x), std::lround(1e3 * corner.y)}, 0.0);
          if (is_new) found->second = random.uniform(-noise, noise);
          corner.z = found->second;
        }
      const TriangleSurface surface(mesh, 0.26 * kPi / 180.0);
      for (int k = 0; k < 100; k++) {
        const double angle = random.uniform(-kPi, kPi);
        const Capsule rod = {{{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.95},
                              {std::cos(angle), std::sin(angle), 0.0},
                              6.0},
                             1.0};
        const Contacts contacts = contacts_of(rod, surface);
        // Of some seams under the rod each adds no more than its height.
        EXPECT_NEAR(sum_of_overlaps(contacts, rod).z, 2.0 * 0.05, 1.5 * tiles * noise)
            << tiles << ", " << noise << text_of(rod) << text_of(contacts);
      }
    }
}

// ---- narrow facets, rims, slots -----------------------------------------------------------------

namespace {

// The top of a box of width 2 (in x), between sharp edges at x = -1 and 1, z = 0.
Mesh beam() { return box_mesh({1.0, 10.0, 5.0}); }

Capsule over_beam(double tilt, double height)  // of the centre, + end up
{
  return {{{0.0, 0.3, 5.0 + height}, {std::cos(tilt), 0.0, std::sin(tilt)}, 4.0}, 1.0};
}

}  // namespace

// A rod longer than the facet that it lies on rests on both rims.
TEST(ContactsOnABeam, AreAtBothRims)
{
  const TriangleSurface surface(beam(), 0.0);
  const Capsule rod = over_beam(0.0, 0.95);
  EXPECT_EQ(difference(contacts_of(rod, surface), rod,
                       {at(kBetween, {-1.0, 0.3, 5.0}, kUp, 0.95),
                        at(kBetween, {1.0, 0.3, 5.0}, kUp, 0.95)},
                       1e-12),
            "");
}

// Tilted by alpha, the lower rim from which it rises bears fully at its own distance cos(alpha)
// lower; the other, over which it goes down inwards, 1 - alpha/(turn/2) of its height.
TEST(ContactsOnABeam, OfATiltedRodFadeAtTheRimThatItRisesOver)
{
  const TriangleSurface surface(beam(), 0.0);
  const double turn = 0.5 * kPi;
  for (const double alpha : {1e-3, 0.01, 0.03}) {
    const Capsule rod = over_beam(alpha, 0.9);
    const double low = 0.9 - std::tan(alpha), high = 0.9 + std::tan(alpha);  // over the rims
    const Vec3 across = {-std::sin(alpha), 0.0, std::cos(alpha)};
    EXPECT_EQ(difference(contacts_of(rod, surface), rod,
                         {at(kBetween, {-1.0, 0.3, 5.0}, across, low * std::cos(alpha)),
                          at(kBetween, {1.0, 0.3, 5.0}, kUp, high, 1.0 - alpha / (0.5 * turn))},
                         1e-12),
              "");
  }
}

// Two coplanar plates, 1 apart; free rims turn by pi.
TEST(ContactsOverASlot, AreAtBothRims)
{
  Mesh mesh;
  add_rectangle(mesh, -10.0, -0.5, -10.0, 10.0);
  add_rectangle(mesh, 0.5, 10.0, -10.0, 10.0);
  const TriangleSurface surface(mesh, 0.0);
  const Vec3 x = {1.0, 0.0, 0.0};
  const Capsule across = {{{0.2, 0.0, 0.95}, x, 3.0}, 1.0};
  EXPECT_EQ(
      difference(contacts_of(across, surface), across,
                 {at(kMinus, {-2.8, 0.0, 0.0}, kUp, 0.95), at(kPlus, {3.2, 0.0, 0.0}, kUp, 0.95),
                  at(kBetween, {-0.5, 0.0, 0.0}, kUp, 0.95),
                  at(kBetween, {0.5, 0.0, 0.0}, kUp, 0.95)},
                 1e-12),
      "");
  // Its end over the slot's middle, at the same distance from both rims: at the near one the axis is nearer
  // farther in. That place bears what the end at the far rim, half a radius away, leaves.
  const Capsule into = {{{-3.0, 0.0, 0.8}, x, 3.0}, 1.0};
  const double distance = std::hypot(0.5, 0.8), overlap = 1.0 - distance;
  EXPECT_EQ(difference(contacts_of(into, surface), into,
                       {at(kMinus, {-6.0, 0.0, 0.0}, kUp, 0.8),
                        at(kPlus, {0.5, 0.0, 0.0}, unit({-0.5, 0.0, 0.8}), distance),
                        at(kBetween, {-0.5, 0.0, 0.0}, kUp, 0.8,
                           1.0 - overlap / 0.2 * 0.5 * 0.8 / distance)},
                       1e-12),
            "");
}

// A shelf and below its rim a slope of 30 degrees that rises away from it: the end over the shelf
// is nearer to the slope than its radius and sees it past the rim, 0.25 away.
TEST(ContactsBesideAShelf, AreThoseThatItDoesNotHide)
{
  Mesh mesh;
  add_rectangle(mesh, -30.0, -0.7, -30.0, 30.0);
  const Vec3 end = {-0.8, 0.3, 0.6}, normal = {-0.5, 0.0, std::sqrt(0.75)};
  const Vec3 up = {normal.z, 0.0, 0.5}, foot = end - 0.8 * normal, across = {0.0, 30.0, 0.0};
  const Vec3 low = foot - 0.3 * up, high = foot + 30.0 * up;
  mesh.push_back({low - across, high - across, high + across});
  mesh.push_back({low - across, high + across, low + across});
  const TriangleSurface surface(mesh, 0.0);
  const Capsule rod = {{end, kUp, 0.0}, 1.0};
  EXPECT_EQ(difference(contacts_of(rod, surface), rod,
                       {at(kMinus, {-0.8, 0.3, 0.0}, kUp, 0.6), at(kMinus, foot, normal, 0.8)},
                       1e-12),
            "");
  // With the shelf as far as there the slope is behind it.
  for (Corners &corners : mesh)
    for (Vec3 &corner : corners)
      if (corner.x == -0.7) corner.x = -0.4;
  const TriangleSurface longer(mesh, 0.0);
  EXPECT_EQ(
      difference(contacts_of(rod, longer), rod, {at(kMinus, {-0.8, 0.3, 0.0}, kUp, 0.6)}, 1e-12),
      "");
}

// An end that is remembered stays at the face however deep behind it it is.
TEST(ContactsBehindAFace, StayWhenRemembered)
{
  const TriangleSurface surface(two_triangles(), 0.0);
  for (const double depth : {0.99, 1.01, 3.0}) {
    const Capsule rod = {{{0.3, 1.0, -depth}, kUp, 0.0}, 1.0};
    EXPECT_EQ(difference(contacts_of(rod, surface, {{kMinus, 0, 0, kUp}}), rod,
                         {at(kMinus, {0.3, 1.0, 0.0}, kUp, -depth)}, 1e-12),
              "");
  }
}

// Parallel to an edge and beside it, as far as over its corner: the end bears it.
TEST(ContactsAlongAnEdge, OfARodPastItsCornerAreAtItsEnd)
{
  const TriangleSurface surface(box_mesh({5.0, 5.0, 5.0}), 0.0);
  const Vec3 out = unit({0.0, 0.3, 0.85}), x = {1.0, 0.0, 0.0};
  const Capsule rod = {{Vec3{5.0, 5.0, 5.0} + 0.9 * out, x, 3.0}, 1.0};
  EXPECT_EQ(
      difference(contacts_of(rod, surface), rod, {at(kMinus, {2.0, 5.0, 5.0}, out, 0.9)}, 1e-12),
      "");
}

// A hole of free rims just wider than the rod: on each side one, and they stay when remembered.
TEST(ContactsInAHole, StayWhenRemembered)
{
  Mesh mesh;  // a frame about |x|, |y| < 0.98
  add_rectangle(mesh, -5.0, -0.98, -5.0, 5.0);
  add_rectangle(mesh, 0.98, 5.0, -5.0, 5.0);
  add_rectangle(mesh, -0.98, 0.98, -5.0, -0.98);
  add_rectangle(mesh, -0.98, 0.98, 0.98, 5.0);
  const TriangleSurface surface(mesh, 0.0);
  const Capsule rod = {{{0.0, 0.0, 0.3}, kUp, 4.0}, 1.0};
  const Vec3 x = {1.0, 0.0, 0.0}, y = {0.0, 1.0, 0.0};
  const std::vector<Expected> expected = {
      at(kBetween, 0.98 * x, -x, 0.98), at(kBetween, -0.98 * x, x, 0.98),
      at(kBetween, 0.98 * y, -y, 0.98), at(kBetween, -0.98 * y, y, 0.98)};
  const Contacts first = contacts_of(rod, surface);
  EXPECT_EQ(difference(first, rod, expected, 1e-12), "");
  EXPECT_EQ(difference(contacts_of(rod, surface, memory_of(first)), rod, expected, 1e-12), "");
}

// A sphere in the outlet of a steep smooth funnel touches it all round; so it does a step later.
TEST(ContactsInAFunnel, StayWhenRemembered)
{
  const int facets = 16;
  Mesh mesh = tube_mesh(facets, 1.0, 0.0);
  for (Corners &corners : mesh)
    for (Vec3 &corner : corners)
      if (corner.z > 0.0) corner = {3.0 * corner.x, 3.0 * corner.y, 3.0};
  const TriangleSurface surface(mesh, 2.1 * kPi / facets);
  // Facets rise by 4 over 2 cos(pi/n).
  const Capsule rod = {{{0.0, 0.0, 0.0}, kUp, 0.0}, 1.35};
  const Contacts first = contacts_of(rod, surface),
                 second = contacts_of(rod, surface, memory_of(first));
  ASSERT_GE(first.size(), static_cast<size_t>(facets)) << text_of(first);
  EXPECT_LT(norm(load_of(first, rod).force - load_of(second, rod).force), 1e-12)
      << text_of(first) << text_of(second);
}

// The end between two walls of one smooth patch: each bears its whole load, as two planes do.
TEST(ContactsInASmoothChannel, OfBothWallsBearWholeLoads)
{
  Mesh mesh;  // half a tube along z with walls that go on straight, 1.96 apart
  const auto add_strip = [&](const Vec3 &a, const Vec3 &b) {
    mesh.push_back({a - 3.0 * kUp, b - 3.0 * kUp, b + 3.0 * kUp});
    mesh.push_back({a - 3.0 * kUp, b + 3.0 * kUp, a + 3.0 * kUp});
  };
  const auto round = [](int k) -> Vec3 {
    return {0.98 * std::cos(kPi + kPi * k / 16), 0.98 * std::sin(kPi + kPi * k / 16), 0.0};
  };
  const Vec3 up = {0.0, 5.0, 0.0};
  for (int k = 0; k < 16; k++) add_strip(round(k), round(k + 1));
  add_strip(round(0) + up, round(0));
  add_strip(round(16), round(16) + up);
  const TriangleSurface surface(mesh, 0.25);
  const Capsule rod = {{{0.0, 3.0, 0.0}, kUp, 0.0}, 1.0};
  const Vec3 x = {1.0, 0.0, 0.0}, y = {0.0, 3.0, 0.0};
  EXPECT_EQ(difference(contacts_of(rod, surface), rod,
                       {at(kMinus, y - 0.98 * x, x, 0.98), at(kMinus, y + 0.98 * x, -x, 0.98)},
                       1e-12),
            "");
}

// A long edge beside two short ones at a sharp ridge: the node in its middle is a corner of the
// wall alone; over the floor an end beside it has its foot, and nothing else.
TEST(ContactsAtATJunction, OfARidgeAreNoCornerOfTheLongSide)
{
  Mesh mesh;  // floor y < 0, z = 0; wall down at y = 0 of two pieces that meet at x = 0
  mesh.push_back({Vec3{-5.0, -9.0, 0.0}, Vec3{5.0, -9.0, 0.0}, Vec3{5.0, 0.0, 0.0}});
  mesh.push_back({Vec3{-5.0, -9.0, 0.0}, Vec3{5.0, 0.0, 0.0}, Vec3{-5.0, 0.0, 0.0}});
  mesh.push_back({Vec3{-5.0, 0.0, 0.0}, Vec3{0.0, 0.0, 0.0}, Vec3{0.0, 0.0, -5.0}});
  mesh.push_back({Vec3{0.0, 0.0, 0.0}, Vec3{5.0, 0.0, 0.0}, Vec3{0.0, 0.0, -5.0}});
  const TriangleSurface surface(mesh, 0.0);
  const Capsule rod = {{{0.0, -0.3, 0.9}, kUp, 0.0}, 1.0};
  EXPECT_EQ(
      difference(contacts_of(rod, surface), rod, {at(kMinus, {0.0, -0.3, 0.0}, kUp, 0.9)}, 1e-12),
      "");
}
