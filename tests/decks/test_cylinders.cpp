// SPDX-License-Identifier: GPL-2.0-or-later
// The outside of cylinders, which rods touch anywhere along themselves, and cylinders whose radius is a
// variable.
#include <cmath>
#include <ostream>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "scene.h"

using namespace decks;

namespace {

constexpr const char *kFrictionless = "linear tangential off";
constexpr const char *kModels = "linear tangential history";
constexpr double kStiffness = 2e4;
const std::string kMotion = "fix motion all nve/spherocylinder\n";

// Place k of a vector whose first place is that of `axis`, then round.
Vec3 turned(int axis, const Vec3 &v)
{
  return axis == 2 ? v : axis == 0 ? Vec3{v.z, v.x, v.y} : Vec3{v.y, v.z, v.x};
}

std::string cylinder(int axis, const std::string &radius, const std::string &keywords = "")
{
  return fmt::format("type 1 {}cylinder {} 0.0 0.0 {}", "xyz"[axis], radius, keywords);
}

double nearest_of(const Rod &rod, double radius)
{
  double least = 1e300;
  for (int n = -1000; n <= 1000; n++) {
    const Vec3 at = rod.position + (n / 1000.0 * rod.half_cylinder()) * rod.axis;
    least = std::min(least, std::hypot(at.x, at.y) - radius - rod.radius());
  }
  return least;
}

// Rods that fly and tumble in a closed box round a post along z.
Scene rods_round_a_post(const std::string &models, double restitution, double friction)
{
  std::mt19937 random(32452843);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Scene scene;
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.31;
    scene.box_hi[d] = 0.31;
  }
  for (const double ratio : {1.0, 3.0, 10.0, 20.0, 1.0, 3.0, 10.0, 20.0, 6.0}) {
    Rod rod;
    rod.length = ratio * rod.diameter;
    do {
      rod.position = 0.16 * Vec3{any(random), any(random), 0.0};
      rod.position.z = -0.2 + 0.05 * static_cast<double>(scene.rods.size());
      rod.axis = normalized({any(random), any(random), 0.3 * any(random)});
    } while (nearest_of(rod, 0.06) < 1e-3);
    rod.velocity = 3.0 * Vec3{any(random), any(random), 0.0};
    rod.omega = 30.0 * Vec3{any(random), any(random), any(random)};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e5, 6e4, restitution, friction) + rod_pair(models) +
                  rod_wall("post", models, cylinder(2, "0.06"));
  for (const char *plane : {"x", "y", "z"})
    for (const char *place : {"-0.3", "0.3"})
      scene.physics += rod_wall(fmt::format("{}{}", plane, place[0] == '-' ? "low" : "high"),
                                models, fmt::format("type 1 {}plane {}", plane, place));
  scene.physics += kMotion;
  scene.dt = 2e-6;
  scene.steps = 100000;
  scene.dump_every = 20000;
  return scene;
}

}  // namespace

// A rod that crosses a post off its centre: J = (1 + e) v/(1/m + a^2/I), a slow impact that turns nothing.
TEST(OutsideOfACylinder, OffCentreImpact)
{
  double worst = 0.0;
  for (int axis = 0; axis < 3; axis++)
    for (const double restitution : {1.0, 0.5})
      for (const double lever : {0.0, 0.02, -0.04}) {
        const double speed = 1e-4;
        Scene scene;
        Rod rod;
        rod.axis = turned(axis, {0.0, 1.0, 0.0});
        rod.position = turned(axis, {0.08 + rod.radius() + 1e-9, lever, 0.1});
        rod.velocity = turned(axis, {-speed, 0.0, 0.0});
        scene.rods = {rod};
        scene.physics = linear_material(1e6, 1e6, restitution, 0.0) + rod_pair(kFrictionless) +
                        rod_wall("post", kFrictionless, cylinder(axis, "0.08")) + kMotion;
        scene.dt = 5e-8;
        scene.steps = 20000;
        const Rod end = run(scene).back().rods[0];
        const auto p = rod.properties();
        const double J =
            (1.0 + restitution) * speed / (1.0 / p.mass + lever * lever / p.inertia_transverse);
        const Vec3 velocity = turned(axis, {-speed + J / p.mass, 0.0, 0.0});
        const Vec3 omega = turned(axis, {0.0, 0.0, lever * J / p.inertia_transverse});
        worst = std::max(
            {worst, norm(end.velocity - velocity) / speed, norm(end.omega - omega) * 0.05 / speed});
      }
  expect_holds({"A rod crosses a post off its centre", "closed form", 1e-3}, worst);
}

// The outside of a cylinder is a rod of its radius that cannot move, parallel rods and all.
TEST(OutsideOfACylinder, IsALongRodHeldStill)
{
  double worst = 0.0;
  std::mt19937 random(86028121);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const char *keywords : {"", "spread_contact off"})
    for (const double tilt : {0.0, 1e-4, 1e-3, 0.01, 0.1, 1.0}) {
      Scene scene;
      for (int n = 0; n < 8; n++) {
        Rod rod;
        const double angle = 0.25 * M_PI * n;
        const Vec3 out = {std::cos(angle), std::sin(angle), 0.0};
        rod.axis = normalized({tilt * any(random), tilt * any(random), 1.0});
        rod.position = (tilt < 0.5 ? 0.13 : 0.17) * out + Vec3{0.0, 0.0, 0.2 * any(random)};
        rod.velocity = -1.0 * out;
        rod.omega = {any(random), any(random), any(random)};
        scene.rods.push_back(rod);
      }
      scene.box_lo[2] = -2.0;
      scene.box_hi[2] = 2.0;
      const std::string material =
          linear_material(1e5, 6e4, 0.7, 0.0) + rod_pair(kFrictionless, keywords);
      scene.physics =
          material + rod_wall("post", kFrictionless, cylinder(2, "0.1", keywords)) + kMotion;
      scene.dt = 5e-6;
      scene.steps = 20000;
      std::vector<Frame> at_wall = run(scene);
      Rod post;
      post.diameter = 0.2;
      post.length = 3.6;
      post.axis = {0.0, 0.0, 1.0};
      post.density = 1e3;
      post.type = 2;
      scene.rods.push_back(post);
      scene.types = 2;
      scene.physics = linear_material(1e5, 6e4, 0.7, 0.0, 2) + rod_pair(kFrictionless, keywords) +
                      "group post type 2\ngroup rods type 1\nfix held post freeze\n"
                      "fix motion rods nve/spherocylinder\n";
      std::vector<Frame> at_rod = run(scene);
      for (Frame &frame : at_rod) frame.rods.pop_back();
      worst = std::max(worst, largest_difference(at_wall, at_rod));
    }
  expect_holds({"A post, and a rod held still in its place", "pair contact", 1e-12}, worst);
}

// Elastic and without friction, all that flies keeps its energy; and no ranks or restart change a motion.
TEST(OutsideOfACylinder, KeepsEnergy)
{
  Scene scene = rods_round_a_post(kFrictionless, 1.0, 0.0);
  const std::vector<Frame> frames = run(scene);
  const double before = kinetic_energy(frames.front().rods);
  scene.dt *= 0.5;
  scene.steps *= 2;
  scene.dump_every *= 2;
  const double error = std::fabs(kinetic_energy(frames.back().rods) / before - 1.0);
  const double half = std::fabs(kinetic_energy(run(scene).back().rods) / before - 1.0);
  expect_holds({"Energy of rods round a post", "conservation", 1e-5}, error);
  expect_holds({"Energy of rods round a post, half the step", "conservation", 1e-6}, half);
  for (const Frame &frame : frames)
    for (const Rod &rod : frame.rods) EXPECT_GT(nearest_of(rod, 0.06), -0.5 * rod.radius());
}

TEST(OutsideOfACylinder, RanksAndRestartsChangeNothing)
{
  Scene scene = rods_round_a_post(kModels, 0.6, 0.4);
  scene.steps = 40000;
  const std::vector<Frame> one = run(scene);
  for (const Mode mode : {Mode::TwoRanks, Mode::FourRanks, Mode::Restarted})
    EXPECT_LT(largest_difference(one, run(scene, mode)), 1e-10) << name_of(mode);
}

// A rod in the groove between two bars slides along it: each bears m g/(2 cos b), b the angle of its normal,
// and friction stops it with mu g/cos b.
TEST(OutsideOfACylinder, RodSlidesInAGroove)
{
  Scene scene;
  const double bar = 0.03, apart = 0.02, mu = 0.2, speed = 0.3;  // bars at y = -+0.02
  Rod rod;
  const double sine = apart / (bar + rod.radius()), cosine = std::sqrt(1.0 - sine * sine);
  const double load = rod.mass() * 9.81 / (2.0 * cosine);
  rod.position = {-0.5, 0.0, (bar + rod.radius() - load / kStiffness) * cosine};
  rod.velocity = {speed, 0.0, 0.0};
  scene.rods = {rod};
  scene.physics = linear_material(kStiffness, 5.7e3, 0.5, mu) + rod_pair(kModels) +
                  rod_wall("left", kModels, "type 1 xcylinder 0.03 -0.02 0.0") +
                  rod_wall("right", kModels, "type 1 xcylinder 0.03 0.02 0.0") +
                  "fix weight all gravity 9.81 vector 0.0 0.0 -1.0\n" + kMotion;
  scene.dt = 5e-6;
  scene.steps = 40000;
  scene.dump_every = 20000;
  const std::vector<Frame> frames = run(scene);
  const double brake = mu * 9.81 / cosine, stop = speed * speed / (2.0 * brake);
  const double way = frames[1].rods[0].position.x + 0.5;
  expect_holds({"A rod slides in the groove of two bars: way at 0.1 s", "closed form", 1e-3},
               std::fabs(way / (speed * 0.1 - 0.5 * brake * 0.01) - 1.0));
  expect_holds({"A rod slides in the groove of two bars: way to rest", "closed form", 1e-3},
               std::fabs((frames.back().rods[0].position.x + 0.5) / stop - 1.0));
  EXPECT_NEAR(frames.back().rods[0].position.y, 0.0, 1e-9);
}

// A bar that turns under a rod that lies along it drags it with mu g while it slides.
TEST(OutsideOfACylinder, TurningBarDragsARod)
{
  Scene scene;
  Rod rod;
  rod.axis = {0.0, 1.0, 0.0};
  const double load = rod.mass() * 9.81;
  rod.position = {0.0, 0.0, 0.1 + rod.radius() - load / kStiffness};
  scene.rods = {rod};
  scene.physics = linear_material(kStiffness, 5.7e3, 0.5, 0.2) + rod_pair(kModels) +
                  rod_wall("bar", kModels, cylinder(1, "0.1", "shear z 5.0")) +
                  "fix weight all gravity 9.81 vector 0.0 0.0 -1.0\n" + kMotion;
  scene.dt = 5e-6;
  scene.steps = 2000;
  const Rod end = run(scene).back().rods[0];
  // Sliding: mu g t along the surface's velocity, about y as LIGGGHTS's cylinders turn.
  EXPECT_NEAR(std::fabs(end.velocity.x), 0.2 * 9.81 * 0.01, 0.02 * 0.2 * 9.81 * 0.01);
  EXPECT_NEAR(end.velocity.y, 0.0, 1e-6);
}

namespace {

struct Growth {
  const char *name;
  bool inside;
  double speed;  // of the radius
};

void PrintTo(const Growth &growth, std::ostream *out) { *out << growth.name; }

class CylinderThatGrows : public testing::TestWithParam<Growth> {};

}  // namespace

// A rod held still along the cylinder: kn times the depth and 2 beta sqrt(kn m_eff) times the speed at which the
// surface comes; inside two ends that share the load, outside one contact.
TEST_P(CylinderThatGrows, PushesByItsPlaceAndItsSpeed)
{
  const Growth &growth = GetParam();
  for (int axis = 0; axis < 3; axis++)
    for (const Mode mode : {Mode::OneRank, Mode::TwoRanks}) {
      Scene scene;
      Rod rod;
      rod.axis = turned(axis, {0.0, 0.0, 1.0});
      const Vec3 out = {0.6, 0.8, 0.0};
      rod.position = turned(axis, 0.2 * out);
      scene.rods = {rod};
      const double gap = growth.inside ? 1e-4 : -1e-4,
                   first = 0.2 + (growth.inside ? 1 : -1) * 0.005 + gap;
      scene.physics =
          linear_material(kStiffness, 5.7e3, 0.5, 0.0) + rod_pair(kModels) +
          fmt::format("variable size equal {}+{}*step*dt\n", first, growth.speed) +
          rod_wall("tube", kModels, cylinder(axis, "v_size", "store_force yes")) +
          "fix hold all move linear 0.0 0.0 0.0\n"
          "compute fx all reduce sum f_force_tube[1]\ncompute fy all reduce sum f_force_tube[2]\n"
          "compute fz all reduce sum f_force_tube[3]\n"
          "thermo_style custom step c_fx c_fy c_fz\nthermo 100\nthermo_modify norm no lost error\n";
      scene.dt = 2e-5;
      scene.steps = 1000;
      const DeckFolder folder;
      folder.write("rods.data", data_file(scene));
      folder.write("in.grow", preamble(scene, mode) + "read_data rods.data\nneighbor 0.02 bin\n" +
                                  "neigh_modify delay 0\n" + scene.physics +
                                  "timestep 2e-5\nrun 400\nrun 600\n");
      const Outcome outcome =
          folder.run("in.grow", {Program::Lmp, mode == Mode::OneRank ? 1 : 2, 60});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
      const std::vector<double> row = read_thermo(outcome.output).rows.back();
      const double depth = std::fabs(growth.speed) * 1000 * 2e-5 - std::fabs(gap);
      const double beta = -std::log(0.5) / std::hypot(std::log(0.5), M_PI);
      const double contacts = growth.inside ? 2.0 : 1.0;
      const double damping = 2.0 * beta * std::sqrt(kStiffness * rod.mass() / contacts);
      const double push = contacts * (kStiffness * depth + damping * std::fabs(growth.speed));
      const Vec3 wanted = turned(axis, (growth.inside ? -push : push) * out);
      EXPECT_LT(norm(Vec3{row[1], row[2], row[3]} - wanted), 1e-6 * push)
          << axis << ": " << row[1] << " " << row[2] << " " << row[3] << ", wanted " << wanted.x
          << " " << wanted.y << " " << wanted.z;
    }
}

INSTANTIATE_TEST_SUITE_P(, CylinderThatGrows,
                         testing::Values(Growth{"TubeThatShrinks", true, -0.02},
                                         Growth{"PostThatGrows", false, 0.02}),
                         [](const auto &info) { return std::string(info.param.name); });

// Without its speed a wall would push by 2.5 N less in the first step after a restart, 1e-7 m in the end.
TEST(GrowingCylinders, KeepTheirSpeedInARestart)
{
  Scene scene;
  for (int n = 0; n < 4; n++) {
    Rod rod;
    const double angle = 0.3 + 0.5 * M_PI * n;
    rod.position = {0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.1 * n};
    rod.axis = {0.0, 0.0, 1.0};
    scene.rods.push_back(rod);
  }
  scene.physics =
      linear_material(kStiffness, 5.7e3, 0.5, 0.3) + rod_pair(kModels) +
      "variable tube equal 0.1051-0.2*step*dt\nvariable post equal 0.0949+0.1*step*dt\n" +
      rod_wall("tube", kModels, cylinder(2, "v_tube")) +
      rod_wall("post", kModels, cylinder(2, "v_post")) + kMotion;
  scene.dt = 1e-6;
  scene.steps = 2000;
  scene.dump_every = 500;
  const std::vector<Frame> whole = run(scene);
  EXPECT_LT(largest_difference(whole, run(scene, Mode::Restarted)), 1e-10);
  EXPECT_LT(largest_difference(whole, run(scene, Mode::FourRanks)), 1e-12);
}

namespace {

struct Refusal {
  const char *name, *walls, *sentence;
};

void PrintTo(const Refusal &refusal, std::ostream *out) { *out << refusal.name; }

class CylindersRefuse : public testing::TestWithParam<Refusal> {};

}  // namespace

TEST_P(CylindersRefuse, InOneSentence)
{
  Scene scene;
  Rod rod;
  rod.axis = {0.0, 1.0, 0.0};
  scene.rods = {rod};
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.walls", preamble(scene) + "read_data rods.data\nneighbor 0.02 bin\n" +
                               linear_material(kStiffness, 5.7e3, 0.5, 0.2) + rod_pair(kModels) +
                               GetParam().walls + kMotion + "timestep 1e-5\nrun 10\n");
  const Outcome outcome = folder.run("in.walls", {Program::Lmp, 1, 60});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find(GetParam().sentence), std::string::npos) << outcome.output;
}

#define TUBE \
  "fix tube all wall/gran model linear tangential history surface spherocylinder primitive type 1 "

INSTANTIATE_TEST_SUITE_P(
    , CylindersRefuse,
    testing::Values(
        Refusal{"RodAcross", TUBE "zcylinder 0.03 0.02 0.03\n",
                "Fix wall/gran (id tube): the axis of rod 1 is across the cylinder at step 0"},
        Refusal{"RadiusBelowZero",
                "variable r equal 0.00001-0.000003*step\n" TUBE "zcylinder v_r 0.5 0.0\n",
                "variable r for the cylinder's radius must be a number > 0 (got -2e-06 at step 4)"},
        Refusal{"RadiusJumps", "variable r equal 0.5-0.2*(step>5)\n" TUBE "zcylinder v_r 0.0 0.0\n",
                "the cylinder's radius jumps by -0.2 at step 6, wanted at most the thinnest rod's "
                "radius 0.005"},
        Refusal{"TooNarrow", "variable r equal 0.006-0.0001*step\n" TUBE "ycylinder v_r 0.0 0.0\n",
                "the cylinder's radius 0.005 must be larger than that of the thickest rod"},
        Refusal{"NoName", TUBE "zcylinder v_ 0.0 0.0\n",
                "v_ must be followed by the name of a variable"},
        Refusal{"PostAtAPeriodicFace",
                "change_box all boundary p p f\n" TUBE "zcylinder 0.1 -0.87 0.0\n",
                "must lie within the box, -1 to 1, by half the length of the longest rod outside"},
        Refusal{
            "NoVariable", TUBE "zcylinder v_r 0.0 0.0\n",
            "variable r for the cylinder's radius must be of style equal (got none of this name)"}),
    [](const auto &info) { return std::string(info.param.name); });
