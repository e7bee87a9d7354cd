// SPDX-License-Identifier: GPL-2.0-or-later
// What mesh walls report, and what must not change them: forces and torques on meshes, servo plates, ranks,
// restarts, periodic boxes, several meshes and types, contact models, stock LIGGGHTS's spheres.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "mesh_files.h"
#include "scene.h"
#include "stock_spheres.h"

using namespace decks;

namespace {

const std::string kModels = "linear tangential history";
const std::string kMotion = "fix motion all nve/spherocylinder\n";
const std::string kWeight = "fix weight all gravity 9.81 vector 0.0 0.0 -1.0\n";
const std::string kMaterial = linear_material(2e5, 1.2e5, 0.6, 0.3) + rod_pair(kModels);

// Rods with velocities in a closed box of side 0.3 about the origin, as far apart as may be.
std::vector<Rod> rods_in_a_box(int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Rod> rods;
  for (int n = 0; n < count; n++) {
    Rod rod;
    rod.length = (n % 3 == 0 ? 2.0 : n % 3 == 1 ? 4.0 : 6.0) * rod.diameter;
    rod.axis = normalized({any(random), any(random), any(random)});
    rod.position = {-0.1 + 0.1 * (n % 3), -0.1 + 0.1 * (n / 3 % 3), -0.1 + 0.1 * (n / 9)};
    rod.velocity = 3.0 * Vec3{any(random), any(random), any(random)};
    rod.omega = 30.0 * Vec3{any(random), any(random), any(random)};
    rods.push_back(rod);
  }
  return rods;
}

Scene box_scene(const std::string &walls, int count = 27)
{
  Scene scene;
  scene.rods = rods_in_a_box(count, 15487469);
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.16;
    scene.box_hi[d] = 0.16;
  }
  scene.skin = 0.01;
  const Vec3 low = {-0.15, -0.15, -0.15}, high = {0.15, 0.15, 0.15};
  scene.files["box.stl"] = stl(box_mesh(low, high, 5));
  scene.physics = kMaterial + walls + kWeight + kMotion;
  scene.dt = 5e-6;
  scene.steps = 6000;
  scene.dump_every = 3000;
  return scene;
}

std::string box_walls(const std::string &keywords = "")
{
  return mesh_fix("m", "box.stl") + mesh_wall("walls", kModels, {"m"}, keywords);
}

// The deck of a scene up to its run, with `commands` after it; thermo output in all digits.
Outcome run_deck(const DeckFolder &folder, const Scene &scene, const std::string &commands,
                 Mode mode = Mode::OneRank, int ranks = 1)
{
  folder.write("rods.data", data_file(scene));
  for (const auto &[name, text] : scene.files) folder.write(name, text);
  folder.write("in.mesh", preamble(scene, mode) + "read_data rods.data\n" +
                              fmt::format("neighbor {} bin\nneigh_modify delay 0\ntimestep {}\n",
                                          scene.skin, scene.dt) +
                              scene.physics + commands);
  return folder.run("in.mesh", {Program::Lmp, ranks, 60});
}

}  // namespace

// ---- ranks, restarts, periodic boxes ------------------------------------------------------------

class MeshRuns : public testing::TestWithParam<Mode> {};

TEST_P(MeshRuns, MoveRodsAsOnOneRank)
{
  Scene scene = box_scene(box_walls());
  // A first force of a run has the velocities of a whole step, others of half a step before: without damping
  // that makes no difference to a restart.
  if (GetParam() == Mode::Restarted)
    scene.physics =
        linear_material(2e5, 1.2e5, 1.0, 0.3) + rod_pair(kModels) + box_walls() + kWeight + kMotion;
  const std::vector<Frame> wanted = run(scene);
  expect_holds({fmt::format("27 rods in a box of triangles, {}: position (m)", name_of(GetParam())),
                "one rank", 1e-10},
               largest_difference(wanted, run(scene, GetParam())));
  int turned = 0;
  for (size_t k = 0; k < scene.rods.size(); k++)
    turned += norm(wanted.back().rods[k].velocity - scene.rods[k].velocity) > 0.5;
  EXPECT_GT(turned, 10);
}

// A floor through the periodic boundaries of a box, rods across them; as zplane.
TEST_P(MeshRuns, AreThePlaneThroughPeriodicBoundaries)
{
  Scene scene;
  scene.boundary = "p p f";
  std::mt19937 random(7919);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int n = 0; n < 9; n++) {
    Rod rod;
    rod.axis = normalized({any(random), any(random), 0.05 * any(random)});
    rod.position = {0.145 * (n % 3 - 1), 0.145 * (n / 3 - 1), 0.008};
    rod.length = 0.06;
    rod.velocity = {3.0 + any(random), 0.5 * any(random), 0.0};
    scene.rods.push_back(rod);
  }
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.2;
    scene.box_hi[d] = 0.2;
  }
  scene.skin = 0.01;
  scene.dt = 1e-5;
  scene.steps = 8000;
  scene.dump_every = 4000;
  scene.physics = kMaterial + rod_wall("floor", kModels, "type 1 zplane 0.0") + kWeight + kMotion;
  const std::vector<Frame> wanted = run(scene);
  scene.files["floor.stl"] =
      stl(tiled({{-0.2, -0.2, 0.0}, {0.4, 0.0, 0.0}, {0.0, 0.4, 0.0}}, 9, 8));
  scene.physics = kMaterial + mesh_fix("m", "floor.stl") + mesh_wall("floor", kModels, {"m"}) +
                  kWeight + kMotion;
  expect_holds(
      {fmt::format("Rods on a periodic floor of triangles, {}: position (m)", name_of(GetParam())),
       "zplane", 1e-9},
      largest_difference(wanted, run(scene, GetParam())));
}

INSTANTIATE_TEST_SUITE_P(, MeshRuns,
                         testing::Values(Mode::OneRank, Mode::TwoRanks, Mode::FourRanks,
                                         Mode::Restarted),
                         [](const auto &info) { return name_of(info.param); });

// The borders of three subdomains go through faces of the mesh, not along its seams.
TEST(MeshWalls, OnThreeRanks)
{
  const Scene scene = box_scene(box_walls());
  const auto end = [&](int ranks) {
    const DeckFolder folder;
    Scene cut = scene;
    const Outcome outcome =
        run_deck(folder, cut,
                 exact_dump("dump.end", cut.steps, "id x y z") + fmt::format("run {}\n", cut.steps),
                 Mode::OneRank, ranks);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return read_dump(folder / "dump.end").back().atoms;
  };
  const Table one = end(1), three = end(3);
  ASSERT_EQ(one.rows.size(), three.rows.size());
  double error = 0.0;
  for (size_t k = 0; k < one.rows.size(); k++)
    for (size_t c = 1; c < 4; c++)
      error = std::max(error, std::fabs(one.rows[k][c] - three.rows[k][c]));
  expect_holds({"27 rods in a box of triangles on three ranks: position (m)", "one rank", 1e-10},
               error);
}

// Contacts in a restart file know triangles by their numbers, and the models' values by their places.
TEST(MeshWalls, GoOnWithTheContactsOfTheSameMeshesOnly)
{
  Scene scene = box_scene(box_walls());
  const Vec3 low = {-0.15, -0.15, -0.15}, high = {0.15, 0.15, 0.15};
  scene.files["finer.stl"] = stl(box_mesh(low, high, 6));
  scene.files["wider.stl"] = stl(box_mesh(1.001 * low, 1.001 * high, 5));
  scene.files["lid.stl"] =
      stl(tiled({{-0.1, -0.1, 0.155}, {0.2, 0.0, 0.0}, {0.0, 0.2, 0.0}}, 1, 1));
  const DeckFolder folder;
  ASSERT_EQ(run_deck(folder, scene, "run 2000\nwrite_restart at.2000\n").exit_code, 0);
  const auto go_on = [&](const std::string &walls) {
    folder.write("in.on", preamble(scene, Mode::OneRank) + "read_restart at.2000\n" +
                              fmt::format("neighbor {} bin\ntimestep {}\n", scene.skin, scene.dt) +
                              kMaterial + walls + kWeight + kMotion + "run 10\n");
    return folder.run("in.on", {Program::Lmp, 1, 60});
  };
  const auto walls_of = [](const std::string &file, const std::string &id = "walls",
                           const std::string &models = kModels) {
    return mesh_fix("other", file) + mesh_wall(id, models, {"other"});
  };
  EXPECT_EQ(go_on(walls_of("box.stl")).exit_code, 0);
  EXPECT_EQ(go_on(walls_of("finer.stl", "new")).exit_code, 0);

  const std::string rolling =
      "fix r all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
      "fix s all property/global coefficientRollingViscousDamping peratomtypepair 1 0.1\n";
  const std::string same_mesh = "expected the same mesh, or another id";
  const std::pair<std::string, std::string> wrong[] = {
      {walls_of("finer.stl"),
       "Fix wall/gran (id walls): the restart file holds contacts with a mesh of 300 triangles and an "
       "area of 0.54 where mesh other is (got 432 and 0.54; " +
           same_mesh},
      {walls_of("wider.stl"),
       "area of 0.54 where mesh other is (got 300 and 0.541081; " + same_mesh},
      {mesh_fix("other", "box.stl") + mesh_fix("lid", "lid.stl") +
           mesh_wall("walls", kModels, {"other", "lid"}),
       "Fix wall/gran (id walls): the restart file holds its contacts with 1 meshes (got 2; expected "
       "the same meshes"},
      {walls_of("box.stl", "walls", "linear tangential no_history"),
       "Fix wall/gran (id walls): the restart file holds contacts of "},
      {rolling + walls_of("box.stl", "walls", "linear tangential off rolling_friction epsd2"),
       "Fix wall/gran (id walls): the restart file holds contacts of other contact models"}};
  for (const auto &[walls, sentence] : wrong) {
    const Outcome outcome = go_on(walls);
    EXPECT_NE(outcome.exit_code, 0) << walls;
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << outcome.output;
  }
}

// Rods that a command puts to the other side of a sheet between two runs are where they are: on no side of
// before. Those that it leaves, or moves by less than their radius, go on.
TEST(MeshWalls, ForgetContactsOfRodsThatWerePutElsewhere)
{
  Scene scene;
  scene.rods.resize(2);
  for (int n = 0; n < 2; n++) scene.rods[n].position = {0.01, 0.2 * n, 0.00499};
  scene.rods[0].length = 0.04;
  scene.files["sheet.stl"] =
      stl(tiled({{-0.5, -0.5, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 3, 3));
  scene.physics =
      kMaterial + mesh_fix("sheet", "sheet.stl") + mesh_wall("wall", kModels, {"sheet"}) + kMotion;
  const double pushed = 2e5 * 1e-5;  // kn overlap, at each end
  // Moves of the first rod: how, and its force after them.
  const struct {
    std::string command;
    double force;
  } moves[] = {{"displace_atoms one move 0.0 0.0 -0.15\n", 0.0},
               {"displace_atoms one move 0.0 0.0 -0.00998\n", -2.0 * pushed},
               {"set group one z -0.15\n", 0.0},
               {"displace_atoms one move 0.2 0.0 0.0\n", 2.0 * pushed},
               {"displace_atoms one move 0.0 0.0 -0.001\n", 2.0 * (pushed + 2e5 * 1e-3)}};
  for (const auto &[command, force] : moves)
    for (const char *words : {"", " pre no"}) {
      const DeckFolder folder;
      const Outcome outcome = run_deck(folder, scene,
                                       "group one id 1\n" + exact_dump("dump.f", 1, "id fz") +
                                           "run 1\n" + command + "run 1" + words + "\n");
      ASSERT_EQ(outcome.exit_code, 0) << command << outcome.output;
      const auto rows = read_dump(folder / "dump.f").back().atoms.rows;
      EXPECT_NEAR(rows[0][1], force, 0.05 * (2.0 * pushed) + 0.001 * std::fabs(force))
          << command << words;
      EXPECT_NEAR(rows[1][1], 2.0 * pushed, 0.1 * pushed) << command << words;
    }
}

// A second run is one that goes on from a restart file, to the last bit.
TEST(MeshWalls, GoOnInTheNextRunAsFromARestart)
{
  Scene scene = box_scene(box_walls());
  scene.boundary = "p p f";
  for (int d = 0; d < 2; d++) {
    scene.box_lo[d] = -0.15;
    scene.box_hi[d] = 0.15;
  }
  scene.files["floor.stl"] =
      stl(tiled({{-0.15, -0.15, -0.14}, {0.3, 0.0, 0.0}, {0.0, 0.3, 0.0}}, 2, 2));
  scene.files["lid.stl"] =
      stl(tiled({{-0.15, -0.15, 0.14}, {0.3, 0.0, 0.0}, {0.0, 0.3, 0.0}}, 2, 2));
  const std::string physics = linear_material(2e5, 1.2e5, 0.6, 0.3) + rod_pair(kModels) +
                              mesh_fix("floor", "floor.stl") + mesh_fix("lid", "lid.stl") +
                              mesh_wall("walls", kModels, {"floor", "lid"}) + kWeight + kMotion;
  scene.physics = physics;
  const std::string dump =
      "compute contacts all contact/spherocylinder\n" + exact_dump("dump.end", 4000, kFrameColumns);
  const auto end = [&](const std::string &commands) {
    const DeckFolder folder;
    const Outcome outcome = run_deck(folder, scene, commands);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    if (commands.find("write_restart") != std::string::npos) {
      folder.write("in.on", preamble(scene) + "read_restart at.2000\n" +
                                fmt::format("neighbor {} bin\nneigh_modify delay 0\ntimestep {}\n",
                                            scene.skin, scene.dt) +
                                physics + dump + "run 2000\n");
      const Outcome on = folder.run("in.on", {Program::Lmp, 1, 60});
      EXPECT_EQ(on.exit_code, 0) << on.output;
    }
    return read_dump(folder / "dump.end").back().atoms.rows;
  };
  EXPECT_EQ(end(dump + "run 2000\nrun 2000\n"), end("run 2000\nwrite_restart at.2000\n"));
}

// Six sheets as six meshes of one wall, or with planes in the place of four of them, are one box.
// LIGGGHTS knows one fix wall/gran of meshes.
TEST(MeshWalls, MayBeOfManyMeshesAndManyWalls)
{
  const std::vector<Frame> wanted = run(box_scene(box_walls()));
  const Vec3 low = {-0.15, -0.15, -0.15}, high = {0.15, 0.15, 0.15};
  const Mesh box = box_mesh(low, high, 5);
  for (const int meshes : {6, 2}) {
    std::string fixes;
    std::vector<std::string> names;
    Scene scene = box_scene("");
    // The box's faces: z, x, y at the low side, then at the high one.
    for (int k = 0; k < 6; k++) {
      const std::string name = fmt::format("m{}", k);
      if (k % 3 < meshes / 2) {
        scene.files[name + ".stl"] = stl({box.begin() + k * 50, box.begin() + (k + 1) * 50});
        fixes += mesh_fix(name, name + ".stl");
        names.push_back(name);
      } else {
        fixes += rod_wall(name, kModels,
                          fmt::format("type 1 {}plane {}", "zxy"[k % 3], k < 3 ? -0.15 : 0.15));
      }
    }
    scene.physics = kMaterial + fixes + mesh_wall("walls", kModels, names) + kWeight + kMotion;
    expect_holds({fmt::format("27 rods in a box of {} meshes and {} planes: position (m)", meshes,
                              6 - meshes),
                  "one mesh", 1e-10},
                 largest_difference(wanted, run(scene)));
  }
}

// Types of rods and of meshes: each contact takes its own pair's values, m g/(2 kn) deep.
TEST(MeshWalls, TakeTheValuesOfTypes)
{
  Scene scene;
  scene.types = 3;
  for (int n = 0; n < 4; n++) {
    Rod rod;
    rod.type = 2 + n % 2;
    rod.axis = {0.0, 1.0, 0.0};
    rod.position = {n < 2 ? -0.2 : 0.2, n % 2 ? 0.1 : -0.1, rod.radius()};
    scene.rods.push_back(rod);
  }
  const auto stiffness = [](int i, int j) { return 1e4 * (i * j); };
  scene.files["left.stl"] = stl(tiled({{-0.5, -0.5, 0.0}, {0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 3, 3));
  scene.files["right.stl"] = stl(tiled({{0.0, -0.5, 0.0}, {0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 3, 3));
  scene.physics = pair_property("kn", 3, stiffness) + pair_property("kt", 3, 1e4) +
                  pair_property("coefficientRestitution", 3, 0.2) +
                  pair_property("coefficientFriction", 3, 0.3) + rod_pair(kModels) +
                  mesh_fix("left", "left.stl") +
                  "fix right all mesh/surface file right.stl type 3\n" +
                  mesh_wall("floor", kModels, {"left", "right"}) + kWeight + kMotion;
  scene.dt = 2e-5;
  scene.steps = 15000;
  const std::vector<Rod> end = run(scene).back().rods;
  for (int n = 0; n < 4; n++) {
    const Rod &rod = end[n];
    const double depth = 0.5 * rod.mass() * 9.81 / stiffness(rod.type, n < 2 ? 1 : 3);
    EXPECT_NEAR(rod.radius() - rod.position.z, depth, 1e-6 * depth) << n;
  }
}

// ---- forces on meshes ---------------------------------------------------------------------------

// What the mesh gets is what the rods lose, in each step: force and torque about its reference point.
// From the times of half steps: p' - p = -dt (F + F')/2 and the same for angular momentum.
TEST(MeshStress, IsTheChangeOfMomentum)
{
  for (const int ranks : {1, 2}) {
    Scene scene = box_scene(
        mesh_fix("m", "box.stl", "reference_point 0.02 -0.03 0.05", "mesh/surface/stress") +
        mesh_wall("walls", kModels, {"m"}));
    scene.physics =
        kMaterial +
        mesh_fix("m", "box.stl", "reference_point 0.02 -0.03 0.05", "mesh/surface/stress") +
        mesh_wall("walls", kModels, {"m"}) + kMotion;  // no weight
    const int steps = 4000;
    const DeckFolder folder;
    const Outcome outcome =
        run_deck(folder, scene,
                 "compute contacts all contact/spherocylinder\n"
                 "thermo_style custom step f_m[1] f_m[2] f_m[3] f_m[4] f_m[5] f_m[6]\nthermo 1\n"
                 "thermo_modify norm no format float %.17g\n" +
                     exact_dump("dump.rods", steps, kFrameColumns) + fmt::format("run {}\n", steps),
                 ranks == 2 ? Mode::TwoRanks : Mode::OneRank, ranks);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const std::vector<Frame> frames = read_frames(folder / "dump.rods", scene);
    const Table thermo = read_thermo(outcome.output);
    ASSERT_EQ(thermo.rows.size(), static_cast<size_t>(steps) + 1);
    double sums[6] = {}, sizes = 0.0;
    for (size_t n = 0; n < thermo.rows.size(); n++)
      for (int k = 0; k < 6; k++) {
        const double part = n == 0 || n == thermo.rows.size() - 1 ? 0.5 : 1.0;
        sums[k] += part * scene.dt * thermo.rows[n][k + 1];
        sizes += scene.dt * std::fabs(thermo.rows[n][k + 1]);
      }
    const Vec3 about = {0.02, -0.03, 0.05};
    const Vec3 p = momentum(frames.back().rods) - momentum(frames.front().rods);
    const Vec3 l =
        angular_momentum(frames.back().rods, about) - angular_momentum(frames.front().rods, about);
    expect_holds({"Force on a mesh, summed over 4000 steps: momentum, relative",
                  "change of the rods' momentum", 1e-12},
                 norm(p + Vec3{sums[0], sums[1], sums[2]}) / sizes);
    expect_holds({"Torque on a mesh, summed over 4000 steps: angular momentum, relative",
                  "change of the rods' angular momentum", 1e-12},
                 norm(l + Vec3{sums[3], sums[4], sums[5]}) / sizes);
    EXPECT_GT(sizes, 0.01);
  }
}

// A plate that is driven down on rods on a floor reaches its force. 18 contacts of 2e5 N/m: at 0.01 m/s and
// 5 x the part that is missing a step moves it by up to a tenth of what stops it.
TEST(MeshServo, ReachesItsForce)
{
  const double wanted = 20.0;
  Scene scene;
  for (int n = 0; n < 9; n++) {
    Rod rod;
    rod.axis = normalized({std::cos(0.7 * n), std::sin(0.7 * n), 0.0});
    rod.position = {0.15 * (n % 3 - 1), 0.15 * (n / 3 - 1), rod.radius()};
    scene.rods.push_back(rod);
  }
  scene.files["lid.stl"] =
      stl(tiled({{-0.3, -0.3, 0.0102}, {0.6, 0.0, 0.0}, {0.0, 0.6, 0.0}}, 4, 4));
  scene.physics =
      kMaterial + rod_wall("floor", kModels, "type 1 zplane 0.0") +
      mesh_fix(
          "lid", "lid.stl",
          "com 0.0 0.0 0.0102 ctrlPV force axis 0.0 0.0 -1.0 target_val 20.0 vel_max 0.01 kp 5.0",
          "mesh/surface/stress/servo") +
      mesh_wall("press", kModels, {"lid"}) + kWeight + kMotion;
  scene.dt = 1e-5;
  const DeckFolder folder;
  const Outcome outcome =
      run_deck(folder, scene,
               "thermo_style custom step f_lid[1] f_lid[2] f_lid[3] f_lid[9]\nthermo 2000\n"
               "thermo_modify norm no format float %.12g\nrun 16000\n");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  expect_holds({"Servo plate on nine rods: force, relative", "target_val", 0.01},
               std::fabs(thermo.rows.back()[3] / wanted - 1.0));
}

// Forces stored per rod are those on the mesh.
TEST(MeshForces, StoredAndListedAreTheRods)
{
  Scene scene = box_scene("");
  scene.physics = kMaterial + box_walls("store_force yes") + kMotion;
  const DeckFolder folder;
  std::string commands = "compute rows all wall/gran/local id force torque contactPoint delta\n";
  for (int k = 1; k <= 3; k++)
    commands += fmt::format("compute s{0} all reduce sum f_force_walls[{0}]\n", k);
  commands +=
      "variable tx atom fx\nvariable ty atom fy\nvariable tz atom fz\n"
      "compute t all reduce sum v_tx v_ty v_tz\ncompute c all reduce sum c_rows[4] c_rows[5] "
      "c_rows[6]\nthermo_style custom step c_s1 c_s2 c_s3 c_c[1] c_c[2] c_c[3]\nthermo 100\n"
      "thermo_modify norm no format float %.17g\nrun 3000\n";
  const Outcome outcome = run_deck(folder, scene, commands);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  double error = 0.0, size = 0.0;
  for (const std::vector<double> &row : read_thermo(outcome.output).rows)
    for (int k = 1; k <= 3; k++) {
      error = std::max(error, std::fabs(row[k] - row[k + 3]));
      size = std::max(size, std::fabs(row[k]));
    }
  EXPECT_GT(size, 1.0);
  EXPECT_LT(error, 1e-11 * size);
}

// ---- stock spheres ------------------------------------------------------------------------------

namespace {

struct Models {
  const char *name, *words;
};

void PrintTo(const Models &models, std::ostream *out) { *out << models.words; }

const char *const kAllMaterials = R"(
fix p1 all property/global kn peratomtypepair 1 1e5
fix p2 all property/global kt peratomtypepair 1 5e4
fix p3 all property/global gamman peratomtypepair 1 2000.0
fix p4 all property/global gammat peratomtypepair 1 1000.0
fix p5 all property/global youngsModulus peratomtype 5e6
fix p6 all property/global poissonsRatio peratomtype 0.45
fix p7 all property/global coefficientRestitution peratomtypepair 1 0.7
fix p8 all property/global coefficientFriction peratomtypepair 1 0.3
fix p9 all property/global characteristicVelocity scalar 1.0
fix p10 all property/global coefficientRollingFriction peratomtypepair 1 0.1
fix p11 all property/global coefficientRollingViscousDamping peratomtypepair 1 0.1
fix p12 all property/global cohesionEnergyDensity peratomtypepair 1 20000.0
)";

// Balls over a block: on its upper face, over its rims and over its corners, each on its own and down on
// it with spin.
std::vector<Rod> balls_over_a_block()
{
  std::vector<Rod> balls;
  const double places[][2] = {{0.01, 0.03}, {-0.04, -0.01}, {0.1, 0.02}, {-0.03, 0.1},
                              {-0.1, 0.01}, {0.1, 0.1},     {-0.1, -0.1}};
  for (const auto &place : places) {
    Rod ball;
    ball.diameter = ball.length = 0.014;
    const double n = static_cast<double>(balls.size());
    // Beyond the rim by a part of the radius.
    const auto beyond = [](double x) { return std::fabs(x) == 0.1 ? x * 1.025 : x; };
    ball.position = {beyond(place[0]), beyond(place[1]), 0.0085};
    ball.velocity = {0.02 * (n - 3.0), 0.03, -0.5};
    ball.omega = {10.0 - 3.0 * n, 5.0, 2.0 * n};
    balls.push_back(ball);
  }
  return balls;
}

std::string ball_deck(bool stock, const std::string &models)
{
  const char *surface = stock ? "default" : "spherocylinder";
  return fmt::format(R"(atom_style {0}
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
read_data balls.data
neighbor 0.004 bin
neigh_modify delay 0
{1}
pair_style gran model {2} surface {3}
pair_coeff * *
fix m all mesh/surface file block.stl type 1
fix block all wall/gran model {2} surface {3} mesh n_meshes 1 meshes m
timestep 1e-6
fix weight all gravity 9.81 vector 0 0 -1
fix motion all {4}
thermo 20000
{5}run 20000
)",
                     stock ? "granular" : "spherocylinder", kAllMaterials, models, surface,
                     stock ? "nve/sphere" : "nve/spherocylinder",
                     exact_dump("dump.balls", 2000, "id x y z vx vy vz omegax omegay omegaz"));
}

class MeshSphereLimit : public testing::TestWithParam<Models> {};

}  // namespace

TEST_P(MeshSphereLimit, IsStockLiggghtsOnTheSameMesh)
{
  const DeckFolder ours, stock;
  Scene scene;
  scene.rods = balls_over_a_block();
  const std::string block = stl(box_mesh({-0.1, -0.1, -0.2}, {0.1, 0.1, 0.0}, 4));
  ours.write("block.stl", block);
  stock.write("block.stl", block);
  ours.write("balls.data", data_file(scene));
  stock.write("balls.data", granular_data_file(scene.rods, -1.0, 1.0));
  ours.write("in.balls", ball_deck(false, GetParam().words));
  stock.write("in.balls", ball_deck(true, GetParam().words));
  const Outcome our_outcome = ours.run("in.balls");
  ASSERT_EQ(our_outcome.exit_code, 0) << our_outcome.output;
  const Outcome stock_outcome = stock.run("in.balls", {Program::Stock, 1});
  ASSERT_EQ(stock_outcome.exit_code, 0) << stock_outcome.output;
  const auto got = read_dump(ours / "dump.balls"), wanted = read_dump(stock / "dump.balls");
  ASSERT_EQ(got.size(), wanted.size());
  double position = 0.0, spin = 0.0;
  for (size_t f = 0; f < got.size(); f++)
    for (size_t k = 0; k < scene.rods.size(); k++) {
      double apart = 0.0;
      for (size_t c = 1; c < 4; c++)
        apart = std::max(apart, std::fabs(got[f].atoms.rows[k][c] - wanted[f].atoms.rows[k][c]));
      position = std::max(position, apart);
      for (size_t c = 7; c < 10; c++)
        spin = std::max(spin, std::fabs(got[f].atoms.rows[k][c] - wanted[f].atoms.rows[k][c]));
      if (apart > 1e-10 && f + 1 == got.size()) fmt::print("ball {}: {:.1e} m\n", k, apart);
    }
  expect_holds({fmt::format("Balls on faces, rims and corners of a block, {}: position (m)",
                            GetParam().words),
                "stock LIGGGHTS", 1e-10},
               position);
  expect_holds({fmt::format("Balls on faces, rims and corners of a block, {}: spin (rad/s)",
                            GetParam().words),
                "stock LIGGGHTS", 1e-6},
               spin);
}

INSTANTIATE_TEST_SUITE_P(
    , MeshSphereLimit,
    testing::Values(Models{"Hooke", "hooke tangential history"},
                    Models{"Stiffness", "hooke/stiffness tangential no_history"},
                    Models{"Hertz", "hertz tangential history"},
                    Models{"HertzOff", "hertz tangential off"},
                    Models{"Rolling", "hertz tangential history rolling_friction epsd2"},
                    Models{"Sjkr", "hertz tangential history cohesion sjkr"}),
    [](const auto &info) { return std::string(info.param.name); });

// The same models on rods: a floor of triangles is zplane.
class MeshModels : public testing::TestWithParam<Models> {};

TEST_P(MeshModels, AreThoseOfThePlane)
{
  const auto moved = [](bool mesh) {
    Scene scene;
    for (int n = 0; n < 4; n++) {
      Rod rod;
      rod.length = 0.03 + 0.02 * n;
      rod.axis = normalized({std::cos(1.0 * n), std::sin(1.0 * n), 0.05 * n});
      rod.position = {0.2 * (n - 1.5), 0.02 * n,
                      rod.radius() + 1e-4 + rod.half_cylinder() * rod.axis.z};
      rod.velocity = {0.1, 0.05 * n, -0.1};
      scene.rods.push_back(rod);
    }
    scene.files["floor.stl"] =
        stl(tiled({{-0.9, -0.9, 0.0}, {1.8, 0.0, 0.0}, {0.0, 1.8, 0.0}}, 31, 29));
    const std::string words = GetParam().words;
    scene.physics = kAllMaterials + rod_pair(words) +
                    (mesh ? mesh_fix("m", "floor.stl") + mesh_wall("floor", words, {"m"})
                          : rod_wall("floor", words, "type 1 zplane 0.0")) +
                    kWeight + kMotion;
    scene.dt = 1e-5;
    scene.steps = 5000;
    scene.dump_every = 500;
    return run(scene);
  };
  expect_holds({fmt::format("Rods on a floor of triangles, {}: position (m)", GetParam().words),
                "zplane", 1e-12},
               largest_difference(moved(true), moved(false)));
}

INSTANTIATE_TEST_SUITE_P(
    , MeshModels,
    testing::Values(Models{"Hooke", "hooke tangential history"},
                    Models{"Stiffness", "hooke/stiffness tangential no_history"},
                    Models{"Hertz", "hertz tangential history"},
                    Models{"HertzOff", "hertz tangential off"},
                    Models{"Linear", "linear tangential history"},
                    Models{"RollingCdt", "hertz tangential history rolling_friction cdt"},
                    Models{"RollingEpsd2", "hertz tangential history rolling_friction epsd2"},
                    Models{"Sjkr", "hertz tangential history cohesion sjkr"},
                    Models{"Sjkr2", "hooke tangential history cohesion sjkr2"}),
    [](const auto &info) { return std::string(info.param.name); });

// Heat from a hot floor flows as from a hot plane: 4 k sqrt(A) dT at each end.
TEST(MeshHeat, IsThatOfAPlane)
{
  const auto heat = [](bool mesh) {
    Scene scene;
    Rod rod;
    rod.position.z = rod.radius() - 1e-5;
    scene.rods = {rod};
    scene.files["floor.stl"] =
        stl(tiled({{-0.9, -0.9, 0.0}, {1.8, 0.0, 0.0}, {0.0, 1.8, 0.0}}, 31, 29));
    const std::string words = "hertz tangential history";
    scene.physics =
        kAllMaterials + rod_pair(words) +
        (mesh ? mesh_fix("m", "floor.stl", "temperature 800.0") + mesh_wall("floor", words, {"m"})
              : rod_wall("floor", words, "type 1 zplane 0.0 temperature 800.0")) +
        kMotion +
        "fix Yo all property/global youngsModulusOriginal peratomtype 8.0e7\n"
        "fix k all property/global thermalConductivity peratomtype 100.0\n"
        "fix c all property/global thermalCapacity peratomtype 10.0\n"
        "fix heat all heat/gran/conduction initial_temperature 300.0\n";
    scene.dt = 1e-9;
    const DeckFolder folder;
    const Outcome outcome =
        run_deck(folder, scene, exact_dump("dump.heat", 2, "id f_heat f_heatFlux[0]") + "run 2\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return outcome.exit_code ? 0.0 : read_dump(folder / "dump.heat").back().atoms.rows[0][2];
  };
  const double plane = heat(false);
  EXPECT_GT(plane, 1.0);
  EXPECT_NEAR(heat(true), plane, 1e-9 * plane);
}

// ---- bad input ----------------------------------------------------------------------------------

// A rod that starts across a sheet, by its middle or nearly: it runs, with one warning that names rod,
// mesh and a triangle.
TEST(MeshInput, WarnsOfARodAcrossAFace)
{
  for (const double height : {0.04, 0.01}) {
    Scene scene;
    Rod rod;
    rod.axis = {0.0, 0.0, 1.0};
    rod.position = {0.01, 0.02, height};
    scene.rods = {rod};
    scene.files["sheet.stl"] =
        stl(tiled({{-0.5, -0.5, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 3, 3));
    scene.physics = kMaterial + mesh_fix("sheet", "sheet.stl") +
                    mesh_wall("wall", kModels, {"sheet"}) + kMotion;
    scene.dt = 1e-6;
    const DeckFolder folder;
    const Outcome outcome = run_deck(folder, scene, "run 100\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    const size_t at = outcome.output.find(
        "Fix wall/gran (id wall): rod 1 goes through a face of mesh sheet, near triangle");
    EXPECT_NE(at, std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find("goes through a face", at + 60), std::string::npos);
  }
}

// A sheet on a part of another in its plane bears twice: one warning with both triangles. Sheets that meet edge to
// edge, tiles of other sizes beside each other, and one above the other are nothing to tell of.
TEST(MeshInput, WarnsOfSheetsThatOverlap)
{
  const Mesh sheet = tiled({{-0.5, -0.5, 0.0}, {0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 2, 3);
  const struct {
    Mesh more;
    bool overlaps;
  } cases[] = {{tiled({{-0.2, -0.2, 0.0}, {0.4, 0.0, 0.0}, {0.0, 0.4, 0.0}}, 1, 1), true},
               {tiled({{0.0, -0.5, 0.0}, {0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 3, 7), false},
               {tiled({{-0.2, -0.2, 0.001}, {0.4, 0.0, 0.0}, {0.0, 0.4, 0.0}}, 1, 1), false},
               {tiled({{-0.2, -0.2, -0.2}, {0.4, 0.0, 0.4}, {0.0, 0.4, 0.0}}, 1, 1), false}};
  for (const auto &[more, overlaps] : cases)
    for (const int ranks : {1, 2}) {
      Scene scene;
      scene.rods = {Rod()};
      scene.rods[0].position.z = 0.02;
      Mesh mesh = sheet;
      mesh.insert(mesh.end(), more.begin(), more.end());
      scene.files["sheets.stl"] = stl(mesh);
      scene.physics = kMaterial + mesh_fix("sheets", "sheets.stl") +
                      mesh_wall("wall", kModels, {"sheets"}) + kMotion;
      const DeckFolder folder;
      const Outcome outcome = run_deck(folder, scene, "run 10\nrun 10\n",
                                       ranks == 2 ? Mode::TwoRanks : Mode::OneRank, ranks);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
      const std::string told = "Fix wall/gran (id wall): a free edge of triangle ";
      const size_t at = outcome.output.find(told);
      EXPECT_EQ(at != std::string::npos, overlaps) << outcome.output;
      EXPECT_TRUE(!overlaps || outcome.output.find(told, at + 1) == std::string::npos);
    }
}

// The wall needs its mesh: unfixing it alone is told, and so is a mesh that is named twice.
TEST(MeshInput, TellsOfAMeshThatIsTakenAwayOrNamedTwice)
{
  Scene scene;
  scene.rods = {Rod()};
  scene.rods[0].position.z = 0.01;
  scene.files["sheet.stl"] =
      stl(tiled({{-0.5, -0.5, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 2, 2));
  scene.dt = 1e-6;
  const std::string sheet = kMaterial + mesh_fix("sheet", "sheet.stl");
  scene.physics = sheet + mesh_wall("wall", kModels, {"sheet"}) + kMotion;
  const DeckFolder taken;
  const Outcome outcome = run_deck(taken, scene, "run 10\nunfix sheet\nrun 10\n");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("can not unfix while fix wall/gran (id wall) is active"),
            std::string::npos)
      << outcome.output;
  scene.physics = sheet + mesh_wall("wall", kModels, {"sheet", "sheet"}) + kMotion;
  const DeckFolder twice;
  const Outcome named = run_deck(twice, scene, "run 10\n");
  EXPECT_NE(named.exit_code, 0);
  EXPECT_NE(named.output.find("mesh sheet is named twice"), std::string::npos) << named.output;
}

// One triangle alone, a closed box with a face missing, and triangles that cross each other are meshes.
TEST(MeshInput, OpenAndCrossingMeshesAreAccepted)
{
  const Mesh one = {{Vec3{-0.3, -0.3, 0.0}, Vec3{0.3, -0.3, 0.0}, Vec3{0.0, 0.3, 0.0}}};
  Mesh open = box_mesh({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}, 2);
  open.resize(open.size() - 8);
  Mesh crossing = tiled({{-0.3, -0.3, 0.0}, {0.6, 0.0, 0.0}, {0.0, 0.6, 0.0}}, 1, 1);
  const Mesh upright = tiled({{-0.25, 0.05, -0.3}, {0.5, 0.0, 0.0}, {0.0, 0.0, 0.6}}, 1, 1);
  crossing.insert(crossing.end(), upright.begin(), upright.end());
  for (const Mesh &mesh : {one, open, crossing}) {
    Scene scene;
    Rod rod;
    rod.position = {0.01, -0.05, 0.01};
    scene.rods = {rod};
    scene.files["mesh.stl"] = stl(mesh);
    scene.physics = kMaterial + mesh_fix("m", "mesh.stl") + mesh_wall("wall", kModels, {"m"}) +
                    kWeight + kMotion;
    scene.dt = 1e-5;
    const DeckFolder folder;
    const Outcome outcome = run_deck(folder, scene, "run 3000\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
}
