// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's commands that go by meshes, with rods: insertion into regions of tetrahedra and through faces,
// rods counted as they cross a face, wear, servo flaps, heat; and meshes with a mistake.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "core/rotation.h"
#include "mesh_files.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;

namespace {

constexpr double kPi = 3.14159265358979323846;
const std::string kModels = "linear tangential history";
const std::string kMotion = "fix motion all nve/spherocylinder\n";
const std::string kWeight = "fix weight all gravity 9.81 vector 0.0 0.0 -1.0\n";
constexpr double kStiffness = 2e5;  // N/m
const std::string kMaterial = linear_material(kStiffness, 1.2e5, 0.6, 0.3) + rod_pair(kModels);
const std::string kSmooth = linear_material(kStiffness, 1.2e5, 1.0, 0.0) + rod_pair(kModels);

Outcome run_deck(const DeckFolder &folder, const Scene &scene, const std::string &commands,
                 Mode mode = Mode::OneRank)
{
  folder.write("rods.data", data_file(scene));
  for (const auto &[name, text] : scene.files) folder.write(name, text);
  folder.write("in.mesh", preamble(scene, mode) + "read_data rods.data\n" +
                              fmt::format("neighbor {} bin\nneigh_modify delay 0\ntimestep {}\n",
                                          scene.skin, scene.dt) +
                              scene.physics + commands);
  return folder.run("in.mesh", {Program::Lmp, mode == Mode::TwoRanks ? 2 : 1, 60});
}

Mesh floor_mesh(double side, int n, double z = 0.0)
{
  return tiled({{-0.5 * side, -0.5 * side, z}, {side, 0.0, 0.0}, {0.0, side, 0.0}}, n, n);
}

int count_of(const std::string &text, const std::string &word)
{
  int count = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) count++;
  return count;
}

class MeshRanks : public testing::TestWithParam<int> {};

// ---- insertion ----------------------------------------------------------------------------------

constexpr double kHalfSide = 0.1;  // of a cube of tetrahedra (m)
constexpr double kTurned = 0.5;    // about z (rad)

// Six tetrahedra along the diagonals of a cube that is turned about z.
std::string cube_of_tetrahedra()
{
  std::string text =
      "# vtk DataFile Version 2.0\ncube\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n";
  const double c = std::cos(kTurned), s = std::sin(kTurned);
  for (int k = 0; k < 8; k++) {
    const double x = k & 1 ? kHalfSide : -kHalfSide, y = k & 2 ? kHalfSide : -kHalfSide;
    text += fmt::format("{:.17g} {:.17g} {:.17g}\n", c * x - s * y, s * x + c * y,
                        k & 4 ? kHalfSide : -kHalfSide);
  }
  text += "CELLS 6 30\n";
  int order[3] = {1, 2, 4};
  do text += fmt::format("4 0 {} {} 7\n", order[0], order[0] + order[1]);
  while (std::next_permutation(order, order + 3));
  return text + "CELL_TYPES 6\n10\n10\n10\n10\n10\n10\n";
}

// By how much a ball is inside of the cube (m).
double inside_cube(const Vec3 &point, double radius)
{
  const double c = std::cos(kTurned), s = std::sin(kTurned);
  const double x = c * point.x + s * point.y, y = c * point.y - s * point.x;
  return kHalfSide - radius - std::max({std::fabs(x), std::fabs(y), std::fabs(point.z)});
}

std::vector<Rod> packed_into_the_cube(const std::string &all_in, int ranks)
{
  const DeckFolder folder;
  folder.write("cube.vtk", cube_of_tetrahedra());
  Scene scene;
  scene.boundary = "f f f";
  folder.write(
      "in.pack",
      preamble(scene, ranks == 2 ? Mode::TwoRanks : Mode::OneRank) +
          "region box block -0.3 0.3 -0.3 0.3 -0.3 0.3 units box\ncreate_box 1 box\n"
          "region feed mesh/tet file cube.vtk scale 1. move 0. 0. 0. rotate 0. 0. 0. units box\n"
          "neighbor 0.01 bin\nneigh_modify delay 0\n" +
          kMaterial + kMotion +
          "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
          "radius constant 0.005 length constant 0.04\n"
          "fix rods all particledistribution/discrete 32452843 1 rod 1.0\n"
          "fix pack all insert/pack seed 86028121 distributiontemplate rods insert_every once "
          "overlapcheck yes orientation random all_in " +
          all_in +
          " maxattempt 1000 vel constant 0.0 0.0 0.0 region feed particles_in_region 80\n"
          "compute contacts all contact/spherocylinder\ntimestep 1e-5\n" +
          exact_dump("dump.rods", 1, kFrameColumns) + "run 1\n");
  const Outcome outcome = folder.run("in.pack", {Program::Lmp, ranks, 60});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return {};
  return read_frames(folder / "dump.rods", scene).back().rods;
}

}  // namespace

// all_in yes: rods with their ends lie in the cube; all_in no: their centres do, and of 80 rods of 0.4 half
// sides some stick out.
TEST_P(MeshRanks, PackingFillsARegionOfTetrahedra)
{
  for (const bool all_in : {true, false}) {
    const std::vector<Rod> rods = packed_into_the_cube(all_in ? "yes" : "no", GetParam());
    ASSERT_EQ(rods.size(), 80u);
    int sticking_out = 0;
    for (size_t k = 0; k < rods.size(); k++) {
      const Rod &rod = rods[k];
      EXPECT_GE(inside_cube(rod.position, 0.0), 0.0) << k;
      double inside = 1.0;
      for (const double side : {-1.0, 1.0})
        inside = std::min(inside, inside_cube(rod.position + side * rod.half_cylinder() * rod.axis,
                                              rod.radius()));
      sticking_out += inside < 0.0;
      for (size_t other = k + 1; other < rods.size(); other++)
        EXPECT_GT(slow_distance(rod, rods[other]), rod.diameter) << k << " and " << other;
    }
    EXPECT_EQ(sticking_out > 5, !all_in) << sticking_out;
    if (all_in) {
      EXPECT_EQ(sticking_out, 0);
    }
  }
}

// A region of tetrahedra knows of a point whether it is inside, not how far: the template's own keyword is
// refused.
TEST(MeshMistakes, TemplatesInRegionsOfTetrahedra)
{
  const DeckFolder folder;
  folder.write("cube.vtk", cube_of_tetrahedra());
  folder.write(
      "in.pack",
      preamble(Scene()) +
          "region box block -0.3 0.3 -0.3 0.3 -0.3 0.3 units box\ncreate_box 1 box\n"
          "region feed mesh/tet file cube.vtk scale 1. move 0. 0. 0. rotate 0. 0. 0. units box\n" +
          kMaterial +
          "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
          "radius constant 0.005 length constant 0.04 all_in_region feed\n");
  const Outcome outcome = folder.run("in.pack");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("region feed of style mesh/tet cannot tell"), std::string::npos)
      << outcome.output;
}

// Rods of a stream are set into the space above the face, fall through it and through two more, flat and
// inclined ones, long and short, turning, and do not see each other: fix massflow/mesh has counted those that are
// beyond a face, each once, with its mass.
TEST_P(MeshRanks, StreamCrossesFacesOnce)
{
  const DeckFolder folder;
  folder.write("face.stl", stl(floor_mesh(0.16, 1, 0.2)));
  folder.write("below.stl", stl(floor_mesh(0.38, 3, 0.05)));
  folder.write("tilted.stl",
               stl(tiled({{-0.19, -0.19, -0.1}, {0.38, 0.0, 0.06}, {0.0, 0.38, 0.0}}, 2, 2)));
  const std::string deck =
      preamble(Scene(), GetParam() == 2 ? Mode::TwoRanks : Mode::OneRank) +
      "region box block -0.2 0.2 -0.2 0.2 -0.5 0.5 units box\ncreate_box 1 box\n"
      "neighbor 0.02 bin\nneigh_modify delay 0\n" +
      kMaterial + kMotion +
      "fix long all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
      "radius constant 0.003 length constant 0.06\n"
      "fix short all particletemplate/spherocylinder 15485867 atom_type 1 density constant 1000 "
      "radius constant 0.004 length constant 0.01\n"
      "fix rods all particledistribution/discrete 32452843 2 long 0.7 short 0.3\n"
      "fix face all mesh/surface/planar file face.stl type 1\n"
      "fix below all mesh/surface/planar file below.stl type 1\n"
      "fix tilted all mesh/surface/planar file tilted.stl type 1\n"
      "fix pour all insert/stream seed 86028121 distributiontemplate rods nparticles 60 "
      "particlerate 600 overlapcheck yes all_in no orientation random vel constant 0. 0. -1.0 "
      "omega constant 30. 10. 0. insertion_face face extrude_length 0.15\n"
      "fix weight all gravity 9.81 vector 0.0 0.0 -1.0\n"
      "fix n_below all massflow/mesh mesh below count once vec_side 0 0 -1\n"
      "fix m_below all massflow/mesh mesh below count multiple vec_side 0 0 -1\n"
      "fix n_tilted all massflow/mesh mesh tilted count once vec_side 0 0 -1\n"
      "neigh_modify exclude type 1 1\ntimestep 5e-6\nthermo 8000\n"
      "thermo_style custom step f_n_below[1] f_n_below[2] f_m_below[1] f_m_below[2] f_n_tilted[1] "
      "f_n_tilted[2] atoms\nthermo_modify norm no lost error format float %.15g\n" +
      exact_dump("dump.rods", 8000, "id x y z mass omegax omegay omegaz") + "run 8000\nrun 36000\n";
  folder.write("in.stream", deck);
  const Outcome outcome = folder.run("in.stream", {Program::Lmp, GetParam(), 60});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  std::vector<Snapshot> dumped = read_dump(folder / "dump.rods");
  dumped.erase(dumped.begin());  // none are there yet
  ASSERT_EQ(thermo.rows.size(), 6u);
  int crossed_last = 0;
  for (size_t f = 0; f < 5; f++) {
    ASSERT_EQ(thermo.rows[f][0], dumped[f].step);
    const Table &rods = dumped[f].atoms;
    double counts[2] = {}, masses[2] = {};
    for (size_t row = 0; row < rods.rows.size(); row++) {
      const double height = rods.at(row, "z"), x = rods.at(row, "x");
      const bool beyond[2] = {height < 0.05, height < -0.1 + 0.06 * (x + 0.19) / 0.38};
      for (int k = 0; k < 2; k++)
        if (beyond[k]) {
          counts[k] += 1.0;
          masses[k] += rods.at(row, "mass");
        }
      // A free rod's angular velocity turns about its angular momentum, and keeps its size.
      if (height < 0.2) {
        EXPECT_NEAR(
            std::hypot(rods.at(row, "omegax"), rods.at(row, "omegay"), rods.at(row, "omegaz")),
            std::hypot(30.0, 10.0), 1e-9)
            << "rod " << row;
      }
    }
    for (int k = 0; k < 3; k++) {
      const int face = k == 2;
      EXPECT_NEAR(thermo.rows[f][1 + 2 * k], masses[face], 1e-12) << "step " << dumped[f].step;
      EXPECT_EQ(thermo.rows[f][2 + 2 * k], counts[face]) << "step " << dumped[f].step;
    }
    crossed_last = static_cast<int>(counts[1]);
  }
  EXPECT_GT(crossed_last, 10);
  EXPECT_LT(crossed_last, 60);
}

INSTANTIATE_TEST_SUITE_P(, MeshRanks, testing::Values(1, 2),
                         [](const auto &info) { return std::to_string(info.param); });

// ---- wear ---------------------------------------------------------------------------------------

namespace {

constexpr double kFinnie = 1e-3;  // k_finnie

// Of all triangles of a dump mesh/vtk file: wear times area, which is what wears (m^3 in LIGGGHTS's units).
double worn(const DeckFolder &folder, const std::string &file, double area)
{
  std::istringstream text(folder.read(file));
  std::string word;
  while (text >> word)
    if (word == "wear") break;
  int parts = 0, count = 0;
  text >> parts >> count >> word;
  double sum = 0.0, wear = 0.0;
  for (int k = 0; k < count && text >> wear; k++) sum += wear;
  EXPECT_EQ(parts, 1);
  EXPECT_GT(count, 0);
  return area * sum;
}

// Finnie's law as LIGGGHTS has it: what a force does in a step dt at a speed, with the angle between velocity
// and surface.
double finnie(const Vec3 &velocity, double force, double dt)
{
  const double speed = norm(velocity);
  const double s = std::fabs(velocity.z) / speed, c = std::hypot(velocity.x, velocity.y) / speed;
  const double share = 3.0 * s > c ? 0.33333 * c * c : 2.0 * s * c - 3.0 * s * s;
  return 2.0 * kFinnie * share * speed * force * dt;
}

const std::string kWearing =
    fmt::format("fix kf all property/global k_finnie peratomtypepair 1 {}\n", kFinnie);

struct Wearing {
  const char *name;
  Vec3 axis, velocity, omega;
  Vec3 at_contacts[2];  // velocities there; the second of no use for a rod on one end
  int contacts;
};

void PrintTo(const Wearing &wearing, std::ostream *out) { *out << wearing.name; }

constexpr double kDepth = 1e-5, kArm = 0.005 - 0.5 * kDepth;  // m

class MeshWear : public testing::TestWithParam<Wearing> {};

}  // namespace

// A rod on a plate, ten steps so short that nothing changes: by the velocity of each contact point, an end
// of the axis and the depth r - overlap/2 below it.
TEST_P(MeshWear, GoesByTheContactPoint)
{
  const Wearing &wearing = GetParam();
  Scene scene;
  Rod rod;
  rod.axis = wearing.axis;
  rod.velocity = wearing.velocity;
  rod.omega = wearing.omega;
  rod.position = {0.011, 0.023,
                  rod.radius() - kDepth + std::fabs(rod.axis.z) * rod.half_cylinder()};
  scene.rods = {rod};
  scene.files["plate.stl"] = stl(floor_mesh(1.0, 2));
  scene.physics = kSmooth + kWearing +
                  mesh_fix("m", "plate.stl", "wear finnie", "mesh/surface/stress") +
                  mesh_wall("w", kModels, {"m"}) + kMotion;
  scene.dt = 1e-11;
  const DeckFolder folder;
  const Outcome outcome =
      run_deck(folder, scene, "dump wear all mesh/vtk 10 wear*.vtk wear m\nrun 20\n");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const double area = 1.0 / 8.0;
  const double got = worn(folder, "wear20.vtk", area) - worn(folder, "wear10.vtk", area);
  double wanted = 0.0;
  for (int k = 0; k < wearing.contacts; k++)
    for (int step = 11; step <= 20; step++) {
      const Vec3 &velocity = wearing.at_contacts[k];
      const double depth = kDepth - velocity.z * scene.dt * step;
      wanted += finnie(velocity, kStiffness * depth, scene.dt);
    }
  if (norm(wearing.at_contacts[0]) < 1e-9) {
    EXPECT_EQ(got, 0.0);
    return;
  }
  expect_holds({fmt::format("Wear of a plate, {}: relative", wearing.name),
                "Finnie's law at the contact point", 1e-5},
               std::fabs(got / wanted - 1.0));
}

INSTANTIATE_TEST_SUITE_P(
    , MeshWear,
    testing::Values(
        // Along the axis, both ends alike, by shallow and by steep angles.
        Wearing{"FlatAlong", {1, 0, 0}, {3, 0, -0.2}, {0, 0, 0}, {{3, 0, -0.2}, {3, 0, -0.2}}, 2},
        Wearing{"FlatAcross", {0, 1, 0}, {3, 0, -0.2}, {0, 0, 0}, {{3, 0, -0.2}, {3, 0, -0.2}}, 2},
        Wearing{"FlatSteep", {1, 0, 0}, {1, 0, -2}, {0, 0, 0}, {{1, 0, -2}, {1, 0, -2}}, 2},
        // Rolls: the centre moves, the contact point does not.
        Wearing{"Rolling", {0, 1, 0}, {40.0 * kArm, 0, 0}, {0, 40, 0}, {{0, 0, 0}, {0, 0, 0}}, 2},
        // Turns on the spot about its axis and sinks: the centre has no way along the plate.
        Wearing{"Spinning",
                {0, 1, 0},
                {0, 0, -0.01},
                {0, 40, 0},
                {{-40.0 * kArm, 0, -0.01}, {-40.0 * kArm, 0, -0.01}},
                2},
        // Turns about the upright and sinks: 0.045 m from the centre.
        Wearing{"Turning",
                {1, 0, 0},
                {0, 0, -0.05},
                {0, 0, 20},
                {{0, 20.0 * 0.045, -0.05}, {0, -20.0 * 0.045, -0.05}},
                2},
        // On one end, upright: about its own contact point, and about its centre.
        Wearing{"TippingOverItsEnd",
                {0, 0, 1},
                {3.0 * (0.045 + kArm), 0, 0},
                {0, 3, 0},
                {{0, 0, 0}, {0, 0, 0}},
                1},
        Wearing{"TippingOverItsCentre",
                {0, 0, 1},
                {0, 0, -0.02},
                {0, 3, 0},
                {{-3.0 * (0.045 + kArm), 0, -0.02}, {0, 0, 0}},
                1},
        // Inclined by 30 degrees, turning: the contact goes down as the lower end does.
        Wearing{"Inclined",
                {std::sqrt(0.75), 0, 0.5},
                {0, 0, 0},
                {0, -2, 0},
                {{2.0 * (0.0225 + kArm), 0, -2.0 * 0.045 * std::sqrt(0.75)}, {0, 0, 0}},
                1}),
    [](const auto &info) { return std::string(info.param.name); });

// A rod driven down a slope into a plate over its seams, 40 mm on 60 triangles a side: the force is kn times
// the overlap at each step.
TEST(MeshWearing, OfASlide)
{
  Scene scene;
  Rod rod;
  rod.axis = normalized({1.0, 0.3, 0.0});
  rod.position = {-0.02, 0.011, rod.radius() - kDepth};
  scene.rods = {rod};
  const int n = 60, steps = 2000;
  const Vec3 velocity = {2.0, 0.0, -0.01};
  scene.files["plate.stl"] = stl(floor_mesh(0.4, n));
  scene.physics = kSmooth + kWearing +
                  mesh_fix("m", "plate.stl", "wear finnie", "mesh/surface/stress") +
                  mesh_wall("w", kModels, {"m"}) + "fix motion all move linear 2.0 0.0 -0.01\n";
  scene.dt = 1e-5;
  const DeckFolder folder;
  const Outcome outcome = run_deck(
      folder, scene,
      fmt::format("dump wear all mesh/vtk {} wear*.vtk wear m\nrun {}\n", steps / 2, steps));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const double area = 0.5 * (0.4 / n) * (0.4 / n);
  const double got = worn(folder, fmt::format("wear{}.vtk", steps), area) -
                     worn(folder, fmt::format("wear{}.vtk", steps / 2), area);
  double wanted = 0.0;
  for (int step = steps / 2 + 1; step <= steps; step++)
    wanted += 2.0 * finnie(velocity, kStiffness * (kDepth + 0.01 * scene.dt * step), scene.dt);
  expect_holds(
      {"Wear of a plate under a sliding rod: relative", "Finnie's law, sum over steps", 1e-6},
      std::fabs(got / wanted - 1.0));
}

// ---- servo flap ---------------------------------------------------------------------------------

// A flap hinged at x = 0 comes down on two rods that lie on a floor and holds its torque, then a larger one.
// It turns the rods' overlaps by kn/2 sum of 2 x^2, 6500 N m/rad, so that the controller settles at
// kp vel_max/(0.2 m) 6500/target, some 500/s. The torque is that of the forces which the floor bears beside the
// rods' weight.
TEST(MeshServoFlap, ReachesItsTorqueAndHoldsIt)
{
  Scene scene;
  for (const double x : {0.1, 0.15}) {
    Rod rod;
    rod.axis = {0.0, 1.0, 0.0};
    rod.position = {x, 0.0, rod.radius()};
    scene.rods.push_back(rod);
  }
  scene.files["flap.stl"] =
      stl(tiled({{0.0, -0.1, 0.0101}, {0.2, 0.0, 0.0}, {0.0, 0.2, 0.0}}, 3, 3));
  scene.physics = kMaterial + rod_wall("floor", kModels, "type 1 zplane 0.0") +
                  "variable goal equal 2.0+(step>10000)\n" +
                  mesh_fix("flap", "flap.stl",
                           "com 0.0 0.0 0.0101 ctrlPV torque axis 0.0 1.0 0.0 target_val v_goal "
                           "vel_max 0.01 kp 5.0",
                           "mesh/surface/stress/servo") +
                  mesh_wall("press", kModels, {"flap"}) + kWeight + kMotion;
  scene.dt = 1e-5;
  for (const Mode mode : {Mode::OneRank, Mode::TwoRanks}) {
    const DeckFolder folder;
    const Outcome outcome =
        run_deck(folder, scene,
                 "thermo_style custom step f_flap[4] f_flap[5] f_flap[6]\nthermo 200\n"
                 "thermo_modify norm no format float %.12g\n" +
                     exact_dump("dump.rods", 10000, "id x z") + "run 20000\n",
                 mode);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const Table thermo = read_thermo(outcome.output);
    double off = 0.0;
    for (const std::vector<double> &row : thermo.rows) {
      const bool is_second = row[0] > 10000.0;
      if (row[0] < (is_second ? 15000.0 : 5000.0)) continue;
      off = std::max(off, std::fabs(-row[2] / (is_second ? 3.0 : 2.0) - 1.0));
      EXPECT_NEAR(row[1], 0.0, 1e-9);
      EXPECT_NEAR(row[3], 0.0, 1e-9);
    }
    expect_holds({"Servo flap on two rods, from 50 ms on: torque, relative", "target_val", 0.01},
                 off);
    const std::vector<Snapshot> dumped = read_dump(folder / "dump.rods");
    for (int k = 1; k <= 2; k++) {
      double torque = 0.0;
      for (int n = 0; n < 2; n++) {
        const Rod &rod = scene.rods[n];
        const Table &atoms = dumped[k].atoms;
        const double floor = 2.0 * kStiffness * (rod.radius() - atoms.at(n, "z"));
        torque += atoms.at(n, "x") * (floor - rod.mass() * 9.81);
      }
      EXPECT_NEAR(torque, 1.0 + k, 1e-3);
    }
  }
}

// ---- heat ---------------------------------------------------------------------------------------

namespace {

constexpr double kTubeRadius = 0.05;
constexpr int kPlates = 96;

// Heat into rods along the inside of a hot tube, all round it: over plates and over seams of two. `keywords`
// of the wall and of the fix.
std::vector<double> heat_in_a_tube(bool mesh, const std::string &keywords, int rods = 24)
{
  Scene scene;
  for (int n = 0; n < rods; n++) {
    Rod rod;
    // Over a seam, hardly off one, over a quarter and over the middle of a plate.
    constexpr double kOff[] = {0.0, 0.02, 0.5, 1.0};
    const double angle = 2.0 * kPi * n / rods + kOff[n % 4] * kPi / kPlates;
    const double out = kTubeRadius - rod.radius() + 2e-4;
    rod.axis = {0.0, 0.0, 1.0};
    rod.length = 0.05;
    rod.position = {out * std::cos(angle), out * std::sin(angle), 0.0};
    scene.rods.push_back(rod);
  }
  scene.files["tube.stl"] = stl(tube_mesh(kTubeRadius, -0.2, 0.2, kPlates, 16));
  const std::string area = keywords.empty() ? "" : " contact_area " + keywords;
  scene.physics = kMaterial +
                  (mesh ? mesh_fix("m", "tube.stl", "temperature 800.0 curvature 4.0") +
                              mesh_wall("tube", kModels, {"m"}, area)
                        : rod_wall("tube", kModels,
                                   fmt::format("type 1 zcylinder {} 0.0 0.0 temperature 800.0{}",
                                               kTubeRadius, area))) +
                  kMotion +
                  "fix k all property/global thermalConductivity peratomtype 100.0\n"
                  "fix c all property/global thermalCapacity peratomtype 10.0\n"
                  "fix heat all heat/gran/conduction initial_temperature 300.0\n";
  scene.dt = 1e-10;
  const DeckFolder folder;
  const Outcome outcome =
      run_deck(folder, scene, exact_dump("dump.heat", 2, "id f_heatFlux[0]") + "run 2\n");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  std::vector<double> heat(rods, 0.0);
  if (outcome.exit_code == 0) {
    const Table last = read_dump(folder / "dump.heat").back().atoms;
    for (int n = 0; n < rods; n++) heat[n] = last.at(n, "f_heatFlux[0]");
  }
  return heat;
}

}  // namespace

// 4 k/2 sqrt(A) dT at each of two ends, A the circle in which the end's sphere and the wall meet. Plates lie
// up to R (1 - cos(pi/n)) nearer to the tube's axis than the cylinder, so that overlaps are larger by up to that,
// and heat by up to half of it over the overlap; across a seam two plates have one contact's heat.
TEST(MeshHeat, OfAFacettedTubeIsThatOfACylinder)
{
  const double r = 0.005, depth = 2e-4;
  const double wanted = 2.0 * 200.0 * std::sqrt(kPi * (r * r - (r - depth) * (r - depth))) * 500.0;
  const double chord = kTubeRadius * (1.0 - std::cos(kPi / kPlates));
  const std::vector<double> plain = heat_in_a_tube(false, ""), facetted = heat_in_a_tube(true, "");
  double error = 0.0;
  for (size_t n = 0; n < plain.size(); n++) {
    EXPECT_NEAR(plain[n], wanted, 1e-6 * wanted);
    error = std::max(error, std::fabs(facetted[n] / wanted - 1.0));
  }
  expect_holds({"Heat in a tube of 96 plates: relative", "cylinder, within the chord's height",
                1.01 * 0.5 * chord / depth},
               error);
}

// By other areas there is no chord: a given one, or the projection pi r^2.
TEST(MeshHeat, OfASeamIsOneContacts)
{
  for (const char *area : {"constant 1e-6", "projection"}) {
    const double size = area[0] == 'c' ? 1e-6 : kPi * 0.005 * 0.005;
    for (const double heat : heat_in_a_tube(true, area))
      EXPECT_NEAR(heat, 2.0 * 200.0 * std::sqrt(size) * 500.0, 1e-7 * heat) << area;
  }
}

// ---- bad input ----------------------------------------------------------------------------------

namespace {

// A rod that falls on a mesh and comes to rest on it, or not.
Scene falling_rod(const std::string &file, const std::string &keywords = "")
{
  Scene scene;
  Rod rod;
  rod.position = {0.01, -0.05, rod.radius() + 1e-4};
  scene.rods = {rod};
  scene.files["mesh.stl"] = file;
  scene.physics = linear_material(kStiffness, 1.2e5, 0.2, 0.3) + rod_pair(kModels) +
                  mesh_fix("m", "mesh.stl", keywords) + mesh_wall("wall", kModels, {"m"}) +
                  kWeight + kMotion;
  scene.dt = 1e-5;
  scene.steps = 20000;
  return scene;
}

// Ends with this sentence, on one rank and on two.
void expect_told(const Scene &scene, const std::string &sentence)
{
  for (const Mode mode : {Mode::OneRank, Mode::TwoRanks}) {
    const DeckFolder folder;
    const Outcome outcome = run_deck(folder, scene, "run 100\n", mode);
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_LT(outcome.exit_code, 128) << "ended by a signal";
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << outcome.output;
  }
}

// The rod lies on z = 0, m g/(2 kn) deep at each end.
void expect_rests(const Scene &scene, const std::string &what)
{
  const Rod rod = run(scene).back().rods[0];
  const double depth = 0.5 * rod.mass() * 9.81 / kStiffness;
  EXPECT_NEAR(rod.radius() - rod.position.z, depth, 1e-3 * depth) << what;
  EXPECT_NEAR(rod.axis.z, 0.0, 1e-6) << what;
}

Mesh turned_over(Mesh mesh)
{
  for (MeshTriangle &triangle : mesh) std::swap(triangle[1], triangle[2]);
  return mesh;
}

}  // namespace

// LIGGGHTS refuses a sliver; a triangle that is a point it takes, and it is none.
TEST(MeshMistakes, TrianglesOfNoArea)
{
  Mesh sliver = floor_mesh(1.0, 3);
  sliver.push_back({Vec3{0.0, 0.0, 0.0}, Vec3{0.1, 0.0, 0.0}, Vec3{0.2, 0.0, 0.0}});
  expect_told(falling_rod(stl(sliver)), "Bad mesh, cannot continue");
  expect_told(falling_rod(stl(sliver), "curvature 1e-5 curvature_tolerant yes"),
              "Bad mesh, cannot continue");
  Mesh point = floor_mesh(1.0, 3);
  point.push_back({Vec3{0.02, -0.05, 0.0}, Vec3{0.02, -0.05, 0.0}, Vec3{0.02, -0.05, 0.0}});
  expect_rests(falling_rod(stl(point)), "a triangle that is a point");
}

TEST(MeshMistakes, OutsideOfTheBox)
{
  expect_told(falling_rod(stl(tiled({{-0.5, -0.5, 0.0}, {2.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 4, 2))),
              "4 mesh elements have been lost / left the domain");
  expect_told(falling_rod(stl(tiled({{1.5, -0.5, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 2, 2))),
              "All 8 mesh elements have been lost / left the domain");
  // Triangles with a corner outside, but not their centres.
  expect_rests(falling_rod(stl(tiled({{-0.5, -0.5, 0.0}, {1.6, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 1, 1))),
               "corners outside");
}

// Cut in the middle of a number's line, of a triangle, or between two; words for numbers.
TEST(MeshMistakes, FilesThatAreNotWhole)
{
  const std::string whole = stl(floor_mesh(1.0, 3));
  const size_t middle = whole.find("vertex", whole.size() / 2);
  expect_told(falling_rod(whole.substr(0, middle + 12)), "a vertex must have three numbers (got");
  expect_told(falling_rod(whole.substr(0, middle)), "it breaks off after");
  expect_told(falling_rod(whole.substr(0, whole.find("facet normal", middle))),
              "it breaks off after");
  std::string word = whole;
  word.replace(word.find("vertex") + 7, 4, "here");
  expect_told(falling_rod(word), "a vertex must have three numbers (got 'vertex here");
  std::string fourth = whole;
  fourth.insert(fourth.find("endloop"), "vertex 0 0 0\n");
  expect_told(falling_rod(fourth), "line 7: a facet must have three vertices (got a fourth)");
  expect_told(falling_rod(""), "mesh empty");
  // Windows's line ends, comments and empty lines are none.
  std::string windows;
  for (const char c : whole)
    windows += c == '\n' ? std::string(" # a remark\r\n\r\n") : std::string(1, c);
  expect_rests(falling_rod(windows), "comments");
  // A binary file: 80 bytes, the count, and of each triangle twelve floats and two bytes.
  const Mesh floor = floor_mesh(1.0, 2);
  std::string binary(80, ' ');
  const auto add = [&](const void *value, size_t size) {
    binary.append(static_cast<const char *>(value), size);
  };
  const auto count = static_cast<unsigned>(floor.size());
  add(&count, sizeof(count));
  for (const MeshTriangle &triangle : floor) {
    const float normal[3] = {0.0F, 0.0F, 1.0F};
    add(normal, sizeof(normal));
    for (const Vec3 &corner : triangle) {
      const float values[3] = {static_cast<float>(corner.x), static_cast<float>(corner.y), 0.0F};
      add(values, sizeof(values));
    }
    binary.append(2, '\0');
  }
  expect_rests(falling_rod(binary), "a binary file");
  expect_told(falling_rod(binary.substr(0, 200)), "Error in reading binary STL file");
}

// Which way triangles look does not matter, nor whether they agree.
TEST(MeshMistakes, NormalsInsideOut)
{
  const std::vector<Frame> wanted = run(falling_rod(stl(floor_mesh(1.0, 4))));
  Mesh mixed = floor_mesh(1.0, 4);
  for (size_t t = 0; t < mixed.size(); t += 3) std::swap(mixed[t][1], mixed[t][2]);
  for (const Mesh &mesh : {turned_over(floor_mesh(1.0, 4)), mixed})
    EXPECT_LT(largest_difference(wanted, run(falling_rod(stl(mesh)))), 1e-12);
}

// A floor that a wall goes through, one with a hole beside the rod, and an open box.
TEST(MeshMistakes, CrossingAndOpenMeshes)
{
  Mesh crossing = floor_mesh(1.0, 1);
  const Mesh upright = tiled({{-0.25, 0.05, -0.3}, {0.5, 0.0, 0.0}, {0.0, 0.0, 0.6}}, 1, 1);
  crossing.insert(crossing.end(), upright.begin(), upright.end());
  expect_rests(falling_rod(stl(crossing)), "a wall through a floor");
  Mesh open = floor_mesh(1.0, 5);
  open.erase(open.begin(), open.begin() + 6);
  expect_rests(falling_rod(stl(open)), "a hole");
  Mesh box = box_mesh({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.0}, 2);
  box.resize(box.size() - 8);
  expect_rests(falling_rod(stl(box)), "an open box");
}

TEST(MeshMistakes, TooFast)
{
  Scene scene = falling_rod(stl(floor_mesh(1.0, 3)));
  scene.physics += "fix shift all move/mesh mesh m linear 600.0 0.0 0.0\n";
  expect_told(scene, "mesh m moves by 0.006 at step");
}

// Rods that are put through a sheet while the run goes on: one warning a mesh and rank with a rod's id,
// none of the sheet that no rod crosses; and each rod, told or not, goes to the side where its centre was and
// stays there. Rods do not see each other.
TEST_P(MeshRanks, InsertionThroughASheetIsTold)
{
  for (const bool across : {true, false}) {
    const DeckFolder folder;
    folder.write("sheet.stl", stl(floor_mesh(0.5, 5, across ? 0.0 : -0.2)));
    folder.write("clear.stl", stl(floor_mesh(0.5, 5, 0.25)));
    folder.write(
        "in.pack",
        preamble(Scene(), GetParam() == 2 ? Mode::TwoRanks : Mode::OneRank) +
            "region box block -0.3 0.3 -0.3 0.3 -0.3 0.3 units box\ncreate_box 1 box\n"
            "region feed block -0.2 0.2 -0.2 0.2 -0.08 0.08 units box\n"
            "neighbor 0.01 bin\nneigh_modify delay 0 exclude type 1 1\n" +
            linear_material(2e3, 1e3, 0.1, 0.0) + rod_pair(kModels) + kMotion +
            mesh_fix("sheet", "sheet.stl") + mesh_fix("clear", "clear.stl") +
            mesh_wall("wall", kModels, {"sheet", "clear"}) +
            "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
            "radius constant 0.005 length constant 0.06\n"
            "fix rods all particledistribution/discrete 32452843 1 rod 1.0\n"
            "fix pack all insert/rate/region seed 86028121 distributiontemplate rods nparticles 60 "
            "particlerate 1e4 insert_every 200 overlapcheck yes orientation random all_in no "
            "maxattempt 1000 vel constant 0.0 0.0 0.0 region feed\n"
            "compute contacts all contact/spherocylinder\ntimestep 1e-5\nthermo 500\n"
            "thermo_modify lost error\n" +
            exact_dump("dump.rods", 1, "id z shapex shapez quat1 quat2 quat3 quat4") +
            "run 1600\n");
    const Outcome outcome = folder.run("in.pack", {Program::Lmp, GetParam(), 60});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const std::string told = "Fix wall/gran (id wall): rod ";
    EXPECT_LE(count_of(outcome.output, told), across ? GetParam() : 0) << outcome.output;
    if (!across) continue;
    const size_t at = outcome.output.find(told);
    ASSERT_NE(at, std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("goes through a face of mesh sheet, near triangle", at),
              std::string::npos);

    struct Life {
      long first;
      double height, rise, last_height, last_rise;
    };
    std::map<int, Life> lives;
    for (const Snapshot &snapshot : read_dump(folder / "dump.rods"))
      for (size_t row = 0; row < snapshot.atoms.rows.size(); row++) {
        const Table &atoms = snapshot.atoms;
        const Vec3 axis = spherocylinder::axis_of({atoms.at(row, "quat1"), atoms.at(row, "quat2"),
                                                   atoms.at(row, "quat3"), atoms.at(row, "quat4")});
        const double rise = std::fabs(axis.z) * (atoms.at(row, "shapez") - atoms.at(row, "shapex"));
        const double height = atoms.at(row, "z");
        const auto [life, is_new] = lives.try_emplace(static_cast<int>(atoms.at(row, "id")),
                                                      Life{snapshot.step, height, rise, 0.0, 0.0});
        life->second.last_height = height;
        life->second.last_rise = rise;
      }
    const Life &warned = lives.at(std::stoi(outcome.output.substr(at + told.size())));
    EXPECT_LT(std::fabs(warned.height), warned.rise);
    int through = 0, later = 0;
    for (const auto &[id, life] : lives) {
      if (std::fabs(life.height) > life.rise || life.first > 800) continue;
      through++;
      later += life.first > 1;
      EXPECT_GT(life.last_height * (life.height > 0.0 ? 1.0 : -1.0), life.last_rise)
          << "rod " << id;
    }
    EXPECT_GT(through, 5);
    EXPECT_GT(later, 3);
  }
}
