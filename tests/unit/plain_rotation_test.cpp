// SPDX-License-Identifier: GPL-2.0-or-later
// The plain rotation does what it is said to do wrong, in closed form, and comes to the exact one as
// the step goes to zero.
#include "core/plain_rotation.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/mass_properties.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

struct Spin {
  Quaternion q;
  Vec3 omega_body;
};

// A step of fix nve/spherocylinder, rotation plain, without torque.
Spin stepped(Spin spin, const MassProperties &rod, double dt)
{
  constexpr Vec3 kNone = {0.0, 0.0, 0.0};
  const auto kick = [&] {
    spin.omega_body =
        kicked_plainly(spin.omega_body, kNone, rod.inertia_axial, rod.inertia_transverse, 0.5 * dt);
  };
  kick();
  spin.q = turned_plainly(spin.q, spin.omega_body, dt);
  kick();
  return spin;
}

double across_axis(const Vec3 &omega_body) { return std::hypot(omega_body.x, omega_body.y); }

Vec3 momentum_of(const Spin &spin, const MassProperties &rod)
{
  return angular_momentum(rotated(spin.omega_body, spin.q), axis_of(spin.q), rod.inertia_axial,
                          rod.inertia_transverse);
}

// How far the axis is from where rotate_freely has it after the time.
double axis_error(const Spin &start, const MassProperties &rod, double time, int steps)
{
  Spin spin = start;
  for (int k = 0; k < steps; k++) spin = stepped(spin, rod, time / steps);
  const Quaternion exact = rotate_freely(start.q, momentum_of(start, rod), rod.inertia_axial,
                                         rod.inertia_transverse, time);
  return norm(axis_of(spin.q) - axis_of(exact));
}

}  // namespace

// Closed form: in each half step the part across the axis turns by atan x and grows by
// sqrt(1 + x^2), x = (1 - I_a/I_t) omega_z dt/2; the part along it stays. Rounding adds up to an
// epsilon or two a step.
TEST(PlainRotation, GrowsAcrossTheAxis)
{
  constexpr int kSteps = 20000;
  RandomRods random(67867967);
  for (const double aspect_ratio : {1.0, 1.5, 10.0, 30.0}) {
    const MassProperties rod = mass_properties(0.01, aspect_ratio * 0.01, kDensity);
    const Spin start = {rotation_about(random.direction(), 1.0), {3.0, -4.0, 200.0}};
    const double dt = 1e-4;
    const double x = 0.5 * dt * (1.0 - rod.inertia_axial / rod.inertia_transverse) * 200.0;
    Spin spin = start;
    for (int k = 0; k < kSteps; k++) spin = stepped(spin, rod, dt);
    const double growth = std::exp(kSteps * std::log1p(x * x));
    EXPECT_NEAR(across_axis(spin.omega_body) / 5.0 / growth, 1.0, 4 * kSteps * kEpsilon);
    EXPECT_EQ(spin.omega_body.z, 200.0);
    // It turns against omega_z in the body, which turns the other way.
    const double angle = std::atan2(-4.0, 3.0) - 2.0 * kSteps * std::atan(x);
    EXPECT_NEAR(spin.omega_body.x / across_axis(spin.omega_body), std::cos(angle), 1e-9);
    EXPECT_NEAR(spin.omega_body.y / across_axis(spin.omega_body), std::sin(angle), 1e-9);
  }
}

// Closed form: about a fixed axis it turns by 2 atan(|omega| dt/2) a step, whatever the step.
TEST(PlainRotation, TurnsByTheArcTangent)
{
  const MassProperties ball = mass_properties(0.01, 0.01, kDensity);
  RandomRods random(86028121);
  for (const double angle : {1e-3, 0.1, 1.0, 3.0}) {
    const Vec3 direction = random.direction();
    Spin spin = {rotation_about(random.direction(), 2.0), {}};
    spin.omega_body = in_body_frame(direction, spin.q);
    const Vec3 before = axis_of(spin.q);
    spin = stepped(spin, ball, angle);
    EXPECT_LT(norm(axis_of(spin.q) - turned(before, direction, 2.0 * std::atan(0.5 * angle))),
              10 * kEpsilon);
  }
}

// The energy across the axis grows by exp(Omega^2 dt t/2), Omega = (1 - I_a/I_t) omega_z: first
// order in the step. rotate_freely knows no step.
TEST(PlainRotation, IsOfFirstOrder)
{
  for (const double aspect_ratio : {2.0, 10.0, 30.0}) {
    const MassProperties rod = mass_properties(0.01, aspect_ratio * 0.01, kDensity);
    const Spin start = {rotation_about({0.6, 0.0, 0.8}, 0.7), {30.0, 10.0, 60.0}};
    const double coarse = axis_error(start, rod, 0.1, 2000);
    const double fine = axis_error(start, rod, 0.1, 8000);
    EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 1.0, 0.05) << aspect_ratio;
    EXPECT_LT(fine, 1e-2);
  }
}

// A torque about the axis of a rod at rest, and one across it, turn it by T dt/I.
TEST(PlainRotation, KicksByTheTorque)
{
  const Vec3 omega = kicked_plainly({0.0, 0.0, 0.0}, {6.0, -8.0, 3.0}, 0.5, 2.0, 0.1);
  EXPECT_DOUBLE_EQ(omega.x, 0.3);
  EXPECT_DOUBLE_EQ(omega.y, -0.4);
  EXPECT_DOUBLE_EQ(omega.z, 0.6);
}
