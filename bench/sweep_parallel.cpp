// SPDX-License-Identifier: GPL-2.0-or-later
// What the two rules for the contact of nearly parallel rods do (docs/notes/parallel_rods.md): the
// plain closest point and spread_contact. Each scene is run with both; one CSV line a figure.
#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "convergence.h"
#include "core/spread_contact.h"
#include "results_file.h"
#include "scene.h"

using namespace decks;
namespace sc = spherocylinder;

namespace {

constexpr double kGravity = 9.81;
constexpr double kStiffness = 1e5;

// Error of the kinetic energy after 400 meetings, relative to that of the pair.
struct MeetingErrors {
  int parted = 0;
  double mean = 0.0, rms = 0.0, worst = 0.0;
};

void put(bool spread, const std::string &scene, const std::string &figure, double value)
{
  static ResultsFile table("parallel_rods.csv", "spread_contact,scene,figure,value");
  table.row("{},{},{},{:.3e}", spread ? "on" : "off", scene, figure, value);
  fmt::print("spread_contact {}: {}: {} {:.3e}\n", spread ? "on" : "off", scene, figure, value);
  std::fflush(stdout);
}

std::string pair_line(const std::string &models, bool spread)
{
  return fmt::format("pair_style gran model {} surface spherocylinder spread_contact {}\n"
                     "pair_coeff * *\n",
                     models, spread ? "on" : "off");
}

const char *const kWeight = "fix weight all gravity 9.81 vector 0 0 -1\n";

// Two rods, one above the other, meet side by side at `speed`, tilted by up to 10^(tilts - 6) (uniform
// in the logarithm) and shifted along each other: 400 meetings at once. No friction, no damping:
// the relative error of the kinetic energy after they have parted.
MeetingErrors elastic_meetings(bool spread, double aspect_ratio, double tilts, double speed,
                               int steps_a_contact)
{
  std::mt19937 random(12345);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Scene scene;
  scene.skin = 0.005;
  for (int k = 0; k < 400; k++) {
    Rod lower, upper;
    lower.length = upper.length = aspect_ratio * upper.diameter;
    lower.position = {-0.9 + 0.19 * (k % 10), -0.95 + 0.19 * (k / 10 % 10), -0.9 + 0.5 * (k / 100)};
    const double tilt = std::pow(10.0, -6.0 + tilts * unit(random));
    const double turn = std::pow(10.0, -6.0 + 5.0 * unit(random));
    upper.axis = normalized({1.0, turn, tilt});
    upper.position =
        lower.position + Vec3{0.6 * upper.length * (unit(random) - 0.5), 0.0,
                              upper.diameter + upper.half_cylinder() * tilt + 1e-4 * speed};
    lower.velocity.z = 0.5 * speed;
    upper.velocity.z = -0.5 * speed;
    scene.rods.push_back(lower);
    scene.rods.push_back(upper);
  }
  scene.physics = linear_material(kStiffness, kStiffness, 1.0, 0.0) +
                  pair_line("linear tangential off", spread) +
                  "fix motion all nve/spherocylinder\n";
  // End on end: m_eff = m/8.
  scene.dt =
      3.14159265358979 * std::sqrt(scene.rods[0].mass() / 8.0 / kStiffness) / steps_a_contact;
  scene.steps = 80 * steps_a_contact;
  const Frame end = run(scene).back();
  const std::vector<Rod> &after = end.rods;
  MeetingErrors errors;
  double squares = 0.0, sum = 0.0;
  for (size_t k = 0; k < after.size(); k += 2) {
    if (end.contacts[k] > 0.0) continue;  // energy still in the spring
    errors.parted++;
    const double before = scene.rods[k].kinetic_energy() + scene.rods[k + 1].kinetic_energy();
    const double error = (after[k].kinetic_energy() + after[k + 1].kinetic_energy()) / before - 1.0;
    sum += error;
    squares += error * error;
    errors.worst = std::max(errors.worst, std::fabs(error));
  }
  errors.mean = sum / errors.parted;
  errors.rms = std::sqrt(squares / errors.parted);
  return errors;
}

void elastic_meetings(bool spread, double tilts, double speed)
{
  for (const int steps : {25, 50, 100, 200, 400}) {
    const MeetingErrors errors = elastic_meetings(spread, 10.0, tilts, speed, steps);
    const std::string name = fmt::format(
        "elastic meetings at {} m/s; tilt to 1e{}; {} steps a contact", speed, tilts - 6.0, steps);
    put(spread, name, "pairs that have parted", errors.parted);
    put(spread, name, "mean relative energy error", errors.mean);
    put(spread, name, "rms relative energy error", errors.rms);
    put(spread, name, "worst relative energy error", errors.worst);
  }
}

// Five rods lie on each other between two smooth walls one diameter apart, or, elastic, are let go
// half a diameter above each other.
Scene stack(bool spread, double restitution, double friction, double gap)
{
  Scene scene;
  scene.box_lo[2] = -0.1;
  scene.types = 2;  // walls: type 2, smooth
  std::mt19937 random(4321);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  for (int k = 0; k < 5; k++) {
    Rod rod;
    rod.position = {0.02 * unit(random), 0.0, rod.radius() + k * (rod.diameter + gap) + gap};
    rod.axis = normalized({1.0, 0.0, 1e-3 * unit(random)});
    scene.rods.push_back(rod);
  }
  const auto rubs = [&](int i, int j) { return i == 1 && j == 1 ? friction : 0.0; };
  const std::string models = friction > 0.0 ? "linear tangential history" : "linear tangential off";
  scene.physics = pair_property("kn", 2, kStiffness) + pair_property("kt", 2, kStiffness) +
                  pair_property("coefficientRestitution", 2, restitution) +
                  pair_property("coefficientFriction", 2, rubs) + pair_line(models, spread) +
                  rod_wall("floor", models, "type 1 zplane 0.0") +
                  rod_wall("left", models, "type 2 yplane -0.005") +
                  rod_wall("right", models, "type 2 yplane 0.005") +
                  rod_wall("back", models, "type 2 xplane -0.1") +
                  rod_wall("front", models, "type 2 xplane 0.1") +
                  "fix motion all nve/spherocylinder\n" + kWeight;
  scene.dt = 1e-5;
  return scene;
}

// Kinetic and potential energy; that of the springs is not in it.
double height_energy(const std::vector<Rod> &rods)
{
  double energy = kinetic_energy(rods);
  for (const Rod &rod : rods) energy += rod.mass() * kGravity * rod.position.z;
  return energy;
}

void stack_at_rest(bool spread)
{
  Scene scene = stack(spread, 0.5, 0.2, 0.0);
  scene.steps = 200000;
  scene.dump_every = 100;
  const std::vector<Frame> frames = run(scene);
  double kinetic = 0.0, slope = 0.0, sink = 0.0;
  size_t n = 0;
  for (size_t k = frames.size() / 2; k < frames.size(); k++, n++) {
    kinetic += kinetic_energy(frames[k].rods);
    for (const Rod &rod : frames[k].rods) slope = std::max(slope, std::fabs(rod.axis.z));
    // The top rod: m g / k for each of the contacts below it and what they carry.
    const std::vector<Rod> &rods = frames[k].rods;
    const double weight = rods[0].mass() * kGravity;
    const double rest = 4.5 * 2.0 * rods[0].radius() - weight / kStiffness * (1 + 2 + 3 + 4 + 2.5);
    sink = std::max(sink, std::fabs(rods[4].position.z - rest));
  }
  put(spread, "stack of 5 at rest; second second", "mean kinetic energy (J)", kinetic / n);
  put(spread, "stack of 5 at rest; second second", "largest slope of an axis", slope);
  put(spread, "stack of 5 at rest; second second", "largest error of the top height (m)", sink);
}

bool touches_floor(const Rod &rod)
{
  return rod.position.z - rod.half_cylinder() * std::fabs(rod.axis.z) < rod.radius();
}

// Kinetic and potential energy in frames in which nothing touches; the stack jumps about for 2 s.
void elastic_stack(bool spread)
{
  for (const double dt : {8e-6, 4e-6, 2e-6, 1e-6}) {
    Scene scene = stack(spread, 1.0, 0.0, 5e-3);
    scene.dt = dt;
    scene.steps = std::lround(2.0 / dt);
    scene.dump_every = scene.steps / 1000;
    const std::vector<Frame> frames = run(scene);
    double floor_level = 0.0;  // energy of the stack at rest
    for (int k = 0; k < 5; k++)
      floor_level += frames[0].rods[k].mass() * kGravity * (2 * k + 1) * 0.005;
    const double start = height_energy(frames[0].rods) - floor_level;
    std::vector<double> drift;  // while nothing touches, in the last fifth
    for (size_t f = frames.size() * 4 / 5; f < frames.size(); f++) {
      bool free = true;
      for (size_t k = 0; k < frames[f].rods.size(); k++)
        free = free && frames[f].contacts[k] == 0.0 && !touches_floor(frames[f].rods[k]);
      if (free) drift.push_back((height_energy(frames[f].rods) - floor_level) / start - 1.0);
    }
    std::sort(drift.begin(), drift.end());
    put(spread, fmt::format("elastic stack of 5; 2 s at dt {:.0e} s", dt),
        "relative drift of energy (median of the last 0.4 s)", drift.at(drift.size() / 2));
  }
}

// A rod in the groove of two fixed ones, parallel to them and shifted along them: m g/(2 cos(phi))
// on each, at rest.
void rod_on_two(bool spread, double shift)
{
  Scene scene;
  Rod left, right, rod;
  left.axis = right.axis = rod.axis = {1.0, 0.0, 0.0};
  left.position = {0.0, -0.006, 0.0};
  right.position = {0.0, 0.006, 0.0};
  rod.position = {shift, 0.0, 0.008};
  scene.rods = {rod, left, right};
  scene.physics = linear_material(kStiffness, kStiffness, 0.5, 0.2) +
                  pair_line("linear tangential history", spread) +
                  "group supports id 2 3\ngroup free id 1\n"
                  "fix hold supports freeze\nfix motion free nve/spherocylinder\n" +
                  std::string(kWeight);
  scene.dt = 1e-5;
  scene.steps = 200000;
  scene.dump_every = 100;
  const std::vector<Frame> frames = run(scene);
  double kinetic = 0.0, slope = 0.0, travel = 0.0;
  size_t n = 0;
  for (size_t k = frames.size() / 2; k < frames.size(); k++, n++) {
    const Rod &now = frames[k].rods[0];
    kinetic += now.kinetic_energy();
    slope = std::max(slope, std::fabs(now.axis.z));
    travel = std::max(travel, norm(now.position - frames[frames.size() / 2].rods[0].position));
  }
  const std::string name = fmt::format("rod on two; shifted {} m; second second", shift);
  put(spread, name, "mean kinetic energy (J)", kinetic / n);
  put(spread, name, "largest slope of the axis", slope);
  put(spread, name, "travel (m)", travel);
}

// The same groove tilted along its axis: the rod slides at g (sin(b) - mu cos(b)/cos(phi)).
void sliding_in_groove(bool spread)
{
  const double slope = degrees(30.0), friction = 0.2;
  Scene scene;
  Rod left, right, rod;
  left.length = right.length = 1.0;
  left.axis = right.axis = rod.axis = {1.0, 0.0, 0.0};
  left.position = {0.0, -0.006, 0.0};
  right.position = {0.0, 0.006, 0.0};
  rod.position = {-0.4, 0.0, 0.008};
  scene.rods = {rod, left, right};
  scene.box_lo[0] = -1.5;
  scene.box_hi[0] = 1.5;
  scene.physics = linear_material(kStiffness, kStiffness, 0.5, friction) +
                  pair_line("linear tangential history", spread) +
                  "group supports id 2 3\ngroup free id 1\n"
                  "fix hold supports freeze\nfix motion free nve/spherocylinder\n" +
                  fmt::format("fix weight all gravity 9.81 vector {} 0 {}\n", std::sin(slope),
                              -std::cos(slope));
  scene.dt = 1e-5;
  scene.steps = 40000;
  scene.dump_every = 100;
  const std::vector<Frame> frames = run(scene);
  const Rod &half = frames[frames.size() / 2].rods[0], &end = frames.back().rods[0];
  const double measured = (end.velocity.x - half.velocity.x) / 0.2;
  const double cos_phi = 0.8;
  const double expected = kGravity * (std::sin(slope) - friction * std::cos(slope) / cos_phi);
  put(spread, "rod slides in a groove", "relative error of its acceleration",
      std::fabs(measured / expected - 1.0));
  double pitch = 0.0;
  for (size_t k = frames.size() / 2; k < frames.size(); k++)
    pitch = std::max(pitch, std::fabs(frames[k].rods[0].omega.y));
  put(spread, "rod slides in a groove", "largest rate of pitching (rad/s)", pitch);
}

// Torque about its centre of a rod that lies on another, m tilted through zero in steps of 10^-6:
// the largest change from one pose to the next over the largest torque.
void torque_jump(bool spread)
{
  const double diameter = 0.01, half = 0.045, overlap = 1e-4;
  double jump = 0.0, largest = 0.0;
  sc::Vec3 last{0.0, 0.0, 0.0};
  for (int k = -5000; k <= 5000; k++) {
    const double tilt = 1e-6 * k;
    const sc::Segment i{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, half};
    const sc::Segment j{{0.01, 0.0, diameter - overlap},
                        {std::cos(tilt), 0.0, std::sin(tilt)},
                        half};
    const sc::ClosestPoints closest = sc::closest_points(i, j);
    sc::RodContact contact{closest, diameter - std::sqrt(closest.distance_squared)};
    if (spread) contact = sc::spread_contact(i, j, diameter, closest);
    const sc::ClosestPoints &c = contact.points;
    const sc::Vec3 force = (contact.overlap / sc::norm(c.delta)) * c.delta + contact.sideways;
    const sc::Vec3 torque = kStiffness * (sc::cross(c.s * i.axis, force) + contact.couple_i);
    if (k > -5000) jump = std::max(jump, sc::norm(torque - last));
    largest = std::max(largest, sc::norm(torque));
    last = torque;
  }
  put(spread, "tilt through zero in steps of 1e-6", "largest jump of torque / largest torque",
      jump / largest);
}

}  // namespace

// Rods of any length, tilted by up to 0.3: rms errors of the second order in the time step, and below
// those of the closest point.
TEST(SweepParallel, MeetingsOfShortRods)
{
  ResultsFile table(
      "parallel_short_rods.csv",
      "aspect_ratio,spread_contact,steps_per_contact,meetings,mean_relative_energy_error,"
      "rms_relative_energy_error,worst_relative_energy_error");
  for (const double aspect_ratio : {1.5, 2.0, 3.0, 5.0, 10.0}) {
    double finest[2] = {0.0, 0.0};
    for (const bool spread : {false, true}) {
      std::vector<double> dt, rms;
      for (const int steps : {25, 50, 100, 200}) {
        const MeetingErrors errors = elastic_meetings(spread, aspect_ratio, 5.5, 1.0, steps);
        table.row("{},{},{},{},{:.3e},{:.3e},{:.3e}", aspect_ratio, spread ? "on" : "off", steps,
                  errors.parted, errors.mean, errors.rms, errors.worst);
        fmt::print(
            "lambda {}, spread_contact {}, {} steps: mean {:.1e}, rms {:.1e}, worst {:.1e}\n",
            aspect_ratio, spread ? "on" : "off", steps, errors.mean, errors.rms, errors.worst);
        std::fflush(stdout);
        dt.push_back(1.0 / steps);
        rms.push_back(errors.rms);
        finest[spread] = errors.rms;
      }
      if (spread) {
        EXPECT_GT(order_of_convergence(dt, rms), 1.7) << "aspect ratio " << aspect_ratio;
      }
    }
    EXPECT_LT(finest[1], finest[0]) << "aspect ratio " << aspect_ratio;
  }
}

TEST(SweepParallel, BothRules)
{
  for (const bool spread : {false, true}) {
    torque_jump(spread);
    elastic_meetings(spread, 4.0, 0.1);
    for (const double speed : {0.1, 1.0, 3.0}) elastic_meetings(spread, 5.0, speed);
    stack_at_rest(spread);
    rod_on_two(spread, 0.0);
    rod_on_two(spread, 0.03);
    sliding_in_groove(spread);
    elastic_stack(spread);
  }
}
