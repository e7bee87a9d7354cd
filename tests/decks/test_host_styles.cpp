// SPDX-License-Identifier: GPL-2.0-or-later
// The table of LIGGGHTS's styles: each that it refuses ends a deck with rods by the table's own sentence,
// and the manual page is the table. That the table names every style there is: test_host_names.cpp.
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "deck_run.h"
#include "loader/host_styles.h"
#include "loader/host_styles_page.h"

using namespace decks;
using spherocylinder::HostKind;
using spherocylinder::HostStyle;
using spherocylinder::Verdict;

namespace spherocylinder {

void PrintTo(const HostStyle &row, std::ostream *out)
{
  *out << word_for(row.kind) << " " << row.name;
}

}  // namespace spherocylinder

namespace {

const char *const kData = R"(two rods

2 atoms
1 atom types
-0.5 0.5 xlo xhi
-0.5 0.5 ylo yhi
-0.5 0.5 zlo zhi

Atoms

1 1 0.01 0.1 2700 0 0 0.2 1 0 0
2 1 0.01 0.1 2700 0 0.1 0.2 0 0.6 0.8
)";

const char *const kBefore = R"(atom_style spherocylinder
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
)";

const char *const kAfter = R"(neighbor 0.02 bin
neigh_modify delay 0
fix kn all property/global kn peratomtypepair 1 1e5
fix kt all property/global kt peratomtypepair 1 1e5
fix rest all property/global coefficientRestitution peratomtypepair 1 0.5
fix fric all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model linear tangential history surface spherocylinder
pair_coeff * *
fix motion all nve/spherocylinder
timestep 1e-5
)";

Outcome run_deck(const std::string &deck, int ranks = 1)
{
  const DeckFolder folder;
  folder.write("in.deck", deck);
  folder.write("rods.data", kData);
  Launch launch;
  launch.ranks = ranks;
  return folder.run("in.deck", launch);
}

void expect_refused(const Outcome &outcome, const std::string &sentence)
{
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_LT(outcome.exit_code, 128) << "ended by a signal\n" << outcome.output;
  EXPECT_NE(outcome.output.find("ERROR: " + sentence), std::string::npos)
      << "wanted: " << sentence << "\ngot: " << outcome.output;
}

std::string good_deck() { return std::string(kBefore) + "read_data rods.data\n" + kAfter; }

// What the deck's writer reads: who, and the table's sentence.
std::string sentence_of(const HostStyle &row, const std::string &id = "")
{
  return std::string(word_for(row.kind)) + " " + row.name + (id.empty() ? "" : " (id " + id + ")") +
         " with atom_style spherocylinder: " + row.sentence;
}

std::vector<HostStyle> refused(HostKind kind)
{
  std::vector<HostStyle> rows;
  for (const HostStyle &row : spherocylinder::host_styles())
    if (row.kind == kind && row.verdict == Verdict::Refused) rows.push_back(row);
  return rows;
}

std::vector<HostStyle> refused(const std::vector<HostKind> &kinds)
{
  std::vector<HostStyle> rows;
  for (const HostKind kind : kinds)
    for (const HostStyle &row : refused(kind)) rows.push_back(row);
  return rows;
}

// The line of a deck that asks for the style.
std::string asked_by(const HostStyle &row)
{
  const std::string name = row.name;
  switch (row.kind) {
    case HostKind::Fix: return "fix asked all " + name;
    case HostKind::Compute: return "compute asked all " + name;
    case HostKind::Dump: return "dump asked all " + name + " 1 file.*";
    case HostKind::Pair: return "pair_style " + name;
    case HostKind::Integrate: return "run_style " + name;
    case HostKind::MeshModule: return "fix asked all mesh/surface/" + name + " file none type 1";
    default: return name;  // a command
  }
}

bool has_id(HostKind kind)
{
  return kind == HostKind::Fix || kind == HostKind::Compute || kind == HostKind::Dump;
}

class RefusedStyle : public testing::TestWithParam<HostStyle> {};

TEST_P(RefusedStyle, EndsWithItsSentence)
{
  const HostStyle &row = GetParam();
  const Outcome outcome = run_deck(good_deck() + asked_by(row) + "\nrun 1\n");
  expect_refused(outcome, sentence_of(row, has_id(row.kind) ? "asked" : ""));
  EXPECT_EQ(outcome.output.find("Loop time"), std::string::npos) << "it ran";
}

std::string test_name(const testing::TestParamInfo<HostStyle> &info)
{
  std::string name = std::string(word_for(info.param.kind)) + "_" + info.param.name;
  for (char &c : name)
    if (!isalnum(c)) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(, RefusedStyle,
                         testing::ValuesIn(refused({HostKind::Fix, HostKind::Compute,
                                                    HostKind::Command, HostKind::BuiltIn,
                                                    HostKind::Dump, HostKind::Pair,
                                                    HostKind::Integrate, HostKind::MeshModule})),
                         test_name);

// Also where the atom style comes after it.
TEST(RefusedUnits, EndWithTheirSentence)
{
  for (const HostStyle &row : refused(HostKind::Units)) {
    std::string deck = good_deck() + "run 1\n";
    deck.replace(deck.find("units si\n"), 9, "");
    expect_refused(run_deck(std::string("units ") + row.name + "\n" + deck), sentence_of(row));
    expect_refused(run_deck(std::string(kBefore) + "units " + row.name + "\n"), sentence_of(row));
  }
}

TEST(RefusedAtomStyle, Hybrid)
{
  expect_refused(run_deck("atom_style hybrid sphere spherocylinder\n"),
                 sentence_of(*spherocylinder::find_host_style(HostKind::AtomStyle, "hybrid")));
}

// On every number of ranks: contacts would be missed, or the run would hang.
class RefusedTriclinic : public testing::TestWithParam<int> {};

TEST_P(RefusedTriclinic, InEveryWayToMakeIt)
{
  const std::string sentence =
      sentence_of(*spherocylinder::find_host_style(HostKind::Box, "triclinic"));
  const std::string prism = "region box prism -0.5 0.5 -0.5 0.5 -0.5 0.5 0.0 0.0 0.0 units box\n";
  expect_refused(run_deck(std::string(kBefore) + prism + "create_box 1 box\n" + kAfter + "run 1\n",
                          GetParam()),
                 sentence);
  expect_refused(run_deck(good_deck() + "change_box all triclinic\nrun 1\n", GetParam()), sentence);
  expect_refused(run_deck(good_deck() + "change_box all xy final 0.1\nrun 1\n", GetParam()),
                 sentence);

  const DeckFolder folder;
  std::string tilted = kData;
  tilted.replace(tilted.find("\nAtoms"), 0, "0.0 0.0 0.0 xy xz yz\n");
  folder.write("rods.data", tilted);
  folder.write("in.deck", good_deck() + "run 1\n");
  Launch launch;
  launch.ranks = GetParam();
  expect_refused(folder.run("in.deck", launch), sentence);
}

INSTANTIATE_TEST_SUITE_P(OnRanks, RefusedTriclinic, testing::Values(1, 2, 4));

TEST(RefusedBox, Dimension2)
{
  const std::string sentence =
      sentence_of(*spherocylinder::find_host_style(HostKind::Box, "dimension 2"));
  expect_refused(run_deck("dimension 2\natom_style spherocylinder\n"),
                 "Atom style spherocylinder requires a 3d simulation (dimension 3)");
  expect_refused(run_deck(std::string(kBefore) + "dimension 2\nread_data rods.data\n"), sentence);
}

// A host of the same version that has a function more, which only builds with superquadrics have; their
// classes are larger.
TEST(HostBuild, WithSuperquadricsIsRefused)
{
  if (SPHEROCYLINDER_SANITIZED) GTEST_SKIP() << "the sanitizers must be loaded first";
  const DeckFolder folder;
  folder.write("in.deck", "print hello\n");
  EXPECT_EQ(folder.run("in.deck").exit_code, 0);
  setenv("LD_PRELOAD", SUPERQUADRICS, 1);
  const Outcome outcome = folder.run("in.deck");
  unsetenv("LD_PRELOAD");
  expect_refused(outcome,
                 "libspherocylinder: host program must be LIGGGHTS 3.8.0 as Debian builds it (got: "
                 "it is built with superquadrics)");
}

// Two rods that fly at each other from different ranks: settings under which LIGGGHTS would not look
// for rods of other ranks in time change nothing. That they bounce: momentum of each is turned round.
TEST(NeighbourSettings, DoNotPutContactsOff)
{
  std::string data = kData;
  data.replace(data.find("1 1 0.01"), std::string::npos,
               "1 1 0.01 0.1 2700 0 0 -0.4 1 0 0\n2 1 0.01 0.1 2700 0 0 0.4 0 1 0\n\nVelocities\n\n"
               "1 0 0 10 0 0 0\n2 0 0 -10 0 0 0\n");
  const auto velocity_after = [&](const std::string &settings) {
    const DeckFolder folder;
    folder.write("rods.data", data);
    folder.write("in.deck", "processors 1 1 2\n" + good_deck() + settings + "\n" +
                                exact_dump("end.dump", 6000, "id vz") + "run 6000\n");
    Launch launch;
    launch.ranks = 2;
    const Outcome outcome = folder.run("in.deck", launch);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_EQ(outcome.output.find("WARNING: Command neigh_modify") != std::string::npos,
              settings != "neigh_modify delay 0");
    return read_dump(folder / "end.dump").back().atoms.at(0, "vz");
  };
  const double bounced = velocity_after("neigh_modify delay 0");
  EXPECT_NEAR(bounced, -5.0, 0.1);  // restitution 0.5
  for (const char *settings : {"neigh_modify delay 6000", "neigh_modify delay 2000 check no",
                               "neigh_modify delay 0 every 3000", "neigh_modify delay 0 once yes"})
    EXPECT_EQ(velocity_after(settings), bounced) << settings;
}

TEST(RefusedGhosts, OfOneGroup)
{
  expect_refused(run_deck(good_deck() + "group one id 1\natom_modify first one\n"
                                        "communicate single group one vel yes\nrun 1\n"),
                 "Command communicate with atom_style spherocylinder: group one leaves out rods of "
                 "other ranks and images, whose contacts would be missed; use communicate single "
                 "vel yes");
}

// Also where the histories in the file would not fit other models.
TEST(RefusedRestart, WithoutTheSurfaceModel)
{
  const DeckFolder folder;
  folder.write("rods.data", kData);
  folder.write("in.write", good_deck() + "run 1\nwrite_restart rods.restart\n");
  ASSERT_EQ(folder.run("in.write").exit_code, 0);
  std::string deck = std::string(kBefore) + "read_restart rods.restart\n" + kAfter + "run 1\n";
  const std::string surface = " surface spherocylinder";
  deck.erase(deck.find(surface), surface.size());
  const size_t linear = deck.find("model linear");
  deck.replace(linear, 12, "model hertz");
  folder.write("in.read", deck);
  expect_refused(folder.run("in.read"),
                 "Atom style spherocylinder: pair_style gran must be given surface spherocylinder");
}

TEST(NoPairStyle, IsSaid)
{
  std::string deck = good_deck() + "atom_modify sort 0 0\nrun 1\n";
  const size_t pair = deck.find("pair_style");
  deck.erase(pair, deck.find("fix motion") - pair);
  const Outcome outcome = run_deck(deck);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(
      outcome.output.find("WARNING: Atom style spherocylinder: there is no pair_style, rods pass "
                          "through each other"),
      std::string::npos)
      << outcome.output;
}

// Another atom style is LIGGGHTS's own affair.
TEST(HostStyles, AreAllThereWithoutRods)
{
  const Outcome outcome = run_deck(R"(atom_style sphere
units si
boundary f f f
region box block 0 1 0 1 0 1 units box
create_box 1 box
atom_modify sort 0 0
create_atoms 1 single 0.5 0.5 0.5 units box
set atom 1 density 1000 diameter 0.1
pair_style none
fix motion all nve/sphere
compute spin all erotate/sphere
run 1
)");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

TEST(HostStyles, ManualPageIsPrintedFromTheTable)
{
  std::ifstream in(HOST_STYLES_PAGE);
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(page == spherocylinder::host_styles_page())
      << "print it anew: the command stands at the page's end";
}

// Each refusal says what to do instead, and nothing is listed twice.
TEST(HostStyles, RowsAreWhole)
{
  for (const HostStyle &row : spherocylinder::host_styles()) {
    EXPECT_EQ(spherocylinder::find_host_style(row.kind, row.name)->sentence, row.sentence)
        << word_for(row.kind) << " " << row.name << " is listed twice";
    const std::string sentence = row.sentence;
    const bool says_what_instead = sentence.find("; ") != std::string::npos;
    EXPECT_TRUE(row.verdict != Verdict::Refused || says_what_instead)
        << word_for(row.kind) << " " << row.name << ": " << sentence;
    EXPECT_TRUE(row.verdict != Verdict::Different || !sentence.empty()) << row.name;
  }
}

}  // namespace
