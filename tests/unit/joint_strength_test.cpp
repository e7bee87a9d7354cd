// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/joint_strength.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

using namespace spherocylinder;

namespace {

struct Random {
  std::mt19937_64 engine{15485863};
  double operator()(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
};

JointStrain bent(double x, double y)
{
  JointStrain d{};
  d.bend_x = x;
  d.bend_y = y;
  return d;
}

}  // namespace

// In any direction, from any state: the moment is that at yield and points the same way, twist is left alone, and
// a second look changes nothing.
TEST(JointYield, BringsTheMomentBackAlongItsDirection)
{
  Random random;
  double worst = 0.0;
  int yielded = 0;
  for (int trial = 0; trial < 10000; trial++) {
    const JointStrain d = bent(random(-1.0, 1.0), random(-1.0, 1.0));
    const JointRest rest = {random(-1.0, 1.0), random(-1.0, 1.0), random(-1.0, 1.0)};
    const double stiffness = std::pow(10.0, random(-6.0, 3.0));
    const double most = stiffness * random(0.01, 1.0);
    const double moment = stiffness * elastic_bend(d, rest);
    if (!yields(d, rest, stiffness, most)) {
      EXPECT_LE(moment, most * (1.0 + 1e-12));
      continue;
    }
    yielded++;
    const JointRest now = rest_after_yielding(d, rest, stiffness, most);
    const double x = d.bend_x - rest.bend_x, y = d.bend_y - rest.bend_y;
    const double left_x = d.bend_x - now.bend_x, left_y = d.bend_y - now.bend_y;
    worst = std::max(
        {worst, std::fabs(stiffness * std::hypot(left_x, left_y) / most - 1.0),
         std::fabs(x * left_y - y * left_x) / (x * x + y * y),
         std::fabs(plastic_work(rest, now, most) / (most * (moment - most) / stiffness) - 1.0) *
             (moment / most - 1.0)});
    EXPECT_GT(x * left_x + y * left_y, 0.0);
    EXPECT_EQ(now.twist, rest.twist);
    EXPECT_FALSE(yields(d, now, stiffness, most));
  }
  EXPECT_GT(yielded, 1000);
  EXPECT_LT(worst, 1e-12);
}

// Independent slow method: the stress sigma_0 over the half circle above the middle, times its height, twice.
TEST(JointYield, MomentOfAPlasticCircle)
{
  const double radius = 0.3, stress = 7.0;
  double sum = 0.0;
  const int slices = 200000;
  for (int k = 0; k < slices; k++) {
    const double y = radius * (k + 0.5) / slices;
    sum += 2.0 * std::sqrt(radius * radius - y * y) * y * radius / slices;
  }
  EXPECT_NEAR(plastic_moment(stress, radius) / (2.0 * stress * sum), 1.0, 1e-7);
}

// Independent slow method: the greatest stress over the rim of the circle, N/A + M y/I, with one strength for both.
TEST(JointStrength, IsTheHighestStressAtTheRim)
{
  Random random;
  double worst = 0.0;
  for (int trial = 0; trial < 100; trial++) {
    const double r = random(0.5, 2.0), area = pi * r * r, inertia = pi * r * r * r * r / 4.0;
    const JointChannels stiffness = {random(1.0, 5.0), 1.0, random(1.0, 5.0), 1.0};
    JointStrain d = bent(random(-1.0, 1.0), random(-1.0, 1.0));
    d.stretch = random(-1.0, 1.0);
    const JointRest rest = {random(-0.2, 0.2), random(-0.2, 0.2), 0.0};
    const double strength = random(0.1, 10.0);
    const double m_x = stiffness.bend * (d.bend_x - rest.bend_x);
    const double m_y = stiffness.bend * (d.bend_y - rest.bend_y);
    double highest = -1e300;
    const int steps = 100000;
    for (int k = 0; k < steps; k++) {
      const double angle = 2.0 * pi * k / steps;
      const double x = r * std::cos(angle), y = r * std::sin(angle);
      highest =
          std::max(highest, stiffness.stretch * d.stretch / area + (m_x * y - m_y * x) / inertia);
    }
    JointStrength both;
    both.tensile = both.bending = strength;
    worst =
        std::max(worst, std::fabs(utilisation(d, rest, stiffness, r, both) - highest / strength) /
                            (1.0 + std::fabs(highest / strength)));
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_FALSE(JointStrength{}.is_finite());
}
