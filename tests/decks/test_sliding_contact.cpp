// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts that stick, slide along rods or turn with them: a long rest on an incline, spinning rods
// that come to rest, V grooves, a turning drum, a pair whose common normal turns.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

class SlidingContact : public RunMode {};

constexpr double kGravity = 9.81;
constexpr double kStiffness = 1e5;
const std::string kModels = "linear tangential history";

const std::string kFloor = rod_wall("floor", kModels, "type 1 zplane 0.0");

// Contacts of the rods with each other; rods of the last atom type are fixed.
std::string contacts_and_fixed_rods(int fixed_type, const std::string &keywords = "")
{
  return "pair_style gran model " + kModels + " surface spherocylinder" + keywords +
         "\npair_coeff * *\n" +
         fmt::format("group fixed type {}\ngroup loose subtract all fixed\n"
                     "fix hold fixed freeze\nfix motion loose nve/spherocylinder\n",
                     fixed_type);
}

std::string gravity(const Vec3 &direction)
{
  return fmt::format("fix weight all gravity {} vector {} {} {}\n", kGravity, direction.x,
                     direction.y, direction.z);
}

// Gravity as an incline feels it that goes down along +x.
std::string gravity_on_slope(double slope)
{
  return gravity({std::sin(slope), 0.0, -std::cos(slope)});
}

// On a floor at z = 0, sunk in by what its weight needs.
Rod lying_rod(const Vec3 &axis, double slope = 0.0)
{
  Rod rod;
  rod.axis = axis;
  rod.position.z = rod.radius() - rod.mass() * kGravity * std::cos(slope) / (2.0 * kStiffness);
  return rod;
}

// Two rods to fix below a horizontal rod, that cross it at `arm` from its centre and lean outwards
// by `half_angle`, so that their tops are a notch: at an overlap of `sink` with the rod.
std::vector<Rod> notch(const Rod &above, double arm, double half_angle, double sink, int type)
{
  const Vec3 up = {0.0, 0.0, 1.0}, across = cross(up, above.axis);
  std::vector<Rod> sides;
  for (const double side : {-1.0, 1.0}) {
    Rod rod;
    rod.type = type;
    rod.axis = std::cos(half_angle) * up + side * std::sin(half_angle) * across;
    const Vec3 normal = std::sin(half_angle) * up - side * std::cos(half_angle) * across;
    rod.position =
        above.position + arm * above.axis - (above.radius() + rod.radius() - sink) * normal;
    sides.push_back(rod);
  }
  return sides;
}

constexpr double kNotchArm = 0.025;  // either side of the rod's centre

// A groove of two notches: the four contacts carry N = m g_n/(4 sin(half_angle)) each, g_n the part
// of gravity that presses the rod into it.
void add_groove(Scene &scene, const Rod &rod, double half_angle, double sink)
{
  for (const double arm : {-kNotchArm, kNotchArm})
    for (const Rod &side : notch(rod, arm, half_angle, sink, scene.types))
      scene.rods.push_back(side);
}

// A slope of 20 degrees under a friction of 0.5 for 10^6 steps, 10 s: a rod down the slope on the
// floor, one on two fixed rods across the slope, and one in a groove at 45 degrees to the slope (it
// would roll anywhere else).
TEST(LongRest, OnAnInclineWithoutCreep)
{
  const double slope = degrees(20.0);
  Scene scene;
  scene.types = 2;
  scene.box_lo[2] = -0.2;
  Rod on_floor = lying_rod({1.0, 0.0, 0.0}, slope);
  on_floor.position.y = -0.6;
  Rod on_bars, in_groove;
  on_bars.position = {0.0, 0.0, 0.2};
  in_groove.position = {0.0, 0.6, 0.2};
  in_groove.axis = normalized({1.0, 1.0, 0.0});
  scene.rods = {on_floor, on_bars, in_groove};
  for (const double arm : {-0.03, 0.02}) {
    Rod bar;
    bar.type = 2;
    bar.axis = {0.0, 1.0, 0.0};
    bar.position = on_bars.position + Vec3{arm, 0.0, -bar.diameter};
    scene.rods.push_back(bar);
  }
  add_groove(scene, in_groove, degrees(45.0), 0.0);
  scene.physics = linear_material(kStiffness, kStiffness, 0.3, 0.5, 2) +
                  contacts_and_fixed_rods(2) + kFloor + gravity_on_slope(slope);
  scene.dt = 1e-5;
  scene.steps = 1000000;
  scene.dump_every = scene.steps / 20;
  const std::vector<Frame> frames = run(scene);

  const Frame &settled = frames[1], &end = frames.back();
  double creep = 0.0;
  for (size_t k = 0; k < 3; k++)
    creep = std::max(creep, norm(end.rods[k].position - settled.rods[k].position));
  // A rod that turns by less than the last digit of its quaternion in a step, 10^-16, keeps its
  // axis: a rate up to 10^-16/dt goes on for ever and carries the rod along at r times that,
  // 5e-14 m/s. The tangential springs are 4e-7 m long.
  expect_holds({"Incline, 10^6 steps, on a floor, on bars, in a groove: creep (m)", "none", 1e-12},
               creep);
}

// Flat on a floor and turning about the vertical: the ends slide at right angles to the rod, each
// under m g/2, with the torque mu m g h/2 in all: omega falls at mu m g h/(2 I_t), and the rod
// stops after omega^2/(2 x that) rad.
TEST_P(SlidingContact, FlatRodSpinsDown)
{
  const double friction = 0.2;
  Scene scene;
  scene.box_lo[2] = -0.1;
  Rod fast = lying_rod({1.0, 0.0, 0.0}), slow = fast;
  fast.omega.z = 25.0;
  slow.omega.z = -8.0;
  slow.position.y = 0.2;
  scene.rods = {fast, slow};
  scene.physics = linear_material(kStiffness, kStiffness, 0.3, friction) + rod_pair(kModels) +
                  kFloor + "fix motion all nve/spherocylinder\n" + gravity_on_slope(0.0);
  scene.dt = 1e-5;
  scene.steps = 20000;
  scene.dump_every = 100;
  const std::vector<Frame> frames = run(scene, GetParam());

  const auto p = fast.properties();
  const double slowing = friction * p.mass * kGravity * fast.half_cylinder() / p.inertia_transverse;
  const Frame &start = frames[1], &middle = frames[102], &end = frames.back();
  const auto rate = [&](const Frame &frame) { return frame.rods[0].omega.z; };
  // Not over the restart half way: in a run's first step LIGGGHTS's history model damps without
  // the limit of friction, which may give the rod a sideways speed of 10^-2 of that of its ends.
  double error = 0.0;
  for (const auto &[from, to] : {std::pair{&start, &frames[100]}, std::pair{&middle, &end}})
    error = std::max(
        error, std::fabs((rate(*from) - rate(*to)) / (to->time - from->time) / slowing - 1.0));
  expect_holds({"Flat rod turning on a floor: deceleration, relative", "mu m g h/(2 I_t)", 1e-4},
               error);
  EXPECT_LT(norm(frames[100].rods[0].position - fast.position), 1e-9)
      << "the forces of the two ends must cancel";

  const double left = std::fabs(start.rods[1].omega.z);
  const auto heading = [](const Rod &rod) { return std::atan2(rod.axis.y, rod.axis.x); };
  const double turned = heading(start.rods[1]) - heading(end.rods[1]);
  // It ends with the springs' length, mu m g/(2 kt) = 2e-7 m, over the arm.
  expect_holds({"Flat rod turning on a floor: angle at which it stops, relative",
                "omega^2 I_t/(mu m g h)", 1e-4},
               std::fabs(turned / (left * left / (2.0 * slowing)) - 1.0));
  EXPECT_LT(norm(end.rods[1].omega), 1e-9);
}

// Turning about its own axis in a groove of half angle a. Friction pushes the rod up one side, so
// that the sides carry unequal N1, N2: across (N1 - N2) cos(a) = mu (N1 + N2) sin(a), upwards
// (N1 + N2) sin(a) + mu (N1 - N2) cos(a) = m g, from which N1 + N2 = m g/(sin(a) (1 + mu^2)).
// omega falls at mu r (N1 + N2)/I_a.
TEST_P(SlidingContact, RodSpinsDownInAGroove)
{
  const double friction = 0.2, half_angle = degrees(40.0), sine = std::sin(half_angle);
  Scene scene;
  scene.types = 2;
  Rod rod;
  rod.omega.x = 200.0;
  const auto p = rod.properties();
  const double sink = p.mass * kGravity / (4.0 * sine * kStiffness);
  scene.rods = {rod};
  add_groove(scene, rod, half_angle, sink);
  scene.physics = linear_material(kStiffness, kStiffness, 0.3, friction, 2) +
                  contacts_and_fixed_rods(2) + gravity_on_slope(0.0);
  scene.box_lo[2] = -0.5;
  scene.dt = 5e-6;
  scene.steps = 24000;
  scene.dump_every = 2000;
  const std::vector<Frame> frames = run(scene, GetParam());
  const Frame &middle = frames[9], &end = frames.back();
  const double load = p.mass * kGravity / (sine * (1.0 + friction * friction));
  const double slowing = friction * rod.radius() * load / p.inertia_axial;
  // The arm of friction ends in the middle of the overlap, 10^-4 r short of the surface.
  expect_holds(
      {"Rod turning in a groove: deceleration, relative", "mu r m g/(sin(a) (1 + mu^2) I_a)", 2e-4},
      std::fabs((middle.rods[0].omega.x - end.rods[0].omega.x) / (end.time - middle.time) /
                    slowing -
                1.0));
  EXPECT_LT(std::fabs(end.rods[0].position.x), 1e-9);
}

// A groove of half angle a that goes down at a slope b acts as friction mu/sin(a): a rod slides
// with g (sin(b) - mu cos(b)/sin(a)). Grooves of fixed rods: two notches, four contacts that slide
// along the rod; and two parallel rails, where each rail has one contact, at whichever point the
// rule for parallel rods chooses.
TEST_P(SlidingContact, SlidesDownAGroove)
{
  const double slope = degrees(40.0), half_angle = degrees(40.0), friction = 0.2;
  const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
  const double expected = kGravity * (std::sin(slope) - friction * std::cos(slope) / sine);
  for (const std::string rails : {"notches", "spread_contact off", "spread_contact on"}) {
    Scene scene;
    scene.types = 2;
    scene.box_lo[2] = -0.5;
    Rod rod;
    // One of the two sides' load over the stiffness.
    const double sink = rod.mass() * kGravity * std::cos(slope) / (2.0 * sine * kStiffness);
    scene.rods = {rod};
    if (rails == "notches") {
      add_groove(scene, rod, half_angle, 0.5 * sink);
    } else {
      for (const double side : {-1.0, 1.0}) {
        Rod rail;
        rail.type = 2;
        rail.length = 0.4;
        rail.position = (sink - rod.diameter) * Vec3{0.0, -side * cosine, sine};
        scene.rods.push_back(rail);
      }
    }
    scene.physics = linear_material(kStiffness, kStiffness, 0.3, friction, 2) +
                    contacts_and_fixed_rods(2, rails == "notches" ? "" : " " + rails) +
                    gravity_on_slope(slope);
    scene.dt = 1e-5;
    scene.steps = 8000;
    scene.dump_every = 500;
    const std::vector<Frame> frames = run(scene, GetParam());
    const Frame &middle = frames[9], &end = frames.back();
    EXPECT_GT(end.rods[0].position.x, 0.01) << "the notches end at 0.02 m";
    const double gained = end.rods[0].velocity.x - middle.rods[0].velocity.x;
    // The rod pitches a little, as the load moves from one notch or end to the other.
    expect_holds({"Groove of fixed rods, across or parallel, sliding: acceleration, relative",
                  "g (sin(b) - mu cos(b)/sin(a))", 2e-4},
                 std::fabs(gained / (end.time - middle.time) / expected - 1.0));
  }
}

// The same between two planes at right angles (a = 45 degrees): one rod slides and one rests.
TEST_P(SlidingContact, SlidesDownACorner)
{
  const double slope = degrees(30.0), sine = std::sin(slope), cosine = std::cos(slope);
  const double half = std::sqrt(0.5);      // sin and cos of 45 degrees
  const double frictions[] = {0.3, 0.45};  // tan(30) sin(45) = 0.408 holds it
  Scene scene;
  scene.types = 3;
  scene.box_lo[1] = scene.box_lo[2] = -0.1;
  Rod rod;
  const double sink = rod.mass() * kGravity * cosine * half / (2.0 * kStiffness);
  rod.position = {-0.5, rod.radius() - sink, rod.radius() - sink};
  scene.rods = {rod, rod};
  scene.rods[1].type = 2;
  scene.rods[1].position.x = 0.3;
  const auto friction = [&](int i, int j) { return frictions[std::min({i, j, 2}) - 1]; };
  scene.physics = pair_property("kn", 3, kStiffness) + pair_property("kt", 3, kStiffness) +
                  pair_property("coefficientRestitution", 3, 0.3) +
                  pair_property("coefficientFriction", 3, friction) + rod_pair(kModels) +
                  rod_wall("floor", kModels, "type 3 zplane 0.0") +
                  rod_wall("side", kModels, "type 3 yplane 0.0") +
                  "fix motion all nve/spherocylinder\n" +
                  gravity({sine, -cosine * half, -cosine * half});
  scene.dt = 1e-5;
  scene.steps = 20000;
  scene.dump_every = 2500;
  const std::vector<Frame> frames = run(scene, GetParam());
  const Frame &middle = frames[5], &end = frames.back();
  const double expected = kGravity * (sine - frictions[0] * cosine / half);
  expect_holds({"Corner of two planes, sliding: acceleration, relative",
                "g (sin(b) - mu cos(b)/sin(a))", 1e-6},
               std::fabs((end.rods[0].velocity.x - middle.rods[0].velocity.x) /
                             (end.time - middle.time) / expected -
                         1.0));
  expect_holds({"Corner of two planes, resting: creep in 0.075 s (m)", "none", 1e-12},
               norm(end.rods[1].position - middle.rods[1].position));
}

// Pressed into a groove of half angle a and let go, without weight: the overlap pushes it out, with
// N = k (d0 - u sin(a)) after a way u, and the tangential springs T = kt u cos(a) hold it. They
// balance, N sin(a) = T cos(a), after u = k d0 sin(a)/(k sin(a)^2 + kt cos(a)^2) if mu >= tan(a);
// else it is driven out.
TEST_P(SlidingContact, WedgedRodLocksItself)
{
  const double half_angle = degrees(25.0), pressed = 2e-5, kt = 0.7 * kStiffness;
  const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
  const double times_threshold[] = {0.99, 0.999, 1.001, 1.01};
  Scene scene;
  scene.types = 5;
  scene.box_lo[2] = -0.5;
  for (int type = 1; type <= 4; type++) {
    Rod rod;
    rod.type = type;
    rod.position.y = -1.0 + 0.4 * type;
    scene.rods.push_back(rod);
  }
  for (int k = 0; k < 4; k++) add_groove(scene, Rod(scene.rods[k]), half_angle, pressed);
  const auto friction = [&](int i, int j) {
    return times_threshold[std::min({i, j, 4}) - 1] * sine / cosine;
  };
  // Without rebound (e = 0.06), so that the springs are not stretched beyond their balance.
  scene.physics = pair_property("kn", 5, kStiffness) + pair_property("kt", 5, kt) +
                  pair_property("coefficientRestitution", 5, 0.06) +
                  pair_property("coefficientFriction", 5, friction) + contacts_and_fixed_rods(5) +
                  eased_start(100.0, 5000);
  scene.dt = 1e-5;
  scene.steps = 40000;
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;

  double error = 0.0;
  const double expected =
      kStiffness * pressed * sine / (kStiffness * sine * sine + kt * cosine * cosine);
  for (int k = 0; k < 2; k++)
    EXPECT_GT(after[k].position.z, 2.0 * pressed) << "held at " << times_threshold[k];
  for (int k = 2; k < 4; k++) {
    EXPECT_LT(norm(after[k].velocity), 1e-9) << "driven out at " << times_threshold[k];
    error = std::max(error, std::fabs(after[k].position.z / expected - 1.0));
  }
  expect_holds({"Wedged rod, locked: way out of the groove, relative",
                "k d0 sin(a)/(k sin(a)^2 + kt cos(a)^2)", 1e-4},
               error);
  expect_holds({"Wedged rod: friction at which it locks, relative", "tan(a)", 2e-3},
               0.5 * (times_threshold[2] - times_threshold[1]));
}

// Across the inside of a turning drum, without gravity: a chord, carried round at W by its two
// ends. The centrifugal load m W^2 d moves the rod outwards by
//   m W^2 d/(2 (k cos(phi)^2 + kt sin(phi)^2)), sin(phi) = (h/2)/(R - r),
// against both springs of both ends. The tangential ones are stretched along the wall and must turn
// with it; without them it would be m W^2 d/(2 k cos(phi)^2), 1.3 times as much.
TEST_P(SlidingContact, RodAcrossATurningDrum)
{
  const double R = 0.1, rate = 20.0, turns = 3.0, pi = std::acos(-1.0), kt = 0.7 * kStiffness;
  Scene scene;
  Rod rod;
  const double half = rod.half_cylinder(), reach = R - rod.radius();
  const double chord = std::sqrt(reach * reach - half * half);
  rod.position.z = -chord;
  rod.velocity.x = -rate * chord;
  rod.omega.y = rate;
  scene.rods = {rod};
  // LIGGGHTS takes the wall's velocity at the distance R - r at which the end's centre is.
  scene.physics =
      linear_material(kStiffness, kt, 0.8, 1.0) + rod_pair(kModels) +
      rod_wall("drum", kModels,
               fmt::format("type 1 ycylinder {} 0.0 0.0 shear x {}", R, rate * R / reach)) +
      "fix motion all nve/spherocylinder\n";
  scene.dt = 5e-6;
  const long quarters = std::lround(4.0 * turns), every = std::lround(0.5 * pi / (rate * scene.dt));
  scene.steps = quarters * every;
  scene.dump_every = every;
  const std::vector<Frame> frames = run(scene, GetParam());

  const double load = rod.mass() * rate * rate * chord, sine = half / reach;
  const double expected = load / (2.0 * (kStiffness * (1.0 - sine * sine) + kt * sine * sine));
  double sink_error = 0.0, rate_error = 0.0;
  for (const Frame &frame : frames) {
    if (frame.step == 0) continue;
    const Rod &now = frame.rods[0];
    const double sink = std::hypot(now.position.x, now.position.z) - chord;
    sink_error = std::max(sink_error, std::fabs(sink / expected - 1.0));
    rate_error = std::max(rate_error, std::fabs(now.omega.y / rate - 1.0));
  }
  // The normal is half a step ahead of the velocities, so that the dashpots see W^2 (R - r) dt/2 of
  // approach.
  expect_holds({"Rod across a turning drum, 3 turns: sink, relative",
                "m W^2 d/(2 (k cos(phi)^2 + kt sin(phi)^2))", 4e-3},
               sink_error);
  // The end reaches further out by its sink, 3e-5 of R.
  expect_holds({"Rod across a turning drum: rate, relative", "that of the wall at R - r", 1e-4},
               rate_error);
}

// A rod B rolls itself over a fixed rod A while it slides along A: the common normal turns, and the
// contact moves along both rods. B is so heavy that the contact does not change its motion:
// its centre is at (V t, 0, c), its axis b = (0, cos(W t), sin(W t)). Then n = (0, -sin, cos) is
// the normal, c cos(W t) the distance and, without slipping, the tangential force -kt s_t with
//   s_t = V (t - t0) e_x + (c/2) (sin(W t) - sin(W t0)) b
// from the first touch at c cos(W t0) = 2 r: the surface of B at the contact, half the distance
// from its axis, moves at W c cos(W t)/2 along b, and the spring turns with n.
TEST(SlidingContactForce, TurnsWithTheNormal)
{
  const double c = 0.0105, rate = 1.0, slide = 2e-3;
  Scene scene;
  scene.types = 2;
  Rod fixed, rolling;
  fixed.type = 2;
  rolling.axis = {0.0, 1.0, 0.0};
  rolling.position = {0.0, 0.0, c};
  rolling.velocity.x = slide;
  rolling.omega.x = rate;
  rolling.density = 1e15;
  scene.rods = {rolling, fixed};
  scene.dt = 1e-5;
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.roll", preamble(scene) + "read_data rods.data\nneighbor 0.02 bin\n" +
                              linear_material(kStiffness, 0.7 * kStiffness, 1.0, 1e6, 2) +
                              contacts_and_fixed_rods(2) + "timestep 1e-5\n" +
                              exact_dump("dump.roll", 5000, "id fx fy fz") + "run 100000\n");
  const Outcome outcome = folder.run("in.roll");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;

  const double touch = std::acos(fixed.diameter / c);
  double error = 0.0;
  int touching = 0;
  for (const Snapshot &snapshot : read_dump(folder / "dump.roll")) {
    const double angle = rate * scene.dt * static_cast<double>(snapshot.step);
    if (angle < touch + 0.05) continue;
    touching++;
    const Table &f = snapshot.atoms;
    const Vec3 force = {f.at(0, "fx"), f.at(0, "fy"), f.at(0, "fz")};
    const Vec3 along = {0.0, std::cos(angle), std::sin(angle)};
    const Vec3 normal = {0.0, -std::sin(angle), std::cos(angle)};
    const Vec3 expected = kStiffness * (fixed.diameter - c * std::cos(angle)) * normal -
                          0.7 * kStiffness *
                              (slide * (angle - touch) / rate * Vec3{1.0, 0.0, 0.0} +
                               0.5 * c * (std::sin(angle) - std::sin(touch)) * along);
    error = std::max(error, norm(force - expected) / norm(expected));
  }
  EXPECT_GE(touching, 12);
  // Sums of steps: W dt over the angle turned.
  expect_holds({"Rod rolling over a rod, the normal turns by 40 degrees: force, relative",
                "the spring in the turning frame", 1e-4},
               error);
}

// Two crossed rods, so heavy that nothing stops them, turn together at W about the normal of their
// contact while one is drawn away along x at u. Their contact points part by u t along x, whatever W:
// the spring must turn with the pair, and the force on the drawn rod stays -kt u t along x.
TEST_P(SlidingContact, SpringTurnsWithThePair)
{
  const double W = 20.0, u = 1e-5, kt = 1e5;
  Scene scene;
  Rod lower, upper;
  lower.density = upper.density = 1e12;
  lower.omega = upper.omega = {0.0, 0.0, W};
  upper.axis = {0.0, 1.0, 0.0};
  upper.position.z = 0.999 * upper.diameter;
  upper.velocity.x = u;
  scene.rods = {lower, upper};
  scene.physics = linear_material(1e5, kt, 1.0, 1e6) +
                  "pair_style gran model linear tangential history surface spherocylinder "
                  "tangential_damping off\npair_coeff * *\nfix motion all nve/spherocylinder\n";
  scene.dt = 1e-5;
  scene.steps = 15000;  // 3 rad
  // The heavy rods' velocities are too slow to show the force: its impulse does, to be told by their
  // momenta, since the mass is known: sum of kt u t is kt u t^2/2.
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;
  const double t = scene.dt * static_cast<double>(scene.steps), impulse = 0.5 * kt * u * t * t;
  const Vec3 got = lower.mass() * (after[0].velocity - lower.velocity);
  expect_holds(
      {"Spring of a pair that turns about its normal: impulse, relative", "kt u t^2/2", 1e-3},
      norm(got - Vec3{impulse, 0.0, got.z}) / impulse);
}

DECKS_IN_ALL_MODES(SlidingContact);

}  // namespace
