// SPDX-License-Identifier: GPL-2.0-or-later
// fix rest/spherocylinder: what is at rest and what only looks so, and how the run ends.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

constexpr double kGravity = 9.81;
constexpr double kStiffness = 1e4;
constexpr double kWindow = 0.02;
constexpr double kDt = 1e-4;
constexpr int kInterval = 10;
constexpr long kSteps = 600;  // three windows
const std::string kFix =
    fmt::format("fix rested all rest/spherocylinder {} window {}\n", kInterval, kWindow);

// Flat on the floor, sunk by m g/(2 k): at rest but for its velocity.
Rod lying_at(double x, double speed)
{
  Rod rod;
  rod.axis = {0.0, 1.0, 0.0};
  rod.position = {x, 0.0, rod.radius() - rod.mass() * kGravity / (2.0 * kStiffness)};
  rod.velocity = {speed, 0.0, 0.0};
  return rod;
}

// Speed of a rod whose kinetic energy is `ratio` m g D.
double speed_of(double ratio) { return std::sqrt(2.0 * ratio * kGravity * Rod().diameter); }

struct Settling {
  long last_step = 0;
  Table thermo;
  std::string output;
};

Settling settle(const DeckFolder &folder, const std::vector<Rod> &rods, const std::string &fixes,
                int ranks = 1, double friction = 0.0, const std::string &after = "",
                long steps = kSteps)
{
  Scene scene;
  scene.box_lo[2] = -0.1;
  scene.rods = rods;
  folder.write("rods.data", data_file(scene));
  folder.write("in.settle",
               preamble(scene, ranks > 1 ? Mode::TwoRanks : Mode::OneRank) +
                   "read_data rods.data\nneighbor 0.02 bin\nneigh_modify delay 0\n" +
                   linear_material(kStiffness, kStiffness, 0.1, friction) +
                   rod_pair("linear tangential history") +
                   rod_wall("floor", "linear tangential history", "type 1 zplane 0.0") +
                   "fix motion all nve/spherocylinder\n" +
                   fmt::format("fix weight all gravity {} vector 0 0 -1\n", kGravity) + fixes +
                   fmt::format(R"(compute contacts all contact/spherocylinder
compute temperature all temp
compute pressure all pressure temperature
compute energy all pe
timestep {}
thermo_style custom step c_pressure c_energy ke f_rested[1] f_rested[2] f_rested[3] f_rested[4] f_rested[5]
thermo_modify norm no lost error format float %.17g
thermo 300
{}run {}
)",
                               kDt, exact_dump("dump.settle", 600, kFrameColumns), steps) +
                   after);
  const Outcome outcome = folder.run("in.settle", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  Settling result;
  result.output = outcome.output;
  result.thermo = read_thermo(outcome.output);
  if (result.thermo.rows.empty())
    ADD_FAILURE() << outcome.output;
  else
    result.last_step = static_cast<long>(result.thermo.rows.back()[0]);
  return result;
}

// Column k of the fix at the end of the last run.
double rested(const Settling &result, int k)
{
  return result.thermo.rows.empty() ? -1.0 : result.thermo.rows.back().at(3 + k);
}

long last_step(const std::vector<Rod> &rods, const std::string &fixes, int ranks = 1,
               double friction = 0.0)
{
  const DeckFolder folder;
  return settle(folder, rods, fixes, ranks, friction).last_step;
}

class EndAtRest : public testing::TestWithParam<int> {};

// At rest from the first look, at step 10, on: the 200 steps of the window later the run ends with the next
// step, with thermo output, a frame of the dump and a restart that holds the same bed; the deck goes
// on. Energy and pressure are tallied only in steps
// known beforehand.
TEST_P(EndAtRest, EndsTheRunWithItsOutputAndTheDeckGoesOn)
{
  const DeckFolder folder;
  const Settling result =
      settle(folder, {lying_at(-0.3, 0.0), lying_at(0.3, 0.0)}, kFix, GetParam(), 0.0,
             "write_restart rested\nvariable ended equal f_rested[5]\n"
             "print \"the deck goes on: ${ended}\"\n");
  const long expected = kInterval + std::lround(kWindow / kDt) + 1;
  EXPECT_EQ(result.last_step, expected) << result.output;
  EXPECT_EQ(rested(result, 5), 1.0);
  EXPECT_NEAR(rested(result, 4), kWindow, 1e-9);
  EXPECT_NE(result.output.find(fmt::format("for {} steps", expected)), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("\nthe deck goes on: 1"), std::string::npos);

  const Snapshot frame = read_dump(folder / "dump.settle").back();
  EXPECT_EQ(frame.step, expected);
  folder.write("in.again", preamble(Scene(), GetParam() > 1 ? Mode::TwoRanks : Mode::OneRank) +
                               "read_restart rested\nneighbor 0.02 bin\n" +
                               linear_material(kStiffness, kStiffness, 0.1, 0.0) +
                               rod_pair("linear tangential history") +
                               "fix motion all nve/spherocylinder\n" +
                               "compute contacts all contact/spherocylinder\n" +
                               exact_dump("dump.again", 1, kFrameColumns) + "run 0\n");
  ASSERT_EQ(folder.run("in.again", {Program::Lmp, GetParam()}).exit_code, 0);
  const Snapshot again = read_dump(folder / "dump.again").back();
  EXPECT_EQ(again.step, expected);
  EXPECT_EQ(again.atoms.rows, frame.atoms.rows);
}

// Closed form: m v^2/2 = energy m g D, of one rod, and of one of two.
TEST_P(EndAtRest, EnergyIsTheMeanOverTheRods)
{
  const std::string fixes = "fix rested all rest/spherocylinder 10 energy 1e-4 window 0.02\n";
  EXPECT_EQ(last_step({lying_at(-0.1, speed_of(1.01e-4)), lying_at(0.3, speed_of(1.01e-4))}, fixes,
                      GetParam()),
            kSteps);
  EXPECT_LT(last_step({lying_at(-0.1, speed_of(0.99e-4)), lying_at(0.3, speed_of(0.99e-4))}, fixes,
                      GetParam()),
            kSteps);
  EXPECT_EQ(last_step({lying_at(-0.1, speed_of(2.02e-4)), lying_at(0.3, 0.0)}, fixes, GetParam()),
            kSteps);
  EXPECT_LT(last_step({lying_at(-0.1, speed_of(1.98e-4)), lying_at(0.3, 0.0)}, fixes, GetParam()),
            kSteps);
}

// A rod placed at rest in the air has no energy in the first steps, and half of one rod's fall is
// hidden by many at rest; its weight is not balanced.
TEST_P(EndAtRest, FallingRodsAreNotAtRest)
{
  Rod falling = lying_at(0.3, 0.0);
  falling.position.z = 0.4;
  EXPECT_EQ(last_step({lying_at(-0.3, 0.0), falling},
                      "fix rested all rest/spherocylinder 10 energy 1e9 window 0.02\n", GetParam()),
            kSteps);
}

// A rod that falls over as slowly as a brake lets it has next to no energy, and its one contact
// carries its weight; the torque of that contact is balanced by nothing.
TEST_P(EndAtRest, BrakedRodsAreNotAtRest)
{
  Rod leaning;
  leaning.axis = {std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  leaning.position = {-0.3, 0.0,
                      leaning.half_cylinder() * std::sqrt(0.5) + leaning.radius() -
                          leaning.mass() * kGravity / kStiffness};
  const std::string brake = "fix limit all limit/omega 0.01\n";
  const DeckFolder folder;
  const Settling result =
      settle(folder, {leaning, lying_at(0.3, 0.0)}, brake + kFix, GetParam(), 0.5);
  EXPECT_EQ(result.last_step, kSteps) << result.output;
  EXPECT_LT(rested(result, 1), 1e-5);
  // Weight at half length L/2 - r from the centre, at 45 degrees, over m g L/2.
  EXPECT_NEAR(rested(result, 3), leaning.half_cylinder() * std::sqrt(0.5) / (0.5 * leaning.length),
              0.05);
}

INSTANTIATE_TEST_SUITE_P(, EndAtRest, testing::Values(1, 2),
                         [](const auto &info) { return "ranks" + std::to_string(info.param); });

// Without the keyword: sqrt(20 D/g) = 0.1428 s, looks at multiples of ten steps.
TEST(EndAtRestDefault, WindowIsTheFallOfTenDiameters)
{
  const double window = std::sqrt(20.0 * Rod().diameter / kGravity);
  const double steps = kInterval * (1.0 + std::ceil(window / kDt / kInterval)) + 1.0;
  const DeckFolder folder;
  EXPECT_EQ(settle(folder, {lying_at(0.3, 0.0)}, "fix rested all rest/spherocylinder 10\n", 1, 0.0,
                   "", 2000)
                .last_step,
            static_cast<long>(steps));
}

// A run that comes after has its own window, and one too short for it ends where it would.
TEST(EndAtRestDefault, EachRunHasItsWindow)
{
  const DeckFolder folder;
  const Settling result =
      settle(folder, {lying_at(0.3, 0.0)}, kFix, 1, 0.0,
             "run 100\nwrite_restart some\nrun 1000 pre no\nrun 300 every 240 NULL\n"
             "write_restart more\nvariable ended equal f_rested[5]\n"
             "print \"ended: ${ended}\"\n");
  const long first = kInterval + 200 + 1;   // looks at 10, 20 ... 210
  const long second = first + 100;          // 311
  const long third = second + 9 + 200 + 1;  // looks from 320
  const long fourth = third + 9 + 200 + 1 + (300 - 240);
  EXPECT_EQ(result.last_step, fourth) << result.output;
  EXPECT_NE(result.output.find("\nended: 0"), std::string::npos);  // the last part was too short
}

// reset_timestep gives the second run the first step of the one before: it is not ended where that was.
TEST(EndAtRestDefault, RunFromTheSameStepIsAnotherOne)
{
  const DeckFolder folder;
  const Settling result = settle(folder, {lying_at(0.3, 0.0)}, kFix, 1, 0.0,
                                 "run 0\nreset_timestep 0\nvelocity all set 0 0 0.5\n"
                                 "run 300\nvariable ended equal f_rested[5]\n"
                                 "print \"ended: ${ended}\"\n");
  EXPECT_EQ(result.last_step, 300) << result.output;
  const std::size_t told = result.output.find("the run ends");
  EXPECT_NE(told, std::string::npos);
  EXPECT_EQ(result.output.find("the run ends", told + 1), std::string::npos);  // not by `run 0`
  EXPECT_NE(result.output.find("\nended: 0"), std::string::npos);
}

}  // namespace
