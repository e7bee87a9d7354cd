// SPDX-License-Identifier: GPL-2.0-or-later
// Two rods meet: energy, momentum, contact time, deep overlap.
#include <algorithm>
#include <cmath>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

class PairImpact : public RunMode {};

constexpr double kApproach = 0.01;  // normal speed of the contact points, m/s
constexpr double kGap = 1e-7;       // before the contact, m

// Two rods about to touch, and the contact they will make.
struct Meeting {
  Rod i, j;
  Vec3 arm_i, arm_j;  // from the centres to the contact, along the axes
  Vec3 normal;        // from j to i

  double normal_velocity(const Rod &a, const Rod &b) const
  {
    return dot(normal, a.velocity + cross(a.omega, arm_i) - b.velocity - cross(b.omega, arm_j));
  }
  // 1/m_eff = sum [1/m + (a x n)^T I^-1 (a x n)]
  double effective_mass() const
  {
    return 1.0 / (1.0 / i.mass() + 1.0 / j.mass() +
                  norm_squared(cross(arm_i, normal)) / i.properties().inertia_transverse +
                  norm_squared(cross(arm_j, normal)) / j.properties().inertia_transverse);
  }
};

// Rod i's axis point at `s` (fraction of half the cylinder, -1 to 1) meets j's at `t` along the
// normal. The given velocities are changed by what makes them approach at kApproach.
Meeting meet(Rod i, double s, Rod j, double t, const Vec3 &normal)
{
  Meeting m{i, j, s * i.half_cylinder() * i.axis, t * j.half_cylinder() * j.axis, normal};
  const double distance = i.radius() + j.radius() + kGap;
  m.i.position = j.position + m.arm_j + distance * normal - m.arm_i;
  m.i.velocity = m.i.velocity - (kApproach + m.normal_velocity(m.i, m.j)) * normal;
  return m;
}

// Crossing axes, an end on a side, two ends; equal and unequal rods; a rod and a sphere.
std::vector<Meeting> meetings()
{
  std::vector<Meeting> all;
  Rod rod, thick;
  // Small beside the approach, so that the contact stays where it is.
  rod.velocity = {0.002, -0.001, 0.0015};
  rod.omega = {0.01, 0.02, -0.01};
  rod.axis = {1.0, 0.0, 0.0};
  thick.diameter = 0.02;
  thick.length = 0.15;
  thick.velocity = {-0.001, 0.001, 0.0};
  thick.omega = {0.005, -0.01, 0.01};
  thick.axis = normalized({0.4, 0.7, 0.0});
  Rod ball = rod;
  ball.length = ball.diameter;

  Rod leaning = rod;
  leaning.axis = normalized({0.5, -0.2, -0.7});  // its end at +axis is its lowest point
  all.push_back(meet(rod, 0.3, thick, -0.6, {0.0, 0.0, 1.0}));
  all.push_back(meet(rod, -0.9, thick, 0.9, {0.0, 0.0, -1.0}));
  all.push_back(meet(leaning, 1.0, thick, 0.5, {0.0, 0.0, 1.0}));
  all.push_back(meet(leaning, 1.0, rod, 1.0, normalized({0.6, 0.2, 0.75})));
  all.push_back(meet(ball, 0.0, thick, 0.8, {0.0, 0.0, 1.0}));
  all.push_back(meet(ball, 0.0, ball, 0.0, normalized({1.0, 2.0, 2.0})));

  for (size_t k = 0; k < all.size(); k++) {  // each pair on its own
    const Vec3 shift = {-0.75 + 0.3 * static_cast<double>(k), 0.0, 0.0};
    all[k].i.position = all[k].i.position + shift;
    all[k].j.position = all[k].j.position + shift;
  }
  return all;
}

Scene scene_of(const std::vector<Meeting> &all)
{
  Scene scene;
  for (const Meeting &m : all) {
    scene.rods.push_back(m.i);
    scene.rods.push_back(m.j);
  }
  scene.dt = 5e-8;
  scene.steps = 12000;
  scene.dump_every = 200;
  return scene;
}

TEST_P(PairImpact, LosesTheEnergyOfTheEffectiveMass)
{
  const double restitution = 0.5;
  const std::vector<Meeting> all = meetings();
  Scene scene = scene_of(all);
  scene.physics = linear_material(1e6, 1e6, restitution, 0.0) + rod_pair("linear tangential off") +
                  "fix motion all nve/spherocylinder\n";
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;

  double restitution_error = 0.0, energy_error = 0.0;
  for (size_t k = 0; k < all.size(); k++) {
    const Rod &i = after[2 * k], &j = after[2 * k + 1];
    restitution_error =
        std::max(restitution_error,
                 std::fabs(all[k].normal_velocity(i, j) / kApproach - restitution) / restitution);
    // Lost: (1 - e^2) m_eff v_n^2 / 2.
    const double share = 0.5 * all[k].effective_mass() * kApproach * kApproach;
    const double lost = kinetic_energy({all[k].i, all[k].j}) - kinetic_energy({i, j});
    energy_error =
        std::max(energy_error, std::fabs(lost / share - (1.0 - restitution * restitution)));
  }
  // As for a wall: 2 zeta omega dt is below 1e-3, and the arms turn by less than that.
  expect_holds({"Two rods, six meetings: coefficient of restitution, relative",
                "e at the effective mass", 2e-3},
               restitution_error);
  expect_holds({"Two rods, six meetings: energy lost / (m_eff v_n^2/2)", "1 - e^2", 2e-3},
               energy_error);
}

TEST_P(PairImpact, KeepsMomentumAndAngularMomentum)
{
  const std::vector<Meeting> all = meetings();
  Scene scene = scene_of(all);
  for (Rod &rod : scene.rods) rod.omega = 200.0 * rod.omega;  // so that friction has work to do
  scene.physics = linear_material(1e6, 1e6, 0.5, 0.3) + rod_pair("linear tangential history") +
                  "fix motion all nve/spherocylinder\n";
  const Vec3 fixed_point = {0.3, -0.2, 0.5};
  double linear = 0.0, angular = 0.0, spin_change = 0.0;
  for (const Frame &frame : run(scene, GetParam()))
    for (size_t k = 0; k < all.size(); k++) {
      const std::vector<Rod> before = {scene.rods[2 * k], scene.rods[2 * k + 1]};
      const std::vector<Rod> now = {frame.rods[2 * k], frame.rods[2 * k + 1]};
      const double scale =
          before[0].mass() * norm(before[0].velocity) + before[1].mass() * norm(before[1].velocity);
      linear = std::max(linear, norm(momentum(now) - momentum(before)) / scale);
      angular = std::max(angular, norm(angular_momentum(now, fixed_point) -
                                       angular_momentum(before, fixed_point)) /
                                      (scale * 1.0));  // the fixed point is about 1 m away
      spin_change = std::max(spin_change, norm(now[0].omega - before[0].omega));
    }
  EXPECT_GT(spin_change, 0.01);
  // Sums of 12000 steps of round-off.
  expect_holds({"Two rods with friction: momentum, relative, every 200 steps", "conserved", 1e-12},
               linear);
  expect_holds({"Two rods with friction: angular momentum about a fixed point, relative",
                "conserved", 1e-12},
               angular);
}

// Head-on: e, and contact time pi / sqrt(k/m_eff - c^2/(4 m_eff^2)) with c = 2 zeta sqrt(k m_eff),
// e = exp(-pi zeta / sqrt(1 - zeta^2)).
TEST_P(PairImpact, HeadOnRestitutionAndContactTime)
{
  const double pi = std::acos(-1.0), kn = 1e6;
  const double restitutions[] = {0.9, 0.5, 0.1};
  std::vector<Meeting> all;
  for (int type = 1; type <= 3; type++) {
    Rod ball, rod, across;
    ball.length = ball.diameter;
    across.axis = {0.0, 1.0, 0.0};
    ball.type = rod.type = across.type = type;
    const Vec3 place = {-0.6 + 0.3 * type, 0.0, 0.0};
    ball.position = place + Vec3{0.0, 0.5, 0.0};
    across.position = place;
    all.push_back(meet(ball, 0.0, ball, 0.0, {0.0, 0.0, 1.0}));
    all.push_back(meet(rod, 0.0, across, 0.0, {0.0, 0.0, 1.0}));
  }
  Scene scene = scene_of(all);
  scene.types = 3;
  scene.dt = 5e-8;
  scene.steps = 11200;
  scene.dump_every = 4;
  scene.physics = pair_property("kn", 3, kn) + pair_property("kt", 3, kn) +
                  pair_property("coefficientRestitution", 3,
                                [&](int i, int j) { return restitutions[std::max(i, j) - 1]; }) +
                  rod_pair("linear tangential off") + "fix motion all nve/spherocylinder\n";
  const std::vector<Frame> frames = run(scene, GetParam());

  double restitution_error = 0.0, time_error = 0.0;
  for (size_t k = 0; k < all.size(); k++) {
    const Rod &i = frames.back().rods[2 * k], &j = frames.back().rods[2 * k + 1];
    const double e = restitutions[k / 2];
    restitution_error =
        std::max(restitution_error, std::fabs(all[k].normal_velocity(i, j) / kApproach - e) / e);
    const double zeta = -std::log(e) / std::hypot(pi, std::log(e));
    const double expected = pi / std::sqrt(kn / all[k].effective_mass() * (1.0 - zeta * zeta));
    long touching = 0;
    for (const Frame &frame : frames) touching += frame.contacts[2 * k] > 0.0;
    const double measured = touching * scene.dump_every * scene.dt;
    time_error = std::max(time_error, std::fabs(measured - expected) / expected);
  }
  // omega dt is 2e-3 for the balls: 2 zeta omega dt; the contact time is counted in dumps.
  expect_holds({"Head-on, balls and crossed rods: restitution, relative", "e", 3e-3},
               restitution_error);
  expect_holds({"Head-on, balls and crossed rods: contact time, relative",
                "pi/sqrt(k/m_eff - c^2/(4 m_eff^2))", 3e-3},
               time_error);
}

// Nearly parallel rods that meet with one end: the contact there is half a spring (spread_contact),
// damped for what it is, so that its points part with e times their approach. The rods turn by less
// than a tenth of the tilt meanwhile, and the free end stays clear.
TEST_P(PairImpact, NearlyParallelRodsOnOneEnd)
{
  const double restitution = 0.5, approach = 1e-3, stiffness = 1e6;
  Scene scene;
  for (const double tilt : {0.002, 0.005, 0.02, 0.1}) {
    Rod lower, upper;
    lower.position.y = upper.position.y = -0.8 + 0.2 * static_cast<double>(scene.rods.size());
    upper.axis = {std::cos(tilt), 0.0, std::sin(tilt)};
    // The lower end of the upper rod, at x = -h/2 cos(tilt), over the lower rod.
    upper.position.x = 0.01;
    upper.position.z = upper.diameter + 1e-8 + upper.half_cylinder() * std::sin(tilt);
    upper.velocity.z = -approach;
    scene.rods.push_back(lower);
    scene.rods.push_back(upper);
  }
  scene.physics = linear_material(stiffness, stiffness, restitution, 0.0) +
                  rod_pair("linear tangential off") + "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-7;
  scene.steps = 10000;
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;

  double error = 0.0;
  for (size_t k = 0; k < after.size(); k += 2) {
    const auto end_velocity = [&](const Rod &lower, const Rod &upper) {
      const Vec3 end = -upper.half_cylinder() * upper.axis;
      const Vec3 below = {upper.position.x + end.x, 0.0, 0.0};
      return upper.velocity.z + cross(upper.omega, end).z - lower.velocity.z -
             cross(lower.omega, below).z;
    };
    error = std::max(
        error, std::fabs(end_velocity(after[k], after[k + 1]) / approach / restitution - 1.0));
  }
  expect_holds({"Nearly parallel rods on one end: restitution, relative", "e", 1e-3}, error);
}

// limitForce on: the force is cut off where it would pull, at which the pair parts with
// e' = exp(-zeta/sqrt(1-zeta^2) (pi - atan(2 zeta sqrt(1-zeta^2)/(1-2 zeta^2)))) for zeta <
// 1/sqrt(2) (Schwager and Poeschel, Granular Matter 9 (2007) 465).
TEST_P(PairImpact, LimitForceDoesNotPull)
{
  const double restitution = 0.3, pi = std::acos(-1.0);
  std::vector<Meeting> all = meetings();
  Scene scene = scene_of(all);
  scene.physics = linear_material(1e6, 1e6, restitution, 0.0) +
                  "pair_style gran model linear tangential off surface spherocylinder limitForce "
                  "on\npair_coeff * *\nfix motion all nve/spherocylinder\n";
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  const double zeta = -std::log(restitution) / std::hypot(pi, std::log(restitution));
  const double root = std::sqrt(1.0 - zeta * zeta);
  const double expected =
      std::exp(-zeta / root * (pi - std::atan(2.0 * zeta * root / (1.0 - 2.0 * zeta * zeta))));
  double error = 0.0;
  for (size_t k = 0; k < all.size(); k++)
    error = std::max(error, std::fabs(all[k].normal_velocity(after[2 * k], after[2 * k + 1]) /
                                          kApproach / expected -
                                      1.0));
  expect_holds({"limitForce on: restitution, relative",
                "exp(-zeta/w (pi - atan(2 zeta w/(1-2 zeta^2)))), w^2 = 1-zeta^2", 2e-3},
               error);
}

// Crossed rods driven at each other at 14 m/s (a fall of 10 m) with a contact so soft that the
// axes pass each other: overlap v sqrt(m_eff/k) = 1.5 D. The spring goes on pushing the way it
// came, so that without damping the rods part at the speed they met.
TEST_P(PairImpact, DeepOverlapIsPushedBack)
{
  const double speed = 14.0;
  std::vector<Meeting> all;
  Rod rod, across;
  across.axis = normalized({0.2, 1.0, 0.0});
  const double ends[] = {0.0, 0.4, 0.8};
  for (int k = 0; k < 3; k++) {
    across.position = {-0.4 + 0.4 * k, 0.0, 0.0};
    all.push_back(meet(rod, ends[k], across, -ends[k], {0.0, 0.0, 1.0}));
    all.back().i.velocity = {0.0, 0.0, -0.5 * speed};
    all.back().j.velocity = {0.0, 0.0, 0.5 * speed};
  }
  Scene scene = scene_of(all);
  const double depth = 1.5 * rod.diameter;
  const double kn = all[0].effective_mass() * speed * speed / (depth * depth);
  scene.physics = linear_material(kn, kn, 1.0, 0.0) + rod_pair("linear tangential history") +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-6;
  scene.steps = 5000;
  scene.dump_every = 20;
  const std::vector<Frame> frames = run(scene, GetParam());

  double deepest = 0.0, energy_error = 0.0;
  for (const Frame &frame : frames)
    deepest =
        std::max(deepest, all[0].i.diameter - frame.rods[0].position.z + frame.rods[1].position.z);
  EXPECT_GT(deepest, 1.4 * rod.diameter) << "the axes must pass each other for this test";
  for (size_t k = 0; k < all.size(); k++) {
    const Rod &i = frames.back().rods[2 * k], &j = frames.back().rods[2 * k + 1];
    EXPECT_EQ(frames.back().contacts[2 * k], 0.0) << "pair " << k << " has not parted";
    energy_error =
        std::max(energy_error,
                 std::fabs(kinetic_energy({i, j}) / kinetic_energy({all[k].i, all[k].j}) - 1.0));
  }
  // Centre on centre nothing turns, so that the sides can be told.
  const Rod &i = frames.back().rods[0], &j = frames.back().rods[1];
  EXPECT_GT(i.position.z - j.position.z, rod.diameter) << "the rods have passed through";
  // Verlet's error (omega dt)^2 and the unresolved first and last step.
  expect_holds({"Deep overlap, 14 m/s, 1.5 D: speed of parting, relative", "elastic", 1e-6},
               std::fabs((i.velocity.z - j.velocity.z) / speed - 1.0));
  expect_holds(
      {"Deep overlap, on and off centre: energy after parting, relative", "conserved", 1e-6},
      energy_error);
}

// Axes that cross exactly have no direction p - q: the common perpendicular parts them.
TEST(DeepOverlap, CrossingAxesArePushedApart)
{
  Scene scene;
  Rod rod, across;
  across.axis = {0.0, 1.0, 0.0};
  Rod parallel = rod;
  parallel.position = rod.position = {0.5, 0.0, 0.0};
  scene.rods = {rod, parallel};
  rod.position = across.position = {-0.5, 0.0, 0.0};
  scene.rods.push_back(rod);
  scene.rods.push_back(across);
  scene.physics = linear_material(1e5, 1e5, 0.5, 0.2) + rod_pair("linear tangential history") +
                  "fix motion all nve/spherocylinder\n";
  scene.steps = 2000;
  const std::vector<Rod> after = run(scene).back().rods;
  for (const size_t k : {0, 2}) {
    const Vec3 between = after[k].position - after[k + 1].position;
    EXPECT_GE(norm(between), 0.99 * rod.diameter) << "pair " << k;
  }
  EXPECT_NEAR(std::fabs(after[2].position.z - after[3].position.z),
              norm(after[2].position - after[3].position), 1e-9);
}

DECKS_IN_ALL_MODES(PairImpact);

}  // namespace
