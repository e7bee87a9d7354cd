// SPDX-License-Identifier: GPL-2.0-or-later
// Rods placed by hand, create_atoms and set: size, density, orientation and spin are what the deck says,
// and mass and inertia belong to them (closed forms), before the next run, in it and in files.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/rotation.h"
#include "scene.h"

using namespace decks;

namespace {

// As many atom types as the deck uses.
std::string preamble_of_box(const std::string &commands, int ranks)
{
  const int types = commands.find("create_atoms 2") == std::string::npos ? 1 : 2;
  return fmt::format(R"(atom_style spherocylinder
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
{}region box block -1 1 -1 1 -1 1 units box
create_box {} box
neighbor 0.02 bin
neigh_modify delay 0
{}{}timestep 1e-6
fix motion all nve/spherocylinder
)",
                     ranks > 1 ? "processors 2 1 1\n" : "", types,
                     linear_material(1e5, 1e5, 0.5, 0.2, types),
                     rod_pair("linear tangential history"));
}

constexpr const char *kColumns =
    "id type x y z vx mass shapex shapez radius diameter density quat1 quat2 quat3 quat4 omegax omegay omegaz "
    "angmomx angmomy angmomz inertiax inertiaz";

// The rods after `commands` and a run of one step of 1e-6 s.
Table rods_after(const std::string &commands, int ranks, const std::string &end = "run 0\n")
{
  const DeckFolder folder;
  folder.write("in.set", preamble_of_box(commands, ranks) + commands +
                             exact_dump("dump.rods", 1, kColumns) + end);
  const Outcome outcome = folder.run("in.set", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return {};
  return read_dump(folder / "dump.rods").back().atoms;
}

std::string error_of(const std::string &commands, int ranks = 1)
{
  const DeckFolder folder;
  folder.write("in.set", preamble_of_box(commands, ranks) + commands + "run 0\n");
  const Outcome outcome = folder.run("in.set", {Program::Lmp, ranks});
  EXPECT_NE(outcome.exit_code, 0) << commands;
  EXPECT_LT(outcome.exit_code, 128) << outcome.output;
  const size_t at = outcome.output.find("ERROR");
  return at == std::string::npos ? outcome.output : outcome.output.substr(at, 300);
}

Vec3 axis_of_row(const Table &rods, size_t row)
{
  return spherocylinder::axis_of(
      {rods.at(row, "quat1"), rods.at(row, "quat2"), rods.at(row, "quat3"), rods.at(row, "quat4")});
}

void expect_rod(const Table &rods, size_t row, double diameter, double length, double density)
{
  const auto wanted = spherocylinder::mass_properties(diameter, length, density);
  EXPECT_DOUBLE_EQ(rods.at(row, "shapex"), 0.5 * diameter);
  EXPECT_DOUBLE_EQ(rods.at(row, "diameter"), diameter);
  EXPECT_DOUBLE_EQ(rods.at(row, "shapez"), 0.5 * length);
  EXPECT_DOUBLE_EQ(rods.at(row, "radius"), 0.5 * length);
  EXPECT_DOUBLE_EQ(rods.at(row, "density"), density);
  EXPECT_DOUBLE_EQ(rods.at(row, "mass"), wanted.mass);
  EXPECT_DOUBLE_EQ(rods.at(row, "inertiax"), wanted.inertia_transverse);
  EXPECT_DOUBLE_EQ(rods.at(row, "inertiaz"), wanted.inertia_axial);
}

class SetOnRanks : public testing::TestWithParam<int> {};

TEST_P(SetOnRanks, RodsAreMadeByHand)
{
  const Table rods = rods_after(R"(create_atoms 1 single -0.5 0 0.2 units box
create_atoms 2 single 0.5 0.1 0.2 units box
set atom 1 diameter 0.01 length 0.08 density 2700 axis 0 3 4
set type 2 shape 0.02 0.02 0.15 density 1200 quat 1 0 0 90 omegaz 5 vx 0.3
)",
                                GetParam());
  ASSERT_EQ(rods.rows.size(), 2u);
  expect_rod(rods, 0, 0.01, 0.08, 2700.0);
  expect_rod(rods, 1, 0.04, 0.3, 1200.0);
  EXPECT_LT(norm(axis_of_row(rods, 0) - Vec3{0.0, 0.6, 0.8}), 1e-14);
  // z turned about x by a quarter turn.
  EXPECT_LT(norm(axis_of_row(rods, 1) - Vec3{0.0, -1.0, 0.0}), 1e-14);
  EXPECT_EQ(rods.at(1, "vx"), 0.3);
  // Its axis is y: spin about z is about a transverse axis.
  const auto wanted = spherocylinder::mass_properties(0.04, 0.3, 1200.0);
  EXPECT_NEAR(rods.at(1, "angmomz"), 5.0 * wanted.inertia_transverse,
              1e-14 * wanted.inertia_transverse);
}

TEST_P(SetOnRanks, RodsFromALatticeTakeVariables)
{
  const Table rods = rods_after(R"(lattice sc 0.5
region inner block -0.9 0.9 -0.9 0.9 -0.1 0.1 units box
create_atoms 1 region inner
variable d atom 0.01+0.002*id
variable l atom 10*v_d
variable rho equal 1500
variable angle atom 10*id
set group all diameter v_d length v_l density v_rho quat 0 1 0 v_angle
)",
                                GetParam());
  ASSERT_EQ(rods.rows.size(), 9u);
  for (size_t row = 0; row < 9; row++) {
    const double id = rods.at(row, "id"), diameter = 0.01 + 0.002 * id;
    expect_rod(rods, row, diameter, 10.0 * diameter, 1500.0);
    const double angle = degrees(10.0 * id);
    EXPECT_LT(norm(axis_of_row(rods, row) - Vec3{std::sin(angle), 0.0, std::cos(angle)}), 1e-14);
  }
}

// A rod made by hand turns as its closed form says: about its axis of omega, transverse to the
// axis.
TEST_P(SetOnRanks, ARodMadeByHandTurns)
{
  const Table rods = rods_after(R"(create_atoms 1 single 0.3 0 0 units box
set atom 1 diameter 0.01 length 0.1 density 2700 axis 1 0 0 omegaz 50
)",
                                GetParam(), "run 1000\n");
  const double angle = 50.0 * 1e-3;
  EXPECT_LT(norm(axis_of_row(rods, 0) - Vec3{std::cos(angle), std::sin(angle), 0.0}), 1e-12);
}

TEST_P(SetOnRanks, AngularMomentumGivesSpin)
{
  const Table rods = rods_after(R"(create_atoms 1 single 0.3 0 0 units box
set atom 1 diameter 0.02 length 0.1 density 1000 axis 1 0 0 angmom 1e-6 2e-6 0
)",
                                GetParam());
  const auto wanted = spherocylinder::mass_properties(0.02, 0.1, 1000.0);
  EXPECT_NEAR(rods.at(0, "omegax") * wanted.inertia_axial, 1e-6, 1e-18);
  EXPECT_NEAR(rods.at(0, "omegay") * wanted.inertia_transverse, 2e-6, 1e-18);
}

TEST_P(SetOnRanks, SizeChangesBetweenRuns)
{
  const Table rods = rods_after(R"(create_atoms 1 single -0.5 0 0 units box
create_atoms 1 single 0.5 0 0 units box
set group all diameter 0.01 length 0.05 density 2000 axis 0 1 0
run 10
set atom 2 diameter 0.06 length 0.2
set atom 1 density 900
)",
                                GetParam());
  expect_rod(rods, 0, 0.01, 0.05, 900.0);
  expect_rod(rods, 1, 0.06, 0.2, 2000.0);
}

TEST_P(SetOnRanks, FilesWrittenRightAfterHoldTheRod)
{
  const DeckFolder folder;
  folder.write("in.write",
               preamble_of_box("", GetParam()) + R"(create_atoms 1 single -0.5 0 0 units box
set atom 1 diameter 0.01 length 0.05 density 2000 axis 0 0.6 0.8 omegax 3
write_restart rod.restart
write_data rod.data
)");
  const Outcome written = folder.run("in.write", {Program::Lmp, GetParam()});
  ASSERT_EQ(written.exit_code, 0) << written.output;
  const std::string start =
      "atom_style spherocylinder\natom_modify map array\nboundary f f f\nnewton off\n"
      "communicate single vel yes\nunits si\n";
  const std::string rest = "neighbor 0.02 bin\n" + linear_material(1e5, 1e5, 0.5, 0.2) +
                           rod_pair("linear tangential history") +
                           "fix motion all nve/spherocylinder\n" +
                           exact_dump("dump.rods", 1, kColumns) + "run 0\n";
  for (const char *read : {"read_data rod.data\n", "read_restart rod.restart\n"}) {
    folder.write("in.read", start + read + rest);
    const Outcome outcome = folder.run("in.read");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const Table rods = read_dump(folder / "dump.rods").back().atoms;
    expect_rod(rods, 0, 0.01, 0.05, 2000.0);
    EXPECT_LT(norm(axis_of_row(rods, 0) - Vec3{0.0, 0.6, 0.8}), 1e-14);
    EXPECT_EQ(rods.at(0, "omegax"), 3.0);
  }
}

INSTANTIATE_TEST_SUITE_P(, SetOnRanks, testing::Values(1, 2));

// By place, not by rank: the same axes on one and two ranks. Uniform on the sphere: the mean of
// u_z^2 over n rods is 1/3 with standard deviation sqrt(4/45/n).
TEST(Set, RandomAxesAreUniformAndDoNotDependOnRanks)
{
  const std::string commands = R"(create_atoms 1 random 10007 10007 NULL
set group all diameter 0.0001 length 0.001 density 2000 quat/random 4711
)";
  Table one = rods_after(commands, 1), two = rods_after(commands, 2);
  ASSERT_EQ(one.rows.size(), two.rows.size());
  // create_atoms numbers the rods by rank: find them by their x.
  for (Table *table : {&one, &two})
    std::sort(table->rows.begin(), table->rows.end(),
              [](const auto &a, const auto &b) { return a[2] < b[2]; });
  double sum = 0.0;
  for (size_t row = 0; row < one.rows.size(); row++) {
    EXPECT_EQ(norm(axis_of_row(one, row) - axis_of_row(two, row)), 0.0);
    sum += std::pow(axis_of_row(one, row).z, 2);
  }
  const double n = static_cast<double>(one.rows.size());
  EXPECT_EQ(n, 10007.0);
  EXPECT_NEAR(sum / n, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / n));
}

TEST(Set, SaysWhatIsMissingOrWrong)
{
  const std::string create = "create_atoms 1 single 0 0 0 units box\n";
  const struct {
    const char *commands, *says;
  } cases[] = {
      {"", "rod 1, made by create_atoms, has no diameter"},
      {"set atom 1 diameter 0.01 density 2700\n", "has no length"},
      {"set atom 1 length 0.01\n", "has no diameter"},
      {"set atom 1 diameter 0.01 length 0.005\n", "must be >= the diameter 0.01 (got 0.005)"},
      {"set atom 1 diameter -0.01 length 0.005\n", "diameter of rod 1 must be > 0 (got -0.01)"},
      {"set atom 1 shape 0.01 0.02 0.1\n", "shape of rod 1 must be r r L/2"},
      {"set atom 1 axis 0 0 0\n", "axis of rod 1 wants a direction"},
      {"set atom 1 axis 0 0\n", "axis wants 3 values (got 2)"},
      {"set atom 1 quat_direct 0.7 0.7 0 0.7\n", "must have length 1"},
      {"set atom 1 angmom 0 0 1\n", "wants its diameter, length and density first"},
      {"set atom 1 volume 1\n", "volume cannot be set for rods"},
      {"set atom 1 inertiax 1\n", "inertiax cannot be set for rods"},
      {"set atom 1 blockiness 2 2\n", "blockiness cannot be set for rods"},
      {"set atom 1 aspect_ratio 1 2\n", "aspect_ratio cannot be set for rods"},
      {"set atom 1 colour 2\n", "unknown keyword colour"},
      {"set group big diameter 2\n", "group big does not exist"},
      {"set atom 1 diameter v_none\n", "variable none does not exist"},
      {"set atom 1 diameter 0,01\n", "diameter must be a number or a variable (got 0,01)"}};
  for (const auto &c : cases)
    EXPECT_NE(error_of(create + c.commands).find(c.says), std::string::npos)
        << c.commands << error_of(create + c.commands);
  EXPECT_NE(error_of(create, 2).find("has no diameter"), std::string::npos);
}

TEST(Set, NearlyUnitQuaternionsAreNormalised)
{
  const Table rods = rods_after(R"(create_atoms 1 single 0 0 0 units box
set atom 1 diameter 0.01 length 0.1 density 1000 quat_direct 0.7071 0.7071 0 0
)",
                                1);
  EXPECT_NEAR(rods.at(0, "quat1"), std::sqrt(0.5), 1e-15);
  EXPECT_LT(norm(axis_of_row(rods, 0) - Vec3{0.0, -1.0, 0.0}), 1e-15);
}

}  // namespace
