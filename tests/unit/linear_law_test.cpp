// SPDX-License-Identifier: GPL-2.0-or-later
// The slider of model linear on its own: what it does to force, spring and energy.
#include "core/linear_law.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "test_support.h"

using namespace spherocylinder;

namespace {

struct Sliding {
  Vec3 spring, slip;
  double stiffness, damping, most;
};

// Any direction of spring against slip, dashpots from far below the limit to far above it.
Sliding any_sliding(RandomRods &random)
{
  const Vec3 n = random.direction();
  Sliding s;
  s.stiffness = random.log_uniform(1e2, 1e6);
  s.most = random.log_uniform(1e-3, 1e3);
  s.spring = s.most / s.stiffness * random.log_uniform(1e-3, 1e2) * random.across(n);
  s.damping = random.log_uniform(1e-2, 1e2);
  s.slip = s.most / s.damping * random.log_uniform(1e-3, 1e3) * random.across(n);
  return s;
}

double energy(const Sliding &s, const Vec3 &spring)
{
  return 0.5 * s.stiffness * norm_squared(spring);
}

}  // namespace

// Spring and dashpot together never pull harder than friction lets them, spring alone neither twice
// as hard; the force never adds energy by way of the spring.
TEST(LinearSlider, HoldsTheWholeForceAndNeverWindsTheSpring)
{
  RandomRods random(86028121);
  int slides = 0;
  constexpr int kDraws = 100000;
  for (int k = 0; k < kDraws; k++) {
    const Sliding s = any_sliding(random);
    Vec3 spring = s.spring;
    const Vec3 force =
        sliding_force<SliderLimits::WholeForce>(spring, s.slip, s.stiffness, s.damping, s.most);
    ASSERT_LE(norm(force), s.most * (1.0 + 8.0 * kEpsilon));
    ASSERT_LE(energy(s, spring),
              energy(s, s.spring) * (1.0 + 1e-12) + 1e-14 * s.most * s.most / s.stiffness);
    if (norm(s.stiffness * s.spring + s.damping * s.slip) <= s.most) {
      // Holds: spring and dashpot as they are.
      ASSERT_EQ(norm(spring - s.spring), 0.0);
      ASSERT_LE(norm(force + s.stiffness * s.spring + s.damping * s.slip), 1e-12 * s.most);
      continue;
    }
    slides++;
    ASSERT_NEAR(norm(force), s.most, 8.0 * kEpsilon * s.most);
    ASSERT_LE(s.stiffness * norm(spring), 2.0 * s.most * (1.0 + 1e-12));
    // A slow dashpot and the spring make up the force.
    if (s.damping * norm(s.slip) < s.most) {
      ASSERT_LE(norm(force + s.stiffness * spring + s.damping * s.slip), 1e-12 * s.most);
    }
  }
  EXPECT_GT(slides, kDraws / 4);
  EXPECT_LT(slides, kDraws - kDraws / 10);
}

// A mass that slides to rest: mu F_n until the dashpot lets go faster than the spring loads, at
// v = gamma mu F_n/(m k_t), from then on spring and dashpot, and no jump between the two.
TEST(LinearSlider, ForceStaysAtTheLimitAndLeavesItWithoutAJump)
{
  const double stiffness = 1e4, damping = 5.0, most = 2.0, dt = 1e-6, mass = 0.02, start = 3.0;
  const double holds_from = damping * most / (mass * stiffness);
  Vec3 spring = {0.0, 0.0, 0.0}, slip = {start, 0.0, 0.0};  // damping 15 N, far beyond the limit
  const Vec3 n = {0.0, 0.0, 1.0};
  double last = -most, largest_step = 0.0;
  for (int step = 1; slip.x > 0.0; step++) {
    spring = loaded_spring(spring, slip, n, dt);
    const Vec3 force =
        sliding_force<SliderLimits::WholeForce>(spring, slip, stiffness, damping, most);
    const bool sliding = slip.x > 1.001 * holds_from;
    if (sliding) {
      ASSERT_NEAR(force.x, -most, 1e-12) << "step " << step;
    }
    largest_step = std::max(largest_step, std::fabs(force.x - last));
    last = force.x;
    slip = slip + (dt / mass) * force;
    if (sliding) {
      ASSERT_NEAR(slip.x, start - most / mass * step * dt, 1e-9);
    }
  }
  EXPECT_LT(largest_step, damping * most / mass * dt);
}

// A material without tangential stiffness has neither spring nor dashpot.
TEST(LinearSlider, NothingWithoutStiffness)
{
  Vec3 spring = {1e-3, 0.0, 0.0};
  const Vec3 force =
      sliding_force<SliderLimits::WholeForce>(spring, {1.0, 2.0, 0.0}, 0.0, 0.0, 0.0);
  EXPECT_EQ(norm(force), 0.0);
  EXPECT_EQ(spring.x, 1e-3);
}

// LIGGGHTS's way: the dashpot lies outside of the slider and lets go where the spring slides.
TEST(LinearSlider, LiggghtsLimitsTheSpringAlone)
{
  const double stiffness = 1e4, damping = 5.0, most = 2.0;
  Vec3 spring = {1e-4, 0.0, 0.0};
  const Vec3 slip = {3.0, 0.0, 0.0};
  Vec3 force = sliding_force<SliderLimits::SpringAlone>(spring, slip, stiffness, damping, most);
  EXPECT_NEAR(force.x, -(1.0 + 15.0), 1e-12);
  spring = {4e-4, 0.0, 0.0};
  force = sliding_force<SliderLimits::SpringAlone>(spring, slip, stiffness, damping, most);
  EXPECT_NEAR(force.x, -most, 1e-12);
  EXPECT_NEAR(spring.x, most / stiffness, 1e-18);
}
