// SPDX-License-Identifier: GPL-2.0-or-later
// fix move with rods: centres, axes, velocities and spins of driven rods by closed form, and what
// they do to rods in their way.
#include <algorithm>
#include <cmath>
#include <string>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

constexpr double kPi = 3.14159265358979323846;

class FixMove : public RunMode {};

// Rodrigues' formula.
Vec3 turned(const Vec3 &a, const Vec3 &about, double angle)
{
  const Vec3 n = normalized(about);
  return std::cos(angle) * a + std::sin(angle) * cross(n, a) +
         (1.0 - std::cos(angle)) * dot(n, a) * n;
}

std::string contact_commands()
{
  return linear_material(2e4, 5.7e3, 0.5, 0.0) + rod_pair("linear tangential history");
}

// Three rods of different lengths and directions, far apart.
Scene apart(const std::string &motion)
{
  Scene scene;
  for (int k = 0; k < 3; k++) {
    Rod rod;
    rod.length = 0.02 + 0.05 * k;
    rod.position = {-0.4 + 0.4 * k, 0.3 - 0.2 * k, 0.1 * k};
    rod.axis = normalized({0.3 + k, -0.5, 0.8 - k});
    scene.rods.push_back(rod);
  }
  scene.physics = contact_commands() + motion;
  scene.dt = 1e-4;
  scene.steps = 4000;
  scene.dump_every = 500;
  return scene;
}

// The distance in a box of period 2 in each direction.
double distance_of_images(Vec3 a)
{
  for (double *d : {&a.x, &a.y, &a.z}) *d = std::remainder(*d, 2.0);
  return norm(a);
}

struct Motion {
  Vec3 position, axis, velocity, omega;
};

// Largest difference of position and axis, and of velocity and spin in the second.
template <typename Expected>
std::pair<double, double> errors(const Scene &scene, Mode mode, Expected expected)
{
  double pose = 0.0, rates = 0.0;
  for (const Frame &frame : run(scene, mode)) {
    if (frame.step == 0) continue;
    for (size_t k = 0; k < frame.rods.size(); k++) {
      const Rod &rod = frame.rods[k];
      const Motion wanted = expected(scene.rods[k], frame.time);
      pose = std::max(
          {pose, distance_of_images(rod.position - wanted.position), norm(rod.axis - wanted.axis)});
      rates =
          std::max({rates, norm(rod.velocity - wanted.velocity), norm(rod.omega - wanted.omega)});
    }
  }
  return {pose, rates};
}

// About any axis through any point, right round and more, in a periodic box.
TEST_P(FixMove, RotatesCentresAndAxes)
{
  const Vec3 abouts[] = {{1.0, 0.0, 0.0}, {0.0, -2.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 2.0, -2.0}};
  double pose = 0.0, rates = 0.0;
  for (const Vec3 &about : abouts) {
    if (GetParam() != Mode::OneRank && about.z >= 0.0) continue;
    const double period = about.y < 0.0 ? -0.3 : 0.3;
    const Vec3 point = {0.5, -0.1, 0.2};
    char command[200];
    snprintf(command, sizeof(command), "fix turn all move rotate 0.5 -0.1 0.2 %g %g %g %g\n",
             about.x, about.y, about.z, period);
    Scene scene = apart(command);
    scene.boundary = "p p p";
    const double rate = 2.0 * kPi / period;
    const auto error = errors(scene, GetParam(), [&](const Rod &start, double time) {
      const Vec3 omega = rate * normalized(about);
      const Vec3 arm = turned(start.position - point, about, rate * time);
      return Motion{point + arm, turned(start.axis, about, rate * time), cross(omega, arm), omega};
    });
    pose = std::max(pose, error.first);
    rates = std::max(rates, error.second);
  }
  expect_holds({"fix move rotate: positions and axes (m, 1)", "rotation about the axis", 1e-11},
               pose);
  expect_holds({"fix move rotate: velocities and spins", "omega x arm, omega", 1e-10}, rates);
}

// No rotation is prescribed: the axis turns with the spin that a rod has.
TEST_P(FixMove, LinearKeepsTheSpin)
{
  Scene scene = apart("fix go all move linear 0.3 -0.2 0.1\n");
  scene.rods[1].omega = {3.0, -4.0, 12.0};
  const auto error = errors(scene, GetParam(), [&](const Rod &start, double time) {
    const Vec3 v = {0.3, -0.2, 0.1};
    const double rate = norm(start.omega);
    return Motion{start.position + time * v,
                  rate > 0.0 ? turned(start.axis, start.omega, rate * time) : start.axis, v,
                  start.omega};
  });
  expect_holds({"fix move linear: positions and axes (m, 1)", "x + v t, spin kept", 1e-11},
               error.first);
  expect_holds({"fix move linear: velocities and spins", "v, omega", 1e-12}, error.second);
}

TEST_P(FixMove, Wiggles)
{
  const auto error = errors(apart("fix go all move wiggle 0.05 0.0 -0.03 0.17\n"), GetParam(),
                            [&](const Rod &start, double time) {
                              const double w = 2.0 * kPi / 0.17;
                              const Vec3 a = {0.05, 0.0, -0.03};
                              return Motion{start.position + std::sin(w * time) * a,
                                            start.axis,
                                            w * std::cos(w * time) * a,
                                            {0.0, 0.0, 0.0}};
                            });
  expect_holds({"fix move wiggle: positions and axes (m, 1)", "A sin(w t)", 1e-12}, error.first);
  expect_holds({"fix move wiggle: velocities", "A w cos(w t)", 1e-11}, error.second);
}

// Displacements and velocities by variables; a direction without either is free.
TEST(DrivenRods, FollowsVariables)
{
  Scene scene = apart(R"(variable x equal 0.1*sin(20*step*dt)
variable vx equal 2*cos(20*step*dt)
variable vy atom 0.5+0*x
fix go all move variable v_x NULL NULL v_vx v_vy NULL
fix gravity all gravity 10 vector 0 0 -1
)");
  const auto error = errors(scene, Mode::OneRank, [&](const Rod &start, double time) {
    return Motion{start.position +
                      Vec3{0.1 * std::sin(20.0 * time), 0.5 * time, -5.0 * time * time},
                  start.axis,
                  {2.0 * std::cos(20.0 * time), 0.5, -10.0 * time},
                  {0.0, 0.0, 0.0}};
  });
  expect_holds({"fix move variable: positions and axes (m, 1)", "the formulas, free fall", 1e-10},
               error.first);
  expect_holds({"fix move variable: velocities", "the formulas, free fall", 1e-10}, error.second);
}

// A paddle turns about its middle and strikes an upright rod at rest. Their axes, at right angles,
// touch at the distance D, when the paddle is asin(D/r) short of the rod's direction. The paddle
// does not give way: without friction the rod leaves with (1 + e) times the paddle's speed at the
// contact along its normal, which is omega sqrt(r^2 - D^2). The paddle turns on during the contact,
// which takes 65 steps (0.5 degrees).
TEST_P(FixMove, PaddleStrikesARod)
{
  Scene scene;
  Rod paddle, target;
  paddle.length = 0.2;
  target.length = 0.05;
  target.position = {0.06, 0.05, 0.0};
  target.axis = {0.0, 0.0, 1.0};
  scene.rods = {paddle, target};
  scene.physics = contact_commands() + "group paddle id 1\ngroup free id 2\n"
                                       "fix turn paddle move rotate 0 0 0 0 0 1 1.0\n"
                                       "fix motion free nve/spherocylinder\n";
  scene.dt = 2e-5;
  scene.steps = 6000;
  scene.dump_every = GetParam() == Mode::OneRank ? 1 : 1000;
  long struck = 0;
  double speed = 0.0;
  for (const Frame &frame : run(scene, GetParam())) {
    speed = std::hypot(frame.rods[1].velocity.x, frame.rods[1].velocity.y);
    if (!struck && speed > 0.0) struck = frame.step;
  }
  const double r = std::hypot(0.06, 0.05), rate = 2.0 * kPi;
  const double angle = std::atan2(0.05, 0.06) - std::asin(0.01 / r);
  const double expected = 1.5 * rate * std::sqrt(r * r - 1e-4);
  if (GetParam() == Mode::OneRank) {
    EXPECT_NEAR(static_cast<double>(struck), std::ceil(angle / rate / scene.dt), 1.0);
  }
  expect_holds({"fix move rotate: speed of a rod struck by a driven one, relative",
                "(1 + e) omega sqrt(r^2 - D^2)", 4e-3},
               std::fabs(speed / expected - 1.0));
}

// Once the fix is gone the rods are free tops that start from the driven motion.
TEST(DrivenRods, RodsAreFreeAfterUnfix)
{
  Scene scene = apart("fix turn all move rotate 0 0 0 0.6 0 0.8 3\n");
  scene.physics += "timestep 1e-4\nrun 700\nunfix turn\nfix motion all nve/spherocylinder\n";
  scene.steps = 2000;
  scene.dump_every = 1000;
  const std::vector<Frame> frames = run(scene);
  double error = 0.0;
  for (size_t k = 0; k < scene.rods.size(); k++) {
    const Vec3 about = {0.6, 0.0, 0.8};
    const double rate = 2.0 * kPi / 3.0, driven = 0.07, free = frames.back().time - driven;
    Rod start = scene.rods[k];
    start.position = turned(start.position, about, rate * driven);
    start.axis = turned(start.axis, about, rate * driven);
    start.omega = rate * about;
    const Vec3 L = start.angular_momentum();
    const Vec3 axis = turned(start.axis, L, norm(L) / start.properties().inertia_transverse * free);
    const Vec3 position = start.position + free * cross(start.omega, start.position);
    const Rod &now = frames.back().rods[k];
    error = std::max({error, norm(now.axis - axis), norm(now.position - position)});
  }
  expect_holds(
      {"fix move, then free: axes and positions (1, m)", "precession at abs(L)/I_t", 1e-10}, error);
}

// A limit on all rods lets the driven ones turn as they are told.
TEST(DrivenRods, AreNotLimited)
{
  Scene scene = apart("");
  scene.rods[0].omega = {0.0, 0.0, 50.0};
  scene.rods[0].axis = {1.0, 0.0, 0.0};
  scene.physics += "group free id 1\ngroup driven subtract all free\n"
                   "fix turn driven move rotate 0 0 0 0 0 1 0.3\n"
                   "fix motion free nve/spherocylinder\nfix limit all limit/omega 5\n";
  scene.steps = scene.dump_every = 100;
  const Frame last = run(scene).back();
  EXPECT_NEAR(norm(last.rods[0].omega), 5.0, 1e-12);
  for (size_t k = 1; k < 3; k++) {
    EXPECT_NEAR(last.rods[k].omega.z, 2.0 * kPi / 0.3, 1e-12);
    EXPECT_LT(norm(last.rods[k].axis -
                   turned(scene.rods[k].axis, {0.0, 0.0, 1.0}, 2.0 * kPi / 0.3 * last.time)),
              1e-12);
  }
}

// Half a millimetre deep, by a position without a velocity: both ends of a lying rod are on the
// floor. By a velocity as well, each end's dashpot adds c v with c = 2 beta sqrt(k m_eff).
TEST(DrivenRods, PressOnTheFloor)
{
  for (const bool has_velocity : {false, true}) {
    Rod rod;
    rod.position.z = 0.02;
    Scene scene;
    scene.rods = {rod};
    scene.skin = 0.1;
    scene.dt = 2e-5;
    scene.steps = 969;
    const double speed = 0.016 / 1000.0 / scene.dt;
    char motion[300];
    snprintf(motion, sizeof(motion),
             "variable dz equal -%.17g*step*dt\nvariable vz equal -%.17g\n"
             "fix lower all move variable NULL NULL v_dz NULL NULL %s\n",
             speed, speed, has_velocity ? "v_vz" : "NULL");
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("in.floor",
                 preamble(scene) + "read_data rods.data\nneighbor 0.1 bin\nneigh_modify delay 0\n" +
                     contact_commands() +
                     rod_wall("floor", "linear tangential history", "type 1 zplane 0.0") + motion +
                     "timestep 2e-5\n" + exact_dump("dump.floor", 969, "id fz") + "run 969\n");
    const Outcome outcome = folder.run("in.floor");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const double force = read_dump(folder / "dump.floor").back().atoms.at(0, "fz");
    const double spring = 2.0 * 2e4 * (0.016 * 0.969 - 0.015);
    if (!has_velocity) {
      EXPECT_NEAR(force, spring, 1e-9);
      continue;
    }
    // Each end carries half the rod: 1/m_eff = 2/m.
    const double beta = -std::log(0.5) / std::hypot(kPi, std::log(0.5));
    const double damping = 2.0 * 2.0 * beta * std::sqrt(2e4 * 0.5 * rod.mass()) * speed;
    EXPECT_NEAR(force, spring + damping, 1e-6 * force);
  }
}

// Two rods that are both driven press on each other with k times the overlap.
TEST(DrivenRods, DrivenRodsPressOnEachOther)
{
  Scene scene;
  Rod below, above;
  above.axis = {0.0, 1.0, 0.0};
  above.position.z = 0.0105;
  scene.rods = {below, above};
  scene.physics =
      contact_commands() +
      "group below id 1\ngroup above id 2\n"
      "variable dz equal -1e-3*step/1000\n"
      "fix stay below move linear 0 0 0\n"
      "fix push above move variable NULL NULL v_dz NULL NULL NULL\n"
      "compute push above reduce sum fz\nfix out all ave/time 1 1 1000 c_push file force\n";
  scene.dt = 1e-5;
  scene.steps = 1000;
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.push", preamble(scene) + "read_data rods.data\n" + scene.physics +
                              "timestep 1e-5\nrun 1000\n");
  ASSERT_EQ(folder.run("in.push").exit_code, 0);
  const std::string force = folder.read("force");
  EXPECT_NEAR(std::stod(force.substr(force.rfind(' '))), 2e4 * 5e-4, 1e-6) << force;
}

struct Jump {
  const char *name, *before, *between;
};

void PrintTo(const Jump &jump, std::ostream *out) { *out << jump.name; }

class FixMoveJump : public testing::TestWithParam<Jump> {};

// LIGGGHTS would put these rods, without a word, to where the first definition of the fix says.
TEST_P(FixMoveJump, IsRefused)
{
  const Scene scene = apart("");
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.jump", preamble(scene) + "read_data rods.data\n" + scene.physics +
                              "group some id 1\nfix rest all nve/spherocylinder\nunfix rest\n" +
                              "group others id 3\n" + GetParam().before +
                              "\ntimestep 1e-4\nrun 20\n" + GetParam().between + "\nrun 20\n");
  const Outcome outcome = folder.run("in.jump");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("would jump by"), std::string::npos) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(
    , FixMoveJump,
    testing::Values(Jump{"LateInTheGroup", "fix hold all freeze\nfix go some move linear 0.1 0 0",
                         "group some id 3"},
                    Jump{"LateInTheGroupOfAVariable",
                         "variable x equal 1e-6*step\nfix hold all freeze\n"
                         "fix go some move variable v_x NULL NULL NULL NULL NULL",
                         "group some id 3"},
                    Jump{"OtherTimeStep", "fix go all move rotate 0 0 0 0 0 1 0.1",
                         "timestep 3e-4"},
                    Jump{"OtherStep", "fix go all move linear 0.5 0 0", "reset_timestep 1000"}),
    [](const auto &info) { return std::string(info.param.name); });

DECKS_IN_ALL_MODES(FixMove);

}  // namespace
