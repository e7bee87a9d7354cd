// SPDX-License-Identifier: GPL-2.0-or-later
// The decks of input/: on several ranks all rods are placed, and each rank has its share of them
// when they have come down; what can be chosen does what it says.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/rotation.h"
#include "deck_run.h"

using namespace decks;

namespace {

// A vessel hardly wider than a rod is long, whose bed is a sixth of its height.
constexpr const char *kCase = "variable lambda index 5\n"
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
constexpr const char *kShare = "run 0\n"
                               "variable even equal f_even\n"
                               "print \"imbalance ${even}\"\n";

void copy_decks(const DeckFolder &folder)
{
  for (const auto &deck : std::filesystem::directory_iterator(INPUT_FOLDER))
    std::filesystem::copy(deck.path(), folder / deck.path().filename().string());
}

// Runs a stage of input/ with `given` before it.
Outcome run_stage(const DeckFolder &folder, const std::string &stage, const std::string &given,
                  int ranks = 1)
{
  folder.write("in." + stage + "_case", given + "include in." + stage + "\n");
  return folder.run("in." + stage + "_case", {Program::Lmp, ranks});
}

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
  copy_decks(folder);
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
  copy_decks(folder);
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

// The largest angular velocity of a rod, total and across its axis, at the end of a stage.
struct Fastest {
  double total = 0.0, across = 0.0;
};

Fastest fastest_in(const Table &rods)
{
  Fastest fastest;
  for (size_t i = 0; i < rods.rows.size(); i++) {
    const auto value = [&](const char *column) { return rods.at(i, column); };
    const spherocylinder::Vec3 omega = {value("omegax"), value("omegay"), value("omegaz")};
    const spherocylinder::Vec3 axis =
        spherocylinder::axis_of({value("quat1"), value("quat2"), value("quat3"), value("quat4")});
    fastest.total = std::max(fastest.total, norm(omega));
    fastest.across = std::max(fastest.across, norm(omega - dot(omega, axis) * axis));
  }
  return fastest;
}

// limit_part, given to in.fill, holds in both stages: rods roll faster than the limit of their
// transverse part, and not where the total is limited. Dumps have six digits.
TEST(StudyDecksLimit, PartIsThatOfBothStages)
{
  for (const std::string part : {"total", "transverse"}) {
    const DeckFolder folder;
    copy_decks(folder);
    const std::string limits = "variable limit_fill index 2.0\nvariable limit_settle index 1.0\n"
                               "variable dump_every index 1000\n";
    for (const std::string stage : {"fill", "settle"}) {
      const std::string given = stage == "fill" ? "variable limit_part index " + part + "\n" : "";
      folder.write("in." + stage + "_case", limits + given + kCase + "include in." + stage + "\n");
      const Outcome outcome = folder.run("in." + stage + "_case");
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
      const double limit = stage == "fill" ? 2.0 : 1.0;
      const Fastest fastest = fastest_in(read_dump(folder / ("dump." + stage)).back().atoms);
      EXPECT_LE(fastest.across, limit * 1.00001) << stage << part;
      EXPECT_GT(fastest.across, 0.1 * limit) << stage << part;
      if (part == "total") {
        EXPECT_LE(fastest.total, limit * 1.00001) << stage;
      } else {
        EXPECT_GT(fastest.total, 1.2 * limit) << stage;
      }
    }
  }
}

// Fibres go from in.fill to in.settle as they are, on any number of ranks, and their step is short enough
// for contacts and joints. bending B gives E I = B rho pi r^2 g L^3, I = pi r^4/4.
class StudyDecksFibres : public testing::TestWithParam<int> {};

TEST_P(StudyDecksFibres, ArePouredAndSettle)
{
  const DeckFolder folder;
  copy_decks(folder);
  const std::string limits = "variable thermo_every index 100\nvariable dump_every index 1000\n";
  const std::string given = "variable lambda index 30\nvariable vessel_diameter index 0.4\n"
                            "variable rods index 40\nvariable vessel_height index 0.8\n"
                            "variable segments index 6\nvariable bending index 0.05\n"
                            "variable fill_time index 0.2\nvariable total_time index 0.25\n";
  std::map<std::pair<int, int>, int> ids;  // by fibre and place
  for (const std::string stage : {"fill", "settle"}) {
    folder.write("in." + stage + "_case", limits + (stage == "fill" ? given : "") + "include in." +
                                              stage + "\nprint \"E ${youngs_modulus}\"\n");
    const Outcome outcome = folder.run("in." + stage + "_case", {Program::Lmp, GetParam()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_EQ(outcome.output.find("of the stable step"), std::string::npos) << outcome.output;
    const size_t at = outcome.output.find("\nE ");
    ASSERT_NE(at, std::string::npos);
    const double wanted = 4.0 * 0.05 * 2700.0 * 9.81 * std::pow(0.3, 3) / std::pow(0.005, 2);
    EXPECT_NEAR(std::stod(outcome.output.substr(at + 3)), wanted, 1e-12 * wanted);
    if (stage == "settle") {
      const Table thermo = read_thermo(outcome.output);
      EXPECT_EQ(thermo.at(0, "Atoms"), 240.0);
      EXPECT_LT(thermo.rows.back().at(7), 0.5);  // largest overlap
      EXPECT_GT(thermo.rows.back().at(8), 0.0);  // energy of joints
    }
    const Table rods = read_dump(folder / ("dump." + stage)).back().atoms;
    ASSERT_EQ(rods.rows.size(), 240u);
    for (size_t k = 0; k < rods.rows.size(); k++) {
      const std::pair<int, int> segment(rods.at(k, "f_fibres[1]"), rods.at(k, "f_fibres[2]"));
      EXPECT_GE(segment.second, 1);
      EXPECT_LE(segment.second, 6);
      const int id = static_cast<int>(rods.at(k, "id"));
      if (stage == "fill")
        EXPECT_TRUE(ids.emplace(segment, id).second) << segment.first << " " << segment.second;
      else
        EXPECT_EQ(ids[segment], id);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, StudyDecksFibres, testing::Values(1, 2));

TEST(StudyDecksWrong, FibresAreRefused)
{
  for (const auto &[given, says] :
       {std::pair("variable segments index 0\n", "segments must be >= 1"),
        std::pair("variable bending index 0\n", "bending must be > 0")}) {
    const DeckFolder folder;
    copy_decks(folder);
    const Outcome outcome = run_stage(folder, "fill", std::string(given));
    EXPECT_NE(outcome.output.find(says), std::string::npos) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "restart.fill"));
  }
}

// --- What can be chosen -------------------------------------------------------------------------

constexpr double kGravity = 9.81;
// Rods of 0.05 m.
constexpr const char *kVessel =
    "variable lambda index 5\nvariable vessel_diameter index 0.08\nvariable rods index 64\n"
    "variable vessel_height index 1.5\nvariable limit_fill index 0\n"
    "variable limit_settle index 0\n";
// The dump's first frame is that of the rods as placed.
constexpr const char *kAsPlaced =
    "variable dt index 1e-12\nvariable fill_time index 1e-12\nvariable dump_every index 1\n";

struct Axis {
  double heading, height;  // heading (degrees, 0 to 180) and vertical part of an axis
};

std::vector<Axis> axes_of(const Snapshot &frame)
{
  std::vector<Axis> axes;
  for (size_t i = 0; i < frame.atoms.rows.size(); i++) {
    const double q1 = frame.atoms.at(i, "quat1"), q2 = frame.atoms.at(i, "quat2"),
                 q3 = frame.atoms.at(i, "quat3"), q4 = frame.atoms.at(i, "quat4");
    const double x = 2 * (q2 * q4 + q1 * q3), y = 2 * (q3 * q4 - q1 * q2);
    axes.push_back({std::fmod(std::atan2(y, x) * 180 / M_PI + 360.001, 180.0),
                    std::abs(1 - 2 * (q2 * q2 + q3 * q3))});
  }
  return axes;
}

// A rod lies on the floor and slides along its axis: v = v_0 - mu g t, mu that of the walls.
TEST(StudyDecksChoice, FrictionAtWallsIsTheirOwn)
{
  const DeckFolder folder;
  copy_decks(folder);
  folder.write("rods.data",
               "rod\n\n1 atoms\n2 atom types\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n\n"
               "Atoms\n\n1 1 0.01 0.1 2700 0 0 0.005 1 0 0\n\n"
               "Velocities\n\n1 1 0 0 0 0 0\n");
  folder.write("in.slide",
               "variable vessel_diameter index 1.0\nvariable friction index 0.5\n"
               "variable friction_wall index 0.1\ninclude in.rods\nread_data rods.data\n"
               "include in.contact\n" +
                   exact_dump("dump.end", 2500, "id vx") + "run 2500\n");
  const Outcome outcome = folder.run("in.slide");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NEAR(read_dump(folder / "dump.end").back().atoms.at(0, "vx"),
              1.0 - 0.1 * kGravity * 2500 * 2e-5, 1e-3);
}

TEST(StudyDecksChoice, RodsStartUprightOrLevel)
{
  const DeckFolder folder;
  copy_decks(folder);
  for (const bool upright : {true, false}) {
    const Outcome outcome =
        run_stage(folder, "fill",
                  std::string(kVessel) + kAsPlaced +
                      (upright ? "variable vertical index 1\n" : "variable horizontal index 1\n"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    std::map<long, int> headings;
    const std::vector<Axis> axes = axes_of(read_dump(folder / "dump.fill").at(1));
    ASSERT_EQ(axes.size(), 64u);
    for (const Axis &axis : axes) {
      EXPECT_NEAR(axis.height, upright ? 1.0 : 0.0, 1e-6);
      headings[std::lround(axis.heading / 11.25)]++;
    }
    if (upright) continue;
    ASSERT_EQ(headings.size(), 16u);  // 180/16 = 11.25 degrees apart
    for (const auto &[heading, rods] : headings) EXPECT_EQ(rods, 4) << heading;
  }
}

// A layer two lengths high falls from `drop` above the bed: no rod is faster than after a free fall
// of both and a length, the room between the highest centre and the highest point there may be.
TEST(StudyDecksChoice, GentlyPouredRodsFallFromTheBedsTop)
{
  const DeckFolder folder;
  copy_decks(folder);
  const std::string gentle =
      std::string(kVessel) +
      "variable gentle index 1\nvariable layers index 4\nvariable fill_time index 1.0\n"
      "variable dt index 5e-5\nvariable dump_every index 400\n";
  const Outcome outcome = run_stage(folder, "fill", gentle);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::vector<Snapshot> frames = read_dump(folder / "dump.fill");
  for (const Snapshot &frame : frames) {
    const long layers = std::min(4L, (frame.step + 4999) / 5000);
    ASSERT_EQ(frame.atoms.rows.size(), static_cast<size_t>(16 * layers)) << frame.step;
    for (size_t i = 0; i < frame.atoms.rows.size(); i++)
      EXPECT_LE(std::abs(frame.atoms.at(i, "vz")), std::sqrt(2 * kGravity * (0.05 + 3 * 0.05)));
  }
  EXPECT_EQ(frames.back().atoms.rows.size(), 64u);

  const Outcome uneven = run_stage(folder, "fill", "variable layers index 10\n" + gentle);
  EXPECT_NE(uneven.output.find("rods must be a multiple of layers 10 (got 64)"), std::string::npos)
      << uneven.output;
  const Outcome hasty = run_stage(folder, "fill", "variable fill_time index 0.6\n" + gentle);
  EXPECT_NE(hasty.output.find("fill_time must be layers 4 times as long (got 0.6)"),
            std::string::npos)
      << hasty.output;
}

TEST(StudyDecksChoice, LengthsSpreadEvenly)
{
  const DeckFolder folder;
  copy_decks(folder);
  const Outcome outcome =
      run_stage(folder, "fill",
                std::string("variable rods index 63\nvariable length_spread index 0.2\n") +
                    kVessel + kAsPlaced);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  std::map<long, int> lengths;
  const Table rods = read_dump(folder / "dump.fill").at(1).atoms;
  for (size_t i = 0; i < rods.rows.size(); i++) lengths[std::lround(2000 * rods.at(i, "shapez"))]++;
  EXPECT_EQ(lengths, (std::map<long, int>{{40, 21}, {50, 21}, {60, 21}}));
}

// A rod that falls freely is seen from the vessel: it falls g t²/2 and the vessel's lift a/(2 pi f²)
// more, a the largest acceleration; its speed is then that of the fall, as the vessel rests again.
TEST(StudyDecksChoice, TapsLiftTheVessel)
{
  const DeckFolder folder;
  copy_decks(folder);
  const std::string one =
      "variable rods index 1\nvariable vessel_height index 10\n" + std::string(kVessel);
  ASSERT_EQ(run_stage(folder, "fill", "variable fill_time index 2e-5\n" + one).exit_code, 0);
  ASSERT_EQ(run_stage(folder, "settle", "variable total_time index 4e-5\n" + one).exit_code, 0);
  const Outcome outcome = run_stage(folder, "tap",
                                    "variable taps index 1\nvariable tap_strength index 3\n"
                                    "variable tap_frequency index 20\n"
                                    "variable tap_time index 0.2\n");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::vector<Snapshot> frames = read_dump(folder / "dump.tap");
  ASSERT_EQ(frames.size(), 2u);
  const double lift = 3 * kGravity / (2 * M_PI * 20 * 20);
  EXPECT_NEAR(frames[0].atoms.at(0, "z") - frames[1].atoms.at(0, "z"),
              kGravity * 0.2 * 0.2 / 2 + lift, 2e-4);  // a step or two at 2 m/s
  EXPECT_NEAR(frames[1].atoms.at(0, "vz"), -kGravity * 0.2, 2e-3);
}

// The heap is wider than the vessel was, and every rod is there, on three ranks as many each: cuts that stay
// thirds of the box would give one rank everything. Cuts are a skin apart.
TEST(StudyDecksChoice, TheBedCollapsesWithoutItsWall)
{
  const DeckFolder folder;
  copy_decks(folder);
  const std::string given =
      "variable quick index 1\nvariable fill_time index 0.7\n" + std::string(kVessel);
  ASSERT_EQ(run_stage(folder, "fill", given).exit_code, 0);
  ASSERT_EQ(run_stage(folder, "settle", given).exit_code, 0);
  for (const int ranks : {1, 3}) {
    folder.write(
        "in.collapse_case",
        "variable skin_diameters index 1.0\nvariable reach index 0.5\nvariable collapse_time index 0.3\n"
        "variable dump_every index 2000\ninclude in.collapse\n" +
            std::string(kShare));
    const Outcome outcome = folder.run("in.collapse_case", {Program::Lmp, ranks});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_LE(imbalance(outcome), 1.2) << ranks;
    const Table heap = read_dump(folder / "dump.collapse").back().atoms;
    ASSERT_EQ(heap.rows.size(), 64u);
    double widest = 0.0;
    for (size_t i = 0; i < heap.rows.size(); i++)
      widest = std::max(widest, std::hypot(heap.at(i, "x"), heap.at(i, "y")));
    EXPECT_GT(widest, 0.06);
    EXPECT_LT(widest, 0.54);
  }
}

TEST(StudyDecksChoice, WrongValuesAreTold)
{
  const DeckFolder folder;
  copy_decks(folder);
  const std::pair<const char *, const char *> wrong[] = {
      {"friction_wall index -1", "friction_wall must be >= 0 (got -1)"},
      {"length_spread index 1", "length_spread must be >= 0 and < 1 (got 1)"},
      {"vertical index 2", "vertical and horizontal must be 0 or 1 (got 2 and 0)"},
      {"gentle index 3", "gentle must be 0 or 1 (got 3)"},
      {"drop index -1", "layers must be >= 1 and drop >= 0 (got 10 and -1)"}};
  for (const auto &[given, told] : wrong) {
    const Outcome outcome =
        run_stage(folder, "fill", std::string("variable ") + given + "\n" + kVessel);
    EXPECT_NE(outcome.output.find(told), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.exit_code, 0);
  }
  folder.write("in.case", "variable types index 1\nvariable out index .\n");
  const Outcome changed =
      run_stage(folder, "settle", std::string("variable friction_wall index 0.1\n") + kVessel);
  EXPECT_NE(changed.output.find("poured with one friction for rods and walls (got friction 0.2 and "
                                "friction_wall 0.1)"),
            std::string::npos)
      << changed.output;
  const Outcome outcome =
      run_stage(folder, "tap", "variable tap_time index 0.01\n" + std::string(kVessel));
  EXPECT_NE(outcome.output.find("tap_time must be longer than a tap, 1/tap_frequency (got 0.01 at "
                                "30.0)"),
            std::string::npos)
      << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(, StudyDecks, testing::Values(1, 2, 3, 4),
                         [](const auto &info) { return "ranks" + std::to_string(info.param); });

}  // namespace
