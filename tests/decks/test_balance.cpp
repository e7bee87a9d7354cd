// SPDX-License-Identifier: GPL-2.0-or-later
// balance and fix balance: with `weight neigh` a rod costs 1 and a factor for each of its close pairs, counted
// by search over all pairs; meshes follow the cuts.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "mesh_files.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;

namespace {

constexpr double kSkin = 0.003;  // m, of the close pairs
constexpr double kFactor = 0.8;
// A cut is known to 2 m / 2^20; rods are apart by more in height.
constexpr const char *kShift = "shift z 20 1.02 weight neigh 0.8";

using Processors = std::array<int, 3>;

// A stack of 100 rods at rest that nearly touch, below the middle of the box, and as many above it on
// their own: 1 mm between neighbours in the stack, give or take 0.8, 5 mm across a diagonal.
Scene stack_and_loose_rods()
{
  std::mt19937 random(15485863);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Scene scene;
  for (int n = 0; n < 200; n++) {
    const double apart = n < 100 ? 0.011 : 0.05, lowest = n < 100 ? -0.3 : 0.1;
    const double off = 0.02 * any(random), jitter = 0.0004 * any(random);
    Rod rod;
    rod.position = {off, (n % 10 - 4.5) * apart, lowest + n / 10 % 10 * apart + jitter};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e5, 5e4, 0.5, 0.3) +
                  rod_pair("linear tangential history", fmt::format("close_skin {}", kSkin)) +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-5;
  return scene;
}

std::vector<int> close_pairs_by_search(const Scene &scene)
{
  std::vector<int> pairs(scene.rods.size(), 0);
  for (size_t i = 0; i < pairs.size(); i++)
    for (size_t j = 0; j < i; j++) {
      const Rod &a = scene.rods[i], &b = scene.rods[j];
      if (norm(a.position - b.position) > a.length + kSkin) continue;
      if (slow_distance(a, b) - a.diameter > kSkin) continue;
      pairs[i]++;
      pairs[j]++;
    }
  return pairs;
}

// Of the dearest rank over the mean; `cuts`: fractions of the box in x, y and z, its ends included.
double imbalance_by_search(const Scene &scene, const std::array<std::vector<double>, 3> &cuts)
{
  const std::vector<int> pairs = close_pairs_by_search(scene);
  std::array<size_t, 3> parts;
  for (int d = 0; d < 3; d++) parts[d] = cuts[d].size() - 1;
  std::vector<double> cost(parts[0] * parts[1] * parts[2], 0.0);
  double all = 0.0;
  for (size_t i = 0; i < pairs.size(); i++) {
    const Vec3 &at = scene.rods[i].position;
    const double place[3] = {at.x, at.y, at.z};
    size_t rank = 0;
    for (int d = 0; d < 3; d++) {
      const double part = (place[d] - scene.box_lo[d]) / (scene.box_hi[d] - scene.box_lo[d]);
      const auto above = std::upper_bound(cuts[d].begin(), cuts[d].end(), part);
      rank = rank * parts[d] + (above - cuts[d].begin() - 1);
    }
    cost[rank] += 1.0 + kFactor * pairs[i];
    all += 1.0 + kFactor * pairs[i];
  }
  return *std::max_element(cost.begin(), cost.end()) * static_cast<double>(cost.size()) / all;
}

std::array<std::vector<double>, 3> equal_cuts(const Processors &n)
{
  std::array<std::vector<double>, 3> cuts;
  for (int d = 0; d < 3; d++)
    for (int k = 0; k <= n[d]; k++) cuts[d].push_back(static_cast<double>(k) / n[d]);
  return cuts;
}

std::string begin(const Scene &scene, const Processors &n)
{
  return preamble(scene) +
         fmt::format("processors {} {} {}\nread_data rods.data\n"
                     "neighbor {} bin\nneigh_modify delay 0\ntimestep {}\n",
                     n[0], n[1], n[2], scene.skin, scene.dt) +
         scene.physics;
}

Outcome run_deck(const Scene &scene, const Processors &n, const std::string &commands)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.cost", begin(scene, n) + commands);
  return folder.run("in.cost", {Program::Lmp, n[0] * n[1] * n[2]});
}

class ByCost : public testing::TestWithParam<Processors> {};

// What `balance` prints is what a search finds, six digits of it, before and after; the threshold is kept.
TEST_P(ByCost, CommandCountsClosePairs)
{
  const Scene scene = stack_and_loose_rods();
  const Outcome outcome =
      run_deck(scene, GetParam(), fmt::format("run 0\nbalance 1.1 {}\nrun 0\n", kShift));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string says = "initial/final imbalance factor = ";
  const size_t at = outcome.output.find(says);
  ASSERT_NE(at, std::string::npos) << outcome.output;
  std::istringstream lines(outcome.output.substr(at + says.size()));
  double initial = 0.0, final = 0.0;
  lines >> initial >> final;
  std::array<std::vector<double>, 3> cuts;
  for (std::vector<double> &of_dimension : cuts) {
    std::string line, word;
    while (line.find("cuts:") == std::string::npos) std::getline(lines, line);
    std::istringstream words(line.substr(line.find(':') + 1));
    for (double cut; words >> cut;) of_dimension.push_back(cut);
  }
  const double before = imbalance_by_search(scene, equal_cuts(GetParam()));
  EXPECT_GT(before, 1.5);
  const std::string case_of = fmt::format("Balance by cost, {} ranks: imbalance ", GetParam()[2]);
  expect_holds({case_of + "before, relative", "all pairs, by search", 1e-5},
               std::abs(initial / before - 1.0));
  expect_holds({case_of + "after, relative", "all pairs, by search", 1e-5},
               std::abs(final / imbalance_by_search(scene, cuts) - 1.0));
  EXPECT_LE(final, 1.1);
}

// Before the first run all rods cost the same and are even where they are. When it is next looked at the
// cuts go into the stack, where they stay from run to run, also when rods have changed places in between.
TEST_P(ByCost, FixKeepsWhatItKnows)
{
  const Scene scene = stack_and_loose_rods();
  Processors n = GetParam();
  const Outcome outcome = run_deck(
      scene, n,
      fmt::format(
          "fix bal all balance 10 1.1 {}\n"
          "thermo 20\nthermo_style custom step atoms f_bal f_bal[1] f_bal[2] f_bal[3]\n"
          "thermo_modify norm no lost error\n"
          "run 0\nprint \"first $(f_bal)\"\nrun 20\nwrite_restart here\nprint \"moved $(f_bal[2])\"\nrun 20\n",
          kShift));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  const std::vector<int> pairs = close_pairs_by_search(scene);
  double all = 0.0;
  for (const int count : pairs) all += 1.0 + kFactor * count;
  for (size_t row = 0; row < thermo.rows.size(); row++) {
    EXPECT_LE(thermo.at(row, "bal"), 1.1) << row;
    EXPECT_NEAR(thermo.at(row, "bal[1]"), thermo.at(row, "bal") * all / n[2], 1e-3 * all) << row;
  }
  const auto printed = [&](const std::string &what) {
    const size_t at = outcome.output.rfind("\n" + what + " ");
    return at == std::string::npos ? NAN : std::stod(outcome.output.substr(at + what.size() + 2));
  };
  EXPECT_GT(printed("first"), 1.3);
  EXPECT_GE(printed("moved"), 1.0);
  EXPECT_EQ(thermo.at(thermo.rows.size() - 1, "bal[2]"), printed("moved"));
}

INSTANTIATE_TEST_SUITE_P(Ranks, ByCost, testing::Values(Processors{1, 1, 2}, Processors{1, 1, 4}));

// Rods that come and go: the others keep their counts, from which a run begins. By their number alone the cut
// would go through the upper half of the stack.
TEST(ByCostOfFewer, RodsComeAndGo)
{
  const Scene scene = stack_and_loose_rods();
  const std::string begins = "run 0\nprint \"begins $(f_bal)\"\nrun 20\n";
  const Outcome outcome = run_deck(
      scene, {1, 1, 2},
      fmt::format("fix bal all balance 0 1.1 {}\nrun 20\n"
                  "region upper block INF INF INF INF 0.33 INF units box\n"
                  "group loose region upper\ndelete_atoms group loose\n{}"
                  "create_atoms 1 single 0.0 0.0 0.5 units box\ngroup new id > 150\n"
                  "set group new diameter 0.01 length 0.1 density 2700 axis 1.0 0.0 0.0\n{}"
                  "unfix bal\nrun 20\n",
                  kShift, begins, begins));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string says = "\nbegins ";
  size_t at = outcome.output.find(says);
  for (int run = 0; run < 2; run++) {
    ASSERT_NE(at, std::string::npos) << outcome.output;
    EXPECT_LE(std::stod(outcome.output.substr(at + says.size())), 1.1) << run;
    at = outcome.output.find(says, at + 1);
  }
  const Table thermo = read_thermo(outcome.output);
  EXPECT_EQ(thermo.at(thermo.rows.size() - 1, "Atoms"), 151.0);
}

// Rods in the highest part of a box of triangles fall to its floor: the cuts have far to go, both ways, and
// each rank keeps the triangles that are its own.
class InMesh : public testing::TestWithParam<Processors> {};

Scene rods_in_a_mesh()
{
  std::mt19937 random(32452843);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  Scene scene;
  for (int n = 0; n < 36; n++) {
    Rod rod;
    rod.length = 0.06;
    rod.position = {(n % 6 - 2.5) * 0.07, (n / 6 - 2.5) * 0.07, 0.4};
    rod.axis = normalized(vector());
    rod.velocity = {0.0, 0.0, -6.0};
    rod.omega = 5.0 * vector();
    scene.rods.push_back(rod);
  }
  scene.files["box.stl"] = stl(box_mesh({-0.25, -0.25, -0.5}, {0.25, 0.25, 0.5}, 4));
  const std::string models = "linear tangential history";
  scene.physics = linear_material(1e5, 5e4, 0.5, 0.3) + rod_pair(models) +
                  "fix motion all nve/spherocylinder\n" + mesh_fix("box", "box.stl") +
                  mesh_wall("walls", models, {"box"});
  scene.dt = 2e-5;
  return scene;
}

TEST_P(InMesh, AsOnOneRank)
{
  Scene scene = rods_in_a_mesh();
  const auto run_on = [&](const Processors &n, const std::string &balance) {
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    for (const auto &[name, text] : scene.files) folder.write(name, text);
    folder.write("in.mesh", begin(scene, n) + "compute contacts all contact/spherocylinder\n" +
                                exact_dump("dump.rods", 9000, kFrameColumns) + balance +
                                "run 9000\n");
    const Outcome outcome = folder.run("in.mesh", {Program::Lmp, n[0] * n[1] * n[2]});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return read_frames(folder / "dump.rods", scene);
  };
  const std::vector<Frame> one = run_on({1, 1, 1}, "");
  double lowest = 0.0;
  for (const Rod &rod : one.back().rods) lowest = std::min(lowest, rod.position.z);
  EXPECT_LT(lowest, -0.4);
  expect_holds(
      {fmt::format("Falling in a box of triangles, fix balance, {} ranks: position (m)",
                   GetParam()[0] * GetParam()[2]),
       "one rank", 1e-10},
      largest_difference(one, run_on(GetParam(), "fix bal all balance 100 1.05 shift xz 20 1.02\n"
                                                 "thermo_modify norm no lost error\n")));
}

INSTANTIATE_TEST_SUITE_P(Ranks, InMesh, testing::Values(Processors{1, 1, 4}, Processors{4, 1, 1}));

// One sentence each.
TEST(ByCostErrors, WrongInput)
{
  Scene scene = stack_and_loose_rods();
  scene.rods.resize(2);
  const std::string fix = "fix bal all balance 10 1.1 shift z 10 1.1 ";
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {fix + "wait neigh 1\nrun 0\n",
       "Fix balance (id bal): unknown keyword wait (expected weight)"},
      {fix + "weight\nrun 0\n", "Fix balance (id bal): expected weight neigh factor"},
      {fix + "weight neigh\nrun 0\n", "Fix balance (id bal): expected weight neigh factor"},
      {fix + "weight time 1\nrun 0\n", "unknown weight time (expected neigh)"},
      {fix + "weight neigh much\nrun 0\n", "factor of weight neigh must be a number (got much)"},
      {fix + "weight neigh 0\nrun 0\n", "factor of weight neigh must be > 0 (got 0)"},
      {fix + "weight neigh 1 out\nrun 0\n", "expected nothing after weight neigh factor (got out)"},
      {"run 0\nbalance 1.1 shift z 10 1.1 weight neigh -1\n", "must be > 0 (got -1)"},
      {"balance 1.1 shift z 10 1.1 weight neigh 1\nrun 0\n",
       "Balance command: weight neigh counts the close pairs of the run just before"},
      {"run 0\nwrite_restart here\ngroup one id 1\ndelete_atoms group one\nbalance 1.1 shift z 10 1.1 weight neigh 1\n",
       "(expected run 0 before it)"}};
  for (const auto &[commands, says] : wrong) {
    const Outcome outcome = run_deck(scene, {1, 1, 1}, commands);
    EXPECT_NE(outcome.exit_code, 0) << commands;
    const size_t at = outcome.output.find("ERROR");
    ASSERT_NE(at, std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find("ERROR", at + 1), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find(says, at), std::string::npos) << outcome.output;
  }
}

}  // namespace
