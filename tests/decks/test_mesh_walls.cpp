// SPDX-License-Identifier: GPL-2.0-or-later
// Rods against meshes at rest: tilings that are planes, faces, edges and corners, boxes and tubes.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "core/rotation.h"
#include "mesh_files.h"
#include "scene.h"

using namespace decks;

namespace {

const std::string kModels = "linear tangential history";
constexpr double kGravity = 9.81;

std::string gravity(const Vec3 &down)
{
  return fmt::format("fix weight all gravity {} vector {} {} {}\n", kGravity, down.x, down.y,
                     down.z);
}

// ---- tilings ------------------------------------------------------------------------------------

struct Tiling {
  const char *name;
  Mesh (*mesh)(const Sheet &sheet);
};

void PrintTo(const Tiling &tiling, std::ostream *out) { *out << tiling.name; }

const Tiling kTilings[] = {
    {"TwoTriangles", [](const Sheet &sheet) { return tiled(sheet, 1, 1); }},
    {"Cells", [](const Sheet &sheet) { return tiled(sheet, 13, 13); }},
    {"ManyCells", [](const Sheet &sheet) { return tiled(sheet, 61, 47); }},
    {"AnyCells", [](const Sheet &sheet) { return randomly_tiled(sheet, 9, 32452843); }}};

class Tilings : public testing::TestWithParam<Tiling> {};

// Nine rods of five lengths, each on its own: thrown, they come down tumbling on the floor z = 0 from low
// heights, slide, roll and bounce.
std::vector<Rod> thrown_rods()
{
  std::mt19937 random(86028121);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Rod> rods;
  for (int n = 0; n < 9; n++) {
    Rod rod;
    const double ratios[] = {1.0, 2.0, 6.0, 12.0, 25.0};
    rod.length = ratios[n % 5] * rod.diameter;
    rod.axis = normalized({any(random), any(random), 0.4 * any(random)});
    const double lowest = rod.half_cylinder() * std::fabs(rod.axis.z) + rod.radius();
    rod.position = {0.55 * (n % 3 - 1) + 0.1 * any(random), 0.55 * (n / 3 - 1) + 0.1 * any(random),
                    lowest + 0.002};
    rod.velocity = {0.4 * any(random), 0.4 * any(random), -0.2};
    rod.omega = 10.0 * Vec3{any(random), any(random), any(random)};
    rods.push_back(rod);
  }
  return rods;
}

Scene thrown_scene()
{
  Scene scene;
  scene.rods = thrown_rods();
  scene.skin = 0.01;
  scene.dt = 1e-5;
  scene.steps = 12000;
  scene.dump_every = 1000;
  return scene;
}

const std::string kFrictional = linear_material(2e5, 1.2e5, 0.6, 0.3) + rod_pair(kModels);
const Sheet kFloor = {{-0.95, -0.95, 0.0}, {1.9, 0.0, 0.0}, {0.0, 1.9, 0.0}};

}  // namespace

TEST_P(Tilings, AreThePlane)
{
  Scene scene = thrown_scene();
  const std::string motion = gravity({0.0, 0.0, -1.0}) + "fix motion all nve/spherocylinder\n";
  scene.physics = kFrictional + motion + rod_wall("floor", kModels, "type 1 zplane 0.0");
  const std::vector<Frame> plane = run(scene);
  scene.files["floor.stl"] = stl(GetParam().mesh(kFloor));
  scene.physics =
      kFrictional + mesh_fix("m", "floor.stl") + mesh_wall("floor", kModels, {"m"}) + motion;
  const std::vector<Frame> mesh = run(scene);
  expect_holds({fmt::format("Tumbling on a floor of triangles, {}: position (m)", GetParam().name),
                "zplane", 1e-13},
               largest_difference(plane, mesh));
  // They have turned and come a long way.
  double way = 0.0;
  for (size_t k = 0; k < scene.rods.size(); k++)
    way = std::max(way, norm(plane.back().rods[k].position - scene.rods[k].position));
  EXPECT_GT(way, 0.02);
}

// The whole scene turned about an axis that is none of the box's, with gravity: the motion turned.
TEST_P(Tilings, MayBeInclined)
{
  const Vec3 about = normalized({0.3, 1.0, -0.4});
  const double angle = 0.5;
  const auto turned = [&](const Vec3 &a) {
    return std::cos(angle) * a + std::sin(angle) * cross(about, a) +
           (1.0 - std::cos(angle)) * dot(about, a) * about;
  };
  Scene scene = thrown_scene();
  scene.steps = 6000;
  const std::string motion = "fix motion all nve/spherocylinder\n";
  scene.physics = kFrictional + motion + gravity({0.0, 0.0, -1.0}) +
                  rod_wall("floor", kModels, "type 1 zplane 0.0");
  std::vector<Frame> plane = run(scene);
  for (Frame &frame : plane)
    for (Rod &rod : frame.rods) {
      rod.position = turned(rod.position);
      rod.axis = turned(rod.axis);
    }
  for (Rod &rod : scene.rods) {
    rod.position = turned(rod.position);
    rod.axis = turned(rod.axis);
    rod.velocity = turned(rod.velocity);
    rod.omega = turned(rod.omega);
  }
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -1.5;
    scene.box_hi[d] = 1.5;
  }
  scene.files["floor.stl"] =
      stl(GetParam().mesh({turned(kFloor.corner), turned(kFloor.a), turned(kFloor.b)}));
  scene.physics = kFrictional + mesh_fix("m", "floor.stl") + mesh_wall("floor", kModels, {"m"}) +
                  gravity(turned({0.0, 0.0, -1.0})) + motion;
  // Each landing multiplies what rounding began.
  expect_holds({fmt::format("The same on an incline, {}: position (m)", GetParam().name),
                "zplane, turned", 1e-11},
               largest_difference(plane, run(scene)));
}

INSTANTIATE_TEST_SUITE_P(, Tilings, testing::ValuesIn(kTilings),
                         [](const auto &info) { return std::string(info.param.name); });

namespace {

// Down the incline of a tiling about y, gravity upright; rods along the slope, which do not roll, at rest
// on it: m g cos(slope)/2 an end.
Scene incline(double slope, double friction, const std::vector<Vec3> &places)
{
  const double stiffness = 1e5;
  const Vec3 down = {std::cos(slope), 0.0, -std::sin(slope)};
  const Vec3 up = {std::sin(slope), 0.0, std::cos(slope)};
  Scene scene;
  for (const Vec3 &place : places) {
    Rod rod;
    const double overlap = 0.5 * rod.mass() * kGravity * std::cos(slope) / stiffness;
    rod.axis = down;
    rod.position = place.x * down + Vec3{0.0, place.y, 0.0} + (rod.radius() - overlap) * up;
    scene.rods.push_back(rod);
  }
  scene.files["incline.stl"] =
      stl(tiled({-0.9 * down - Vec3{0.0, 0.9, 0.0}, 1.8 * down, {0.0, 1.8, 0.0}}, 60, 7));
  scene.physics = linear_material(stiffness, 6e4, 0.4, friction) + rod_pair(kModels) +
                  mesh_fix("m", "incline.stl") + mesh_wall("incline", kModels, {"m"}) +
                  gravity({0.0, 0.0, -1.0}) + "fix motion all nve/spherocylinder\n";
  scene.dt = 2e-5;
  return scene;
}

}  // namespace

// g (sin - mu cos) along the slope, over 20 seams and more; from when the springs of friction are taut.
TEST(Inclines, RodsSlideDownThem)
{
  const double slope = degrees(30.0), friction = 0.25, time = 0.25;
  Scene scene = incline(slope, friction, {{-0.7, 0.0, 0.0}, {-0.7, 0.3, 0.0}});
  scene.dump_every = static_cast<long>(time / scene.dt + 0.5);
  scene.steps = 3 * scene.dump_every;
  const std::vector<Frame> frames = run(scene);
  const Vec3 down = {std::cos(slope), 0.0, -std::sin(slope)};
  const double wanted = kGravity * (std::sin(slope) - friction * std::cos(slope)) * time * time;
  double error = 0.0;
  for (size_t k = 0; k < scene.rods.size(); k++) {
    const auto place = [&](size_t f) { return dot(frames[f].rods[k].position, down); };
    const double got = place(3) - 2.0 * place(2) + place(1);
    error = std::max(error, std::fabs(got / wanted - 1.0));
    EXPECT_GT(place(3) - place(0), 0.6);
  }
  expect_holds({"Rods that slide down an incline of triangles: acceleration, relative",
                "g (sin - mu cos)", 1e-6},
               error);
}

// Just below the angle of friction a rod stays where it is, wherever the seams are under its ends: its
// centres lie at 17 places from one seam to the next, and on a seam.
TEST(Inclines, RodsStayOnThem)
{
  const double friction = 0.4, slope = std::atan(friction) * 0.97;
  std::vector<Vec3> places;
  for (int k = 0; k < 17; k++) places.push_back({-0.3 + 0.03 * k / 16.0, -0.8 + 0.1 * k, 0.0});
  Scene scene = incline(slope, friction, places);
  scene.physics += eased_start(0.5, 6000);
  scene.steps = 30000;
  scene.dump_every = 15000;
  const std::vector<Frame> frames = run(scene);
  double creep = 0.0, settled = 0.0;
  for (size_t k = 0; k < places.size(); k++) {
    creep = std::max(creep, norm(frames[2].rods[k].position - frames[1].rods[k].position));
    settled = std::max(settled, norm(frames[1].rods[k].position - frames[0].rods[k].position));
  }
  EXPECT_LT(settled, 1e-5);
  expect_holds({"Rods at rest on an incline of triangles: creep in 0.3 s (m)", "0", 1e-11}, creep);
}

// ---- faces, edges, corners ----------------------------------------------------------------------

namespace {

constexpr double kApproach = 1e-5;  // so slow that nothing turns while it touches (m/s)
constexpr double kStiffness = 1e4;  // N/m
constexpr double kGap = 1e-11;

// A rod that a point of a mesh stops: `along` the axis from its centre, with the normal towards the rod.
struct Impact {
  const char *on;
  Rod rod;
  double along = 0.0;
  Vec3 normal{0.0, 0.0, 1.0};
  Mesh mesh;

  Vec3 arm() const { return along * rod.axis; }
  double speed_of_point(const Rod &moving) const
  {
    return dot(moving.velocity + cross(moving.omega, along * moving.axis), normal);
  }
};

// `point` of the mesh, `along` of the rod's axis, of elevation and azimuth (degrees); any normal that is
// the surface's, or at right angles to the axis between its ends.
Impact impact(const char *on, const Mesh &mesh, const Vec3 &point, double elevation, double azimuth,
              double along, const Vec3 &normal)
{
  Impact made;
  made.on = on;
  made.mesh = mesh;
  Rod &rod = made.rod;
  const double e = degrees(elevation), a = degrees(azimuth);
  rod.axis = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
  made.along = along * rod.half_cylinder();
  made.normal = normal;
  rod.position = point + (rod.radius() + kGap) * normal - made.along * rod.axis;
  rod.velocity = -kApproach * normal;
  return made;
}

// The normal between an axis and an edge line, upwards.
Vec3 across(double elevation, double azimuth, const Vec3 &edge)
{
  const double e = degrees(elevation), a = degrees(azimuth);
  const Vec3 axis = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
  const Vec3 n = normalized(cross(axis, edge));
  return n.z < 0.0 ? -n : n;
}

// Of a rod whose axis goes through a point: upwards, at right angles to the axis.
Vec3 above(double elevation, double azimuth)
{
  const double e = degrees(elevation), a = degrees(azimuth);
  return {-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e)};
}

std::vector<Impact> impacts()
{
  const double s = 0.06;
  const Sheet flat = {{-s, -s, 0.0}, {2.0 * s, 0.0, 0.0}, {0.0, 2.0 * s, 0.0}};
  const Mesh face = tiled(flat, 3, 3);
  const Mesh sheet = tiled({{-s, -s, 0.0}, {s, 0.0, 0.0}, {0.0, 2.0 * s, 0.0}}, 2, 3);  // to x = 0
  const Mesh roof = joined({tiled({{0.0, -s, 0.0}, {s, 0.0, -s}, {0.0, 2.0 * s, 0.0}}, 2, 4),
                            tiled({{0.0, -s, 0.0}, {-s, 0.0, -s}, {0.0, 2.0 * s, 0.0}}, 3, 4)});
  // Steeper than a ridge seen from any side, so that rods up to 30 degrees steep touch the tip alone.
  const Vec3 tip = {0.0, 0.0, 0.0}, base[4] = {{0.02, 0.02, -0.05},
                                               {-0.02, 0.02, -0.05},
                                               {-0.02, -0.02, -0.05},
                                               {0.02, -0.02, -0.05}};
  Mesh pyramid;
  for (int k = 0; k < 4; k++) pyramid.push_back({tip, base[k], base[(k + 1) % 4]});
  const Vec3 y = {0.0, 1.0, 0.0}, z = {0.0, 0.0, 1.0}, x = {1.0, 0.0, 0.0};

  std::vector<Impact> all;
  for (const double elevation : {20.0, 60.0, 90.0})
    all.push_back(impact("face", face, {0.004, 0.001, 0.0}, elevation, 25.0, -1.0, z));
  // Between its ends on the ridge, and an end on it.
  for (const double along : {0.0, 0.4, -0.8})
    all.push_back(impact("ridge", roof, {0.0, 0.003, 0.0}, 0.0, 0.0, along, across(0.0, 0.0, y)));
  all.push_back(impact("ridge", roof, {0.0, 0.002, 0.0}, 30.0, 40.0, 0.6, across(30.0, 40.0, y)));
  all.push_back(impact("ridge", roof, {0.0, 0.001, 0.0}, 70.0, 10.0, -1.0, z));
  all.push_back(
      impact("ridge", roof, {0.0, 0.001, 0.0}, 80.0, 10.0, -1.0, normalized({0.3, 0.0, 1.0})));
  // The rim of the sheet: from above, on the slant, straight on, and an end.
  all.push_back(impact("rim", sheet, {0.0, 0.0, 0.0}, 10.0, 180.0, 0.5, across(10.0, 180.0, y)));
  all.push_back(impact("rim", sheet, {0.0, 0.0, 0.0}, 45.0, 180.0, 0.5, across(45.0, 180.0, y)));
  all.push_back(impact("rim", sheet, {0.0, 0.0, 0.0}, 90.0, 0.0, -0.3, x));
  all.push_back(impact("rim", sheet, {0.0, 0.0, 0.0}, 0.0, 0.0, -1.0, x));
  all.push_back(
      impact("rim", sheet, {0.0, 0.0, 0.0}, 60.0, 20.0, -1.0, normalized({1.0, 0.0, 1.0})));
  // The tip.
  for (const double elevation : {0.0, 15.0})
    for (const double azimuth : {0.0, 45.0, 100.0})
      all.push_back(
          impact("tip", pyramid, tip, elevation, azimuth, 0.5, above(elevation, azimuth)));
  all.push_back(impact("tip", pyramid, tip, 80.0, 10.0, -1.0, z));
  all.push_back(impact("tip", pyramid, tip, 85.0, 10.0, -1.0, normalized({0.1, -0.1, 1.0})));
  // A corner of the sheet, on the slant and in its plane.
  all.push_back(impact("sheet's corner", sheet, {0.0, -s, 0.0}, 0.0, 45.0, 0.4,
                       normalized({1.0, -1.0, 0.2})));
  all.push_back(impact("sheet's corner", sheet, {0.0, -s, 0.0}, 0.0, 45.0, -0.3,
                       normalized({1.0, -1.0, 0.0})));
  return all;
}

}  // namespace

// Without friction a contact at the arm a with the normal n has 1/m_eff = 1/m + |a x n|^2/I_t, and its
// point parts with e times its speed: v + (1+e) v m_eff/m n, omega + (1+e) v m_eff/I_t a x n.
TEST(MeshImpacts, KeepTheRestitutionAtTheContact)
{
  std::vector<Impact> all = impacts();
  // A place of its own for each.
  std::vector<Mesh> meshes;
  Scene scene;
  const std::vector<double> restitutions = {1.0, 0.7, 0.3};
  scene.types = static_cast<int>(restitutions.size());
  std::vector<Impact> made;
  for (size_t e = 0; e < restitutions.size(); e++)
    for (Impact one : all) {
      const int n = static_cast<int>(made.size());
      const Vec3 place = {-0.85 + 0.2 * (n % 9), -0.85 + 0.2 * (n / 9), 0.1};
      one.mesh = transformed(one.mesh, [&](const Vec3 &p) { return p + place; });
      one.rod.position = one.rod.position + place;
      one.rod.type = static_cast<int>(e) + 1;
      meshes.push_back(one.mesh);
      scene.rods.push_back(one.rod);
      made.push_back(one);
    }
  ASSERT_LT(made.size(), 81u);
  scene.files["all.stl"] = stl(joined(meshes));
  const auto restitution = [&](int i, int j) { return restitutions[std::max(i, j) - 1]; };
  const std::string models = "linear tangential off";
  scene.physics = pair_property("kn", 3, kStiffness) + pair_property("kt", 3, kStiffness) +
                  pair_property("coefficientRestitution", 3, restitution) + rod_pair(models) +
                  mesh_fix("m", "all.stl") + mesh_wall("all", models, {"m"}) +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-6;
  scene.steps = 9000;

  const std::vector<Rod> after = run(scene).back().rods;
  std::map<std::string, double> worst;
  for (size_t k = 0; k < made.size(); k++) {
    const Impact &one = made[k];
    const auto p = one.rod.properties();
    const double e = restitutions[one.rod.type - 1];
    const Vec3 twist = cross(one.arm(), one.normal);
    const double mass = 1.0 / (1.0 / p.mass + norm_squared(twist) / p.inertia_transverse);
    const double impulse = (1.0 + e) * kApproach * mass;
    const Vec3 velocity = one.rod.velocity + impulse / p.mass * one.normal;
    const Vec3 omega = impulse / p.inertia_transverse * twist;
    const double error = (norm(after[k].velocity - velocity) +
                          norm(after[k].omega - omega) * one.rod.half_cylinder()) /
                         kApproach;
    worst[one.on] = std::max(worst[one.on], error);
    EXPECT_LT(error, 2e-3) << one.on << " " << k % all.size() << " e=" << e
                           << ": point leaves with " << one.speed_of_point(after[k]) / kApproach;
  }
  for (const auto &[on, error] : worst)
    expect_holds({fmt::format("Impact off the centre without friction, on a {}: velocities, "
                              "relative",
                              on),
                  "J = (1+e) v/(1/m + |a x n|^2/I_t)", 2e-3},
                 error);
}

// A rod that lies in the plane of a sheet's corner and crosses it there touches both rims and the corner at
// one place: its restitution is that of one contact, a hair inside as outside.
TEST(MeshImpacts, AreOfOneContactWhereTwoRimsMeet)
{
  const double e = 0.7, s = 0.06;
  const std::string models = "linear tangential off";
  for (const double inside : {-1e-6, -1e-12, 0.0, 1e-12, 1e-9, 1e-7, 1e-5}) {
    Scene scene;
    Impact one = impact("corner", {}, {-inside, inside, 0.0}, 0.0, 45.0, 0.4, {0.0, 0.0, 1.0});
    // One that only just misses the corner is there too.
    scene.rods = {one.rod};
    scene.files["sheet.stl"] = stl(tiled({{-s, 0.0, 0.0}, {s, 0.0, 0.0}, {0.0, s, 0.0}}, 2, 2));
    scene.physics = linear_material(kStiffness, kStiffness, e, 0.0) + rod_pair(models) +
                    mesh_fix("m", "sheet.stl") + mesh_wall("wall", models, {"m"}) +
                    "fix motion all nve/spherocylinder\n";
    scene.dt = 1e-6;
    scene.steps = 9000;
    const double got = one.speed_of_point(run(scene).back().rods[0]) / kApproach;
    EXPECT_NEAR(got, e, 2e-3) << inside;
  }
}
