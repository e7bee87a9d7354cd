// SPDX-License-Identifier: GPL-2.0-or-later
// Wrong decks and data files: the program must end with an exit code other than 0 and one sentence
// that says who complains, what about, the value seen and the value wanted.
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "deck_run.h"

using namespace decks;

namespace {

const char *const kGoodData = R"(two rods

2 atoms
1 atom types
-0.5 0.5 xlo xhi
-0.5 0.5 ylo yhi
-0.5 0.5 zlo zhi

Atoms

1 1 0.01 0.1 2700 0 0 0.2 1 0 0
2 1 0.01 0.1 2700 0 0.1 0.2 0 0.6 0.8
)";

const char *const kGoodDeck = R"(atom_style spherocylinder
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
read_data rods.data
neighbor 0.02 bin
neigh_modify delay 0
fix kn all property/global kn peratomtypepair 1 1e5
fix kt all property/global kt peratomtypepair 1 1e5
fix rest all property/global coefficientRestitution peratomtypepair 1 0.5
fix fric all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model linear tangential history surface spherocylinder
pair_coeff * *
fix floor all wall/gran model linear tangential history surface spherocylinder &
  primitive type 1 zplane 0.0
fix motion all nve/spherocylinder
timestep 1e-5
run 10
)";

const char *const kGoodInsertion = R"(atom_style spherocylinder
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
region box block -0.2 0.2 -0.2 0.2 0.0 0.4 units box
create_box 1 box
region vessel block -0.2 0.2 -0.2 0.2 0.0 0.4 units box
neighbor 0.02 bin
neigh_modify delay 0
fix kn all property/global kn peratomtypepair 1 1e5
fix kt all property/global kt peratomtypepair 1 1e5
fix rest all property/global coefficientRestitution peratomtypepair 1 0.5
fix fric all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model linear tangential history surface spherocylinder
pair_coeff * *
fix motion all nve/spherocylinder
fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 &
  radius constant 0.005 length constant 0.1 all_in_region vessel
fix mix all particledistribution/discrete 32452843 1 rod 1.0
fix pack all insert/pack seed 86028121 distributiontemplate mix insert_every once &
  overlapcheck yes orientation random all_in no maxattempt 100 vel constant 0.0 0.0 0.0 &
  region vessel particles_in_region 20
timestep 1e-5
run 1
)";

// In the good text `find` is replaced; an empty `find` adds `replace` before the run.
struct Edit {
  std::string find, replace;
};

struct BadInput {
  const char *name;
  Edit edit;
  std::vector<std::string> says;  // in this order, in one line
};

void PrintTo(const BadInput &input, std::ostream *out)
{
  *out << input.edit.find << " -> " << input.edit.replace;
}

std::string edited(std::string text, const Edit &edit)
{
  const std::string find = edit.find.empty() ? "timestep 1e-5\n" : edit.find;
  const size_t at = text.find(find);
  EXPECT_NE(at, std::string::npos) << "no '" << find << "' in the good text";
  if (at == std::string::npos) return text;
  return text.replace(at, find.size(),
                      edit.find.empty() ? edit.replace + "\n" + find : edit.replace);
}

// The lines that begin with the word.
std::vector<std::string> lines_with(const std::string &output, const std::string &word)
{
  std::vector<std::string> lines;
  size_t begin = 0;
  while (begin < output.size()) {
    const size_t end = std::min(output.find('\n', begin), output.size());
    const std::string line = output.substr(begin, end - begin);
    if (line.find(word) != std::string::npos) lines.push_back(line);
    begin = end + 1;
  }
  return lines;
}

bool says_in_order(const std::string &line, const std::vector<std::string> &parts)
{
  size_t at = 0;
  for (const std::string &part : parts) {
    at = line.find(part, at);
    if (at == std::string::npos) return false;
    at += part.size();
  }
  return true;
}

void expect_line(const std::string &output, const std::string &word,
                 const std::vector<std::string> &says)
{
  const std::vector<std::string> lines = lines_with(output, word);
  for (const std::string &line : lines)
    if (says_in_order(line, says)) return;
  std::string wanted = word;
  for (const std::string &part : says) wanted += " ... " + part;
  ADD_FAILURE() << "wanted: " << wanted << "\ngot: " << (lines.empty() ? output : lines[0]);
}

void expect_refused(const std::string &deck, const std::string &data,
                    const std::vector<std::string> &says)
{
  const DeckFolder folder;
  folder.write("in.bad", deck);
  folder.write("rods.data", data);
  const Outcome outcome = folder.run("in.bad");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_LT(outcome.exit_code, 128) << "ended by a signal\n" << outcome.output;
  expect_line(outcome.output, "ERROR", says);
}

TEST(BadInput, TheGoodDecksRun)
{
  for (const char *deck : {kGoodDeck, kGoodInsertion}) {
    const DeckFolder folder;
    folder.write("in.good", deck);
    folder.write("rods.data", kGoodData);
    const Outcome outcome = folder.run("in.good");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_EQ(outcome.output.find("WARNING"), std::string::npos) << outcome.output;
  }
}

class BadData : public testing::TestWithParam<BadInput> {};
class BadDeck : public testing::TestWithParam<BadInput> {};
class BadInsertion : public testing::TestWithParam<BadInput> {};

TEST_P(BadData, IsRefused)
{
  expect_refused(kGoodDeck, edited(kGoodData, GetParam().edit), GetParam().says);
}

TEST_P(BadDeck, IsRefused)
{
  expect_refused(edited(kGoodDeck, GetParam().edit), kGoodData, GetParam().says);
}

TEST_P(BadInsertion, IsRefused)
{
  expect_refused(edited(kGoodInsertion, GetParam().edit), kGoodData, GetParam().says);
}

std::string input_name(const testing::TestParamInfo<BadInput> &info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    , BadData,
    testing::Values(
        BadInput{"LengthBelowDiameter",
                 {"1 1 0.01 0.1", "1 1 0.01 0.005"},
                 {"data file", "atom 1", "length", ">= the diameter 0.01", "got 0.005"}},
        BadInput{"DiameterZero",
                 {"1 1 0.01 0.1", "1 1 0 0.1"},
                 {"data file", "atom 1", "diameter must be > 0", "got 0"}},
        BadInput{"DiameterNegative",
                 {"1 1 0.01 0.1", "1 1 -0.01 0.1"},
                 {"data file", "atom 1", "diameter must be > 0", "got -0.01"}},
        BadInput{"DiameterNotANumber",
                 {"1 1 0.01 0.1", "1 1 thick 0.1"},
                 {"data file", "atom 1", "diameter", "number", "got thick"}},
        BadInput{"DensityZero",
                 {"0.1 2700", "0.1 0"},
                 {"data file", "atom 1", "density must be > 0", "got 0"}},
        BadInput{"DensityNegative",
                 {"0.1 2700", "0.1 -2700"},
                 {"data file", "atom 1", "density must be > 0", "got -2700"}},
        BadInput{"AxisZero",
                 {"0.2 1 0 0", "0.2 0 0 0"},
                 {"data file", "atom 1", "axis", "length 1", "got 0 0 0"}},
        BadInput{"AxisNotUnit",
                 {"0 0.6 0.8", "0 0.6 0.6"},
                 {"data file", "atom 2", "axis", "length 1", "got 0 0.6 0.6"}},
        BadInput{"TypeUnknown",
                 {"1 1 0.01 0.1", "1 7 0.01 0.1"},
                 {"data file", "atom 1", "type must be 1 to 1", "got 7"}},
        BadInput{"ColumnsOfSpheres",
                 {"1 1 0.01 0.1 2700 0 0 0.2 1 0 0\n2 1 0.01 0.1 2700 0 0.1 0.2 0 0.6 0.8",
                  "1 1 0.01 2700 0 0 0.2\n2 1 0.01 2700 0 0.1 0.2"},
                 {"ata file"}}),
    input_name);

const char *const kYoung = "fix young all property/global youngsModulus peratomtype 5e6\n"
                           "fix nu all property/global poissonsRatio peratomtype 0.3\n";
const std::string kWall = "wall/gran model linear tangential history surface spherocylinder ";

INSTANTIATE_TEST_SUITE_P(
    , BadDeck,
    testing::Values(
        BadInput{"StiffnessMissing",
                 {"fix kn all property/global kn peratomtypepair 1 1e5\n", ""},
                 {"property", "kn"}},
        BadInput{"StiffnessZero",
                 {"kn peratomtypepair 1 1e5", "kn peratomtypepair 1 0"},
                 {"kn", "> 0"}},
        BadInput{"FrictionMissing",
                 {"fix fric all property/global coefficientFriction peratomtypepair 1 0.3\n", ""},
                 {"property", "coefficientFriction"}},
        BadInput{"PairWithoutSurface",
                 {"pair_style gran model linear tangential history surface spherocylinder",
                  "pair_style gran model linear tangential history"},
                 {"odel linear", "surface spherocylinder"}},
        BadInput{"StockPairWithoutSurface",
                 {"pair_style gran model linear tangential history surface spherocylinder",
                  std::string(kYoung) + "pair_style gran model hertz tangential history"},
                 {"pair_style gran", "surface spherocylinder"}},
        BadInput{"PairWithSurfaceDefault",
                 {"pair_style gran model linear tangential history surface spherocylinder",
                  std::string(kYoung) +
                      "pair_style gran model hertz tangential history surface default"},
                 {"pair_style gran", "surface spherocylinder"}},
        BadInput{"WallWithoutSurface",
                 {kWall + "&\n  primitive", "wall/gran model linear tangential history primitive"},
                 {"odel linear", "surface spherocylinder"}},
        BadInput{"StockWallWithoutSurface",
                 {"fix floor all " + kWall + "&\n  primitive",
                  std::string(kYoung) +
                      "fix floor all wall/gran model hertz tangential history primitive"},
                 {"wall/gran", "floor", "surface spherocylinder"}},
        BadInput{
            "KeywordUnknown",
            {"surface spherocylinder\npair_coeff", "surface spherocylinder aspect on\npair_coeff"},
            {"aspect"}},
        BadInput{"CloseSkinNegative",
                 {"surface spherocylinder\npair_coeff",
                  "surface spherocylinder close_skin -0.001\npair_coeff"},
                 {"close_skin must be auto or a length > 0", "got -0.001"}},
        BadInput{"CloseSkinZero",
                 {"surface spherocylinder\npair_coeff",
                  "surface spherocylinder close_skin 0\npair_coeff"},
                 {"close_skin must be auto or a length > 0", "got 0"}},
        BadInput{"CloseSkinNoNumber",
                 {"surface spherocylinder\npair_coeff",
                  "surface spherocylinder close_skin wide\npair_coeff"},
                 {"close_skin must be auto or a length > 0", "got wide"}},
        BadInput{
            "CloseSkinMissing",
            {"surface spherocylinder\npair_coeff", "surface spherocylinder close_skin\npair_coeff"},
            {"close_skin must be auto or a length > 0", "got nothing"}},
        BadInput{"ContactForcesStored",
                 {"", "fix mean all continuum/weighted kernel_radius 0.1 kernel_type Wendland "
                      "compute stress"},
                 {"Fix continuum/weighted (id mean)", "no forces", "compute pair/gran/local"}},
        BadInput{"PlaneInAPeriodicDirection",
                 {"boundary f f f", "boundary p p p"},
                 {"Fix wall/gran (id floor)", "periodic direction z"}},
        BadInput{"CylinderOverAPeriodicFace",
                 {"",
                  "change_box all boundary p f f\nfix vessel all wall/gran model linear "
                  "tangential history surface spherocylinder primitive type 1 zcylinder 0.6 0 0"},
                 {"Fix wall/gran (id vessel)", "from -0.6 to 0.6", "-0.5 to 0.5"}},
        BadInput{"CylinderOfNegativeRadius",
                 {"", "fix vessel all wall/gran model linear tangential history surface "
                      "spherocylinder primitive type 1 zcylinder -0.2 0 0"},
                 {"Fix wall/gran (id vessel)", "radius must be > 0", "-0.2"}},
        BadInput{"CylinderThinnerThanARod",
                 {"", "fix vessel all wall/gran model linear tangential history surface "
                      "spherocylinder primitive type 1 zcylinder 0.004 0 0"},
                 {"Fix wall/gran (id vessel)", "0.004", "thickest rod (got 0.005)"}},
        BadInput{"KeywordWithoutValue",
                 {"history surface spherocylinder\npair_coeff",
                  "history surface spherocylinder limitForce\npair_coeff"},
                 {"Surface spherocylinder", "each have a value", "limitForce"}},
        BadInput{"SearchOfNoKind",
                 {"history surface spherocylinder\npair_coeff",
                  "history surface spherocylinder search fast\npair_coeff"},
                 {"Surface spherocylinder", "search must be exact or five_step", "got fast"}},
        BadInput{"SearchWithoutValue",
                 {"history surface spherocylinder\npair_coeff",
                  "history surface spherocylinder search\npair_coeff"},
                 {"Surface spherocylinder", "search must be exact or five_step", "got nothing"}},
        BadInput{"EffectiveMassOfNoKind",
                 {"history surface spherocylinder\npair_coeff",
                  "history surface spherocylinder effective_mass maybe\npair_coeff"},
                 {"effective_mass", "maybe"}},
        BadInput{"EffectiveMassOfNoKindAtAWall",
                 {"zplane 0.0", "zplane 0.0 effective_mass maybe"},
                 {"effective_mass", "maybe"}},
        BadInput{"PrimitiveWithoutType",
                 {"", "fix vessel all wall/gran model linear tangential history surface "
                      "spherocylinder primitive type"},
                 {"Fix wall/gran (id vessel)", "primitive must be followed by", "got 1 words"}},
        BadInput{"NegativeFriction",
                 {"peratomtypepair 1 0.3", "peratomtypepair 1 -0.2"},
                 {"coefficientFriction must be >= 0", "-0.2"}},
        BadInput{"WallDefinedTwice",
                 {"", "fix floor all wall/gran model linear tangential history surface "
                      "spherocylinder primitive type 1 zplane 0.1"},
                 {"Fix wall/gran (id floor)", "unfix it first"}},
        BadInput{"NegativeTimeStep",
                 {"timestep 1e-5", "timestep -1e-5"},
                 {"time step must be > 0", "-1e-05"}},
        BadInput{"ReplicateAfterRestart",
                 {"",
                  "run 1\nwrite_restart r\nclear\natom_style spherocylinder\natom_modify map "
                  "array\nnewton off\ncommunicate single vel yes\nread_restart r\nreplicate 2 1 1 "
                  "offset 2 2 2 shift 0 0 0"},
                 {"Replicate must come after the first run"}},
        BadInput{"ReplicateWithSpringSelf",
                 {"", "fix home all spring/self 10.0\nreplicate 2 1 1 offset 2 2 2 shift 0 0 0"},
                 {"Replicate", "fix spring/self (id home)", "after replicate"}},
        BadInput{"IntervalNotWhole",
                 {"", "fix check all check/timestep/spherocylinder 2.5 0.2"},
                 {"Fix check/timestep/spherocylinder (id check)", "whole number", "2.5"}},
        BadInput{"TurnRateNotANumber",
                 {"zplane 0.0\n", "zplane 0.0 turn fast 0 0\n"},
                 {"Fix wall/gran (id floor)", "rate of turn must be a number", "fast"}},
        BadInput{"DumpFormatTooShort",
                 {"", "dump d all custom 1 dump.d id x y\ndump_modify d format \"%d %g\""},
                 {"Dump custom (id d)", "3 columns", "got 2"}},
        BadInput{"NoRods", {"", "delete_atoms group all"}, {"Atom style spherocylinder", "no rod"}},
        BadInput{"AtomStyleWithArguments",
                 {"atom_style spherocylinder", "atom_style spherocylinder 10"},
                 {"atom_style spherocylinder", "no arguments"}},
        BadInput{"NoIntegrator",
                 {"fix motion all nve/spherocylinder\n", ""},
                 {"no integrator", "nve/spherocylinder"}},
        BadInput{"IntegratorOfSpheres",
                 {"fix motion all nve/spherocylinder", "fix motion all nve/sphere"},
                 {"Fix nve/sphere (id motion)", "atom_style spherocylinder", "nve/spherocylinder"}},
        BadInput{"IntegratedTwiceInOverlappingGroups",
                 {"", "group first id 1\nfix again first nve/spherocylinder"},
                 {"again", "first", "1 rods", "motion", "one"}},
        BadInput{"IntegratedByPointsToo",
                 {"", "fix points all nve"},
                 {"Fix nve (id points)", "axes", "nve/spherocylinder"}},
        BadInput{"LimitNotANumber",
                 {"", "fix lim all limit/omega ten"},
                 {"Fix limit/omega (id lim)", "omega must be a number", "got ten"}},
        BadInput{"LimitZero",
                 {"", "fix lim all limit/omega 0"},
                 {"Fix limit/omega (id lim)", "must be > 0", "got 0"}},
        BadInput{"LimitNegative",
                 {"", "fix lim all limit/omega -1"},
                 {"Fix limit/omega (id lim)", "must be > 0", "got -1"}},
        BadInput{"LimitMissing",
                 {"", "fix lim all limit/omega"},
                 {"limit/omega (id lim)", "limit"}},
        BadInput{"LimitKeywordUnknown",
                 {"", "fix lim all limit/omega 4 part axial"},
                 {"Fix limit/omega (id lim)", "part", "component"}},
        BadInput{"LimitComponentUnknown",
                 {"", "fix lim all limit/omega 4 component radial"},
                 {"Fix limit/omega (id lim)", "total, transverse or axial", "got radial"}},
        BadInput{"LimitComponentMissing",
                 {"", "fix lim all limit/omega 4 component"},
                 {"Fix limit/omega (id lim)", "total, transverse or axial"}},
        BadInput{"RestWithoutGravity",
                 {"", "fix rested all rest/spherocylinder 10"},
                 {"Fix rest/spherocylinder (id rested)", "requires a fix gravity"}},
        BadInput{"RestIntervalMissing",
                 {"", "fix rested all rest/spherocylinder"},
                 {"rest/spherocylinder (id rested)", "interval in steps"}},
        BadInput{"RestIntervalZero",
                 {"", "fix rested all rest/spherocylinder 0"},
                 {"rest/spherocylinder (id rested)", ">= 1 step", "got 0"}},
        BadInput{"RestKeywordUnknown",
                 {"", "fix rested all rest/spherocylinder 10 speed 1"},
                 {"rest/spherocylinder (id rested)", "speed", "energy, unbalanced or window"}},
        BadInput{"RestEnergyZero",
                 {"", "fix rested all rest/spherocylinder 10 energy 0"},
                 {"rest/spherocylinder (id rested)", "energy must be > 0", "got 0"}},
        BadInput{"RestWindowMissing",
                 {"", "fix rested all rest/spherocylinder 10 window"},
                 {"rest/spherocylinder (id rested)", "window must be a number", "got nothing"}},
        BadInput{"IntegratorWithArguments",
                 {"all nve/spherocylinder", "all nve/spherocylinder fast"},
                 {"nve/spherocylinder", "motion", "fast", "expected rotation"}},
        BadInput{
            "IntegratorWithAnotherRotation",
            {"all nve/spherocylinder", "all nve/spherocylinder rotation euler"},
            {"nve/spherocylinder (id motion)", "rotation must be exact or plain", "got euler"}},
        BadInput{
            "IntegratorWithNoRotation",
            {"all nve/spherocylinder", "all nve/spherocylinder rotation"},
            {"nve/spherocylinder (id motion)", "rotation must be exact or plain", "got nothing"}},
        BadInput{"RodsOutsideACylinder",
                 {"zplane 0.0", "zcylinder 0.05 0.08 0.0"},
                 {"wall/gran (id floor)", "the axis of rod 1 is across the cylinder"}},
        BadInput{"PrimitiveUnknown", {"zplane 0.0", "zcone 0.0"}, {"wall/gran", "floor"}},
        BadInput{"MeshWall",
                 {"primitive type 1 zplane 0.0", "mesh n_meshes 1 meshes nothing"},
                 {"wall/gran", "floor", "mesh"}},
        BadInput{"NewtonOn", {"newton off", "newton on"}, {"newton", "off"}},
        BadInput{"NoGhostVelocities",
                 {"communicate single vel yes\n", ""},
                 {"ghost atoms store velocity"}},
        BadInput{"SetDiameter",
                 {"", "set group all diameter 0.2"},
                 {"set", "length of rod", ">= the diameter 0.2", "got 0.1"}},
        BadInput{"DiameterAdapted",
                 {"", "variable d equal 0.1+0.0001*step\nfix grow all adapt 10 atom diameter v_d"},
                 {"Fix adapt (id grow)", "bounding sphere", "set"}},
        BadInput{"SetMass", {"", "set group all mass 2.0"}, {"mass", "rods", "set density"}},
        BadInput{
            "CapillaryCohesion",
            {"pair_style gran model linear tangential history",
             "pair_style gran model linear tangential history cohesion easo/capillary/viscous"},
            {"urface spherocylinder", "capillary"}},
        BadInput{"OtherPairStyle",
                 {"pair_style gran model linear tangential history surface spherocylinder\n"
                  "pair_coeff * *",
                  "pair_style soft 0.1\npair_coeff * * 1.0"},
                 {"spherocylinder", "pair_style"}},
        BadInput{"ComputeWithArguments",
                 {"", "compute er all erotate/spherocylinder fast"},
                 {"erotate/spherocylinder", "er", "fast"}},
        BadInput{"ContactsHeatFlux",
                 {"", "compute c all pair/gran/local id heatFlux"},
                 {"Compute pair/gran/local (id c)", "heatFlux", "f_heatFlux"}},
        BadInput{"ContactsKeywordUnknown",
                 {"", "compute c all pair/gran/local id normals"},
                 {"pair/gran/local", "keyword"}},
        BadInput{"WallContactsBeforeTheWall",
                 {"fix floor", "compute c all wall/gran/local id\nfix floor"},
                 {"Compute wall/gran/local (id c)", "fix wall/gran", "before"}},
        BadInput{"TwoDimensions",
                 {"atom_style spherocylinder", "dimension 2\natom_style spherocylinder"},
                 {"spherocylinder", "3d"}}),
    input_name);

INSTANTIATE_TEST_SUITE_P(
    , BadInsertion,
    testing::Values(
        BadInput{"LengthBelowDiameter",
                 {"length constant 0.1", "length constant 0.008"},
                 {"particletemplate/spherocylinder (id rod)", "length", ">= the diameter 0.01",
                  "got 0.008"}},
        BadInput{"RadiusZero",
                 {"radius constant 0.005", "radius constant 0"},
                 {"particletemplate/spherocylinder (id rod)", "radius must be > 0", "got 0"}},
        BadInput{"RadiusNegative",
                 {"radius constant 0.005", "radius constant -0.005"},
                 {"particletemplate/spherocylinder (id rod)", "radius must be > 0", "got -0.005"}},
        BadInput{"LengthNegative",
                 {"length constant 0.1", "length constant -0.1"},
                 {"particletemplate/spherocylinder (id rod)", "length must be > 0", "got -0.1"}},
        BadInput{"LengthMissing",
                 {"length constant 0.1 ", ""},
                 {"particletemplate/spherocylinder (id rod)", "length"}},
        BadInput{
            "LengthRandom",
            {"length constant 0.1", "length uniform 0.1 0.2"},
            {"particletemplate/spherocylinder (id rod)", "length must be constant", "got uniform"}},
        BadInput{"DensityZero",
                 {"density constant 2700", "density constant 0"},
                 {"particletemplate/spherocylinder", "rod", "density"}},
        BadInput{"KeywordUnknown",
                 {"all_in_region vessel", "inside vessel"},
                 {"particletemplate/spherocylinder (id rod)", "inside"}},
        BadInput{"RegionUnknown",
                 {"all_in_region vessel", "all_in_region pot"},
                 {"particletemplate/spherocylinder (id rod)", "region pot", "not exist"}},
        BadInput{
            "SeedTooSmall",
            {"particletemplate/spherocylinder 15485863", "particletemplate/spherocylinder 101"},
            {"seed", "> 10000", "prime"}},
        BadInput{"SeedNotPrime",
                 {"particletemplate/spherocylinder 15485863",
                  "particletemplate/spherocylinder 15485864"},
                 {"seed", "> 10000", "prime"}},
        BadInput{
            "RegionTooNarrow",
            {"region vessel block -0.2 0.2 -0.2 0.2", "region vessel block -0.2 0.2 -0.004 0.004"},
            {"particletemplate/spherocylinder (id rod)", "region vessel", "0.008", "0.01"}},
        BadInput{"RegionTooShort",
                 {"region vessel block -0.2 0.2 -0.2 0.2 0.0 0.4",
                  "region vessel block -0.02 0.02 -0.02 0.02 0.1 0.14"},
                 {"particletemplate/spherocylinder (id rod)", "region vessel", "0.1"}},
        BadInput{"TooManyRods",
                 {"particles_in_region 20", "particles_in_region 5000"},
                 {"particletemplate/spherocylinder (id rod)", "pack", "of 5000 rods"}},
        BadInput{"AtomStyleHybrid",
                 {"atom_style spherocylinder", "atom_style hybrid spherocylinder sphere"},
                 {"hybrid", "atom_style spherocylinder", "alone"}},
        BadInput{
            "RadiusRandom",
            {"radius constant 0.005", "radius uniform 0.005 0.006"},
            {"particletemplate/spherocylinder (id rod)", "radius must be constant", "got uniform"}},
        BadInput{"TemplateOfSpheres",
                 {"particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 &\n"
                  "  radius constant 0.005 length constant 0.1 all_in_region vessel",
                  "particletemplate/sphere 15485863 atom_type 1 density constant 2700 radius "
                  "constant 0.005"},
                 {"particletemplate/sphere (id rod)", "particletemplate/spherocylinder"}}),
    input_name);

// The surface model, the integrator and the template on spheres.
TEST(BadInput, RodStylesNeedTheRodsAtomStyle)
{
  const std::string spheres_deck =
      edited(kGoodDeck, {"atom_style spherocylinder", "atom_style sphere"});
  const std::string spheres_data =
      "two\n\n2 atoms\n1 atom types\n-0.5 0.5 xlo xhi\n-0.5 0.5 ylo yhi\n"
      "-0.5 0.5 zlo zhi\n\nAtoms\n\n1 1 0.01 2700 0 0 0.2\n"
      "2 1 0.01 2700 0 0.1 0.2\n";
  expect_refused(spheres_deck, spheres_data,
                 {"Fix nve/spherocylinder", "atom_style spherocylinder", "got sphere"});
  const std::string stock_integrator = edited(spheres_deck, {"nve/spherocylinder", "nve/sphere"});
  expect_refused(stock_integrator, spheres_data,
                 {"surface spherocylinder", "atom_style spherocylinder", "got sphere"});
  expect_refused(edited(stock_integrator, {"", "fix lim all limit/omega 4"}), spheres_data,
                 {"limit/omega", "atom_style spherocylinder", "got sphere"});
  expect_refused(edited(stock_integrator, {"", "compute er all erotate/spherocylinder"}),
                 spheres_data,
                 {"erotate/spherocylinder", "atom_style spherocylinder", "got sphere"});
  expect_refused(edited(kGoodInsertion, {"atom_style spherocylinder", "atom_style sphere"}), "",
                 {"spherocylinder", "atom_style spherocylinder", "got sphere"});
}

// Two rods that touch, and a step of 1e-3 s where 2 sqrt(m_eff/k)/10 is about 5e-5 s: a warning
// with the limit, and the run goes on.
TEST(BadInput, RodLongerThanThePeriodWouldTouchItself)
{
  const std::string deck = edited(kGoodDeck, {"boundary f f f", "boundary p p f"});
  expect_refused(deck, edited(kGoodData, {"1 1 0.01 0.1", "1 1 0.01 1.1"}),
                 {"periodic in x with 1", "longest rod's length 1.1"});
}

TEST(BadInput, StageThatDoesNotFitItsBed)
{
  const DeckFolder folder;
  for (const char *name : {"in.rods", "in.contact", "in.fill", "in.settle"})
    std::filesystem::copy(std::filesystem::path(INPUT_FOLDER) / name, folder / name);
  folder.write("in.pour",
               "variable rods index 5\nvariable fill_time index 1e-4\ninclude in.fill\n");
  EXPECT_EQ(folder.run("in.pour").exit_code, 0);
  folder.write("in.other", "variable lambda index 30\ninclude in.settle\n");
  const Outcome outcome = folder.run("in.other");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("poured with rods of length 0.1"), std::string::npos)
      << outcome.output;
}

TEST(BadInput, ValuesOfTheStudysDecks)
{
  const DeckFolder folder;
  for (const char *name : {"in.rods", "in.contact", "in.fill"})
    std::filesystem::copy(std::filesystem::path(INPUT_FOLDER) / name, folder / name);
  for (const auto &[variable, sentence] :
       {std::pair{"quick index 2", "quick must be 0 or 1 (got 2)"},
        {"skin_diameters index 0", "skin_diameters must be > 0 (got 0)"}}) {
    folder.write("in.pour", std::string("variable ") + variable + "\ninclude in.fill\n");
    const Outcome outcome = folder.run("in.pour");
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.output.find(std::string("ERROR: in.rods: ") + sentence), std::string::npos)
        << outcome.output;
  }
}

TEST(BadInput, TimeStepFarTooLongIsWarnedAbout)
{
  const DeckFolder folder;
  folder.write("in.warn", edited(kGoodDeck, {"timestep 1e-5", "timestep 1e-3"}));
  folder.write("rods.data",
               edited(kGoodData, {"1 1 0.01 0.1 2700 0 0 0.2", "1 1 0.01 0.1 2700 0 0 0.0049"}));
  const Outcome outcome = folder.run("in.warn");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  expect_line(outcome.output, "WARNING", {"time step 0.001", "recommended", "limit", "rod 1"});
  EXPECT_EQ(lines_with(outcome.output, "time step 0.001").size(), 1u) << "once a run";

  // Whichever of a pair style and several walls sees it first.
  const std::string floor = " all wall/gran model linear tangential history surface spherocylinder "
                            "primitive type 1 zplane ";
  folder.write("in.walls", edited(edited(kGoodDeck, {"timestep 1e-5", "timestep 1e-3"}),
                                  {"fix motion all", "fix one" + floor + "1e-4\nfix two" + floor +
                                                         "2e-4\nfix motion all"}));
  EXPECT_EQ(lines_with(folder.run("in.walls").output, "time step 0.001").size(), 1u);
}

// A rod of 0.1 m that stands with its centre 0.02 m above a floor reaches 0.03 m, three diameters,
// through it: placed so by the data file, or by an insertion whose region begins at the floor. One that
// hits a soft floor goes in step by step.
TEST(BadInput, RodsPlacedThroughAWallAreToldFromHardImpacts)
{
  const std::string placed = "the rod was placed through the wall", hit = "use a stiffer contact";
  const auto warning = [](const std::string &deck, const std::string &data) {
    const DeckFolder folder;
    folder.write("in.wall", deck);
    folder.write("rods.data", data);
    const Outcome outcome = folder.run("in.wall");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return lines_with(outcome.output, "overlap by");
  };
  const std::string data = edited(kGoodData, {"0 0 0.2 1 0 0", "0 0 0.02 0 0 1"});
  const auto by_file = warning(kGoodDeck, data);
  ASSERT_EQ(by_file.size(), 1u);
  EXPECT_NE(by_file[0].find("rod 1 and a wall overlap by 3"), std::string::npos) << by_file[0];
  EXPECT_NE(by_file[0].find(placed), std::string::npos) << by_file[0];

  std::string deck = edited(kGoodInsertion, {" all_in_region vessel", ""});
  deck = edited(deck, {"vessel block -0.2 0.2 -0.2 0.2 0.0", "vessel block -0.2 0.2 -0.2 0.2 0.1"});
  deck = edited(deck, {"fix motion all",
                       "fix floor all wall/gran model linear tangential history surface "
                       "spherocylinder primitive type 1 zplane 0.1\nfix motion all"});
  const auto by_insertion = warning(deck, kGoodData);
  ASSERT_GE(by_insertion.size(), 1u);
  EXPECT_NE(by_insertion[0].find(placed), std::string::npos) << by_insertion[0];

  // v sqrt(m/k) = 0.9 diameters: 0.0205 kg, 1e5 N/m on one contact in the middle, 20 m/s; v dt = 0.02
  // diameters.
  const auto by_motion = warning(edited(kGoodDeck, {"run 10", "velocity all set 0 0 -20\nrun 80"}),
                                 edited(kGoodData, {"0 0 0.2 1 0 0", "0 0 0.056 0 0 1"}));
  ASSERT_EQ(by_motion.size(), 1u);
  EXPECT_NE(by_motion[0].find(hit), std::string::npos) << by_motion[0];
}

// A wrong deck must end all ranks, not hang.
TEST(BadInput, EndsAllRanks)
{
  const DeckFolder folder;
  folder.write("in.bad", kGoodDeck);
  folder.write("rods.data", edited(kGoodData, {"0 0.6 0.8", "0 0.6 0.6"}));
  const Outcome outcome = folder.run("in.bad", {Program::Lmp, 2});
  EXPECT_NE(outcome.exit_code, 0);
  expect_line(outcome.output, "ERROR", {"atom 2", "axis"});
}

}  // namespace
