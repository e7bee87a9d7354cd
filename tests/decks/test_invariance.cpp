// SPDX-License-Identifier: GPL-2.0-or-later
// What must not change the motion: the frame, the rods' numbers, the sign of an axis, the place in
// a periodic box, the number of ranks. And what a mixture of rods and spheres must keep.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "claim.h"
#include "core/rotation.h"
#include "run_mode.h"

using namespace decks;

namespace {

// Round-off grows in each collision by about the rod's length over its radius.
constexpr double kSameMotion = 1e-9;

const std::string kColliding = linear_material(1e5, 5e4, 0.7, 0.3) +
                               rod_pair("linear tangential history") +
                               "fix motion all nve/spherocylinder\n";

Vec3 random_direction(std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

// Eight rods round the origin that fly at it and collide with friction.
Scene cluster()
{
  std::mt19937 random(30011);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Scene scene;
  for (int i = 0; i < 8; i++) {
    Rod rod;
    rod.length = 0.08 + 0.02 * any(random);
    rod.position = 0.07 * Vec3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
    rod.axis = random_direction(random);
    rod.velocity = -12.0 * rod.position + 0.2 * random_direction(random);
    rod.omega = 5.0 * random_direction(random);
    scene.rods.push_back(rod);
  }
  scene.physics = kColliding;
  scene.dt = 1e-5;
  scene.steps = 8000;
  scene.dump_every = 4000;
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.5;
    scene.box_hi[d] = 0.5;
  }
  return scene;
}

// Largest difference of the motions: positions (m), axes up to their sign.
double difference(const std::vector<Rod> &a, const std::vector<Rod> &b)
{
  double largest = 0.0;
  for (size_t i = 0; i < a.size(); i++) {
    largest = std::max(largest, norm(a[i].position - b[i].position));
    largest = std::max(largest, norm(cross(a[i].axis, b[i].axis)) * a[i].half_cylinder());
  }
  return largest;
}

const std::vector<Rod> &reference()
{
  static const std::vector<Rod> rods = run(cluster()).back().rods;
  return rods;
}

void expect_same(const std::string &what, const std::vector<Rod> &rods)
{
  ASSERT_EQ(rods.size(), reference().size());
  expect_holds({"Invariance, " + what + ": position (m)", "same scene", kSameMotion},
               difference(rods, reference()));
}

TEST(Invariance, TheReferenceCollides)
{
  const Scene scene = cluster();
  EXPECT_LT(kinetic_energy(reference()), 0.9 * kinetic_energy(scene.rods));
  EXPECT_LT(norm(momentum(reference()) - momentum(scene.rods)), 1e-12 * scene.rods[0].mass());
}

TEST(Invariance, RotatedScene)
{
  const spherocylinder::Quaternion q = spherocylinder::normalized({0.3, -0.5, 0.7, 0.2});
  // The columns of the rotation are the turned unit vectors; axis_of turns z.
  const Vec3 ez = axis_of(q);
  const Vec3 ex = axis_of(q * spherocylinder::rotation_about({0.0, 1.0, 0.0}, std::acos(0.0)));
  const Vec3 ey = cross(ez, ex);
  const auto turn = [&](const Vec3 &a) { return a.x * ex + a.y * ey + a.z * ez; };
  const auto turn_back = [&](const Vec3 &a) { return Vec3{dot(a, ex), dot(a, ey), dot(a, ez)}; };
  const auto turn_rod = [](Rod rod, const std::function<Vec3(const Vec3 &)> &by) {
    rod.position = by(rod.position);
    rod.axis = by(rod.axis);
    rod.velocity = by(rod.velocity);
    rod.omega = by(rod.omega);
    return rod;
  };
  Scene scene = cluster();
  for (Rod &rod : scene.rods) rod = turn_rod(rod, turn);
  std::vector<Rod> rods = run(scene).back().rods;
  for (Rod &rod : rods) rod = turn_rod(rod, turn_back);
  expect_same("rotated scene", rods);
}

TEST(Invariance, NumbersOfTheRods)
{
  Scene scene = cluster();
  std::reverse(scene.rods.begin(), scene.rods.end());
  std::vector<Rod> rods = run(scene).back().rods;
  std::reverse(rods.begin(), rods.end());
  expect_same("i and j swapped", rods);
}

TEST(Invariance, SignsOfTheAxes)
{
  Scene scene = cluster();
  for (Rod &rod : scene.rods) rod.axis = -rod.axis;
  expect_same("axes u -> -u", run(scene).back().rods);
}

// In a periodic box with the cluster's middle on a corner, so that rods meet across every boundary.
TEST(Invariance, PeriodicImages)
{
  for (const Mode mode : {Mode::OneRank, Mode::TwoRanks}) {
    Scene scene = cluster();
    scene.boundary = "p p p";
    const auto wrap = [](double x) { return x - std::round(x); };  // box from -0.5 to 0.5
    const Vec3 corner = {0.5, 0.5, 0.5};
    for (Rod &rod : scene.rods) {
      const Vec3 moved = rod.position + corner;
      rod.position = {wrap(moved.x), wrap(moved.y), wrap(moved.z)};
    }
    std::vector<Rod> rods = run(scene, mode).back().rods;
    for (size_t i = 0; i < rods.size(); i++) {
      const Vec3 &near = reference()[i].position;
      const Vec3 away = rods[i].position - corner - near;
      rods[i].position = near + Vec3{wrap(away.x), wrap(away.y), wrap(away.z)};
    }
    expect_same("across periodic boundaries", rods);
  }
}

TEST(Invariance, ContactsAcrossTheCutOfTwoRanks)
{
  expect_same("1 and 2 ranks", run(cluster(), Mode::TwoRanks).back().rods);
}

TEST(Invariance, Repeatable)
{
  EXPECT_EQ(difference(run(cluster()).back().rods, reference()), 0.0);
}

class Mixture : public RunMode {};

// 64 rods of several lengths and diameters, and spheres, thrown together.
TEST_P(Mixture, KeepsMomentumAndAngularMomentum)
{
  std::mt19937 random(40009);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const double ratios[] = {1.0, 1.5, 4.0, 10.0};
  Scene scene;
  for (int i = 0; i < 64; i++) {
    Rod rod;
    rod.diameter = i % 3 == 0 ? 0.006 : 0.01;
    rod.length = ratios[i % 4] * rod.diameter;
    rod.density = i % 5 == 0 ? 1000.0 : 2700.0;
    rod.position = 0.11 * Vec3{i % 4 - 1.5, i / 4 % 4 - 1.5, i / 16 - 1.5};
    rod.axis = random_direction(random);
    rod.velocity = -15.0 * rod.position + 0.3 * random_direction(random);
    rod.omega = 5.0 * random_direction(random);
    scene.rods.push_back(rod);
  }
  scene.physics = kColliding;
  scene.dt = 1e-5;
  scene.steps = 10000;
  scene.dump_every = 2000;

  const Vec3 point = {0.1, 0.2, -0.1};
  double linear_scale = 0.0, angular_scale = 0.0;
  for (const Rod &rod : scene.rods) {
    linear_scale += rod.mass() * norm(rod.velocity);
    angular_scale += rod.mass() * norm(rod.velocity) * norm(rod.position - point);
  }
  double linear = 0.0, angular = 0.0, energy = 1.0;
  for (const Frame &frame : run(scene, GetParam())) {
    linear = std::max(linear, norm(momentum(frame.rods) - momentum(scene.rods)) / linear_scale);
    angular = std::max(
        angular, norm(angular_momentum(frame.rods, point) - angular_momentum(scene.rods, point)) /
                     angular_scale);
    energy = kinetic_energy(frame.rods) / kinetic_energy(scene.rods);
  }
  EXPECT_LT(energy, 0.9) << "the rods must have collided";
  expect_holds({"64 rods and spheres of mixed sizes: momentum, relative", "conserved", 1e-13},
               linear);
  expect_holds(
      {"64 rods and spheres of mixed sizes: angular momentum, relative", "conserved", 1e-12},
      angular);
}

DECKS_IN_ALL_MODES(Mixture);

}  // namespace
