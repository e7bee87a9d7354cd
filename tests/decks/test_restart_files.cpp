// SPDX-License-Identifier: GPL-2.0-or-later
// Restart files: whole or refused, and a run that goes on from one is the run that was not stopped.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "run_mode.h"
#include "scene.h"
#include "stock_spheres.h"

using namespace decks;

namespace {

// Two crossed layers that rock on their tangential springs, on a floor and thrown against each other.
Scene crossed_layers()
{
  Scene scene;
  scene.box_lo[2] = -0.1;
  for (int n = 0; n < 12; n++) {
    Rod rod;
    const bool upper = n >= 6;
    const double place = -0.075 + 0.03 * (n % 6);
    rod.length = 0.2;
    rod.axis = upper ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
    rod.position = upper ? Vec3{place, 0.0, 0.0149985} : Vec3{0.0, place, 0.004999};
    if (upper) rod.velocity = {0.2, 0.05 * (n - 8), -0.1};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e5, 5e4, 0.5, 0.3) + rod_pair("linear tangential history") +
                  rod_wall("floor", "linear tangential history", "type 1 zplane 0.0") +
                  "fix motion all nve/spherocylinder\nfix weight all gravity 9.81 vector 0 0 -1\n";
  scene.dt = 1e-5;
  return scene;
}

std::string settings(const Scene &scene, const std::string &physics)
{
  return "neighbor 0.02 bin\n" + physics +
         fmt::format("compute contacts all contact/spherocylinder\ntimestep {}\n", scene.dt);
}

std::string beginning(const Scene &scene)
{
  return preamble(scene) + "read_data rods.data\n" + settings(scene, scene.physics);
}

std::string going_on(const Scene &scene, const std::string &file)
{
  return preamble(scene) + "read_restart " + file + "\n" + settings(scene, scene.physics);
}

// A folder with a restart file `rods.restart` of crossed layers, 300 steps on, and the deck in.read that goes on
// from `rods.read`.
class RestartFile : public testing::Test {
 protected:
  void SetUp() override
  {
    folder.write("rods.data", data_file(scene));
    folder.write("in.write", beginning(scene) + "run 300\nwrite_restart rods.restart\n");
    folder.write("in.read", going_on(scene, "rods.read") + "run 1\n");
    const Outcome written = folder.run("in.write");
    ASSERT_EQ(written.exit_code, 0) << written.output;
    bytes = folder.read("rods.restart");
    ASSERT_GT(bytes.size(), 1000u);
  }

  Outcome read(const std::string &content, int ranks = 1)
  {
    folder.write("rods.read", content);
    return folder.run("in.read", {Program::Lmp, ranks, 30});
  }

  void expect_refused(const std::string &content, const std::string &reason, int ranks = 1)
  {
    const Outcome outcome = read(content, ranks);
    EXPECT_NE(outcome.exit_code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("ERROR: Restart file rods.read is not whole: " + reason),
              std::string::npos)
        << outcome.output;
    EXPECT_LT(outcome.output.size(), 10000u);
  }

  const Scene scene = crossed_layers();
  const DeckFolder folder;
  std::string bytes;
};

constexpr char kNoMark[] = "it has no closing mark";
constexpr char kShortHeader[] = "it ends within its header";

TEST_F(RestartFile, IsReadAsItWasWritten)
{
  const Outcome outcome = read(bytes);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(outcome.output.find("read_restart"), std::string::npos) << outcome.output;
  EXPECT_EQ(read(bytes, 2).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / ".rods.restart.part"));
}

TEST_F(RestartFile, IsRefusedIfCut)
{
  for (const size_t left : {size_t(0), size_t(3), size_t(7), size_t(300)})
    expect_refused(bytes.substr(0, left), kShortHeader);
  for (const size_t gone : {size_t(1), size_t(20), size_t(100), size_t(500), bytes.size() / 2})
    expect_refused(bytes.substr(0, bytes.size() - gone), kNoMark);
  expect_refused("", kShortHeader, 2);
  expect_refused(bytes.substr(0, bytes.size() - 500), kNoMark, 2);
  expect_refused(bytes + "\n", kNoMark);
  expect_refused(bytes.substr(8), "its check sum is ");
  expect_refused(std::string(5000, '\0'), "a word in its header has 0 letters");
  expect_refused(std::string(5000, '\xff'), "it does not begin as a restart file");
}

TEST_F(RestartFile, IsRefusedIfThereIsNone)
{
  const Outcome outcome = folder.run("in.read");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("Restart file rods.read cannot be read: No such file"),
            std::string::npos)
      << outcome.output;
}

// An older plug-in's: LIGGGHTS's part alone.
TEST_F(RestartFile, WithoutMarkIsReadOnlyIfToldTo)
{
  const size_t mark = bytes.find("spherocylinder 0");
  ASSERT_NE(mark, std::string::npos);
  const std::string old = bytes.substr(0, mark);
  expect_refused(old, kNoMark);
  folder.write("in.read", going_on(scene, "rods.read unchecked") + "run 1\n");
  const Outcome outcome = read(old);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  // The header is looked at in any case, and so is a mark.
  expect_refused(old.substr(0, 300), kShortHeader);
  std::string other = bytes;
  other[mark - 40] ^= 1;
  expect_refused(other, "its check sum is ");
}

TEST_F(RestartFile, SaysWhichModelsDiffer)
{
  const std::string physics = linear_material(1e5, 5e4, 0.5, 0.3) +
                              rod_pair("linear tangential no_history") +
                              rod_wall("ground", "linear tangential history", "type 1 zplane 0.0") +
                              "fix motion all nve/spherocylinder\n";
  folder.write("in.read",
               preamble(scene) + "read_restart rods.read\n" + settings(scene, physics) + "run 1\n");
  const Outcome outcome = read(bytes);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char *said :
       {"contact models or walls are others than the file's (in the file: pair_style gran model "
        "linear tangential history surface spherocylinder; wall floor: model linear tangential "
        "history surface spherocylinder primitive zplane;",
        "now: pair_style gran model linear tangential no_history surface spherocylinder; wall "
        "ground: "})
    EXPECT_NE(outcome.output.find(said), std::string::npos) << said << "\n" << outcome.output;
}

// One byte changed, anywhere.
class ChangedRestartFile : public RestartFile, public testing::WithParamInterface<int> {};

TEST_P(ChangedRestartFile, IsRefused)
{
  constexpr int kChanges = 16;
  std::mt19937 random(104729 + GetParam());
  std::uniform_int_distribution<size_t> place(0, bytes.size() - 1);
  std::uniform_int_distribution<int> change(1, 255);
  for (int k = 0; k < kChanges; k++) {
    std::string changed = bytes;
    const size_t where = place(random);
    changed[where] = static_cast<char>(changed[where] ^ change(random));
    const Outcome outcome = read(changed);
    EXPECT_NE(outcome.exit_code, 0) << where;
    EXPECT_NE(outcome.output.find("Restart file rods.read is not whole: "), std::string::npos)
        << where << "\n"
        << outcome.output;
  }
}

INSTANTIATE_TEST_SUITE_P(, ChangedRestartFile, testing::Range(0, 4));

// One file a rank, and a base.
TEST(RestartFilesOfRanks, AreWholeAndOfOneStep)
{
  const Scene scene = crossed_layers();
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.write", beginning(scene) + "run 300\nwrite_restart old.%\nrun 10\nwrite_restart "
                                              "new.%\nwrite_restart new.one\n");
  folder.write("in.read", going_on(scene, "rods.%") + exact_dump("dump.parts", 100, kFrameColumns) +
                              "run 100\n");
  folder.write("in.one", going_on(scene, "new.one") + exact_dump("dump.one", 100, kFrameColumns) +
                             "run 100\n");
  ASSERT_EQ(folder.run("in.write", {Program::Lmp, 2}).exit_code, 0);
  const auto take = [&](const std::string &base, const std::string &first,
                        const std::string &second) {
    folder.write("rods.base", base);
    folder.write("rods.0", first);
    folder.write("rods.1", second);
  };
  const std::string base = folder.read("new.base"), first = folder.read("new.0"),
                    second = folder.read("new.1");
  ASSERT_FALSE(second.empty());
  take(base, first, second);
  for (const int ranks : {1, 2, 3}) {
    const Outcome outcome = folder.run("in.read", {Program::Lmp, ranks});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    ASSERT_EQ(folder.run("in.one", {Program::Lmp, ranks}).exit_code, 0);
    EXPECT_LE(largest_difference(read_frames(folder / "dump.parts", scene),
                                 read_frames(folder / "dump.one", scene)),
              1e-13)
        << ranks;
  }
  struct Wrong {
    std::string base, first, second, said;
  };
  const Wrong wrong[] = {
      {base, first, folder.read("old.1"), "rods.1 is not whole: it is of another step"},
      {base, second, second, "rods.0 is not whole: it is of another step"},
      {folder.read("old.base"), first, second, "is not whole: it is of another step"},
      {base, first, second.substr(0, second.size() - 1), "rods.1 is not whole: it has no closing"},
      {base, "", second, "rods.0 is not whole: it has no closing mark"},
      {base.substr(0, base.size() - 1), first, second, "rods.base is not whole: it has no closing"},
  };
  for (const Wrong &files : wrong)
    for (const int ranks : {1, 2}) {
      take(files.base, files.first, files.second);
      const Outcome outcome = folder.run("in.read", {Program::Lmp, ranks});
      EXPECT_NE(outcome.exit_code, 0);
      EXPECT_NE(outcome.output.find(files.said), std::string::npos) << files.said << "\n"
                                                                    << outcome.output;
    }
}

// Spheres: the stock program reads the file and does not see the mark; a file of its own has none.
TEST(RestartFilesOfSpheres, GoBothWays)
{
  Scene scene;
  for (int i = 0; i < 3; i++) {
    Rod ball;
    ball.length = ball.diameter = 0.1;
    ball.position = {0.3 * i - 0.3, 0.0, 0.0};
    ball.velocity = {0.1 * i, 0.0, 0.2};
    scene.rods.push_back(ball);
  }
  const DeckFolder folder;
  folder.write("balls.data", granular_data_file(scene.rods, -1.0, 1.0));
  const std::string start =
      "atom_style granular\natom_modify map array sort 0 0\nboundary f f f\nnewton "
      "off\ncommunicate single vel yes\nunits si\n";
  const std::string rest = "neighbor 0.02 bin\nfix motion all nve/sphere\ntimestep 1e-5\n" +
                           exact_dump("dump.{}", 10, "id x y z vx vy vz");
  const auto deck = [&](const std::string &from, const std::string &dump, const std::string &then) {
    std::string text = start + from + "\n" + rest + then;
    text.replace(text.find("{}"), 2, dump);
    return text;
  };
  folder.write("in.lmp", deck("read_data balls.data", "a", "run 10\nwrite_restart of.lmp\n"));
  folder.write("in.stock", deck("read_data balls.data", "b", "run 10\nwrite_restart of.stock\n"));
  ASSERT_EQ(folder.run("in.lmp").exit_code, 0);
  ASSERT_EQ(folder.run("in.stock", {Program::Stock}).exit_code, 0);
  folder.write("in.there", deck("read_restart of.lmp", "c", "run 10\n"));
  folder.write("in.here", deck("read_restart of.stock", "d", "run 10\n"));
  const Outcome there = folder.run("in.there", {Program::Stock});
  EXPECT_EQ(there.exit_code, 0) << there.output;
  const Outcome here = folder.run("in.here");
  EXPECT_EQ(here.exit_code, 0) << here.output;
  EXPECT_EQ(folder.read("dump.c"), folder.read("dump.d"));
  folder.write("of.stock", "");
  EXPECT_NE(folder.run("in.here").output.find("of.stock is not whole"), std::string::npos);
}

// A run of 1000 steps, and those that go on from files it wrote on the way.
class SplitRun : public testing::TestWithParam<int> {};

TEST_P(SplitRun, IsTheRunThatWasNotSplit)
{
  const int ranks = GetParam();
  Scene scene = crossed_layers();
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.whole", beginning(scene) + exact_dump("dump.whole", 1000, kFrameColumns) +
                               "restart 137 rods.*\nrun 1000\n");
  ASSERT_EQ(folder.run("in.whole", {Program::Lmp, ranks}).exit_code, 0);
  const std::vector<Frame> whole = {read_frames(folder / "dump.whole", scene).back()};
  double equal = 0.0, other = 0.0;
  for (const int step : {137, 411, 959})
    for (const int on : {ranks, ranks == 1 ? 2 : ranks - 1}) {
      folder.write("in.rest", going_on(scene, fmt::format("rods.{}", step)) +
                                  exact_dump("dump.rest", 1000, kFrameColumns) +
                                  fmt::format("run {}\n", 1000 - step));
      const Outcome outcome = folder.run("in.rest", {Program::Lmp, on});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
      const std::vector<Frame> rest = {read_frames(folder / "dump.rest", scene).back()};
      double &largest = on == ranks ? equal : other;
      largest = std::max(largest, largest_difference(whole, rest));
    }
  const std::string who = fmt::format("Run of 1000 steps on {} ranks, split at 3 places: ", ranks);
  // On several ranks rods change hands at other steps, and forces are summed in another order.
  if (ranks == 1)
    expect_holds({who + "position on as many (m)", "same bits", 0.0}, equal);
  else
    expect_holds({who + "position on as many (m)", "unsplit", 1e-15}, equal);
  expect_holds({who + "position on other numbers (m)", "unsplit", 1e-10}, other);
}

INSTANTIATE_TEST_SUITE_P(Ranks, SplitRun, testing::Values(1, 2, 4));

// Rods that are still to come come where they would have.
struct Insertion {
  const char *name, *commands;
};

void PrintTo(const Insertion &insertion, std::ostream *out) { *out << insertion.name; }

class SplitInsertion : public testing::TestWithParam<Insertion> {};

TEST_P(SplitInsertion, DrawsTheSameNumbers)
{
  Scene scene;
  scene.physics =
      linear_material(1e5, 5e4, 0.5, 0.3) + rod_pair("linear tangential history") +
      rod_wall("floor", "linear tangential history", "type 1 zplane -0.9") +
      "fix long all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
      "radius constant 0.005 length constant 0.1\n"
      "fix short all particletemplate/spherocylinder 15485867 atom_type 1 density constant 2700 "
      "radius constant 0.004 length constant 0.05\n"
      "fix rods all particledistribution/discrete 32452843 2 long 0.5 short 0.5\n"
      "region place block -0.8 0.8 -0.8 0.8 0.5 0.8 units box\n" +
      std::string(GetParam().commands) +
      "fix motion all nve/spherocylinder\nfix weight all gravity 9.81 vector 0 0 -1\n"
      "compute contacts all contact/spherocylinder\ntimestep 1e-4\n";
  const DeckFolder folder;
  std::string face = "solid face\n";
  for (const char *corners :
       {"-0.5 -0.5 0.7|0.5 -0.5 0.7|0.5 0.5 0.7|", "-0.5 -0.5 0.7|0.5 0.5 0.7|-0.5 0.5 0.7|"}) {
    std::string text = std::string("vertex ") + corners;
    for (size_t k; (k = text.find('|')) != std::string::npos;)
      text.replace(k, 1, k + 1 < text.size() ? "\nvertex " : "\n");
    face += "facet normal 0 0 1\nouter loop\n" + text + "endloop\nendfacet\n";
  }
  folder.write("face.stl", face + "endsolid face\n");
  for (const int ranks : {1, 2}) {
    const Mode mode = ranks == 1 ? Mode::OneRank : Mode::TwoRanks;
    folder.write("in.whole", preamble(scene, mode) +
                                 "region box block -1 1 -1 1 -1 1 units box\ncreate_box 1 box\n"
                                 "neighbor 0.02 bin\n" +
                                 scene.physics + exact_dump("dump.whole", 300, kFrameColumns) +
                                 "restart 150 r.*\nrun 300\n");
    folder.write("in.rest", preamble(scene, mode) + "read_restart r.150\nneighbor 0.02 bin\n" +
                                scene.physics + exact_dump("dump.rest", 300, kFrameColumns) +
                                "run 150\n");
    for (const char *deck : {"in.whole", "in.rest"}) {
      const Outcome outcome = folder.run(deck, {Program::Lmp, ranks});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    }
    const Snapshot whole = read_dump(folder / "dump.whole").back(),
                   rest = read_dump(folder / "dump.rest").back();
    ASSERT_EQ(whole.step, rest.step);
    ASSERT_GT(whole.atoms.rows.size(), 200u);
    EXPECT_EQ(whole.atoms.rows, rest.atoms.rows) << ranks;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , SplitInsertion,
    testing::Values(
        Insertion{"Pack",
                  "fix pour all insert/pack seed 86028121 distributiontemplate rods insert_every "
                  "100 overlapcheck yes orientation random all_in yes vel gaussian 0 0 -30 0.1 0.1 "
                  "0.1 region place particles_in_region 100\n"},
        Insertion{"RateRegion",
                  "fix pour all insert/rate/region seed 86028121 distributiontemplate rods "
                  "nparticles 1000 particlerate 10000 insert_every 70 overlapcheck yes orientation "
                  "random all_in yes vel uniform 0 0 -1 0.1 0.1 0.1 region place\n"},
        Insertion{"Stream",
                  "fix face all mesh/surface/planar file face.stl type 1\n"
                  "fix pour all insert/stream seed 86028121 distributiontemplate rods nparticles "
                  "3000 particlerate 10000 overlapcheck yes orientation random all_in no vel "
                  "constant 0 0 -20 insertion_face face extrude_length 0.3\n"}),
    [](const auto &info) { return info.param.name; });

TEST(DataFileOfContacts, SaysThatItHasNoHistories)
{
  const Scene scene = crossed_layers();
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.write", beginning(scene) + "run 300\nwrite_data again.data\n");
  const Outcome outcome = folder.run("in.write");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string said = "Contact histories are not in data files";
  EXPECT_NE(outcome.output.find(said), std::string::npos) << outcome.output;
  EXPECT_NE(folder.read("log.liggghts").find(said), std::string::npos);
}

}  // namespace
