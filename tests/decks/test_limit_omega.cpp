// SPDX-License-Identifier: GPL-2.0-or-later
// fix limit/omega on free rods: what it caps, what it leaves, what it says it removed.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "scene.h"

using namespace decks;

namespace {

constexpr double kLimit = 4.0;  // rad/s

struct Limited {
  std::vector<Rod> before, after;
  // actions, energy removed, acted in the last step, most often limited rod: times, id;
  // rotational energy
  Table thermo;
  Snapshot of_rods;  // last step: id, times limited, energy removed
};

// Three free rods: below the limit, above it across the axis, above it along the axis too.
Limited run_limited(const std::string &options, int ranks = 1, double limit = kLimit,
                    int steps = 10)
{
  Scene scene;
  const Vec3 spins[] = {{1.0, 2.0, 1.0}, {0.5, 30.0, 0.0}, {40.0, -8.0, 9.0}};
  for (int i = 0; i < 3; i++) {
    Rod rod;
    rod.position.x = -0.5 + 0.5 * i;
    rod.omega = spins[i];
    scene.rods.push_back(rod);
  }
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write(
      "in.limit",
      preamble(scene, ranks > 1 ? Mode::TwoRanks : Mode::OneRank) + R"(read_data rods.data
neighbor 0.02 bin
)" + linear_material(1e5, 1e5, 0.5, 0.2) +
          rod_pair("linear tangential history") +
          fmt::format(R"(fix motion all nve/spherocylinder
fix limit all limit/omega {0} {1}
compute contacts all contact/spherocylinder
compute energy all erotate/spherocylinder
timestep 1e-5
thermo_style custom step f_limit[1] f_limit[2] f_limit[3] f_limit[4] f_limit[5] c_energy
thermo_modify norm no format float %.17g
thermo {4}
{2}run {3}
)",
                      limit, options,
                      exact_dump("dump.rods", steps, kFrameColumns) +
                          "dump limited all custom 10 dump.limited id f_limit[1] f_limit[2]\n"
                          "dump_modify limited sort id format \"%d %.17g %.17g\"\n",
                      steps, steps / 10));
  const Outcome outcome = folder.run("in.limit", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  return {scene.rods, read_frames(folder / "dump.rods", scene).back().rods,
          read_thermo(outcome.output), read_dump(folder / "dump.limited").back()};
}

double axial(const Rod &rod) { return std::fabs(dot(rod.omega, rod.axis)); }
double transverse(const Rod &rod) { return norm(rod.omega - dot(rod.omega, rod.axis) * rod.axis); }

TEST(LimitOmega, CapsTheWholeAngularVelocityByDefault)
{
  for (const int ranks : {1, 2}) {
    const Limited result = run_limited("", ranks);
    for (const Rod &rod : result.after) EXPECT_LE(norm(rod.omega), kLimit * (1.0 + 1e-12));
    EXPECT_NEAR(norm(result.after[0].omega), norm(result.before[0].omega), 1e-3);
    EXPECT_NEAR(norm(result.after[1].omega), kLimit, 1e-12 * kLimit);
    EXPECT_NEAR(norm(result.after[2].omega), kLimit, 1e-12 * kLimit);
  }
}

TEST(LimitOmega, CapsTheAxialComponentOnly)
{
  const Limited result = run_limited("component axial");
  EXPECT_NEAR(axial(result.after[2]), kLimit, 1e-12);
  // The axial spin is cut at the end of the first step: until then both parts turn freely.
  EXPECT_NEAR(transverse(result.after[2]), transverse(result.before[2]), 1e-9);
  EXPECT_NEAR(transverse(result.after[1]), transverse(result.before[1]), 1e-9);
}

TEST(LimitOmega, CapsTheTransverseComponentOnly)
{
  const Limited result = run_limited("component transverse");
  EXPECT_NEAR(transverse(result.after[1]), kLimit, 1e-12);
  EXPECT_NEAR(transverse(result.after[2]), kLimit, 1e-12);
  EXPECT_NEAR(axial(result.after[2]), axial(result.before[2]), 1e-9);
}

TEST(LimitOmega, CountsActionsAndEnergy)
{
  double error = 0.0;
  for (const char *options : {"", "component axial", "component transverse"}) {
    const Limited result = run_limited(options);
    const Table &thermo = result.thermo;
    ASSERT_GE(thermo.rows.size(), 2u);
    const size_t last = thermo.rows.size() - 1;
    const double lost = thermo.rows[0].back() - thermo.rows[last].back();
    error = std::max(error, std::fabs(thermo.rows[last][2] / lost - 1.0));
    EXPECT_GE(thermo.rows[last][1], 1.0);
    double expected_energy = 0.0;
    for (const Rod &rod : result.before)
      expected_energy += 0.5 * dot(rod.omega, rod.angular_momentum());
    EXPECT_NEAR(thermo.rows[0].back(), expected_energy, 1e-14 * expected_energy);
  }
  // Differences of energies: round-off over the fraction removed.
  expect_holds({"limit/omega: energy removed, relative", "loss seen by compute erotate", 1e-12},
               error);
}

// The per-rod sums add up to the global ones, on any number of ranks.
TEST(LimitOmega, TellsWhichRods)
{
  for (const int ranks : {1, 2}) {
    const Limited result = run_limited("", ranks);
    const std::vector<double> &last = result.thermo.rows.back();
    double times = 0.0, energy = 0.0, most = 0.0, most_id = 0.0;
    for (const std::vector<double> &row : result.of_rods.atoms.rows) {
      times += row[1];
      energy += row[2];
      if (row[1] > most) {
        most = row[1];
        most_id = row[0];
      }
    }
    EXPECT_EQ(times, last[1]);
    EXPECT_NEAR(energy, last[2], 1e-14 * energy);
    EXPECT_EQ(most, last[4]);
    EXPECT_EQ(most_id, last[5]);
    EXPECT_EQ(result.of_rods.atoms.rows[0][1], 0.0) << "rod 1 turns slower than the limit";
    EXPECT_GE(most, 1.0);
  }
}

// Free rods keep what the limit leaves them: two of the three are limited once, and never again
// for being above it by rounding.
TEST(LimitOmega, RoundingIsNoAction)
{
  const Limited result = run_limited("", 1, kLimit, 10000);
  EXPECT_EQ(result.thermo.rows.back()[1], 2.0);
  EXPECT_EQ(result.thermo.rows.back()[4], 1.0);
}

TEST(LimitOmega, IsIdleBelowTheLimit)
{
  const Limited result = run_limited("", 1, 1000.0);
  for (const std::vector<double> &line : result.thermo.rows)
    for (const size_t column : {1, 2, 3, 4, 5}) EXPECT_EQ(line[column], 0.0);
  for (size_t i = 0; i < result.before.size(); i++)
    EXPECT_NEAR(norm(result.after[i].angular_momentum() - result.before[i].angular_momentum()), 0.0,
                1e-14 * norm(result.before[i].angular_momentum()));
}

}  // namespace
