// SPDX-License-Identifier: GPL-2.0-or-later
// Friction of rods on planes: inclines, a sliding rod that comes to roll, a ladder.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "claim.h"
#include "mesh_files.h"
#include "run_mode.h"

using namespace decks;

namespace {

class Friction : public RunMode {};

constexpr double kGravity = 9.81;
constexpr double kStiffness = 1e5;

// On a floor at z = 0, sunk in by what its weight needs: two contacts carry m g cos(slope) / 2
// each.
Rod lying_rod(const Vec3 &axis, double slope = 0.0)
{
  Rod rod;
  rod.axis = axis;
  rod.position.z = rod.radius() - rod.mass() * kGravity * std::cos(slope) / (2.0 * kStiffness);
  return rod;
}

std::string gravity_on_slope(double slope)
{
  return fmt::format("fix weight all gravity {} vector {} 0 {}\n", kGravity, std::sin(slope),
                     -std::cos(slope));
}

std::string floor_and_motion()
{
  return rod_pair("linear tangential history") +
         rod_wall("floor", "linear tangential history", "type 1 zplane 0.0") +
         "fix motion all nve/spherocylinder\n";
}

// Slope alpha down along +x, atom types with their own friction against the floor (type 1).
//   axis across, kappa = I_a/(m r^2): rolls if mu >= tan(alpha) kappa/(1+kappa), with
//   g sin(alpha)/(1+kappa), else g (sin(alpha) - mu cos(alpha))
//   axis along the slope: rests if tan(alpha) <= mu, else g (sin(alpha) - mu cos(alpha))
TEST_P(Friction, Incline)
{
  const double slope = degrees(20.0), sine = std::sin(slope), cosine = std::cos(slope);
  const double frictions[] = {0.5, 0.05, 0.5, 0.2};
  Scene scene;
  scene.types = 4;
  scene.box_lo[2] = -0.1;
  for (int type = 1; type <= 4; type++) {
    Rod rod = lying_rod(type <= 2 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0}, slope);
    rod.type = type;
    rod.position.x = -0.4;
    rod.position.y = -0.6 + 0.3 * type;
    scene.rods.push_back(rod);
  }
  scene.physics = pair_property("kn", 4, kStiffness) + pair_property("kt", 4, kStiffness) +
                  pair_property("coefficientRestitution", 4, 0.3) +
                  pair_property("coefficientFriction", 4,
                                [&](int i, int j) { return frictions[std::max(i, j) - 1]; }) +
                  floor_and_motion() + gravity_on_slope(slope);
  scene.dt = 1e-5;
  scene.steps = 40000;
  scene.dump_every = 5000;
  const std::vector<Frame> frames = run(scene, GetParam());
  const Frame &middle = frames[5], &end = frames.back();

  const auto p = scene.rods[0].properties();
  const double kappa = p.inertia_axial / (p.mass * std::pow(scene.rods[0].radius(), 2));
  // Not from the start, where the tangential springs are loaded from zero, nor from the restart
  // half way: see SlidingRodComesToRoll.
  const auto error = [&](size_t i, double expected) {
    const double gained = end.rods[i].velocity.x - middle.rods[i].velocity.x;
    return std::fabs(gained / (end.time - middle.time) / expected - 1.0);
  };
  // A rod that has sunk in by 10^-4 r rolls on a shorter radius.
  expect_holds({"Incline, axis across, rolls: acceleration, relative", "g sin(a)/(1+kappa)", 2e-4},
               error(0, kGravity * sine / (1.0 + kappa)));
  const Rod &rolling = end.rods[0];
  expect_holds({"Incline, rolls: slip/speed", "v = omega r", 2e-4},
               std::fabs(rolling.omega.y * rolling.radius() / rolling.velocity.x - 1.0));
  expect_holds(
      {"Incline, axis across, slides: acceleration, relative", "g (sin(a) - mu cos(a))", 1e-6},
      error(1, kGravity * (sine - frictions[1] * cosine)));
  // The spring's first oscillation dies out in milliseconds; a creep would go on.
  expect_holds({"Incline, axis along, rests: creep in 0.15 s (m)", "none", 1e-12},
               norm(end.rods[2].position - middle.rods[2].position));
  expect_holds(
      {"Incline, axis along, slides: acceleration, relative", "g (sin(a) - mu cos(a))", 1e-6},
      error(3, kGravity * (sine - frictions[3] * cosine)));
}

// Thrown along a floor without spin: slows down at mu g while the slip v - omega r falls at
// mu g (1 + 1/kappa); rolls from then on at (v + kappa omega r)/(1 + kappa), v0/(1 + kappa) if it
// had no spin.
TEST_P(Friction, SlidingRodComesToRoll)
{
  const double friction = 0.2, slowing = friction * kGravity;
  Scene scene;
  scene.box_lo[2] = -0.1;
  Rod rod = lying_rod({0.0, 1.0, 0.0});
  rod.velocity.x = 0.5;
  rod.position.x = -0.1;
  scene.rods = {rod};
  scene.physics = linear_material(kStiffness, kStiffness, 0.3, friction) + floor_and_motion() +
                  gravity_on_slope(0.0);
  scene.dt = 1e-5;
  scene.steps = 20000;
  scene.dump_every = 10;
  const std::vector<Frame> frames = run(scene, GetParam());

  const auto p = rod.properties();
  const double r = rod.radius(), kappa = p.inertia_axial / (p.mass * r * r);
  const Frame &start = frames[0];
  const double v0 = start.rods[0].velocity.x, spin0 = start.rods[0].omega.y * r;
  const double rolling_from = start.time + (v0 - spin0) / (slowing * (1.0 + 1.0 / kappa));

  double sliding_error = 0.0, first_rolling = 0.0;
  for (const Frame &frame : frames) {
    const Rod &now = frame.rods[0];
    if (frame.step > 0 && frame.time < 0.95 * rolling_from)
      sliding_error =
          std::max(sliding_error,
                   std::fabs(now.velocity.x - (v0 - slowing * (frame.time - start.time))) / v0);
    const double slip = now.velocity.x - now.omega.y * r;
    if (slip < 1e-3 * v0 && first_rolling == 0.0) first_rolling = frame.time;
  }
  expect_holds({"Sliding rod: speed while sliding, / v0", "v0 - mu g t", 1e-12}, sliding_error);
  // Known to the spacing of the dumps and the threshold of 10^-3 v0.
  expect_holds({"Sliding rod: time at which it rolls, relative", "v0/(mu g (1+1/kappa))", 3e-3},
               std::fabs(first_rolling / rolling_from - 1.0));
  // The rod has sunk in by 10^-4 r.
  expect_holds(
      {"Sliding rod comes to roll: speed, relative", "v0/(1+kappa)", 1e-4},
      std::fabs(frames.back().rods[0].velocity.x * (1.0 + kappa) / (v0 + kappa * spin0) - 1.0));
}

namespace {

const std::string kPlanes = rod_wall("floor", "linear tangential history", "type 5 zplane 0.0") +
                            rod_wall("side", "linear tangential history", "type 6 xplane 0.0");

// A ladder in the xz plane: foot on the floor, head against a smooth wall at x = 0.
// N_wall = m g h cos(theta) / (2 (h sin(theta) + r)); it stands if N_wall <= mu m g.
// Rods of type 1 to 4, floor type 5, wall type 6.
void expect_ladder_at_its_threshold(Scene scene, const std::string &walls, Mode mode)
{
  const double theta = degrees(60.0);
  Rod ladder;
  ladder.axis = {std::cos(theta), 0.0, std::sin(theta)};
  const double h = 2.0 * ladder.half_cylinder(), r = ladder.radius();
  const double threshold = h * std::cos(theta) / (2.0 * (h * std::sin(theta) + r));
  const double weight = ladder.mass() * kGravity;
  const double times_threshold[] = {0.98, 0.998, 1.002, 1.02};

  scene.types = 6;
  scene.box_lo[2] = -0.1;
  for (int type = 1; type <= 4; type++) {
    Rod rod = ladder;
    rod.type = type;
    rod.position = {-r - 0.5 * h * std::cos(theta) + threshold * weight / kStiffness,
                    -0.6 + 0.25 * type, r + 0.5 * h * std::sin(theta) - weight / kStiffness};
    scene.rods.push_back(rod);
  }
  const auto friction = [&](int i, int j) {
    const int rod = std::min(i, j), wall = std::max(i, j);
    return rod <= 4 && wall == 5 ? times_threshold[rod - 1] * threshold : 0.0;
  };
  scene.physics = pair_property("kn", 6, kStiffness) + pair_property("kt", 6, kStiffness) +
                  pair_property("coefficientRestitution", 6, 0.1) +
                  pair_property("coefficientFriction", 6, friction) +
                  rod_pair("linear tangential history") + walls +
                  "fix motion all nve/spherocylinder\n" + gravity_on_slope(0.0) +
                  eased_start(100.0, 5000);
  scene.dt = 1e-5;
  scene.steps = 60000;
  const std::vector<Rod> after = run(scene, mode).back().rods;

  for (int i = 0; i < 2; i++)
    EXPECT_LT(after[i].position.z, scene.rods[i].position.z - 1e-3)
        << "stands at " << times_threshold[i] << " of the threshold friction";
  double wall_force_error = 0.0;
  for (int i = 2; i < 4; i++) {
    EXPECT_LT(norm(after[i].velocity), 1e-9)
        << "slips at " << times_threshold[i] << " of the threshold friction";
    const double head = after[i].position.x + after[i].half_cylinder() * after[i].axis.x;
    wall_force_error =
        std::max(wall_force_error, std::fabs((r + head) * kStiffness / (threshold * weight) - 1.0));
  }
  // The springs let the ladder turn by 10^-4 before it rests.
  expect_holds({"Ladder: force on the wall, relative", "m g h cos(t)/(2 (h sin(t) + r))", 2e-4},
               wall_force_error);
  // Half the width of the bracket of the rods that slip and those that stand.
  expect_holds({"Ladder: friction at which it slips, relative", "N_wall = mu m g", 3e-3},
               0.5 * (times_threshold[2] - times_threshold[1]));
}

}  // namespace

TEST_P(Friction, LadderAtItsThreshold)
{
  expect_ladder_at_its_threshold(Scene{}, kPlanes, GetParam());
}

// In a corner of two sheets of triangles, of which each is a mesh of its own material.
TEST(MeshFriction, LadderAtItsThreshold)
{
  Scene scene;
  scene.files["floor.stl"] =
      stl(randomly_tiled({{-0.5, -0.7, 0.0}, {0.5, 0.0, 0.0}, {0.0, 1.4, 0.0}}, 6, 15485863));
  scene.files["side.stl"] =
      stl(randomly_tiled({{0.0, -0.7, 0.0}, {0.0, 1.4, 0.0}, {0.0, 0.0, 0.4}}, 6, 32452843));
  expect_ladder_at_its_threshold(
      scene,
      "fix floor all mesh/surface file floor.stl type 5\n"
      "fix side all mesh/surface file side.stl type 6\n" +
          mesh_wall("walls", "linear tangential history", {"floor", "side"}),
      Mode::OneRank);
}

DECKS_IN_ALL_MODES(Friction);

}  // namespace
