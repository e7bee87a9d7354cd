// SPDX-License-Identifier: GPL-2.0-or-later
// Each rod is moved by exactly one fix that turns its axis, or frozen; everything else is refused in one
// sentence.
#include <cmath>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

Scene two_rods(const std::string &integrators)
{
  Scene scene;
  for (int k = 0; k < 2; k++) {
    Rod rod;
    rod.position.y = 0.5 * k;
    rod.omega.y = 10.0;
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(2e4, 5.7e3, 0.5, 0.2) + rod_pair("linear tangential history") +
                  "group a id 1\ngroup b id 2\n" + integrators;
  scene.dt = 2e-5;
  scene.steps = 2500;
  return scene;
}

Outcome outcome_of(const Scene &scene, int ranks = 1)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.rods", preamble(scene) + "read_data rods.data\n" + scene.physics +
                              "timestep 2e-5\nrun 10\n");
  return folder.run("in.rods", {Program::Lmp, ranks, 60});
}

struct Wrong {
  const char *name, *integrators, *says;
};

void PrintTo(const Wrong &wrong, std::ostream *out) { *out << wrong.integrators; }

class WrongIntegrator : public testing::TestWithParam<Wrong> {};

TEST_P(WrongIntegrator, IsRefused)
{
  const Outcome outcome = outcome_of(two_rods(GetParam().integrators));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find(GetParam().says), std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("Loop time"), std::string::npos) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(
    , WrongIntegrator,
    testing::Values(
        Wrong{"NveOnAPart", "fix m1 a nve/spherocylinder\nfix m2 b nve\n", "ix nve (id m2)"},
        Wrong{"NveAlone", "fix m2 all nve\n", "ix nve (id m2)"},
        Wrong{"NveSphere", "fix m1 a nve/spherocylinder\nfix m2 b nve/sphere\n", "ix nve/sphere"},
        Wrong{"NveLimit", "fix m1 a nve/spherocylinder\nfix m2 b nve/limit radius_ratio 0.1\n",
              "ix nve/limit"},
        Wrong{"NveNoforce", "fix m1 a nve/spherocylinder\nfix m2 b nve/noforce\n",
              "ix nve/noforce"},
        Wrong{"NoneOnAPart", "fix m1 a nve/spherocylinder\n",
              "1 rods (the first is rod 2) are in no integrator's group"},
        Wrong{"Two", "fix m1 all nve/spherocylinder\nfix m2 b move linear 0 0 1\n",
              "a rod wants exactly one integrator"},
        Wrong{"Rigid", "fix m2 all rigid single\n", "ix rigid"}),
    [](const auto &info) { return std::string(info.param.name); });

TEST(Integrators, NoneOnAPartOfTwoRanks)
{
  const Outcome outcome = outcome_of(two_rods("fix m1 a nve/spherocylinder\n"), 2);
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("(the first is rod 2)"), std::string::npos) << outcome.output;
}

// By 10 rad/s about y for 0.05 s: half a radian.
TEST(Integrators, OneForEachRod)
{
  const Frame last =
      run(two_rods("fix m1 a nve/spherocylinder\nfix m2 b nve/spherocylinder\n")).back();
  for (const Rod &rod : last.rods)
    EXPECT_LT(norm(rod.axis - Vec3{std::cos(0.5), 0.0, -std::sin(0.5)}), 1e-10);
}

TEST(Integrators, FrozenAndDrivenRodsCount)
{
  const Frame last = run(two_rods("fix m1 a freeze\nfix m2 b move linear 0 0 1\n")).back();
  EXPECT_EQ(norm(last.rods[0].position), 0.0);
  EXPECT_NEAR(last.rods[1].position.z, 0.05, 1e-14);
}

// Between two runs rods are made, and handed from rank to rank, before they get their integrator.
TEST(Integrators, NewRodsMayWaitForOneBetweenRuns)
{
  for (const int ranks : {1, 2}) {
    const Outcome outcome = outcome_of(two_rods(R"(timestep 2e-5
group old id 1 2
fix motion old nve/spherocylinder
run 10
create_atoms 1 single 0.0 -0.5 0.0 units box
set atom 3 diameter 0.01 length 0.1 density 2700
displace_atoms all move 0.0 0.1 0.0 units box
group old id 3
)"),
                                       ranks);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
}

// LIGGGHTS would go on with its list of fixes by number, one of which is gone, and with a pair style, dump
// or columns that nobody has prepared.
TEST(Integrators, RunPreNoWantsTheSameStyles)
{
  for (const char *change :
       {"unfix down", "unfix push", "fix more all addforce 1.0 0.0 0.0", "pair_style none",
        "compute more all contact/spherocylinder", "dump more all custom 5 more.dump id fx",
        "thermo_style custom step ke"}) {
    const Outcome outcome = outcome_of(two_rods(std::string(R"(timestep 2e-5
fix motion all nve/spherocylinder
fix down all gravity 9.81 vector 0.0 0.0 -1.0
fix push all addforce 1.0 0.0 0.0
run 10
run 10 pre no
)") + change + "\nrun 10 pre no\n"));
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.output.find("Command run: pre no cannot be used after fix"),
              std::string::npos)
        << outcome.output;
  }
}

// Rods inserted into a group that nothing moves.
TEST(Integrators, NewRodsWantOneToo)
{
  const Outcome outcome = outcome_of(two_rods(R"(fix motion a nve/spherocylinder
fix hold b freeze
region above block -0.5 0.5 -0.9 -0.5 0.0 0.5 units box
fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 &
  radius constant 0.005 length constant 0.1
fix mix all particledistribution/discrete 32452843 1 rod 1.0
group others type 2
fix pack others insert/pack seed 86028121 distributiontemplate mix insert_every once &
  overlapcheck yes all_in no maxattempt 100 vel constant 0.0 0.0 0.0 region above particles_in_region 5
)"));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("has come into the run and is in no integrator's group"),
            std::string::npos)
      << outcome.output;
}

}  // namespace
