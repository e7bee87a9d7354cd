// SPDX-License-Identifier: GPL-2.0-or-later
// Contact histories follow their rods through whatever a deck does to the list of rods between two
// runs: what is left moves on as if nothing had happened, and nothing is pushed the wrong way.
#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

// Crossed rods in a stack, pressed together and sheared, so that springs and sides are all in use;
// four more far from it and from each other, among the ids of the stack's.
Scene stack()
{
  Scene scene;
  for (int k = 0; k < 10; k++) {
    Rod rod;
    const bool far = k == 0 || k == 3 || k == 7 || k == 8;
    const int level = k - (k > 0) - (k > 3) - (k > 7) - (k > 8);
    rod.axis = level % 2 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    rod.position = far ? Vec3{0.5, -0.4 + 0.1 * k, 0.4} : Vec3{0.003, 0.002, 0.0097 * level};
    if (!far) rod.velocity = Vec3{0.05 * level, 0.02 - 0.03 * level, 0.0};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(2e4, 5.7e3, 0.5, 0.4) + rod_pair("linear tangential history") +
                  rod_wall("floor", "linear tangential history", "type 1 zplane -0.0048") +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 2e-5;
  return scene;
}

std::string settings(const Scene &scene)
{
  return fmt::format("neighbor {} bin\nneigh_modify delay 0\n{}timestep {}\nthermo 20\n"
                     "thermo_modify norm no lost error\n",
                     scene.skin, scene.physics, scene.dt);
}

constexpr const char *kColumns = "id x y z vx vy vz omegax omegay omegaz quat1 quat2 quat3 quat4";

// The stack's rods at the end, from the lowest to the highest, 14 numbers each.
using Rows = std::vector<std::vector<double>>;

Rows near_rods(const DeckFolder &folder)
{
  Rows rows;
  const std::vector<Snapshot> snapshots = read_dump(folder / "dump.end");
  for (const std::vector<double> &row : snapshots.back().atoms.rows)
    if (row[1] < 0.3) rows.push_back({row.begin() + 1, row.end()});
  std::sort(rows.begin(), rows.end(), [](const auto &a, const auto &b) { return a[2] < b[2]; });
  return rows;
}

std::string last_run(const Scene &)
{
  return "run 20 post no\n" + exact_dump("dump.end", 1, kColumns) + "run 0\n";
}

std::string processors(int ranks)
{
  return ranks == 2 ? "processors 2 1 1\n" : ranks == 4 ? "processors 2 2 1\n" : "";
}

// Runs, does `commands`, runs on; `{restart}` among them is a restart there.
Outcome run_with_pause(const DeckFolder &folder, const std::string &commands, int ranks)
{
  const Scene scene = stack();
  folder.write("rods.data", data_file(scene));
  std::string start = preamble(scene);
  start.insert(start.find("newton"), processors(ranks));
  std::string middle = commands;
  const size_t restart = middle.find("{restart}");
  if (restart != std::string::npos)
    middle.replace(restart, 9,
                   "write_restart r\nclear\n" + start + "read_restart r\n" + settings(scene) +
                       "run 0\n");
  const std::string groups = "group first id 1\ngroup second id 4\ngroup both id 8 9\n"
                             "region corner block 0.4 0.6 -0.6 0.0 0.3 0.5 units box\n";
  folder.write("in.pause", start + "read_data rods.data\n" + settings(scene) + "run 40 post no\n" +
                               groups + middle + last_run(scene));
  return folder.run("in.pause", {Program::Lmp, ranks, 60});
}

struct Pause {
  const char *name, *commands;
};

void PrintTo(const Pause &pause, std::ostream *out) { *out << pause.name; }

constexpr const char *kInsertion =
    "region high block -0.2 0.2 -0.2 0.2 0.5 0.8 units box\n"
    "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
    "radius constant 0.005 length constant 0.1\n"
    "fix rods all particledistribution/discrete 32452843 1 rod 1.0\n"
    "fix pack all insert/pack seed 86028121 distributiontemplate rods insert_every once "
    "overlapcheck yes orientation random all_in yes region high particles_in_region 5\n";

// Deletions and the like that touch no rod of the stack.
const Pause kPauses[] = {
    {"Nothing", ""},
    {"Compress", "delete_atoms group first\n"},
    {"CompressTwice", "delete_atoms group first\ndelete_atoms region corner\n"},
    {"Keep", "delete_atoms group first compress no\n"},
    {"KeepTwice", "delete_atoms group first compress no\ndelete_atoms group second compress no\n"},
    {"KeepThenCompress",
     "delete_atoms group second compress no\ndelete_atoms group both compress yes\n"
     "delete_atoms group first compress no\n"},
    {"CompressThenKeep", "delete_atoms group both\ndelete_atoms group first compress no\n"},
    {"Porosity", "delete_atoms porosity corner 0.7 86028121\n"},
    {"Overlap", "delete_atoms overlap 0.12 both all\n"},
    {"OverlapThenGroup", "delete_atoms overlap 0.12 both all\ndelete_atoms group first\n"},
    {"RestartBetween", "delete_atoms group first\n{restart}\ndelete_atoms group second\n"},
    {"RestartAfter", "delete_atoms group first\ndelete_atoms group second\n{restart}\n"},
    {"BalanceBefore", "balance 1.0 shift x 10 1.01\ndelete_atoms group first\n"},
    {"BalanceAfter", "delete_atoms group first\nbalance 1.0 shift x 10 1.01\n"},
    {"WriteRestart", "write_restart r.tmp\ndelete_atoms group first\nwrite_restart r.tmp\n"},
    {"OtherLists", "compute near all coord/atom 0.1\ndump d all custom 10 d.tmp id c_near\n"},
    {"OtherListsAndDeletion",
     "compute near all coord/atom 0.1\ndelete_atoms group first\ndump d all custom 10 d.tmp id c_near\n"},
    {"Insertion", kInsertion},
};

class Histories : public testing::TestWithParam<std::tuple<Pause, int>> {
 public:
  // On as many ranks, without a pause's commands.
  static const Rows &untouched(int ranks)
  {
    static Rows rows[5];
    if (rows[ranks].empty()) {
      const DeckFolder folder;
      EXPECT_EQ(run_with_pause(folder, "", ranks).exit_code, 0);
      rows[ranks] = near_rods(folder);
    }
    return rows[ranks];
  }
};

}  // namespace

// The independent method is the same run without the commands. Sums of forces may come in another order.
TEST_P(Histories, FollowTheirRods)
{
  const auto &[pause, ranks] = GetParam();
  const DeckFolder folder;
  const Outcome outcome = run_with_pause(folder, pause.commands, ranks);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(outcome.output.find("contact history of rods"), std::string::npos) << outcome.output;
  const Rows rows = near_rods(folder), &expected = untouched(ranks);
  const bool inserts = pause.name == std::string("Insertion");
  ASSERT_EQ(rows.size(), expected.size() + (inserts ? 5 : 0));
  // A restart has a run 0 more, which works the forces out with the velocities of the full step.
  const bool restarts = std::string(pause.commands).find("{restart}") != std::string::npos;
  for (size_t k = 0; k < expected.size(); k++)
    for (size_t m = 0; m < expected[k].size(); m++)
      EXPECT_NEAR(rows[k][m], expected[k][m],
                  (restarts ? 1e-9 : 1e-11) * std::max(1.0, std::fabs(expected[k][m])))
          << k << " " << m;
}

INSTANTIATE_TEST_SUITE_P(, Histories,
                         testing::Combine(testing::ValuesIn(kPauses), testing::Values(1, 2, 4)),
                         [](const auto &info) {
                           return fmt::format("{}On{}", std::get<0>(info.param).name,
                                              std::get<1>(info.param));
                         });

// Values of contacts are known by their places alone: those in a restart file are for the models that wrote it,
// of pairs and of planes, whose other models may keep as many.
TEST(RestartedContacts, AreOfTheSameModelsOnly)
{
  Scene scene;
  scene.rods.resize(2);
  for (int n = 0; n < 2; n++) scene.rods[n].position.z = 0.00499 + 0.00999 * n;
  const std::string material =
      linear_material(1e4, 5e3, 0.5, 0.3) +
      "fix r all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
      "fix s all property/global coefficientRollingViscousDamping peratomtypepair 1 0.1\n";
  const std::string same = "linear tangential history";
  const std::string other = "linear tangential off rolling_friction epsd2";
  const auto physics = [&](const std::string &pair, const std::string &wall) {
    return material + rod_pair(pair) + rod_wall("floor", wall, "type 1 zplane 0.0") +
           "fix motion all nve/spherocylinder\nneighbor 0.01 bin\ntimestep 1e-6\n";
  };
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.first", preamble(scene) + "read_data rods.data\n" + physics(same, same) +
                               "run 10\nwrite_restart at.10\n");
  ASSERT_EQ(folder.run("in.first").exit_code, 0);
  const auto go_on = [&](const std::string &pair, const std::string &wall) {
    folder.write("in.on",
                 preamble(scene) + "read_restart at.10\n" + physics(pair, wall) + "run 10\n");
    return folder.run("in.on");
  };
  EXPECT_EQ(go_on(same, same).exit_code, 0);
  const Outcome pair = go_on(other, same), wall = go_on(same, other);
  EXPECT_NE(pair.exit_code, 0);
  EXPECT_NE(
      pair.output.find("Pair gran with surface spherocylinder: the restart file holds contacts "
                       "of other contact models"),
      std::string::npos)
      << pair.output;
  EXPECT_NE(wall.exit_code, 0);
  EXPECT_NE(wall.output.find("Fix wall/gran (id floor): the restart file holds contacts of other "
                             "contact models"),
            std::string::npos)
      << wall.output;
}
