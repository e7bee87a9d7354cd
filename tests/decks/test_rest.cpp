// SPDX-License-Identifier: GPL-2.0-or-later
// Rods under gravity on floors and supports: how deep they sink, how they fall over and swing.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

class Rest : public RunMode {};

constexpr double kGravity = 9.81;
constexpr double kStiffness = 1e5;
const char *const kWeight = "fix weight all gravity 9.81 vector 0 0 -1\n";

// Flat on a plane: m g / 2 at each end, sink m g/(2 k), no rocking.
TEST_P(Rest, FlatRodSinksAndDoesNotRock)
{
  Scene scene;
  scene.box_lo[2] = -0.1;
  for (const double ratio : {5.0, 10.0, 30.0}) {
    Rod rod;
    rod.length = ratio * rod.diameter;
    rod.axis = normalized({1.0, 0.3, 0.0});
    rod.position = {0.0, -0.4 + 0.02 * ratio, rod.radius() + 1e-4};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(kStiffness, kStiffness, 0.1, 0.2) +
                  rod_pair("linear tangential history") +
                  rod_wall("floor", "linear tangential history", "type 1 zplane 0.0") +
                  "fix motion all nve/spherocylinder\n" + kWeight;
  scene.dt = 1e-5;
  scene.steps = 30000;
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  double sink_error = 0.0, rocking = 0.0;
  for (const Rod &rod : after) {
    const double sink = rod.mass() * kGravity / (2.0 * kStiffness);
    sink_error = std::max(sink_error, std::fabs((rod.radius() - rod.position.z) / sink - 1.0));
    rocking = std::max(rocking, std::fabs(rod.axis.z));
  }
  // The sink is a difference of numbers 10^4 times as large.
  expect_holds({"Flat rod: sink, relative", "m g/(2 k)", 1e-9}, sink_error);
  expect_holds({"Flat rod: slope of its axis", "0", 1e-12}, rocking);
}

// aspect_scaling on multiplies the stiffness by the aspect ratio: on a wall the sink is
// m g/(2 k lambda).
TEST_P(Rest, AspectScalingMakesLongRodsStiffer)
{
  Scene scene;
  scene.box_lo[2] = -0.1;
  for (const double ratio : {1.0, 5.0, 20.0}) {
    Rod rod;
    rod.length = ratio * rod.diameter;
    rod.position = {0.0, -0.4 + 0.02 * ratio, rod.radius()};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(kStiffness, kStiffness, 0.1, 0.2) +
                  "pair_style gran model linear tangential history surface spherocylinder "
                  "aspect_scaling on\npair_coeff * *\n"
                  "fix floor all wall/gran model linear tangential history surface spherocylinder "
                  "primitive type 1 zplane 0.0 aspect_scaling on\n"
                  "fix motion all nve/spherocylinder\n" +
                  kWeight;
  scene.dt = 1e-5;
  scene.steps = 30000;
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  double error = 0.0;
  for (const Rod &rod : after) {
    const int ends = rod.length > rod.diameter ? 2 : 1;
    const double stiffness = kStiffness * rod.length / rod.diameter;
    const double sink = rod.mass() * kGravity / (ends * stiffness);
    error = std::max(error, std::fabs((rod.radius() - rod.position.z) / sink - 1.0));
  }
  expect_holds({"Flat rods with aspect_scaling on: sink, relative", "m g/(2 k lambda)", 1e-9},
               error);
}

// On two fixed rods across it at -x1 and +x2: N1 = m g x2/(x1+x2), N2 = m g x1/(x1+x2).
TEST_P(Rest, TwoSupports)
{
  const double x1 = 0.02, x2 = 0.04;
  Scene scene;
  Rod rod, left, right;
  left.axis = right.axis = {0.0, 1.0, 0.0};
  left.position.x = -x1;
  right.position.x = x2;
  rod.position.z = rod.diameter;
  scene.rods = {rod, left, right};
  scene.physics = linear_material(kStiffness, kStiffness, 0.1, 0.5) +
                  rod_pair("linear tangential history") +
                  "group supports id 2 3\ngroup free id 1\n"
                  "fix hold supports freeze\nfix motion free nve/spherocylinder\n" +
                  std::string(kWeight);
  scene.dt = 1e-5;
  scene.steps = 30000;
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;

  // The force is k times the overlap of the crossing axes.
  const auto force = [&](const Rod &support) {
    const double along = support.position.x - after[0].position.x;
    const double height =
        after[0].position.z + along * after[0].axis.z / after[0].axis.x - support.position.z;
    return kStiffness * (rod.diameter - height * std::fabs(after[0].axis.x));
  };
  const double weight = rod.mass() * kGravity;
  const double error = std::max(std::fabs(force(after[1]) * (x1 + x2) / (weight * x2) - 1.0),
                                std::fabs(force(after[2]) * (x1 + x2) / (weight * x1) - 1.0));
  // The rod's slope, 10^-5, comes in squared.
  expect_holds({"Rod on two supports: forces, relative", "m g x2/(x1+x2)", 1e-8}, error);
  EXPECT_EQ(norm(after[1].position - left.position), 0.0);
}

// Topples on a frictionless floor: omega^2 = m g h (sin t0 - sin t)/(I_t + m (h/2)^2 cos^2 t), and
// the centre falls straight down.
TEST_P(Rest, TopplesOnAFrictionlessFloor)
{
  const double start_angle = degrees(75.0), kn = 1e6;
  Scene scene;
  scene.box_lo[2] = -0.1;
  Rod rod;
  rod.axis = {std::cos(start_angle), 0.0, std::sin(start_angle)};
  const auto p = rod.properties();
  const double h = 2.0 * rod.half_cylinder();
  // The foot carries N = m g / (1 + m a^2/I_t) at first.
  const double a = 0.5 * h * rod.axis.x;
  const double sink = p.mass * kGravity / (1.0 + p.mass * a * a / p.inertia_transverse) / kn;
  rod.position.z = rod.radius() + 0.5 * h * rod.axis.z - sink;
  scene.rods = {rod};
  scene.physics = linear_material(kn, kn, 0.1, 0.0) + rod_pair("linear tangential off") +
                  rod_wall("floor", "linear tangential off", "type 1 zplane 0.0") +
                  "fix motion all nve/spherocylinder\n" + kWeight;
  scene.dt = 2e-6;
  scene.steps = 100000;
  scene.dump_every = 1000;
  double rate_error = 0.0, drift = 0.0, lowest = 1.0;
  for (const Frame &frame : run(scene, GetParam())) {
    const Rod &now = frame.rods[0];
    const double sine = now.axis.z, cosine = now.axis.x;
    if (sine < 0.1) break;
    lowest = std::min(lowest, sine);
    const double expected =
        std::sqrt(p.mass * kGravity * h * (rod.axis.z - sine) /
                  (p.inertia_transverse + p.mass * 0.25 * h * h * cosine * cosine));
    if (sine < 0.9 * rod.axis.z)
      rate_error = std::max(rate_error, std::fabs(now.omega.y / expected - 1.0));
    drift = std::max(drift, std::fabs(now.position.x));
  }
  EXPECT_LT(lowest, 0.2) << "the rod must have fallen over";
  // The foot's spring gives way by N/k = 2e-7 m of 0.1 m, and the dashpot damps the sink's changes.
  expect_holds({"Topple on a frictionless floor: angular velocity, relative",
                "omega^2 = m g h (sin t0 - sin t)/(I_t + m (h/2)^2 cos^2 t)", 1e-4},
               rate_error);
  expect_holds({"Topple: sideways move of the centre (m)", "0", 1e-12}, drift);
}

// In a cylindrical trough along y (radius R, axis at z = R; LIGGGHTS's ycylinder takes radius, z,
// x): along the trough a rod rests on two ends, sink m g/(2 k), and swings as a pendulum of length
// R - r + sink; across it, each end carries N = m g/(2 cos(phi)), sin(phi) = (h/2)/(R - r + N/k).
TEST_P(Rest, CylindricalTrough)
{
  const double R = 0.2;
  Scene scene;
  scene.box_lo[2] = -0.1;
  Rod along;
  along.axis = {0.0, 1.0, 0.0};
  along.position = {0.0, -0.4, along.radius() + 1e-5};
  Rod swinging = along;
  const double sink = along.mass() * kGravity / (2.0 * kStiffness);
  const double pendulum = R - along.radius() + sink;
  const double amplitude = 0.01;
  swinging.position = {pendulum * std::sin(amplitude), 0.0, R - pendulum * std::cos(amplitude)};
  Rod across;
  const double half = across.half_cylinder();
  across.position = {0.0, 0.4, R - std::sqrt(std::pow(R - across.radius(), 2) - half * half)};
  scene.rods = {along, swinging, across};
  scene.physics =
      linear_material(kStiffness, kStiffness, 0.1, 0.0) + rod_pair("linear tangential off") +
      rod_wall("trough", "linear tangential off", fmt::format("type 1 ycylinder {} {} 0.0", R, R)) +
      "fix motion all nve/spherocylinder\n" + kWeight;
  scene.dt = 1e-5;
  const double period = 2.0 * std::acos(-1.0) * std::sqrt(pendulum / kGravity);
  scene.steps = 2 * std::lround(0.375 * period / scene.dt);
  const Frame end = run(scene, GetParam()).back();

  expect_holds({"Rod along a trough: sink, relative", "m g/(2 k)", 1e-9},
               std::fabs((along.radius() - end.rods[0].position.z) / sink - 1.0));
  // After three quarters of a period it passes the bottom: x/amplitude is the error in phase. A
  // pendulum of amplitude A is slower by A^2/16.
  expect_holds(
      {"Rod along a trough swings: phase after 3/4 period (rad)", "2 pi sqrt((R-r)/g)", 2e-4},
      std::fabs(end.rods[1].position.x / (pendulum * amplitude)));
  const double overlap_across =
      std::hypot(half, R - end.rods[2].position.z) - (R - across.radius());
  const double cosine = (R - end.rods[2].position.z) / std::hypot(half, R - end.rods[2].position.z);
  expect_holds(
      {"Rod across a trough: force at its ends, relative", "m g/(2 cos(phi))", 1e-9},
      std::fabs(overlap_across * kStiffness * 2.0 * cosine / (across.mass() * kGravity) - 1.0));
}

DECKS_IN_ALL_MODES(Rest);

}  // namespace
