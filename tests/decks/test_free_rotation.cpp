// SPDX-License-Identifier: GPL-2.0-or-later
// A rod that touches nothing is a free symmetric top: its angular momentum L is fixed, its axis
// precesses about L at |L| / I_t on a cone with cos(cone) = L.u / |L|. With rotation plain it does
// not quite, in closed form too.
#include <algorithm>
#include <cmath>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

class FreeRotation : public RunMode {};

Scene free_rods()
{
  Scene scene;
  const double ratios[] = {2.0, 10.0, 30.0};
  for (int i = 0; i < 3; i++) {
    Rod rod;
    rod.length = ratios[i] * rod.diameter;
    rod.position = {-0.4 + 0.4 * i, 0.1, 0.0};
    rod.axis = normalized({0.3, -0.5, 0.8 - i});
    rod.omega = Vec3{12.0, -20.0, 5.0 * i} + 300.0 * rod.axis;
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e5, 1e5, 0.5, 0.2) + rod_pair("linear tangential history") +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-5;
  scene.steps = 100000;
  scene.dump_every = 20000;
  return scene;
}

// The axis turned about the direction of L by the angle |L| / I_t t (Rodrigues' formula).
Vec3 precessed(const Rod &start, double time)
{
  const Vec3 L = start.angular_momentum();
  const Vec3 n = normalized(L), u = start.axis;
  const double angle = norm(L) / start.properties().inertia_transverse * time;
  return std::cos(angle) * u + std::sin(angle) * cross(n, u) +
         (1.0 - std::cos(angle)) * dot(n, u) * n;
}

TEST_P(FreeRotation, PrecessesAboutItsAngularMomentum)
{
  Scene scene = free_rods();
  if (GetParam() != Mode::OneRank) scene.steps /= 5;
  double momentum_error = 0.0, cone_error = 0.0, axis_error = 0.0;
  for (const Frame &frame : run(scene, GetParam()))
    for (size_t i = 0; i < scene.rods.size(); i++) {
      const Rod &start = scene.rods[i], &now = frame.rods[i];
      const Vec3 L0 = start.angular_momentum(), L = now.angular_momentum();
      momentum_error = std::max(momentum_error, norm(L - L0) / norm(L0));
      const double cone0 = std::acos(dot(normalized(L0), start.axis));
      cone_error = std::max(cone_error, std::fabs(std::acos(dot(normalized(L), now.axis)) - cone0));
      axis_error = std::max(axis_error, norm(now.axis - precessed(start, frame.time)));
    }
  // 10^5 steps of round-off, which grows like a random walk or at worst linearly.
  expect_holds({"Free precession: angular momentum, relative", "L fixed", 1e-11}, momentum_error);
  expect_holds({"Free precession: cone angle (rad)", "cos(cone) = L.u/abs(L)", 1e-10}, cone_error);
  expect_holds({"Free precession: direction of the axis after 10^5 steps", "rate abs(L)/I_t", 1e-9},
               axis_error);
}

// The closed form holds for any step: these rods turn and spin by up to 1.5 rad in one, beside one
// that hardly moves. Rounding is that of the phase, epsilon times some 1500 rad, and of 1000 steps.
TEST_P(FreeRotation, FarInAStep)
{
  Scene scene = free_rods();
  for (size_t i = 0; i < scene.rods.size(); i++) {
    Rod &rod = scene.rods[i];
    const Vec3 across = normalized(cross(rod.axis, {0.0, 0.0, 1.0}));
    rod.omega = i == 1 ? Vec3{1e-3, 2e-3, 0.0} : 300.0 * across + 300.0 * rod.axis;
  }
  scene.dt = 5e-3;
  scene.steps = 1000;
  scene.dump_every = 200;
  double error = 0.0;
  for (const Frame &frame : run(scene, GetParam()))
    for (size_t i = 0; i < scene.rods.size(); i++)
      error = std::max(error, norm(frame.rods[i].axis - precessed(scene.rods[i], frame.time)));
  expect_holds(
      {"Free precession, up to 1.5 rad a step: direction of the axis", "rate abs(L)/I_t", 1e-11},
      error);
}

double across_axis(const Rod &rod) { return norm(rod.omega - dot(rod.omega, rod.axis) * rod.axis); }

// Closed form: each half step, that is explicit Euler in the body frame, multiplies the part across
// the axis by sqrt(1 + x^2), x = (1 - I_a/I_t) omega_a dt/2. Rounding of 40,000 steps.
TEST_P(FreeRotation, PlainRotationGrowsAcrossTheAxis)
{
  Scene scene = free_rods();
  scene.physics += "unfix motion\nfix motion all nve/spherocylinder rotation plain\n";
  scene.dt = 5e-5;
  scene.steps = 40000;
  double error = 0.0, growth = 0.0;
  for (const Frame &frame : run(scene, GetParam()))
    for (size_t i = 0; i < scene.rods.size(); i++) {
      const Rod &start = scene.rods[i];
      const auto p = start.properties();
      const double x = 0.5 * scene.dt * (1.0 - p.inertia_axial / p.inertia_transverse) *
                       dot(start.omega, start.axis);
      growth = std::exp(static_cast<double>(frame.step) * std::log1p(x * x));
      const double grown = across_axis(frame.rods[i]) / across_axis(start);
      error = std::max(error, std::fabs(grown / growth - 1.0));
    }
  EXPECT_GT(growth, 2.0) << "the test must be one";
  expect_holds({"Free rod, rotation plain: omega across the axis, relative",
                "(1 + ((1 - I_a/I_t) omega_a dt/2)^2)^steps", 1e-11},
               error);
}

// To the last bit.
TEST(RotationOption, ExactIsTheDefault)
{
  std::vector<Frame> ends[2];
  for (const bool named : {false, true}) {
    Scene scene = free_rods();
    scene.steps = 2000;
    scene.physics +=
        named ? "unfix motion\nfix motion all nve/spherocylinder rotation exact\n" : "";
    ends[named] = run(scene);
  }
  EXPECT_EQ(largest_difference(ends[0], ends[1]), 0.0);
}

DECKS_IN_ALL_MODES(FreeRotation);

}  // namespace
