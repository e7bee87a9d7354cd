// SPDX-License-Identifier: GPL-2.0-or-later
// Fibres that move: what is conserved, on any number of ranks, across periodic boundaries, restarts, data
// files and deleted segments; what they weigh, touch and how long a step may be.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "convergence.h"
#include "core/mass_properties.h"
#include "core/numbers.h"
#include "fibres.h"
#include "run_mode.h"

using namespace decks;
using spherocylinder::pi;

namespace {

class FibreMotion : public RunMode {};

// Conserved whatever the joints do, damped too.
TEST_P(FibreMotion, FreeFlight)
{
  Fibre fibre;
  Scene scene = fibre_scene(fibre);
  for (Rod &rod : scene.rods) rod.position.x -= 0.08;
  shake(scene.rods, 0.3, 10.0, 15485863);
  scene.physics = fibre_physics(fibre, "damping 0.05");
  scene.steps = 10000;
  scene.dump_every = 1000;
  const Totals start = totals_of(scene.rods);
  double momentum = 0.0, angular_momentum = 0.0;
  for (const Frame &frame : run(scene, GetParam())) {
    const Totals now = totals_of(frame.rods);
    momentum = std::max(momentum, norm(now.momentum - start.momentum) / norm(start.momentum));
    angular_momentum =
        std::max(angular_momentum, norm(now.angular_momentum - start.angular_momentum) /
                                       norm(start.angular_momentum));
  }
  expect_holds({"Fibre in free flight, 10^4 steps: momentum, relative", "conserved", 1e-12},
               momentum);
  expect_holds({"Fibre in free flight: angular momentum, relative", "conserved", 1e-12},
               angular_momentum);
}

DECKS_IN_ALL_MODES(FibreMotion);

// The largest change of kinetic and joint energy, undamped.
double energy_error(double dt, double time)
{
  Fibre fibre;
  fibre.segments = 6;
  Scene scene = fibre_scene(fibre);
  shake(scene.rods, 0.1, 5.0, 32452843);
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.free", preamble(scene) + "read_data rods.data\nneighbor 0.002 bin\n" +
                              fibre_physics(fibre) +
                              "compute spin all erotate/spherocylinder\n"
                              "thermo_style custom step ke c_spin f_joints\nthermo_modify norm no\n"
                              "thermo_modify format float %.15g\nthermo 1\n" +
                              fmt::format("timestep {}\nrun {}\n", dt, std::lround(time / dt)));
  const Outcome outcome = folder.run("in.free");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table table = read_thermo(outcome.output);
  double worst = 0.0;
  const auto total = [&](size_t row) {
    return table.rows[row][1] + table.rows[row][2] + table.rows[row][3];
  };
  for (size_t row = 0; row < table.rows.size(); row++)
    worst = std::max(worst, std::fabs(total(row) / total(0) - 1.0));
  return worst;
}

TEST(FibreEnergy, IsOfSecondOrderInTheStep)
{
  const double step = Fibre().time_step() / 4.0;
  const double coarse = energy_error(step, 0.01), fine = energy_error(0.5 * step, 0.01);
  expect_holds({"Fibre in free flight: energy, order in dt, off 2", "second order", 0.1},
               std::fabs(std::log2(coarse / fine) - 2.0));
  expect_holds(
      {"Fibre in free flight, dt 0.05 of the stable one: energy, relative", "conserved", 2e-3},
      fine);
}

TEST(FibreRanks, OneTwoAndFourAgree)
{
  const Scene scene = tangle();
  const std::vector<Frame> one = run(scene);
  double contacts = 0.0;
  for (const Frame &frame : one)
    for (const double of_rod : frame.contacts) contacts += of_rod;
  EXPECT_GT(contacts, 10.0) << "fibres must touch";
  expect_holds({"24 fibres longer than subdomains, 1 and 2 ranks, 1000 steps: place (m), axis",
                "same scene", 1e-10},
               difference_in_period(scene, one, run(scene, Mode::TwoRanks)));
  expect_holds({"24 fibres longer than subdomains, 1 and 4 ranks, 1000 steps: place (m), axis",
                "same scene", 1e-10},
               difference_in_period(scene, one, run(scene, Mode::FourRanks)));
}

// Cuts that move with the rods send segments from rank to rank.
TEST(FibreRanks, CutsThatMove)
{
  Scene scene = tangle();
  const std::vector<Frame> one = run(scene);
  scene.physics += "fix even all balance 100 1.05 shift xy 10 1.02\n";
  expect_holds({"24 fibres, 4 ranks, cuts that move: place (m), axis", "same scene", 1e-10},
               difference_in_period(scene, one, run(scene, Mode::FourRanks)));
}

// A joint has no history: to the last bit, on two ranks. Both go on from a new run.
TEST(FibreRestart, GoesOnWithTheSameBits)
{
  const Scene scene = tangle();
  const DeckFolder folder;
  expect_same_bits_from_half(folder, scene, kStateColumns);

  // Without the fix the fibres of the file would fall apart.
  std::string without = scene.physics;
  without.erase(without.find("fix joints"),
                without.find("fix motion") - without.find("fix joints"));
  folder.write("in.without", preamble(scene, Mode::TwoRanks) +
                                 "read_restart half\nneighbor 0.002 bin\n" + without + "run 1\n");
  const Outcome outcome = folder.run("in.without", {Program::Lmp, 2});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("the restart file has fibres, but no fix holds them together"),
            std::string::npos)
      << outcome.output;
}

// The same fibre in the middle and across a boundary.
TEST(FibrePeriodic, AcrossABoundary)
{
  Fibre fibre;
  fibre.segments = 5;
  Scene middle = fibre_scene(fibre);
  middle.boundary = "p p p";
  for (Rod &rod : middle.rods) rod.position.x -= 0.04;
  shake(middle.rods, 0.3, 10.0, 86028121);
  middle.steps = 2000;
  middle.dump_every = 500;
  Scene across = middle;
  for (Rod &rod : across.rods) {
    rod.position.x += 0.49;
    if (rod.position.x >= 0.5) rod.position.x -= 1.0;
  }
  std::vector<Frame> wanted = run(middle);
  for (Frame &frame : wanted)
    for (Rod &rod : frame.rods) rod.position.x += 0.49;
  expect_holds(
      {"Fibre across a periodic boundary, 2000 steps: place (m), axis", "same fibre", 1e-10},
      difference_in_period(middle, wanted, run(across)));
  expect_holds(
      {"Fibre across a periodic boundary, two ranks: place (m), axis", "same fibre", 1e-10},
      difference_in_period(middle, wanted, run(across, Mode::TwoRanks)));
}

// What thermo says at step 0 and after a few steps.
struct Numbers {
  Table thermo;
  std::string output;
};

Numbers numbers_of(const Scene &scene, const std::string &thermo, const std::string &after = "",
                   long steps = 2, int ranks = 1)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.numbers", preamble(scene) + "read_data rods.data\n" +
                                 fmt::format("neighbor {} bin\n", scene.skin) + scene.physics +
                                 "compute mass all property/atom mass\n"
                                 "compute weight all reduce sum c_mass\n" +
                                 after +
                                 fmt::format("timestep {}\nthermo_style custom step {}\nthermo 1\n",
                                             scene.dt, thermo) +
                                 fmt::format("thermo_modify format float %.15g\nrun {}\n", steps));
  const Outcome outcome = folder.run("in.numbers", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  return {outcome.exit_code == 0 ? read_thermo(outcome.output) : Table{}, outcome.output};
}

std::vector<Rod> ring_of(const Fibre &fibre)
{
  std::vector<Rod> rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  Vec3 end = {-0.05, -0.1, 0.0};
  for (int k = 0; k < fibre.segments; k++) {
    const double angle = 2.0 * pi * k / fibre.segments;
    rods[k].axis = {std::cos(angle), std::sin(angle), 0.0};
    rods[k].position = end + (0.5 * fibre.joint_distance) * rods[k].axis;
    end = end + fibre.joint_distance * rods[k].axis;
  }
  return rods;
}

// Closed form: rho (pi r^2 L + 4/3 pi r^3), L the whole axis; the masses of single capsules would make
// 17 % more at h = 8 r and 67 % at h = 2 r. A ring has no ends.
TEST(FibreMass, SharedHemispheresCountOnce)
{
  double worst = 0.0;
  for (const double h : {16.0, 8.0, 2.0})
    for (const bool is_ring : {false, true}) {
      Fibre fibre;
      fibre.segments = 12;
      fibre.joint_distance = h * fibre.radius;
      Scene scene = fibre_scene(fibre);
      if (is_ring) scene.rods = ring_of(fibre);
      const double r = fibre.radius, length = fibre.segments * fibre.joint_distance;
      const double wanted =
          fibre.density * (pi * r * r * length + (is_ring ? 0.0 : 4.0 / 3.0 * pi * r * r * r));
      const Table thermo = numbers_of(scene, "c_weight f_joints[5]", "", 0, is_ring ? 2 : 1).thermo;
      ASSERT_FALSE(thermo.rows.empty());
      worst = std::max(worst, std::fabs(thermo.rows[0][1] / wanted - 1.0));
      EXPECT_EQ(thermo.rows[0][2], is_ring ? 12 : 11);
      const Table half = numbers_of(scene, "c_weight", "set group all density 500\n", 0).thermo;
      ASSERT_FALSE(half.rows.empty());
      worst = std::max(worst, std::fabs(2.0 * half.rows[0][1] / wanted - 1.0));
    }
  expect_holds(
      {"Mass of fibres and rings, h/r 16, 8, 2, relative", "rho (pi r^2 L + 4/3 pi r^3)", 1e-13},
      worst);
}

// A ring that is straight without load, flat: bending energy K/2 (2 pi/N)^2 N, closed form; no net force.
TEST(FibreRing, BendingEnergy)
{
  Fibre fibre;
  fibre.segments = 12;
  Scene scene = fibre_scene(fibre);
  scene.rods = ring_of(fibre);
  const Table thermo = numbers_of(scene, "f_joints[3] f_joints[4] f_joints[1]", "", 0).thermo;
  ASSERT_FALSE(thermo.rows.empty());
  const double angle = 2.0 * pi / fibre.segments;
  const double energy = 0.5 * fibre.segments * fibre.bend_stiffness() * angle * angle;
  expect_holds({"Ring of 12 segments: bending energy, relative", "N K/2 (2 pi/N)^2", 1e-12},
               std::fabs(thermo.rows[0][1] / energy - 1.0));
  EXPECT_LT(thermo.rows[0][2] + thermo.rows[0][3], 1e-20);
}

// Of rest curvature 1/R the same ring has no energy, nor a chain that is read as it is without load.
TEST(FibreRest, CurvedFibresWithoutLoad)
{
  Fibre fibre;
  fibre.segments = 12;
  Scene scene = fibre_scene(fibre);
  scene.rods = ring_of(fibre);
  scene.rods.pop_back();
  scene.physics = fibre_physics(fibre, "rest present");
  const Table as_read = numbers_of(scene, "f_joints", "", 0).thermo;
  ASSERT_FALSE(as_read.rows.empty());
  EXPECT_LT(as_read.rows[0][1], 1e-25);

  // Straight, but bent without load by kappa h at each joint: energy of the bend that is missing.
  scene = fibre_scene(fibre);
  const double curvature = 5.0, twist = 3.0;
  scene.physics =
      fibre_physics(fibre, fmt::format("rest_curvature {} rest_twist {}", curvature, twist));
  const Table bent = numbers_of(scene, "f_joints[3] f_joints[4]", "", 0).thermo;
  ASSERT_FALSE(bent.rows.empty());
  const double h = fibre.joint_distance, joints = fibre.segments - 1;
  expect_holds(
      {"Straight fibre with rest curvature: energy, relative", "EI kappa^2 (N-1) h/2", 1e-12},
      std::fabs(bent.rows[0][1] /
                    (0.5 * joints * fibre.bend_stiffness() * std::pow(curvature * h, 2)) -
                1.0));
  expect_holds({"Straight fibre with rest twist: energy, relative", "GJ tau^2 (N-1) h/2", 1e-12},
               std::fabs(bent.rows[0][2] /
                             (0.5 * joints * fibre.twist_stiffness() * std::pow(twist * h, 2)) -
                         1.0));
}

std::vector<double> contacts_of(const std::vector<Rod> &rods, const Fibre &fibre)
{
  Scene scene = fibre_scene(fibre);
  scene.rods = rods;
  scene.physics = fibre_physics(fibre, "rest present");
  scene.steps = 2;
  return run(scene).front().contacts;
}

TEST(FibreContacts, NeighboursDoNotTouch)
{
  Fibre fibre;
  fibre.segments = 8;
  std::vector<Rod> rods = ring_of(fibre);
  for (const double n : contacts_of(rods, fibre)) EXPECT_EQ(n, 0.0) << "a ring";
  rods.pop_back();
  for (const double n : contacts_of(rods, fibre)) EXPECT_EQ(n, 0.0) << "bent by 45 degrees";
  // Next but one: 1.5 r apart when straight; a ring of them too.
  fibre.joint_distance = 1.5 * fibre.radius;
  fibre.segments = 16;
  for (const double n : contacts_of(straight_rods(fibre, {0, 0, 0}, {0, 0, 1}), fibre))
    EXPECT_EQ(n, 0.0) << "short segments";
  for (const double n : contacts_of(ring_of(fibre), fibre))
    EXPECT_EQ(n, 0.0) << "a ring of short segments";
}

// Rods that overlap at their ends in one run and are joined before the next: their contacts are gone.
TEST(FibreContacts, JoinedBetweenRuns)
{
  Fibre fibre;
  fibre.segments = 5;
  Scene scene = fibre_scene(fibre);
  const std::string joints =
      scene.physics.substr(scene.physics.find("fix joints"),
                           scene.physics.find("fix motion") - scene.physics.find("fix joints"));
  scene.physics.erase(scene.physics.find("fix joints"), joints.size());
  const std::string count = "compute touch all contact/spherocylinder\n"
                            "compute touching all reduce sum c_touch\n";
  const Table apart = numbers_of(scene, "c_touching", count, 0).thermo;
  const Table joined = numbers_of(scene, "c_touching", count + "run 0\n" + joints, 0).thermo;
  ASSERT_FALSE(apart.rows.empty() || joined.rows.empty());
  EXPECT_EQ(apart.rows.back()[1], 8.0);
  EXPECT_EQ(joined.rows.back()[1], 0.0);
}

// Closed form: the fibre's own volume below the surface, times what a cubic metre of water weighs. Lying: all
// of it, half of it; standing, the surface midway in the third segment.
TEST(FibreBuoyancy, DisplacesItsOwnVolume)
{
  Fibre fibre;
  fibre.segments = 5;
  const double r = fibre.radius, h = fibre.joint_distance, area = pi * r * r;
  const double ends = 4.0 / 3.0 * pi * r * r * r, whole = 5.0 * h * area + ends;
  const struct {
    Vec3 axis;
    double level, volume;
  } cases[] = {{{1.0, 0.0, 0.0}, 0.2, whole},
               {{1.0, 0.0, 0.0}, 0.1, 0.5 * whole},
               {{0.0, 0.0, 1.0}, 0.1 + 2.0 * h, 2.5 * h * area + 0.5 * ends}};
  double worst = 0.0;
  for (const auto &wanted : cases) {
    Scene scene = fibre_scene(fibre);
    scene.rods = straight_rods(fibre, {0.0, 0.0, 0.1}, wanted.axis);
    const Table thermo =
        numbers_of(scene, "f_water[3]",
                   fmt::format("fix g all gravity 9.81 vector 0 0 -1\n"
                               "fix water all buoyancy level {:.17g} density 1000 dim z\n",
                               wanted.level),
                   0)
            .thermo;
    ASSERT_FALSE(thermo.rows.empty());
    worst = std::max(worst, std::fabs(thermo.rows[0][1] / (9810.0 * wanted.volume) - 1.0));
  }
  expect_holds(
      {"Fibre in water, lying and standing: lift, relative", "rho g V below the surface", 1e-8},
      worst);
}

// Two rods that lie beside each other touch all the same, and so does a fibre that comes back to itself:
// along x, up, back, and down on the first again.
TEST(FibreContacts, OthersDo)
{
  Fibre fibre;
  const double r = fibre.radius;
  const auto rod = [&](const Vec3 &from, const Vec3 &to) {
    Rod made = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0})[0];
    made.position = 0.5 * (from + to);
    made.axis = normalized(to - from);
    made.length = norm(to - from) + 2.0 * r;
    return made;
  };
  const Vec3 a = {0.0, 0.0, 0.0}, b = {20 * r, 0.0, 0.0}, c = {20 * r, 3.0 * r, 0.0},
             d = {10 * r, 3.0 * r, 0.0}, e = {10 * r, 1.9 * r, 0.0};
  const std::vector<Rod> rods = {rod(a, b), rod(b, c), rod(c, d), rod(d, e),
                                 rod({0.0, -1.9 * r, 0.0}, {5 * r, -1.9 * r, 0.0})};
  EXPECT_EQ(contacts_of(rods, fibre), (std::vector<double>{2.0, 0.0, 0.0, 1.0, 1.0}));
}

// Closed form of a long chain, thin or thick: the least of 2/omega of stretch 4 K/m, shear 4 K (h/2)^2/I_t,
// bending 4 K/I_t and twist 4 K/I_a; with soft stretch another one is the least.
TEST(FibreTimeStep, IsTheLeastOfFour)
{
  double worst = 0.0;
  for (const double h : {16.0, 8.0, 2.0})
    for (const double soft : {1.0, 0.1, 1e-3}) {
      Fibre fibre;
      fibre.joint_distance = h * fibre.radius;
      fibre.stretch_factor = soft;
      const Scene scene = fibre_scene(fibre);
      const auto p = properties_of(scene.rods[1], 2);
      const double arm = 0.5 * fibre.joint_distance;
      const double squared =
          4.0 * std::max({fibre.stretch_stiffness() / p.mass,
                          fibre.shear_stiffness() * arm * arm / p.inertia_transverse,
                          fibre.bend_stiffness() / p.inertia_transverse,
                          fibre.twist_stiffness() / p.inertia_axial});
      const Table thermo =
          numbers_of(scene, "f_step[2]", "fix step all check/timestep/spherocylinder 1 1.0\n")
              .thermo;
      ASSERT_EQ(thermo.rows.size(), 3u);
      worst = std::max(worst, std::fabs(thermo.rows.back()[1] * std::sqrt(squared) / 2.0 - 1.0));
    }
  expect_holds({"Stable step of fibres, h/r 16, 8, 2, stretch 1, 0.1, 0.001, relative",
                "least of stretch, shear, bend, twist", 1e-12},
               worst);
}

// Below the step that is told the energy stays, with dampers too; above it by a tenth it does not.
TEST(FibreTimeStep, IsWhereAFibreStandsOrNot)
{
  const std::string check = "fix step all check/timestep/spherocylinder 1 1.0 warn no\n"
                            "compute spin all erotate/spherocylinder\n";
  for (const double soft : {1.0, 1e-3})
    for (const double damping : {0.0, 0.5}) {
      Fibre fibre;
      fibre.segments = 30;
      fibre.joint_distance = 0.01;
      fibre.stretch_factor = soft;
      Scene scene = fibre_scene(fibre);
      for (Rod &rod : scene.rods) rod.position.x -= 0.15;
      shake(scene.rods, 1e-6, 1e-4, 67867967);
      scene.physics = fibre_physics(fibre, fmt::format("damping {}", damping));
      const Table first = numbers_of(scene, "f_step[2]", check).thermo;
      ASSERT_EQ(first.rows.size(), 3u);
      const double stable = first.rows.back()[1];
      scene.dt = 0.97 * stable;
      const Table below = numbers_of(scene, "ke c_spin", check, 3000).thermo;
      ASSERT_FALSE(below.rows.empty());
      const auto energy = [](const std::vector<double> &row) { return row[1] + row[2]; };
      EXPECT_LT(energy(below.rows.back()), 100.0 * energy(below.rows.front()))
          << soft << ' ' << damping;
      if (damping > 0.0) continue;
      scene.dt = 1.1 * stable;
      const Table above = numbers_of(scene, "ke c_spin", check, 20).thermo;
      ASSERT_FALSE(above.rows.empty());
      EXPECT_GT(energy(above.rows.back()), 1e6 * energy(above.rows.front())) << soft;
    }
}

// The middle segment goes: two fibres of half the joints, whatever the ids are then.
TEST(FibreDeletion, CutsAFibreInTwo)
{
  Fibre fibre;
  fibre.segments = 7;
  Scene scene = fibre_scene(fibre);
  shake(scene.rods, 0.01, 1.0, 15485863);
  std::vector<std::vector<double>> ends;
  for (const char *compress : {"yes", "no"}) {
    const Numbers numbers = numbers_of(
        scene, "c_weight f_joints f_joints[5] ke",
        fmt::format("timestep {}\nrun 10\ngroup gone id 4\ndelete_atoms group gone compress {}\n",
                    scene.dt, compress),
        200, 2);
    ASSERT_FALSE(numbers.thermo.rows.empty()) << numbers.output;
    ends.push_back(numbers.thermo.rows.back());
    EXPECT_EQ(ends.back()[3], 4.0);
    EXPECT_NEAR(ends.back()[1], 6.0 * fibre.segment_mass() + 2.0 * fibre.cap_mass(), 1e-15);
    EXPECT_NE(numbers.output.find("2 ends of fibres are free"), std::string::npos);
  }
  for (size_t k = 1; k < ends[0].size(); k++) EXPECT_NEAR(ends[0][k] / ends[1][k], 1.0, 1e-9) << k;
}

// Bent, twisted and moving, through a data file and back: all that is dumped. Without friction, whose
// springs are not part of a data file.
double change_by_a_data_file(const std::string &keywords)
{
  Scene scene = tangle(keywords);
  scene.physics =
      linear_material(1e3, 1e3, 0.5, 0.0) + scene.physics.substr(scene.physics.find("pair_style"));
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  const std::string columns =
      "id x y z vx vy vz quat1 quat2 quat3 quat4 omegax omegay omegaz mass inertiax fx fy fz tqx tqy "
      "tqz f_fibres[1] f_fibres[2] f_fibres[3] f_fibres[4] f_fibres[5] f_fibres[6]";
  const std::string settings =
      "neighbor 0.002 bin\n" + scene.physics + fmt::format("timestep {}\n", scene.dt);
  folder.write("in.first", preamble(scene) + "read_data rods.data\n" + settings +
                               "run 300\nwrite_data middle.data\n" +
                               exact_dump("dump.on", 1, columns) + "run 0\n");
  folder.write("in.second", preamble(scene, Mode::TwoRanks) + "read_data middle.data\n" + settings +
                                exact_dump("dump.read", 1, columns) + "run 0\n");
  Outcome outcome = folder.run("in.first");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return spherocylinder::none;
  outcome = folder.run("in.second", {Program::Lmp, 2});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return spherocylinder::none;
  const Table on = read_dump(folder / "dump.on").back().atoms;
  const Table read = read_dump(folder / "dump.read").back().atoms;
  EXPECT_EQ(on.rows.size(), read.rows.size());
  double worst = 0.0;
  for (size_t row = 0; row < on.rows.size(); row++)
    for (size_t k = 0; k < on.columns.size(); k++) {
      const double scale = std::max(std::fabs(on.rows[row][k]), 1e-3);
      worst = std::max(worst, std::fabs(read.rows[row][k] - on.rows[row][k]) / scale);
    }
  return worst;
}

TEST(FibreDataFile, ReadsBackWhatWasWritten)
{
  expect_holds({"Fibres, write_data, read_data: state and loads", "same values", 1e-9},
               change_by_a_data_file("rest_curvature 3 rest_twist 2"));
  expect_holds(
      {"Fibres that have yielded and broken, write_data, read_data: state and loads", "same values",
       1e-9},
      change_by_a_data_file("yield_stress 7e4 bending_strength 1.1e5 tensile_strength 1.1e5"));
}

// Columns as typed, rods any way round and in any order: joined by place, tails and heads found.
TEST(FibreDataFile, PlacesMakeChains)
{
  Fibre fibre;
  fibre.segments = 4;
  Scene scene = fibre_scene(fibre);
  scene.rods[1].axis = {-1.0, 0.0, 0.0};
  std::swap(scene.rods[0], scene.rods[3]);
  const DeckFolder folder;
  std::string data = data_file(scene);
  data.replace(data.find("1 atom types"), 0, "4 segments\n");
  folder.write("rods.data", data + "\nFibres\n\n4 7 1\n3 7 3\n2 7 2\n1 7 4   # the last\n");
  folder.write("in.read",
               preamble(scene) + "read_data rods.data\nneighbor 0.002 bin\n" +
                   linear_material(1e3, 1e3, 0.5, 0.3) + rod_pair("linear tangential history") +
                   "fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3\n"
                   "fix motion all nve/spherocylinder\n"
                   "thermo_style custom step f_joints[5] f_joints\nrun 1\n");
  const Outcome outcome = folder.run("in.read");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  EXPECT_EQ(thermo.rows[0][1], 3.0);
  EXPECT_LT(thermo.rows[0][2], 1e-20);
}

// Two segments pulled apart by 0.1 mm: each feels K_stretch times that, and the virial is force times the
// distance of their centres, closed form. Two ranks share it.
TEST(FibreVirial, IsForceTimesDistance)
{
  Fibre fibre;
  fibre.segments = 2;
  Scene scene = fibre_scene(fibre);
  scene.boundary = "p p p";
  scene.rods[0].position.x = -0.01;
  scene.rods[1].position.x = 0.01;
  const double gap = 1e-4;
  for (const int ranks : {1, 2}) {
    const Table thermo =
        numbers_of(scene, "c_press[1] c_press[2] c_press[4]",
                   fmt::format("set atom 2 x {}\ncompute press all pressure thermo_temp virial\n",
                               0.01 + gap),
                   0, ranks)
            .thermo;
    ASSERT_FALSE(thermo.rows.empty());
    const double force = fibre.stretch_stiffness() * gap;
    expect_holds({"Two segments pulled apart: pressure, relative", "-F x distance/volume", 1e-9},
                 std::fabs(thermo.rows[0][1] / (-force * (fibre.joint_distance + gap)) - 1.0));
    EXPECT_LT(std::fabs(thermo.rows[0][2]) + std::fabs(thermo.rows[0][3]), 1e-12);
  }
}

// A chain so stiff that it is one rod: an elastic hit on its end, closed form J = 2 v m_eff of the whole,
// 1/m_eff = 1/m + b^2/I; the contact lasts for ten periods of the bending.
TEST(FibreRigid, MovesLikeOneRod)
{
  Fibre fibre;
  fibre.segments = 5;
  fibre.youngs_modulus = 1e12;
  Scene scene = fibre_scene(fibre);
  const double tilt = degrees(35.0);
  const Vec3 axis = {std::cos(tilt), 0.0, std::sin(tilt)};
  const double r = fibre.radius, reach = 0.5 * fibre.joint_distance * fibre.segments;
  scene.rods = straight_rods(fibre, {0.0, 0.0, 0.0}, axis);
  const Vec3 middle = scene.rods[2].position;
  for (Rod &rod : scene.rods) {
    rod.position = rod.position - middle + Vec3{0.0, 0.0, reach * std::sin(tilt) + r + 1e-5};
    rod.velocity = {0.0, 0.0, -0.1};
  }
  scene.physics =
      linear_material(1e3, 1e3, 1.0, 0.0) + rod_pair("linear") +
      rod_wall("floor", "linear", "type 1 zplane 0.0") +
      fmt::format("fix joints all joint/spherocylinder youngsModulus {} poissonsRatio 0.3 "
                  "join 1e-6\nfix motion all nve/spherocylinder\n",
                  fibre.youngs_modulus);
  scene.steps = std::lround(4e-3 / scene.dt);
  const std::vector<Rod> after = run(scene).back().rods;
  double mass = 0.0, inertia = 0.0, speed = 0.0;
  for (int k = 0; k < 5; k++) {
    const auto p = properties_of(after[k], shared_ends(k, 5));
    const double x = (k - 2) * fibre.joint_distance;
    mass += p.mass;
    inertia += p.inertia_transverse + p.mass * x * x;
    speed += p.mass * after[k].velocity.z;
  }
  const double arm = reach * std::cos(tilt);
  const double impulse = 0.2 / (1.0 / mass + arm * arm / inertia);
  expect_holds(
      {"Stiff fibre hits a floor with its end: impulse, relative", "2 v/(1/m + b^2/I)", 5e-3},
      std::fabs((speed / mass + 0.1) * mass / impulse - 1.0));
}

// Joints are added in their order whatever threads do.
TEST(FibreThreads, SameBits)
{
  const Scene scene = tangle();
  std::vector<std::vector<Frame>> runs;
  for (const int threads : {1, 3}) {
    Scene with = scene;
    with.steps = 200;
    const std::string pair = "surface spherocylinder";
    with.physics.replace(with.physics.find(pair), pair.size(),
                         fmt::format("{} threads {}", pair, threads));
    runs.push_back(run(with));
  }
  EXPECT_EQ(largest_difference(runs[0], runs[1]), 0.0);
}

}  // namespace
