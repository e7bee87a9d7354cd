// SPDX-License-Identifier: GPL-2.0-or-later
// The joint of two rods: stiffness in closed form, force and couple against differences of the energy,
// conservation, objectivity, angles of known poses.
#include "core/rod_joint.h"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint_constants.h"
#include "core/mass_properties.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

double sum_of(const JointChannels &c) { return c.stretch + c.shear + c.bend + c.twist; }

double energy(const JointedRod &first, const JointedRod &second, const JointChannels &stiffness,
              const JointRest &rest)
{
  return sum_of(joint_energies(joint_deformation(first, second), stiffness, rest));
}

Quaternion turn(const Vec3 &direction, double angle) { return rotation_about(direction, angle); }

JointedRod moved(JointedRod rod, const Vec3 &by)
{
  rod.centre = rod.centre + by;
  return rod;
}

JointedRod turned_about_centre(JointedRod rod, const Vec3 &direction, double angle)
{
  rod.orientation = normalized(turn(direction, angle) * rod.orientation);
  return rod;
}

// The second joins the first, bent and twisted by up to `angle`, its end off by up to `gap` lengths.
struct Pair {
  JointedRod first, second;
};

Pair random_pair(RandomRods &random, double size, double angle, double gap)
{
  const auto any_turn = [&](double most) {
    return turn(random.direction(), random.uniform(-most, most));
  };
  Pair pair;
  pair.first.centre = random.vector(3.0 * size);
  pair.first.orientation = normalized(any_turn(kPi));
  pair.first.half_length = size * random.uniform(0.3, 1.0);
  // About the axis, then about a line across it: never near half a turn in sum.
  const Quaternion twist = turn({0.0, 0.0, 1.0}, random.uniform(-angle, angle));
  const Quaternion bend = turn(random.across({0.0, 0.0, 1.0}), random.uniform(0.0, angle));
  pair.second.orientation = normalized(pair.first.orientation * bend * twist);
  pair.second.half_length = size * random.uniform(0.3, 1.0);
  pair.second.centre =
      pair.first.head() + pair.second.half_length * pair.second.axis() + random.vector(gap * size);
  return pair;
}

JointRest random_rest(RandomRods &random)
{
  return {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
}

// Central difference, fourth order: error h^4 of the function's own scale, rounding epsilon U/h.
double slope(const std::function<double(double)> &f, double h)
{
  return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}

const std::array<Vec3, 3> kDirections = {Vec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

}  // namespace

// Independent slow method: the energy is displaced and turned, rod by rod, axis by axis.
TEST(RodJoint, ForceAndCoupleAreTheGradientOfTheEnergy)
{
  RandomRods random(15485863);
  double worst = 0.0;
  for (const double size : kDiameters)
    for (int trial = 0; trial < 400; trial++) {
      // Angles from none at all, where series are used, to near half a turn.
      const double angle = trial % 4 == 0   ? 1e-3
                           : trial % 4 == 1 ? 0.3
                           : trial % 4 == 2 ? 1.5
                                            : 2.6;
      const Pair pair = random_pair(random, size, angle, trial % 3 == 0 ? 0.3 : 1e-3);
      const JointRest rest = trial % 2 ? random_rest(random) : JointRest{};
      const JointChannels stiffness = {random.uniform(1.0, 5.0), random.uniform(1.0, 5.0),
                                       size * size * random.uniform(0.1, 1.0),
                                       size * size * random.uniform(0.1, 1.0)};
      const JointDeformation d = joint_deformation(pair.first, pair.second);
      const JointLoad load = elastic_load(pair.first, d, stiffness, rest);
      const Vec3 torques[] = {load.torque_on_first(pair.first), load.torque_on_second(pair.second)};
      const Vec3 forces[] = {load.force, -load.force};
      // Of the load, what it would be at a strain of one: an angle of 1 rad, a gap of one size.
      const double force_scale = norm(load.force) + 0.01 * stiffness.stretch * size;
      const double torque_scale = norm(torques[0]) + norm(torques[1]) + 0.01 * stiffness.bend;
      for (int which = 0; which < 2; which++)
        for (const Vec3 &n : kDirections) {
          const auto with = [&](const JointedRod &rod) {
            return which == 0 ? energy(rod, pair.second, stiffness, rest)
                              : energy(pair.first, rod, stiffness, rest);
          };
          const JointedRod &rod = which == 0 ? pair.first : pair.second;
          const double by_place =
              slope([&](double h) { return with(moved(rod, h * n)); }, 1e-3 * size);
          const double by_turn =
              slope([&](double h) { return with(turned_about_centre(rod, n, h)); }, 1e-3);
          worst = std::max(worst, std::fabs(dot(forces[which], n) + by_place) / force_scale);
          worst = std::max(worst, std::fabs(dot(torques[which], n) + by_turn) / torque_scale);
        }
    }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1e-7);
}

// Closed form: forces are equal and opposite at one point, couples too; damping included.
TEST(RodJoint, MomentumAndAngularMomentumAreKept)
{
  RandomRods random(32452843);
  double worst = 0.0;
  for (int trial = 0; trial < 10000; trial++) {
    const Pair pair = random_pair(random, 1.0, 2.5, 0.5);
    const JointChannels stiffness = {3.0, 1.0, 0.5, 0.2}, damping = {0.3, 0.2, 0.1, 0.05};
    const RodMotion motions[] = {{random.vector(1.0), random.vector(1.0)},
                                 {random.vector(1.0), random.vector(1.0)}};
    const JointDeformation d = joint_deformation(pair.first, pair.second);
    JointLoad load = elastic_load(pair.first, d, stiffness, random_rest(random));
    add_damping(pair.first, motions[0], pair.second, motions[1], d, damping, load);
    const Vec3 about = random.vector(3.0);
    const Vec3 total =
        cross(pair.first.centre - about, load.force) + load.torque_on_first(pair.first) -
        cross(pair.second.centre - about, load.force) + load.torque_on_second(pair.second);
    worst = std::max(worst, norm(total) / (norm(load.force) * 5.0 + norm(load.couple)));
  }
  EXPECT_LT(worst, 20 * kEpsilon);
}

// Both rods turned and moved as one: loads turn along, energies stay. With them moving as one body,
// damping has nothing to oppose.
TEST(RodJoint, RigidMotionChangesNothing)
{
  RandomRods random(49979687);
  double worst = 0.0;
  for (int trial = 0; trial < 10000; trial++) {
    const Pair pair = random_pair(random, 1.0, 2.5, 0.3);
    const JointChannels stiffness = {3.0, 1.0, 0.5, 0.2};
    const JointRest rest = random_rest(random);
    const Quaternion q = normalized(turn(random.direction(), random.uniform(-kPi, kPi)));
    const Vec3 shift = random.vector(10.0);
    const auto carried = [&](const JointedRod &rod) {
      return JointedRod{rotated(rod.centre, q) + shift, normalized(q * rod.orientation),
                        rod.half_length};
    };
    const JointedRod first = carried(pair.first), second = carried(pair.second);
    const JointLoad load =
        elastic_load(pair.first, joint_deformation(pair.first, pair.second), stiffness, rest);
    const JointDeformation d = joint_deformation(first, second);
    const JointLoad other = elastic_load(first, d, stiffness, rest);
    worst = std::max(worst, norm(other.force - rotated(load.force, q)));
    worst = std::max(worst, norm(other.couple - rotated(load.couple, q)));
    worst = std::max(worst, std::fabs(energy(first, second, stiffness, rest) -
                                      energy(pair.first, pair.second, stiffness, rest)));
    const Vec3 velocity = random.vector(1.0), omega = random.vector(1.0);
    JointLoad damped = other;
    add_damping(first, {velocity + cross(omega, first.centre), omega}, second,
                {velocity + cross(omega, second.centre), omega}, d, {1.0, 2.0, 3.0, 4.0}, damped);
    worst = std::max(worst, norm(damped.force - other.force) + norm(damped.couple - other.couple));
  }
  EXPECT_LT(worst, 2e-13);
}

// Poses of known bend and twist, closed form: turned about the second rod's axis, about a line across.
TEST(RodJoint, BendAndTwistOfKnownPoses)
{
  RandomRods random(67867967);
  for (int trial = 0; trial < 1000; trial++) {
    JointedRod first{random.vector(1.0), normalized(turn(random.direction(), 2.0)), 0.5};
    const double bend = random.uniform(0.0, 3.1), twist = random.uniform(-3.1, 3.1);
    const Vec3 binormal = random.across({0.0, 0.0, 1.0});
    const Quaternion half = turn({0.0, 0.0, 1.0}, 0.5 * twist);
    JointedRod second = first;
    second.orientation = normalized(first.orientation * half * turn(binormal, bend) * half);
    const JointDeformation d = joint_deformation(first, second);
    EXPECT_NEAR(std::sqrt(d.bend_squared()), std::acos(dot(first.axis(), second.axis())),
                1e-7);  // acos near 0 and pi
    EXPECT_NEAR(d.bend_x, bend * binormal.x, 1e-13);
    EXPECT_NEAR(d.bend_y, bend * binormal.y, 1e-13);
    EXPECT_NEAR(d.twist, twist, 2e-13);
    // Seen from the other side: the angles turn their signs.
    const JointDeformation back = joint_deformation(second, first);
    EXPECT_NEAR(back.bend_x, -d.bend_x, 1e-13);
    EXPECT_NEAR(back.twist, -d.twist, 2e-13);
  }
}

// The series and the formulas meet: s^2 = 0.01 is a bend of 0.20033 rad, t^2 = 0.01 a twist of 0.19934.
TEST(RodJoint, SeriesMeetTheFormula)
{
  const auto couple_at = [](double bend) {
    JointedRod first{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, 0.5}, second = first;
    second.orientation = turn({1.0, 0.0, 0.0}, bend);
    return elastic_load(first, joint_deformation(first, second), {1.0, 1.0, 1.0, 1.0}, {}).couple.x;
  };
  for (const double bend : {1e-12, 1e-6, 0.01, 0.2, 0.2003, 0.2004, 0.3, 1.0, 3.0})
    EXPECT_NEAR(couple_at(bend) / bend, 1.0, 1e-14) << bend;
  const auto twist_at = [](double twist) { return twist_of(turn({0.0, 0.0, 1.0}, twist)); };
  for (const double twist : {1e-12, 0.01, 0.1993, 0.1994, 0.3, 1.0, 3.0})
    for (const double sign : {-1.0, 1.0})
      EXPECT_NEAR(twist_at(sign * twist) / (sign * twist), 1.0, 1e-15) << twist;
}

// Closed form: EA/h, kappa G A/h, EI/h, GJ/h; of unlike halves in series.
TEST(RodJoint, StiffnessIsTheBeams)
{
  const double r = 0.002, h = 0.03, E = 2e9, nu = 0.3, G = E / 2.6;
  const double A = kPi * r * r, I = kPi * r * r * r * r / 4.0;
  const JointChannels k = joint_stiffness({r, h / 2.0, E, nu}, {r, h / 2.0, E, nu});
  EXPECT_NEAR(k.stretch / (E * A / h), 1.0, 1e-15);
  EXPECT_NEAR(k.shear / (0.9 * G * A / h), 1.0, 1e-15);
  EXPECT_NEAR(k.bend / (E * I / h), 1.0, 1e-15);
  EXPECT_NEAR(k.twist / (G * 2.0 * I / h), 1.0, 1e-15);
  EXPECT_NEAR(k.twist / k.bend, 1.0 / (1.0 + nu), 1e-15);

  const JointChannels unlike = joint_stiffness({r, h / 2.0, E, nu}, {r, h, 3.0 * E, nu});
  EXPECT_NEAR(unlike.bend, 1.0 / (0.5 * h / (E * I) + h / (3.0 * E * I)), 1e-14 * unlike.bend);
}

// Closed form of one degree of freedom: two free rods twisted against each other move the inertia
// 1/(1/I_1 + 1/I_2); critical damping is 2 sqrt(K I).
TEST(RodJoint, DampingRatioIsThatOfTheFreePair)
{
  const double zeta = 0.1, stiffness = 0.02;
  const JointedMass one = {0.01, 2e-6, 3e-7, 0.02}, two = {0.02, 5e-6, 5e-7, 0.03};
  const JointChannels masses = effective_masses(one, two);
  const double inertia = 1.0 / (1.0 / 3e-7 + 1.0 / 5e-7);
  EXPECT_NEAR(masses.twist, inertia, 1e-15 * inertia);
  const JointChannels c = damping_coefficients({0, 0, 0, zeta}, {1, 1, 1, stiffness}, masses);
  EXPECT_NEAR(c.twist, 2.0 * zeta * std::sqrt(stiffness * inertia), 1e-15);
  EXPECT_EQ(c.stretch, 0.0);
}

namespace {

struct ChainRod {
  JointedRod pose;
  RodMotion motion;
  Vec3 angular_momentum;
};

// A chain in free flight by the scheme of fix nve/spherocylinder; returns the largest change of energy.
double energy_error(double dt, double time)
{
  const double h = 0.02, r = 0.002;
  const MassProperties p = mass_properties(2.0 * r, h + 2.0 * r, 1000.0);
  const JointChannels k = joint_stiffness({r, h / 2, 1e7, 0.3}, {r, h / 2, 1e7, 0.3});
  std::vector<ChainRod> chain(6);
  RandomRods random(86028121);
  for (size_t i = 0; i < chain.size(); i++) {
    chain[i].pose = {{0.0, 0.0, h * i}, {1.0, 0.0, 0.0, 0.0}, 0.5 * h};
    chain[i].motion.velocity = random.vector(0.3);
    chain[i].angular_momentum = p.inertia_transverse * random.vector(20.0);
  }
  std::vector<Vec3> forces(chain.size()), torques(chain.size());
  const auto loads = [&] {
    double potential = 0.0;
    for (size_t i = 0; i < chain.size(); i++) forces[i] = torques[i] = kZero;
    for (size_t i = 0; i + 1 < chain.size(); i++) {
      const JointedRod &first = chain[i].pose, &second = chain[i + 1].pose;
      const JointDeformation d = joint_deformation(first, second);
      const JointLoad load = elastic_load(first, d, k, {});
      forces[i] = forces[i] + load.force;
      forces[i + 1] = forces[i + 1] - load.force;
      torques[i] = torques[i] + load.torque_on_first(first);
      torques[i + 1] = torques[i + 1] + load.torque_on_second(second);
      potential += sum_of(joint_energies(d, k, {}));
    }
    return potential;
  };
  const auto kinetic = [&] {
    double sum = 0.0;
    for (const ChainRod &rod : chain)
      sum += 0.5 * p.mass * norm_squared(rod.motion.velocity) +
             rotational_energy(rod.angular_momentum, rod.pose.axis(), p.inertia_axial,
                               p.inertia_transverse);
    return sum;
  };
  const double start = loads() + kinetic();
  double worst = 0.0;
  for (long step = 0; step < std::lround(time / dt); step++) {
    const auto kick = [&] {
      for (size_t i = 0; i < chain.size(); i++) {
        chain[i].motion.velocity = chain[i].motion.velocity + (0.5 * dt / p.mass) * forces[i];
        chain[i].angular_momentum = chain[i].angular_momentum + 0.5 * dt * torques[i];
      }
    };
    kick();
    for (ChainRod &rod : chain) {
      rod.pose.centre = rod.pose.centre + dt * rod.motion.velocity;
      rod.pose.orientation = rotate_freely(rod.pose.orientation, rod.angular_momentum,
                                           p.inertia_axial, p.inertia_transverse, dt);
    }
    const double potential = loads();
    kick();
    worst = std::max(worst, std::fabs((potential + kinetic()) / start - 1.0));
  }
  return worst;
}

}  // namespace

// Symplectic and second order: half the step, a quarter of the swing of the energy, and no drift.
TEST(RodJoint, EnergyOfAFreeChainIsOfSecondOrderInTheStep)
{
  const double coarse = energy_error(2e-6, 0.02), fine = energy_error(1e-6, 0.02);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
  EXPECT_LT(energy_error(1e-6, 0.2), 1.5 * fine);
}
