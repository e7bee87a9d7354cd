// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's styles that the table calls right or different: each in a deck with rods on two ranks,
// which must run to its end; some by closed form.
#include <cmath>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "deck_run.h"
#include "loader/host_styles.h"

using namespace decks;
using spherocylinder::HostKind;

namespace {

const char *const kPlane = R"(solid plane
facet normal 0 0 1
 outer loop
  vertex -0.4 -0.4 0.1
  vertex 0.4 -0.4 0.1
  vertex 0.4 0.4 0.1
 endloop
endfacet
facet normal 0 0 1
 outer loop
  vertex -0.4 -0.4 0.1
  vertex 0.4 0.4 0.1
  vertex -0.4 0.4 0.1
 endloop
endfacet
endsolid plane
)";

// Of two rods, 0.1 and 0.2 m long.
std::string data(const std::string &rods)
{
  return "two rods\n\n2 atoms\n1 atom types\n-0.5 0.5 xlo xhi\n-0.5 0.5 ylo yhi\n-0.5 0.5 zlo zhi\n\n"
         "Atoms\n\n" +
         rods;
}

const std::string kTouching =
    "1 1 0.01 0.1 2700 -0.02 0.01 0.2 1 0 0\n2 1 0.01 0.2 2700 0.02 0.01 0.2099 0 0.6 0.8\n\n"
    "Velocities\n\n1 0 0 0 0 3 0\n2 1 0 0 0 0 4\n";

std::string deck(const std::string &commands, int steps, const std::string &boundary = "f f f",
                 const std::string &after_rods = "")
{
  return "atom_style spherocylinder\natom_modify map array\nboundary " + boundary + R"(
newton off
communicate single vel yes
units si
read_data rods.data
)" + after_rods +
         R"(
neighbor 0.02 bin
neigh_modify delay 0
region all_of_it block -1 1 -1 1 -1 1 units box
fix kn all property/global kn peratomtypepair 1 1e5
fix kt all property/global kt peratomtypepair 1 1e5
fix rest all property/global coefficientRestitution peratomtypepair 1 0.5
fix fric all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model linear tangential history surface spherocylinder
pair_coeff * *
fix floor all wall/gran model linear tangential history surface spherocylinder &
  primitive type 1 zplane -0.45
fix motion all nve/spherocylinder
timestep 1e-5
)" + commands +
         "\nrun " + std::to_string(steps) + "\n";
}

struct Use {
  HostKind kind;
  const char *name;
  const char *commands;
};

void PrintTo(const Use &use, std::ostream *out) { *out << word_for(use.kind) << " " << use.name; }

constexpr HostKind kFix = HostKind::Fix, kCompute = HostKind::Compute, kDump = HostKind::Dump;

const Use kUses[] = {
    {kFix, "addforce", "fix t all addforce 0 0 1"},
    {kFix, "ave/atom", "fix t all ave/atom 1 5 5 vx"},
    {kFix, "ave/correlate", "compute k all ke\nfix t all ave/correlate 1 2 5 c_k"},
    {kFix, "ave/histo", "fix t all ave/histo 1 5 5 -1 1 10 vx mode vector"},
    {kFix, "ave/spatial", "fix t all ave/spatial 1 5 5 z lower 0.1 density/mass vz units box"},
    {kFix, "ave/time", "compute k all ke\nfix t all ave/time 1 5 5 c_k"},
    {kFix, "aveforce", "fix t all aveforce 0 0 1"},
    {kFix, "diam/max", "fix t all diam/max"},
    {kFix, "drag", "fix t all drag 0 0 0 1 0.1"},
    {kFix, "gravity", "fix t all gravity 9.81 vector 0 0 -1"},
    {kFix, "lineforce", "fix t all lineforce 0 0 1"},
    {kFix, "mesh/surface", "fix t all mesh/surface file plane.stl type 1"},
    {kFix, "mesh/surface/planar", "fix t all mesh/surface/planar file plane.stl type 1"},
    {kFix, "momentum", "fix t all momentum 1 linear 1 1 1 angular"},
    {kFix, "move/mesh",
     "fix m all mesh/surface file plane.stl type 1\n"
     "fix t all move/mesh mesh m linear 0 0 1"},
    {kFix, "planeforce", "fix t all planeforce 0 0 1"},
    {kFix, "print", "fix t all print 5 hello"},
    {kFix, "property/atom", "fix t all property/atom pp scalar yes yes no 1.0"},
    {kFix, "property/atom/tracer",
     "fix t all property/atom/tracer region_mark all_of_it mark_step 1 "
     "marker_style dirac check_mark_every 1"},
    {kFix, "setforce", "fix t all setforce 0 0 1"},
    {kFix, "spring", "fix t all spring tether 1 0 0 0 0"},
    {kFix, "spring/self", "fix t all spring/self 1"},
    {kFix, "store/force", "fix t all store/force"},
    {kFix, "store/state", "fix t all store/state 0 x y z"},
    {kFix, "viscous", "fix t all viscous 0.1"},
    {kCompute, "centro/atom", "compute t all centro/atom fcc\ndump d all custom 5 file id c_t"},
    {kCompute, "cluster/atom", "compute t all cluster/atom 0.05\ndump d all custom 5 file id c_t"},
    {kCompute, "cna/atom", "compute t all cna/atom 0.05\ndump d all custom 5 file id c_t"},
    {kCompute, "com", "compute t all com\nfix a all ave/time 1 1 5 c_t mode vector"},
    {kCompute, "coord/atom", "compute t all coord/atom 0.05\ndump d all custom 5 file id c_t"},
    {kCompute, "displace/atom", "compute t all displace/atom\ndump d all custom 5 file id c_t[1]"},
    {kCompute, "gyration", "compute t all gyration\nfix a all ave/time 1 1 5 c_t"},
    {kCompute, "ke", "compute t all ke\nfix a all ave/time 1 1 5 c_t"},
    {kCompute, "ke/atom", "compute t all ke/atom\ndump d all custom 5 file id c_t"},
    {kCompute, "msd", "compute t all msd com yes\nfix a all ave/time 1 1 5 c_t mode vector"},
    {kCompute, "pair/gran/local", "compute t all pair/gran/local\ndump d all local 5 file c_t[1]"},
    {kCompute, "pe", "compute t all pe\nfix a all ave/time 1 1 5 c_t"},
    {kCompute, "pe/atom", "compute t all pe/atom\ndump d all custom 5 file id c_t"},
    {kCompute, "pressure", "compute t all pressure thermo_temp\nfix a all ave/time 1 1 5 c_t"},
    {kCompute, "rdf", "compute t all rdf 10\nfix a all ave/time 1 1 5 c_t mode vector"},
    {kCompute, "reduce",
     "compute t all reduce sum vx vy\nfix a all ave/time 1 1 5 c_t mode vector"},
    {kCompute, "reduce/region",
     "compute t all reduce/region all_of_it sum vx\n"
     "fix a all ave/time 1 1 5 c_t"},
    {kCompute, "slice",
     "compute x all reduce sum vx vy vz\ncompute t all slice 1 3 1 c_x\n"
     "fix a all ave/time 1 1 5 c_t mode vector"},
    {kCompute, "stress/atom", "compute t all stress/atom\ndump d all custom 5 file id c_t[1]"},
    {kCompute, "temp", "compute t all temp\nfix a all ave/time 1 1 5 c_t"},
    {kCompute, "wall/gran/local", "compute t all wall/gran/local\ndump d all local 5 file c_t[1]"},
    {kDump, "custom", "dump t all custom 5 file.* id x quat1"},
    {kDump, "custom/vtk", "dump t all custom/vtk 5 file*.vtk id x y z quat1"},
    {kDump, "decomposition/vtk", "dump t all decomposition/vtk 5 file*.vtk"},
    {kDump, "local", "compute p all pair/gran/local\ndump t all local 5 file.* c_p[1]"},
    {kDump, "local/gran/vtk",
     "compute p all pair/gran/local\ndump t all local/gran/vtk 5 file*.vtk p"},
    {kDump, "mesh/stl",
     "fix m all mesh/surface file plane.stl type 1\n"
     "dump t all mesh/stl 5 file*.stl"},
    {kDump, "mesh/vtk",
     "fix m all mesh/surface file plane.stl type 1\n"
     "dump t all mesh/vtk 5 file*.vtk stress"},
    {kDump, "xyz", "dump t all xyz 5 file.xyz"},
};

class StyleThatWorks : public testing::TestWithParam<Use> {};

TEST_P(StyleThatWorks, RunsWithRods)
{
  const Use &use = GetParam();
  const auto *row = spherocylinder::find_host_style(use.kind, use.name);
  ASSERT_TRUE(row) << "not in the table";
  EXPECT_NE(row->verdict, spherocylinder::Verdict::Refused);
  const DeckFolder folder;
  folder.write("rods.data", data(kTouching));
  folder.write("plane.stl", kPlane);
  folder.write("in.deck", deck(use.commands, 10));
  Launch launch;
  launch.ranks = 2;
  const Outcome outcome = folder.run("in.deck", launch);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

std::string test_name(const testing::TestParamInfo<Use> &info)
{
  std::string name = std::string(word_for(info.param.kind)) + "_" + info.param.name;
  for (char &c : name)
    if (!isalnum(c)) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(, StyleThatWorks, testing::ValuesIn(kUses), test_name);

// Two rods fly through a mesh side by side: counted once each, with their own masses (rho V).
TEST(HostStyleValues, MassflowCountsRodsByTheirMass)
{
  const DeckFolder folder;
  folder.write("plane.stl", kPlane);
  folder.write("rods.data", data("1 1 0.01 0.1 2700 0.1 0.02 -0.1 1 0 0\n"
                                 "2 1 0.01 0.2 2700 0.2 -0.13 -0.1 0 0 1\n\n"
                                 "Velocities\n\n1 0 0 10 0 0 0\n2 0 0 10 0 0 0\n"));
  folder.write("in.deck",
               deck("fix m all mesh/surface file plane.stl type 1\n"
                    "fix t all massflow/mesh mesh m count once vec_side 0 0 1\n"
                    "thermo_style custom step f_t[1] f_t[2]\nthermo_modify format float %.12g",
                    3000));
  const Outcome outcome = folder.run("in.deck");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  const double volume = 3.14159265358979 * 0.005 * 0.005 * (0.09 + 0.19 + 8.0 / 3.0 * 0.005);
  EXPECT_NEAR(thermo.rows.back()[1], 2700.0 * volume, 1e-9);
  EXPECT_EQ(thermo.rows.back()[2], 2.0);
}

// Copies are the same rods, each box over: sizes, axes and spins.
TEST(HostStyleValues, ReplicateCopiesRods)
{
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    folder.write("rods.data", data(kTouching));
    folder.write(
        "in.deck",
        deck(exact_dump("end.dump", 1, "id x y z omegay omegaz shapez quat1 quat2 quat3 quat4"), 0,
             "p p f", "replicate 2 2 1 offset 1.0 1.0 1.0 shift 0 0 0"));
    Launch launch;
    launch.ranks = ranks;
    const Outcome outcome = folder.run("in.deck", launch);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const Table rods = read_dump(folder / "end.dump").back().atoms;
    ASSERT_EQ(rods.rows.size(), 8u);
    for (size_t row = 2; row < 8; row++) {
      const size_t original = row % 2;
      EXPECT_NEAR(rods.at(row, "z"), rods.at(original, "z"), 1e-12);
      EXPECT_NEAR(std::fabs(rods.at(row, "x") - rods.at(original, "x")), row < 4 ? 0.0 : 1.0,
                  1e-12);
      EXPECT_NEAR(std::fabs(rods.at(row, "y") - rods.at(original, "y")), row % 4 < 2 ? 0.0 : 1.0,
                  1e-12);
      for (const char *column : {"omegay", "omegaz", "shapez", "quat1", "quat2", "quat3", "quat4"})
        EXPECT_EQ(rods.at(row, column), rods.at(original, column)) << column;
    }
  }
}

// A single dump of a refused style, and mesh modules beside others.
TEST(HostStyleValues, RefusedInOtherWords)
{
  for (const char *commands :
       {"write_dump all image file.ppm radius type", "write_dump all atom/vtk file.vtk",
        "fix m all mesh/surface/stress/liquidtransfer file plane.stl type 1",
        "thermo_style custom step erotate"}) {
    const DeckFolder folder;
    folder.write("plane.stl", kPlane);
    folder.write("rods.data", data(kTouching));
    folder.write("in.deck", deck(commands, 1));
    const Outcome outcome = folder.run("in.deck");
    EXPECT_NE(outcome.exit_code, 0) << commands;
    EXPECT_NE(outcome.output.find(" with atom_style spherocylinder: "), std::string::npos)
        << commands << "\n"
        << outcome.output;
  }
}

}  // namespace
