// SPDX-License-Identifier: GPL-2.0-or-later
// Rods against meshes that move: by each style of fix move/mesh, and by surface velocities.
#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "mesh_files.h"
#include "scene.h"

using namespace decks;

namespace {

const std::string kModels = "linear tangential history";
const std::string kMotion = "fix motion all nve/spherocylinder\n";
constexpr double kStiffness = 2e4;

std::string weight(double g = 9.81)
{
  return fmt::format("fix weight all gravity {} vector 0.0 0.0 -1.0\n", g);
}

const Sheet kPlate = {{-0.5, -0.5, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};

// Rods that come down on a plate at z = 0 and slide, tumbling.
std::vector<Rod> rods_on_a_plate()
{
  std::vector<Rod> rods;
  for (int n = 0; n < 6; n++) {
    Rod rod;
    rod.length = (n % 3 == 0 ? 1.0 : n % 3 == 1 ? 4.0 : 10.0) * rod.diameter;
    const double angle = 1.1 * n;
    rod.axis = normalized({std::cos(angle), std::sin(angle), n % 2 ? 0.2 : 0.0});
    rod.position = {-0.2 + 0.2 * (n % 3), n < 3 ? -0.1 : 0.1,
                    rod.half_cylinder() * rod.axis.z + rod.radius() + 1e-5 + 1e-4 * n};
    rod.velocity = {0.1 * (n - 2), 0.05 * (3 - n), 0.0};
    rods.push_back(rod);
  }
  return rods;
}

Scene plate_scene(const std::string &wall, double restitution = 0.5)
{
  Scene scene;
  scene.rods = rods_on_a_plate();
  scene.files["plate.stl"] = stl(tiled(kPlate, 9, 11));
  scene.physics = linear_material(kStiffness, 5.7e3, restitution, 0.3) + rod_pair(kModels) + wall +
                  weight() + kMotion;
  scene.dt = 1e-5;
  scene.steps = 10000;
  scene.dump_every = 1000;
  return scene;
}

std::string plate(const std::string &keywords = "")
{
  return mesh_fix("m", "plate.stl", keywords) + mesh_wall("plate", kModels, {"m"});
}

}  // namespace

// A belt drags as a plane with the same surface velocity.
TEST(SurfaceVelocity, IsThatOfAShearedPlane)
{
  const std::vector<Frame> wanted =
      run(plate_scene(rod_wall("plate", kModels, "type 1 zplane 0.0 shear x 0.7")));
  const std::vector<Frame> got = run(plate_scene(plate("surface_vel 0.7 0.0 0.0")));
  expect_holds({"Rods on a belt of triangles: position (m)", "zplane shear", 1e-11},
               largest_difference(wanted, got));
}

TEST(SurfaceVelocity, MayTurn)
{
  const std::vector<Frame> wanted =
      run(plate_scene(rod_wall("plate", kModels, "type 1 zplane 0.0 turn 3.0 0.05 -0.02")));
  const std::vector<Frame> got =
      run(plate_scene(plate("surface_ang_vel origin 0.05 -0.02 0.0 axis 0.0 0.0 1.0 omega 3.0")));
  expect_holds({"Rods on a surface of triangles that turns: position (m)", "zplane turn", 1e-11},
               largest_difference(wanted, got));
}

// A rod along the belt slides with mu g until it has the belt's speed, and keeps that.
TEST(SurfaceVelocity, TakesARodAlong)
{
  const double speed = 0.4, friction = 0.3, g = 9.81;
  Scene scene;
  Rod rod;
  rod.position = {-0.3, 0.0, rod.radius() - 0.5 * rod.mass() * g / kStiffness};
  scene.rods = {rod};
  scene.files["plate.stl"] = stl(tiled(kPlate, 23, 3));
  scene.physics = linear_material(kStiffness, 5.7e3, 0.3, friction) + rod_pair(kModels) +
                  plate(fmt::format("surface_vel {} 0.0 0.0", speed)) + weight(g) + kMotion;
  scene.dt = 1e-5;
  scene.steps = 40000;
  scene.dump_every = 5000;
  const std::vector<Frame> frames = run(scene);
  const auto velocity = [&](int f) { return frames[f].rods[0].velocity.x; };
  // 0.136 s; the spring is taut after mu N/kt, 5 um, 1 ms of it.
  EXPECT_NEAR(velocity(2) - velocity(1), friction * g * 0.05, 1e-6);
  for (const int f : {6, 7, 8}) EXPECT_NEAR(velocity(f), speed, 1e-6);
}

// ---- meshes that move ---------------------------------------------------------------------------

// Plane and rods at rest, seen from a frame that moves: the same but for the frame's way.
TEST(MovedMeshes, LinearIsAMovingFrame)
{
  const Vec3 v = {0.3, -0.2, 0.15};
  const std::vector<Frame> at_rest = run(plate_scene(plate()));
  Scene moving = plate_scene(
      plate() + fmt::format("fix go all move/mesh mesh m linear {} {} {}\n", v.x, v.y, v.z));
  for (Rod &rod : moving.rods) rod.velocity = rod.velocity + v;
  std::vector<Frame> got = run(moving);
  for (Frame &frame : got)
    for (Rod &rod : frame.rods) rod.position = rod.position - frame.time * v;
  expect_holds({"Rods on a plate that moves: position (m)", "plate at rest", 1e-9},
               largest_difference(at_rest, got));
}

// Meshes that move while rods lie on them, however the deck is run.
class MovedMeshesRun : public testing::TestWithParam<Mode> {};

TEST_P(MovedMeshesRun, AsOnOneRank)
{
  const char *const moves[] = {"linear 0.3 -0.2 0.15",
                               "rotate origin 0.05 -0.02 0.0 axis 0.0 0.1 1.0 period 2.0",
                               "wiggle amplitude 0.0 0.002 0.001 period 0.05"};
  for (const char *move : moves) {
    Scene scene = plate_scene(plate() + "fix go all move/mesh mesh m " + move + "\n");
    scene.steps = 4000;
    // Without damping the first force of a restarted run is that of the step before.
    if (GetParam() == Mode::Restarted)
      scene.physics.replace(scene.physics.find("coefficientRestitution peratomtypepair 1 0.5"), 44,
                            "coefficientRestitution peratomtypepair 1 1.0");
    expect_holds({fmt::format("Rods on a mesh moved by {}, {}: position (m)",
                              std::string(move).substr(0, 6), name_of(GetParam())),
                  "one rank", 1e-10},
                 largest_difference(run(scene), run(scene, GetParam())));
  }
}

INSTANTIATE_TEST_SUITE_P(, MovedMeshesRun,
                         testing::Values(Mode::TwoRanks, Mode::FourRanks, Mode::Restarted),
                         [](const auto &info) { return name_of(info.param); });

// In its own plane, about an axis that is not its middle.
TEST(MovedMeshes, RotateIsATurningPlane)
{
  const double rate = 3.0;
  const std::vector<Frame> wanted = run(plate_scene(
      rod_wall("plate", kModels, fmt::format("type 1 zplane 0.0 turn {} 0.05 -0.02", rate))));
  const std::vector<Frame> got = run(plate_scene(
      plate() + fmt::format("fix go all move/mesh mesh m rotate origin 0.05 -0.02 0.0 axis 0.0 0.0 "
                            "1.0 period {:.17g}\n",
                            2.0 * std::acos(-1.0) / rate)));
  expect_holds({"Rods on a plate that turns: position (m)", "zplane turn", 1e-9},
               largest_difference(wanted, got));
}

namespace {

struct Mover {
  const char *name;
  std::string words;   // of fix move/mesh, and variables before it
  std::string before;  // commands
  double height;       // of the plate at the rod's place at the end of the run (m)
  double velocity;     // there, upwards (m/s)
  double first;        // the same at the start of the run
  double start_turn;   // of the file's plate about y (rad)
};

void PrintTo(const Mover &mover, std::ostream *out) { *out << mover.name; }

constexpr double kPi = 3.14159265358979323846;
constexpr double kTime = 0.02;   // of the run, s
constexpr double kLever = 0.12;  // of the rod from the y axis, m

// wiggle: amplitude sin(2 pi t/period); riggle: an angle that does; rotate: the plate starts turned back.
const Mover kMovers[] = {
    {"Linear", "linear 0.1 0.0 -0.05", "", -0.001, -0.05, -0.05, 0.0},
    {"LinearVariable", "linear/variable v_vx v_vy v_vz",
     "variable vx equal 0.0\nvariable vy equal 0.1\nvariable vz equal 6.0*step*dt-0.1\n",
     3.0 * kTime *kTime - 0.1 * kTime, 0.02, -0.1, 0.0},
    {"Wiggle", "wiggle amplitude 0.0 0.0 0.0005 period 0.06", "", 0.0005 * 0.8660254037844386,
     -0.0005 * 2.0 * kPi / 0.06 * 0.5, 0.0005 * 2.0 * kPi / 0.06, 0.0},
    {"Riggle", "riggle origin 0.0 0.0 0.0 axis 0.0 1.0 0.0 period 0.04 amplitude 0.5", "", 0.0,
     kLever * 0.5 * kPi / 180.0 * 2.0 * kPi / 0.04, -kLever * 0.5 * kPi / 180.0 * 2.0 * kPi / 0.04,
     0.0},
    {"Rotate", "rotate origin 0.0 0.0 0.0 axis 0.0 1.0 0.0 period 20.0", "", 0.0,
     -kLever * 2.0 * kPi / 20.0, -kLever * 2.0 * kPi / 20.0, -2.0 * kPi / 20.0 * kTime},
    {"RotateVariable", "rotate/variable origin 0.0 0.0 0.0 axis 0.0 1.0 0.0 omega v_w",
     "variable w equal 0.3\n", 0.0, -kLever * 0.3, -kLever * 0.3, -0.3 * kTime},
};

class MovedBy : public testing::TestWithParam<Mover> {};

}  // namespace

// A rod that is held along y over the plate: its ends give kn times their depth less the damping 2 beta
// sqrt(kn m_eff) times the plate's speed there, with m_eff of one of two ends that share the load.
TEST_P(MovedBy, TheWallHasThePlaceAndTheVelocityOfTheMesh)
{
  const Mover &mover = GetParam();
  for (const int ranks : {1, 2}) {
    Scene scene;
    Rod rod;
    const double depth = 2e-3;
    rod.axis = {0.0, 1.0, 0.0};
    rod.position = {kLever, 0.02, mover.height + rod.radius() - depth};
    scene.rods = {rod};
    const double c = std::cos(mover.start_turn), s = std::sin(mover.start_turn);
    const Mesh turned = transformed(tiled(kPlate, 7, 8), [&](const Vec3 &p) {
      return Vec3{c * p.x + s * p.z, p.y, -s * p.x + c * p.z};
    });
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("plate.stl", stl(turned));
    std::string start = preamble(scene, ranks == 2 ? Mode::TwoRanks : Mode::OneRank);
    folder.write("in.move",
                 start + "read_data rods.data\nneighbor 0.02 bin\nneigh_modify delay 0\n" +
                     linear_material(kStiffness, 5.7e3, 0.5, 0.2) + rod_pair(kModels) +
                     mover.before + mesh_fix("m", "plate.stl") +
                     mesh_wall("plate", kModels, {"m"}, "store_force yes") +
                     "fix go all move/mesh mesh m " + mover.words +
                     "\nfix hold all move linear 0.0 0.0 0.0\n"
                     "compute f all reduce sum f_force_plate[3]\n"
                     "thermo_style custom step c_f\nthermo 2000\nthermo_modify norm no format "
                     "float %.15g\ntimestep 1e-5\nrun 2000\n");
    const Outcome outcome = folder.run("in.move", {Program::Lmp, ranks, 60});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const double beta = -std::log(0.5) / std::hypot(std::log(0.5), kPi);
    const double damping = 2.0 * beta * std::sqrt(kStiffness * 0.5 * rod.mass());
    // LIGGGHTS's movers add up their velocities at the ends of the steps to the mesh's place.
    const double ahead = 0.5 * 1e-5 * (mover.velocity - mover.first);
    const double wanted = 2.0 * (kStiffness * (depth + ahead) + damping * mover.velocity);
    const double share = 2.0 * damping * mover.velocity / wanted;
    const double got = read_thermo(outcome.output).rows.back()[1];
    expect_holds({fmt::format("Push of a mesh moved by {}: force, / that of its speed", mover.name),
                  "2 (kn depth + 2 beta sqrt(kn m/2) v)", 1e-4},
                 std::fabs(got / wanted - 1.0) / std::fabs(share));
  }
}

INSTANTIATE_TEST_SUITE_P(, MovedBy, testing::ValuesIn(kMovers),
                         [](const auto &info) { return std::string(info.param.name); });

// Without weight, in a drum of plates that turns with the rods in it: each lies in the valley of two
// plates at 30 degrees, held by centrifugal force, and goes round with the drum: m w^2 a is shared by two
// contacts an end, cos(15 degrees) of each outwards.
TEST(MovedMeshes, ADrumTakesRodsRound)
{
  const double rate = 20.0, radius = 0.1, cosine = std::cos(kPi / 12);
  Scene scene;
  for (int n = 0; n < 4; n++) {
    Rod rod;
    rod.length = n == 3 ? rod.diameter : 0.05;
    const double angle = 2.0 * kPi * n / 12.0;
    const Vec3 out = {std::cos(angle), std::sin(angle), 0.0};
    rod.axis = {0.0, 0.0, 1.0};
    rod.position = (radius - (rod.radius() + 1e-9) / cosine) * out;  // as yet not in touch
    rod.velocity = rate * cross(Vec3{0.0, 0.0, 1.0}, rod.position);
    rod.omega = {0.0, 0.0, rate};
    scene.rods.push_back(rod);
  }
  scene.files["drum.stl"] = stl(tube_mesh(radius, -0.1, 0.1, 12, 2));
  scene.physics = linear_material(kStiffness, 1.2e4, 0.5, 0.5) + rod_pair(kModels) +
                  mesh_fix("m", "drum.stl") + mesh_wall("drum", kModels, {"m"}) +
                  fmt::format("fix go all move/mesh mesh m rotate origin 0.0 0.0 0.0 axis 0.0 0.0 "
                              "1.0 period {:.17g}\n",
                              2.0 * kPi / rate) +
                  kMotion;
  scene.dt = 1e-5;
  scene.steps = 10000;
  const Frame end = run(scene).back();
  const double turn = rate * end.time, c = std::cos(turn), s = std::sin(turn);
  double error = 0.0;
  for (size_t n = 0; n < end.rods.size(); n++) {
    const Rod &rod = scene.rods[n];
    const double contacts = n == 3 ? 2.0 : 4.0;
    const double touching = radius - rod.radius() / cosine;
    // a = touching + overlap/cosine; kn overlap contacts cosine = m w^2 a
    const double soft = rod.mass() * rate * rate / (contacts * cosine * cosine * kStiffness);
    const Vec3 p = (touching / (1.0 - soft) / norm(rod.position)) * rod.position;
    error = std::max(error,
                     norm(end.rods[n].position - Vec3{c * p.x - s * p.y, s * p.x + c * p.y, 0.0}));
  }
  expect_holds({"Rods held by centrifugal force in a drum that turned by 2 rad: position (m)",
                "moving frame", 1e-6},
               error);
}

// More than a rod's radius a step: one sentence, also in a step in which LIGGGHTS makes its lists anew and
// gives triangles to other ranks.
TEST(MovedMeshes, MayNotJump)
{
  const Scene scene = plate_scene("");
  for (const char *lists : {"", " every 1 check no"})
    for (const int ranks : {1, 2}) {
      const DeckFolder folder;
      folder.write("rods.data", data_file(scene));
      folder.write("plate.stl", scene.files.at("plate.stl"));
      folder.write("in.jump",
                   preamble(scene, ranks == 2 ? Mode::TwoRanks : Mode::OneRank) +
                       std::string("read_data rods.data\nneighbor 0.02 bin\nneigh_modify delay 0") +
                       lists + "\n" + scene.physics + plate() +
                       "variable n equal 0.0\nvariable z equal -600.0*(step==6)\n"
                       "fix go all move/mesh mesh m linear/variable v_n v_n v_z\n"
                       "timestep 1e-5\nrun 10\n");
      const Outcome outcome = folder.run("in.jump", {Program::Lmp, ranks, 60});
      EXPECT_NE(outcome.exit_code, 0) << lists;
      EXPECT_NE(outcome.output.find("ERROR"), std::string::npos) << outcome.output;
      EXPECT_NE(outcome.output.find("mesh m moves by 0.006 at step 6"), std::string::npos)
          << outcome.output;
    }
}

// Through a periodic boundary, with new lists in each step: copies of triangles that come and go, and
// triangles that LIGGGHTS puts to the other side of the box, are no jump.
TEST(MovedMeshes, MayGoThroughPeriodicBoundaries)
{
  Scene scene = plate_scene("");
  scene.boundary = "p p f";
  scene.files["strip.stl"] =
      stl(tiled({{-0.1, -0.5, -0.1}, {0.2, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 3, 5));
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("strip.stl", scene.files["strip.stl"]);
    folder.write("in.strip", preamble(scene, ranks == 2 ? Mode::TwoRanks : Mode::OneRank) +
                                 "read_data rods.data\nneighbor 0.02 bin\n"
                                 "neigh_modify delay 0 every 1 check no\n" +
                                 scene.physics + mesh_fix("m", "strip.stl") +
                                 mesh_wall("strip", kModels, {"m"}) +
                                 "fix go all move/mesh mesh m linear 300.0 0.0 0.0\n"
                                 "timestep 1e-5\nrun 800\n");
    const Outcome outcome = folder.run("in.strip", {Program::Lmp, ranks, 60});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
}
