// SPDX-License-Identifier: GPL-2.0-or-later
// A rod as long as thick is a sphere: the same deck on stock LIGGGHTS, with atom_style granular and
// surface default, must give the same motion. For LIGGGHTS's contact models, over collisions with
// each other and with walls.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "scene.h"
#include "stock_spheres.h"

using namespace decks;

namespace {

struct Models {
  const char *name;   // of the test
  const char *words;  // of the deck
};

void PrintTo(const Models &models, std::ostream *out) { *out << models.words; }

class SphereLimit : public testing::TestWithParam<Models> {};

// 27 balls in a box of side 0.06 m.
std::vector<Rod> balls()
{
  std::mt19937 random(20011);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Rod> all;
  for (int i = 0; i < 27; i++) {
    Rod ball;
    ball.length = ball.diameter = 0.012 + 0.002 * any(random);
    ball.position = {0.01 + 0.02 * (i % 3) + 0.002 * any(random),
                     0.01 + 0.02 * (i / 3 % 3) + 0.002 * any(random),
                     0.01 + 0.02 * (i / 9) + 0.002 * any(random)};
    ball.velocity = {0.3 * any(random), 0.3 * any(random), 0.3 * any(random)};
    ball.omega = {20.0 * any(random), 20.0 * any(random), 20.0 * any(random)};
    all.push_back(ball);
  }
  return all;
}

// Everything any of the models may ask for.
const char *const kMaterial = R"(
fix p1 all property/global kn peratomtypepair 1 1e5
fix p2 all property/global kt peratomtypepair 1 5e4
fix p3 all property/global gamman peratomtypepair 1 2000.0
fix p4 all property/global gammat peratomtypepair 1 1000.0
fix p5 all property/global youngsModulus peratomtype 5e6
fix p6 all property/global poissonsRatio peratomtype 0.45
fix p7 all property/global coefficientRestitution peratomtypepair 1 0.7
fix p8 all property/global coefficientFriction peratomtypepair 1 0.3
fix p9 all property/global characteristicVelocity scalar 1.0
fix p10 all property/global coefficientRollingFriction peratomtypepair 1 0.1
fix p11 all property/global coefficientRollingViscousDamping peratomtypepair 1 0.1
fix p12 all property/global cohesionEnergyDensity peratomtypepair 1 20000.0
)";

// Stock LIGGGHTS forgets the tangential spring of a parted pair only within the contact distance
// factor, so at its default of 1 not before the next neighbour list; rods forget it at once. A
// factor of 1.1 in the stock deck lets both forget at once.
std::string deck_for(bool stock, const std::string &models, bool with_bar, int steps)
{
  const char *surface = stock ? "default" : "spherocylinder";
  std::string walls;
  for (const char *axis : {"x", "y", "z"})
    for (const int side : {0, 1})
      walls += fmt::format(
          "fix wall_{0}{1} all wall/gran model {2} surface {3} primitive type 1 {0}plane {4}\n",
          axis, side, models, surface, 0.06 * side);
  if (with_bar)
    walls += fmt::format(
        "fix bar all wall/gran model {} surface {} primitive type 1 ycylinder 0.003 0.0 0.02\n",
        models, surface);
  return fmt::format(R"(atom_style {0}
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
read_data balls.data
neighbor 0.004 bin
neigh_modify delay 0{7}
{1}
pair_style gran model {2} surface {3}
pair_coeff * *
{4}
timestep 1e-5
fix weight all gravity 9.81 vector 0 0 -1
fix motion all {5}
thermo 10000
{6}run {8}
)",
                     stock ? "granular" : "spherocylinder", kMaterial, models, surface, walls,
                     stock ? "nve/sphere" : "nve/spherocylinder",
                     exact_dump("dump.balls", steps, "id x y z vx vy vz omegax omegay omegaz"),
                     stock ? " contact_distance_factor 1.1" : "", steps);
}

// As far as the last of both runs: the largest differences.
struct Difference {
  double position = 0.0, spin = 0.0;  // m, rad/s
  double travelled = 0.0;             // downwards, of any ball (m)
};

Difference of_stock_liggghts(const std::string &models, bool with_bar, int steps)
{
  const std::vector<Rod> all = balls();
  const DeckFolder ours, stock;
  Scene scene;
  scene.rods = all;
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = 0.0;
    scene.box_hi[d] = 0.06;
  }
  ours.write("balls.data", data_file(scene));
  ours.write("in.balls", deck_for(false, models, with_bar, steps));
  stock.write("balls.data", granular_data_file(all, 0.0, 0.06));
  stock.write("in.balls", deck_for(true, models, with_bar, steps));

  const Outcome our_outcome = ours.run("in.balls");
  EXPECT_EQ(our_outcome.exit_code, 0) << our_outcome.output;
  const Outcome stock_outcome = stock.run("in.balls", {Program::Stock, 1});
  EXPECT_EQ(stock_outcome.exit_code, 0) << stock_outcome.output;

  const Table got = read_dump(ours / "dump.balls").back().atoms;
  const Table wanted = read_dump(stock / "dump.balls").back().atoms;
  EXPECT_EQ(got.rows.size(), all.size());
  EXPECT_EQ(wanted.rows.size(), all.size());
  Difference result;
  for (size_t i = 0; i < all.size(); i++) {
    for (const char *c : {"x", "y", "z"})
      result.position = std::max(result.position, std::fabs(got.at(i, c) - wanted.at(i, c)));
    for (const char *c : {"omegax", "omegay", "omegaz"})
      result.spin = std::max(result.spin, std::fabs(got.at(i, c) - wanted.at(i, c)));
    result.travelled = std::max(result.travelled, std::fabs(got.at(i, "z") - all[i].position.z));
  }
  return result;
}

}  // namespace

TEST_P(SphereLimit, MovesAsInStockLiggghts)
{
  const Difference difference = of_stock_liggghts(GetParam().words, false, 10000);
  EXPECT_GT(difference.travelled, 0.01);
  // Round-off, which each collision multiplies by about the free path over the radius.
  expect_holds({"Sphere limit, 27 balls, 10^4 steps, position (m)", "stock LIGGGHTS", 1e-10},
               difference.position);
  expect_holds({"Sphere limit, 27 balls, 10^4 steps, spin (rad/s)", "stock LIGGGHTS", 1e-6},
               difference.spin);
}

// On the outside of a cylinder, which throws them apart, so that round-off grows faster: half the steps.
TEST_P(SphereLimit, MovesAsInStockLiggghtsRoundABar)
{
  const Difference difference = of_stock_liggghts(GetParam().words, true, 5000);
  EXPECT_GT(difference.travelled, 0.01);
  expect_holds({"Sphere limit, 27 balls round a bar, position (m)", "stock LIGGGHTS", 1e-10},
               difference.position);
  expect_holds({"Sphere limit, 27 balls round a bar, spin (rad/s)", "stock LIGGGHTS", 1e-6},
               difference.spin);
}

INSTANTIATE_TEST_SUITE_P(
    , SphereLimit,
    testing::Values(Models{"HookeHistory", "hooke tangential history"},
                    Models{"HookeNoHistory", "hooke tangential no_history"},
                    Models{"HookeOff", "hooke tangential off"},
                    Models{"StiffnessHistory", "hooke/stiffness tangential history"},
                    Models{"StiffnessNoHistory", "hooke/stiffness tangential no_history"},
                    Models{"StiffnessOff", "hooke/stiffness tangential off"},
                    Models{"HertzHistory", "hertz tangential history"},
                    Models{"HertzNoHistory", "hertz tangential no_history"},
                    Models{"HertzOff", "hertz tangential off"},
                    Models{"HertzRollingCdt", "hertz tangential history rolling_friction cdt"},
                    Models{"HertzRollingEpsd", "hertz tangential history rolling_friction epsd"},
                    Models{"HertzRollingEpsd2", "hertz tangential history rolling_friction epsd2"},
                    Models{"HertzCohesionSjkr", "hertz tangential history cohesion sjkr"},
                    Models{"HookeCohesionSjkr2", "hooke tangential history cohesion sjkr2"}),
    [](const auto &info) { return info.param.name; });

// Rods under LIGGGHTS's own models: hooke and hertz keep the coefficient of restitution for
// off-centre impacts too, because they damp by the effective mass at the contact.
TEST(StockModels, RodsKeepTheCoefficientOfRestitution)
{
  const double restitution = 0.5, approach = 0.01;
  Scene scene;
  scene.box_lo[2] = -0.1;
  for (const double elevation : {10.0, 50.0, 90.0}) {
    Rod rod;
    rod.axis = {std::cos(degrees(elevation)), 0.0, std::sin(degrees(elevation))};
    rod.position = {0.0, -0.5 + 0.3 * static_cast<double>(scene.rods.size()),
                    rod.radius() + 1e-7 + rod.half_cylinder() * rod.axis.z};
    rod.velocity.z = -approach;
    scene.rods.push_back(rod);
  }
  scene.dt = 1e-7;
  scene.steps = 25000;
  for (const std::string model : {"hooke", "hertz"}) {
    scene.physics = "fix y all property/global youngsModulus peratomtype 9e8\n"
                    "fix nu all property/global poissonsRatio peratomtype 0.3\n"
                    "fix cv all property/global characteristicVelocity scalar 0.01\n" +
                    pair_property("coefficientRestitution", 1, restitution) +
                    rod_pair(model + " tangential off") +
                    rod_wall("floor", model + " tangential off", "type 1 zplane 0.0") +
                    "fix motion all nve/spherocylinder\n";
    const std::vector<Rod> after = run(scene).back().rods;
    double error = 0.0;
    for (const Rod &rod : after) {
      const double end = rod.velocity.z + rod.omega.y * rod.half_cylinder() * rod.axis.x;
      error = std::max(error, std::fabs(end / approach / restitution - 1.0));
    }
    // As for model linear; a Hertz contact starts more softly.
    expect_holds({"Off-centre impact, model " + model + ": restitution, relative", "e", 2e-3},
                 error);
  }
}
