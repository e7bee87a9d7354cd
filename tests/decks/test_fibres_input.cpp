// SPDX-License-Identifier: GPL-2.0-or-later
// Wrong fibres: the program ends with one sentence that says who, what, the value seen and the one wanted.
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "deck_run.h"

using namespace decks;

namespace {

// Three rods end to end along x, h = 0.02, and one beside them.
const char *const kData = R"(a fibre

4 atoms
3 segments
1 atom types
-0.5 0.5 xlo xhi
-0.5 0.5 ylo yhi
-0.5 0.5 zlo zhi

Atoms

1 1 0.004 0.024 1000 0.00 0 0 1 0 0
2 1 0.004 0.024 1000 0.02 0 0 1 0 0
3 1 0.004 0.024 1000 0.04 0 0 1 0 0
4 1 0.004 0.024 1000 0.20 0 0 0 1 0

Fibres

1 1 1
2 1 2
3 1 3
)";

const char *const kDeck = R"(atom_style spherocylinder
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
read_data rods.data
neighbor 0.002 bin
neigh_modify delay 0
fix kn all property/global kn peratomtypepair 1 1e3
fix kt all property/global kt peratomtypepair 1 1e3
fix e all property/global coefficientRestitution peratomtypepair 1 0.5
fix mu all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model linear tangential history surface spherocylinder
pair_coeff * *
fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3 damping 0.1
fix motion all nve/spherocylinder
timestep 1e-5
run 10
)";

struct Mistake {
  const char *name;
  bool in_data;
  const char *find, *replace, *says;
};

void PrintTo(const Mistake &mistake, std::ostream *out) { *out << mistake.name; }

class FibreInput : public testing::TestWithParam<Mistake> {};

std::string edited(const char *text, const char *find, const char *replace)
{
  std::string result = text;
  const size_t at = result.find(find);
  EXPECT_NE(at, std::string::npos) << find;
  return at == std::string::npos ? result : result.replace(at, std::string(find).size(), replace);
}

TEST(FibreDeck, RightOneRuns)
{
  const DeckFolder folder;
  folder.write("rods.data", kData);
  folder.write("in.fibre", kDeck);
  const Outcome outcome = folder.run("in.fibre");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("2 joints of fibres"), std::string::npos);
}

TEST_P(FibreInput, EndsWithOneSentence)
{
  const Mistake &mistake = GetParam();
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    folder.write("rods.data",
                 mistake.in_data ? edited(kData, mistake.find, mistake.replace) : kData);
    folder.write("in.fibre",
                 mistake.in_data ? kDeck : edited(kDeck, mistake.find, mistake.replace));
    const Outcome outcome = folder.run("in.fibre", {Program::Lmp, ranks});
    EXPECT_NE(outcome.exit_code, 0) << outcome.output;
    EXPECT_LT(outcome.exit_code, 128) << outcome.output;
    EXPECT_NE(outcome.output.find(mistake.says), std::string::npos) << outcome.output;
  }
}

// Of a fibre without its middle two parts are left, whose places have a gap.
TEST(FibreDeck, WhatIsLeftOfAFibreIsReadAgain)
{
  const DeckFolder folder;
  folder.write("rods.data", kData);
  folder.write("in.cut", std::string(kDeck) +
                             "group middle id 2\ndelete_atoms group middle\nrun 1\n"
                             "write_data left.data\n");
  ASSERT_EQ(folder.run("in.cut").exit_code, 0);
  folder.write("in.fibre", edited(kDeck, "read_data rods.data", "read_data left.data"));
  const Outcome outcome = folder.run("in.fibre");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

// As write_data has them, but one: which ends are joined, the orientation, the joint without load.
TEST(FibreDeck, JointsHaveTwoEnds)
{
  const char *const turn = " 0.70710678118654757 0 0.70710678118654757 0 0 0 0\n";
  const struct {
    const char *ends[3], *says;  // nothing: they are right
  } cases[] = {
      {{"74", "79", "69"}, ""},
      {{"74", "78", "69"},
       "the head of rod 1, place 1 of fibre 1, is joined and the tail of the next is free"},
      {{"72", "79", "69"},
       "the head of rod 1, place 1 of fibre 1, is free and the tail of the next is joined"},
      {{"74", "79", "71"},
       "the head of rod 3, place 3 of fibre 1, is joined and the tail of the next is free"},
      {{"75", "79", "69"},
       "the head of rod 3, place 3 of fibre 1, is free and the tail of the next is joined"},
  };
  for (const auto &tried : cases) {
    const std::string section = std::string("1 1 1 ") + tried.ends[0] + turn + "2 1 2 " +
                                tried.ends[1] + turn + "3 1 3 " + tried.ends[2] + turn;
    const DeckFolder folder;
    folder.write("rods.data", edited(kData, "1 1 1\n2 1 2\n3 1 3\n", section.c_str()));
    folder.write("in.fibre", kDeck);
    const Outcome outcome = folder.run("in.fibre");
    EXPECT_EQ(outcome.exit_code == 0, !*tried.says) << outcome.output;
    EXPECT_NE(outcome.output.find(tried.says), std::string::npos) << outcome.output;
  }
}

TEST(FibreDeck, JointsAreNotTurnedRoundWithoutLoad)
{
  for (const char *rest : {"rest_curvature 1e4", "rest_twist -200"}) {
    const DeckFolder folder;
    folder.write("rods.data", kData);
    folder.write("in.fibre", edited(kDeck, "damping 0.1", rest));
    const Outcome outcome = folder.run("in.fibre");
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.output.find("degrees; wanted less than 179 of either"), std::string::npos)
        << outcome.output;
  }
}

// Of the keyword join: what meets is joined, but not three ends at a point, nor two rods at both ends.
TEST(FibreJoin, EndsWithOneSentence)
{
  const std::string start = R"(a star

3 atoms
1 atom types
-0.5 0.5 xlo xhi
-0.5 0.5 ylo yhi
-0.5 0.5 zlo zhi

Atoms

1 1 0.004 0.024 1000 0.01 0 0 1 0 0
)";
  const struct {
    const char *rods, *says;
  } cases[] = {{"2 1 0.004 0.024 1000 0 0.01 0 0 1 0\n3 1 0.004 0.024 1000 0 0 0.01 0 0 1\n",
                "meet within 1e-05 diameters; wanted two at a joint"},
               {"2 1 0.004 0.024 1000 0.01 0 0 1 0 0\n3 1 0.004 0.024 1000 0 0.2 0 0 0 1\n",
                "rods 1 and 2 meet at both their ends"}};
  for (const auto &wrong : cases) {
    const DeckFolder folder;
    folder.write("rods.data", start + wrong.rods);
    folder.write("in.fibre", edited(kDeck, "damping 0.1", "join 1e-5"));
    const Outcome outcome = folder.run("in.fibre");
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.output.find(wrong.says), std::string::npos) << outcome.output;
  }
}

// What goes with joints, without the fix that holds them.
TEST(FibreAlone, EndsWithOneSentence)
{
  const std::string data = kData;
  const size_t header = data.find("3 segments\n"), section = data.find("Fibres");
  const std::string rods = data.substr(0, header) + data.substr(header + 11, section - header - 11);
  const struct {
    const char *line, *says;
  } cases[] = {
      {"compute j all joint/spherocylinder/local",
       "Compute joint/spherocylinder/local (id j): no fix holds joints (expected fix ID all "
       "joint/spherocylinder)"},
      {"fix h all hinge/spherocylinder tail",
       "Fix hinge/spherocylinder (id h): without fix joint/spherocylinder, whose stiffness "
       "it would have, a hinge wants the keyword stiffness"}};
  for (const auto &wrong : cases) {
    const DeckFolder folder;
    folder.write("rods.data", rods);
    std::string deck =
        edited(kDeck, "damping 0.1\n",
               std::string("damping 0.1\nunfix joints\n" + std::string(wrong.line) + "\n").c_str());
    folder.write("in.fibre", deck);
    const Outcome outcome = folder.run("in.fibre");
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.output.find(wrong.says), std::string::npos) << outcome.output;
  }
}

constexpr const char *kModuli = "youngsModulus 1e7 poissonsRatio 0.3 damping 0.1";

INSTANTIATE_TEST_SUITE_P(
    , FibreInput,
    testing::Values(
        // The data file.
        Mistake{"SegmentOfNoAtom", true, "3 1 3\n", "7 1 3\n",
                "line 21, atom 7: no such id in the Atoms section"},
        Mistake{"AtomTwice", true, "3 1 3\n", "2 1 3\n",
                "atom 2: its fibre has been given in line 20 already"},
        Mistake{
            "JointTwice", true, "3 1 3\n", "3 1 2\n",
            "atom 3: place 2 of fibre 1 has been given in line 20 already, a joint would be named "
            "twice"},
        Mistake{"NoFibreId", true, "3 1 3\n", "3 0 3\n", "fibre must be an integer >= 1 (got 0)"},
        Mistake{"NoPlace", true, "3 1 3\n", "3 1\n", "2 columns, wanted 3 or 11: id fibre place"},
        Mistake{"NotAPlace", true, "3 1 3\n", "3 1 last\n",
                "place must be an integer >= 1 (got last)"},
        Mistake{"Gap", true, "3 1 3\n", "3 1 4\n",
                "fibre 1 has no rod at place 3, the next is rod 3 at place 4; wanted places from 1 "
                "without a gap"},
        Mistake{"NoHeader", true, "3 segments\n", "",
                "the header must say how many lines the Fibres section has"},
        Mistake{"TooFewLines", true, "3 1 3\n", "",
                "the file ends after 2 of 3 lines of the Fibres section"},
        Mistake{
            "DoNotMeet", true, "3 1 0.004 0.024 1000 0.04", "3 1 0.004 0.024 1000 0.041",
            "rods 2 and 3, places 2 and 3 of fibre 1, do not meet: the nearest of their ends' centres "
            "are 0.001 apart, wanted at most 4e-06 (0.001 diameters)"},
        Mistake{"OtherDiameter", true, "3 1 0.004 0.024 1000 0.04 0 0",
                "3 1 0.005 0.025 1000 0.04 0 0",
                "rods 2 and 3 are joined and must have the same diameter (got 0.004 and 0.005)"},
        Mistake{
            "TooShort", true, "3 1 0.004 0.024 1000 0.04 0 0", "3 1 0.004 0.005 1000 0.0305 0 0",
            "the joints of a segment must be at least its radius 0.002 apart (got 0.001 for rod "
            "3)"},
        Mistake{"Folded", true, "3 1 0.004 0.024 1000 0.04 0 0", "3 1 0.004 0.064 1000 0 0 0",
                "rods 2 and 3 are folded onto each other at their joint"},
        Mistake{"ElevenColumns", true, "3 1 3\n", "3 1 3 0 1 0 0 0 0 0 0\n",
                "11 columns, wanted 3 as in the lines before"},
        // The fix.
        Mistake{"ZeroModulus", false, "youngsModulus 1e7", "youngsModulus 0",
                "youngsModulus must be > 0 (got 0)"},
        Mistake{"NegativeModulus", false, "youngsModulus 1e7", "youngsModulus -1e7",
                "Fix joint/spherocylinder (id joints): youngsModulus must be > 0 (got -1e7)"},
        Mistake{"NotANumber", false, "youngsModulus 1e7", "youngsModulus stiff",
                "youngsModulus must be a number (got stiff)"},
        Mistake{"PoissonsRatio", false, "poissonsRatio 0.3", "poissonsRatio 0.6",
                "poissonsRatio must be <= 0.5 (got 0.6)"},
        Mistake{"LowPoissonsRatio", false, "poissonsRatio 0.3", "poissonsRatio -1",
                "poissonsRatio must be > -1 (got -1)"},
        Mistake{"NoModulus", false, "youngsModulus 1e7 ", "",
                "no youngsModulus is given; wanted the keyword or fix ID all property/global "
                "youngsModulus peratomtype"},
        Mistake{"ZeroModulusOfType", false, "fix joints all joint/spherocylinder youngsModulus 1e7",
                "fix E all property/global youngsModulus peratomtype -5\n"
                "fix joints all joint/spherocylinder",
                "youngsModulus of atom type 1 must be > 0 (got -5)"},
        Mistake{"ZeroBendFactor", false, kModuli,
                "youngsModulus 1e7 poissonsRatio 0.3 bend_factor 0",
                "bend_factor must be > 0 (got 0)"},
        Mistake{"StretchFactor", false, kModuli,
                "youngsModulus 1e7 poissonsRatio 0.3 stretch_factor -1",
                "stretch_factor must be > 0 (got -1)"},
        Mistake{"Damping", false, "damping 0.1", "damping -0.1", "damping must be >= 0 (got -0.1)"},
        Mistake{"Keyword", false, "damping 0.1", "dampning 0.1", "unknown keyword dampning"},
        Mistake{"NoValue", false, "damping 0.1", "damping",
                "damping must be a number (got nothing)"},
        Mistake{"Rest", false, "damping 0.1", "rest bent",
                "rest must be straight or present (got bent)"},
        Mistake{"RestTwice", false, "damping 0.1", "rest present rest_curvature 2",
                "rest present leaves no room for rest_curvature and rest_twist"},
        Mistake{"YieldTwice", false, "damping 0.1", "yield_stress 1e5 yield_moment 1e-4",
                "yield_stress and yield_moment say the same; wanted one of them"},
        Mistake{"YieldStress", false, "damping 0.1", "yield_stress 0",
                "yield_stress must be > 0 (got 0)"},
        Mistake{"YieldMoment", false, "damping 0.1", "yield_moment -1e-4",
                "yield_moment must be > 0 (got -1e-4)"},
        Mistake{"TensileStrength", false, "damping 0.1", "tensile_strength 0",
                "tensile_strength must be > 0 (got 0)"},
        Mistake{"BendingStrength", false, "damping 0.1", "bending_strength high",
                "bending_strength must be a number (got high)"},
        // Its compute and hinges.
        Mistake{
            "LocalValue", false, "run 10",
            "compute j all joint/spherocylinder/local moment\nrun 10",
            "Compute joint/spherocylinder/local (id j): unknown value moment (expected any of id1"},
        Mistake{"HingeEnd", false, "run 10", "fix h all hinge/spherocylinder both\nrun 10",
                "Fix hinge/spherocylinder (id h): the end must be tail, head or free (got both)"},
        Mistake{"HingeNoEnd", false, "run 10", "fix h all hinge/spherocylinder\nrun 10",
                "the end must be tail, head or free (got nothing)"},
        Mistake{"HingeKeyword", false, "run 10", "fix h all hinge/spherocylinder tail k 1\nrun 10",
                "unknown keyword k (expected stiffness, damping or velocity)"},
        Mistake{"HingeStiffness", false, "run 10",
                "fix h all hinge/spherocylinder tail stiffness 0\nrun 10",
                "stiffness must be > 0 (got 0)"},
        Mistake{"HingeDamping", false, "run 10",
                "fix h all hinge/spherocylinder tail damping -1\nrun 10",
                "damping must be >= 0 (got -1)"},
        Mistake{"HingeVelocity", false, "run 10",
                "fix h all hinge/spherocylinder tail velocity 1 0\nrun 10",
                "velocity must be a number (got nothing)"},
        Mistake{"HingeInTheMiddle", false, "run 10",
                "group m id 2\nfix h m hinge/spherocylinder free\nrun 10",
                "rod 2 has no free end, which is to be held is not told"},
        Mistake{"HingeOfOneRod", false, "run 10",
                "group m id 4\nfix h m hinge/spherocylinder free\nrun 10",
                "rod 4 has two free ends, which is to be held is not told"},
        Mistake{"Join", false, "damping 0.1", "join 2", "join must be <= 0.5 diameters (got 2)"},
        Mistake{
            "TwoFixes", false, "fix motion",
            "fix more all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3\nfix motion",
            "fix joint/spherocylinder (id joints) holds the joints already, a joint would be named "
            "twice"},
        Mistake{"CutByTheGroup", false, "fix joints all", "group some id 1 2 4\nfix joints some",
                "rod 3 of fibre 1 is not in group some, which would cut the fibre"},
        Mistake{"NoFix", false, "fix joints all", "#",
                "3 rods are segments of fibres, but no fix holds them together"},
        Mistake{"NoIntegrator", false, "fix motion all nve/spherocylinder", "",
                "no integrator is defined, rods would not move (expected fix ID group "
                "nve/spherocylinder)"},
        Mistake{"NoGhostVelocities", false, "communicate single vel yes\nunits si",
                "communicate single vel no\nunits si", "elocit"},
        Mistake{"PulledApart", false, "run 10",
                "displace_atoms all move 0 0 0\nset atom 3 x 0.2\nrun 10",
                "the rod that rod 2, place 2 of fibre 1, is joined to at its head is not at hand"},
        Mistake{"DiameterLater", false, "run 10", "set atom 3 diameter 0.005 length 0.025\nrun 10",
                "rods 2 and 3 are joined and must have the same diameter (got 0.004 and 0.005)"},
        Mistake{"TimeStep", false, "timestep 1e-5\nrun 10",
                "fix step all check/timestep/spherocylinder 1 0.5 error yes\ntimestep 4e-4\nrun 10",
                "allowed is 0.5 of it"}),
    [](const auto &info) { return std::string(info.param.name); });

}  // namespace
