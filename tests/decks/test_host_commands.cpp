// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's commands and fixes that set, hold or push rods: displace_atoms, velocity, fix freeze,
// fix buoyancy.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

constexpr double kPi = 3.14159265358979323846;

Scene scene_of(const std::vector<Rod> &rods, const std::string &commands)
{
  Scene scene;
  scene.rods = rods;
  scene.physics =
      linear_material(2e4, 5.7e3, 0.5, 0.2) + rod_pair("linear tangential history") + commands;
  scene.dt = 2e-5;
  scene.steps = 100;
  return scene;
}

constexpr const char *kMotion = "fix motion all nve/spherocylinder\n";

// Nine parallel rods side by side, a little apart.
std::vector<Rod> raft()
{
  std::vector<Rod> rods;
  for (int k = 0; k < 9; k++) {
    Rod rod;
    rod.length = 0.05;
    rod.position = {0.06 * (k % 3), 0.0101 * (k / 3), 0.0};
    rods.push_back(rod);
  }
  return rods;
}

class DisplaceAtoms : public testing::TestWithParam<Mode> {};

// The raft as a whole, about a line that goes askew through a point beside it: nothing touches, and the
// spins, which turn with the rods, keep their energy.
TEST_P(DisplaceAtoms, RotateTurnsAxesAndSpins)
{
  std::vector<Rod> rods = raft();
  const Vec3 point = {0.1, -0.2, 0.05}, about = normalized({1.0, -2.0, 2.0});
  const double angle = degrees(130.0);
  for (Rod &rod : rods) rod.omega = 5.0 * rod.axis;
  const Scene scene =
      scene_of(rods, std::string(kMotion) + "displace_atoms all rotate 0.1 -0.2 0.05 1 -2 2 130\n");
  const std::vector<Frame> frames = run(scene, GetParam());
  for (const Frame &frame : frames)
    for (size_t k = 0; k < rods.size(); k++) {
      const auto turned = [&](const Vec3 &a) {
        return std::cos(angle) * a + std::sin(angle) * cross(about, a) +
               (1.0 - std::cos(angle)) * dot(about, a) * about;
      };
      const Rod &now = frame.rods[k];
      EXPECT_LT(norm(now.position - point - turned(rods[k].position - point)), 1e-12);
      EXPECT_LT(norm(now.axis - turned(rods[k].axis)), 1e-12);
      EXPECT_LT(norm(now.omega - turned(rods[k].omega)), 1e-11);
      EXPECT_EQ(frame.contacts[k], 0.0);
    }
}

INSTANTIATE_TEST_SUITE_P(, DisplaceAtoms, testing::Values(Mode::OneRank, Mode::TwoRanks),
                         [](const auto &info) { return name_of(info.param); });

TEST(HostCommands, DisplaceAtomsMoveLeavesAxes)
{
  const std::vector<Rod> rods = raft();
  const std::vector<Frame> frames =
      run(scene_of(rods, std::string(kMotion) + "displace_atoms all move 0.1 0.2 0.3\n"));
  for (size_t k = 0; k < rods.size(); k++) {
    EXPECT_LT(norm(frames.back().rods[k].position - rods[k].position - Vec3{0.1, 0.2, 0.3}), 1e-15);
    EXPECT_LT(norm(frames.back().rods[k].axis - rods[k].axis), 1e-15);
  }
}

// velocity setAngular gives the angular momentum.
TEST(HostCommands, VelocitySetAngularTurnsRods)
{
  Rod rod;
  rod.axis = {0.6, 0.0, 0.8};
  const std::vector<Frame> frames =
      run(scene_of({rod}, std::string(kMotion) + "velocity all setAngular 1e-4 2e-4 -3e-4\n"));
  for (const Frame &frame : frames)
    EXPECT_LT(norm(frame.rods[0].angular_momentum() - Vec3{1e-4, 2e-4, -3e-4}), 1e-16);
}

// A rod that create_atoms has made has no inertia yet, and no angular velocity follows.
TEST(HostCommands, VelocitySetAngularWantsTheSize)
{
  const DeckFolder folder;
  Scene scene = scene_of({Rod{}}, kMotion);
  folder.write("rods.data", data_file(scene));
  folder.write("in.rods", preamble(scene) + "read_data rods.data\n" + scene.physics +
                              "create_atoms 1 single 0.0 0.5 0.0 units box\n"
                              "velocity all setAngular 1e-4 0.0 0.0\n"
                              "set atom 2 diameter 0.01 length 0.1 density 2700\nrun 1\n");
  const Outcome outcome = folder.run("in.rods", {Program::Lmp, 1, 60});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("setAngular wants the size of rod 2 first"), std::string::npos)
      << outcome.output;
}

TEST(HostCommands, VelocityZeroAngularIndividualStopsSpins)
{
  std::vector<Rod> rods = raft();
  for (Rod &rod : rods) rod.omega = {1.0, 20.0, -30.0};
  const std::vector<Frame> frames =
      run(scene_of(rods, std::string(kMotion) + "velocity all zero angularIndividual\n"));
  for (size_t k = 0; k < rods.size(); k++) {
    EXPECT_EQ(norm(frames.back().rods[k].omega), 0.0);
    EXPECT_LT(norm(frames.back().rods[k].axis - rods[k].axis), 1e-15);
  }
}

// A frozen rod, with or without an integrator of its own, is at rest, also in the eyes of one that
// falls on it; without friction and restitution 1 that one rebounds as from a wall.
TEST(HostCommands, FreezeStopsRods)
{
  for (const char *integrator : {"all", "falling"}) {
    Rod frozen, falling;
    frozen.velocity = {0.0, 0.0, 1.0};
    frozen.omega = {0.0, 30.0, 100.0};
    falling.axis = {0.0, 1.0, 0.0};
    falling.position.z = 0.011;
    falling.velocity.z = -0.1;
    Scene scene = scene_of({frozen, falling}, "");
    scene.physics = linear_material(2e4, 5.7e3, 1.0, 0.0) + rod_pair("linear tangential history") +
                    "group frozen id 1\ngroup falling id 2\nfix hold frozen freeze\n" +
                    "fix motion " + integrator + " nve/spherocylinder\n";
    scene.dt = 1e-6;
    scene.steps = 25000;
    const Frame last = run(scene).back();
    EXPECT_EQ(norm(last.rods[0].position), 0.0);
    EXPECT_LT(norm(last.rods[0].axis - frozen.axis), 1e-15);
    EXPECT_EQ(norm(last.rods[0].omega), 0.0);
    EXPECT_NEAR(last.rods[1].velocity.z, 0.1, 1e-6) << integrator;
  }
}

// The force and torque on rods with fix buoyancy (density 1000, level 0.5) and gravity.
Table forces_in_water(const std::vector<Rod> &rods, const std::string &more)
{
  const DeckFolder folder;
  const Scene scene = scene_of(rods, "fix gravity all gravity 9.81 vector 0 0 -1\n"
                                     "fix water all buoyancy level 0.5 density 1000 dim z" +
                                         more + "\n" + kMotion);
  folder.write("rods.data", data_file(scene));
  folder.write("in.water", preamble(scene) + "read_data rods.data\n" + scene.physics +
                               exact_dump("dump.water", 1, "id fx fy fz tqx tqy tqz") +
                               "thermo_style custom step f_water[1] f_water[3]\nrun 0\n");
  const Outcome outcome = folder.run("in.water");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table atoms = read_dump(folder / "dump.water").back().atoms;
  const Table thermo = read_thermo(outcome.output);
  double lift = 0.0;
  for (size_t k = 0; k < rods.size(); k++) lift += atoms.at(k, "fz") + 9.81 * rods[k].mass();
  EXPECT_NEAR(thermo.rows.back()[2], lift, 1e-6 * std::fabs(lift));
  return atoms;
}

TEST(HostCommands, BuoyancyOfARodsOwnVolume)
{
  // Under water, above it, and standing with half its length under.
  std::vector<Rod> rods(3);
  rods[0].position = {0.0, 0.0, -0.5};
  rods[1].position = {0.2, 0.0, 0.6};
  rods[2].position = {0.4, 0.0, 0.5};
  rods[2].axis = {0.0, 0.0, 1.0};
  for (Rod &rod : rods) rod.length = 0.05;
  const Table atoms = forces_in_water(rods, "");
  const double volume = rods[0].properties().volume;
  EXPECT_NEAR(atoms.at(0, "fz"), (1000.0 - 2700.0) * 9.81 * volume, 1e-12);  // -0.0611 N
  EXPECT_NEAR(atoms.at(1, "fz"), -2700.0 * 9.81 * volume, 1e-12);
  EXPECT_NEAR(atoms.at(2, "fz"), (500.0 - 2700.0) * 9.81 * volume, 1e-9);
  EXPECT_NEAR(atoms.at(2, "tqx"), 0.0, 1e-12);
}

// A long rod leans by 30 degrees and has its middle at the surface: its lower half is immersed, whose
// centroid is half of that half away, but for the ends' roundness and the slanting cut, both of the
// order of r/L. It is lifted upright... to lie: the torque is lift times horizontal arm.
TEST(HostCommands, BuoyancyActsAtTheImmersedPart)
{
  Rod rod;
  rod.diameter = 1e-4;
  rod.length = 0.2;
  rod.position = {0.0, 0.0, 0.5};
  rod.axis = {std::sin(kPi / 6.0), 0.0, std::cos(kPi / 6.0)};
  const Table atoms = forces_in_water({rod}, "");
  const double lift = 500.0 * 9.81 * rod.properties().volume;
  const double arm = -0.05 * std::sin(kPi / 6.0);  // along x
  EXPECT_NEAR(atoms.at(0, "tqy"), -arm * lift, 1e-3 * std::fabs(arm * lift));
  EXPECT_NEAR(atoms.at(0, "tqx"), 0.0, 1e-9 * std::fabs(arm * lift));
}

TEST(HostCommands, BuoyancyMindsItsRegion)
{
  std::vector<Rod> rods(2);
  rods[1].position.x = 0.5;
  const std::string region = " region left";
  Scene scene = scene_of(rods, "");
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.water", preamble(scene) + "read_data rods.data\n" + scene.physics +
                               "region left block -0.1 0.1 INF INF INF INF units box\n"
                               "fix gravity all gravity 9.81 vector 0 0 -1\n"
                               "fix water all buoyancy level 0.5 density 1000 dim z region left\n" +
                               kMotion + exact_dump("dump.water", 1, "id fz") + "run 0\n");
  ASSERT_EQ(folder.run("in.water").exit_code, 0);
  const Table atoms = read_dump(folder / "dump.water").back().atoms;
  const double volume = rods[0].properties().volume;
  EXPECT_NEAR(atoms.at(0, "fz"), (1000.0 - 2700.0) * 9.81 * volume, 1e-12);
  EXPECT_NEAR(atoms.at(1, "fz"), -2700.0 * 9.81 * volume, 1e-12);
}

// Nobody has given forces: rods fly on, those that come to another rank too.
TEST(FixExternal, GivesNoForceUntilItIsToldTo)
{
  std::vector<Rod> rods;
  for (int k = 0; k < 500; k++) {
    Rod rod;
    rod.length = 0.02;
    rod.position = {-0.9 + 0.09 * (k % 20), -0.9 + 0.07 * (k / 20), 0.0};
    rod.velocity = {(k / 20) % 2 ? 30.0 : -30.0, 0.0, 1.0};
    rods.push_back(rod);
  }
  const Scene scene =
      scene_of(rods, std::string(kMotion) + "fix outside all external pf/array 1\n");
  for (const Mode mode : {Mode::OneRank, Mode::TwoRanks}) {
    const Frame last = run(scene, mode).back();
    for (size_t k = 0; k < rods.size(); k++)
      ASSERT_EQ(norm(last.rods[k].velocity - rods[k].velocity), 0.0) << "rod " << k + 1;
  }
}

// Only the displacement is to blame: the same deck without it keeps its rods.
TEST(DisplaceAtomsOut, OfAFixedBoxIsRefused)
{
  for (const char *boundary : {"f f f", "p f f", "f m f"}) {
    Scene scene = scene_of(raft(), "");
    scene.boundary = boundary;
    for (const double way : {0.3, 0.99}) {
      const DeckFolder folder;
      folder.write("rods.data", data_file(scene));
      folder.write("in.out", preamble(scene) + "read_data rods.data\n" + scene.physics + kMotion +
                                 "displace_atoms all move 0 0 " + std::to_string(way * 2.0) +
                                 " units box\nrun 1\n");
      const Outcome outcome = folder.run("in.out");
      const bool refused =
          outcome.output.find("9 rods are outside the box now") != std::string::npos;
      EXPECT_EQ(outcome.exit_code != 0, way > 0.5) << outcome.output;
      EXPECT_EQ(refused, way > 0.5);
    }
  }
}

}  // namespace
