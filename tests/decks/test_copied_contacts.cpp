// SPDX-License-Identifier: GPL-2.0-or-later
// Friction that holds a rod goes on to hold it when rod and supports are turned or copied together.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

constexpr double kGravity = 9.81, kSlope = 0.3;  // of gravity's direction, below friction's 0.5

// Rod 3 lies across the frozen rods 1 and 2; gravity pulls it along its axis, friction holds it.
Scene held_rod(const std::string &boundary)
{
  Scene scene;
  scene.boundary = boundary;
  for (const double x : {-0.03, 0.03}) {
    Rod rod;
    rod.position = {x, 0.0, 0.0};
    rod.axis = {0.0, 1.0, 0.0};
    scene.rods.push_back(rod);
  }
  Rod rod;
  rod.position = {0.0, 0.0, 0.009995};
  scene.rods.push_back(rod);
  scene.physics = linear_material(2e4, 5.7e3, 0.3, 0.5) + rod_pair("linear tangential history") +
                  "group supports id 1 2\ngroup held id 3\nfix still supports freeze\n"
                  "fix motion held nve/spherocylinder\n";
  scene.dt = 1e-5;
  return scene;
}

std::string gravity(const std::string &direction)
{
  return fmt::format("fix pull all gravity {} vector {}\n", kGravity, direction);
}

// The rods with their forces a step after `command`.
Table forces_after(const Scene &scene, const std::string &command, int ranks, std::string *said)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  std::string start = preamble(scene);
  if (ranks == 2) start.insert(start.find("newton"), "processors 2 1 1\n");
  folder.write("in.held", start + "read_data rods.data\nneighbor 0.02 bin\nneigh_modify delay 0\n" +
                              scene.physics + gravity(fmt::format("{} 0 -1", kSlope)) +
                              "timestep 1e-5\nthermo_modify lost error\nrun 10000\n" + command +
                              exact_dump("dump.end", 1, "id x y z fx fy fz") + "run 1\n");
  const Outcome outcome = folder.run("in.held", {Program::Lmp, ranks, 60});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (said) *said = outcome.output;
  return read_dump(folder / "dump.end").back().atoms;
}

// What would pull a rod without friction.
double pull(const Scene &scene)
{
  return scene.rods.back().mass() * kGravity * kSlope / std::sqrt(1.0 + kSlope * kSlope);
}

}  // namespace

class CopiedContacts : public testing::TestWithParam<int> {};

// All and gravity by a quarter of a turn: in equilibrium before, in equilibrium after.
TEST_P(CopiedContacts, SpringsTurnWithTheRods)
{
  const Scene scene = held_rod("f f f");
  std::string said;
  const Table rods = forces_after(scene,
                                  "displace_atoms all rotate 0.1 0.05 0 0 0 1 90 units box\n"
                                  "unfix pull\n" +
                                      gravity(fmt::format("0 {} -1", kSlope)),
                                  GetParam(), &said);
  for (const char *component : {"fx", "fy", "fz"})
    EXPECT_NEAR(rods.at(2, component), 0.0, 1e-6 * pull(scene)) << component;
  EXPECT_EQ(said.find("begin anew"), std::string::npos) << said;
}

// One turned without the others: its contacts begin anew, and that is said. In the step after, it is held
// by what has come since only, the dashpot above all.
TEST_P(CopiedContacts, SpringsToOthersAreForgotten)
{
  const Scene scene = held_rod("f f f");
  std::string said;
  const Table rods = forces_after(
      scene, "displace_atoms held rotate 0 0 0 0 0 1 1.0e-6 units box\n", GetParam(), &said);
  EXPECT_NE(said.find("2 contacts with rods that are not turned and 0 of rods with walls"),
            std::string::npos)
      << said;
  EXPECT_NEAR(rods.at(2, "fx"), pull(scene), 0.01 * pull(scene));
}

// The same of a rod that lies on a floor.
TEST_P(CopiedContacts, SpringsToWallsAreForgotten)
{
  Scene scene = held_rod("f f f");
  scene.physics += rod_wall("floor", "linear tangential history", "type 1 zplane 0.0");
  scene.rods[0].position.z = scene.rods[1].position.z = 0.5;
  scene.rods[2].position.z = 0.004998;
  std::string said;
  const Table rods = forces_after(scene, "displace_atoms all rotate 0 0 0 0 0 1 1.0e-6 units box\n",
                                  GetParam(), &said);
  EXPECT_NE(said.find("0 contacts with rods that are not turned and 1 of rods with walls"),
            std::string::npos)
      << said;
  EXPECT_NEAR(rods.at(2, "fx"), pull(scene), 0.01 * pull(scene));
}

// Two copies beside each other, each held by its own springs; ids go on from the highest one.
TEST_P(CopiedContacts, CopiesAreHeldByTheirOwn)
{
  const Scene scene = held_rod("f f f");
  const Table rods =
      forces_after(scene, "replicate 2 1 1 offset 0.4 2.0 2.0 shift 0 0 0\n", GetParam(), nullptr);
  ASSERT_EQ(rods.rows.size(), 6u);
  for (size_t k = 0; k < 6; k++) EXPECT_EQ(rods.at(k, "id"), k + 1.0);
  for (const size_t k : {2u, 5u})
    for (const char *component : {"fx", "fy", "fz"})
      EXPECT_NEAR(rods.at(k, component), 0.0, 1e-6 * pull(scene))
          << component << " of rod " << k + 1;
  EXPECT_NEAR(rods.at(5, "x") - rods.at(2, "x"), 0.4, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(, CopiedContacts, testing::Values(1, 2),
                         [](const auto &info) { return fmt::format("Ranks{}", info.param); });
