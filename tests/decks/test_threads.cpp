// SPDX-License-Identifier: GPL-2.0-or-later
// How many threads a rank has must not change a bit of what comes out.
#include <cstdlib>
#include <ostream>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <sched.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh_files.h"
#include "scene.h"

using namespace decks;

namespace {

struct Contacts {
  const char *name, *models;
  std::vector<int> threads;
  const char *more = "";  // commands
  bool in_mesh = false;   // a box of triangles that shakes, in the place of planes and a tube
};

void PrintTo(const Contacts &contacts, std::ostream *out) { *out << contacts.name; }

class Threads : public testing::TestWithParam<Contacts> {};

// How threads wait: those beyond the processors must not wait in a loop for one that cannot run.
class WaitPolicy {
 public:
  explicit WaitPolicy(const char *policy)
  {
    if (const char *now = getenv(kName)) before_ = now;
    set(policy);
  }
  ~WaitPolicy() { set(before_.empty() ? nullptr : before_.c_str()); }
  WaitPolicy(const WaitPolicy &) = delete;
  WaitPolicy &operator=(const WaitPolicy &) = delete;

 private:
  static constexpr const char *kName = "OMP_WAIT_POLICY";
  std::string before_;

  static void set(const char *policy)
  {
    if (policy)
      setenv(kName, policy, 1);
    else
      unsetenv(kName);
  }
};

// 900 rods of three lengths in layers fall on the floor of a closed box, and on each other: more close pairs,
// rods at walls and rods than eight threads must have to be put to work.
std::string primitive_walls(const std::string &models)
{
  return rod_wall("floor", models, "type 1 zplane 0.0") +
         rod_wall("left", models, "type 1 xplane -0.265") +
         rod_wall("right", models, "type 1 xplane 0.265") +
         rod_wall("front", models, "type 1 yplane -0.265") +
         rod_wall("back", models, "type 1 yplane 0.265") +
         rod_wall("tube", models, "type 1 zcylinder 0.5 0.0 0.0");
}

std::string walls_of_triangles(Scene &scene, const std::string &models)
{
  scene.files["box.stl"] = stl(box_mesh({-0.265, -0.265, 0.0}, {0.265, 0.265, 0.35}, 6));
  return mesh_fix("box", "box.stl") + mesh_wall("walls", models, {"box"}) +
         "fix shake all move/mesh mesh box wiggle amplitude 0.0 0.0 0.002 period 0.04\n";
}

Scene falling_rods(const Contacts &contacts, const std::string &threads)
{
  std::mt19937 random(982451653);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Scene scene;
  constexpr double kApart = 0.034;
  for (int n = 0; n < 900; n++) {
    Rod rod;
    rod.length = (n % 3 == 0 ? 1.0 : n % 3 == 1 ? 2.0 : 3.0) * rod.diameter;
    rod.position = {(n % 15 - 7) * kApart, (n / 15 % 15 - 7) * kApart, 0.018 + n / 225 * kApart};
    rod.axis = normalized({any(random), any(random), any(random)});
    rod.velocity = {0.5 * any(random), 0.5 * any(random), -2.0};
    rod.omega = 20.0 * Vec3{any(random), any(random), any(random)};
    scene.rods.push_back(rod);
  }
  for (int d = 0; d < 2; d++) {
    scene.box_lo[d] = -0.27;
    scene.box_hi[d] = 0.27;
  }
  scene.box_lo[2] = -0.01;
  scene.box_hi[2] = 0.4;
  scene.skin = 0.01;
  const std::string models = contacts.models;
  scene.physics = linear_material(2e4, 1e4, 0.2, 0.3) + no_rolling_friction(1) +
                  rod_pair(models, threads) +
                  (contacts.in_mesh ? walls_of_triangles(scene, models) : primitive_walls(models)) +
                  "fix weight all gravity 60.0 vector 0.0 0.0 -1.0\n"
                  "fix motion all nve/spherocylinder\n" +
                  contacts.more;
  scene.dt = 2e-5;
  scene.steps = 4000;
  scene.dump_every = 2000;
  return scene;
}

std::string thermo_of(const Scene &scene, const std::string &threads)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.threads", preamble(scene) + "read_data rods.data\nneighbor 0.01 bin\n" +
                                 "neigh_modify delay 0\n" + scene.physics + "timestep 2e-5\n" +
                                 "thermo_style custom step atoms\nrun 0\n");
  if (!threads.empty()) setenv("OMP_NUM_THREADS", threads.c_str(), 1);
  const Outcome outcome = folder.run("in.threads");
  if (!threads.empty()) unsetenv("OMP_NUM_THREADS");
  return fmt::format("exit {}\n{}", outcome.exit_code, outcome.output);
}

}  // namespace

TEST_P(Threads, ChangeNoBit)
{
  const WaitPolicy patient("passive");
  const std::vector<Frame> one = run(falling_rods(GetParam(), "threads 1"));
  double contacts = 0.0;
  for (const double of_rod : one.back().contacts) contacts += of_rod;
  EXPECT_GT(contacts, 300.0);
  for (const int threads : GetParam().threads)
    EXPECT_EQ(
        largest_difference(one, run(falling_rods(GetParam(), fmt::format("threads {}", threads)))),
        0.0)
        << threads;
}

TEST(ThreadsOfTwoRanks, ChangeNoBit)
{
  const WaitPolicy patient("passive");
  const Contacts linear = {"", "linear tangential history", {}};
  EXPECT_EQ(largest_difference(run(falling_rods(linear, "threads 1"), Mode::TwoRanks),
                               run(falling_rods(linear, "threads 2"), Mode::TwoRanks)),
            0.0);
}

// What looks at each contact, and the models that serve one thread, see them in turn.
INSTANTIATE_TEST_SUITE_P(
    , Threads,
    testing::Values(Contacts{"Linear", "linear tangential history", {2, 3, 4, 8}},
                    Contacts{"Frictionless", "linear tangential off", {2}},
                    Contacts{"InAMesh", "linear tangential history", {2, 3}, "", true},
                    Contacts{"Observed",
                             "linear tangential history",
                             {3},
                             "compute rows all pair/gran/local pos force\n"
                             "compute sum all reduce sum c_rows[1]\n"
                             "compute stress all stress/atom pair\n"
                             "fix keep all ave/time 10 1 10 c_sum\n"},
                    Contacts{"LaneByLane", "linear tangential history rolling_friction cdt", {2}}),
    [](const auto &info) { return std::string(info.param.name); });

TEST(NumberOfThreads, IsThatOfTheKeywordElseOfTheVariable)
{
  const Contacts linear = {"", "linear tangential history", {}};
  const std::string one = thermo_of(falling_rods(linear, "threads 1"), "1");
  EXPECT_EQ(one.find("threads for each"), std::string::npos) << one;
  const WaitPolicy patient("passive");
  for (const auto &[keyword, variable, wanted] :
       {std::tuple("threads 2", "3", 2), std::tuple("", "3", 3), std::tuple("", "2,4", 2),
        std::tuple("threads 40", "", 40)}) {
    const std::string told = thermo_of(falling_rods(linear, keyword), variable);
    EXPECT_NE(told.find(fmt::format("Rods: {} threads for each of 1 ranks", wanted)),
              std::string::npos)
        << told;
    EXPECT_EQ(told.find("exit 0"), 0u) << told;
  }
}

// Where threads wait in a loop, no more than there are processors.
TEST(NumberOfThreads, IsThatOfTheProcessorsAtMost)
{
  const WaitPolicy impatient(nullptr);
  const Contacts linear = {"", "linear tangential history", {}};
  const std::string many = thermo_of(falling_rods(linear, "threads 1000"), "");
  EXPECT_NE(many.find("Rods: 1 ranks of 1000 threads each are more than the"), std::string::npos)
      << many;
  EXPECT_EQ(many.find("Rods: 1000 threads"), std::string::npos) << many;
  EXPECT_EQ(many.find("exit 0"), 0u) << many;
}

// Those that the launcher gives the rank, not those of the machine.
TEST(NumberOfThreads, IsThatOfTheProcessorsItIsBoundTo)
{
  const WaitPolicy impatient(nullptr);
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  int first = 0;
  while (!CPU_ISSET(first, &before)) first++;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const Contacts linear = {"", "linear tangential history", {}};
  const std::string bound = thermo_of(falling_rods(linear, "threads 2"), "");
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
  EXPECT_NE(bound.find("that they may use here: 1 threads are used"), std::string::npos) << bound;
  EXPECT_EQ(bound.find("exit 0"), 0u) << bound;
}

TEST(NumberOfThreads, IsRefusedInOneSentence)
{
  const Contacts linear = {"", "linear tangential history", {}};
  for (const char *wrong : {"0", "-1", "two", "2.5", "5000"}) {
    const std::string by_keyword =
        thermo_of(falling_rods(linear, std::string("threads ") + wrong), "");
    EXPECT_NE(by_keyword.find(fmt::format("Surface spherocylinder: threads must be a whole number "
                                          "from 1 to 1024 (got {})",
                                          wrong)),
              std::string::npos)
        << by_keyword;
    const std::string by_variable = thermo_of(falling_rods(linear, ""), wrong);
    EXPECT_NE(by_variable.find(fmt::format(
                  "OMP_NUM_THREADS must be a whole number from 1 to 1024 (got {})", wrong)),
              std::string::npos)
        << by_variable;
  }
}
