// SPDX-License-Identifier: GPL-2.0-or-later
// Rods that a command puts into each other: the run ends with a sentence, unless the deck allows it, and no
// history of another place is used. Also types that nothing uses, and lists of rods that are gone.
#include <ostream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

// Two pairs of crossed rods that touch, 1e-4 m deep, and a rod apart. In a periodic box and on several
// ranks the first pair is across a border.
Scene pairs()
{
  Scene scene;
  Rod rod;
  for (const Vec3 &place : {Vec3{0.0, 0.0, 0.0}, Vec3{0.4, 0.3, 0.0}}) {
    rod.axis = {1.0, 0.0, 0.0};
    rod.position = place;
    scene.rods.push_back(rod);
    rod.axis = {0.0, 1.0, 0.0};
    rod.position.z += 0.0099;
    scene.rods.push_back(rod);
  }
  rod.position = {-0.5, 0.5, 0.5};
  scene.rods.push_back(rod);
  return scene;
}

struct Case {
  const char *name;
  std::string models;  // of the pair style, with keywords
  const char *pause;   // commands between two runs
  const char *run;     // the second one
  const char *wanted;  // in the output of a run that is refused, else null
};

void PrintTo(const Case &c, std::ostream *out) { *out << c.name; }

constexpr const char *kHistory = "linear tangential history surface spherocylinder";
constexpr const char *kNone = "linear tangential no_history surface spherocylinder";
constexpr const char *kHertz = "hertz tangential off surface spherocylinder";

// Rod 5 comes 0.006 m above the axis of rod 4: 0.4 diameters deep. By 0.0081 m: 0.19.
constexpr const char *kInto = "displace_atoms fifth move 0.9 -0.2 -0.4841 units box\n";
constexpr const char *kSlightly = "displace_atoms fifth move 0.9 -0.2 -0.482 units box\n";
constexpr const char *kPast = "displace_atoms second move 0.0 0.0 -0.0198 units box\n";
constexpr const char *kSentence = "rods 4 and 5 overlap by 0.4";

constexpr const char *kResized =
    "Run: pre no cannot be used after a command has changed the size, mass, type or frozen group of rods";

const Case kCases[] = {
    {"Displaced", kHistory, kInto, "run 5", kSentence},
    {"DisplacedWithoutHistory", kNone, kInto, "run 5", kSentence},
    {"DisplacedWithHertz", kHertz, kInto, "run 5", kSentence},
    {"DisplacedPreNo", kHistory, kInto, "run 5 pre no", kSentence},
    {"DisplacedAllowed", std::string(kHistory) + " sudden_overlap on", kInto, "run 5", nullptr},
    {"DisplacedSlightly", kHistory, kSlightly, "run 5", nullptr},
    {"DisplacedThenDeleted", kHistory,
     "displace_atoms fifth move 0.9 -0.2 -0.4841 units box\ndelete_atoms group fourth\n", "run 5",
     nullptr},
    {"DeletedThenDisplaced", kHistory,
     "delete_atoms group first\ndisplace_atoms fifth move 0.9 -0.2 -0.4841 units box\n", "run 5",
     "overlap by 0.4"},  // which ids the rods have now depends on the ranks
    {"PreNoAfterDeletion", kHistory, "delete_atoms group fifth\n", "run 5 pre no",
     "Run: pre no cannot be used after a command has deleted, added or renamed rods"},
    {"DiameterPreNo", kHistory, "set group fifth diameter 0.0105\n", "run 5 pre no", kResized},
    {"LengthPreNo", kHistory, "set group fifth length 0.12\n", "run 5 pre no", kResized},
    {"DensityPreNo", kHistory, "set group fifth density 2600\n", "run 5 pre no", kResized},
    {"Diameter", kHistory, "set group fifth diameter 0.0105\n", "run 5", nullptr},
    {"SameSizePreNo", kHistory, "set group fifth diameter 0.01\n", "run 5 pre no", nullptr},
    {"TypeOfLaterPreNo", kHistory, "set group fifth type 2\n", "run 5 pre no",
     "rod 5 has atom type 2 at step 6"},
    {"TypeOfLater", kHistory, "set group fifth type 2\n", "run 5", nullptr},
};

class SuddenOverlaps : public testing::TestWithParam<std::tuple<Case, int>> {};

Outcome run_with_pause(const DeckFolder &folder, const Case &c, int ranks)
{
  const Scene scene = pairs();
  Scene two_types = scene;
  two_types.types = 2;
  folder.write("rods.data", data_file(two_types));
  std::string start = preamble(scene);
  start.insert(start.find("newton"), ranks == 2   ? "processors 2 1 1\n"
                                     : ranks == 4 ? "processors 2 2 1\n"
                                                  : "");
  std::string deck = start + "read_data rods.data\nneighbor 0.02 bin\nneigh_modify delay 0\n" +
                     linear_material(2e4, 5.7e3, 0.5, 0.2, 2) +
                     "fix Y all property/global youngsModulus peratomtype 5e6 5e6\n"
                     "fix nu all property/global poissonsRatio peratomtype 0.3 0.3\n"
                     "pair_style gran model " +
                     c.models +
                     "\npair_coeff * *\n"
                     "fix motion all nve/spherocylinder\ntimestep 2e-5\n"
                     "group first id 1\ngroup second id 2\ngroup fourth id 4\ngroup fifth id 5\n"
                     "compute fz all reduce max fz\nthermo_style custom step c_fz\nthermo 5\n"
                     "thermo_modify norm no lost error\nrun 5\n" +
                     c.pause + c.run + "\n";
  folder.write("in.pause", deck);
  return folder.run("in.pause", {Program::Lmp, ranks, 60});
}

}  // namespace

TEST_P(SuddenOverlaps, EndTheRun)
{
  const auto &[c, ranks] = GetParam();
  const DeckFolder folder;
  const Outcome outcome = run_with_pause(folder, c, ranks);
  if (c.wanted) {
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.output.find(c.wanted), std::string::npos) << outcome.output;
  } else {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
}

INSTANTIATE_TEST_SUITE_P(, SuddenOverlaps,
                         testing::Combine(testing::ValuesIn(kCases), testing::Values(1, 2, 4)),
                         [](const auto &info) {
                           return fmt::format("{}On{}", std::get<0>(info.param).name,
                                              std::get<1>(info.param));
                         });

// Rod 2 is put as deep below rod 1 as it was above: its history would push it up by 1.99 diameters'
// overlap, 398 N. Dropped, rod 1 feels kn 1e-4 m = 2 N upwards.
TEST(FalseHistories, AreDropped)
{
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    const Case c = {"Past", kHistory, kPast, "run 1", nullptr};
    const Outcome outcome = run_with_pause(folder, c, ranks);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("the contact history of rods 1 and 2 does not belong"),
              std::string::npos)
        << outcome.output;
    const double fz = read_thermo(outcome.output).rows[0][1];
    EXPECT_NEAR(fz, 2.0, 0.2) << ranks;
  }
}

// Types above the highest that is used have no properties: their numbers are asked of nobody. The
// forces are kn 1e-4 m, between rods and at a wall.
TEST(UnusedTypes, AreNotLookedAt)
{
  for (const char *models :
       {"linear tangential history", "linear tangential off", "linear tangential no_history"})
    for (const int types : {2, 3, 7})
      for (const Mode mode : {Mode::OneRank, Mode::TwoRanks, Mode::FourRanks}) {
        Scene scene = pairs();
        scene.types = types;
        scene.physics = linear_material(2e4, 5.7e3, 0.5, 0.2, types) + rod_pair(models) +
                        rod_wall("floor", models, "type 1 zplane -0.0049") +
                        "fix motion all nve/spherocylinder\n";
        scene.dt = 1e-6;
        scene.steps = 10;
        const Frame end = run(scene, mode).back();
        const double impulse = 2e4 * 1e-4 * 1e-5;
        EXPECT_NEAR(end.rods[1].mass() * end.rods[1].velocity.z, impulse, 0.02 * impulse) << types;
        // Both ends at the wall, and the rod above.
        EXPECT_NEAR(end.rods[0].mass() * end.rods[0].velocity.z, impulse, 0.02 * impulse) << types;
      }
}
