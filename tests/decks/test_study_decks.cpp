// SPDX-License-Identifier: GPL-2.0-or-later
// The decks of input/ on several ranks: all rods are placed, and each rank has its share of them when
// they have come down.
#include <gtest/gtest.h>

#include <filesystem>

#include "deck_run.h"

using namespace decks;

namespace {

// A vessel hardly wider than a rod is long, whose bed is a sixth of its height.
constexpr const char *kCase =
    "variable lambda index 5\n"
    "variable vessel_diameter index 0.06\n"
    "variable rods index 60\n"
    "variable vessel_height index 1.5\n"
    "variable stiffness index 2e3\n"
    "variable dt index 6e-5\n"
    "variable fill_time index 0.6\n"
    "variable total_time index 0.66\n"
    "variable limit_fill index 0\n"
    "variable limit_settle index 0\n";

// The fuller rank's rods over the mean once the stage is over.
constexpr const char *kShare =
    "run 0\n"
    "variable even equal f_even\n"
    "print \"imbalance ${even}\"\n";

double imbalance(const Outcome &outcome)
{
  const std::string says = "\nimbalance ";
  const size_t at = outcome.output.find(says);
  EXPECT_NE(at, std::string::npos) << outcome.output;
  return at == std::string::npos ? 0.0 : std::stod(outcome.output.substr(at + says.size()));
}

class StudyDecks : public testing::TestWithParam<int> {};

// Level cuts that stayed where they are would give the lowest rank everything: an imbalance of as
// many as there are ranks.
TEST_P(StudyDecks, EachRankHasItsShare)
{
  const DeckFolder folder;
  for (const char *name : {"in.rods", "in.contact", "in.fill", "in.settle"})
    std::filesystem::copy(std::filesystem::path(INPUT_FOLDER) / name, folder / name);
  for (const std::string stage : {"fill", "settle"}) {
    folder.write("in." + stage + "_case", kCase + ("include in." + stage + "\n") + kShare);
    const Outcome outcome = folder.run("in." + stage + "_case", {Program::Lmp, GetParam()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_LE(imbalance(outcome), 1.2) << stage;
    EXPECT_EQ(read_thermo(outcome.output).at(0, "Atoms"), 60.0) << stage;
  }
}

// quick 1 goes from in.fill to in.settle, with a longer step, and ends at rest with a frame and a
// restart of that step; without it nothing ends before its time.
TEST(StudyDecksQuick, EndsAtRest)
{
  const DeckFolder folder;
  for (const char *name : {"in.rods", "in.contact", "in.fill", "in.settle"})
    std::filesystem::copy(std::filesystem::path(INPUT_FOLDER) / name, folder / name);
  const std::string vessel =
      "variable lambda index 5\nvariable vessel_diameter index 0.06\nvariable rods index 60\n"
      "variable vessel_height index 1.5\nvariable fill_time index 0.6\n"
      "variable limit_fill index 0\n";
  folder.write("in.fill_case", vessel + "variable quick index 1\ninclude in.fill\n");
  ASSERT_EQ(folder.run("in.fill_case").exit_code, 0);
  folder.write("in.settle_case", "variable vessel_height index 1.5\nvariable limit_settle index 0\n"
                                 "include in.settle\nvariable ended equal f_rested[5]\n"
                                 "print \"ended ${ended} at step $(step) of ${dt} s\"\n");
  const Outcome outcome = folder.run("in.settle_case");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  const double last = thermo.rows.back()[0];
  EXPECT_LT(last * 5e-5, 2.9);
  EXPECT_NE(outcome.output.find("ended 1 at"), std::string::npos) << outcome.output;
  EXPECT_EQ(read_dump(folder / "dump.settle").back().step, static_cast<long>(last));
  EXPECT_TRUE(std::filesystem::exists(folder / "restart.settle"));
}

INSTANTIATE_TEST_SUITE_P(, StudyDecks, testing::Values(1, 2, 3, 4),
                         [](const auto &info) { return "ranks" + std::to_string(info.param); });

}  // namespace
