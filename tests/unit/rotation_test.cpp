// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/rotation.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "core/mass_properties.h"
#include "core/rotation_batch.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

constexpr double kAspectRatios[] = {1.0, 1.5, 10.0, 30.0};

double norm(const Quaternion &q)
{
  return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
}

Quaternion conjugate(const Quaternion &q) { return {q.w, -q.x, -q.y, -q.z}; }

// Body x and y in the space frame (first columns of q's matrix).
Vec3 body_x(const Quaternion &q)
{
  return {1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z),
          2.0 * (q.x * q.z - q.w * q.y)};
}

Vec3 body_y(const Quaternion &q)
{
  return {2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z),
          2.0 * (q.y * q.z + q.w * q.x)};
}

// Largest distance between the body axes of two orientations (q and -q are one orientation).
double orientation_difference(const Quaternion &a, const Quaternion &b)
{
  return std::max(
      {norm(body_x(a) - body_x(b)), norm(body_y(a) - body_y(b)), norm(axis_of(a) - axis_of(b))});
}

// A rod thrown with any spin and orientation.
struct Top {
  double inertia_axial, inertia_transverse;
  Quaternion start;
  Vec3 angular_momentum;

  double precession_rate() const { return norm(angular_momentum) / inertia_transverse; }
  Vec3 precession_axis() const { return (1.0 / norm(angular_momentum)) * angular_momentum; }
  Quaternion after(double time) const { return moved(start, time); }
  Quaternion moved(const Quaternion &q, double time) const
  {
    return rotate_freely(q, angular_momentum, inertia_axial, inertia_transverse, time);
  }
  // Fastest angle per unit time of precession or spin.
  double rate() const
  {
    const double along = std::fabs(dot(angular_momentum, axis_of(start)));
    return precession_rate() + along / inertia_axial;
  }
};

Quaternion random_orientation(RandomRods &random)
{
  return rotation_about(random.direction(), random.uniform(-kPi, kPi));
}

Top random_top(RandomRods &random, double diameter, double aspect_ratio)
{
  const MassProperties p = mass_properties(diameter, aspect_ratio * diameter, kDensity);
  Top top{p.inertia_axial, p.inertia_transverse, random_orientation(random), {}};
  const Vec3 omega = random.log_uniform(0.1, 1e3) * random.direction();
  top.angular_momentum =
      angular_momentum(omega, axis_of(top.start), p.inertia_axial, p.inertia_transverse);
  return top;
}

// Runs check(top) over sizes, aspect ratios and random throws.
template <class Check>
void for_random_tops(int throws, Check check)
{
  RandomRods random(32452843);
  for (const double diameter : kDiameters)
    for (const double aspect_ratio : kAspectRatios)
      for (int k = 0; k < throws; k++) check(random_top(random, diameter, aspect_ratio), random);
}

// Euler's equations of a symmetric top in the body frame, with the kinematics
// dq/dt = q (0, omega_body)/2; classical fourth-order Runge-Kutta.
using State = std::array<double, 7>;  // w, x, y, z, omega_body

State rate_of_change(const State &state, double inertia_axial, double inertia_transverse)
{
  const Quaternion q{state[0], state[1], state[2], state[3]};
  const Vec3 omega_body{state[4], state[5], state[6]};
  const Quaternion dq = q * Quaternion{0.0, omega_body.x, omega_body.y, omega_body.z};
  const double k = (inertia_transverse - inertia_axial) / inertia_transverse;
  return {0.5 * dq.w,
          0.5 * dq.x,
          0.5 * dq.y,
          0.5 * dq.z,
          k * omega_body.y * omega_body.z,
          -k * omega_body.z * omega_body.x,
          0.0};
}

State sum(const State &a, double factor, const State &b)
{
  State result;
  for (std::size_t k = 0; k < a.size(); k++) result[k] = a[k] + factor * b[k];
  return result;
}

Quaternion integrated(const Top &top, double time, int steps)
{
  const Vec3 omega = angular_velocity(top.angular_momentum, axis_of(top.start), top.inertia_axial,
                                      top.inertia_transverse);
  State state{top.start.w,
              top.start.x,
              top.start.y,
              top.start.z,
              dot(omega, body_x(top.start)),
              dot(omega, body_y(top.start)),
              dot(omega, axis_of(top.start))};
  const double dt = time / steps;
  const auto rate = [&](const State &s) {
    return rate_of_change(s, top.inertia_axial, top.inertia_transverse);
  };
  for (int step = 0; step < steps; step++) {
    const State k1 = rate(state);
    const State k2 = rate(sum(state, 0.5 * dt, k1));
    const State k3 = rate(sum(state, 0.5 * dt, k2));
    const State k4 = rate(sum(state, dt, k3));
    state = sum(sum(sum(sum(state, dt / 6.0, k1), dt / 3.0, k2), dt / 3.0, k3), dt / 6.0, k4);
  }
  return normalized({state[0], state[1], state[2], state[3]});
}

void expect_quaternion(const Quaternion &q, double w, double x, double y, double z)
{
  EXPECT_NEAR(q.w, w, 2 * kEpsilon);
  EXPECT_NEAR(q.x, x, 2 * kEpsilon);
  EXPECT_NEAR(q.y, y, 2 * kEpsilon);
  EXPECT_NEAR(q.z, z, 2 * kEpsilon);
}

// Directions in which a formula for the shortest rotation loses its digits, both ways round.
std::array<Vec3, 12> awkward_directions(double small, double z_sign)
{
  const double z = z_sign * std::sqrt((1.0 - small) * (1.0 + small));
  const double s = small * std::sqrt(0.5);
  return {{{small, 0.0, z},
           {-small, 0.0, z},
           {0.0, small, z},
           {0.0, -small, z},
           {s, s, z},
           {-s, s, z},
           {s, -s, z},
           {-s, -s, z},
           // the same round the equator
           {z, 0.0, small},
           {z, 0.0, -small},
           {0.0, z, small},
           {0.0, z, -small}}};
}

}  // namespace

TEST(FreeRotation, KeepsUnitNorm)
{
  double worst = 0.0;
  for_random_tops(20, [&](const Top &top, RandomRods &random) {
    Quaternion q = top.start;
    for (int step = 0; step < 1000; step++) {
      q = top.moved(q, random.log_uniform(1e-9, 10.0));
      worst = std::max(worst, std::fabs(norm(q) - 1.0));
    }
  });
  EXPECT_LE(worst, 2 * kEpsilon);
}

// Closed form: L and omega_3 are constant, and so is the cone, cos = L.u/|L| = I_a omega_3/|L|.
// A step rounds the axis by about one epsilon in any direction.
TEST(FreeRotation, KeepsConeAngle)
{
  constexpr int kSteps = 10000;
  double worst = 0.0;
  for_random_tops(5, [&](const Top &top, RandomRods &) {
    const double omega_3 = dot(angular_velocity(top.angular_momentum, axis_of(top.start),
                                                top.inertia_axial, top.inertia_transverse),
                               axis_of(top.start));
    const double cone = top.inertia_axial * omega_3 / norm(top.angular_momentum);
    Quaternion q = top.start;
    for (int step = 0; step < kSteps; step++) {
      q = top.moved(q, 0.1 / top.rate());
      worst = std::max(worst, std::fabs(dot(axis_of(q), top.precession_axis()) - cone));
    }
  });
  std::printf("cone angle after %d steps: worst drift of the cosine %.1e\n", kSteps, worst);
  EXPECT_LT(worst, kSteps * kEpsilon);
}

// Closed form: the axis turns about L at |L|/I_t. A million steps of 0.01 rad; rounding adds up to
// at most one epsilon a step in the axis and one in the angle of that step.
TEST(FreeRotation, PrecessesAtClosedFormRate)
{
  constexpr int kSteps = 1000000;
  RandomRods random(49979687);
  for (const double aspect_ratio : kAspectRatios) {
    const Top top = random_top(random, 0.01, aspect_ratio);
    const double dt = 0.01 / top.precession_rate();
    Quaternion q = top.start;
    for (int step = 0; step < kSteps; step++) q = top.moved(q, dt);
    const long double angle = static_cast<long double>(top.precession_rate()) * dt * kSteps;
    const Vec3 expected = turned(axis_of(top.start), top.precession_axis(), angle);
    const double error = norm(axis_of(q) - expected);
    std::printf("lambda %4.1f: axis error %.1e after %d steps, %.0f rad\n", aspect_ratio, error,
                kSteps, static_cast<double>(angle));
    EXPECT_LT(error, kSteps * kEpsilon);
  }
}

// The closed form is exact for any step: n steps of dt are one of n dt. A step rounds the axis by
// about one epsilon, and the phase of n dt by an epsilon of itself. The spin about the axis follows
// L.u/I_a, which that epsilon of the axis changes by epsilon |L|/I_a: the turn of the body about
// its own axis is good to epsilon |L|/I_a times the time only, also for a rod that hardly spins.
TEST(FreeRotation, StepsCompose)
{
  constexpr int kSteps = 1000;
  double worst_axis = 0.0, worst_body = 0.0;
  for_random_tops(20, [&](const Top &top, RandomRods &random) {
    const double dt = random.log_uniform(1e-6, 10.0) / top.rate(), time = kSteps * dt;
    Quaternion q = top.start;
    for (int step = 0; step < kSteps; step++) q = top.moved(q, dt);
    const Quaternion once = top.after(time);
    const double precession = top.precession_rate() * time;
    const double fastest = norm(top.angular_momentum) / top.inertia_axial * time;
    worst_axis =
        std::max(worst_axis, norm(axis_of(q) - axis_of(once)) / (kEpsilon * (kSteps + precession)));
    worst_body = std::max(worst_body,
                          orientation_difference(q, once) / (kEpsilon * kSteps * (1.0 + fastest)));
  });
  std::printf("composition: axis %.2f epsilon (steps + angle), body %.3f epsilon steps |L|t/I_a\n",
              worst_axis, worst_body);
  EXPECT_LT(worst_axis, 4.0);
  EXPECT_LT(worst_body, 4.0);
}

// Rounding as above, for a single step.
TEST(FreeRotation, NegativeStepGoesBack)
{
  double worst = 0.0;
  for_random_tops(1000, [&](const Top &top, RandomRods &random) {
    const double time = random.log_uniform(1e-6, 100.0) / top.rate();
    const double fastest = norm(top.angular_momentum) / top.inertia_axial * time;
    worst = std::max(worst, orientation_difference(top.moved(top.after(time), -time), top.start) /
                                (kEpsilon * (1.0 + fastest)));
  });
  std::printf("there and back: worst %.2f epsilon (1 + |L|t/I_a)\n", worst);
  EXPECT_LT(worst, 32.0);
}

// Independent slow method: Runge-Kutta on Euler's equations follows the whole body, spin about the
// axis included. Halving its step divides the difference by 2^4 until it is all rounding, which
// shows that the limit is the closed form.
TEST(FreeRotation, EulerEquationsConvergeToIt)
{
  RandomRods random(67867967);
  for (const double aspect_ratio : kAspectRatios)
    for (int k = 0; k < 10; k++) {
      const Top top = random_top(random, 0.01, aspect_ratio);
      const double time = 20.0 / top.rate();
      const Quaternion exact = top.after(time);
      const double coarse = orientation_difference(integrated(top, time, 400), exact);
      const double medium = orientation_difference(integrated(top, time, 800), exact);
      const double fine = orientation_difference(integrated(top, time, 12800), exact);
      EXPECT_NEAR(std::log2(coarse / medium), 4.0, 0.1) << "lambda " << aspect_ratio;
      EXPECT_LT(fine, 2e-12) << "lambda " << aspect_ratio;
    }
}

// The angular velocity of the motion gives back L: omega from a difference of orientations over
// +-step, 2 vec(q+ q-*)/(2 step), with its step^2 error removed by halving (Richardson).
TEST(FreeRotation, MotionCarriesItsAngularMomentum)
{
  double worst = 0.0;
  for_random_tops(50, [&](const Top &top, RandomRods &random) {
    const double now = random.uniform(0.0, 10.0) / top.rate();
    const auto difference = [&](double step) -> Vec3 {
      Quaternion turn = top.after(now + step) * conjugate(top.after(now - step));
      const double scale = (turn.w < 0.0 ? -1.0 : 1.0) / step;
      return {scale * turn.x, scale * turn.y, scale * turn.z};
    };
    const double step = 2e-3 / top.rate();
    const Vec3 omega = (4.0 / 3.0) * difference(0.5 * step) - (1.0 / 3.0) * difference(step);
    const Vec3 momentum =
        angular_momentum(omega, axis_of(top.after(now)), top.inertia_axial, top.inertia_transverse);
    worst = std::max(worst, norm(momentum - top.angular_momentum) / norm(top.angular_momentum));
  });
  std::printf("angular momentum of the motion: worst relative difference %.1e\n", worst);
  // Rounding of q over the step: epsilon/2e-3, times rate()/(|L|/I_t), up to I_t/I_a.
  EXPECT_LT(worst, 1e-9);
}

// Closed form for L = D: turns about L at |L|/I, as any sphere.
TEST(FreeRotation, SphereTurnsAboutItsAngularMomentum)
{
  RandomRods random(86028121);
  for (const double diameter : kDiameters)
    for (int k = 0; k < 1000; k++) {
      const Top top = random_top(random, diameter, 1.0);
      const double time = random.log_uniform(1e-3, 100.0) / top.precession_rate();
      const double angle = top.precession_rate() * time;
      const Quaternion q = top.after(time);
      for (const auto body_axis : {body_x, body_y, axis_of})
        ASSERT_LT(norm(body_axis(q) - turned(body_axis(top.start), top.precession_axis(), angle)),
                  8 * kEpsilon * (1.0 + angle));
    }
}

TEST(FreeRotation, NoAngularMomentumNoMotion)
{
  const Quaternion q{0.5, -0.5, 0.5, 0.5};
  const Quaternion same = rotate_freely(q, {0.0, 0.0, 0.0}, 1.0, 2.0, 1e9);
  EXPECT_TRUE(same.w == q.w && same.x == q.x && same.y == q.y && same.z == q.z);
}

// Closed forms: L along the axis spins the body at |L|/I_a and leaves the axis, also when L points
// against it; L across it tumbles the axis in a plane at |L|/I_t without spin.
TEST(FreeRotation, PureSpinAndPureTumble)
{
  const double axial = 0.5, transverse = 4.0, time = 0.7;
  for (const double sign : {1.0, -1.0}) {
    const Quaternion spun =
        rotate_freely({1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, sign * 2.0}, axial, transverse, time);
    const double angle = sign * 2.0 / axial * time;
    EXPECT_NEAR(norm(axis_of(spun) - Vec3{0.0, 0.0, 1.0}), 0.0, 4 * kEpsilon);
    EXPECT_NEAR(norm(body_x(spun) - Vec3{std::cos(angle), std::sin(angle), 0.0}), 0.0,
                8 * kEpsilon);
  }
  const Quaternion tumbled =
      rotate_freely({1.0, 0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, axial, transverse, time);
  const double angle = 2.0 / transverse * time;
  EXPECT_NEAR(norm(axis_of(tumbled) - Vec3{0.0, -std::sin(angle), std::cos(angle)}), 0.0,
              4 * kEpsilon);
  EXPECT_NEAR(norm(body_x(tumbled) - Vec3{1.0, 0.0, 0.0}), 0.0, 4 * kEpsilon);
}

namespace {

void set(RodRotations &rods, int k, const Top &top, const Quaternion &q)
{
  const double inertia[] = {top.inertia_transverse, top.inertia_transverse, top.inertia_axial};
  const double row[] = {q.w, q.x, q.y, q.z};
  rods.set(k, top.angular_momentum, inertia, row);
}

// The larger of the half angles that a step precesses and spins.
double half_angle(const Top &top, double dt)
{
  const double spin = dot(top.angular_momentum, axis_of(top.start)) *
                      (1.0 / top.inertia_axial - 1.0 / top.inertia_transverse);
  return 0.5 * dt * std::max(top.precession_rate(), std::fabs(spin));
}

}  // namespace

// The rods of a batch are its lanes: each must come out as it does alone, whatever the others are.
// Rods that turn too far are left to rotate_freely, and no others. Orientation and velocity differ
// by rounding.
TEST(FreeRotationBatch, EachRodTurnsAsItDoesAlone)
{
  double worst = 0.0, worst_omega = 0.0;
  int taken = 0, left = 0;
  RodRotations rods{};
  RandomRods random(15485867);
  for (int batch = 0; batch < 2000; batch++) {
    std::vector<Top> tops;
    const double dt = 1e-5;
    for (int k = 0; k < kBatch; k++) {
      Top top = random_top(random, kDiameters[random.below(5)], random.log_uniform(1.0, 100.0));
      const double faster = random.log_uniform(1e-6, 10.0) / (top.rate() * dt);
      top.angular_momentum = faster * top.angular_momentum;
      tops.push_back(top);
      set(rods, k, top, top.start);
    }
    rotate_freely(rods, dt);
    for (int k = 0; k < kBatch; k++) {
      const Top &top = tops[k];
      const double half = half_angle(top, dt);
      if (std::fabs(half - 0.1) > 1e-9) {
        EXPECT_EQ(rods.uncertain[k] != 0.0, half > 0.1) << half;
      }
      if (rods.uncertain[k] != 0.0) {
        left++;
        continue;
      }
      taken++;
      worst = std::max(worst, orientation_difference(rods.after(k), top.after(dt)));
      const Vec3 omega = angular_velocity(top.angular_momentum, axis_of(top.after(dt)),
                                          top.inertia_axial, top.inertia_transverse);
      worst_omega = std::max(worst_omega, norm(rods.omega.get(k) - omega) * top.inertia_axial /
                                              norm(top.angular_momentum));
    }
  }
  std::printf("batch: axes %.1e, omega %.1e |L|/I_a; %d rods, %d left out\n", worst, worst_omega,
              taken, left);
  EXPECT_GT(taken, 10000);
  EXPECT_GT(left, 1000);
  EXPECT_LT(worst, 8 * kEpsilon);
  EXPECT_LT(worst_omega, 8 * kEpsilon);
}

// As FreeRotation.PrecessesAtClosedFormRate.
TEST(FreeRotationBatch, PrecessesAtClosedFormRate)
{
  constexpr int kSteps = 100000;
  const double dt = 1e-5;
  RandomRods random(32452867);
  RodRotations rods{};
  std::vector<Top> tops;
  for (int k = 0; k < kBatch; k++) {
    Top top = random_top(random, 0.01, random.log_uniform(1.0, 100.0));
    top.angular_momentum = (0.02 / (top.rate() * dt)) * top.angular_momentum;
    tops.push_back(top);
    set(rods, k, top, top.start);
  }
  for (int step = 0; step < kSteps; step++) {
    rotate_freely(rods, dt);
    for (int k = 0; k < kBatch; k++) {
      ASSERT_EQ(rods.uncertain[k], 0.0);
      set(rods, k, tops[k], rods.after(k));
    }
  }
  double worst = 0.0;
  for (int k = 0; k < kBatch; k++) {
    const long double angle = static_cast<long double>(tops[k].precession_rate()) * dt * kSteps;
    const Vec3 expected = turned(axis_of(tops[k].start), tops[k].precession_axis(), angle);
    worst = std::max(worst, norm(axis_of(rods.before(k)) - expected));
  }
  std::printf("batch: axis error %.1e after %d steps\n", worst, kSteps);
  EXPECT_LT(worst, kSteps * kEpsilon);
}

// An orientation that is off unit length, as a user's may be, is left to rotate_freely.
TEST(FreeRotationBatch, OrientationOffUnitLengthIsLeftOut)
{
  RandomRods random(982451653);
  RodRotations rods{};
  for (int k = 0; k < kBatch; k++) {
    Top top = random_top(random, 0.01, 10.0);
    const double scale = k % 2 ? 1.0 + 1e-7 : 1.0 + 1e-10;
    const Quaternion q = top.start;
    set(rods, k, top, {scale * q.w, scale * q.x, scale * q.y, scale * q.z});
  }
  rotate_freely(rods, 1e-9);
  for (int k = 0; k < kBatch; k++) EXPECT_EQ(rods.uncertain[k] != 0.0, k % 2 == 1) << k;
}

TEST(FreeRotationBatch, AngularVelocities)
{
  RandomRods random(104395301);
  RodRotations rods{};
  for (int batch = 0; batch < 100; batch++) {
    std::vector<Top> tops;
    for (int k = 0; k < kBatch; k++) {
      const double ratio = random.log_uniform(1.0, 100.0);
      tops.push_back(random_top(random, kDiameters[random.below(5)], ratio));
      set(rods, k, tops[k], tops[k].start);
    }
    angular_velocities(rods);
    for (int k = 0; k < kBatch; k++) {
      const Vec3 wanted = angular_velocity(tops[k].angular_momentum, axis_of(tops[k].start),
                                           tops[k].inertia_axial, tops[k].inertia_transverse);
      ASSERT_LE(norm(rods.omega.get(k) - wanted),
                8 * kEpsilon * norm(tops[k].angular_momentum) / tops[k].inertia_axial);
    }
  }
}

TEST(Orientation, OfCoordinateAxes)
{
  const double c = std::sqrt(0.5);
  expect_quaternion(orientation_of({0.0, 0.0, 1.0}), 1.0, 0.0, 0.0, 0.0);
  expect_quaternion(orientation_of({0.0, 0.0, -1.0}), 0.0, 1.0, 0.0, 0.0);
  expect_quaternion(orientation_of({1.0, 0.0, 0.0}), c, 0.0, c, 0.0);
  expect_quaternion(orientation_of({0.0, 1.0, 0.0}), c, -c, 0.0, 0.0);
}

TEST(Orientation, AxisComesBackFromRandomDirections)
{
  RandomRods random(15487469);
  double worst = 0.0;
  for (int k = 0; k < 1000000; k++) {
    const Vec3 axis = random.direction();
    const Quaternion q = orientation_of(axis);
    ASSERT_NEAR(norm(q), 1.0, 2 * kEpsilon);
    worst = std::max(worst, norm(axis_of(q) - axis));
  }
  EXPECT_LT(worst, 4 * kEpsilon);
}

TEST(Orientation, AxisComesBackNearPolesAndEquator)
{
  for (int exponent = -300; exponent <= -1; exponent++)
    for (const double z_sign : {1.0, -1.0})
      for (const Vec3 &axis : awkward_directions(std::pow(10.0, exponent), z_sign)) {
        const Quaternion q = orientation_of(axis);
        ASSERT_NEAR(norm(q), 1.0, 2 * kEpsilon) << exponent;
        ASSERT_LT(norm(axis_of(q) - axis), 4 * kEpsilon) << exponent;
      }
}

// The shortest rotation from z turns about z x axis, at right angles to z and to the axis, by the
// angle between them.
TEST(Orientation, IsTheShortestRotation)
{
  RandomRods random(15487457);
  for (int k = 0; k < 100000; k++) {
    const Vec3 axis = random.direction();
    const Quaternion q = orientation_of(axis);
    ASSERT_NEAR(q.z, 0.0, 4 * kEpsilon);
    ASSERT_NEAR(q.x * axis.x + q.y * axis.y, 0.0, 4 * kEpsilon);
    ASSERT_NEAR(2.0 * std::acos(std::fabs(q.w)), std::acos(axis.z), 1e-7);
  }
}

// Both ways through the raw rows of the host.
TEST(Orientation, StoresAndLoadsRows)
{
  double row[4];
  store(Quaternion{0.1, 0.2, 0.3, 0.4}, row);
  const Quaternion q = load_quaternion(row);
  EXPECT_TRUE(row[0] == 0.1 && row[1] == 0.2 && row[2] == 0.3 && row[3] == 0.4);
  EXPECT_TRUE(q.w == 0.1 && q.x == 0.2 && q.y == 0.3 && q.z == 0.4);
}

// Closed form: the product turns by b first, then by a. A quarter turn about z and then one about
// x take body x to z.
TEST(Orientation, ProductTurnsRightFactorFirst)
{
  const Quaternion about_z = rotation_about({0.0, 0.0, 1.0}, 0.5 * kPi);
  const Quaternion about_x = rotation_about({1.0, 0.0, 0.0}, 0.5 * kPi);
  EXPECT_NEAR(norm(body_x(about_x * about_z) - Vec3{0.0, 0.0, 1.0}), 0.0, 4 * kEpsilon);
}
