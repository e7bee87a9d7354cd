// SPDX-License-Identifier: GPL-2.0-or-later
// What goes into a file comes back; the same deck gives the same result however it is started.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "scene.h"

using namespace decks;

namespace {

// A few rods of several sizes in motion, falling on a floor.
Scene falling_rods()
{
  Scene scene;
  scene.box_lo[2] = -0.1;
  for (int i = 0; i < 5; i++) {
    Rod rod;
    rod.length = 0.02 + 0.02 * i;
    rod.density = 1000.0 + 400.0 * i;
    rod.position = {-0.4 + 0.2 * i, 0.1 * i, 0.1};
    rod.axis = normalized({0.3 * i - 0.5, 0.4, 0.2 + 0.3 * i});
    rod.velocity = {0.1, -0.2 * i, -1.0};
    rod.omega = {3.0 * i, 1.0, -2.0};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e5, 5e4, 0.5, 0.3) + rod_pair("linear tangential history") +
                  rod_wall("floor", "linear tangential history", "type 1 zplane 0.0") +
                  "fix motion all nve/spherocylinder\nfix weight all gravity 9.81 vector 0 0 -1\n";
  scene.dt = 1e-5;
  scene.steps = 12000;
  return scene;
}

double state_difference(const std::vector<Rod> &a, const std::vector<Rod> &b)
{
  if (a.size() != b.size()) return 1.0;
  double largest = 0.0;
  for (size_t i = 0; i < a.size(); i++)
    for (const double d :
         {norm(a[i].position - b[i].position), norm(a[i].velocity - b[i].velocity),
          norm(a[i].omega - b[i].omega), norm(a[i].axis - b[i].axis),
          std::fabs(a[i].length - b[i].length), std::fabs(a[i].diameter - b[i].diameter),
          std::fabs(a[i].density - b[i].density)})
      largest = std::max(largest, d);
  return largest;
}

// `run 0` and a dump, after the rods are there.
std::string look(const Scene &scene, const std::string &dump)
{
  return "neighbor 0.02 bin\n" + scene.physics +
         "compute contacts all contact/spherocylinder\ntimestep 1e-5\n" +
         exact_dump(dump, 1, kFrameColumns) + "run 0\n";
}

TEST(RoundTrip, RestartFile)
{
  const Scene scene = falling_rods();
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("in.write", preamble(scene) + "read_data rods.data\n" +
                                 look(scene, "dump.before") +
                                 "run 5000\nwrite_restart rods.restart\n");
    folder.write("in.read",
                 preamble(scene) + "read_restart rods.restart\n" + look(scene, "dump.after"));
    // Written on some ranks, read on others.
    ASSERT_EQ(folder.run("in.write", {Program::Lmp, ranks}).exit_code, 0);
    ASSERT_EQ(folder.run("in.read", {Program::Lmp, 3 - ranks}).exit_code, 0);
    EXPECT_EQ(state_difference(read_frames(folder / "dump.before", scene).back().rods,
                               read_frames(folder / "dump.after", scene).back().rods),
              0.0);
  }
}

// Files that `restart` writes within a run hold the tangential springs of that step, as those of
// write_restart do: both go on alike, where a further fix makes both work their forces out anew.
TEST(RoundTrip, RestartFilesWithinARun)
{
  Scene scene = falling_rods();
  scene.rods.clear();
  // A layer that friction holds on another, rocking on its tangential springs.
  for (int n = 0; n < 12; n++) {
    Rod rod;
    const bool upper = n >= 6;
    const double place = -0.075 + 0.03 * (n % 6);
    rod.length = 0.2;
    rod.axis = upper ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
    rod.position = upper ? Vec3{place, 0.0, 0.0149985} : Vec3{0.0, place, 0.004999};
    if (upper) rod.velocity = {4e-4, 3e-4, 0.0};
    scene.rods.push_back(rod);
  }
  const auto whole = [&](const std::string &commands) {
    return preamble(scene) + "read_data rods.data\nneighbor 0.02 bin\n" + scene.physics +
           "timestep 1e-5\n" + commands;
  };
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("in.within", whole("restart 1500 rods.a rods.b\nrun 2000\n"));
    folder.write("in.after", whole("run 1500\nwrite_restart rods.after\n"));
    ASSERT_EQ(folder.run("in.within", {Program::Lmp, ranks}).exit_code, 0);
    ASSERT_EQ(folder.run("in.after", {Program::Lmp, ranks}).exit_code, 0);
    std::vector<Rod> ends[2];
    for (const char *file : {"rods.a", "rods.after"}) {
      folder.write("in.rest", preamble(scene) + fmt::format("read_restart {}\n", file) +
                                  "neighbor 0.02 bin\n" + scene.physics +
                                  "fix other all print 1000 'another fix'\n"
                                  "compute contacts all contact/spherocylinder\ntimestep 1e-5\n" +
                                  exact_dump("dump.rest", 20, kFrameColumns) + "run 20\n");
      ASSERT_EQ(folder.run("in.rest", {Program::Lmp, ranks}).exit_code, 0);
      ends[file[5] == 'a' && file[6] == 'f'] = read_frames(folder / "dump.rest", scene).back().rods;
    }
    EXPECT_EQ(state_difference(ends[0], ends[1]), 0.0) << ranks;
  }
}

TEST(RoundTrip, DataFile)
{
  const Scene scene = falling_rods();
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.write", preamble(scene) + "read_data rods.data\n" + look(scene, "dump.before") +
                               "run 5000\nwrite_data again.data\n");
  folder.write("in.read", preamble(scene) + "read_data again.data\n" + look(scene, "dump.after"));
  const Outcome written = folder.run("in.write");
  ASSERT_EQ(written.exit_code, 0) << written.output;
  const Outcome read = folder.run("in.read");
  ASSERT_EQ(read.exit_code, 0) << read.output;
  // The axis is written, the quaternion made from it: round-off.
  expect_holds({"write_data, read_data: state", "same values", 1e-14},
               state_difference(read_frames(folder / "dump.before", scene).back().rods,
                                read_frames(folder / "dump.after", scene).back().rods));
}

TEST(RoundTrip, ClearAndAgain)
{
  const Scene scene = falling_rods();
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  std::string deck;
  for (const char *dump : {"dump.first", "dump.second"})
    deck += preamble(scene) + "read_data rods.data\n" + look(scene, dump) + "run 5000\nclear\n";
  folder.write("in.twice", deck);
  const Outcome outcome = folder.run("in.twice");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(folder.read("dump.first"), folder.read("dump.second"));
  EXPECT_FALSE(folder.read("dump.first").empty());
}

TEST(RoundTrip, StockProgramWithThePlugInPreloaded)
{
  if (SPHEROCYLINDER_SANITIZED)
    GTEST_SKIP() << "the sanitizers cannot be preloaded after the start";
  Scene scene = falling_rods();
  const std::vector<Rod> lmp = run(scene).back().rods;
  EXPECT_EQ(state_difference(run(scene, Mode::OneRank, Program::Preloaded).back().rods, lmp), 0.0);
  EXPECT_EQ(state_difference(run(scene, Mode::TwoRanks, Program::Preloaded).back().rods,
                             run(scene, Mode::TwoRanks).back().rods),
            0.0);
}

TEST(RoundTrip, DumpColumns)
{
  Scene scene = falling_rods();
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.dump",
               preamble(scene) + "read_data rods.data\nneighbor 0.02 bin\n" + scene.physics +
                   "timestep 1e-5\n" +
                   exact_dump("dump.rods", 1,
                              "id type x y z shapex shapey shapez quat1 quat2 quat3 quat4 inertiax "
                              "inertiay inertiaz mass density radius omegax omegay omegaz angmomx "
                              "angmomy angmomz fx fy fz tqx tqy tqz") +
                   "run 0\n");
  const Outcome outcome = folder.run("in.dump");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table atoms = read_dump(folder / "dump.rods").back().atoms;
  ASSERT_EQ(atoms.rows.size(), scene.rods.size());
  for (size_t i = 0; i < scene.rods.size(); i++) {
    const Rod &rod = scene.rods[i];
    const auto p = rod.properties();
    EXPECT_DOUBLE_EQ(atoms.at(i, "shapex"), rod.radius());
    EXPECT_DOUBLE_EQ(atoms.at(i, "shapey"), rod.radius());
    EXPECT_DOUBLE_EQ(atoms.at(i, "shapez"), 0.5 * rod.length);
    EXPECT_DOUBLE_EQ(atoms.at(i, "radius"), 0.5 * rod.length);
    EXPECT_DOUBLE_EQ(atoms.at(i, "mass"), p.mass);
    EXPECT_DOUBLE_EQ(atoms.at(i, "density"), rod.density);
    EXPECT_DOUBLE_EQ(atoms.at(i, "inertiax"), p.inertia_transverse);
    EXPECT_DOUBLE_EQ(atoms.at(i, "inertiay"), p.inertia_transverse);
    EXPECT_DOUBLE_EQ(atoms.at(i, "inertiaz"), p.inertia_axial);
    const Vec3 L = rod.angular_momentum();
    EXPECT_NEAR(atoms.at(i, "angmomx"), L.x, 1e-14 * norm(L));
    EXPECT_NEAR(atoms.at(i, "angmomy"), L.y, 1e-14 * norm(L));
    EXPECT_NEAR(atoms.at(i, "angmomz"), L.z, 1e-14 * norm(L));
    EXPECT_NEAR(atoms.at(i, "fz"), -9.81 * p.mass, 1e-14);
    const double w = atoms.at(i, "quat1"), x = atoms.at(i, "quat2"), y = atoms.at(i, "quat3"),
                 z = atoms.at(i, "quat4");
    EXPECT_NEAR(w * w + x * x + y * y + z * z, 1.0, 1e-15);
    EXPECT_NEAR(2.0 * (x * z + w * y), rod.axis.x, 1e-15);
    EXPECT_NEAR(2.0 * (y * z - w * x), rod.axis.y, 1e-15);
    EXPECT_NEAR(1.0 - 2.0 * (x * x + y * y), rod.axis.z, 1e-15);
  }
}

}  // namespace
