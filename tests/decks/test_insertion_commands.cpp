// SPDX-License-Identifier: GPL-2.0-or-later
// insert/pack, insert/rate/region and insert/stream with rods: how many, how fast, how they lie and turn.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/rotation.h"
#include "scene.h"

using namespace decks;

namespace {

const char *const kFace = R"(solid face
facet normal 0 0 1
 outer loop
  vertex -0.06 -0.06 0.2
  vertex 0.06 -0.06 0.2
  vertex 0.06 0.06 0.2
 endloop
endfacet
facet normal 0 0 1
 outer loop
  vertex -0.06 -0.06 0.2
  vertex 0.06 0.06 0.2
  vertex -0.06 0.06 0.2
 endloop
endfacet
endsolid face
)";

// `grid`: the word after `processors` on several ranks.
std::string deck_with(const std::string &commands, int ranks, double length = 0.03,
                      const std::string &grid = "1 2 1")
{
  return fmt::format(R"(atom_style spherocylinder
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
{}region box block -0.2 0.2 -0.2 0.2 -0.4 0.4 units box
create_box 1 box
neighbor 0.02 bin
neigh_modify delay 0
{}{}timestep 2e-5
fix motion all nve/spherocylinder
fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 &
  radius constant 0.005 length constant {}
fix rods all particledistribution/discrete 32452843 1 rod 1.0
thermo 50
{})",
                     ranks > 1 ? "processors " + grid + "\n" : "",
                     linear_material(1e5, 1e5, 0.5, 0.2), rod_pair("linear tangential history"),
                     length, commands);
}

Outcome run_deck(const DeckFolder &folder, const std::string &commands, int ranks,
                 double length = 0.03, const std::string &grid = "1 2 1")
{
  folder.write("face.stl", kFace);
  folder.write("in.insert", deck_with(commands, ranks, length, grid));
  return folder.run("in.insert", {Program::Lmp, ranks});
}

constexpr const char *kColumns =
    "id z vx vy vz omegax omegay omegaz angmomx angmomy angmomz quat1 quat2 quat3 quat4";

Vec3 axis_of_row(const Table &rods, size_t row)
{
  return spherocylinder::axis_of(
      {rods.at(row, "quat1"), rods.at(row, "quat2"), rods.at(row, "quat3"), rods.at(row, "quat4")});
}

class Insertions : public testing::TestWithParam<int> {};

// Rods along z that leave the face turn about x with the given omega, and their axes with them:
// released when they pass the face at z = 0.2, so that the angle is omega (0.2 - z) / v.
TEST_P(Insertions, RodsFromAStreamTurn)
{
  const DeckFolder folder;
  const Outcome outcome = run_deck(folder, R"(fix face all mesh/surface/planar file face.stl type 1
fix pour all insert/stream seed 86028121 distributiontemplate rods nparticles 2 &
  particlerate 1000 overlapcheck yes all_in no orientation constant 1 0 0 0 &
  vel constant 0. 0. -1.0 omega constant 40. 0. 0. insertion_face face extrude_length 0.1
)" + exact_dump("dump.rods", 2500, kColumns) + "run 10000\n",
                                   GetParam());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto snapshots = read_dump(folder / "dump.rods");
  const Table &rods = snapshots.back().atoms;
  ASSERT_EQ(rods.rows.size(), 2u);
  const double inertia = spherocylinder::mass_properties(0.01, 0.03, 2700.0).inertia_transverse;
  for (size_t row = 0; row < 2; row++) {
    EXPECT_NEAR(rods.at(row, "omegax"), 40.0, 1e-10);
    EXPECT_NEAR(rods.at(row, "angmomx"), 40.0 * inertia, 1e-12 * inertia);
    // Released at a step's end: to within one step's angle, 40 * 2e-5.
    const double angle = 40.0 * (0.2 - rods.at(row, "z")) / 1.0;
    EXPECT_NEAR(
        std::fabs(dot(axis_of_row(rods, row), Vec3{0.0, -std::sin(angle), std::cos(angle)})), 1.0,
        1e-5);
  }
  // Before their release they neither turn nor are turned.
  for (size_t row = 0; row < snapshots[1].atoms.rows.size(); row++)
    if (snapshots[1].atoms.at(row, "z") > 0.2) {
      EXPECT_EQ(snapshots[1].atoms.at(row, "omegax"), 0.0);
      EXPECT_EQ(axis_of_row(snapshots[1].atoms, row).z, 1.0);
    }
}

// insert/pack and insert/rate/region give velocity and spin at once.
TEST_P(Insertions, VelocityAndSpinAreGiven)
{
  for (const char *inserter :
       {"insert/pack seed 86028121 distributiontemplate rods insert_every once region feed "
        "particles_in_region 20",
        "insert/rate/region seed 86028121 distributiontemplate rods nparticles 20 particlerate 1e6 "
        "insert_every 1 region feed"}) {
    std::string command = std::string("fix pour all ") + inserter;
    const size_t at = command.find(" region feed");
    command.insert(at, " overlapcheck yes orientation constant 0.9239 0 0.3827 0 all_in no "
                       "vel constant 1 2 3 omega constant 0 30 0");
    const DeckFolder folder;
    const Outcome outcome =
        run_deck(folder,
                 "region feed block -0.1 0.1 -0.1 0.1 -0.1 0.1 units box\n" + command + "\n" +
                     exact_dump("dump.rods", 1, kColumns) + "run 1\n",
                 GetParam());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const Table rods = read_dump(folder / "dump.rods").back().atoms;
    ASSERT_EQ(rods.rows.size(), 20u);
    for (size_t row = 0; row < 20; row++) {
      EXPECT_EQ(rods.at(row, "vy"), 2.0);
      EXPECT_NEAR(rods.at(row, "omegay"), 30.0, 1e-12);
      // z turned about y by 45 degrees, to the four digits given. Rods enter a step after it has
      // moved the others.
      const double angle = 2.0 * std::atan2(0.3827, 0.9239);
      EXPECT_LT(norm(axis_of_row(rods, row) - Vec3{std::sin(angle), 0.0, std::cos(angle)}), 1e-12);
    }
  }
}

// The share of the region's volume that rods fill is asked for; they leave downward at 20 m/s and
// the region is filled again every 50 steps. Wanted there after each insertion: f V / V_rod,
// rounded at random.
TEST_P(Insertions, ARegionIsKeptAtItsVolumeFraction)
{
  const DeckFolder folder;
  const Outcome outcome =
      run_deck(folder, R"(region feed block -0.15 0.15 -0.15 0.15 -0.1 0.1 units box
fix pour all insert/pack seed 86028121 distributiontemplate rods insert_every 50 maxattempt 500 &
  overlapcheck yes orientation random all_in no vel constant 0.0 0.0 -20.0 region feed &
  volumefraction_region 0.01
compute z all reduce max z
dump d all custom 1 dump.rods id z
run 51
run 250
)",
               GetParam());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const double volume = spherocylinder::mass_properties(0.01, 0.03, 1.0).volume;
  const double wanted = 0.01 * 0.3 * 0.3 * 0.2 / volume;
  int checked = 0;
  for (const Snapshot &snapshot : read_dump(folder / "dump.rods")) {
    if (snapshot.step % 50 != 1) continue;  // the steps of insertion
    int inside = 0;
    for (size_t row = 0; row < snapshot.atoms.rows.size(); row++)
      inside += std::fabs(snapshot.atoms.at(row, "z")) <= 0.1;
    EXPECT_NEAR(inside, wanted, 1.0) << snapshot.step;
    checked++;
  }
  EXPECT_GE(checked, 6);
}

// The same of a mass and of a number of rods.
TEST_P(Insertions, ARegionIsKeptAtItsMassAndNumber)
{
  const auto properties = spherocylinder::mass_properties(0.01, 0.03, 2700.0);
  for (const std::string &amount : {fmt::format("mass_in_region {}", 40.2 * properties.mass),
                                    std::string("particles_in_region 40")}) {
    const DeckFolder folder;
    const Outcome outcome =
        run_deck(folder,
                 "region feed block -0.15 0.15 -0.15 0.15 -0.1 0.1 units box\n"
                 "fix pour all insert/pack seed 86028121 distributiontemplate rods insert_every 50 "
                 "maxattempt 500 overlapcheck yes orientation random all_in no "
                 "vel constant 0.0 0.0 -20.0 region feed " +
                     amount + "\ndump d all custom 1 dump.rods id z\nrun 201\n",
                 GetParam());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    for (const Snapshot &snapshot : read_dump(folder / "dump.rods")) {
      if (snapshot.step % 50 != 1) continue;
      int inside = 0;
      for (size_t row = 0; row < snapshot.atoms.rows.size(); row++)
        inside += std::fabs(snapshot.atoms.at(row, "z")) <= 0.1;
      EXPECT_NEAR(inside, 40, 1.0) << amount << ", step " << snapshot.step;
    }
  }
}

// LIGGGHTS's atoi takes 2e1 for 2.
TEST_P(Insertions, WholeNumbersMayBeWrittenAsOthers)
{
  const DeckFolder folder;
  const Outcome outcome = run_deck(
      folder,
      "region feed block -0.1 0.1 -0.1 0.1 -0.1 0.1 units box\nfix pour all insert/pack seed "
      "86028121 distributiontemplate rods insert_every once overlapcheck yes all_in no "
      "maxattempt 1.0e2 region feed particles_in_region 2e1\n" +
          exact_dump("dump.rods", 1, kColumns) + "run 1\n",
      GetParam());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(read_dump(folder / "dump.rods").back().atoms.rows.size(), 20u);
}

INSTANTIATE_TEST_SUITE_P(, Insertions, testing::Values(1, 2));

// Two ranks' parts of a region 0.08 wide, cut in its middle: of rods 0.07 long, no centre finds a
// place nearer than 0.035 to the cut, 7/8 of the region.
TEST(InsertionAtBorders, SaysHowMuchOfTheRegionIsOutOfUse)
{
  const std::string pack = R"(region feed block -0.1 0.1 -0.04 0.04 -0.1 0.1 units box
fix pour all insert/pack seed 86028121 distributiontemplate rods insert_every once maxattempt 20 &
  overlapcheck yes orientation random all_in no vel constant 0.0 0.0 0.0 region feed &
  particles_in_region 100
run 1
)";
  const DeckFolder folder;
  const Outcome outcome = run_deck(folder, pack, 2, 0.07);
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("of 100 rods (no centre was tried in 8"), std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("fewer processors"), std::string::npos);
}

std::string error_of(const std::string &command, int ranks = 1)
{
  const DeckFolder folder;
  const Outcome outcome = run_deck(
      folder,
      "region feed block -0.1 0.1 -0.1 0.1 -0.1 0.1 units box\nfix pour all insert/pack seed "
      "86028121 distributiontemplate rods insert_every once overlapcheck yes all_in no " +
          command + "\nrun 1\n",
      ranks);
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_LT(outcome.exit_code, 128);
  const size_t at = outcome.output.find("ERROR");
  return at == std::string::npos ? outcome.output : outcome.output.substr(at, 300);
}

TEST(InsertionCommand, RefusesWhatItCannotMean)
{
  const std::string rest = " region feed particles_in_region 5";
  EXPECT_NE(error_of("vel constant 0,5 0 0" + rest).find("vel must be a number (got 0,5)"),
            std::string::npos);
  EXPECT_NE(error_of("omega constant fast 0 0" + rest).find("omega must be a number (got fast)"),
            std::string::npos);
  EXPECT_NE(error_of("orientation constant 0.7 0.7 0 0.7" + rest).find("must have length 1"),
            std::string::npos);
  EXPECT_NE(
      error_of("region feed particles_in_region many").find("particles_in_region must be a number"),
      std::string::npos);
  EXPECT_NE(
      error_of("region feed particles_in_region 2.5").find("must be a whole number (got 2.5)"),
      std::string::npos);
  EXPECT_NE(error_of("compress_tags yes" + rest).find("compress_tags yes"), std::string::npos);
  EXPECT_NE(error_of("check_dist_from_subdomain_border no" + rest, 2).find("needs one rank"),
            std::string::npos);
}

}  // namespace
