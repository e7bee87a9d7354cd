// SPDX-License-Identifier: GPL-2.0-or-later
// Ghosts that are not sent in each step: no contact is missed, and no bit is another than where all are sent.
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "rod_gas.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;

namespace {

using Processors = std::array<int, 3>;

constexpr int kParts = 12, kPartSteps = 100;

// A run in parts, on so many ranks.
struct Ghosts {
  const char *name;
  Processors ranks;
  const char *keywords = "";  // of the pair style
  const char *before = "";    // the run
  const char *between = "";   // the parts, which are numbered by ${part}
  const char *options = "pre no";
  bool periodic = true;
  double skin = 0.08;   // LIGGGHTS seldom builds its lists
  int shot_each = 8;    // so many rods one is shot
  double faster = 6.0;  // than the rods of a gas would be
  double volume_fraction = 0.12;
};

void PrintTo(const Ghosts &run, std::ostream *out) { *out << run.name; }

struct Report {
  double held = -1.0, sent = -1.0, bytes = -1.0;
  long asked = -1;
};

Report read_report(const std::string &output)
{
  Report report;
  const size_t begin = output.rfind("Rod ghosts of a rank: ");
  if (begin == std::string::npos) return report;
  sscanf(output.c_str() + begin,
         "Rod ghosts of a rank: held = %lf, sent in a step = %lf, bytes sent in a step = %lf, "
         "asked for = %ld",
         &report.held, &report.sent, &report.bytes, &report.asked);
  return report;
}

// Rods at rest and rods that are shot through them.
Scene shot_through(const Ghosts &given)
{
  RodGas gas;
  gas.rods = 200;
  gas.shortest = 0.3;
  gas.volume_fraction = given.volume_fraction;
  Scene scene = scene_of(gas);
  scene.skin = given.skin;
  scene.dt = shortest_contact(gas) / 40.0;
  for (size_t k = 0; k < scene.rods.size(); k++) {
    Rod &rod = scene.rods[k];
    const double faster = k % given.shot_each == 0 ? given.faster : 0.0;
    rod.velocity = faster * rod.velocity;
    rod.omega = faster * rod.omega;
  }
  if (given.periodic) return scene;
  scene.boundary = "f f f";
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] *= 4.0;
    scene.box_hi[d] *= 4.0;
  }
  return scene;
}

struct Result {
  std::string output;
  std::vector<Frame> frames;
  std::vector<Vec3> sides;  // of the box, at each frame
};

std::vector<Vec3> read_sides(const std::filesystem::path &dump)
{
  std::vector<Vec3> sides;
  std::ifstream file(dump);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("ITEM: BOX BOUNDS", 0) != 0) continue;
    double lo[3], hi[3];
    for (int d = 0; d < 3; d++) file >> lo[d] >> hi[d];
    sides.push_back({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
  }
  return sides;
}

Result run_scene(const Ghosts &given, const std::string &keywords)
{
  const Scene scene = shot_through(given);
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  const Processors &n = given.ranks;
  folder.write("in.ghosts",
               preamble(scene) +
                   fmt::format("processors {} {} {}\nread_data rods.data\nneighbor {} bin\n", n[0],
                               n[1], n[2], scene.skin) +
                   linear_material(1e5, 5e4, 0.9, 0.3) +
                   "pair_style gran model linear tangential history surface spherocylinder " +
                   given.keywords + " " + keywords +
                   "\npair_coeff * *\nfix motion all nve/spherocylinder\n" +
                   "compute contacts all contact/spherocylinder\n" +
                   exact_dump("dump.ghosts", kPartSteps, kFrameColumns) +
                   fmt::format("timestep {}\n", scene.dt) + given.before +
                   fmt::format("run 0\nvariable part loop {}\nlabel part\n{}run {} {}\n"
                               "next part\njump SELF part\n",
                               kParts, given.between, kPartSteps, given.options));
  const Outcome outcome = folder.run("in.ghosts", {Program::Lmp, n[0] * n[1] * n[2], 120});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return {};
  return {outcome.output, read_frames(folder / "dump.ghosts", scene),
          read_sides(folder / "dump.ghosts")};
}

// Pairs that touch, by trying all; the box is periodic or has room around the rods.
long touching_pairs(const std::vector<Rod> &rods, const Vec3 &side)
{
  long pairs = 0;
  for (size_t i = 0; i < rods.size(); i++)
    for (size_t j = i + 1; j < rods.size(); j++) {
      Rod other = rods[j];
      Vec3 between = other.position - rods[i].position;
      between = between - Vec3{side.x * std::round(between.x / side.x),
                               side.y * std::round(between.y / side.y),
                               side.z * std::round(between.z / side.z)};
      if (norm(between) > 0.5 * (rods[i].length + other.length)) continue;
      other.position = rods[i].position + between;
      pairs += slow_distance(rods[i], other) < rods[i].radius() + other.radius();
    }
  return pairs;
}

// Rods whose state is not the same to the last bit.
int different(const std::vector<Frame> &a, const std::vector<Frame> &b)
{
  const auto same = [](const Vec3 &u, const Vec3 &v) {
    return u.x == v.x && u.y == v.y && u.z == v.z;
  };
  if (a.empty() || a.size() != b.size()) return -1;
  int count = 0;
  for (size_t f = 0; f < a.size(); f++) {
    if (a[f].rods.size() != b[f].rods.size()) return -1;
    for (size_t k = 0; k < a[f].rods.size(); k++) {
      const Rod &one = a[f].rods[k], &other = b[f].rods[k];
      count += !same(one.position, other.position) || !same(one.axis, other.axis) ||
               !same(one.velocity, other.velocity) || !same(one.omega, other.omega);
    }
  }
  return count;
}

class NeededGhosts : public testing::TestWithParam<Ghosts> {};

TEST_P(NeededGhosts, MissNoContactAndChangeNoBit)
{
  const Ghosts &given = GetParam();
  const Result needed = run_scene(given, ""), all = run_scene(given, "ghosts all");
  ASSERT_EQ(needed.frames.size(), kParts + 1u);
  ASSERT_EQ(needed.sides.size(), needed.frames.size());
  long touched = 0;
  for (size_t f = 0; f < needed.frames.size(); f++) {
    const Frame &frame = needed.frames[f];
    const long touching = touching_pairs(frame.rods, needed.sides[f]);
    double counted = 0.0;
    for (const double contacts : frame.contacts) counted += contacts;
    EXPECT_EQ(counted, 2.0 * static_cast<double>(touching)) << "step " << frame.step;
    touched += touching;
  }
  EXPECT_GE(touched, 5);
  EXPECT_EQ(different(needed.frames, all.frames), 0);
  const Report few = read_report(needed.output), many = read_report(all.output);
  fmt::print("{}: bytes sent by a rank in a step {:.0f} of {:.0f}, asked for {} times\n",
             given.name, few.bytes, many.bytes, few.asked);
  EXPECT_LT(few.bytes, many.bytes);
  EXPECT_GE(few.asked, 1);
  EXPECT_EQ(many.asked, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Runs, NeededGhosts,
    testing::Values(
        Ghosts{"TwoRanks", {2, 1, 1}}, Ghosts{"CutInZ", {1, 1, 2}}, Ghosts{"ThreeRanks", {1, 3, 1}},
        Ghosts{"FourRanks", {2, 2, 1}}, Ghosts{"EightRanks", {2, 2, 2}},
        Ghosts{"ThinSubdomains", {4, 1, 1}}, Ghosts{"ThinnerSubdomains", {8, 1, 1}},
        Ghosts{"OpenSides", {2, 2, 1}, "", "", "", "pre no", false},
        Ghosts{"OfAThinSkin", {2, 1, 1}, "close_skin 1e-4"},
        Ghosts{"OfAWideSkin", {2, 1, 1}, "close_skin 0.01"},
        Ghosts{"OfManyBuilds", {2, 2, 1}, "", "", "", "pre no", true, 0.004},
        Ghosts{"OfChangingSkins",
               {2, 1, 2},
               "",
               "",
               "variable skin equal 0.02+0.01*(${part}%4)\nneighbor ${skin} bin\n",
               ""},
        Ghosts{"OfTwoThreads", {2, 1, 1}, "threads 2"},
        // Nothing moves on the other ranks until it comes.
        Ghosts{"OfOneThatIsShot",
               {4, 1, 1},
               "close_skin 1e-4",
               "",
               "",
               "pre no",
               true,
               0.08,
               200,
               40.0},
        Ghosts{"OfFewThatAreShot",
               {2, 2, 1},
               "close_skin 1e-4",
               "",
               "",
               "pre no",
               true,
               0.08,
               40,
               40.0},
        // Far from all others before.
        Ghosts{"OfADiluteGas",
               {2, 1, 1},
               "close_skin 1e-3",
               "",
               "",
               "pre no",
               true,
               0.08,
               20,
               100.0,
               0.01},
        Ghosts{"OfADiluteGasInFour", {4, 1, 1}, "", "", "", "pre no", true, 0.08, 20, 100.0, 0.02},
        // A third of a diameter in a step, beyond what a ghost may be off.
        Ghosts{"Jumping", {2, 2, 1}, "sudden_overlap on", "", "", "pre no", true, 0.08, 8, 400.0},
        // Rods put among those of other ranks overlap none of them.
        Ghosts{"OfMoreAndMore",
               {2, 2, 1},
               "",
               "region place sphere 0.0 0.0 0.0 0.3 units box\n"
               "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant "
               "2700 radius constant 0.005 length constant 0.06\n"
               "fix rods all particledistribution/discrete 32452843 1 rod 1.0\n"
               "fix pack all insert/pack seed 86028121 distributiontemplate rods insert_every 150 "
               "overlapcheck yes orientation random all_in no maxattempt 200 "
               "vel constant 20.0 0.0 0.0 region place particles_in_region 240\n",
               "",
               "pre no",
               false},
        Ghosts{"OfFewerAndFewer",
               {2, 2, 1},
               "",
               "",
               "group gone id ${part}\ndelete_atoms group gone compress no\n",
               ""},
        Ghosts{"Driven",
               {2, 2, 1},
               "",
               "group driven id <> 1 20\ngroup free subtract all driven\nunfix motion\n"
               "fix motion free nve/spherocylinder\n"
               "fix drive driven move rotate 0.0 0.0 0.0 0.0 0.0 1.0 0.02\n"},
        Ghosts{"Squeezed",
               {2, 1, 1},
               "",
               "fix squeeze all deform 13 x scale 0.98 y scale 0.99 remap x units box\n",
               "",
               ""},
        Ghosts{"Stretched",
               {3, 1, 1},
               "",
               "fix stretch all deform 3 x vel 20.0 remap none units box\n",
               "",
               ""},
        Ghosts{"Balanced",
               {4, 1, 1},
               "",
               "fix even all balance 10 1.0 shift x 12 1.02\n",
               "",
               "pre no",
               true,
               0.02},
        Ghosts{"BalancedInZ",
               {1, 2, 2},
               "",
               "fix even all balance 10 1.0 shift yz 12 1.02\n",
               "",
               "pre no",
               true,
               0.03}),
    [](const auto &info) { return std::string(info.param.name); });

// Of the same deck with `commands` before the run: the end of it.
struct End {
  std::string output;
  Table thermo;
};

End run_with(const std::string &keywords, const std::string &commands, int parts = 4)
{
  const Ghosts given{"", {2, 2, 1}};
  const Scene scene = shot_through(given);
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write(
      "in.ghosts",
      preamble(scene) + "processors 2 2 1\nread_data rods.data\nneighbor 0.02 bin\n" +
          linear_material(1e5, 5e4, 0.9, 0.3) + rod_pair("linear tangential history", keywords) +
          "fix motion all nve/spherocylinder\nthermo_modify norm no lost error\n" + commands +
          fmt::format("timestep {}\nthermo 100\nrun {}\n", scene.dt, 100 * parts));
  const Outcome outcome = folder.run("in.ghosts", {Program::Lmp, 4, 120});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return {};
  return {outcome.output, read_thermo(outcome.output)};
}

// Computes that look at all rods near one get them as they are, and the log says for which.
TEST(GhostsOfReaders, AreAllSent)
{
  const char *const readers[] = {"coord/atom 0.05", "cluster/atom 0.05", "centro/atom 12",
                                 "cna/atom 0.05"};
  for (const std::string reader : readers) {
    const std::string commands =
        "compute seen all " + reader +
        "\ncompute sum all reduce sum c_seen\nthermo_style custom step c_sum\n";
    const End needed = run_with("", commands), all = run_with("ghosts all", commands);
    const std::string style = reader.substr(0, reader.find(' '));
    EXPECT_NE(needed.output.find("Rod ghosts: all are sent, for Compute " + style + " (id seen)"),
              std::string::npos)
        << needed.output;
    ASSERT_EQ(needed.thermo.rows.size(), 5u);
    for (size_t row = 0; row < needed.thermo.rows.size(); row++)
      EXPECT_EQ(needed.thermo.at(row, "sum"), all.thermo.at(row, "sum")) << reader;
    EXPECT_EQ(read_report(needed.output).bytes, read_report(all.output).bytes);
  }
}

TEST(GhostsOfReaders, AreThoseNeededElse)
{
  const End end =
      run_with("", "compute centres all com\nfix mean all ave/time 1 1 1 c_centres mode vector\n"
                   "compute motion all temp\ncompute pressure all pressure motion\n"
                   "thermo_style custom step c_pressure\n");
  EXPECT_EQ(end.output.find("all are sent"), std::string::npos);
  EXPECT_GE(read_report(end.output).asked, 1);
}

TEST(GhostsKeyword, IsNeededOrAll)
{
  const Scene scene = shot_through({"", {1, 1, 1}});
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.ghosts", preamble(scene) + "read_data rods.data\n" +
                                rod_pair("linear tangential history", "ghosts some"));
  const Outcome outcome = folder.run("in.ghosts");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("ghosts must be needed or all (got some)"), std::string::npos)
      << outcome.output;
}

}  // namespace
