// SPDX-License-Identifier: GPL-2.0-or-later
// Rods on and in bodies of triangles: blocks, boxes, tubes, seams, sheets, slots and grates.
#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "mesh_files.h"
#include "scene.h"

using namespace decks;

namespace {

const std::string kModels = "linear tangential history";
constexpr double kGravity = 9.81;
const std::string kWeight =
    fmt::format("fix weight all gravity {} vector 0.0 0.0 -1.0\n", kGravity);
const std::string kMotion = "fix motion all nve/spherocylinder\n";

std::string whole_wall(const std::string &keywords = "", const std::string &models = kModels)
{
  return mesh_fix("m", "wall.stl", "curvature_tolerant yes " + keywords) +
         mesh_wall("wall", models, {"m"});
}

// Rows of the walls' contacts: wall, triangle, rod, force.
struct Load {
  int rod;
  Vec3 force, point;
};

std::vector<Load> last_loads(const Scene &scene, const std::string &walls)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  for (const auto &[name, text] : scene.files) folder.write(name, text);
  folder.write(
      "in.loads",
      preamble(scene) + "read_data rods.data\nneighbor 0.02 bin\nneigh_modify delay 0\n" +
          scene.physics + walls + "compute loads all wall/gran/local id force contactPoint\n" +
          exact_local_dump("dump.loads", scene.steps, "loads", 9) +
          fmt::format("timestep {}\nthermo {}\nrun {}\n", scene.dt, scene.steps, scene.steps));
  const Outcome outcome = folder.run("in.loads");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  std::vector<Load> loads;
  if (outcome.exit_code != 0) return loads;
  const Table rows = read_dump(folder / "dump.loads").back().atoms;
  for (const std::vector<double> &row : rows.rows)
    loads.push_back({static_cast<int>(row[2]), {row[3], row[4], row[5]}, {row[6], row[7], row[8]}});
  return loads;
}

}  // namespace

// A rod lies across two bars, its centre at the part p of their distance from the first: the levers give
// (1 - p) m g and p m g. Bars are sharp roofs, the rims of one block, or sheets on edge.
TEST(RodAcrossTwoEdges, SharesItsWeightByTheLevers)
{
  const double apart = 0.05, s = 0.02;
  const auto roof = [&](double x) {
    return joined({tiled({{x, -0.9, 0.0}, {s, 0.0, -s}, {0.0, 1.8, 0.0}}, 1, 20),
                   tiled({{x, -0.9, 0.0}, {-s, 0.0, -s}, {0.0, 1.8, 0.0}}, 1, 20)});
  };
  const auto blade = [&](double x) {
    return tiled({{x, -0.9, 0.0}, {0.0, 0.0, -s}, {0.0, 1.8, 0.0}}, 1, 30);
  };
  const struct {
    const char *name;
    Mesh mesh;
  } kinds[] = {{"roofs", joined({roof(0.0), roof(apart)})},
               {"blades", joined({blade(0.0), blade(apart)})},
               {"a block", box_mesh({0.0, -0.9, -0.04}, {apart, 0.9, 0.0}, 7)}};
  for (const auto &kind : kinds) {
    Scene scene;
    const double parts[] = {0.5, 0.3, 0.12, 0.6};
    for (const double part : parts) {
      Rod rod;
      rod.position = {part * apart, -0.8 + 0.1 * static_cast<double>(scene.rods.size()),
                      rod.radius()};
      // Also at an angle to the bars' normal: the same part of a longer span.
      const double turn = scene.rods.size() == 3 ? 0.5 : 0.0;
      rod.axis = {std::cos(turn), std::sin(turn), 0.0};
      scene.rods.push_back(rod);
    }
    scene.files["wall.stl"] = stl(kind.mesh);
    scene.physics = linear_material(1e5, 6e4, 0.3, 0.3) + rod_pair(kModels) + kWeight + kMotion +
                    eased_start(2.0, 10000);
    scene.dt = 2e-5;
    scene.steps = 20000;
    const std::vector<Load> loads = last_loads(scene, whole_wall());
    EXPECT_EQ(loads.size(), 8u) << kind.name;
    double error = 0.0;
    for (size_t k = 0; k < scene.rods.size(); k++) {
      const double weight = scene.rods[k].mass() * kGravity;
      double left = 0.0, right = 0.0;
      for (const Load &load : loads)
        if (load.rod == static_cast<int>(k) + 1)
          (load.point.x < 0.5 * apart ? left : right) += load.force.z;
      error = std::max({error, std::fabs(left / weight - (1.0 - parts[k])),
                        std::fabs(right / weight - parts[k])});
    }
    expect_holds(
        {fmt::format("Rods at rest across {}: reactions, / weight", kind.name), "levers", 1e-4},
        error);
  }
}

// ---- vessels ------------------------------------------------------------------------------------

namespace {

// Rods of type 2 meet walls, of type 1; each other they hardly feel.
std::string alone(double kn, double kt, double restitution, double friction)
{
  const auto with_walls = [](double value) {
    return [value](int i, int j) { return i + j == 4 ? 1e-12 * value : value; };
  };
  return pair_property("kn", 2, with_walls(kn)) + pair_property("kt", 2, with_walls(kt)) +
         pair_property("coefficientRestitution", 2, restitution) +
         pair_property("coefficientFriction", 2, friction);
}

// Rods that fly about between walls.
std::vector<Rod> flying_rods(int count, double reach, double speed, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Rod> rods;
  for (int n = 0; n < count; n++) {
    Rod rod;
    rod.type = 2;
    const double ratios[] = {1.0, 3.0, 8.0, 12.0};
    rod.length = ratios[n % 4] * rod.diameter;
    rod.axis = normalized({any(random), any(random), any(random)});
    rod.position = reach * Vec3{any(random), any(random), any(random)};
    rod.velocity = speed * Vec3{any(random), any(random), any(random)};
    rod.omega = 20.0 * Vec3{any(random), any(random), any(random)};
    rods.push_back(rod);
  }
  return rods;
}

}  // namespace

// A box of triangles is its six planes, edges and corners of the vessel included.
TEST(BoxesOfTriangles, AreTheirPlanes)
{
  Scene scene;
  scene.types = 2;
  scene.rods = flying_rods(12, 0.03, 4.0, 982451653);
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.11;
    scene.box_hi[d] = 0.11;
  }
  scene.dt = 5e-6;
  scene.steps = 24000;
  scene.dump_every = 2000;
  const std::string rest = alone(2e5, 1.2e5, 0.7, 0.3) + rod_pair(kModels) + kWeight + kMotion;
  scene.physics = rest;
  for (const char axis : {'x', 'y', 'z'})
    for (const int side : {-1, 1})
      scene.physics += rod_wall(fmt::format("{}{}", axis, side + 1), kModels,
                                fmt::format("type 1 {}plane {}", axis, 0.1 * side));
  const std::vector<Frame> wanted = run(scene);
  for (const int cells : {1, 9}) {
    scene.files["wall.stl"] = stl(box_mesh({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, cells));
    scene.physics = rest + whole_wall();
    expect_holds({fmt::format("Rods that fly about in a box of {} triangles, with friction: "
                              "position (m)",
                              12 * cells * cells),
                  "six planes", 1e-9},
                 largest_difference(wanted, run(scene)));
  }
  int turns = 0;
  for (size_t f = 1; f < wanted.size(); f++)
    for (size_t k = 0; k < scene.rods.size(); k++)
      turns += norm(wanted[f].rods[k].velocity - wanted[f - 1].rods[k].velocity) > 0.3;
  EXPECT_GT(turns, 30);
}

namespace {

constexpr double kTube = 0.1;             // radius, m
constexpr double kTubeStiffness = 400.0;  // N/m

Scene tube_scene(const std::vector<Rod> &rods, int plates)
{
  Scene scene;
  scene.types = 2;
  scene.rods = rods;
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.3;
    scene.box_hi[d] = 0.3;
  }
  const std::string models = "linear tangential off";
  scene.physics = alone(kTubeStiffness, 1e4, 1.0, 0.0) + rod_pair(models) + kMotion;
  if (plates == 0) {
    scene.physics += rod_wall("wall", models, fmt::format("type 1 zcylinder {} 0.0 0.0", kTube));
  } else {
    // Half the sagitta outside, half inside.
    const double half_turn = std::acos(-1.0) / plates;
    const double radius = kTube * 2.0 / (1.0 + std::cos(half_turn));
    scene.files["wall.stl"] = stl(tube_mesh(radius, -0.25, 0.25, plates, 5, 0.1234));
    scene.physics += whole_wall(fmt::format("curvature {}", 1.01 * 360.0 / plates), models);
  }
  scene.dt = 1e-5;
  return scene;
}

// Rods along z, and as chords, that centrifugal force holds on the wall with an overlap of half a
// millimetre or more: they slide round inside.
std::vector<Rod> sliding_round()
{
  std::vector<Rod> rods;
  const double speed = 2.0;
  for (int n = 0; n < 6; n++) {
    Rod rod;
    rod.type = 2;
    rod.length = (n % 3 == 0 ? 5.0 : n % 3 == 1 ? 7.0 : 10.0) * rod.diameter;
    const double angle = 1.0 + n;
    const Vec3 out = {std::cos(angle), std::sin(angle), 0.0};
    const Vec3 round = {-out.y, out.x, 0.0};
    rod.axis = n < 3 ? Vec3{0.0, 0.0, 1.0} : normalized(round + Vec3{0.0, 0.0, 0.3});
    const double half = rod.half_cylinder() * dot(rod.axis, round);
    // Two ends, each k overlap cos(angle of the chord) = m v^2/(distance of the centre)/2.
    double reach = kTube - rod.radius(), overlap = 0.0;
    for (int k = 0; k < 20; k++) {
      const double centre = std::sqrt(reach * reach - half * half);
      overlap = 0.5 * rod.mass() * speed * speed / centre / kTubeStiffness * reach / centre;
      reach = kTube - rod.radius() + overlap;
    }
    EXPECT_GT(overlap, 5e-4);
    const double centre = std::sqrt(reach * reach - half * half);
    rod.position = centre * out + Vec3{0.0, 0.0, 0.05 * n - 0.12};
    rod.velocity = speed * round;
    rod.omega = {0.0, 0.0, speed / centre};
    rods.push_back(rod);
  }
  return rods;
}

}  // namespace

// Of plates whose corners and middles lie as far outside as inside, the error is that of a chord: a quarter
// for twice as many plates, in what a rod moves.
TEST(TubesOfPlates, ConvergeToTheCylinder)
{
  const auto moved = [](int plates) {
    Scene scene = tube_scene(sliding_round(), plates);
    scene.steps = 10000;
    scene.dump_every = 500;
    return run(scene);
  };
  const std::vector<Frame> cylinder = moved(0);
  std::vector<double> errors;
  for (const int plates : {32, 64, 128}) {
    errors.push_back(largest_difference(cylinder, moved(plates)));
    fmt::print("{} plates: {:.3e} m\n", plates, errors.back());
  }
  EXPECT_GT(errors[0] / errors[1], 3.0);
  EXPECT_GT(errors[1] / errors[2], 3.0);
  expect_holds({"Rods that slide round in a tube of 128 plates: position (m)", "zcylinder", 1e-4},
               errors[2]);
}

// ---- seams --------------------------------------------------------------------------------------

// A rod that rolls over seams at constant height, pressed on the floor by its weight, without damping:
// nothing may change its speed. Periodic: the floor of 2500 strips is crossed four times.
TEST(Seams, TakeNoEnergyOfARollingRod)
{
  const double stiffness = 1e5, speed = 4.0;
  Scene scene;
  scene.boundary = "p f f";
  scene.box_lo[0] = -0.5;
  scene.box_hi[0] = 0.5;
  Rod rod;
  rod.axis = {0.0, 1.0, 0.0};
  const double overlap = 0.5 * rod.mass() * kGravity / stiffness;
  rod.position = {0.1, 0.01, rod.radius() - overlap};
  rod.velocity = {speed, 0.0, 0.0};
  rod.omega = {0.0, speed / (rod.radius() - overlap), 0.0};
  scene.rods = {rod};
  scene.files["wall.stl"] =
      stl(tiled({{-0.5, -0.06, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.13, 0.0}}, 2500, 1));
  scene.physics = linear_material(stiffness, 6e4, 1.0, 0.5) + rod_pair(kModels) + kWeight +
                  kMotion + whole_wall("");
  scene.dt = 1e-5;
  scene.steps = 100000;
  const Rod after = run(scene).back().rods[0];
  expect_holds({"Rod that rolled over 10000 seams: energy, relative", "kept", 1e-6},
               std::fabs(after.kinetic_energy() / rod.kinetic_energy() - 1.0));
}

// ---- sheets -------------------------------------------------------------------------------------

// A sheet has two sides; a rod that comes so fast that its axis passes it is sent back all the same. m v^2/2
// = 2 kn depth^2/2 for both ends flat; here 1.5 to 2.8 radii deep. Its speed after is that before.
TEST(Sheets, AreNotCrossedByFastRods)
{
  Scene scene;
  std::vector<Vec3> ways;
  const double stiffness = 1e4;
  for (int n = 0; n < 16; n++) {
    Rod rod;
    rod.diameter = 0.004;
    rod.length = n % 4 == 0 ? rod.diameter : 0.06;
    const double side = n % 2 ? 1.0 : -1.0;
    const double steep = degrees(n % 4 == 3 ? 60.0 : n % 4 == 2 ? 20.0 : 0.0);
    rod.axis = {std::cos(steep), 0.0, std::sin(steep)};
    rod.position = {-0.75 + 0.5 * (n % 4), -0.75 + 0.5 * (n / 4),
                    side * (rod.half_cylinder() * std::fabs(rod.axis.z) + rod.radius() + 1e-3)};
    // Depth d: v = d sqrt(k/m) (or less where one end hits).
    const double deep = (1.5 + 1.3 * n / 15.0) * rod.radius();
    const double speed =
        deep * std::sqrt(2.0 * stiffness / rod.mass()) * (n % 4 == 0 || n % 4 == 2 ? 0.7 : 1.0);
    rod.velocity = {0.0, 0.0, -side * speed};
    scene.rods.push_back(rod);
  }
  scene.files["wall.stl"] =
      stl(tiled({{-0.95, -0.95, 0.0}, {1.9, 0.0, 0.0}, {0.0, 1.9, 0.0}}, 31, 31));
  const std::string models = "linear tangential off";
  scene.physics = linear_material(stiffness, stiffness, 1.0, 0.0) + rod_pair(models) + kMotion +
                  whole_wall("", models);
  scene.dt = 1e-6;
  scene.steps = 6000;
  scene.dump_every = 100;
  const std::vector<Frame> frames = run(scene);
  double change = 0.0;
  for (size_t n = 0; n < scene.rods.size(); n++) {
    const Rod &before = scene.rods[n], &after = frames.back().rods[n];
    const double side = before.position.z > 0.0 ? 1.0 : -1.0;
    double lowest = 1.0;
    for (const Frame &frame : frames)
      for (const double end : {-1.0, 1.0}) {
        const Rod &rod = frame.rods[n];
        lowest = std::min(lowest, side * (rod.position + end * rod.half_cylinder() * rod.axis).z);
      }
    EXPECT_LT(lowest, 0.0) << n;  // its axis was through
    EXPECT_GT(side * after.position.z, 0.0) << n;
    change = std::max(change, std::fabs(after.kinetic_energy() / before.kinetic_energy() - 1.0));
  }
  expect_holds({"Rods thrown deep into a sheet: energy, relative", "kept", 1e-3}, change);
}

namespace {

// Energy over frames of an elastic frictionless run while rods are in gravity: kinetic + m g z, read when
// no contact is near (the last frame), relative to the first.
double energy(const Rod &rod)
{
  return rod.kinetic_energy() + rod.mass() * kGravity * rod.position.z;
}

Scene elastic_scene(const std::vector<Rod> &rods, const Mesh &mesh,
                    const std::string &keywords = "")
{
  const std::string models = "linear tangential off";
  Scene scene;
  scene.rods = rods;
  scene.files["wall.stl"] = stl(mesh);
  scene.physics = linear_material(1e5, 1e5, 1.0, 0.0) + rod_pair(models) + kWeight + kMotion +
                  whole_wall(keywords, models);
  scene.dt = 2e-6;
  return scene;
}

// How much energies differ at the end, where they are all below the mesh and free.
double energy_change(const Scene &scene, const char *name)
{
  const std::vector<Frame> frames = run(scene);
  double change = 0.0;
  for (size_t n = 0; n < scene.rods.size(); n++) {
    const double one = energy(frames.back().rods[n]) - energy(scene.rods[n]);
    const double scale = scene.rods[n].mass() * kGravity * scene.rods[n].length;
    fmt::print("{} rod {}: energy {:+.2e} of m g L, z = {:.3f}\n", name, n, one / scale,
               frames.back().rods[n].position.z);
    EXPECT_TRUE(std::isfinite(one));
    change = std::max(change, std::fabs(one) / scale);
  }
  return change;
}

}  // namespace

// Rods fall through slots of a sheet, off its rims and through a grate of bars, elastic and without
// friction: what is left is what they had. No closed form of the motion, of the energy only.
TEST(Sheets, KeepTheEnergyOfRodsThatFallThroughSlots)
{
  // Two sheets with a slot 0.016 wide along y.
  const Mesh slot =
      joined({tiled({{-0.1, -0.9, 0.0}, {0.092, 0.0, 0.0}, {0.0, 1.8, 0.0}}, 4, 40),
              tiled({{0.008, -0.9, 0.0}, {0.092, 0.0, 0.0}, {0.0, 1.8, 0.0}}, 4, 40)});
  std::vector<Rod> rods;
  for (int n = 0; n < 8; n++) {
    Rod rod;
    const double steep = degrees(66.0 + 3.0 * n);
    rod.axis = {std::cos(steep), 0.0, std::sin(steep)};
    const Vec3 lower_end = {0.0005 * (n % 5 - 2), -0.8 + 0.22 * n, 0.006};
    rod.position = lower_end + rod.half_cylinder() * rod.axis;
    rods.push_back(rod);
  }
  Scene scene = elastic_scene(rods, slot);
  scene.steps = 150000;
  scene.box_lo[2] = -2.0;
  expect_holds({"Rods at a slot: energy, / m g L", "kept", 1e-3}, energy_change(scene, "slot"));
}

TEST(Sheets, KeepTheEnergyOfRodsThatTipOverARim)
{
  const Mesh sheet = tiled({{-0.1, -0.9, 0.0}, {0.1, 0.0, 0.0}, {0.0, 1.8, 0.0}}, 4, 40);
  const Mesh block = box_mesh({-0.1, -0.9, -0.1}, {0.0, 0.9, 0.0}, 6);
  for (const bool solid : {false, true}) {
    std::vector<Rod> rods;
    for (int n = 0; n < 8; n++) {
      Rod rod;
      rod.axis = normalized({1.0, 0.05 * n, 0.0});
      rod.position = {0.005 + 0.004 * n, -0.8 + 0.22 * n, rod.radius() + 1e-4};
      rods.push_back(rod);
    }
    Scene scene = elastic_scene(rods, solid ? block : sheet);
    scene.steps = 200000;
    scene.box_lo[2] = -3.0;
    expect_holds({fmt::format("Rods that tip over the rim of a {}: energy, / m g L",
                              solid ? "block" : "sheet"),
                  "kept", 1e-3},
                 energy_change(scene, solid ? "block" : "sheet"));
  }
}

TEST(Sheets, KeepTheEnergyOfRodsOnAGrate)
{
  std::vector<Mesh> bars;
  for (int k = -4; k <= 4; k++)
    bars.push_back(box_mesh({0.03 * k - 0.004, -0.9, -0.02}, {0.03 * k + 0.004, 0.9, 0.0}, 3));
  std::vector<Rod> rods;
  for (int n = 0; n < 8; n++) {
    Rod rod;
    const double steep = degrees(11.0 * n);
    rod.diameter = 0.006;
    rod.length = 0.05;
    rod.axis = normalized({std::cos(steep), 0.3 * (n % 3), std::sin(steep)});
    rod.position = {0.002 * n - 0.02, -0.8 + 0.22 * n,
                    rod.half_cylinder() * rod.axis.z + rod.radius() + 0.01};
    rods.push_back(rod);
  }
  Scene scene = elastic_scene(rods, joined(bars));
  scene.steps = 60000;
  scene.box_lo[2] = -2.0;
  EXPECT_GE(energy_change(scene, "grate"), 0.0);
}

// Rods that fall on the outside of a drum of plates come off it with about the energy that they had: loads
// shared between plates do a little work, with any time step, the more the finer the plates are beside the
// overlap.
TEST(Drums, KeepTheEnergyOfRodsThatFallOnThem)
{
  const struct {
    int plates;
    double tolerance;
  } drums[] = {{12, 5e-4}, {48, 2e-3}, {192, 1e-2}};
  for (const auto &[plates, tolerance] : drums) {
    const Mesh drum = transformed(tube_mesh(0.1, -0.9, 0.9, plates, 3, 0.01), [](const Vec3 &p) {
      return Vec3{p.x, p.z, p.y};
    });
    std::vector<Rod> rods;
    for (int n = 0; n < 8; n++) {
      Rod rod;
      const double turn = degrees(n < 4 ? 25.0 * n : 12.0);
      const double steep = degrees(n < 4 ? 3.0 : 20.0 * (n - 3));
      rod.axis = {std::cos(steep) * std::cos(turn), std::cos(steep) * std::sin(turn),
                  std::sin(steep)};
      rod.position = {0.03 + 0.002 * n, -0.77 + 0.22 * n,
                      0.1 + rod.half_cylinder() * rod.axis.z + rod.radius()};
      rods.push_back(rod);
    }
    Scene scene = elastic_scene(rods, drum, fmt::format("curvature {}", 1.01 * 360.0 / plates));
    scene.box_lo[2] = -3.0;
    scene.steps = 200000;
    const std::string name = fmt::format("drum of {} plates", plates);
    expect_holds({fmt::format("Rods that fall on a {}: energy, / m g L", name), "kept", tolerance},
                 energy_change(scene, name.c_str()));
  }
}
