// SPDX-License-Identifier: GPL-2.0-or-later
// Data files with a mistake: the run ends with one sentence that names file, line, atom and word, on any
// number of ranks; files without one are read whole.
#include <cstdlib>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

// Lines are counted from 1: the first rod is line 10, the first velocity line 15.
const char *const kData = R"(three rods
3 atoms
1 atom types
-1 1 xlo xhi
-1 1 ylo yhi
-1 1 zlo zhi

Atoms

1 1 0.01 0.1 2700 0.1 0.2 0.3 1 0 0
2 1 0.01 0.1 2700 0.1 0.4 0.3 0 1 0   # a comment
3 1 0.01 0.1 2700 -0.1 0.4 -0.3 0 0 1

Velocities

1 0.5 1e-3 -.5 0 0 0
2 0 0 0 1 2 3
3 0 0 0 4 5 6
)";

const char *const kDeck = R"(atom_style spherocylinder
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
read_data rods.data
)";

std::string edited(const std::string &find, const std::string &replace)
{
  std::string text = kData;
  const size_t at = text.find(find);
  EXPECT_NE(at, std::string::npos) << find;
  return text.replace(at, find.size(), replace);
}

std::string error_of(const std::string &data, int ranks = 1)
{
  const DeckFolder folder;
  folder.write("rods.data", data);
  folder.write("in.read", kDeck);
  const Outcome outcome = folder.run("in.read", {Program::Lmp, ranks});
  EXPECT_NE(outcome.exit_code, 0) << data;
  EXPECT_LT(outcome.exit_code, 128) << outcome.output;
  const size_t at = outcome.output.find("ERROR");
  return at == std::string::npos ? outcome.output
                                 : outcome.output.substr(at, outcome.output.find('\n', at) - at);
}

struct Mistake {
  const char *name, *find, *replace, *says;
};

void PrintTo(const Mistake &mistake, std::ostream *out) { *out << mistake.replace; }

class DataFile : public testing::TestWithParam<Mistake> {};

TEST_P(DataFile, MistakeIsToldWithItsLine)
{
  const std::string error = error_of(edited(GetParam().find, GetParam().replace));
  EXPECT_NE(error.find(std::string("rods.data, ") + GetParam().says), std::string::npos) << error;
}

INSTANTIATE_TEST_SUITE_P(
    , DataFile,
    testing::Values(
        Mistake{"WordForPlace", "0.1 0.2 0.3 1", "0.1 abc 0.3 1",
                "line 10, atom 1: y must be a number (got abc)"},
        Mistake{"Comma", "0.4 -0.3", "0,4 -0.3", "line 12, atom 3: y must be a number (got 0,4)"},
        Mistake{"HalfANumber", "0.1 0.4 0.3", "1e 0.4 0.3",
                "line 11, atom 2: x must be a number (got 1e)"},
        Mistake{"NotANumber", "0.1 0.4 0.3", "nan 0.4 0.3",
                "line 11, atom 2: x must be a number (got nan)"},
        Mistake{"Infinite", "0 0 1\n\nV", "0 0 inf\n\nV",
                "line 12, atom 3: uz must be a number (got inf)"},
        Mistake{"Hexadecimal", "2700 -0.1", "0xA8C -0.1",
                "line 12, atom 3: density must be a number (got 0xA8C)"},
        Mistake{"IdNoInteger", "\n2 1 0.01", "\n2.5 1 0.01",
                "line 11: an atom's id must be an integer >= 1 (got 2.5)"},
        Mistake{"IdZero", "\n2 1 0.01", "\n0 1 0.01",
                "line 11: an atom's id must be an integer >= 1 (got 0)"},
        Mistake{"IdTwice", "\n3 1 0.01", "\n1 1 0.01",
                "line 12, atom 1: this id has been given in line 10 already"},
        Mistake{"TypeNoInteger", "3 1 0.01", "3 1.0 0.01",
                "line 12, atom 3: type must be 1 to 1, an integer (got 1.0)"},
        Mistake{"TooFewColumns", "-0.3 0 0 1", "-0.3 0 0",
                "line 12, atom 3: 10 columns, wanted 11 or 14: id type diameter"},
        Mistake{"TooManyColumns", "-0.3 0 0 1", "-0.3 0 0 1 7",
                "line 12, atom 3: 12 columns, wanted 11 or 14"},
        Mistake{"ImageFlagsOfSome", "-0.3 0 0 1", "-0.3 0 0 1 0 0 0",
                "line 12, atom 3: 14 columns, wanted 11 as in the lines before"},
        Mistake{"BlankLine", "\n3 1", "\n\n3 1",
                "line 12: a line of the Atoms section must not be blank"},
        Mistake{"TooFewLines", "3 atoms", "4 atoms",
                "line 13: a line of the Atoms section must not be blank"},
        Mistake{"TooManyLines", "3 atoms", "2 atoms",
                "line 12: expected a section's name or the end of the file after 2 atoms"},
        Mistake{"OutsideTheBox", "0.1 0.4 0.3", "1.1 0.4 0.3",
                "line 11, atom 2: x must lie in the box"},
        Mistake{"NumberOfAtoms", "3 atoms", "three atoms",
                "line 2: the number of atoms must be an integer >= 0 (got three)"},
        Mistake{"NumberOfTypes", "1 atom types", "1.5 atom types",
                "line 3: the number of atom types must be an integer >= 1 (got 1.5)"},
        Mistake{"BoxFace", "-1 1 ylo yhi", "-1 1;0 ylo yhi",
                "line 5: ylo and yhi must be a number (got 1;0)"},
        Mistake{"BoxEmpty", "-1 1 zlo zhi", "1 -1 zlo zhi", "line 6: zlo must be < zhi (got 1 -1)"},
        Mistake{"NoBlankAfterTheName", "Atoms\n\n", "Atoms\n",
                "line 9: the line after Atoms must be blank"},
        Mistake{"VelocityAWord", "1e-3", "fast", "line 16, atom 1: vy must be a number (got fast)"},
        Mistake{"SpinAComma", "1 2 3", "1 2,5 3", "line 17, atom 2: wy must be a number (got 2,5)"},
        Mistake{"VelocityTooShort", "4 5 6", "4 5",
                "line 18, atom 3: 6 columns, wanted 7: id vx vy vz wx wy wz"},
        Mistake{"VelocityOfNoAtom", "\n3 0 0", "\n4 0 0",
                "line 18, atom 4: no such id in the Atoms section"},
        Mistake{"VelocityTwice", "\n3 0 0", "\n2 0 0",
                "line 18, atom 2: its velocity has been given in line 17 already"},
        Mistake{"VelocitiesEndEarly", "\n3 0 0 0 4 5 6\n", "\n",
                "line 17: the file ends after 2 of 3 lines of the Velocities section"}),
    [](const testing::TestParamInfo<Mistake> &info) { return info.param.name; });

TEST(DataFileOnTwoRanks, MistakeIsToldWithItsLine)
{
  const std::string error = error_of(edited("1e-3", "1e-3x"), 2);
  EXPECT_NE(error.find("rods.data, line 16, atom 1: vy must be a number (got 1e-3x)"),
            std::string::npos)
      << error;
}

TEST(DataFileCompressed, IsLookedThroughToo)
{
  const DeckFolder folder;
  folder.write("rods.data", edited("0.4 -0.3", "0.4 low"));
  ASSERT_EQ(std::system(fmt::format("gzip {}", (folder / "rods.data").string()).c_str()), 0);
  std::string deck = kDeck;
  folder.write("in.read", deck.replace(deck.find("rods.data"), 9, "rods.data.gz"));
  const Outcome outcome = folder.run("in.read");
  EXPECT_NE(outcome.output.find("rods.data.gz, line 12, atom 3: z must be a number (got low)"),
            std::string::npos)
      << outcome.output;
}

// Windows's line ends, tabs, image flags, comments, a second file added to the first.
TEST(DataFileRead, GoodFilesAreReadWhole)
{
  std::string data = kData;
  for (size_t at = 0; (at = data.find('\n', at)) != std::string::npos; at += 2)
    data.replace(at, 1, "\r\n");
  const std::string added = R"(two more
2 atoms
1 atom types
-1 1 xlo xhi
-1 1 ylo yhi
-1 1 zlo zhi

Atoms

4	1	0.01	0.1	2700	0.5	0.2	0.3	1	0	0	0	0	0
5	1	0.01	0.1	2700	0.5	0.4	0.3	1	0	0	0	0	0
)";
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    folder.write("rods.data", data);
    folder.write("more.data", added);
    folder.write("in.read",
                 std::string(kDeck) + "read_data more.data add\nneighbor 0.02 bin\n" +
                     linear_material(1e5, 1e5, 0.5, 0.2) + rod_pair("linear tangential history") +
                     "fix motion all nve/spherocylinder\n" +
                     exact_dump("dump.rods", 1, "id x y z vx vy omegax omegay") + "run 0\n");
    const Outcome outcome = folder.run("in.read", {Program::Lmp, ranks});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const Table rods = read_dump(folder / "dump.rods").back().atoms;
    ASSERT_EQ(rods.rows.size(), 5u);
    EXPECT_EQ(rods.at(0, "vy"), 1e-3);
    EXPECT_EQ(rods.at(2, "omegay"), 5.0);
    EXPECT_EQ(rods.at(4, "y"), 0.4);
  }
}

}  // namespace
