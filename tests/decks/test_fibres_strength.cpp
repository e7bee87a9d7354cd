// SPDX-License-Identifier: GPL-2.0-or-later
// Fibres that are bent for good or break, and what is said of each joint: compute joint/spherocylinder/local.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "core/numbers.h"
#include "fibres.h"

using namespace decks;
using spherocylinder::pi;

namespace {

// What a deck prints; `commands` after the rods and the scene's physics.
Table thermo_of(const Scene &scene, const std::string &commands, const std::string &columns,
                int ranks = 1, std::string *output = nullptr)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write(
      "in.fibres",
      preamble(scene) + "read_data rods.data\n" +
          fmt::format("neighbor {} bin\nneigh_modify delay 0\n", scene.skin) + scene.physics +
          "compute spin all erotate/spherocylinder\n" +
          "compute joint all joint/spherocylinder/local bending rest_curvature\n"
          "compute bending all reduce sum c_joint[1]\n"
          "compute rest all reduce sum c_joint[2]\n" +
          fmt::format("timestep {}\nthermo_style custom step {}\nthermo 1\n", scene.dt, columns) +
          "thermo_modify format float %.15g norm no\n" + commands);
  const Outcome outcome = folder.run("in.fibres", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (output) *output = outcome.output;
  return outcome.exit_code == 0 ? read_thermo(outcome.output) : Table{};
}

// Two segments whose joint is bent by hand: the first is frozen, the second is turned about the joint, by
// `step` (rad) in each of `steps` steps.
std::string turned(double step, int steps, double dt)
{
  return fmt::format("fix turn second move rotate 0.01 0 0 0 0 {} {:.17g}\nrun {}\nunfix turn\n",
                     step > 0.0 ? 1 : -1, 2.0 * pi * dt / std::fabs(step), steps);
}

Scene two_segments(const Fibre &fibre, const std::string &keywords)
{
  Scene scene = fibre_scene(fibre);
  scene.physics = fibre_physics(fibre, keywords) +
                  "group first id 1\ngroup second id 2\nunfix motion\nfix hold first freeze\n";
  return scene;
}

double yield_stress_for(const Fibre &fibre, double angle)
{
  return fibre.bend_stiffness() * angle / (4.0 / 3.0 * std::pow(fibre.radius, 3));
}

// Closed form: the rest bend follows the bend at the distance of the yield angle, and stays otherwise (play); the
// moment is K times the distance, at most (4/3) sigma_0 r^3; each turn of the rest bend takes the moment at
// yield times its angle.
TEST(FibreYield, CycleOfOneJoint)
{
  Fibre fibre;
  fibre.segments = 2;
  const double yield = 0.1, step = 0.003;
  const double stress = yield_stress_for(fibre, yield);
  const Scene scene = two_segments(fibre, fmt::format("yield_stress {:.17g}", stress));
  const double moment_at_yield = 4.0 / 3.0 * stress * std::pow(fibre.radius, 3);
  const double h = fibre.joint_distance;
  const std::string columns = "c_bending c_rest f_joints[6] f_joints[3]";
  double angle = 0.0, rest = 0.0, work = 0.0, worst[4] = {0.0, 0.0, 0.0, 0.0}, highest = 0.0;
  std::string commands;
  for (const auto &[size, steps] : {std::pair(step, 100), {-step, 200}, {step, 233}}) {
    const Table table = thermo_of(scene, commands + turned(size, steps, scene.dt), columns);
    commands += turned(size, steps, scene.dt);
    ASSERT_EQ(table.rows.size(), steps + 1u);
    for (size_t row = 1; row < table.rows.size(); row++) {
      angle += size;
      const double before = rest;
      rest = std::clamp(rest, angle - yield, angle + yield);
      work += moment_at_yield * std::fabs(rest - before);
      const double moment = fibre.bend_stiffness() * std::fabs(angle - rest);
      const std::vector<double> &seen = table.rows[row];
      highest = std::max(highest, seen[1]);
      worst[0] = std::max(worst[0], std::fabs(seen[1] - moment) / moment_at_yield);
      worst[1] = std::max(worst[1], std::fabs(seen[2] * h - std::fabs(rest)));
      worst[2] = std::max(worst[2], std::fabs(seen[3] - work) / moment_at_yield);
      worst[3] = std::max(worst[3], std::fabs(seen[4] - 0.5 * moment * std::fabs(angle - rest)) /
                                        moment_at_yield);
    }
  }
  expect_holds({"Plastic hinge: highest moment, relative", "(4/3) sigma_0 r^3", 1e-11},
               std::fabs(highest / moment_at_yield - 1.0));
  expect_holds(
      {"Plastic cycle of a joint: moment over that at yield", "play of the rest bend", 1e-9},
      worst[0]);
  expect_holds({"Plastic cycle: bend that is left (rad)", "play of the rest bend", 1e-9}, worst[1]);
  expect_holds({"Plastic cycle: dissipated energy over the moment at yield",
                "M_y x turns of the rest bend", 1e-9},
               worst[2]);
  expect_holds({"Plastic cycle: elastic energy over the moment at yield", "M^2/2K", 1e-9},
               worst[3]);
}

// The same moment, said in the other way.
TEST(FibreYield, ByMoment)
{
  Fibre fibre;
  fibre.segments = 2;
  const Scene scene = two_segments(fibre, "yield_moment 3e-4");
  const Table table = thermo_of(scene, turned(0.01, 20, scene.dt), "c_bending");
  ASSERT_FALSE(table.rows.empty());
  EXPECT_NEAR(table.rows.back()[1] / 3e-4, 1.0, 1e-12);
}

// Kinetic, elastic and dissipated energy of a fibre that is shaken until it yields.
TEST(FibreYield, EnergyIsAccountedFor)
{
  Fibre fibre;
  fibre.segments = 6;
  double worst[2] = {0.0, 0.0}, lost = 0.0;
  for (const int finer : {1, 2}) {
    Scene scene = fibre_scene(fibre);
    shake(scene.rods, 0.3, 15.0, 32452843);
    scene.physics =
        fibre_physics(fibre, fmt::format("yield_stress {}", yield_stress_for(fibre, 0.02)));
    scene.dt = fibre.time_step() / (8.0 * finer);
    const Table table = thermo_of(scene, fmt::format("run {}\n", std::lround(0.02 / scene.dt)),
                                  "ke c_spin f_joints f_joints[6]");
    ASSERT_FALSE(table.rows.empty());
    const auto total = [](const std::vector<double> &row) {
      return row[1] + row[2] + row[3] + row[4];
    };
    for (const std::vector<double> &row : table.rows)
      worst[finer - 1] =
          std::max(worst[finer - 1], std::fabs(total(row) / total(table.rows[0]) - 1.0));
    lost = table.rows.back()[4] / total(table.rows[0]);
  }
  EXPECT_GT(lost, 0.1) << "it must yield";
  expect_holds({"Fibre that yields in free flight: energy with the dissipated one, relative",
                "conserved", 1e-3},
               worst[1]);
  EXPECT_LT(worst[1], 0.5 * worst[0]);
}

// Whether the joint of two segments breaks that are held at this stretch (m) and angle between them.
bool breaks(const Fibre &fibre, const std::string &strength, double stretch, double angle)
{
  Scene scene = fibre_scene(fibre);
  const Vec3 axis = {std::cos(angle), std::sin(angle), 0.0};
  scene.rods[1].axis = axis;
  scene.rods[1].position = 0.5 * fibre.joint_distance * (Vec3{1.0, 0.0, 0.0} + axis);
  scene.physics = fibre_physics(fibre, strength) + "group both id 1 2\nfix hold both freeze\n";
  const Vec3 mean = {std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0};
  const Vec3 moved = scene.rods[1].position + stretch * mean;
  const Table table =
      thermo_of(scene, fmt::format("set atom 2 x {:.17g} y {:.17g}\nrun 0\n", moved.x, moved.y),
                "f_joints[5] f_joints[7]");
  if (table.rows.empty()) return false;
  EXPECT_EQ(table.rows[0][1] + table.rows[0][2], 1.0);
  return table.rows[0][2] == 1.0;
}

// Closed form: sigma A under pull, sigma I/r under bending, and in between the sum of both parts.
TEST(FibreStrength, BreaksAtItsStrength)
{
  Fibre fibre;
  fibre.segments = 2;
  constexpr double kTensile = 4e5, kBending = 6e5, kNear = 1e-10;
  const double r = fibre.radius, area = pi * r * r;
  const double stretch = kTensile * area / fibre.stretch_stiffness();
  const double angle = kBending * area * r / 4.0 / fibre.bend_stiffness();
  const std::string both =
      fmt::format("tensile_strength {} bending_strength {}", kTensile, kBending);
  const auto error = [&](const std::string &strength, double of_stretch, double of_angle) {
    const auto at = [&](double factor) {
      return breaks(fibre, strength, factor * of_stretch * stretch, factor * of_angle * angle);
    };
    return !at(1.0 - kNear) && at(1.0 + kNear) ? kNear : 1.0;
  };
  expect_holds({"Fibre pulled apart: force at which it breaks, relative", "sigma A", kNear},
               error(fmt::format("tensile_strength {}", kTensile), 1.0, 0.0));
  expect_holds({"Fibre bent until it breaks: moment, relative", "sigma I/r", kNear},
               error(fmt::format("bending_strength {}", kBending), 0.0, 1.0));
  expect_holds({"Fibre pulled and bent: loads at which it breaks, relative",
                "(N/A)/sigma_t + (M r/I)/sigma_b = 1", kNear},
               std::max(error(both, 0.3, 0.7), error(both, -0.5, 1.5)));
  EXPECT_FALSE(breaks(fibre, fmt::format("tensile_strength {}", kTensile), 0.0, 3.0 * angle));
  EXPECT_FALSE(breaks(fibre, fmt::format("bending_strength {}", kBending), 3.0 * stretch, 0.0));
}

// Held at one end and pulled slowly at the other: force sigma A, at that joint where the pull is highest, the
// first one by its own weight.
TEST(FibreStrength, BreaksWherePullIsHighest)
{
  Fibre fibre;
  fibre.segments = 5;
  Scene scene = fibre_scene(fibre);
  const double weight = 100.0 * fibre.segment_mass();
  const double strength = 12.0 * weight / (pi * fibre.radius * fibre.radius);
  scene.physics = fibre_physics(fibre, fmt::format("damping 0.3 tensile_strength {}", strength)) +
                  kClampFirst + "fix weight all gravity 100 vector 1 0 0\n" +
                  "variable pull equal 2*step*dt\n"
                  "group last id 5\nfix load last addforce v_pull 0 0\n";
  std::string output;
  const Table table = thermo_of(scene, "run 1500\n", "f_joints[7] v_pull f_joints[5]", 1, &output);
  ASSERT_FALSE(table.rows.empty());
  size_t row = 0;
  while (row < table.rows.size() && table.rows[row][1] == 0.0) row++;
  ASSERT_LT(row, table.rows.size());
  // Four segments and the last one's hemisphere hang from the first joint.
  const double hanging =
      table.rows[row][2] + 100.0 * (4.0 * fibre.segment_mass() + fibre.cap_mass());
  expect_holds({"Fibre pulled slowly: force at which it breaks, relative", "sigma A", 1e-2},
               std::fabs(hanging / (12.0 * weight) - 1.0));
  EXPECT_EQ(table.rows.back()[1], 1.0);
  EXPECT_EQ(table.rows.back()[3], 3.0);
  EXPECT_NE(output.find("1 joints of fibres have broken"), std::string::npos);
}

// Forces vanish on both sides: momentum and angular momentum of all parts stay. No contact afterwards.
TEST(FibreBreaking, KeepsMomentum)
{
  Fibre fibre;
  Scene scene = fibre_scene(fibre);
  for (Rod &rod : scene.rods) rod.position.x -= 0.08;
  shake(scene.rods, 1.0, 20.0, 15485863);
  scene.physics = fibre_physics(fibre, "bending_strength 3e4 tensile_strength 3e4");
  scene.steps = 5000;
  scene.dump_every = 100;
  const Totals start = totals_of(scene.rods);
  for (const Mode mode : {Mode::OneRank, Mode::TwoRanks}) {
    double momentum = 0.0, angular_momentum = 0.0;
    for (const Frame &frame : run(scene, mode)) {
      const Totals now = totals_of(frame.rods);
      momentum = std::max(momentum, norm(now.momentum - start.momentum) / norm(start.momentum));
      angular_momentum =
          std::max(angular_momentum, norm(now.angular_momentum - start.angular_momentum) /
                                         norm(start.angular_momentum));
    }
    expect_holds({"Fibre that breaks in flight: momentum, relative", "conserved", 1e-12}, momentum);
    expect_holds({"Fibre that breaks in flight: angular momentum, relative", "conserved", 1e-12},
                 angular_momentum);
  }
  const Table table = thermo_of(scene, "run 5000\n", "f_joints[7]");
  ASSERT_FALSE(table.rows.empty());
  EXPECT_GE(table.rows.back()[1], 2.0);
}

// At rest and pulled a little too far, the joint goes and nothing moves: the parts lie in each other, with short
// segments across the one between too, and do not touch.
TEST(FibreBreaking, PartsAreNotKicked)
{
  double fastest = 0.0;
  for (const double h : {8.0, 1.5}) {
    Fibre fibre;
    fibre.segments = 4;
    fibre.joint_distance = h * fibre.radius;
    Scene scene = fibre_scene(fibre);
    scene.physics = fibre_physics(fibre, "tensile_strength 1e3");
    const double stretch = 2e-4 * fibre.joint_distance;
    const Table table = thermo_of(
        scene,
        fmt::format("group right id 3 4\ndisplace_atoms right move {:.17g} 0 0\nrun 200\n",
                    stretch),
        "ke f_joints[7] f_joints[5] f_joints[8]");
    ASSERT_FALSE(table.rows.empty());
    EXPECT_EQ(table.rows.back()[2], 1.0);
    EXPECT_EQ(table.rows.back()[3], 2.0);
    const double energy = 0.5 * fibre.stretch_stiffness() * stretch * stretch;
    EXPECT_NEAR(table.rows.back()[4] / energy, 1.0, 1e-8);
    fastest = std::max(fastest, table.rows.back()[1] / energy);
  }
  expect_holds({"Broken fibre: kinetic energy over the joint's", "no kick", 1e-12}, fastest);
}

// A ring of short segments, which lie in the next but one as well, breaks at each of its joints in turn: nothing
// touches, nothing moves.
TEST(FibreBreaking, RingsAreNotKicked)
{
  Fibre fibre;
  fibre.segments = 16;
  fibre.joint_distance = 1.5 * fibre.radius;
  const double stretch = 1e-4 * fibre.joint_distance;
  const double strength =
      0.9 * fibre.stretch_stiffness() * stretch / (pi * std::pow(fibre.radius, 2));
  const double turn = 2.0 * pi / fibre.segments;
  for (int pulled = 0; pulled < fibre.segments; pulled++) {
    Scene scene = fibre_scene(fibre);
    Vec3 end = {0.0, 0.0, 0.0};
    for (int k = 0; k < fibre.segments; k++) {
      scene.rods[k].axis = {std::cos(k * turn), std::sin(k * turn), 0.0};
      scene.rods[k].position = end + 0.5 * fibre.joint_distance * scene.rods[k].axis;
      end = end + fibre.joint_distance * scene.rods[k].axis;
    }
    const Vec3 moved = scene.rods[pulled].position + stretch * scene.rods[pulled].axis;
    scene.physics = fibre_physics(fibre, fmt::format("rest present tensile_strength {}", strength));
    const Table table = thermo_of(
        scene,
        fmt::format("compute touch all contact/spherocylinder\n"
                    "compute touching all reduce sum c_touch\n"
                    "fix hold all freeze\nset atom {} x {:.17g} y {:.17g}\n"
                    "thermo_style custom step f_joints[5] f_joints[7] c_touching\nrun 3\n",
                    pulled + 1, moved.x, moved.y),
        "ke");
    ASSERT_FALSE(table.rows.empty());
    EXPECT_EQ(table.rows.back()[1], 15.0) << pulled;
    EXPECT_EQ(table.rows.back()[2], 1.0) << pulled;
    EXPECT_EQ(table.rows.back()[3], 0.0) << pulled;
  }
}

// Once apart they touch. Flying apart and, in a second run, back: an elastic hit of equal rods swaps their
// speeds, as that of two rods that were never joined.
TEST(FibreBreaking, PartsTouchOnceApart)
{
  Fibre fibre;
  fibre.segments = 2;
  for (const int ranks : {1, 2}) {
    Scene scene = fibre_scene(fibre);
    for (Rod &rod : scene.rods) rod.position.x -= 0.01;
    scene.rods[0].velocity = {-1.0, 0.0, 0.0};
    scene.rods[1].velocity = {1.0, 0.0, 0.0};
    scene.physics = linear_material(1e3, 1e3, 1.0, 0.0) +
                    fibre_physics(fibre, "tensile_strength 1e3")
                        .substr(linear_material(1e3, 1e3, 0.5, 0.3).size());
    scene.dt = 0.05 * fibre.time_step();
    // By 4 mm to come apart, 0.2 mm more; back, hit and away again.
    const long away = std::lround(0.0021 / scene.dt);
    const Table table = thermo_of(
        scene,
        fmt::format(
            "group left id 1\ngroup right id 2\ncompute vl left reduce sum vx\n"
            "thermo_style custom step f_joints[7] ke c_vl\nthermo_modify format float %.15g\nthermo {0}\nrun {0}\n"
            "velocity left set 1.0 0.0 0.0\nvelocity right set -1.0 0.0 0.0\nrun {0}\n",
            away),
        "ke", ranks);
    ASSERT_FALSE(table.rows.empty());
    EXPECT_EQ(table.rows[0][1], 1.0);
    expect_holds(
        {"Parts of a broken fibre that hit each other: speed after it, relative", "v", 1e-3},
        std::fabs(-table.rows.back()[3] - 1.0));
  }
}

// Parted and yielded joints are with the rods: ranks and threads agree, and a restart goes on with the same bits.
Scene breaking_tangle()
{
  return tangle("damping 0.1 yield_stress 7e4 bending_strength 1.1e5 tensile_strength 1.1e5");
}

TEST(FibreBreaking, OneTwoAndFourRanksAgree)
{
  const Scene scene = breaking_tangle();
  const std::vector<Frame> one = run(scene);
  expect_holds({"24 fibres that yield and break, 1 and 2 ranks, 1000 steps: place (m), axis",
                "same scene", 1e-10},
               difference_in_period(scene, one, run(scene, Mode::TwoRanks)));
  expect_holds({"24 fibres that yield and break, 1 and 4 ranks, 1000 steps: place (m), axis",
                "same scene", 1e-10},
               difference_in_period(scene, one, run(scene, Mode::FourRanks)));
  std::vector<std::vector<double>> sums;
  for (const int ranks : {1, 4}) {
    const Table table =
        thermo_of(scene, "thermo 1000\nrun 1000\n",
                  "f_joints[5] f_joints[6] f_joints[7] f_joints[8] c_bending", ranks);
    ASSERT_FALSE(table.rows.empty());
    sums.push_back(table.rows.back());
  }
  EXPECT_GT(sums[0][3], 3.0) << "joints must break";
  EXPECT_LT(sums[0][3], 120.0) << "and others hold";
  EXPECT_EQ(sums[0][1] + sums[0][3], 24.0 * 6.0);
  EXPECT_GT(sums[0][2], 0.0);
  for (size_t k = 1; k < sums[0].size(); k++) EXPECT_NEAR(sums[1][k] / sums[0][k], 1.0, 1e-8) << k;
}

TEST(FibreBreaking, ThreadsComeToTheSameBits)
{
  std::vector<std::vector<Frame>> runs;
  for (const int threads : {1, 3}) {
    Scene scene = breaking_tangle();
    const std::string pair = "surface spherocylinder";
    scene.physics.replace(scene.physics.find(pair), pair.size(),
                          fmt::format("{} threads {}", pair, threads));
    runs.push_back(run(scene));
  }
  EXPECT_EQ(largest_difference(runs[0], runs[1]), 0.0);
}

TEST(FibreBreaking, RestartGoesOnWithTheSameBits)
{
  const Scene scene = breaking_tangle();
  const DeckFolder folder;
  expect_same_bits_from_half(
      folder, scene,
      std::string(kStateColumns) +
          " f_fibres[3] f_fibres[4] f_fibres[5] f_fibres[6] f_fibres[7] f_fibres[8]",
      "thermo_style custom step f_joints[6] f_joints[7] f_joints[8]\nthermo_modify format float %.17g\n");
}

// Closed form: two joints bent by 20 degrees each, the second pulled by u along its mean axis.
TEST(FibreLocal, SaysWhatAJointBears)
{
  Fibre fibre;
  fibre.segments = 3;
  const double angle = degrees(20.0), u = 1e-5, h = fibre.joint_distance;
  Scene scene = fibre_scene(fibre);
  for (int k = 1; k < 3; k++) {
    scene.rods[k].axis = {std::cos(k * angle), std::sin(k * angle), 0.0};
    scene.rods[k].position =
        scene.rods[k - 1].position + 0.5 * h * (scene.rods[k - 1].axis + scene.rods[k].axis);
  }
  const Vec3 meeting = scene.rods[1].position + 0.5 * h * scene.rods[1].axis;
  const Vec3 mean = {std::cos(1.5 * angle), std::sin(1.5 * angle), 0.0};
  const Vec3 moved = scene.rods[2].position + u * mean;
  scene.physics = fibre_physics(fibre) + "fix hold all freeze\n";
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.local",
               preamble(scene) + "read_data rods.data\nneighbor 0.002 bin\n" + scene.physics +
                   fmt::format("set atom 3 x {:.17g} y {:.17g}\n", moved.x, moved.y) +
                   "compute j all joint/spherocylinder/local\n" +
                   exact_local_dump("dump.joints", 1, "j", 22) +
                   "compute e all joint/spherocylinder/local energy\n"
                   "compute sum all reduce sum c_e\nthermo_style custom step c_sum f_joints\n"
                   "thermo_modify format float %.15g norm no\nrun 0\n");
  const Outcome outcome = folder.run("in.local");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  EXPECT_NEAR(thermo.rows[0][1] / thermo.rows[0][2], 1.0, 1e-14);
  const Table joints = read_dump(folder / "dump.joints").back().atoms;
  ASSERT_EQ(joints.rows.size(), 2u);
  const double moment = fibre.bend_stiffness() * angle, force = fibre.stretch_stiffness() * u;
  const Vec3 place = meeting + 0.5 * u * mean;
  const std::vector<double> wanted = {2.0,
                                      3.0,
                                      1.0,
                                      2.0,
                                      place.x,
                                      place.y,
                                      0.0,
                                      force * mean.x,
                                      force * mean.y,
                                      0.0,
                                      force,
                                      0.0,
                                      0.0,
                                      0.0,
                                      moment,
                                      moment,
                                      0.0,
                                      angle / h,
                                      0.0,
                                      0.0,
                                      0.5 * moment * angle + 0.5 * force * u,
                                      0.0};
  // Each column by its own scale.
  const std::vector<double> scale = {1,      1,     1,     1,     h,      h,      h,      force,
                                     force,  force, force, force, moment, moment, moment, moment,
                                     moment, 1 / h, 1 / h, 1 / h, moment, moment};
  double worst = 0.0;
  ASSERT_EQ(joints.rows[1].size(), wanted.size());
  for (size_t k = 0; k < wanted.size(); k++)
    worst = std::max(worst, std::fabs(joints.rows[1][k] - wanted[k]) / scale[k]);
  expect_holds(
      {"compute joint/spherocylinder/local, a joint bent and pulled: all 22 columns, relative",
       "K_bend x angle, K_stretch x u, their energies", 1e-10},
      worst);
}

// Each joint once, whoever has its rods; sums are those of the fix.
TEST(FibreLocal, EachJointOnceOnAllRanks)
{
  Scene scene = breaking_tangle();
  std::vector<Table> tables;
  for (const int ranks : {1, 2, 4}) {
    const Mode mode = ranks == 1 ? Mode::OneRank : ranks == 2 ? Mode::TwoRanks : Mode::FourRanks;
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("in.local",
                 preamble(scene, mode) + "read_data rods.data\nneighbor 0.002 bin\n" +
                     scene.physics + fmt::format("timestep {}\n", scene.dt) +
                     "compute j all joint/spherocylinder/local place fibre id1 id2 x y z axial "
                     "bending torsion rest_curvature energy plastic\n" +
                     exact_local_dump("dump.joints", 900, "j", 13) +
                     "compute sum all reduce sum c_j[12] c_j[13]\n"
                     "thermo_style custom step c_sum[1] f_joints c_sum[2] f_joints[6]\nthermo 900\n"
                     "thermo_modify format float %.15g norm no\nrun 900\n");
    const Outcome outcome = folder.run("in.local", {Program::Lmp, ranks});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const std::vector<double> sums = read_thermo(outcome.output).rows.back();
    EXPECT_NEAR(sums[1] / sums[2], 1.0, 1e-13);
    EXPECT_LE(sums[3], sums[4]);  // broken joints have no row
    tables.push_back(read_dump(folder / "dump.joints").back().atoms);
    std::sort(tables.back().rows.begin(), tables.back().rows.end(),
              [](const auto &a, const auto &b) { return a[2] < b[2]; });
  }
  ASSERT_GT(tables[0].rows.size(), 20u);
  double worst = 0.0;
  const double scale[] = {1, 1, 1, 1, 1e-3, 1e-3, 1e-3, 1e-2, 1e-3, 1e-3, 1.0, 1e-5, 1e-5};
  for (const Table &table : {tables[1], tables[2]}) {
    ASSERT_EQ(table.rows.size(), tables[0].rows.size());
    ASSERT_EQ(table.rows[0].size(), std::size(scale));
    for (size_t row = 0; row < table.rows.size(); row++)
      for (size_t k = 0; k < std::size(scale); k++) {
        double d = table.rows[row][k] - tables[0].rows[row][k];
        if (k >= 4 && k < 7) d -= 0.16 * std::round(d / 0.16);
        worst = std::max(worst, std::fabs(d) / scale[k]);
      }
  }
  expect_holds(
      {"compute joint/spherocylinder/local, 24 fibres, 1, 2, 4 ranks, 900 steps: rows, relative",
       "same scene", 1e-9},
      worst);
}

}  // namespace
