// SPDX-License-Identifier: GPL-2.0-or-later
// Ends of rods meet walls. Where one end does, the run stops after that contact: the other end comes
// down later.
#include <algorithm>
#include <cmath>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

class WallImpact : public RunMode {};

// Spring and dashpot jump by 2 zeta omega v at touch and at separation, and the step that holds
// the jump is not resolved: a relative error of about 2 zeta omega dt. The time steps below give
// omega dt < 1e-3; the rod turns by less than 1e-3 while it touches.
constexpr double kImpactTolerance = 1e-3;

constexpr double kApproach = 0.01;  // speed of the contact point, m/s: a contact as short as can be
constexpr double kGap = 1e-7;       // before the contact, m

// A rod in the xz plane whose lower end is the gap above the floor, and whose end approaches it at
// kApproach while the rod turns at omega_y.
Rod rod_above_floor(double elevation, double omega_y, double aspect_ratio)
{
  Rod rod;
  rod.length = aspect_ratio * rod.diameter;
  rod.axis = {std::cos(elevation), 0.0, std::sin(elevation)};
  rod.position.z = rod.radius() + kGap + rod.half_cylinder() * rod.axis.z;
  rod.omega = {0.0, omega_y, 0.0};
  // End velocity v + omega x (-h/2 u): z component v_z + omega_y h/2 u_x.
  rod.velocity.z = -kApproach - omega_y * rod.half_cylinder() * rod.axis.x;
  return rod;
}

// One lever a = (h/2) cos(elevation): K = 1/m + a^2/I_t, J = -(1+e) v_n/K, v_z' = v_z + J/m,
// omega_y' = omega_y + a J/I_t (the lower end lies at -a along x, the force along +z).
void add_impulse(Rod &rod, double restitution)
{
  const auto p = rod.properties();
  const double a = rod.half_cylinder() * rod.axis.x;
  const double vn = rod.velocity.z + a * rod.omega.y;
  const double J = -(1.0 + restitution) * vn / (1.0 / p.mass + a * a / p.inertia_transverse);
  rod.velocity.z += J / p.mass;
  rod.omega.y += a * J / p.inertia_transverse;
}

// A floor without friction at z = 0, stiffness 1e6 N/m; a restitution for each atom type.
std::string smooth_floor(const std::vector<double> &restitutions, const std::string &keywords = "")
{
  const int types = static_cast<int>(restitutions.size());
  return pair_property("kn", types, 1e6) + pair_property("kt", types, 1e6) +
         pair_property("coefficientRestitution", types,
                       [&](int i, int j) { return restitutions[std::max(i, j) - 1]; }) +
         rod_pair("linear tangential off") +
         rod_wall("floor", "linear tangential off", "type 1 zplane 0.0 " + keywords) +
         "fix motion all nve/spherocylinder\n";
}

const std::vector<double> kRestitutions = {1.0, 0.9, 0.5, 0.2};

// Flat rods of four lengths and these restitutions above the floor.
Scene flat_rods(const std::string &keywords)
{
  Scene scene;
  scene.types = 4;
  scene.box_lo[2] = -0.1;
  for (const double ratio : {1.5, 3.0, 10.0, 30.0})
    for (int type = 1; type <= 4; type++) {
      Rod rod;
      rod.type = type;
      rod.length = ratio * rod.diameter;
      rod.velocity.z = -kApproach;
      rod.position = {-0.5, -0.9 + 0.1 * static_cast<double>(scene.rods.size()),
                      rod.radius() + kGap};
      scene.rods.push_back(rod);
    }
  scene.physics = smooth_floor(kRestitutions, keywords);
  scene.dt = 3e-8;
  scene.steps = 40000;
  return scene;
}

double difference(const Rod &got, const Rod &wanted)
{
  return std::max(norm(got.velocity - wanted.velocity),
                  norm(got.omega - wanted.omega) * wanted.half_cylinder()) /
         kApproach;
}

TEST_P(WallImpact, OffCentreWithoutFriction)
{
  const std::vector<double> restitutions = {1.0, 0.5, 0.2};
  Scene scene;
  scene.types = 3;
  scene.box_lo[2] = -0.1;
  for (const double ratio : {2.0, 10.0, 30.0})
    for (const double elevation : {15.0, 40.0, 70.0, 90.0})
      for (int type = 1; type <= 3; type++) {
        // Every other rod turns as it comes in.
        const double omega_y = scene.rods.size() % 2 ? 0.2 : 0.0;
        Rod rod = rod_above_floor(degrees(elevation), omega_y, ratio);
        rod.type = type;
        const int n = static_cast<int>(scene.rods.size());
        rod.position.x = -0.85 + 0.34 * (n % 6);
        rod.position.y = -0.85 + 0.34 * (n / 6);
        scene.rods.push_back(rod);
      }
  // Stiffness 1e6 N/m: the slowest contact (30 D upright, e = 0.2) lasts 0.9 ms.
  scene.physics = smooth_floor(restitutions);
  scene.dt = 3e-8;
  scene.steps = 40000;

  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  double error = 0.0;
  for (size_t i = 0; i < scene.rods.size(); i++) {
    Rod wanted = scene.rods[i];
    add_impulse(wanted, restitutions[wanted.type - 1]);
    error = std::max(error, difference(after[i], wanted));
  }
  expect_holds(
      {"Off-centre wall impact without friction, 36 rods", "J = -(1+e) v_n/K", kImpactTolerance},
      error);
}

// Elastic, sliding at v_x = side * 50 kApproach throughout: friction J_t = -mu side J_n acts on the
// lever b = (h/2) sin(elevation) + r, so that J_n = -2 v_n / (K + mu side a b / I_t).
TEST_P(WallImpact, ElasticWithSlidingThroughout)
{
  const double friction = 0.2;
  Scene scene;
  scene.box_lo[2] = -0.1;
  for (const double elevation : {20.0, 45.0, 75.0})
    for (const double side : {-1.0, 1.0}) {
      Rod rod = rod_above_floor(degrees(elevation), 0.0, 10.0);
      rod.velocity.x = side * 50.0 * kApproach;
      rod.position.y = -0.75 + 0.3 * static_cast<double>(scene.rods.size());
      scene.rods.push_back(rod);
    }
  scene.physics = linear_material(1e6, 1e6, 1.0, friction) + rod_pair("linear tangential history") +
                  rod_wall("floor", "linear tangential history", "type 1 zplane 0.0") +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-7;
  scene.steps = 6000;

  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  double error = 0.0;
  for (size_t i = 0; i < scene.rods.size(); i++) {
    Rod wanted = scene.rods[i];
    const auto p = wanted.properties();
    const double side = wanted.velocity.x > 0.0 ? 1.0 : -1.0;
    const double a = wanted.half_cylinder() * wanted.axis.x;
    const double b = wanted.half_cylinder() * wanted.axis.z + wanted.radius();
    const double K = 1.0 / p.mass + a * a / p.inertia_transverse;
    const double K_nt = a * b / p.inertia_transverse;
    const double J = 2.0 * kApproach / (K + friction * side * K_nt);
    wanted.velocity.z += J / p.mass;
    wanted.velocity.x -= friction * side * J / p.mass;
    wanted.omega.y += (a + friction * side * b) * J / p.inertia_transverse;
    error = std::max(error, difference(after[i], wanted));
  }
  expect_holds({"Elastic wall impact, sliding throughout, 6 rods",
                "J_n = -2 v_n/(K + mu s a b/I_t)", kImpactTolerance},
               error);
}

// The inside of a cylinder, from the plane through its axis, is a plane wall: the same closed form
// with the wall at x = +R, for either end of the rod, and at x = -R.
TEST_P(WallImpact, EndAgainstTheInsideOfACylinder)
{
  const double restitution = 0.5, R = 0.3;
  Scene scene;
  const double degrees_from_wall[] = {90.0, 40.0, 70.0};
  for (int i = 0; i < 12; i++) {
    const double side = i % 2 ? -1.0 : 1.0;     // which wall
    const double end = i % 4 < 2 ? 1.0 : -1.0;  // which end of the rod, along its axis
    Rod flat = rod_above_floor(degrees(degrees_from_wall[i / 4]), 0.0, 10.0);
    Rod rod = flat;
    // (z up from the floor) -> (from the wall inwards), (x) -> z.
    rod.axis = (-end) * Vec3{-side * flat.axis.z, 0.0, flat.axis.x};
    rod.position = {side * (R - flat.position.z), 0.0, -0.9 + 0.15 * i};
    rod.velocity = {side * kApproach, 0.0, 0.0};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e6, 1e6, restitution, 0.2) + rod_pair("linear tangential off") +
                  rod_wall("side", "linear tangential off", "type 1 zcylinder 0.3 0.0 0.0") +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-7;
  scene.steps = 6000;

  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  double error = 0.0;
  for (size_t i = 0; i < scene.rods.size(); i++) {
    const Rod &start = scene.rods[i];
    const auto p = start.properties();
    const double side = start.velocity.x > 0.0 ? 1.0 : -1.0;
    // Arm of the end that touches, and a unit force towards the cylinder's axis.
    const double towards = side * start.axis.x > 0.0 ? 1.0 : -1.0;
    const Vec3 arm = towards * start.half_cylinder() * start.axis, force = {-side, 0.0, 0.0};
    const Vec3 torque = cross(arm, force);
    const double K = 1.0 / p.mass + norm_squared(torque) / p.inertia_transverse;
    const double J = (1.0 + restitution) * kApproach / K;
    Rod wanted = start;
    wanted.velocity = start.velocity + J / p.mass * force;
    wanted.omega = J / p.inertia_transverse * torque;
    error = std::max(error, difference(after[i], wanted));
  }
  expect_holds(
      {"Rod ends against the inside of a cylinder, 12 rods", "J = (1+e) v_n/K", kImpactTolerance},
      error);
}

// Flat on a plane: both ends touch at once and share the load, so that m_eff = m/2 at each. The rod
// parts with e times its speed of approach and does not turn.
TEST_P(WallImpact, FlatLanding)
{
  const Scene scene = flat_rods("");
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  double error = 0.0;
  for (size_t i = 0; i < scene.rods.size(); i++) {
    Rod wanted = scene.rods[i];
    wanted.velocity.z = kApproach * kRestitutions[wanted.type - 1];
    error = std::max(error, difference(after[i], wanted));
  }
  expect_holds({"Flat landing on both ends, 16 rods: speed, / approach", "e", kImpactTolerance},
               error);
}

// With effective_mass off each end has a dashpot 2 beta sqrt(k m): two of them on 2 k and m have the
// damping ratio z = beta sqrt(2), and the rod parts with exp(-pi z/sqrt(1 - z^2)).
TEST_P(WallImpact, FlatLandingDampedByMass)
{
  const Scene scene = flat_rods("effective_mass off");
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  double error = 0.0;
  for (size_t i = 0; i < scene.rods.size(); i++) {
    Rod wanted = scene.rods[i];
    const double pi = std::acos(-1.0), log_e = std::log(kRestitutions[wanted.type - 1]);
    const double z = std::sqrt(2.0) * -log_e / std::hypot(pi, log_e);
    wanted.velocity.z = kApproach * std::exp(-pi * z / std::sqrt(1.0 - z * z));
    error = std::max(error, difference(after[i], wanted));
  }
  expect_holds({"Flat landing with effective_mass off: speed, / approach",
                "exp(-pi z/sqrt(1 - z^2)), z = beta sqrt(2)", kImpactTolerance},
               error);
}

DECKS_IN_ALL_MODES(WallImpact);

}  // namespace
