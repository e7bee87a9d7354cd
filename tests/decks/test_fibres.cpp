// SPDX-License-Identifier: GPL-2.0-or-later
// Flexible fibres against the exact answers of the discrete chain and against the beam that it becomes
// with more segments. N rods, joints h apart, bending stiffness EI/h each; L = n h.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "convergence.h"
#include "core/numbers.h"
#include "core/rotation.h"
#include "fibres.h"
#include "run_mode.h"

using namespace decks;
using spherocylinder::pi;

namespace {

class FibreStatics : public RunMode {};

Vec3 tip_of(const Rod &rod) { return rod.position + rod.half_cylinder() * rod.axis; }

// The clamped fibre's last frame after it has come to rest under `loads`, of which a push along it makes
// the lowest frequency this much smaller.
std::vector<Rod> at_rest(const Fibre &fibre, const std::string &loads, Mode mode = Mode::OneRank,
                         double slower = 1.0)
{
  Scene scene = fibre_scene(fibre);
  const double length = fibre.segments * fibre.joint_distance;
  scene.physics =
      fibre_physics(fibre, "damping 0.1") + kClampFirst + loads + drag_of(fibre, length, slower);
  scene.steps = 2 * ((steps_to_rest(fibre, length, slower) + 1) / 2);
  return run(scene, mode).back().rods;
}

std::string force_on_last(const Fibre &fibre, const Vec3 &force)
{
  return fmt::format("group last id {}\nfix load last addforce {:.17g} {:.17g} {:.17g}\n",
                     fibre.segments, force.x, force.y, force.z);
}

// Closed form: joints k = 1 ... n, n = N - 1, see the moment F (k - 1/2) h from the load at the last rod's
// centre and move it by (k - 1/2) h each: F L^3/3EI (1 - 1/(4 n^2)), L = n h between the centres of the
// first and last rod; shear adds F n/K_shear. Small angles: the error is that of cos and sin, (w/L)^2.
TEST_P(FibreStatics, ForceAtTheEnd)
{
  Fibre fibre;
  const double n = fibre.segments - 1, length = n * fibre.joint_distance;
  const double force = 1e-4 * 3.0 * fibre.bending_rigidity() / (length * length);
  const std::vector<Rod> rods =
      at_rest(fibre, force_on_last(fibre, {0.0, -force, 0.0}), GetParam());
  const double bending =
      force * std::pow(length, 3) / (3.0 * fibre.bending_rigidity()) * (1.0 - 1.0 / (4.0 * n * n));
  const double expected = bending + force * n / fibre.shear_stiffness();
  expect_holds({"Clamped fibre, 9 segments, force at the end: deflection, relative",
                "F L^3/3EI (1 - 1/(4n^2)) + F n/K_shear", 1e-6},
               std::fabs(-rods.back().position.y / expected - 1.0));
  // The last joint's turn is felt to the tip: closed form F h^2/(2 K_bend) n^2 of the whole.
  const double slope = force * fibre.joint_distance * n * n / (2.0 * fibre.bend_stiffness());
  expect_holds({"Clamped fibre, 9 segments, force at the end: slope, relative", "F L^2/2EI", 1e-6},
               std::fabs(-rods.back().axis.y / slope - 1.0));
}

// Closed form, tip = outer shared point of the last rod, L = (N - 1/2) h, n = N - 1/2:
// q L^4/8EI (1 - 1/(4 n^2))^2. Beside it the weight P of the hemisphere at the end, felt at the centre of
// the last rod: P h^2/K sum (k - 1/2) k; and shear: each joint carries what hangs beyond it.
TEST_P(FibreStatics, OwnWeight)
{
  Fibre fibre;
  const int joints = fibre.segments - 1;
  const double n = fibre.segments - 0.5, h = fibre.joint_distance, length = n * h;
  const double EI = fibre.bending_rigidity();
  const double gravity = 1e-4 * 8.0 * EI / (fibre.mass_per_length() * std::pow(length, 3));
  const std::vector<Rod> rods = at_rest(
      fibre, fmt::format("fix weight all gravity {:.17g} vector 0 -1 0\n", gravity), GetParam());
  const double q = fibre.mass_per_length() * gravity, cap = fibre.cap_mass() * gravity;
  const double beam = q * std::pow(length, 4) / (8.0 * EI) * std::pow(1.0 - 1.0 / (4.0 * n * n), 2);
  double rest = 0.0;
  for (int k = 1; k <= joints; k++)
    rest += cap * h * h / fibre.bend_stiffness() * (k - 0.5) * k +
            (q * h * k + cap) / fibre.shear_stiffness();
  expect_holds({"Clamped fibre, 9 segments, own weight: deflection, relative",
                "q L^4/8EI (1 - 1/(4n^2))^2 + cap + shear", 1e-6},
               std::fabs(-tip_of(rods.back()).y / (beam + rest) - 1.0));
  // The same from the first joint on: L = n h, n = N - 1, q L^4/8EI (1 + 1/n)^2.
  const double from_joint =
      q * std::pow(joints * h, 4) / (8.0 * EI) * std::pow(1.0 + 1.0 / joints, 2);
  expect_holds({"Fibre clamped at a joint, 8 segments, own weight: deflection, relative",
                "q L^4/8EI (1 + 1/n)^2 + cap + shear", 1e-6},
               std::fabs(-tip_of(rods.back()).y / (from_joint + rest) - 1.0));
}

// Axially: each joint is stretched by F/K_stretch.
TEST_P(FibreStatics, Pulled)
{
  Fibre fibre;
  const double force = 1e-3;
  const std::vector<Rod> rods = at_rest(fibre, force_on_last(fibre, {force, 0.0, 0.0}), GetParam());
  const int joints = fibre.segments - 1;
  const double stretch = rods.back().position.x - joints * fibre.joint_distance;
  expect_holds({"Clamped fibre, pulled: stretch, relative", "F n h/EA", 1e-6},
               std::fabs(stretch / (joints * force / fibre.stretch_stiffness()) - 1.0));
}

DECKS_IN_ALL_MODES(FibreStatics);

// Reaction of a fibre between two frozen rods, the last one turned and moved as `pose` says; loads on the
// last rod are dumped by a fix freeze that comes before the joints.
struct Reaction {
  Vec3 force, torque;
  std::vector<double> energies;  // stretch, shear, bend, twist
  std::vector<Rod> rods;
};

Reaction between_clamps(const Fibre &fibre, const std::vector<Rod> &start,
                        const std::string &turn_last = "")
{
  Scene scene = fibre_scene(fibre);
  scene.rods = start;
  const double length = fibre.segments * fibre.joint_distance;
  scene.steps = steps_to_rest(fibre, length);
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write(
      "in.clamps",
      preamble(scene) + "read_data rods.data\nneighbor 0.002 bin\n" +
          fmt::format("group clamp id 1 {}\ngroup others subtract all clamp\n", fibre.segments) +
          linear_material(1e3, 1e3, 0.5, 0.3) + rod_pair("linear tangential history") +
          "fix clamp clamp freeze\nfix motion others nve/spherocylinder\n" +
          drag_of(fibre, length) +
          fmt::format("fix joints all joint/spherocylinder youngsModulus {} poissonsRatio {} join "
                      "1e-4 damping_twist 0.3 damping_bend 0.3\n",
                      fibre.youngs_modulus, fibre.poissons_ratio) +
          turn_last + fmt::format("timestep {}\n", scene.dt) +
          "thermo_style custom step f_joints[1] f_joints[2] f_joints[3] f_joints[4]\n"
          "compute contacts all contact/spherocylinder\n" +
          fmt::format("thermo {}\nthermo_modify format float %.15g\n", scene.steps) +
          exact_dump("dump.state", scene.steps,
                     std::string(kFrameColumns) + " fx fy fz tqx tqy tqz") +
          fmt::format("run {}\n", scene.steps));
  const Outcome outcome = folder.run("in.clamps");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  Reaction reaction;
  if (outcome.exit_code != 0) return reaction;
  const Table loads = read_dump(folder / "dump.state").back().atoms;
  const size_t last = loads.rows.size() - 1;
  reaction.force = {loads.at(last, "fx"), loads.at(last, "fy"), loads.at(last, "fz")};
  reaction.torque = {loads.at(last, "tqx"), loads.at(last, "tqy"), loads.at(last, "tqz")};
  const Table thermo = read_thermo(outcome.output);
  for (size_t column = 1; column < 5; column++)
    reaction.energies.push_back(thermo.rows.back()[column]);
  reaction.rods = read_frames(folder / "dump.state", scene).back().rods;
  return reaction;
}

// Rods on an arc, each turned by `angle` against the one before about z.
std::vector<Rod> rods_on_arc(const Fibre &fibre, double angle)
{
  std::vector<Rod> rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  for (int k = 1; k < fibre.segments; k++) {
    rods[k].axis = {std::cos(k * angle), std::sin(k * angle), 0.0};
    rods[k].position =
        rods[k - 1].position + (0.5 * fibre.joint_distance) * (rods[k - 1].axis + rods[k].axis);
  }
  return rods;
}

// Closed form: an end moment M bends every joint by M h/EI, an arc; no force. Any angle: 20 degrees each.
TEST(FibreMoments, EndMomentMakesAnArc)
{
  const Fibre fibre;
  const double angle = degrees(20.0);
  const std::vector<Rod> arc = rods_on_arc(fibre, angle);
  const Reaction reaction = between_clamps(fibre, arc);
  ASSERT_EQ(reaction.rods.size(), arc.size());
  const double moment = fibre.bend_stiffness() * angle;
  expect_holds({"Fibre bent to an arc: end moment, relative", "EI/h x angle of each joint", 1e-9},
               std::fabs(-reaction.torque.z / moment - 1.0));
  double off = 0.0;
  for (size_t k = 0; k < arc.size(); k++)
    off = std::max(off, norm(reaction.rods[k].axis - arc[k].axis));
  expect_holds({"Fibre bent to an arc: axes", "equal angles", 1e-9}, off);
  const double energy = 0.5 * (fibre.segments - 1) * moment * angle;
  expect_holds({"Fibre bent to an arc: energy, relative", "M^2 L/2EI", 1e-9},
               std::fabs(reaction.energies.at(2) / energy - 1.0));
  expect_holds({"Fibre bent to an arc: force on the end x L/M", "none", 1e-8},
               norm(reaction.force) * 0.16 / moment);
}

// A force F at the outer end of the last rod, which no command of the host exerts: the last rod is held
// where such a force would hold it, and the fibre must pull back with F at that end. Closed form: joint j of
// n sees F (n + 1 - j) h and moves the end by as much each; L from the clamp, the first rod's centre (C, n =
// N - 1/2) or the first joint (J, n = N - 1), to the outer end.
TEST(FibreMoments, ForceAtTheOuterEnd)
{
  const Fibre fibre;
  const int joints = fibre.segments - 1;
  const double h = fibre.joint_distance, K = fibre.bend_stiffness();
  const double force = 1e-5 * K / (h * joints * joints);
  std::vector<Rod> rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  double angle = 0.0;
  for (int j = 1; j <= joints; j++) {
    angle += force * (joints + 1 - j) * h / K;
    rods[j].axis = {std::cos(angle), -std::sin(angle), 0.0};
    rods[j].position = rods[j - 1].position + (0.5 * h) * (rods[j - 1].axis + rods[j].axis) +
                       Vec3{0.0, -force / fibre.shear_stiffness(), 0.0};
  }
  const double sunk = -tip_of(rods.back()).y;
  const Reaction reaction = between_clamps(fibre, rods);
  ASSERT_EQ(reaction.rods.size(), rods.size());
  const double EI = fibre.bending_rigidity(), shear = joints / fibre.shear_stiffness();
  const double n_c = fibre.segments - 0.5, n_j = joints;
  const double by_c = std::pow(n_c * h, 3) / (3.0 * EI) * (1.0 - 1.0 / (4.0 * n_c * n_c));
  const double by_j =
      std::pow(n_j * h, 3) / (3.0 * EI) * (1.0 + 1.0 / n_j) * (1.0 + 1.0 / (2.0 * n_j));
  expect_holds({"Force at the outer end, clamp at the first centre: deflection/force, relative",
                "L^3/3EI (1 - 1/(4n^2)) + joints/K_shear", 1e-6},
               std::fabs(sunk / reaction.force.y / (by_c + shear) - 1.0));
  expect_holds({"Force at the outer end, clamp at the first joint: deflection/force, relative",
                "L^3/3EI (1 + 1/n)(1 + 1/(2n)) + joints/K_shear", 1e-6},
               std::fabs(sunk / reaction.force.y / (by_j + shear) - 1.0));
  expect_holds({"Force at the outer end: torque about the last centre, relative", "F h/2", 1e-6},
               std::fabs(reaction.torque.z / (0.5 * h * force) - 1.0));
}

// Closed form: the end turned by 80 degrees about the axis twists each joint by 10, T = GJ/h each.
TEST(FibreMoments, EndTwistIsShared)
{
  const Fibre fibre;
  const std::vector<Rod> rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  // The frame along x is y-turned by 90 degrees, then 80 degrees about x.
  const auto q = spherocylinder::rotation_about({1.0, 0.0, 0.0}, degrees(80.0)) *
                 spherocylinder::rotation_about({0.0, 1.0, 0.0}, degrees(90.0));
  const Reaction reaction =
      between_clamps(fibre, rods,
                     fmt::format("set atom {} quat_direct {:.17g} {:.17g} {:.17g} {:.17g}\n",
                                 fibre.segments, q.w, q.x, q.y, q.z));
  const double angle = degrees(80.0) / (fibre.segments - 1);
  expect_holds({"Fibre twisted by 80 degrees: end torque, relative", "GJ/L x angle", 1e-8},
               std::fabs(-reaction.torque.x / (fibre.twist_stiffness() * angle) - 1.0));
  const double energy = 0.5 * (fibre.segments - 1) * fibre.twist_stiffness() * angle * angle;
  expect_holds({"Fibre twisted by 80 degrees: energy, relative", "T^2 L/2GJ", 1e-8},
               std::fabs(reaction.energies.at(3) / energy - 1.0));
  double bent = 0.0;
  for (const Rod &rod : reaction.rods) bent = std::max(bent, norm(rod.axis - Vec3{1.0, 0.0, 0.0}));
  expect_holds({"Fibre twisted by 80 degrees: axes", "straight", 1e-12}, bent);
}

// The chain under a force across, bent far: by shooting from the free end. theta: angles of the rods.
// Neither stretch nor shear: those of the run are 100 times as stiff as the beam's.
double slow_deflection(const Fibre &fibre, double force)
{
  const int n = fibre.segments - 1;
  const double h = fibre.joint_distance, K = fibre.bend_stiffness();
  const auto shoot = [&](double last, double &deflection) {
    double theta = last, moment = force * 0.5 * h * std::cos(last);
    deflection = 0.5 * h * std::sin(last);
    for (int k = n; k >= 1; k--) {
      theta -= moment / K;  // joint k, between rods k - 1 and k
      deflection += (k > 1 ? h : 0.5 * h) * std::sin(theta);
      moment += force * h * std::cos(theta);
    }
    return theta;
  };
  double low = 0.0, high = pi / 2.0, deflection = 0.0;
  for (int trial = 0; trial < 200; trial++) {
    const double middle = 0.5 * (low + high);
    (shoot(middle, deflection) > 0.0 ? high : low) = middle;
  }
  shoot(low, deflection);
  return deflection;
}

// Bisshopp & Drucker (1945): a cantilever under F L^2/EI = 2 sinks by 0.49345748 L (digits: Mattiasson
// 1981). With n = 4, 8, 16 segments between clamp and load.
TEST(FibreContinuum, LargeDeflection)
{
  constexpr double kLength = 0.16, kElastica = 0.49345748;
  std::vector<double> numbers, errors, sunk;
  double worst = 0.0;
  for (const int n : {4, 8, 16}) {
    Fibre fibre;
    fibre.segments = n + 1;
    fibre.joint_distance = kLength / n;
    fibre.stretch_factor = 100.0;
    const double force = 2.0 * fibre.bending_rigidity() / (kLength * kLength);
    const std::vector<Rod> rods = at_rest(fibre, force_on_last(fibre, {0.0, -force, 0.0}));
    const double deflection = -rods.back().position.y;
    worst = std::max(worst, std::fabs(deflection / slow_deflection(fibre, force) - 1.0));
    numbers.push_back(n);
    sunk.push_back(deflection / kLength);
    errors.push_back(std::fabs(sunk.back() - kElastica));
  }
  expect_holds({"Clamped fibre bent by half its length: deflection, relative",
                "discrete chain by shooting", 2e-5},
               worst);
  expect_holds({"Large deflection, n = 4, 8, 16: order in n, off -2", "elastica", 0.1},
               std::fabs(order_of_convergence(numbers, errors) + 2.0));
  expect_holds({"Large deflection, carried on to n = infinity, / L",
                "elastica (Bisshopp & Drucker), 0.49346", 1e-4},
               std::fabs((4.0 * sunk[2] - sunk[1]) / 3.0 - kElastica));
}

// Closed form of the chain as a column, clamped at the first rod, a small force F across and P along at
// the last: with 2 K (1 - cos phi) = P h, w = (F/P) ((h/2) cot(phi/2) tan(n phi) - n h). It has no end at
// n phi = pi/2, P = (4 K/h) sin^2(pi/(4 n)): Euler's pi^2 EI/(4 L^2) as n grows, by n^-2.
TEST(FibreContinuum, EulerBuckling)
{
  constexpr double kLength = 0.16;
  double worst = 0.0;
  std::vector<double> numbers, errors;
  for (const int n : {4, 8, 16}) {
    Fibre fibre;
    fibre.segments = n + 1;
    fibre.joint_distance = kLength / n;
    fibre.stretch_factor = 100.0;
    const double K = fibre.bend_stiffness(), h = fibre.joint_distance;
    const double euler = pi * pi * fibre.bending_rigidity() / (4.0 * kLength * kLength);
    const double P = 0.5 * euler, F = 1e-4 * P;
    const std::vector<Rod> rods =
        at_rest(fibre, force_on_last(fibre, {-P, -F, 0.0}), Mode::OneRank, std::sqrt(0.5));
    const double w = -rods.back().position.y;
    const auto deflection = [&](double phi) {
      const double load = 2.0 * K * (1.0 - std::cos(phi)) / h;
      return F / load * (0.5 * h / std::tan(0.5 * phi) * std::tan(n * phi) - n * h);
    };
    worst = std::max(worst, std::fabs(w / deflection(std::acos(1.0 - 0.5 * P * h / K)) - 1.0));
    // What the measured deflection says of the load at which it has no end: w = w_0/(1 - P/P_cr) but
    // for the shape; here by the stiffness that the closed form would need.
    double low = 0.5, high = 2.0;
    for (int trial = 0; trial < 100; trial++) {
      const double factor = 0.5 * (low + high);
      const double phi = std::acos(1.0 - 0.5 * P * h / (factor * K));
      const double load_by_F = F / P * (0.5 * h / std::tan(0.5 * phi) * std::tan(n * phi) - n * h);
      (load_by_F > w ? low : high) = factor;
    }
    const double critical = low * 4.0 * K / h * std::pow(std::sin(pi / (4.0 * n)), 2);
    numbers.push_back(n);
    errors.push_back(std::fabs(critical / euler - 1.0));
  }
  expect_holds({"Column at half of Euler's load: deflection, relative",
                "(F/P)((h/2) cot(phi/2) tan(n phi) - n h)", 5e-5},
               worst);
  expect_holds({"Euler buckling, n = 4, 8, 16: order in n, off -2", "pi^2 EI/4L^2", 0.1},
               std::fabs(order_of_convergence(numbers, errors) + 2.0));
}

// The lowest period of a clamped fibre of n segments, L = (n - 1/2) h, from where its end passes zero:
// 1.787 L^2 sqrt(rho_l/EI) for n -> infinity. The last rod weighs as the others, its hemisphere made up for
// by its density; turning inertia and shear are of the order (r/L)^2, 1e-5.
double measured_period(int n, double length)
{
  Fibre fibre;
  fibre.segments = n;
  fibre.joint_distance = length / (n - 0.5);
  fibre.radius = 0.0005;
  Scene scene = fibre_scene(fibre);
  scene.rods.back().density *= fibre.segment_mass() / (fibre.segment_mass() + fibre.cap_mass());
  // As the lowest mode moves, nearly: its higher parts are damped by the joints.
  for (int k = 0; k < n; k++) {
    const double s = k * fibre.joint_distance / length;
    const double shape = s * s * (3.0 - s) / 2.0, slope = (6.0 * s - 3.0 * s * s) / 2.0 / length;
    scene.rods[k].velocity = {0.0, 1e-3 * shape, 0.0};
    scene.rods[k].omega = {0.0, 0.0, 1e-3 * slope};
  }
  scene.physics = fibre_physics(fibre, "damping 0.2");
  scene.physics += kClampFirst;
  const double period = 2.0 * pi / fibre.lowest_frequency(length);
  const long per_period = std::lround(period / scene.dt);
  scene.dump_every = std::max(1L, per_period / 200);
  scene.steps = per_period * 7;
  std::vector<double> zeros;
  std::vector<Frame> frames = run(scene);
  for (size_t k = 1; k < frames.size(); k++) {
    const double before = frames[k - 1].rods.back().position.y;
    const double after = frames[k].rods.back().position.y;
    if (!(before < 0.0 && after >= 0.0)) continue;
    // Of the third order between the two: by position and velocity at both.
    const double dt = frames[k].time - frames[k - 1].time;
    const double v0 = frames[k - 1].rods.back().velocity.y * dt;
    const double v1 = frames[k].rods.back().velocity.y * dt;
    double low = 0.0, high = 1.0;
    for (int trial = 0; trial < 60; trial++) {
      const double s = 0.5 * (low + high), c = 1.0 - s;
      const double y = c * c * (1.0 + 2.0 * s) * before + s * s * (1.0 + 2.0 * c) * after +
                       s * c * (c * v0 - s * v1);
      (y < 0.0 ? low : high) = s;
    }
    zeros.push_back(frames[k - 1].time + low * dt);
  }
  return zeros.size() < 2 ? 0.0 : (zeros.back() - zeros[1]) / (zeros.size() - 2);
}

TEST(FibreContinuum, LowestPeriod)
{
  constexpr double kLength = 0.16;
  Fibre beam;
  beam.radius = 0.0005;
  const double wanted = 2.0 * pi / beam.lowest_frequency(kLength);
  std::vector<double> numbers, errors, periods;
  for (const int n : {4, 8, 16}) {
    numbers.push_back(n - 0.5);
    periods.push_back(measured_period(n, kLength));
    errors.push_back(std::fabs(periods.back() / wanted - 1.0));
  }
  const double ratio = std::pow(numbers[2] / numbers[1], 2);
  const double carried_on = (ratio * periods[2] - periods[1]) / (ratio - 1.0);
  expect_holds({"Lowest period of a clamped fibre, n = 4, 8, 16: order in n, off -2",
                "1.787 L^2 sqrt(rho_l/EI)", 0.15},
               std::fabs(order_of_convergence(numbers, errors) + 2.0));
  expect_holds(
      {"Lowest period, carried on to n = infinity, relative", "1.787 L^2 sqrt(rho_l/EI)", 1e-3},
      std::fabs(carried_on / wanted - 1.0));
}

}  // namespace
