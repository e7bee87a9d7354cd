// SPDX-License-Identifier: GPL-2.0-or-later
// Walls look only at rods whose ends were near not long ago, and at the contacts of model linear in
// batches: neither may change a motion.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

#include <fmt/format.h>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

// LIGGGHTS's lists are made anew in each step, and with them that of the rods near a wall.
constexpr const char *kListsOfEachStep = "neigh_modify delay 0 every 1 check no\n";

struct Vessel {
  const char *name, *walls;
  double radius;  // of the space between them: across x and y, or along x
};

void PrintTo(const Vessel &vessel, std::ostream *out) { *out << vessel.name; }

const std::string kModels = "linear tangential off";

const Vessel kVessels[] = {{"Cylinder", "cylinder", 0.3}, {"Planes", "planes", 0.3}};

std::string walls_of(const Vessel &vessel)
{
  if (std::string(vessel.walls) == "cylinder")
    return rod_wall("side", kModels, "type 1 zcylinder 0.3 0.0 0.0");
  return rod_wall("left", kModels, "type 1 xplane -0.3") +
         rod_wall("right", kModels, "type 1 xplane 0.3");
}

// Rods of any length, each in a layer of its own, fly and tumble from wall to wall: up to 20 m/s,
// so that a rod is there a hundred steps after it was a rod's length away. LIGGGHTS's skin of two
// long rods' lengths lets its own lists be for hundreds of steps.
Scene tumbling_rods(const Vessel &vessel)
{
  std::mt19937 random(15485863);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Scene scene;
  for (const double ratio : {1.0, 3.0, 10.0, 30.0, 1.0, 10.0, 30.0, 20.0}) {
    Rod rod;
    rod.length = ratio * rod.diameter;
    const int n = static_cast<int>(scene.rods.size());
    rod.position = {0.05 * any(random), 0.05 * any(random), -2.0 + 0.5 * n};
    rod.axis = normalized({any(random), any(random), any(random)});
    rod.velocity = {12.0 + 8.0 * any(random), 0.0, 0.0};
    if (std::string(vessel.walls) == "cylinder") rod.velocity.y = 20.0 * any(random);
    rod.omega = 40.0 * Vec3{any(random), any(random), any(random)};
    scene.rods.push_back(rod);
  }
  scene.box_lo[2] = -3.0;
  scene.box_hi[2] = 3.0;
  scene.skin = 0.6;
  scene.physics = linear_material(1e6, 1e6, 1.0, 0.0) + rod_pair(kModels) + walls_of(vessel) +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 5e-6;
  scene.steps = 40000;
  scene.dump_every = 1000;
  return scene;
}

class NearWalls : public testing::TestWithParam<Vessel> {};

}  // namespace

// To the last bit: a rod's contacts are worked out alike, whenever it was found near.
TEST_P(NearWalls, NoContactComesUnseen)
{
  Scene scene = tumbling_rods(GetParam());
  const std::vector<Frame> near = run(scene);
  scene.physics += kListsOfEachStep;
  const std::vector<Frame> all = run(scene);
  EXPECT_EQ(largest_difference(near, all), 0.0);

  // They have all been at the walls, and more than once.
  std::vector<int> turns(scene.rods.size(), 0);
  for (size_t f = 1; f < near.size(); f++)
    for (size_t k = 0; k < turns.size(); k++)
      turns[k] += norm(near[f].rods[k].velocity - near[f - 1].rods[k].velocity) > 0.01;
  EXPECT_GE(*std::min_element(turns.begin(), turns.end()), 2);
  for (const Rod &rod : near.back().rods) EXPECT_LT(std::fabs(rod.position.x), 0.3);
}

// The border of two ranks is in the vessel's middle: rods take their contacts along.
TEST_P(NearWalls, NoContactComesUnseenOnTwoRanks)
{
  const Scene scene = tumbling_rods(GetParam());
  EXPECT_EQ(largest_difference(run(scene, Mode::TwoRanks), run(scene)), 0.0);
}

// A rod whose centre is at rest comes to the wall by turning: its end is 0.14 m away at first.
TEST(NearWallsOfTurningRods, NoContactComesUnseen)
{
  for (const Vessel &vessel : kVessels) {
    Scene scene = tumbling_rods(vessel);
    Rod rod;
    rod.length = 0.3;
    rod.axis = {0.0, 0.0, 1.0};
    rod.position = {0.16, 0.0, 0.0};
    rod.omega = {0.0, 30.0, 0.0};
    scene.rods = {rod};
    scene.steps = 16000;
    const std::vector<Frame> near = run(scene);
    scene.physics += kListsOfEachStep;
    EXPECT_EQ(largest_difference(near, run(scene)), 0.0) << vessel.name;
    EXPECT_LT(near.back().rods[0].velocity.x, -0.1) << vessel.name;
  }
}

INSTANTIATE_TEST_SUITE_P(, NearWalls, testing::ValuesIn(kVessels),
                         [](const auto &info) { return std::string(info.param.name); });

namespace {

struct Case {
  const char *name, *tangential, *keywords;
};

void PrintTo(const Case &c, std::ostream *out) { *out << c.name; }

std::string models(const Case &c, bool batched)
{
  const std::string usual = std::string("linear tangential ") + c.tangential;
  return batched ? usual : lane_by_lane(usual);
}

std::string wall(const std::string &id, const Case &c, bool batched, const std::string &primitive)
{
  return fmt::format("fix {} all wall/gran model {} surface spherocylinder primitive {} {}\n", id,
                     models(c, batched), primitive, c.keywords);
}

// All that may look at a wall's contacts, in each step.
constexpr const char *kObservers = R"(
fix look all check/timestep/spherocylinder 1 1.0 warn no
compute rows all wall/gran/local id force history
dump rows all local 1 dump.rows c_rows[1] c_rows[2] c_rows[3]
)";

// Rods of two materials in a drum that turns, some with both ends on it, some spheres, beside a
// belt; each in a slice of its own, so that the walls are all they touch. Forty rods make more
// contacts than one batch holds.
Scene drum(const Case &c, bool batched = true)
{
  std::mt19937 random(49979687);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Scene scene;
  scene.types = 2;
  for (int n = 0; n < 40; n++) {
    Rod rod;
    rod.type = 1 + n % 2;
    rod.length = rod.diameter * (n % 5 == 0 ? 1.0 : 6.0 + 3.0 * any(random));
    // Across the lowest line of the drum of radius 0.1 about the y axis, pressed in by up to 1e-5
    // m.
    const double slope = n % 3 == 0 ? 0.0 : 0.2 * any(random);
    const double half = rod.half_cylinder(), reach = 0.1 - rod.radius();
    rod.axis = {std::cos(slope), 0.0, std::sin(slope)};
    const double down = std::sqrt(reach * reach - std::pow(half * std::cos(slope), 2)) -
                        std::fabs(half * std::sin(slope));
    rod.position = {0.0, -0.9 + 0.045 * n, -(down + 1e-5 * (1.0 + any(random)))};
    rod.velocity = 0.2 * Vec3{any(random), any(random), any(random)};
    rod.velocity.y *= 0.05;
    rod.omega = {0.5 * any(random), 2.0 * any(random), 0.5 * any(random)};
    scene.rods.push_back(rod);
  }
  scene.skin = 0.01;
  scene.physics =
      pair_property("kn", 2, [](int i, int j) { return 1e5 * (i + j); }) +
      pair_property("kt", 2, [](int i, int j) { return 6e4 * (i + j); }) +
      pair_property("coefficientRestitution", 2, [](int i, int j) { return 0.3 + 0.1 * (i + j); }) +
      pair_property("coefficientFriction", 2, [](int i, int j) { return 0.1 + 0.1 * (i + j); }) +
      no_rolling_friction(2) +
      fmt::format("pair_style gran model {} surface spherocylinder {}\npair_coeff * *\n",
                  models(c, batched), c.keywords) +
      wall("drum", c, batched, "type 2 ycylinder 0.1 0.0 0.0 shear x 3.0") +
      wall("belt", c, batched, "type 1 zplane -0.0955 shear x 0.3") +
      "fix weight all gravity 9.81 vector 0.0 0.0 -1.0\n"
      "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-5;
  scene.steps = 1000;
  scene.dump_every = 100;
  return scene;
}

class BatchedWalls : public testing::TestWithParam<Case> {};

// Rounding of the forces, 1e-16 of some ten newtons a step, on rods of some grams: 1e-13 m/s^2 or
// 1e-18 m/s in each of 1000 steps. (In five times as many it grows a thousandfold where an end
// lifts off and comes down again.)
constexpr double kSameMotion = 2e-14;

}  // namespace

TEST_P(BatchedWalls, SameMotionAsOneContactAfterTheOther)
{
  const std::vector<Frame> batched = run(drum(GetParam()));
  const std::vector<Frame> each = run(drum(GetParam(), false));
  expect_holds({"Batched wall contacts: position (m)",
                "LIGGGHTS's models, one contact after the other", kSameMotion},
               largest_difference(batched, each));
  // To the last bit equal, one and the same law would have run twice.
  EXPECT_GT(largest_difference(batched, each), 0.0);
}

// Whoever looks on changes nothing, to the last bit, under either law.
TEST_P(BatchedWalls, AreTheSameUnderObservation)
{
  for (const bool batched : {true, false}) {
    const Case c = GetParam();
    Scene scene = drum(c, batched);
    const std::vector<Frame> alone = run(scene);
    scene.physics += kObservers;
    if (c.tangential != std::string("history"))
      scene.physics.erase(scene.physics.find(" history\ndump"), 8);
    EXPECT_EQ(largest_difference(run(scene), alone), 0.0) << batched;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Models, BatchedWalls,
    testing::Values(Case{"Off", "off", ""}, Case{"NoHistory", "no_history", ""},
                    Case{"History", "history", ""},
                    Case{"AspectScaling", "history", "aspect_scaling on"},
                    Case{"LimitForce", "history", "limitForce on"},
                    Case{"WithoutTangentialDamping", "history", "tangential_damping off"}),
    [](const auto &info) { return std::string(info.param.name); });
