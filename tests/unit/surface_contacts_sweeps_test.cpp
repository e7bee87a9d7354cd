// SPDX-License-Identifier: GPL-2.0-or-later
// Rods that move in small steps over edges, corners, ridges and valleys: their load must not jump.
// By bisection: a change that stays however short the step is one. Radius 1. Left out is where
// loads do jump: an axis that gets parallel to an edge, an end that passes the boundary of a sharp
// valley.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/surface_contacts.h"
#include "surface_contacts_support.h"
#include "surface_reference.h"

using namespace spherocylinder;

namespace {

constexpr Vec3 kUp = {0.0, 0.0, 1.0};
Vec3 unit(const Vec3 &a) { return RandomRods::unit(a); }

struct Sweep {
  const char *name;
  Mesh mesh;
  double smooth_turn;
  double from, to;
  std::function<Capsule(double)> pose;
};
void PrintTo(const Sweep &sweep, std::ostream *out) { *out << sweep.name; }

// A strip between two lines along y.
void add_strip(Mesh &mesh, double x0, double z0, double x1, double z1, double half_width)
{
  const Vec3 a = {x0, -half_width, z0}, b = {x1, -half_width, z1}, c = {x1, half_width, z1},
             d = {x0, half_width, z0};
  mesh.push_back({a, b, c});
  mesh.push_back({a, c, d});
}

// Flat strips along y, one after the other; points are (x, z).
Mesh profile(const std::vector<std::pair<double, double>> &points, double half_width = 30.0)
{
  Mesh mesh;
  for (size_t k = 1; k < points.size(); k++)
    add_strip(mesh, points[k - 1].first, points[k - 1].second, points[k].first, points[k].second,
              half_width);
  return mesh;
}

// Facets that turn by `turn` at x = 0, z = 0, down (a ridge) or up (a valley).
Mesh bent(double turn)
{
  return profile({{-30.0, 0.0}, {0.0, 0.0}, {30.0 * std::cos(turn), -30.0 * std::sin(turn)}});
}

// An uneven round of flat strips, from inside: radius 3 about the y axis.
Mesh uneven_round()
{
  RandomRods random(104729);
  std::vector<std::pair<double, double>> points;
  double angle = -2.5;
  while (angle < 2.5) {
    points.push_back({3.0 * std::sin(angle), -3.0 * std::cos(angle)});
    angle += random.uniform(0.05, 0.4);
  }
  return profile(points);
}

Capsule lying(double x, double y, double z, double yaw, double tilt, double half)
{
  return {{{x, y, z},
           {std::cos(yaw) * std::cos(tilt), std::sin(yaw) * std::cos(tilt), std::sin(tilt)},
           half},
          1.0};
}
Capsule sphere(const Vec3 &at) { return {{at, kUp, 0.0}, 1.0}; }

const std::vector<Sweep> &sweeps()
{
  RandomRods random(15485863);
  const Mesh cube = box_mesh({5.0, 5.0, 5.0}), beam = box_mesh({1.0, 30.0, 5.0});
  Mesh waves;
  for (const Corners &corners : waves_mesh(random, 8, 0.01)) {
    const double size = 10.0;
    waves.push_back({size * corners[0], size * corners[1], size * corners[2]});
  }
  Mesh slot = profile({{-30.0, 0.0}, {-0.5, 0.0}});
  for (const Corners &corners : profile({{0.5, 0.0}, {30.0, 0.0}})) slot.push_back(corners);

  static const std::vector<Sweep> all = {
      // A free rim and sharp edges, square on and at an angle.
      {"EndOffASharpEdge", cube, 0.0, 3.0, 8.0,
       [](double t) {
         return sphere({t, 0.3, 5.9});
       }},
      {"EndOffACorner", cube, 0.0, 3.0, 8.0,
       [](double t) {
         return sphere({t, t - 0.2, 5.9});
       }},
      {"RodOffASharpEdge", cube, 0.0, 0.0, 9.0,
       [](double t) { return lying(t, 0.3, 5.9, 0.0, 0.0, 3.0); }},
      {"RodOffASharpEdgeAtAnAngle", cube, 0.0, 0.0, 9.0,
       [](double t) { return lying(t, 0.3, 5.9, 0.3, 0.0, 3.0); }},
      {"RodOffASharpEdgeOuterEndUp", cube, 0.0, 0.0, 9.0,
       [](double t) { return lying(t, 0.3, 5.95, 0.3, 0.02, 3.0); }},
      {"RodOffASharpEdgeOuterEndDown", cube, 0.0, 0.0, 9.0,
       [](double t) { return lying(t, 0.3, 5.95, 0.3, -0.02, 3.0); }},
      {"RodOffAFreeRim", profile({{-30.0, 0.0}, {0.0, 0.0}}), 0.0, -4.0, 4.0,
       [](double t) { return lying(t, 0.3, 0.9, 0.3, 0.01, 3.0); }},
      {"RodAlongAnEdgeAndOffIt", cube, 0.0, 4.0, 7.0,
       [](double t) { return lying(t, 0.3, 5.9, 0.5 * kPi, 0.0, 3.0); }},
      {"RodNearlyAlongAnEdge", cube, 0.0, 4.0, 7.0,
       [](double t) { return lying(t, 0.3, 5.9, 0.5 * kPi - 0.05, 0.0, 3.0); }},
      {"RodTurnsOnAnEdge", cube, 0.0, 0.0, 0.5 * kPi,
       [](double t) { return lying(5.3, 0.3, 5.9, t, 0.0, 3.0); }},
      {"RodTurnsAboveAnEdge", cube, 0.0, 0.0, 0.5 * kPi - 1e-3,
       [](double t) { return lying(5.0, 0.3, 5.9, t, 0.0, 3.0); }},
      // Corners of a facet.
      {"RodAcrossACorner", cube, 0.0, -2.0, 2.0,
       [](double t) { return lying(5.0 + t, 5.0 + t, 5.9, -0.25 * kPi, 0.0, 4.0); }},
      {"TiltedRodAcrossACorner", cube, 0.0, -2.0, 2.0,
       [](double t) { return lying(5.0 + t, 5.0 + t, 5.9, -0.5, 0.05, 4.0); }},
      {"RodOutOverACorner", cube, 0.0, -3.0, 3.0,
       [](double t) { return lying(5.0, 5.0 + t, 5.9, 0.4, 0.0, 4.0); }},
      {"TiltedRodOutOverACorner", cube, 0.0, -3.0, 3.0,
       [](double t) { return lying(5.0, 5.0 + t, 5.95, 0.4, 0.02, 4.0); }},
      {"RodAcrossARidgePastItsEnd", cube, 0.0, 3.0, 7.0,
       [](double t) -> Capsule {
         const Vec3 out = unit({1.0, 0.0, 1.0});
         return {{Vec3{5.0, t, 5.0} + 0.9 * out, unit({1.0, 0.0, -1.0}), 3.0}, 1.0};
       }},
      // Nearly along an edge and out over its corner.
      {"RodNearlyAlongAnEdgeOutOverItsCorner", cube, 0.0, -1.0, 1.0,
       [](double t) { return lying(5.0, 5.0 + t, 5.9, -0.02, 0.0, 3.0); }},
      {"RodNearlyAlongAnEdgeInOverItsCorner", cube, 0.0, -1.0, 1.0,
       [](double t) { return lying(5.0, 5.0 + t, 5.9, 0.05, 0.0, 3.0); }},
      {"RodAlongAnEdgePastItsCorner", cube, 0.0, -4.0, 4.0,
       [](double t) { return lying(5.0 + t, 5.3, 5.85, 0.01, 0.005, 3.0); }},
      {"RodTiltsOverAnEdgeAndItsCorner", cube, 0.0, -0.3, 0.3,
       [](double t) { return lying(5.0, 5.3, 5.85, 0.01, t, 3.0); }},
      // Narrow facets and slots.
      {"RodTiltsOnABeam", beam, 0.0, -0.6, 0.6,
       [](double t) { return lying(0.0, 0.3, 5.9, 0.0, t, 4.0); }},
      {"RodTiltsAtAnAngleOnABeam", beam, 0.0, -0.6, 0.6,
       [](double t) { return lying(0.0, 0.3, 5.9, 0.7, t, 4.0); }},
      {"RodTurnsOnABeam", beam, 0.0, 0.0, 0.5 * kPi,
       [](double t) { return lying(0.0, 0.3, 5.9, t, 0.01, 4.0); }},
      {"RodOffABeam", beam, 0.0, 0.0, 7.0,
       [](double t) { return lying(t, 0.3, 5.9, 0.2, 0.0, 4.0); }},
      {"RodOverASlot", slot, 0.0, -6.0, 6.0,
       [](double t) { return lying(t, 0.3, 0.9, 0.2, 0.0, 3.0); }},
      // Ridges, sharp and smooth.
      {"EndOverASharpGentleRidge", bent(0.3), 0.0, -2.0, 2.0,
       [](double t) {
         return sphere({t, 0.3, 0.9});
       }},
      {"RodOverASharpGentleRidge", bent(0.3), 0.0, -5.0, 5.0,
       [](double t) { return lying(t, 0.3, 0.9, 0.0, 0.0, 3.0); }},
      {"EndOfARodDownASharpGentleRidge", bent(0.3), 0.0, -4.0, -1.0,
       [](double t) { return lying(t, 0.3, 0.9, 0.0, 0.0, 3.0); }},
      {"EndOfARodDownASmoothRidge", bent(0.3), 0.5, -4.0, -1.0,
       [](double t) { return lying(t, 0.3, 0.9, 0.0, 0.0, 3.0); }},
      {"OverhangingRodsInnerEndToTheRim", cube, 0.0, 5.0, 7.9,
       [](double t) { return lying(t, 0.3, 5.9, 0.0, 0.0, 3.0); }},
      {"RodOverASmoothRidge", bent(0.3), 0.5, -5.0, 5.0,
       [](double t) { return lying(t, 0.3, 0.9, 0.0, 0.0, 3.0); }},
      {"RodOverASmoothRidgeOfManyFacets", tube_mesh(48, 30.0, 0.1), 0.2, 0.0, 0.5,
       [](double t) -> Capsule {  // from outside, across
         const Vec3 out = {std::cos(t), std::sin(t), 0.0}, across = {-out.y, out.x, 0.0};
         return {{1.9 * out, unit(across + 0.05 * kUp), 1.5}, 1.0};
       }},
      {"EndOverASmoothRidgeOfManyFacets", tube_mesh(48, 30.0, 0.1), 0.2, 0.0, 0.5,
       [](double t) {
         return sphere({1.9 * std::cos(t), 1.9 * std::sin(t), 0.0});
       }},
      {"RodObliqueOverASharpGentleRidge", bent(0.3), 0.0, -5.0, 5.0,
       [](double t) { return lying(t, 0.3, 0.9, 1.2, 0.0, 3.0); }},
      {"RodNearlyAlongAGentleRidge", bent(0.3), 0.0, -1.0, 1.0,
       [](double t) { return lying(t, 0.3, 0.9, 1.5, 0.0, 3.0); }},
      {"RodTurnsOnAGentleRidge", bent(0.3), 0.0, 0.0, 1.56,
       [](double t) { return lying(0.1, 0.3, 0.92, t, -0.05, 3.0); }},
      // A ridge of many short edges.
      {"RodTurnsAboveAnEdgeOfManyPieces", four_for_one(four_for_one(cube)), 0.0, 0.3, 1.2,
       [](double t) { return lying(5.0, 0.3, 5.9, t, 0.0, 3.0); }},
      {"RodAlongAnEdgeOfManyPieces", four_for_one(four_for_one(cube)), 0.0, -1.0, 1.0,
       [](double t) -> Capsule {
         const Vec3 out = unit({1.0, 0.0, 1.0});
         return {{Vec3{5.0, t, 5.0} + 0.9 * out, {0.0, 1.0, 0.0}, 3.0}, 1.0};
       }},
      // Valleys, sharp and smooth.
      {"EndInASharpSteepValley", bent(-0.5 * kPi), 0.0, -3.0, -0.9,
       [](double t) {
         return sphere({t, 0.3, 0.9});
       }},
      {"EndInASharpGentleValley", bent(-0.2), 0.0, -0.18, -1e-3,
       [](double t) {
         return sphere({t, 0.3, 0.9});
       }},
      {"EndInASmoothValley", bent(-0.2), 0.5, -2.0, 0.3,
       [](double t) {
         return sphere({t, 0.3, 0.9});
       }},
      {"EndInASmoothUnevenRound", uneven_round(), 0.5, -2.3, 2.3,
       [](double t) {
         return sphere({2.1 * std::sin(t), 0.3, -2.1 * std::cos(t)});
       }},
      {"LargeEndInASmoothUnevenRound", uneven_round(), 0.5, -2.3, 2.3,
       [](double t) -> Capsule {
         return {{{0.35 * std::sin(t), 0.3, -0.35 * std::cos(t)}, kUp, 0.0}, 2.75};
       }},
      {"EndOverSmoothRidgeThenValley",
       profile({{-30.0, 0.0}, {0.0, 0.0}, {2.0, -0.3}, {2.3, -0.3}, {30.0, 3.0}}), 0.6, -1.0, 4.0,
       [](double t) {
         return sphere({t, 0.3, 0.85});
       }},
      {"EndInASmoothTrough", profile({{-30.0, 3.0}, {-0.15, 0.0}, {0.15, 0.0}, {30.0, 3.0}}), 0.5,
       -2.0, 2.0,
       [](double t) {
         return sphere({t, 0.3, 0.9});
       }},
      {"EndSinksBetweenWallsOfOnePatch",
       profile({{-1.1, 6.0},
                {-0.97, 0.0},
                {-0.7, -0.6},
                {-0.2, -0.9},
                {0.2, -0.9},
                {0.7, -0.6},
                {0.97, 0.0},
                {1.1, 6.0}}),
       0.9, -0.1, 3.0,
       [](double t) {
         return sphere({0.02, 0.3, t});
       }},
      {"EndOverSmoothWaves", waves, 0.5, -6.0, 6.0,
       [](double t) {
         return sphere({t, 0.31 * t + 0.4, 0.9});
       }},
      {"RodOverSmoothWaves", waves, 0.5, -4.0, 4.0,
       [](double t) { return lying(t, 0.31 * t + 0.4, 0.95, 0.7, 0.0, 3.0); }},
  };
  return all;
}

class SurfaceSweep : public testing::TestWithParam<Sweep> {};

std::string jump_text(double t, double size, const Sweep &sweep, const TriangleSurface &surface,
                      double before, double after)
{
  const Capsule a = sweep.pose(before), b = sweep.pose(after);
  char head[80];
  std::snprintf(head, sizeof head, "\njump of %.3g at %.9g: ", size, t);
  return head + text_of(a) + text_of(contacts_of(a, surface)) + "\nto" +
         text_of(contacts_of(b, surface));
}

// Jumps that are known, of the sweep's largest one: a rim's contact that ends at the rim's end, a tilt
// that is measured across each edge, an axis nearly parallel to an edge, contacts over a smooth ridge that
// change places, facets of a very large end.
double known_jump(const std::string &name)
{
  const std::map<std::string, double> known = {{"TiltedRodAcrossACorner", 0.02},
                                               {"TiltedRodOutOverACorner", 0.002},
                                               {"RodNearlyAlongAnEdgeOutOverItsCorner", 0.05},
                                               {"RodNearlyAlongAGentleRidge", 0.08},
                                               {"RodObliqueOverASharpGentleRidge", 0.04},
                                               {"RodOverASmoothRidgeOfManyFacets", 0.01},
                                               {"LargeEndInASmoothUnevenRound", 0.004}};
  const auto found = known.find(name);
  return found == known.end() ? 0.0 : found->second;
}

}  // namespace

// Closed form: none. Overlaps are at most 0.25; a jump is a change of more than 1e-3 of a load of 1
// within 1e-7 of a radius (features of seams overlap by 1e-5 radii, which is worth less).
TEST_P(SurfaceSweep, LoadDoesNotJump)
{
  const Sweep &sweep = GetParam();
  const TriangleSurface surface(sweep.mesh, sweep.smooth_turn);
  const auto load = [&](double t) {
    const Capsule rod = sweep.pose(t);
    return load_of(contacts_of(rod, surface), rod);
  };
  constexpr int kSteps = 2000;
  std::string jumps;
  int count = 0;
  double worst = 0.0;
  const double step = (sweep.to - sweep.from) / kSteps;
  Load last = load(sweep.from);
  for (int k = 1; k <= kSteps; k++) {
    double low = sweep.from + (k - 1) * step, high = sweep.from + k * step;
    const Load next = load(high);
    const Capsule rod = sweep.pose(low);
    Load at_low = last, at_high = next;
    last = next;
    while (high - low > 1e-7 && difference(at_low, at_high, rod) > 1e-3) {
      const double middle = 0.5 * (low + high);
      const Load at_middle = load(middle);
      if (difference(at_low, at_middle, rod) > difference(at_middle, at_high, rod)) {
        high = middle;
        at_high = at_middle;
      } else {
        low = middle;
        at_low = at_middle;
      }
    }
    const double size = difference(at_low, at_high, rod);
    if (size <= 1e-3) continue;
    count++;
    if (size > worst) {
      worst = size;
      jumps = jump_text(low, size, sweep, surface, low, high);
    }
  }
  const double known = known_jump(sweep.name);
  EXPECT_LE(worst, known) << "the largest of " << count << ":" << jumps;
  EXPECT_TRUE(count == 0 || known > 0.0);
}

// With each step's contacts as the memory of the next the rod, which goes through nothing, has the
// same contacts as without.
TEST_P(SurfaceSweep, MemoryChangesNothing)
{
  const Sweep &sweep = GetParam();
  const TriangleSurface surface(sweep.mesh, sweep.smooth_turn);
  Memory memory;
  Failures differ;
  constexpr int kSteps = 200;
  for (int k = 0; k <= kSteps; k++) {
    const Capsule rod = sweep.pose(sweep.from + (sweep.to - sweep.from) * k / kSteps);
    const Contacts contacts = near_contacts_of(rod, surface, sweep.mesh, memory),
                   without = near_contacts_of(rod, surface, sweep.mesh);
    memory = memory_of(without);
    const double change = difference(load_of(contacts, rod), load_of(without, rod), rod);
    differ.add(!(change < 1e-9),
               text_of(rod) + text_of(without) + "\nremembered" + text_of(contacts));
  }
  EXPECT_EQ(differ.count(), 0) << differ.text();
}

INSTANTIATE_TEST_SUITE_P(Paths, SurfaceSweep, testing::ValuesIn(sweeps()),
                         [](const auto &info) { return std::string(info.param.name); });
