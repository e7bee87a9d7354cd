// SPDX-License-Identifier: GPL-2.0-or-later
// Fibres that touch while they move: energy and momentum of rods that slide over joints, ranks and threads, a
// fibre drawn over a cylinder, one that is laid on a floor, a twisted ring that coils up.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "core/numbers.h"
#include "core/rotation.h"
#include "fibres.h"
#include "run_mode.h"

using namespace decks;
using spherocylinder::pi;

namespace {

struct Deck {
  std::vector<Frame> frames;
  Table thermo;
  Table last;  // of the dump's last frame
};

Deck run_deck(const Scene &scene, const std::string &thermo, const std::string &columns = "",
              int ranks = 1)
{
  Deck deck;
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  for (const auto &[name, text] : scene.files) folder.write(name, text);
  const long every = scene.dump_every ? scene.dump_every : scene.steps;
  folder.write("in.deck",
               preamble(scene, ranks == 1   ? Mode::OneRank
                               : ranks == 2 ? Mode::TwoRanks
                                            : Mode::FourRanks) +
                   fmt::format("read_data rods.data\nneighbor {} bin\n", scene.skin) +
                   scene.physics + fmt::format("timestep {:.17g}\n", scene.dt) +
                   "compute contacts all contact/spherocylinder\n" +
                   "compute turning all erotate/spherocylinder\n" +
                   fmt::format("thermo_style custom step {}\nthermo {}\n", thermo, every) +
                   "thermo_modify format float %.15g lost error\n" +
                   exact_dump("dump.deck", every, std::string(kFrameColumns) + columns) +
                   fmt::format("run {}\n", scene.steps));
  Launch launch;
  launch.ranks = ranks;
  launch.time_limit = scene.time_limit;
  const Outcome outcome = folder.run("in.deck", launch);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return deck;
  deck.frames = read_frames(folder / "dump.deck", scene);
  deck.thermo = read_thermo(outcome.output);
  deck.last = read_dump(folder / "dump.deck").back().atoms;
  return deck;
}

// Of segment k of n: inner ones have both ends shared.
spherocylinder::MassProperties properties_of(const Rod &rod, int k, int n)
{
  return spherocylinder::mass_properties(rod.diameter, rod.length, rod.density,
                                         (k > 0) + (k < n - 1));
}

// Fibres of four segments in rows, each hit near its middle joint by a rod that slides along it, at another place
// each. `count` of them; rods of a fibre first, then its rod.
constexpr int kSegments = 4;

Scene glancing_blows(int count, double dt_factor, const std::string &material,
                     const std::string &models)
{
  Fibre fibre;
  fibre.segments = kSegments;
  Scene scene = fibre_scene(fibre);
  scene.rods.clear();
  for (int n = 0; n < count; n++) {
    const double y = 0.05 * (n - 0.5 * (count - 1));
    std::vector<Rod> rods = straight_rods(fibre, {-0.03, y, 0.0}, {1.0, 0.0, 0.0});
    Rod rod;
    rod.diameter = 2.0 * fibre.radius;
    rod.length = 0.02;
    rod.density = fibre.density;
    const double angle = degrees(90.0 - 6.0 * (n % 10));
    rod.axis = {std::cos(angle), std::sin(angle), 0.0};
    rod.position = {-2.5e-3 + 4e-4 * (n % 16), y + 1e-3 * (n % 3), 2.0 * fibre.radius + 5e-5};
    rod.velocity = {1.0, 0.0, -0.1};
    rods.push_back(rod);
    scene.rods.insert(scene.rods.end(), rods.begin(), rods.end());
  }
  scene.box_lo[1] = -0.05 * count;
  scene.box_hi[1] = 0.05 * count;
  scene.physics =
      material + rod_pair(models) +
      "fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3 join 1e-6\n"
      "fix motion all nve/spherocylinder\n";
  scene.dt *= dt_factor;
  scene.steps = std::lround(6e-3 / scene.dt);
  return scene;
}

// Closed form: kinetic energy and that of the joints, before and after, when nothing touches.
TEST(FibreBlows, KeepTheirEnergy)
{
  double errors[2];
  for (const int finer : {0, 1}) {
    const Scene scene =
        glancing_blows(16, finer ? 0.125 : 0.25, linear_material(1e3, 1e3, 1.0, 0.0), "linear");
    const Deck deck = run_deck(scene, "ke c_turning f_joints");
    ASSERT_FALSE(deck.frames.empty());
    const Frame &end = deck.frames.back();
    double touching = 0.0;
    for (const double contacts : end.contacts) touching += contacts;
    EXPECT_EQ(touching, 0.0);
    const auto energy = [&](const std::vector<double> &row) { return row[1] + row[2] + row[3]; };
    const double before = energy(deck.thermo.rows.front()), after = energy(deck.thermo.rows.back());
    // Of what the blows are about: what the rods had across the fibres.
    const double across = before * 0.01 / 1.01;
    errors[finer] = std::fabs(after - before) / across;
    double moved = 0.0;
    for (size_t k = 0; k < end.rods.size(); k += kSegments + 1)
      moved = std::max(moved, norm(end.rods[k + 1].velocity));
    EXPECT_GT(moved, 0.01);
  }
  expect_holds({"Rods that slide over joints of free fibres, elastic: energy/that of the blow",
                "none lost or gained", 2e-3},
               errors[1]);
}

// With friction and damping: each fibre with its rod keeps its momentum and its angular momentum.
TEST(FibreBlows, KeepTheirMomentum)
{
  const Scene scene =
      glancing_blows(8, 0.25, linear_material(1e3, 1e3, 0.5, 0.3), "linear tangential history");
  std::vector<Frame> of_ranks[3];
  double linear = 0.0, angular = 0.0;
  for (const int n : {0, 1, 2}) {
    const Deck deck = run_deck(scene, "ke", "", 1 << n);
    ASSERT_FALSE(deck.frames.empty());
    of_ranks[n] = deck.frames;
    const auto totals = [&](const Frame &frame, size_t first) {
      std::pair<Vec3, Vec3> sums{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
      for (int k = 0; k <= kSegments; k++) {
        const Rod &rod = frame.rods[first + k];
        const auto p = k < kSegments ? properties_of(rod, k, kSegments) : rod.properties();
        sums.first = sums.first + p.mass * rod.velocity;
        const double along = dot(rod.omega, rod.axis);
        sums.second = sums.second +
                      p.mass * cross(rod.position - scene.rods[first].position, rod.velocity) +
                      p.inertia_transverse * (rod.omega - along * rod.axis) +
                      (p.inertia_axial * along) * rod.axis;
      }
      return sums;
    };
    for (size_t first = 0; first < scene.rods.size(); first += kSegments + 1) {
      const auto [p0, l0] = totals(deck.frames.front(), first);
      const auto [p1, l1] = totals(deck.frames.back(), first);
      linear = std::max(linear, norm(p1 - p0) / norm(p0));
      angular = std::max(angular, norm(l1 - l0) / (norm(p0) * 0.02));
    }
  }
  expect_holds(
      {"Rods that slide over joints, friction and damping, 1, 2, 4 ranks: momentum, relative",
       "kept", 1e-12},
      linear);
  expect_holds(
      {"Rods that slide over joints, friction and damping, 1, 2, 4 ranks: angular momentum, relative",
       "kept", 1e-10},
      angular);
  expect_holds(
      {"Rods that slide over joints, 2 and 4 ranks: places and axes (m)", "one rank", 1e-12},
      std::max(largest_difference(of_ranks[0], of_ranks[1]),
               largest_difference(of_ranks[0], of_ranks[2])));
}

// Histories that go along, and sums of forces, whatever threads do.
TEST(FibreBlows, SameBitsForThreads)
{
  std::vector<std::vector<Frame>> runs;
  for (const int threads : {1, 3}) {
    Scene scene = glancing_blows(
        150, 0.5, linear_material(1e3, 1e3, 0.5, 0.3),
        fmt::format("linear tangential history surface spherocylinder threads {}", threads));
    const size_t at = scene.physics.find(" surface spherocylinder", scene.physics.find("threads"));
    scene.physics.erase(at, std::string(" surface spherocylinder").size());
    scene.skin = 0.005;
    runs.push_back(run(scene));
  }
  double touched = 0.0;
  for (size_t k = kSegments; k < runs[0].back().rods.size(); k += kSegments + 1)
    touched += runs[0].back().rods[k].velocity.z > -0.09;
  EXPECT_GT(touched, 100.0);
  EXPECT_EQ(largest_difference(runs[0], runs[1]), 0.0);
}

// Joints of short segments, of which second neighbours overlap by geometry.
TEST(FibreBlows, SecondNeighboursDoNotPush)
{
  Fibre fibre;
  fibre.segments = 12;
  fibre.joint_distance = 1.2 * fibre.radius;
  Scene scene = fibre_scene(fibre);
  scene.steps = 100;
  const Deck deck = run_deck(scene, "ke c_turning f_joints");
  ASSERT_FALSE(deck.thermo.rows.empty());
  EXPECT_LT(deck.thermo.rows.back()[1] + deck.thermo.rows.back()[3], 1e-20);
}

// A fibre is drawn over half of a fixed cylinder: a weight at one end, the other drawn down steadily. Closed
// form of N segments that turn by a each: tension grows by (1 + mu tan(a/2))/(1 - mu tan(a/2)) at each, by
// e^(mu a) for many.
TEST(FibreCapstan, TensionGrowsWithTheAngle)
{
  const double R = 0.05, friction = 0.2, r = 0.001, h = 0.008;
  Fibre fibre;
  fibre.radius = r;
  fibre.joint_distance = h;
  const double reach = R + r;
  // Tangent to the circle of the axes: each segment turns by a.
  const double a = 2.0 * std::atan(0.5 * h / reach);
  const int on_arc = static_cast<int>(std::lround(pi / a)), tail = 6;
  fibre.segments = on_arc + 1 + 2 * tail;
  const double turn = pi / on_arc;
  std::vector<Rod> rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  const double circle = 0.5 * h / std::tan(0.5 * turn);
  for (int k = 0; k < fibre.segments; k++) {
    const int on = std::clamp(k - tail, 0, on_arc);
    const double angle = pi - on * turn;  // of where it touches
    const double beyond = k < tail            ? (k - tail) * h
                          : k > tail + on_arc ? (k - tail - on_arc) * h
                                              : 0.0;
    const Vec3 out = {std::cos(angle), std::sin(angle), 0.0},
               ahead = {std::sin(angle), -std::cos(angle), 0.0};
    rods[k].axis = ahead;
    rods[k].position = circle * out + beyond * ahead;
  }
  Scene scene = fibre_scene(fibre);
  scene.rods = rods;
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.2;
    scene.box_hi[d] = 0.2;
  }
  const double weight = 0.05, speed = 0.02;
  scene.skin = 2e-3;
  scene.physics =
      linear_material(1e4, 1e4, 0.5, friction) + rod_pair("linear tangential history") +
      "fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3 bend_factor 0.01 "
      "damping 0.1 join 0.1\n" +
      fmt::format("fix drum all wall/gran model linear tangential history surface spherocylinder "
                  "primitive type 1 zcylinder {} 0.0 0.0\n",
                  circle - r + 2e-6) +
      fmt::format("group drawn id {}\ngroup loose subtract all drawn\n", fibre.segments) +
      "group hung id 1\n" + fmt::format("fix load hung addforce 0.0 {} 0.0\n", -weight) +
      "fix motion loose nve/spherocylinder\n" +
      fmt::format("fix draw drawn move linear 0.0 {} 0.0\n", -speed) +
      "fix drag loose viscous 2e-4\n";
  scene.dt = 2e-5;
  scene.steps = 40000;
  scene.dump_every = 400;
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write(
      "in.capstan",
      preamble(scene) + "read_data rods.data\nneighbor 0.002 bin\n" + scene.physics +
          "timestep 2e-5\nvariable pull equal fy[" + std::to_string(fibre.segments) +
          "]\n"
          "thermo_style custom step v_pull f_joints\nthermo 400\nthermo_modify format float %.12g\n"
          "run 40000\n");
  const Outcome outcome = folder.run("in.capstan");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  double sum = 0.0;
  int n = 0;
  for (size_t k = thermo.rows.size() / 2; k < thermo.rows.size(); k++, n++)
    sum += thermo.rows[k][1];
  const double ratio = sum / n / weight, expected = std::exp(friction * pi);
  expect_holds(
      {"Fibre drawn over half a cylinder, r/R = 0.02: T2/T1, relative", "e^(mu phi)", 0.02},
      std::fabs(ratio / expected - 1.0));
  // About the cylinder's axis tension has the lever R + r, friction R.
  expect_holds({"Fibre drawn over half a cylinder, r/R = 0.02: T2/T1, relative to a thick fibre's",
                "e^(mu phi R/(R + r))", 5e-3},
               std::fabs(ratio / std::exp(friction * pi * (circle - r) / circle) - 1.0));
}

// Askew by 10 degrees, one end first, with a floor that gives back half: it comes to rest, and its energy, of
// motion, joints and height, never grows.
TEST(FibreOnFloor, LaidAskewComesToRest)
{
  Fibre fibre;
  fibre.segments = 8;
  Scene scene = fibre_scene(fibre);
  const double tilt = degrees(10.0), gravity = 9.81;
  const Vec3 axis = {std::cos(tilt), 0.0, std::sin(tilt)};
  scene.rods = straight_rods(
      fibre, {-0.07, 0.0, fibre.radius + 0.5 * fibre.joint_distance * std::sin(tilt) + 1e-5}, axis);
  scene.physics =
      linear_material(1e3, 1e3, 0.5, 0.3) + rod_pair("linear tangential history") +
      rod_wall("floor", "linear tangential history", "type 1 zplane 0.0") +
      "fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3 damping 0.05 join 1e-6\n"
      "fix motion all nve/spherocylinder\n"
      "fix weight all gravity 9.81 vector 0.0 0.0 -1.0\n";
  scene.steps = std::lround(1.5 / scene.dt);
  scene.dump_every = scene.steps / 300;
  const Deck deck = run_deck(scene, "ke c_turning f_joints");
  ASSERT_FALSE(deck.frames.empty());
  double least = 0.0, gain = 0.0, first = 0.0;
  const size_t frames = std::min(deck.frames.size(), deck.thermo.rows.size());
  for (size_t n = 0; n < frames; n++) {
    const std::vector<double> &row = deck.thermo.rows[n];
    double energy = row[1] + row[2] + row[3];
    for (int k = 0; k < fibre.segments; k++)
      energy += properties_of(deck.frames[n].rods[k], k, fibre.segments).mass * gravity *
                (deck.frames[n].rods[k].position.z - fibre.radius);
    if (n == 0) first = least = energy;
    gain = std::max(gain, energy - least);
    least = std::min(least, energy);
  }
  double mass = 0.0;
  for (int k = 0; k < fibre.segments; k++)
    mass += properties_of(scene.rods[k], k, fibre.segments).mass;
  const double kinetic = deck.thermo.rows.back()[1] + deck.thermo.rows.back()[2];
  expect_holds(
      {"Fibre laid askew on a floor: kinetic energy after 1.5 s/energy of its fall", "rest", 1e-12},
      kinetic / first);
  expect_holds({"Fibre laid askew on a floor: gain of energy/energy of its fall",
                "none, but what contacts give back", 0.02},
               gain / first);
  // Nine points bear it: closed form for a straight fibre would be m g/9k at each.
  double deepest = 0.0;
  for (const Rod &rod : deck.frames.back().rods)
    deepest = std::max(deepest, (fibre.radius - rod.position.z) / (mass * gravity / 9.0 / 1e3));
}

// Twist over 2 pi, from the joints, and writhe of a closed chain: Gauss's integral over pairs of straight pieces,
// exact (Klenin & Langowski, Biopolymers 54, 307 (2000)).
double twist_of(const Table &rods)
{
  double sum = 0.0;
  const size_t n = rods.rows.size();
  const auto orientation = [&](size_t k) {
    return spherocylinder::Quaternion{rods.at(k, "quat1"), rods.at(k, "quat2"), rods.at(k, "quat3"),
                                      rods.at(k, "quat4")};
  };
  for (size_t k = 0; k < n; k++) {
    const auto q = orientation(k);
    const auto relative =
        spherocylinder::Quaternion{q.w, -q.x, -q.y, -q.z} * orientation((k + 1) % n);
    double angle = 2.0 * std::atan2(relative.z, relative.w);
    if (angle > pi) angle -= 2.0 * pi;
    if (angle < -pi) angle += 2.0 * pi;
    sum += angle;
  }
  return sum / (2.0 * pi);
}

double writhe_of(const std::vector<Vec3> &corners)
{
  const size_t n = corners.size();
  double sum = 0.0;
  for (size_t a = 0; a < n; a++)
    for (size_t b = a + 2; b < n; b++) {
      if (a == 0 && b == n - 1) continue;
      const Vec3 &p1 = corners[a], &p2 = corners[(a + 1) % n], &p3 = corners[b],
                 &p4 = corners[(b + 1) % n];
      const Vec3 r13 = p3 - p1, r14 = p4 - p1, r23 = p3 - p2, r24 = p4 - p2;
      const Vec3 n1 = cross(r13, r14), n2 = cross(r14, r24), n3 = cross(r24, r23),
                 n4 = cross(r23, r13);
      if (norm(n1) * norm(n2) * norm(n3) * norm(n4) == 0.0) continue;
      const auto angle = [](const Vec3 &u, const Vec3 &v) {
        return std::asin(std::clamp(dot(u, v) / (norm(u) * norm(v)), -1.0, 1.0));
      };
      const double area = angle(n1, n2) + angle(n2, n3) + angle(n3, n4) + angle(n4, n1);
      const double sign = dot(cross(p4 - p3, p2 - p1), r13) > 0.0 ? 1.0 : -1.0;
      sum += sign * area / (4.0 * pi);
    }
  return 2.0 * sum;
}

// A flat ring that would be twisted by four turns without load coils up, its segments press on each other, and
// none goes through another.
TEST(FibreRingContacts, KeepsItsLinkingNumber)
{
  Fibre fibre;
  fibre.segments = 48;
  fibre.joint_distance = 0.01;
  const int n = fibre.segments;
  Scene scene = fibre_scene(fibre);
  scene.rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  const double turn = 2.0 * pi / n, inner = 0.5 * fibre.joint_distance / std::tan(0.5 * turn);
  for (int k = 0; k < n; k++) {
    const double angle = k * turn;
    scene.rods[k].axis = {-std::sin(angle), std::cos(angle), 0.0};
    // A little out of its plane, or it would stay flat.
    scene.rods[k].position = inner * Vec3{std::cos(angle), std::sin(angle), 0.0};
    scene.rods[k].velocity = {0.0, 0.0, 0.02 * std::sin(2.0 * angle)};
  }
  const double turns = 4.0;
  scene.physics =
      linear_material(1e3, 1e3, 0.3, 0.2) + rod_pair("linear tangential history") +
      fmt::format("fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3 "
                  "stretch_factor 0.5 damping 0.1 rest_twist {:.17g} join 1e-3\n",
                  turns * 2.0 * pi / (n * fibre.joint_distance)) +
      "fix motion all nve/spherocylinder\nfix drag all viscous 5e-4\n";
  scene.dt = 0.5 * scene.dt;
  scene.steps = 60000;
  scene.dump_every = 2000;
  const DeckFolder folder;
  const Deck deck =
      run_deck(scene, "ke f_joints f_joints[3] f_joints[4]", " quat1 quat2 quat3 quat4");
  ASSERT_FALSE(deck.frames.empty());
  std::vector<Vec3> corners;
  const std::vector<Rod> &rods = deck.frames.back().rods;
  double touching = 0.0;
  for (int k = 0; k < n; k++) {
    const Rod &next = rods[(k + 1) % n];
    corners.push_back(0.5 * (rods[k].position + rods[k].half_cylinder() * rods[k].axis +
                             next.position - next.half_cylinder() * next.axis));
    touching += deck.frames.back().contacts[k];
  }
  const double twist = twist_of(deck.last), writhe = writhe_of(corners);
  EXPECT_GT(std::fabs(writhe), 0.8);
  EXPECT_GT(touching, 4.0);
  expect_holds({"Ring that coils up by its twist, in contact with itself: Tw + Wr",
                "Lk = 0, joints' shear left out", 0.02},
               std::fabs(twist + writhe));
}

}  // namespace
