// SPDX-License-Identifier: GPL-2.0-or-later
// fix check/timestep/spherocylinder on a rod at rest on a plane: the bound it states, its warning and
// its error.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "scene.h"

using namespace decks;

namespace {

constexpr double kKn = 2e5, kKt = 1e5;  // N/m

Outcome run_resting_rod(const DeckFolder &folder, const std::string &options, int ranks = 1,
                        bool beside_a_frozen_one = false)
{
  Scene scene;
  Rod rod;
  rod.position.z = rod.radius() - rod.mass() * 9.81 / (2.0 * kKn);  // the static sink
  rod.position.x = 0.3;
  scene.rods.push_back(rod);
  if (beside_a_frozen_one) {
    Rod frozen;
    frozen.type = scene.types = 2;
    frozen.density = 27.0;
    frozen.position = {-0.3, 0.0, 0.02};
    frozen.axis = {0.0, 0.0, 1.0};
    scene.rods.push_back(frozen);
  }
  folder.write("rods.data", data_file(scene));
  folder.write("in.check",
               preamble(scene, ranks > 1 ? Mode::TwoRanks : Mode::OneRank) + R"(read_data rods.data
neighbor 0.02 bin
)" + linear_material(kKn, kKt, 0.5, 0.2, scene.types) +
                   rod_pair("linear tangential history") +
                   fmt::format(R"(fix floor all wall/gran model linear tangential history &
  surface spherocylinder primitive type 1 zplane 0.0
fix gravity all gravity 9.81 vector 0.0 0.0 -1.0
group frozen type 2
group loose subtract all frozen
{}fix motion loose nve/spherocylinder
fix check all check/timestep/spherocylinder {}
timestep 2e-5
thermo_style custom step f_check[1] f_check[2] f_check[3]
thermo_modify norm no format float %.17g
thermo 10
run 10
)",
                               beside_a_frozen_one ? "fix hold frozen freeze\n" : "", options));
  return folder.run("in.check", {Program::Lmp, ranks});
}

// Closed form: the trace of I^-1 K over both ends, each with a normal spring and two tangential ones.
// For the normal at +-a on the axis: 1/m + a^2/I_t. Across the axis in the plane: 1/m + a^2/I_t
// + c^2/I_a; along the axis: 1/m + c^2/I_t, with c the height of the axis over the contact point.
double stable_step()
{
  const Rod rod;
  const auto properties = rod.properties();
  const double m = rod.mass(), I_t = properties.inertia_transverse, I_a = properties.inertia_axial;
  const double a = rod.half_cylinder();
  // Contact point: midway in the overlap.
  const double c = rod.radius() - 0.5 * m * 9.81 / (2.0 * kKn);
  const double trace = 2.0 * (kKn * (1.0 / m + a * a / I_t) +
                              kKt * (2.0 / m + a * a / I_t + c * c / I_a + c * c / I_t));
  return 2.0 / std::sqrt(trace);
}

}  // namespace

TEST(CheckTimestep, StatesTheStableStepOfARestingRod)
{
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    const Outcome outcome = run_resting_rod(folder, "10 0.5", ranks);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    // Step, fraction, stable step, contacts.
    const auto row = read_thermo(outcome.output).rows.back();
    EXPECT_NEAR(row[2], stable_step(), 1e-6 * stable_step()) << ranks << " ranks";
    EXPECT_NEAR(row[1], 2e-5 / stable_step(), 1e-6);
    EXPECT_EQ(row[3], 2.0);
    EXPECT_EQ(outcome.output.find("WARNING: Fix check/timestep"), std::string::npos);
  }
}

// A frozen rod, light and deep in the floor, does not swing, and where it was placed is no impact.
TEST(CheckTimestep, LeavesFrozenRodsOut)
{
  const DeckFolder folder;
  const Outcome outcome = run_resting_rod(folder, "10 0.5", 1, true);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NEAR(read_thermo(outcome.output).rows.back()[2], stable_step(), 1e-6 * stable_step());
  EXPECT_EQ(outcome.output.find("WARNING: Rod contacts"), std::string::npos) << outcome.output;
}

TEST(CheckTimestep, WarnsOnceAndStopsIfAsked)
{
  const DeckFolder folder;
  const Outcome warned = run_resting_rod(folder, "1 0.01");
  EXPECT_EQ(warned.exit_code, 0);
  const std::string sentence =
      "WARNING: Fix check/timestep/spherocylinder (id check): time step 2e-05";
  const size_t first = warned.output.find(sentence);
  ASSERT_NE(first, std::string::npos) << warned.output;
  EXPECT_EQ(warned.output.find(sentence, first + 1), std::string::npos);

  const DeckFolder other;
  const Outcome stopped = run_resting_rod(other, "1 0.01 error yes");
  EXPECT_NE(stopped.exit_code, 0);
  EXPECT_NE(stopped.output.find("allowed is 0.01 of it"), std::string::npos) << stopped.output;

  const DeckFolder quiet;
  const Outcome silent = run_resting_rod(quiet, "1 0.01 warn no");
  EXPECT_EQ(silent.output.find("WARNING: Fix check"), std::string::npos);
}
