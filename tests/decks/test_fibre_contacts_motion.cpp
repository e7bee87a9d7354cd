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
    rod.position = {(getenv("OFF") ? atof(getenv("OFF")) : 0.0) - 2.5e-3 + 4e-4 * n,
                    y + 1e-3 * (n % 3), 2.0 * fibre.radius + 5e-5};
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
  fmt::print("coarse {} fine {}\n", errors[0], errors[1]);
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
  for (size_t k = 0; k < thermo.rows.size(); k += 5)
    fmt::print("{} {} {}\n", thermo.rows[k][0], thermo.rows[k][1] / weight, thermo.rows[k][2]);
  const double ratio = sum / n / weight, expected = std::exp(friction * pi);
  expect_holds({"Fibre drawn over half a cylinder: T2/T1, relative", "e^(mu phi)", 0.03},
               std::fabs(ratio / expected - 1.0));
}

}  // namespace
