// SPDX-License-Identifier: GPL-2.0-or-later
// A disk that does not take all of a file ends the program with one sentence and an exit code other than 0, and
// what was there before stays. The shell's limit on the length of files stands for the disk: a write beyond it
// fails as one on a full disk does.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

// 1,000 rods at rest in a grid: 300 kB in a restart file, 60 kB in a frame of a dump.
Scene grid()
{
  Scene scene;
  for (int i = 0; i < 1000; i++) {
    Rod rod;
    rod.length = 0.02;
    rod.diameter = 0.01;
    rod.position = {0.1 * (i % 10) - 0.45, 0.1 * (i / 10 % 10) - 0.45, 0.1 * (i / 100) - 0.45};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e5, 5e4, 0.5, 0.3) + rod_pair("linear tangential history") +
                  "fix motion all nve/spherocylinder\n";
  return scene;
}

constexpr char kDump[] = "id type x y z vx vy vz shapex shapey shapez quat1 quat2 quat3 quat4\n";
constexpr int kBlocks = 150;  // of 512 bytes, the limit of the tests' decks: 77 kB

class FullDisk : public testing::Test {
 protected:
  void SetUp() override
  {
    if (SPHEROCYLINDER_SANITIZED)
      GTEST_SKIP() << "the sanitizers stand before the C library's fopen and fclose themselves";
    folder.write("rods.data", data_file(scene));
  }

  Outcome run(const std::string &commands, Launch launch)
  {
    folder.write("in.rods", preamble(scene) + "read_data rods.data\nneighbor 0.02 bin\n" +
                                scene.physics + "timestep 1e-5\n" + commands);
    return folder.run("in.rods", launch);
  }

  Outcome run_limited(const std::string &commands, Program program = Program::Lmp,
                      int blocks = kBlocks)
  {
    Launch launch;
    launch.program = program;
    launch.before = fmt::format("ulimit -f {};", blocks);
    return run(commands, launch);
  }

  static void expect_sentence(const Outcome &outcome, const std::string &sentence)
  {
    EXPECT_NE(outcome.exit_code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << sentence << "\n"
                                                                << outcome.output;
  }

  bool exists(const std::string &name) const { return std::filesystem::exists(folder / name); }

  const Scene scene = grid();
  const DeckFolder folder;
};

TEST_F(FullDisk, RestartKeepsTheOldFile)
{
  for (const char *commands :
       {"write_restart a.restart\n", "restart 10 a.restart b.restart\nrun 20\n"}) {
    folder.write("a.restart", "old");
    expect_sentence(run_limited(commands),
                    "ERROR: Restart file a.restart cannot be written whole: File too large");
    EXPECT_EQ(folder.read("a.restart"), "old");
    EXPECT_FALSE(exists(".a.restart.part"));
  }
  expect_sentence(run_limited("write_restart r.%\n"),
                  "ERROR: Restart file r.0 cannot be written whole: File too large");
  for (const char *name : {"r.0", "r.base", ".r.0.part", ".r.base.part"})
    EXPECT_FALSE(exists(name));
  expect_sentence(
      run("write_restart rods.data/a.restart\n", {}),
      "ERROR: Restart file rods.data/a.restart cannot be written whole: Not a directory");
  expect_sentence(run("write_restart /dev/full\n", {}), "File /dev/full is cut short");
}

TEST_F(FullDisk, DumpThatGoesOn)
{
  const std::string dump = std::string("dump d all custom 10 dump.rods ") + kDump;
  expect_sentence(run_limited(dump + "run 100\n"), "File dump.rods is cut short: File too large");
  expect_sentence(run_limited(dump + "run 100\n", Program::Preloaded),
                  "File dump.rods is cut short: File too large");
  // Not before its end, as nothing is written before the stream's buffer is full.
  expect_sentence(run_limited(dump + "dump_modify d flush no\nrun 10\n"),
                  "File dump.rods is cut short: File too large");
  expect_sentence(run(std::string("dump d all custom 10 /dev/full ") + kDump + "run 10\n", {}),
                  "File /dev/full is cut short");
}

// Frames are there whole or not at all.
TEST_F(FullDisk, DumpOfOneFrameAFile)
{
  const std::string dump = std::string("dump d all custom 10 frame.* ") + kDump + "run 30\n";
  ASSERT_EQ(run(dump, {}).exit_code, 0);
  const std::string whole = folder.read("frame.0");
  ASSERT_GT(whole.size(), 10000u);
  for (const int step : {0, 10, 20, 30})
    std::filesystem::remove(folder / fmt::format("frame.{}", step));
  expect_sentence(run_limited(dump, Program::Lmp, static_cast<int>(whole.size() / 1024)),
                  "File frame.0 is cut short: File too large");
  EXPECT_FALSE(exists("frame.0"));
  EXPECT_FALSE(exists(".frame.0.part"));
}

TEST_F(FullDisk, FilesOfOneCommand)
{
  folder.write("again.data", "old");
  expect_sentence(run_limited("run 0\nwrite_data again.data\n"),
                  "File again.data is cut short: File too large");
  EXPECT_EQ(folder.read("again.data"), "old");
  expect_sentence(
      run_limited(std::string("run 0\nwrite_dump all custom one.dump ") + kDump, Program::Lmp, 40),
      "File one.dump is cut short: File too large");
  EXPECT_FALSE(exists("one.dump"));
}

TEST_F(FullDisk, LogScreenAndOthers)
{
  Launch launch;
  launch.arguments = "-log /dev/full";
  expect_sentence(run("run 10\n", launch), "File /dev/full is cut short");
  launch.arguments = "-screen /dev/full";
  expect_sentence(run("run 10\n", launch), "File /dev/full is cut short");
  expect_sentence(run("log /dev/full\nrun 10\n", {}), "File /dev/full is cut short");
  expect_sentence(run("fix p all print 5 'all is well' file /dev/full\nrun 10\n", {}),
                  "File /dev/full is cut short");
}

TEST_F(FullDisk, IsNotSeenWhereThereIsRoom)
{
  const Outcome outcome =
      run(std::string("dump d all custom 10 frame.* ") + kDump + "dump e all custom 10 dump.rods " +
              kDump + "run 20\nwrite_restart a.restart\nwrite_data again.data\n",
          {});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(outcome.output.find("cut short"), std::string::npos) << outcome.output;
  for (const char *name : {"frame.0", "frame.20", "dump.rods", "a.restart", "again.data"})
    EXPECT_TRUE(exists(name)) << name;
}

// A disk that is full indeed, where the tests may make one.
TEST_F(FullDisk, ThatIsOne)
{
  const std::filesystem::path disk = folder / "disk";
  std::filesystem::create_directory(disk);
  const std::string mount =
      fmt::format("mount -t tmpfs -o size=80k tmpfs {} 2>/dev/null", disk.string());
  if (std::system(mount.c_str()) != 0) GTEST_SKIP() << "only root may mount a disk";
  const Outcome restart = run("write_restart disk/a.restart\n", {});
  const Outcome dump =
      run(std::string("dump d all custom 10 disk/dump.rods ") + kDump + "run 100\n", {});
  EXPECT_EQ(std::system(fmt::format("umount {}", disk.string()).c_str()), 0);
  expect_sentence(restart,
                  "Restart file disk/a.restart cannot be written whole: No space left on device");
  expect_sentence(dump, "File disk/dump.rods is cut short: No space left on device");
}

}  // namespace
