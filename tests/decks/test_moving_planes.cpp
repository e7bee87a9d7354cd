// SPDX-License-Identifier: GPL-2.0-or-later
// Walls that move, and rods that are moved into walls by something else than their velocity.
#include <cmath>
#include <ostream>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

constexpr double kStiffness = 2e4;
constexpr const char *kModels = "linear tangential history";

std::string start_of(const Scene &scene, int ranks)
{
  std::string start = preamble(scene);
  start.insert(start.find("newton"), ranks == 2   ? "processors 2 1 1\n"
                                     : ranks == 4 ? "processors 2 2 1\n"
                                                  : "");
  return start + "read_data rods.data\nneighbor 0.02 bin\nneigh_modify delay 0\n" +
         linear_material(kStiffness, 5.7e3, 0.5, 0.2) + rod_pair(kModels) + "timestep 2e-5\n";
}

Outcome run_deck(const DeckFolder &folder, const Scene &scene, const std::string &commands,
                 int ranks = 1)
{
  folder.write("rods.data", data_file(scene));
  folder.write("in.walls", start_of(scene, ranks) + commands);
  return folder.run("in.walls", {Program::Lmp, ranks, 60});
}

// A rod along the axis after `axis`, its centre at `height` along `axis`, and one far away.
Scene rod_over_a_wall(int axis, double height)
{
  Scene scene;
  Rod rod;
  double x[3] = {0.01, 0.02, -0.01}, u[3] = {0.0, 0.0, 0.0};
  x[axis] = height;
  u[(axis + 1) % 3] = 1.0;
  rod.position = {x[0], x[1], x[2]};
  rod.axis = {u[0], u[1], u[2]};
  scene.rods.push_back(rod);
  rod.position = rod.position + Vec3{0.4, 0.4, 0.4};
  scene.rods.push_back(rod);
  return scene;
}

}  // namespace

// A rod that is lowered by a variable position, with no velocity given, feels 2 kn x the depth: an end each.
// By displace_atoms between runs, with and without `pre no`, it does too.
TEST(WallsOfMovedRods, FeelThem)
{
  const char *const kMoves[] = {
      "fix lower driven move variable {0} NULL {1}\nfix motion free nve/spherocylinder\nrun 1000\n",
      "fix lower driven move variable {0} NULL {1}\nfix motion free nve/spherocylinder\n"
      "run 200\nrun 300 pre no post no\nrun 500\n",
      "fix motion all nve/spherocylinder\nrun 10\n"
      "displace_atoms driven move {2} units box\nrun 0\n",
      "fix motion all nve/spherocylinder\nrun 10\n"
      "displace_atoms driven move {2} units box\nrun 1 pre no\n"};
  for (int axis = 0; axis < 3; axis++)
    for (const char *move : kMoves)
      for (const int ranks : axis == 2 ? std::vector<int>{1, 2} : std::vector<int>{1}) {
        const char *const three[3][3] = {{"v_dz NULL", "NULL NULL NULL", "-0.016 0 0"},
                                         {"NULL v_dz", "NULL NULL NULL", "0 -0.016 0"},
                                         {"NULL NULL v_dz", "NULL NULL", "0 0 -0.016"}};
        const std::string lower =
            fmt::format(fmt::runtime(move), three[axis][0], three[axis][1], three[axis][2]);
        const DeckFolder folder;
        const Outcome outcome = run_deck(
            folder, rod_over_a_wall(axis, 0.02),
            "group driven id 1\ngroup free id 2\nvariable dz equal -0.016*step/1000\n" +
                fmt::format("fix floor all wall/gran model {} surface spherocylinder primitive "
                            "type 1 {}plane 0.0 store_force yes\n",
                            kModels, "xyz"[axis]) +
                fmt::format("compute f driven reduce sum f_force_floor[{}]\n", axis + 1) +
                "thermo_style custom step c_f\nthermo 100\nthermo_modify norm no\n" + lower,
            ranks);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
        const double force = read_thermo(outcome.output).rows.back()[1];
        EXPECT_NEAR(force, 2.0 * kStiffness * 1e-3, 1e-6) << lower << ranks;
      }
}

// The fix may be named after its keyword.
TEST(MovingPlanes, TurnIsAnId)
{
  const DeckFolder folder;
  const Outcome outcome = run_deck(
      folder, rod_over_a_wall(2, 0.02),
      "fix motion all nve/spherocylinder\n"
      "fix turn all wall/gran model linear tangential history surface spherocylinder primitive "
      "type 1 zplane 0.0 turn 1.0 0.0 0.0\nrun 1\n");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

// A rod that is held where it is: an end gives kn times its depth less the damping 2 beta sqrt(kn m_eff) times
// the plane's speed, with 1/m_eff of one of two ends that share the load.
TEST(MovingPlanes, PushByTheirPlaceAndTheirSpeed)
{
  for (int axis = 0; axis < 3; axis++)
    for (const double speed : {-0.015, 0.02})
      for (const int ranks : axis == 2 ? std::vector<int>{1, 2, 4} : std::vector<int>{1}) {
        Scene scene = rod_over_a_wall(axis, 0.0);
        const double side = speed < 0.0 ? 1.0 : -1.0;  // on which the plane is
        const double first = side * 0.0051, last = first + speed * 1000 * 2e-5;
        const DeckFolder folder;
        const Outcome outcome = run_deck(
            folder, scene,
            fmt::format(
                "group held id 1\ngroup free id 2\nvariable place equal {}+{}*step*dt\n"
                "fix hold held move linear 0.0 0.0 0.0\nfix motion free nve/spherocylinder\n"
                "fix lid all wall/gran model {} surface spherocylinder primitive type 1 "
                "{}plane v_place store_force yes\n"
                "compute f all reduce sum f_force_lid[{}]\n"
                "thermo_style custom step c_f\nthermo 100\nthermo_modify norm no\n"
                "run 400\nrun 600\n",
                first, speed, kModels, "xyz"[axis], axis + 1),
            ranks);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
        const double depth = 0.005 - std::fabs(last);
        const double beta = -std::log(0.5) / std::hypot(std::log(0.5), M_PI);
        const double damping = 2.0 * beta * std::sqrt(kStiffness * 0.5 * scene.rods[0].mass());
        const double wanted = -side * 2.0 * (kStiffness * depth + damping * std::fabs(speed));
        EXPECT_NEAR(read_thermo(outcome.output).rows.back()[1], wanted, 1e-6 * std::fabs(wanted))
            << speed << " " << ranks;
      }
}

// The dashpot's force in the first step after a restart is that in the first step of a second run.
TEST(MovingPlanes, KeepTheirSpeedInARestart)
{
  const std::string lid =
      "variable place equal 0.0051-0.5*step*dt\n"
      "fix hold held move linear 0.0 0.0 0.0\nfix motion free nve/spherocylinder\n"
      "fix lid all wall/gran model linear tangential history surface spherocylinder primitive "
      "type 1 zplane v_place store_force yes\ncompute f all reduce sum f_force_lid[3]\n"
      "thermo_style custom step c_f\nthermo 100\nthermo_modify norm no\n";
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    const Outcome whole = run_deck(folder, rod_over_a_wall(2, 0.0),
                                   "group held id 1\ngroup free id 2\n" + lid +
                                       "run 50\nwrite_restart rods.restart\nrun 10\n",
                                   ranks);
    ASSERT_EQ(whole.exit_code, 0) << whole.output;
    folder.write("in.rest", preamble(Scene{}) + "read_restart rods.restart\nneighbor 0.02 bin\n" +
                                "neigh_modify delay 0\n" +
                                linear_material(kStiffness, 5.7e3, 0.5, 0.2) + rod_pair(kModels) +
                                "timestep 2e-5\n" + lid + "run 10\n");
    const Outcome rest = folder.run("in.rest", {Program::Lmp, ranks, 60});
    ASSERT_EQ(rest.exit_code, 0) << rest.output;
    const auto wanted = read_thermo(whole.output).rows, got = read_thermo(rest.output).rows;
    ASSERT_GE(wanted.size(), 2u);
    ASSERT_EQ(got.size(), 2u);
    for (size_t k = 0; k < 2; k++) {
      const auto &row = wanted[wanted.size() - 2 + k];
      EXPECT_EQ(got[k][0], row[0]);
      EXPECT_NEAR(got[k][1], row[1], 1e-6 * std::fabs(row[1]));
    }
  }
}

// A plane that goes up and down under a rod is the rod going up and down over a plane at rest: the same
// forces in frames that move past each other at constant speed, tangential springs included.
TEST(MovingPlanes, AreAsRodsThatMove)
{
  const double speed = 0.05;
  std::vector<Frame> frames[2];
  for (int moving = 0; moving < 2; moving++) {
    Scene scene = rod_over_a_wall(2, 0.006);
    scene.rods[0].velocity = {0.1, 0.05, moving ? 0.0 : -speed};
    scene.rods[0].omega = {0.0, 1.0, 0.0};
    scene.rods[1].velocity = {0.0, 0.0, moving ? speed : 0.0};
    scene.physics =
        linear_material(kStiffness, 5.7e3, 0.5, 0.2) + rod_pair(kModels) +
        fmt::format("variable place equal {}*step*dt\n", speed) +
        rod_wall("floor", kModels, moving ? "type 1 zplane v_place" : "type 1 zplane 0.0") +
        "fix motion all nve/spherocylinder\n";
    scene.dt = 1e-5;
    scene.steps = 4000;
    scene.dump_every = 100;
    frames[moving] = run(scene);
    EXPECT_LT(largest_difference(frames[moving], run(scene, Mode::TwoRanks)), 1e-12);
  }
  for (size_t f = 0; f < frames[0].size(); f++)
    for (Rod &rod : frames[1][f].rods) rod.position.z -= speed * frames[1][f].time;
  EXPECT_LT(largest_difference(frames[0], frames[1]), 1e-11);
}

// A ball of radius r that lies on a plate which begins to turn is dragged at the wall's speed W a of its
// place: it slides, then rolls with W a/(1 + m r^2/I), 2/7 of it. On any normal and about any centre.
TEST(TurningPlanes, SetABallRolling)
{
  for (int axis = 0; axis < 3; axis++)
    for (const double lever : {0.05, 0.2}) {
      Scene scene;
      Rod ball;
      ball.length = ball.diameter;
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      double x[3];
      x[axis] = 0.1 + 0.00499;
      x[a] = 0.03;
      x[b] = -0.02 + lever;
      ball.position = {x[0], x[1], x[2]};
      scene.rods = {ball};
      const double rate = 0.03 / lever;
      double down[3] = {0.0, 0.0, 0.0};
      down[axis] = -1.0;
      scene.physics =
          linear_material(kStiffness, 5.7e3, 0.3, 0.4) + rod_pair(kModels) +
          fmt::format("fix gravity all gravity 9.81 vector {} {} {}\n", down[0], down[1], down[2]) +
          rod_wall("plate", kModels,
                   fmt::format("type 1 {}plane 0.1 turn {} 0.03 -0.02", "xyz"[axis], rate)) +
          "fix motion all nve/spherocylinder\n";
      scene.dt = 1e-5;
      scene.steps = 2000;
      const Rod end = run(scene).back().rods[0];
      const double velocity[3] = {end.velocity.x, end.velocity.y, end.velocity.z};
      // About direction `axis`, at a place along b: towards -a.
      EXPECT_NEAR(velocity[a], -rate * lever * 2.0 / 7.0, 0.05 * 0.03) << axis;
      EXPECT_NEAR(velocity[b], 0.0, 0.05 * 0.03);
    }
}

namespace {

struct Refusal {
  const char *name, *commands, *sentence;
};

void PrintTo(const Refusal &refusal, std::ostream *out) { *out << refusal.name; }

#define WALL \
  "fix lid all wall/gran model linear tangential history surface spherocylinder primitive type 1 "

const Refusal kRefusals[] = {
    {"NoVariable", WALL "zplane v_nothing\n", "must be of style equal (got none of this name)"},
    {"AtomVariable", "variable h atom x\n" WALL "zplane v_h\n",
     "must be of style equal (got another style)"},
    {"Jump", "variable h equal 0.5-0.3*(step>5)\n" WALL "yplane v_h\n",
     "Fix wall/gran (id lid): the plane's position jumps by -0.3 at step 6"},
    {"NoNumber", "variable h equal 0.1*(step>5)/(step<6)\n" WALL "zplane v_h\n", ""},
    {"CylinderAxis", "variable h equal 0.5\n" WALL "zcylinder 0.5 0.0 v_h\n",
     "must have an axis of two numbers (got v_h)"},
    {"ShearAlongTheNormal", WALL "zplane -0.5 shear z 3.0\n",
     "shear z is along the plane's normal"},
    {"TurningCylinder", WALL "zcylinder 0.9 0.0 0.0 turn 1.0 0.0 0.0\n", "turn is for a plane"},
    {"TurnWithoutCentre", WALL "zplane -0.5 turn 1.0 0.0\n", "turn must be followed by"},
};

class MovingPlanesRefuse : public testing::TestWithParam<Refusal> {};

}  // namespace

TEST_P(MovingPlanesRefuse, InOneSentence)
{
  const DeckFolder folder;
  const Outcome outcome =
      run_deck(folder, rod_over_a_wall(2, 0.0),
               std::string(GetParam().commands) + "fix motion all nve/spherocylinder\nrun 10\n");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find(GetParam().sentence), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("ERROR"), std::string::npos) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(, MovingPlanesRefuse, testing::ValuesIn(kRefusals),
                         [](const auto &info) { return std::string(info.param.name); });
