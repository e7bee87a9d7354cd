// SPDX-License-Identifier: GPL-2.0-or-later
// compute property/atom of rods: axis, quaternion and size for variables, averages and dumps.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/rotation.h"
#include "scene.h"

using namespace decks;

namespace {

Scene scene_of(const std::vector<Rod> &rods)
{
  Scene scene;
  scene.rods = rods;
  scene.dt = 1e-5;
  scene.physics = linear_material(1e5, 1e5, 0.5, 0.2) + rod_pair("linear tangential history") +
                  "fix motion all nve/spherocylinder\n";
  return scene;
}

std::string deck_of(const Scene &scene, int ranks, const std::string &commands)
{
  return preamble(scene, ranks > 1 ? Mode::TwoRanks : Mode::OneRank) +
         "read_data rods.data\nneighbor 0.02 bin\nneigh_modify delay 0\n" + scene.physics +
         fmt::format("timestep {}\n", scene.dt) + commands;
}

Outcome run_deck(const DeckFolder &folder, const Scene &scene, int ranks,
                 const std::string &commands)
{
  folder.write("rods.data", data_file(scene));
  folder.write("in.axes", deck_of(scene, ranks, commands));
  const Outcome outcome = folder.run("in.axes", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  return outcome;
}

class PropertyAtom : public testing::TestWithParam<int> {};

// Three rods along x, y, z: <u_i u_j> is a third of the unit matrix, so that Q = 0.
TEST_P(PropertyAtom, RodsAlongXYZHaveNoOrder)
{
  const Scene scene = scene_of({{{0.1, 0.0, 0.0}, {1.0, 0.0, 0.0}},
                                {{0.1, 0.3, 0.0}, {0.0, 1.0, 0.0}},
                                {{-0.4, 0.6, 0.0}, {0.0, 0.0, 1.0}}});
  const DeckFolder folder;
  const Outcome outcome =
      run_deck(folder, scene, GetParam(), R"(compute u all property/atom ux uy uz
variable xx atom 1.5*c_u[1]*c_u[1]-0.5
variable xy atom 1.5*c_u[1]*c_u[2]
variable zz atom c_u[3]*c_u[3]
compute q all reduce ave v_xx v_xy v_zz
compute k all property/atom quatw quati quatj quatk
variable fromq atom (1-2*(c_k[2]^2+c_k[3]^2))^2
compute m all reduce ave v_fromq
thermo_style custom step c_q[1] c_q[2] c_q[3] c_m
run 0
)");
  const Table thermo = read_thermo(outcome.output);
  EXPECT_NEAR(thermo.at(0, "q[1]"), 0.0, 1e-8);
  EXPECT_NEAR(thermo.at(0, "q[2]"), 0.0, 1e-8);
  EXPECT_NEAR(thermo.at(0, "q[3]"), 1.0 / 3.0, 1e-8);
  EXPECT_NEAR(thermo.at(0, "m"), 1.0 / 3.0, 1e-8);
}

// A rod that turns about z with omega for 100 steps: fix ave/time of cos^2 at its end is
// cos^2(omega t).
TEST_P(PropertyAtom, AveragesFollowTheTurningAxis)
{
  const Scene scene = scene_of({{{0.1, 0.2, 0.0}, {1.0, 0.0, 0.0}, {}, {0.0, 0.0, 500.0}}});
  const DeckFolder folder;
  const Outcome outcome = run_deck(folder, scene, GetParam(), R"(compute u all property/atom ux
variable xx atom c_u*c_u
compute q all reduce sum v_xx
fix mean all ave/time 100 1 100 c_q
fix each all ave/atom 100 1 100 c_u
fix angles all ave/histo 100 1 100 0.0 1.0 10 c_u mode vector file histogram.txt
variable last equal f_mean
compute each all reduce sum f_each
thermo_style custom step f_mean c_each
thermo 100
run 100
)");
  const Table thermo = read_thermo(outcome.output);
  const double c = std::cos(500.0 * 100 * 1e-5);
  EXPECT_NEAR(thermo.at(1, "mean"), c * c, 1e-8);
  EXPECT_NEAR(thermo.at(1, "each"), c, 1e-8);
  EXPECT_NE(folder.read("histogram.txt").find("9 0.85 1 1"), std::string::npos)
      << folder.read("histogram.txt");
}

// Every property of rods beside its closed form, and stock ones in between, in any order.
TEST_P(PropertyAtom, GivesTheRodsOwnSize)
{
  Rod thin{{0.3, 0.0, 0.0}, {0.0, 0.6, 0.8}, {1.0, 2.0, 3.0}, {0.0, 0.0, 0.0}, 0.12, 0.01, 2700.0};
  Rod thick{{-0.3, 0.0, 0.0}, {0.0, 0.0, -1.0}, {4.0, 5.0, 6.0}, {0.0, 0.0, 0.0}, 0.2, 0.05, 900.0};
  const Scene scene = scene_of({thin, thick});
  const DeckFolder folder;
  std::string columns = "id";
  for (int k = 1; k <= 15; k++) columns += fmt::format(" c_p[{}]", k);
  run_deck(folder, scene, GetParam(),
           R"(compute p all property/atom diameter vy length id aspect &
  density volume eqradius inertiax inertiaz shapex shapez uy uz mass
compute one all property/atom vx
group second id 2
compute second second property/atom length
)" + exact_dump("dump.p", 1, columns + " c_one c_second") +
               "run 0\n");
  const Table rows = read_dump(folder / "dump.p").back().atoms;
  ASSERT_EQ(rows.rows.size(), 2u);
  for (size_t k = 0; k < 2; k++) {
    const Rod &rod = scene.rods[k];
    const auto wanted = rod.properties();
    const double values[] = {rod.diameter,
                             rod.velocity.y,
                             rod.length,
                             k + 1.0,
                             rod.length / rod.diameter,
                             rod.density,
                             wanted.volume,
                             std::cbrt(wanted.volume * 3.0 / 4.0 / M_PI),
                             wanted.inertia_transverse,
                             wanted.inertia_axial,
                             rod.radius(),
                             0.5 * rod.length,
                             rod.axis.y,
                             rod.axis.z,
                             wanted.mass};
    for (int column = 0; column < 15; column++)
      EXPECT_NEAR(rows.rows[k][1 + column], values[column], 1e-14 * (1 + std::fabs(values[column])))
          << column;
    EXPECT_EQ(rows.rows[k][16], rod.velocity.x);
    EXPECT_DOUBLE_EQ(rows.rows[k][17], k == 1 ? rod.length : 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(, PropertyAtom, testing::Values(1, 2));

TEST(PropertyAtomOfSpheres, IsLiggghtssOwn)
{
  const DeckFolder folder;
  folder.write("in.spheres", R"(atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
create_atoms 1 single 0 0 0 units box
set atom 1 diameter 0.02 density 1000
compute u all property/atom ux
)");
  const Outcome outcome = folder.run("in.spheres");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("Invalid keyword in compute property/atom"), std::string::npos);
}

}  // namespace
