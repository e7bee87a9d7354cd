// SPDX-License-Identifier: GPL-2.0-or-later
// Ends of fibres that are held, turn and are driven: hinges, a hung chain, towed fibres, a twisted ring.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "convergence.h"
#include "core/numbers.h"
#include "fibres.h"

using namespace decks;
using spherocylinder::pi;

namespace {

// Rods end to end along a line of equal angles, from `start` on.
std::vector<Rod> rods_on_line(const Fibre &fibre, Vec3 start, double first_angle, double turn)
{
  std::vector<Rod> rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  for (int k = 0; k < fibre.segments; k++) {
    const double angle = first_angle + k * turn;
    rods[k].axis = {std::cos(angle), 0.0, std::sin(angle)};
    rods[k].position = start + (0.5 * fibre.joint_distance) * rods[k].axis;
    start = start + fibre.joint_distance * rods[k].axis;
  }
  return rods;
}

// So that the end segments weigh as the others.
void weigh_alike(const Fibre &fibre, std::vector<Rod> &rods)
{
  for (Rod *rod : {&rods.front(), &rods.back()})
    rod->density *= fibre.segment_mass() / (fibre.segment_mass() + fibre.cap_mass());
}

Vec3 tail_of(const Rod &rod) { return rod.position - rod.half_cylinder() * rod.axis; }

double bisected(double low, double high, const std::function<bool(double)> &is_below)
{
  for (int trial = 0; trial < 200; trial++) {
    const double middle = 0.5 * (low + high);
    (is_below(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// A chain of n links of the length L/n, hung from hinges at one height, D apart. Closed form: with its weight w
// in the middle of each link, link k stands at tan(angle) = (n/2 - k + 1/2) w/H, H such that they span D.
double sag_of_links(int n, double length, double span)
{
  const auto angle = [&](int k, double w_over_h) {
    return std::atan((0.5 * n - k + 0.5) * w_over_h);
  };
  const double w_over_h = bisected(0.0, 100.0, [&](double value) {
    double sum = 0.0;
    for (int k = 1; k <= n; k++) sum += length / n * std::cos(angle(k, value));
    return sum > span;
  });
  double sag = 0.0;
  for (int k = 1; k <= n / 2; k++) sag += length / n * std::sin(angle(k, w_over_h));
  return sag;
}

// Catenary y = a cosh(x/a): L = 2 a sinh(D/2a), sag a (cosh(D/2a) - 1).
double sag_of_catenary(double length, double span)
{
  const double a = bisected(1e-3 * length, 100.0 * length, [&](double value) {
    return 2.0 * value * std::sinh(0.5 * span / value) > length;
  });
  return a * (std::cosh(0.5 * span / a) - 1.0);
}

TEST(FibreHinges, CatenaryOfAHungChain)
{
  constexpr double kLength = 0.16, kSpan = 0.1;
  std::vector<double> numbers, errors, sags;
  double worst = 0.0;
  for (const int n : {8, 16, 32}) {
    Fibre fibre;
    fibre.segments = n;
    fibre.radius = 0.0005;
    fibre.joint_distance = kLength / n;
    // Stretch by the weight: rho g L/(factor E).
    const double g = 10.0, stretch = 3e-6;
    fibre.stretch_factor = fibre.density * g * kLength / (stretch * fibre.youngs_modulus);
    Scene scene = fibre_scene(fibre);
    // An arc of the same span: chord 2 R sin(L/2R), by equal angles.
    const double half = bisected(0.01, pi, [&](double angle) {
      return std::sin(angle) / (n * std::sin(angle / n)) * kLength > kSpan;
    });
    scene.rods = rods_on_line(fibre, {0.0, 0.0, 0.0}, -half * (n - 1) / n, 2.0 * half / n);
    weigh_alike(fibre, scene.rods);
    const double frequency = 3.0 * std::sqrt(g / kLength);
    scene.physics =
        fibre_physics(fibre, "bend_factor 1e-9 damping_stretch 0.1 damping_shear 0.1") +
        fmt::format("group ends id 1 {}\nfix hold ends hinge/spherocylinder free\n", n) +
        fmt::format("fix weight all gravity {} vector 0 0 -1\n", g) +
        fmt::format("fix drag all viscous {}\n", 2.0 * fibre.segment_mass() * frequency);
    scene.dt = 0.4 * std::min(std::sqrt(fibre.segment_mass() / fibre.stretch_stiffness()),
                              std::sqrt(fibre.segment_mass() / (3.0 * fibre.shear_stiffness())));
    scene.steps = 2 * std::lround(12.0 / frequency / scene.dt);
    const std::vector<Rod> rods = run(scene).back().rods;
    const double sag = -tail_of(rods[n / 2]).z, exact = sag_of_links(n, kLength, kSpan);
    worst = std::max(worst, std::fabs(sag / exact - 1.0));
    numbers.push_back(n);
    sags.push_back(sag);
    errors.push_back(std::fabs(sag / sag_of_catenary(kLength, kSpan) - 1.0));
  }

  expect_holds({"Chain hung from two hinges, n = 8, 16, 32: sag, relative",
                "links at tan = (n/2 - k + 1/2) w/H", 1e-5},
               worst);
  expect_holds({"Hung chain: order in n, off -2", "catenary y = a cosh(x/a)", 0.1},
               std::fabs(order_of_convergence(numbers, errors) + 2.0));
  expect_holds(
      {"Hung chain, carried on to n = infinity: sag, relative", "catenary y = a cosh(x/a)", 1e-4},
      std::fabs((4.0 * sags[2] - sags[1]) / 3.0 / sag_of_catenary(kLength, kSpan) - 1.0));
}

// What thermo says in the last row.
std::vector<double> last_row(const Scene &scene, const std::string &commands, int ranks = 1)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.ends", preamble(scene) + "read_data rods.data\n" +
                              fmt::format("neighbor {} bin\nneigh_modify delay 0\n", scene.skin) +
                              scene.physics + fmt::format("timestep {:.17g}\n", scene.dt) +
                              commands);
  const Outcome outcome = folder.run("in.ends", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table table = read_thermo(outcome.output);
  EXPECT_FALSE(table.rows.empty()) << outcome.output;
  return table.rows.empty() ? std::vector<double>(8, spherocylinder::none) : table.rows.back();
}

std::string printed(const std::string &columns, long every)
{
  return fmt::format(
      "thermo_style custom step {}\nthermo {}\nthermo_modify format float %.15g norm "
      "no\n",
      columns, every);
}

// Hung from one end: the hinge bears the weight, and the end sinks by W/K.
TEST(FibreHinges, BearsTheWeight)
{
  Fibre fibre;
  fibre.segments = 5;
  Scene scene = fibre_scene(fibre);
  scene.rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
  const double g = 10.0, stiffness = 500.0;
  scene.physics = fibre_physics(fibre, "damping 0.3") +
                  fmt::format("group top id 1\nfix weight all gravity {} vector 0 0 -1\n"
                              "fix hold top hinge/spherocylinder free stiffness {} damping 0.5\n"
                              "fix drag all viscous {}\n",
                              g, stiffness, 0.3 * std::sqrt(stiffness * fibre.segment_mass()));
  const std::vector<double> row =
      last_row(scene, printed("f_hold[1] f_hold[2] f_hold[3] f_hold", 20000) + "run 20000\n", 2);
  const double weight = g * (5.0 * fibre.segment_mass() + 2.0 * fibre.cap_mass());
  expect_holds({"Fibre hung from a hinge: its force, relative", "weight", 1e-9},
               std::fabs(row[3] / weight - 1.0));
  expect_holds({"Fibre hung from a hinge: energy of the spring, relative", "W^2/2K", 1e-9},
               std::fabs(row[4] / (0.5 * weight * weight / stiffness) - 1.0));
}

// A rod that swings about its held end: 2 pi sqrt((I + m l^2)/(m g l)) at small angles; the hinge bears no moment.
TEST(FibreHinges, PendulumOfOneRod)
{
  Fibre fibre;
  fibre.segments = 1;
  Scene scene = fibre_scene(fibre);
  scene.rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
  const auto p = properties_of(scene.rods[0], 0);
  const double l = 0.5 * fibre.joint_distance, g = 10.0, swing = 1e-3;
  const double frequency = std::sqrt(p.mass * g * l / (p.inertia_transverse + p.mass * l * l));
  scene.rods[0].omega = {0.0, swing * frequency, 0.0};
  scene.rods[0].velocity = {-swing * frequency * l, 0.0, 0.0};
  // Sunk by its weight already.
  const double stiffness = 1e6 * p.mass * g / l;
  scene.physics = linear_material(1e3, 1e3, 0.5, 0.3) + rod_pair("linear tangential history") +
                  fmt::format("fix motion all nve/spherocylinder\n"
                              "fix weight all gravity {} vector 0 0 -1\n"
                              "fix hold all hinge/spherocylinder tail stiffness {:.17g}\n",
                              g, stiffness);
  const double period = 2.0 * pi / frequency;
  const long steps = 100000;
  scene.dt = 10.0 * period / steps;
  scene.steps = steps;
  scene.dump_every = 1000;
  const std::vector<Frame> frames = run(scene);
  double worst = 0.0;
  for (const Frame &frame : frames)
    worst = std::max(worst,
                     std::fabs(-frame.rods[0].axis.x / swing - std::sin(frequency * frame.time)));
  expect_holds({"Rod that swings on a hinge, 10 periods: angle over its largest",
                "2 pi sqrt((I + m l^2)/(m g l))", 1e-3},
               worst);
}

// Towed by a hinge that moves, against a drag on each segment: force N c v, and all move as fast.
TEST(FibreHinges, TowsAFibre)
{
  Fibre fibre;
  fibre.segments = 5;
  Scene scene = fibre_scene(fibre);
  const double drag = 2e-3, speed = 0.05;
  scene.physics = fibre_physics(fibre, "damping 0.3") +
                  fmt::format("group first id 1\nfix drag all viscous {}\n"
                              "fix tow first hinge/spherocylinder free velocity {} 0 0\n",
                              drag, -speed);
  const std::vector<double> row =
      last_row(scene,
               "compute slowest all reduce max vx\ncompute fastest all reduce min vx\n" +
                   printed("f_tow[1] c_slowest c_fastest", 60000) + "run 60000\n",
               2);
  expect_holds({"Fibre towed through a drag: force of the hinge, relative", "N c v", 1e-6},
               std::fabs(-row[1] / (5.0 * drag * speed) - 1.0));
  expect_holds({"Fibre towed: speeds, relative", "v", 1e-6},
               std::max(std::fabs(row[2] / speed + 1.0), std::fabs(row[3] / speed + 1.0)));
}

// Through a restart the ends are held where they were: the same bits, while the hinge moves too.
TEST(FibreHinges, RestartGoesOnWithTheSameBits)
{
  Fibre fibre;
  fibre.segments = 5;
  Scene scene = fibre_scene(fibre);
  scene.physics = fibre_physics(fibre, "damping 0.1") +
                  "group ends id 1 5\nfix weight all gravity 10 vector 0 0 -1\n"
                  "fix hold ends hinge/spherocylinder free velocity 0 0.1 0.02\n";
  const DeckFolder folder;
  const Snapshot last = expect_same_bits_from_half(folder, scene, kStateColumns);
  EXPECT_EQ(last.atoms.rows.size(), 5u);
}

// With the stiffness that a hinge has if none is said, the stable step is that of the fibre.
TEST(FibreHinges, LeavesTheTimeStep)
{
  std::vector<double> steps;
  for (const char *hinge : {"", "group ends id 1 9\nfix hold ends hinge/spherocylinder free\n"}) {
    Fibre fibre;
    Scene scene = fibre_scene(fibre);
    scene.physics = fibre_physics(fibre) + hinge;
    steps.push_back(last_row(scene, "fix step all check/timestep/spherocylinder 1 1.0\n" +
                                        printed("f_step[2]", 1) + "run 2\n")[1]);
  }
  EXPECT_EQ(steps[0], steps[1]);
}

// An end that is driven: the last segment of a fibre is turned about its axis by hand, the first is frozen, its
// rotation too. Closed form: T = GJ/L x angle, by the energy T^2 L/2GJ, in the limit of slow turning.
TEST(FibreEnds, TurnedByHand)
{
  Fibre fibre;
  fibre.segments = 5;
  Scene scene = fibre_scene(fibre);
  const long steps = 40000;
  const double angle = degrees(80.0);
  scene.physics =
      fibre_physics(fibre, "damping_twist 0.3 damping_bend 0.3") +
      "group clamp id 1\ngroup driven id 5\ngroup others subtract all driven\nunfix motion\n"
      "fix motion others nve/spherocylinder\nfix clamp clamp freeze\n" +
      fmt::format("fix turn driven move rotate 0 0 0 1 0 0 {:.17g}\n",
                  2.0 * pi / angle * steps * scene.dt);
  const std::vector<double> row =
      last_row(scene, "compute j all joint/spherocylinder/local torsion\n"
                      "compute most all reduce max c_j\ncompute least all reduce min c_j\n" +
                          printed("c_most c_least", steps) + fmt::format("run {}\n", steps));
  const double torque = fibre.twist_stiffness() * angle / 4.0;
  expect_holds(
      {"Fibre whose end is turned slowly by fix move: torque, relative", "GJ/L x angle", 2e-3},
      std::max(std::fabs(row[1] / torque - 1.0), std::fabs(row[2] / torque - 1.0)));
}

// A clamped fibre with a load P in its middle, whose last segment's centre fix setforce keeps on a line. Slow
// method: flexibilities f(a, b), how far rod a's centre sinks by a unit force on that of rod b, from the moments at
// all joints; the prop bears R = P f(n, m)/f(n, n).
TEST(FibreEnds, SlidesOnALine)
{
  Fibre fibre;
  const int n = fibre.segments - 1, m = n / 2;
  const double h = fibre.joint_distance, length = n * h;
  const auto flexibility = [&](int a, int b) {
    double sum = 0.0;
    for (int j = 1; j <= std::min(a, b); j++)
      sum += (a + 0.5 - j) * (b + 0.5 - j) * h * h / fibre.bend_stiffness() +
             1.0 / fibre.shear_stiffness();
    return sum;
  };
  const double load = 1e-4 * 3.0 * fibre.bending_rigidity() / (length * length);
  const double prop = load * flexibility(n, m) / flexibility(n, n);
  Scene scene = fibre_scene(fibre);
  scene.physics = fibre_physics(fibre, "damping 0.1") + kClampFirst +
                  fmt::format("group loaded id {}\ngroup last id {}\n"
                              "fix load loaded addforce 0 {:.17g} 0\n"
                              "fix slide last setforce NULL 0 NULL\n",
                              m + 1, n + 1, -load) +
                  drag_of(fibre, length);
  scene.steps = 2 * steps_to_rest(fibre, length);
  const std::vector<Rod> rods = run(scene).back().rods;
  const double wanted = load * flexibility(m, m) - prop * flexibility(m, n);
  expect_holds(
      {"Clamped fibre whose end slides on a line, load in its middle: deflection, relative",
       "P f(m, m) - R f(m, n)", 1e-6},
      std::fabs(-rods[m].position.y / wanted - 1.0));
  EXPECT_EQ(rods.back().position.y, 0.0);
}

// A ring of a fibre that is straight without load, twisted by Psi in all: how fast its second mode out of the plane
// grows (1/s), slowed by a drag.
double growth_rate(int n, double psi)
{
  constexpr double kRadius = 0.05;
  Fibre fibre;
  fibre.segments = n;
  fibre.radius = 0.0005;
  fibre.stretch_factor = 10.0;
  fibre.joint_distance = 2.0 * kRadius * std::sin(pi / n);
  Scene scene = fibre_scene(fibre);
  const double mode =
      2.7 * std::sqrt(fibre.bending_rigidity() / fibre.mass_per_length()) / (kRadius * kRadius);
  for (int k = 0; k < n; k++) {
    const double angle = 2.0 * pi * k / n;
    scene.rods[k].axis = {-std::sin(angle), std::cos(angle), 0.0};
    scene.rods[k].position =
        (kRadius * std::cos(pi / n)) * Vec3{std::cos(angle), std::sin(angle), 0.0};
    scene.rods[k].velocity = {0.0, 0.0, 1e-5 * kRadius * mode * std::cos(2.0 * angle)};
  }
  // Of a ring there are no hemispheres left over.
  scene.physics =
      fibre_physics(fibre, fmt::format("damping_twist 0.2 damping_stretch 0.1 damping_shear 0.1 "
                                       "rest_twist {:.17g}",
                                       -psi / (n * fibre.joint_distance))) +
      fmt::format("fix drag all viscous {:.17g}\n", 2.0 * fibre.segment_mass() * mode);
  const long steps = std::lround(40.0 / mode / scene.dt);
  scene.steps = 2 * (steps / 2);
  scene.dump_every = scene.steps / 2;
  const std::vector<Frame> frames = run(scene);
  const auto amplitude = [&](const Frame &frame) {
    double c = 0.0, s = 0.0;
    for (int k = 0; k < n; k++) {
      const double angle = 2.0 * pi * k / n, z = frame.rods[k].position.z;
      c += z * std::cos(2.0 * angle);
      s += z * std::sin(2.0 * angle);
    }
    return std::hypot(c, s);
  };
  if (frames.size() < 3) return spherocylinder::none;
  return std::log(amplitude(frames[2]) / amplitude(frames[1])) / (frames[2].time - frames[1].time);
}

// Michell's threshold Psi = 2 pi sqrt(3) EI/GJ, by where the rate of growth is zero, approached as n^-2.
TEST(FibreRing, MichellsThreshold)
{
  const double michell = 2.0 * pi * std::sqrt(3.0) * 1.3;
  EXPECT_LT(growth_rate(24, 0.9 * michell), 0.0);
  EXPECT_GT(growth_rate(24, 1.1 * michell), 0.0);
  std::vector<double> numbers, errors, thresholds;
  for (const int n : {16, 24, 48}) {
    double low = 0.97 * michell, high = 1.03 * michell, at = low;
    for (const double half : {0.03, 0.003}) {
      const double below = growth_rate(n, low), above = growth_rate(n, high);
      at = low - below * (high - low) / (above - below);
      low = at * (1.0 - 0.1 * half);
      high = at * (1.0 + 0.1 * half);
    }
    numbers.push_back(n);
    thresholds.push_back(at);
    errors.push_back(std::fabs(at / michell - 1.0));
  }
  expect_holds({"Twisted ring, n = 16, 24, 48: threshold, order in n, off -2",
                "2 pi sqrt(3) EI/GJ (Michell)", 0.1},
               std::fabs(order_of_convergence(numbers, errors) + 2.0));
  expect_holds({"Twisted ring: threshold, carried on to n = infinity, relative",
                "2 pi sqrt(3) EI/GJ (Michell)", 2e-3},
               std::fabs((4.0 * thresholds[2] - thresholds[1]) / 3.0 / michell - 1.0));
}

}  // namespace
