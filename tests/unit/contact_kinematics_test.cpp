// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/contact_kinematics.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "core/mass_properties.h"
#include "inertia_tensor.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

struct Rod {
  MassProperties properties;
  Vec3 centre, velocity, axis, angular_momentum;

  Vec3 omega() const
  {
    return angular_velocity(angular_momentum, axis, properties.inertia_axial,
                            properties.inertia_transverse);
  }
  double energy() const
  {
    return 0.5 * properties.mass * norm_squared(velocity) +
           rotational_energy(angular_momentum, axis, properties.inertia_axial,
                             properties.inertia_transverse);
  }
  Vec3 momentum() const { return properties.mass * velocity; }
  Vec3 angular_momentum_about_origin() const
  {
    return cross(centre, momentum()) + angular_momentum;
  }

  // `impulse` (N s) at the space point `point`.
  void push(const Vec3 &impulse, const Vec3 &point)
  {
    velocity = velocity + (1.0 / properties.mass) * impulse;
    angular_momentum = angular_momentum + cross(point - centre, impulse);
  }
};

// Two rods that touch at the origin. `normal` points from j to i.
struct Impact {
  Rod i, j;
  Vec3 arm_i, arm_j;  // from the centres to the closest points of the axes
  Vec3 normal;

  double normal_velocity() const
  {
    return dot(velocity_at(i.velocity, i.omega(), -i.centre) -
                   velocity_at(j.velocity, j.omega(), -j.centre),
               normal);
  }
};

// Rod of any aspect ratio and pose whose surface passes through the origin: its axis point at
// `side` radius normal, away from the partner.
Rod touching_rod(RandomRods &random, double diameter, const Vec3 &normal, double side, Vec3 &arm)
{
  const double length = diameter * random.log_uniform(1.0, 100.0);
  Rod rod;
  rod.properties = mass_properties(diameter, length, kDensity);
  rod.axis = random.direction();
  arm = (0.5 * (length - diameter) * random.uniform(-1.0, 1.0)) * rod.axis;
  rod.centre = (side * 0.5 * diameter) * normal - arm;
  const double speed = diameter * random.log_uniform(1.0, 100.0);
  rod.velocity = speed * random.direction();
  rod.angular_momentum =
      angular_momentum((speed / length) * random.vector(1.0), rod.axis,
                       rod.properties.inertia_axial, rod.properties.inertia_transverse);
  return rod;
}

Impact random_impact(RandomRods &random, double diameter)
{
  Impact impact;
  impact.normal = random.direction();
  impact.i = touching_rod(random, diameter, impact.normal, 1.0, impact.arm_i);
  impact.j = touching_rod(random, diameter, impact.normal, -1.0, impact.arm_j);
  return impact;
}

}  // namespace

// Closed form: w = 2 about z, arm 3 along x, so w x a = 6 along y.
TEST(VelocityAt, SpinAboutZ)
{
  const Vec3 v = velocity_at({1.0, -1.0, 0.5}, {0.0, 0.0, 2.0}, {3.0, 0.0, 7.0});
  EXPECT_EQ(v.x, 1.0);
  EXPECT_EQ(v.y, 5.0);
  EXPECT_EQ(v.z, 0.5);
}

// Independent slow method: central difference of the point's path c + v t + R(w t) a. Its error is
// |w|^3 |a| step^2 / 6, here 2e-9 of w a, and its rounding epsilon / (w step), 2e-12.
// A rod that circles the origin at W: its centre's velocity of t - dt/2 with its axis of t give the
// velocity that the tip had at t - dt/2, to second order in dt; without the step back to first.
TEST(VelocityHalfAStepAgo, OnACircle)
{
  const Vec3 omega = {0.0, 2.0, 0.0}, arm = {0.3, 0.1, 0.0};
  const auto error = [&](double dt) {
    const double a = 0.5 * omega.y * dt;  // turned since, about y
    const Vec3 centre_then = {-0.4 * std::sin(a), 0.0, -0.4 * std::cos(a)};
    const Vec3 arm_then = {0.3 * std::cos(a), 0.1, 0.3 * std::sin(a)};
    return norm(velocity_half_a_step_ago(cross(omega, centre_then), omega, arm, dt) -
                cross(omega, centre_then + arm_then));
  };
  EXPECT_LT(error(1e-3), 1e-6);
  EXPECT_NEAR(error(1e-3) / error(5e-4), 4.0, 0.01);
}

TEST(VelocityAt, DifferenceOfThePath)
{
  RandomRods random(6007);
  for (int k = 0; k < 10000; k++) {
    const Vec3 velocity = random.vector(1.0), arm = random.vector(1.0), about = random.direction();
    const double rate = random.log_uniform(0.1, 1e3), step = 1e-4 / rate;
    const auto displacement = [&](double t) { return t * velocity + turned(arm, about, rate * t); };
    const Vec3 slow = (0.5 / step) * (displacement(step) - displacement(-step));
    const Vec3 fast = velocity_at(velocity, rate * about, arm);
    ASSERT_LT(norm(fast - slow), 1e-8 * (norm(velocity) + rate * norm(arm)));
  }
}

// Independent slow method: the whole 3 x 3 inertia tensor, inverted and contracted with a x n, for
// the arm to the axis and for the arm to the surface point below it (n x n = 0: no difference).
TEST(InverseEffectiveMass, FullInertiaTensor)
{
  RandomRods random(6011);
  double worst = 0.0;
  for (const double diameter : kDiameters)
    for (int k = 0; k < 20000; k++) {
      const double length = diameter * random.log_uniform(1.0, 100.0);
      const MassProperties p = mass_properties(diameter, length, kDensity);
      const Vec3 axis = random.direction(), normal = random.direction();
      const Vec3 arm = (0.5 * (length - diameter) * random.uniform(-1.0, 1.0)) * axis;
      const Vec3 surface_arm = arm - (0.5 * diameter) * normal;

      const Matrix inverse_tensor = inverse(inertia_tensor(axis, p));
      const double fast = inverse_effective_mass(p.mass, p.inertia_transverse, arm, normal);
      for (const Vec3 &a : {arm, surface_arm}) {
        const double slow = 1.0 / p.mass + contracted(inverse_tensor, cross(a, normal));
        worst = std::max(worst, std::fabs(fast / slow - 1.0));
      }
    }
  std::printf("worst relative difference from the full tensor: %.1e\n", worst);
  RecordProperty("worst_relative_e15", std::to_string(worst * 1e15));
  // Rounding leaves a x n some epsilon |a| off the transverse plane, which the tensor weighs with
  // up to I_t/I_a = 7e3 (lambda = 100), squared in epsilon: not seen. The rest is plain rounding.
  EXPECT_LT(worst, 32 * kEpsilon);
}

// Closed forms: 1/m through the centre or along the axis; for a rod struck square on its end
// 1/m + (h/2)^2/I_t, which for a thin rod is 4/m.
TEST(InverseEffectiveMass, CentreAxisAndEnd)
{
  for (const double diameter : kDiameters) {
    const double length = 1e4 * diameter;
    const MassProperties p = mass_properties(diameter, length, kDensity);
    const Vec3 across{1.0, 0.0, 0.0}, axis{0.0, 0.0, 1.0};
    const Vec3 end = (0.5 * (length - diameter)) * axis;
    EXPECT_EQ(inverse_effective_mass(p.mass, p.inertia_transverse, {0.0, 0.0, 0.0}, across),
              1.0 / p.mass);
    EXPECT_EQ(inverse_effective_mass(p.mass, p.inertia_transverse, end, axis), 1.0 / p.mass);
    // 1 + 3 (h/L)^2 / (1 - 2/(3 lambda)) differs from 4 by some 4/lambda.
    EXPECT_NEAR(inverse_effective_mass(p.mass, p.inertia_transverse, end, across) * p.mass, 4.0,
                5e-4);
  }
}

// Closed form: with K = 1/m_eff and J = -(1 + e) v_n/K along the normal, the normal velocity turns
// into -e v_n, the energy falls by (1 - e^2) m_eff v_n^2/2, and momentum and angular momentum stay.
TEST(Impulse, RestitutionEnergyAndMomentum)
{
  RandomRods random(6029);
  double worst_velocity = 0.0, worst_energy = 0.0, worst_momentum = 0.0, worst_angular = 0.0;
  for (const double diameter : kDiameters)
    for (int k = 0; k < 20000; k++) {
      Impact impact = random_impact(random, diameter);
      Rod &i = impact.i, &j = impact.j;
      const double e = random.uniform(0.0, 1.0);
      const double inverse_mass =
          inverse_effective_mass(i.properties.mass, i.properties.inertia_transverse, impact.arm_i,
                                 impact.normal) +
          inverse_effective_mass(j.properties.mass, j.properties.inertia_transverse, impact.arm_j,
                                 impact.normal);
      const double before = impact.normal_velocity();
      const double energy = i.energy() + j.energy();
      const Vec3 momentum = i.momentum() + j.momentum();
      const Vec3 angular = i.angular_momentum_about_origin() + j.angular_momentum_about_origin();
      const double speeds = norm(i.velocity) + norm(j.velocity);
      const double angular_size = norm(cross(i.centre, i.momentum())) + norm(i.angular_momentum) +
                                  norm(cross(j.centre, j.momentum())) + norm(j.angular_momentum);

      const Vec3 impulse = (-(1.0 + e) * before / inverse_mass) * impact.normal;
      i.push(impulse, {0.0, 0.0, 0.0});
      j.push(-impulse, {0.0, 0.0, 0.0});

      const double lost = energy - i.energy() - j.energy();
      const double expected = 0.5 * (1.0 - e * e) * before * before / inverse_mass;
      const Vec3 momentum_change = i.momentum() + j.momentum() - momentum;
      const Vec3 angular_change =
          i.angular_momentum_about_origin() + j.angular_momentum_about_origin() - angular;
      const double momentum_size =
          i.properties.mass * norm(i.velocity) + j.properties.mass * norm(j.velocity);

      worst_velocity =
          std::max(worst_velocity, std::fabs(impact.normal_velocity() + e * before) / speeds);
      worst_energy = std::max(worst_energy, std::fabs(lost - expected) / energy);
      worst_momentum = std::max(worst_momentum, norm(momentum_change) / momentum_size);
      worst_angular = std::max(worst_angular, norm(angular_change) / angular_size);
    }
  std::printf("impulse, worst: normal velocity %.1e, energy %.1e, momentum %.1e, angular %.1e\n",
              worst_velocity, worst_energy, worst_momentum, worst_angular);
  // Of the speeds, the energy and the momenta before the impact. The axial part of L may carry
  // I_t/I_a = 7e3 (lambda = 100) times the rounding of its transverse part.
  EXPECT_LT(worst_velocity, 1e-12);
  EXPECT_LT(worst_energy, 1e-12);
  EXPECT_LT(worst_momentum, 8 * kEpsilon);
  EXPECT_LT(worst_angular, 16 * kEpsilon);
}

// The acceleration along n1 of the point at arm 1 under a unit force along n2 at arm 2, from the full
// inertia tensor; for one and the same point and normal it is the inverse effective mass.
TEST(MassCoupling, FullInertiaTensor)
{
  RandomRods random(49979693);
  double worst = 0.0;
  for (int k = 0; k < 20000; k++) {
    const MassProperties p = mass_properties(1.0, random.uniform(1.001, 100.0), 1.0);
    const Vec3 axis = random.direction(), n1 = random.direction(), n2 = random.direction();
    const Vec3 a1 = random.uniform(-5.0, 5.0) * axis, a2 = random.uniform(-5.0, 5.0) * axis;
    const InverseInertia inverse_inertia = {1.0 / p.mass, 1.0 / p.inertia_transverse};
    const double got = mass_coupling(inverse_inertia, a1, n1, a2, n2);

    // x^T M y by the identity x^T M y = ((x+y)^T M (x+y) - (x-y)^T M (x-y))/4.
    const Matrix tensor = inverse(inertia_tensor(axis, p));
    const Vec3 x = cross(a1, n1), y = cross(a2, n2);
    const double expected =
        dot(n1, n2) / p.mass + 0.25 * (contracted(tensor, x + y) - contracted(tensor, x - y));
    const double size = 1.0 / p.mass + contracted(tensor, x) + contracted(tensor, y);
    worst = std::max(worst, std::fabs(got - expected) / size);
    EXPECT_NEAR(mass_coupling(inverse_inertia, a1, n1, a1, n1),
                inverse_effective_mass(inverse_inertia, a1, n1), 1e-13 * size);
  }
  EXPECT_LT(worst, 1e-13);
}

// Two ends of a rod that share the load by at most the cosine of their normals never feel more mass
// than the rod has: K11 + cos(n1,n2) K12 >= 1/m.
TEST(MassCoupling, SharedLoadKeepsTheEffectiveMassBelowTheMass)
{
  RandomRods random(67867979);
  double least = 1e9;
  for (int k = 0; k < 200000; k++) {
    const double aspect_ratio = std::pow(10.0, random.uniform(0.0, 3.0));
    const MassProperties p = mass_properties(1.0, aspect_ratio + 1e-6, 1.0);
    const Vec3 axis = random.direction(), n1 = random.direction(), n2 = random.direction();
    const Vec3 arm = 0.5 * (aspect_ratio + 1e-6 - 1.0) * axis;
    const double cosine = std::max(0.0, dot(n1, n2));
    const InverseInertia inverse_inertia = {1.0 / p.mass, 1.0 / p.inertia_transverse};
    const double sum = inverse_effective_mass(inverse_inertia, arm, n1) +
                       cosine * mass_coupling(inverse_inertia, arm, n1, -arm, n2);
    least = std::min(least, sum * p.mass);
  }
  EXPECT_GE(least, 1.0 - 1e-12);
}
