// SPDX-License-Identifier: GPL-2.0-or-later
// Heat between touching rods, and between a rod and a wall, by closed form. LIGGGHTS's law of one
// contact is 4 k_i k_j/(k_i + k_j) sqrt(A) (T_j - T_i), A the circle in which the two spheres of the
// rods' radii at the contact meet.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "deck_run.h"

using namespace decks;

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Bodies {
  std::string atoms;       // lines of the data file
  std::string x = "-1 1";  // of the box
  std::string boundary = "f f f";
  std::string style = "heat/gran/conduction";
  std::string keywords;  // of the fix
  std::string tangential = "history";
  std::string commands;  // before the run: walls, temperatures
  int steps = 2;
  int ranks = 1;
};

// Rows of a dump after the run: id, temperature, heat flux, and what `columns` adds.
Table heated(const Bodies &bodies, const std::string &columns = "")
{
  const DeckFolder folder;
  int count = 0;
  for (const char c : bodies.atoms) count += c == '\n';
  folder.write("rods.data", "rods\n\n" + std::to_string(count) + " atoms\n2 atom types\n" +
                                bodies.x + " xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n\nAtoms\n\n" +
                                bodies.atoms);
  folder.write("in.heat",
               "atom_style spherocylinder\natom_modify map array\nboundary " + bodies.boundary + R"(
newton off
communicate single vel yes
units si
read_data rods.data
neighbor 0.02 bin
neigh_modify delay 0
fix Y all property/global youngsModulus peratomtype 5.0e6 5.0e6
fix Yo all property/global youngsModulusOriginal peratomtype 8.0e7 8.0e7
fix nu all property/global poissonsRatio peratomtype 0.45 0.45
fix rest all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5
fix fric all property/global coefficientFriction peratomtypepair 2 0.2 0.2 0.2 0.2
pair_style gran model hertz tangential )" +
                   bodies.tangential + R"( surface spherocylinder
pair_coeff * *
timestep 1.0e-9
fix motion all nve/spherocylinder
fix k all property/global thermalConductivity peratomtype 100.0 50.0
fix c all property/global thermalCapacity peratomtype 10.0 10.0
fix heat all )" + bodies.style +
                   " initial_temperature 300.0 " + bodies.keywords + "\nrun 0\n" + bodies.commands +
                   "\nset atom 2 property/atom Temp 800.0\n" +
                   exact_dump("heat.dump", bodies.steps, "id f_heat f_heatFlux[0]" + columns) +
                   "run " + std::to_string(bodies.steps) + "\n");
  Launch launch;
  launch.ranks = bodies.ranks;
  const Outcome outcome = folder.run("in.heat", launch);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::vector<Snapshot> dumped = read_dump(folder / "heat.dump");
  return dumped.empty() ? Table{} : dumped.back().atoms;
}

double flux(const Table &rods, size_t row) { return rods.at(row, "f_heatFlux[0]"); }

// Two crossed rods of types 1 whose axes are `distance` apart.
std::string crossed(double distance, double second_diameter = 0.01, int second_type = 1)
{
  return "1 1 0.01 0.1 2700 0 0 0 1 0 0\n2 " + std::to_string(second_type) + " " +
         std::to_string(second_diameter) + " 0.1 2700 0.02 " + std::to_string(distance) +
         " 0.01 0 0 1\n";
}

double circle(double radius_i, double radius_j, double distance)
{
  const double h =
      (distance * distance + radius_i * radius_i - radius_j * radius_j) / (2.0 * distance);
  return kPi * (radius_i * radius_i - h * h);
}

double harmonic(double k_i, double k_j) { return 4.0 * k_i * k_j / (k_i + k_j); }

// 39.6 W; both ranks of a pair across a border see it.
TEST(Heat, OfCrossedRods)
{
  const double wanted = harmonic(100, 100) * std::sqrt(circle(0.005, 0.005, 0.00999)) * 500.0;
  EXPECT_NEAR(wanted, 39.6, 0.05);
  for (const char *style : {"heat/gran", "heat/gran/conduction"})
    for (const int ranks : {1, 4}) {
      Bodies bodies;
      bodies.atoms = crossed(0.00999);
      bodies.style = style;
      bodies.ranks = ranks;
      const Table rods = heated(bodies);
      EXPECT_NEAR(flux(rods, 0), wanted, 1e-6 * wanted) << style << " on " << ranks << " ranks";
      EXPECT_NEAR(flux(rods, 1), -wanted, 1e-6 * wanted);
    }
}

TEST(Heat, OfOtherRadiiAndMaterials)
{
  Bodies bodies;
  bodies.atoms = crossed(0.0079, 0.006, 2);
  const double wanted = harmonic(100, 50) * std::sqrt(circle(0.005, 0.003, 0.0079)) * 500.0;
  EXPECT_NEAR(flux(heated(bodies), 0), wanted, 1e-6 * wanted);
}

// The rods' ends touch through the border of a periodic box.
TEST(Heat, AcrossAPeriodicBorder)
{
  for (const int ranks : {1, 2}) {
    Bodies bodies;
    bodies.x = "-0.5 0.5";
    bodies.boundary = "p f f";
    bodies.atoms = "1 1 0.01 0.1 2700 -0.46 0 0 1 0 0\n2 1 0.01 0.1 2700 0.4404 0 0 1 0 0\n";
    bodies.ranks = ranks;
    const double wanted = harmonic(100, 100) * std::sqrt(circle(0.005, 0.005, 0.0096)) * 500.0;
    EXPECT_NEAR(flux(heated(bodies), 0), wanted, 1e-6 * wanted) << ranks << " ranks";
  }
}

// Surfaces 2 mm apart, bounding spheres deep in each other.
TEST(Heat, NoneAcrossAGap)
{
  for (const char *tangential : {"history", "no_history", "off"}) {
    Bodies bodies;
    bodies.atoms = "1 1 0.01 0.1 2700 0 0 0 1 0 0\n2 1 0.01 0.1 2700 0 0.012 0 1 0 0\n";
    bodies.tangential = tangential;
    const Table rods = heated(bodies);
    EXPECT_EQ(flux(rods, 0), 0.0) << tangential;
    EXPECT_EQ(flux(rods, 1), 0.0);
    EXPECT_EQ(rods.at(0, "f_heat"), 300.0);
    EXPECT_EQ(rods.at(1, "f_heat"), 800.0);
  }
}

TEST(Heat, OfTheOtherContactAreas)
{
  Bodies bodies;
  bodies.atoms = crossed(0.0079, 0.006);
  bodies.keywords = "contact_area constant 2.0e-6";
  double wanted = harmonic(100, 100) * std::sqrt(2.0e-6) * 500.0;
  EXPECT_NEAR(flux(heated(bodies), 0), wanted, 1e-6 * wanted);

  bodies.keywords = "contact_area projection";
  wanted = harmonic(100, 100) * std::sqrt(kPi) * 0.005 * 500.0;
  EXPECT_NEAR(flux(heated(bodies), 0), wanted, 1e-6 * wanted);

  // The overlap that the true modulus would have, 16 times the one in use: hertz, (1/16)^(2/3).
  bodies.keywords = "area_correction yes";
  const double overlap = 0.0001 * std::pow(1.0 / 16.0, 2.0 / 3.0);
  wanted = harmonic(100, 100) * std::sqrt(circle(0.005, 0.003, 0.008 - overlap)) * 500.0;
  EXPECT_NEAR(flux(heated(bodies), 0), wanted, 1e-4 * wanted);
}

// One rod between two others: mean of the two contact areas.
TEST(Heat, StoresItsContacts)
{
  Bodies bodies;
  bodies.atoms = crossed(0.00999) + "3 1 0.01 0.1 2700 0 -0.0098 0 0 0 1\n";
  bodies.keywords = "store_contact_data yes";
  const Table rods = heated(bodies, " f_contactAreaConduction f_nContactsConduction");
  const double mean = 0.5 * (circle(0.005, 0.005, 0.00999) + circle(0.005, 0.005, 0.0098));
  EXPECT_EQ(rods.at(0, "f_nContactsConduction"), 2.0);
  EXPECT_NEAR(rods.at(0, "f_contactAreaConduction"), mean, 1e-6 * mean);
  EXPECT_EQ(rods.at(2, "f_nContactsConduction"), 1.0);
}

// A wall conducts through each end: one of a rod that stands, two of one that lies.
TEST(Heat, ThroughAWall)
{
  const double area = kPi * (0.005 * 0.005 - 0.0049 * 0.0049);
  const double one_end = harmonic(100, 100) * std::sqrt(area) * 200.0;
  Bodies bodies;
  bodies.commands = "fix floor all wall/gran model hertz tangential history surface spherocylinder "
                    "primitive type 1 zplane 0.0 temperature 500.0";
  bodies.atoms = "1 1 0.01 0.1 2700 0 0 0.0499 0 0 1\n2 1 0.01 0.1 2700 0.5 0 0.5 0 0 1\n"
                 "3 1 0.01 0.1 2700 -0.5 0 0.0049 1 0 0\n";
  const Table rods = heated(bodies);
  EXPECT_NEAR(flux(rods, 0), one_end, 1e-6 * one_end);
  EXPECT_EQ(flux(rods, 1), 0.0);
  EXPECT_NEAR(flux(rods, 2), 2.0 * one_end, 1e-6 * one_end);
}

// The rods' own masses take the heat up: mean temperature stays, the difference falls by a factor
// 1 - 2 H dt/(m c) a step. (Conductivity made 10^8 W/(m K) by the contact's area.)
TEST(Heat, WarmsTheRodsByTheirOwnMass)
{
  Bodies bodies;
  bodies.atoms = crossed(0.00999);
  bodies.keywords = "contact_area constant 1.0e8";
  bodies.steps = 1000;
  const Table rods = heated(bodies);
  const double mass = 2700.0 * kPi * (0.005 * 0.005 * 0.09 + 4.0 / 3.0 * 0.005 * 0.005 * 0.005);
  const double conductance = harmonic(100, 100) * 1.0e4;
  const double factor = std::pow(1.0 - 2.0 * conductance * 1e-9 / (mass * 10.0), 1000);
  EXPECT_LT(factor, 0.99);
  EXPECT_NEAR(rods.at(0, "f_heat"), 550.0 - 250.0 * factor, 1e-6);
  EXPECT_NEAR(rods.at(1, "f_heat"), 550.0 + 250.0 * factor, 1e-6);
}

}  // namespace
