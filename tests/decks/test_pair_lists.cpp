// SPDX-License-Identifier: GPL-2.0-or-later
// The two lists of near rods: they hold what they say, and no motion depends on them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rod_gas.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;

namespace {

// The lines after a run.
struct Report {
  long listed = -1, close = -1, touching = -1, builds = -1, refreshes = -1;
  double list_skin = -1.0, close_skin = -1.0;
};

Report read_report(const std::string &output)
{
  Report report;
  const size_t begin = output.find("Rod pairs: ");
  if (begin == std::string::npos) return report;
  sscanf(
      output.c_str() + begin,
      "Rod pairs: listed = %ld, close = %ld, touching = %ld Rod pair list builds = %ld (skin %lf), "
      "close pair refreshes = %ld (skin %lf)",
      &report.listed, &report.close, &report.touching, &report.builds, &report.list_skin,
      &report.refreshes, &report.close_skin);
  return report;
}

struct Result {
  Report report;
  std::string output;
  std::vector<Frame> frames;
};

// `keywords` of the pair style, `commands` before the run, what follows `run N`.
Result run_with(const Scene &scene, const std::string &keywords, const std::string &commands = "",
                Mode mode = Mode::OneRank, const std::string &run_options = "")
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.lists",
               preamble(scene, mode) + "read_data rods.data\n" +
                   fmt::format("neighbor {} bin\n", scene.skin) +
                   linear_material(1e5, 5e4, 0.9, 0.3) +
                   "pair_style gran model linear tangential history surface spherocylinder " +
                   keywords + "\npair_coeff * *\nfix motion all nve/spherocylinder\n" + commands +
                   "compute contacts all contact/spherocylinder\n" +
                   exact_dump("dump.lists", scene.dump_every, kFrameColumns) +
                   fmt::format("timestep {}\nrun {} {}\n", scene.dt, scene.steps, run_options));
  const Outcome outcome = folder.run("in.lists", {Program::Lmp, mode == Mode::TwoRanks ? 2 : 1});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return {};
  return {read_report(outcome.output), outcome.output, read_frames(folder / "dump.lists", scene)};
}

// Rods of 8-16 and spheres of 1 diameter thrown into a box without regard to overlap.
Scene heap()
{
  std::mt19937 random(50021);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::normal_distribution<double> normal;
  Scene scene;
  for (int i = 0; i < 200; i++) {
    Rod rod;
    rod.diameter = i % 2 ? 0.01 : 0.016;
    rod.length = i % 5 == 0 ? rod.diameter : rod.diameter * (8.0 + i % 8);
    rod.position = 0.15 * Vec3{any(random), any(random), any(random)};
    rod.axis = normalized({normal(random), normal(random), normal(random)});
    scene.rods.push_back(rod);
  }
  scene.dump_every = 1;
  return scene;
}

long pairs_nearer_than(double gap, const Scene &scene)
{
  long pairs = 0;
  for (size_t i = 0; i < scene.rods.size(); i++)
    for (size_t j = i + 1; j < scene.rods.size(); j++) {
      const Rod &a = scene.rods[i], &b = scene.rods[j];
      pairs += slow_distance(a, b) < a.radius() + b.radius() + gap;
    }
  return pairs;
}

// A gas with friction and histories, fast and turning; at least one collision a rod.
Scene gas(int rods = 120, double volume_fraction = 0.06)
{
  RodGas gas;
  gas.rods = rods;
  gas.shortest = 0.3;
  gas.volume_fraction = volume_fraction;
  Scene scene = scene_of(gas);
  scene.skin = 0.08;  // LIGGGHTS seldom builds its lists
  scene.dt = shortest_contact(gas) / 40.0;
  scene.steps = 6000;
  scene.dump_every = 40;  // each contact is seen
  return scene;
}

// Rods whose state is not the same to the last bit.
int different(const std::vector<Frame> &a, const std::vector<Frame> &b)
{
  const auto same = [](const Vec3 &u, const Vec3 &v) {
    return u.x == v.x && u.y == v.y && u.z == v.z;
  };
  if (a.empty() || a.size() != b.size()) return -1;
  int count = 0;
  for (size_t f = 0; f < a.size(); f++)
    for (size_t k = 0; k < a[f].rods.size(); k++) {
      const Rod &one = a[f].rods[k], &other = b[f].rods[k];
      count += !same(one.position, other.position) || !same(one.axis, other.axis) ||
               !same(one.velocity, other.velocity) || !same(one.omega, other.omega);
    }
  return count;
}

// Pairs that touch, of a periodic cube of this side or of none (0), by trying all.
long touching_pairs(const std::vector<Rod> &rods, double side)
{
  long pairs = 0;
  for (size_t i = 0; i < rods.size(); i++)
    for (size_t j = i + 1; j < rods.size(); j++) {
      Rod other = rods[j];
      Vec3 between = other.position - rods[i].position;
      if (side > 0.0)
        between = between - side * Vec3{std::round(between.x / side), std::round(between.y / side),
                                        std::round(between.z / side)};
      if (norm(between) > 0.5 * (rods[i].length + other.length)) continue;
      other.position = rods[i].position + between;
      pairs += slow_distance(rods[i], other) < rods[i].radius() + other.radius();
    }
  return pairs;
}

// A run in parts of 100 steps, after each of which the lists are looked at.
struct InParts {
  const char *name;
  bool periodic = false;
  const char *keywords = "";
  const char *before = "";   // the run
  const char *between = "";  // the parts, which are numbered by ${part}
  const char *options = "pre no";
  int ranks = 1;
};

void PrintTo(const InParts &run, std::ostream *out) { *out << run.name; }

class PairListsInParts : public testing::TestWithParam<InParts> {};

// Rods at rest and, each eighth, rods shot through them: most of the list stays as it is.
Scene shot_through()
{
  Scene scene = gas(300, 0.15);
  for (size_t k = 0; k < scene.rods.size(); k++) {
    Rod &rod = scene.rods[k];
    const double faster = k % 8 == 0 ? 6.0 : 0.0;
    rod.velocity = faster * rod.velocity;
    rod.omega = faster * rod.omega;
  }
  return scene;
}

}  // namespace

// Whatever moves, comes or goes, and whichever lists are made anew: those that touch are those found by
// trying all pairs, in the list (whose contacts the compute counts) and among the close pairs.
TEST_P(PairListsInParts, HoldAllThatTouch)
{
  constexpr int kParts = 40;
  const InParts &given = GetParam();
  Scene scene = shot_through();
  const double side = given.periodic ? scene.box_hi[0] - scene.box_lo[0] : 0.0;
  if (!given.periodic) {
    scene.boundary = "f f f";
    for (int d = 0; d < 3; d++) {
      scene.box_lo[d] *= 4.0;
      scene.box_hi[d] *= 4.0;
    }
  }
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.parts",
               preamble(scene, given.ranks == 2 ? Mode::TwoRanks : Mode::OneRank) +
                   "read_data rods.data\n" + fmt::format("neighbor {} bin\n", scene.skin) +
                   linear_material(1e5, 5e4, 0.9, 0.3) +
                   "pair_style gran model linear tangential history surface spherocylinder " +
                   given.keywords + "\npair_coeff * *\nfix motion all nve/spherocylinder\n" +
                   "compute contacts all contact/spherocylinder\n" +
                   exact_dump("dump.parts", 100, kFrameColumns) +
                   fmt::format("timestep {}\n", scene.dt) + given.before +
                   fmt::format("run 0\nvariable part loop {}\nlabel part\n{}run 100 {}\n"
                               "next part\njump SELF part\n",
                               kParts, given.between, given.options));
  const Outcome outcome = folder.run("in.parts", {Program::Lmp, given.ranks});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::vector<Frame> frames = read_frames(folder / "dump.parts", scene);

  long all = 0;
  size_t place = 0;
  for (const Frame &frame : frames) {
    const long touching = touching_pairs(frame.rods, side);
    double counted = 0.0;
    for (const double contacts : frame.contacts) counted += contacts;
    EXPECT_EQ(counted, 2.0 * static_cast<double>(touching)) << "step " << frame.step;
    place = outcome.output.find("Rod pairs: ", place);
    ASSERT_NE(place, std::string::npos);
    if (given.ranks == 1 && !given.periodic) {
      EXPECT_EQ(read_report(outcome.output.substr(place)).touching, touching)
          << "step " << frame.step;
    }
    place++;
    all += touching;
  }
  EXPECT_EQ(frames.size(), kParts + 1u);
  EXPECT_GT(all, 40);
}

INSTANTIATE_TEST_SUITE_P(
    Runs, PairListsInParts,
    testing::Values(
        InParts{"ShotThrough"}, InParts{"Periodic", true},
        InParts{"OfAThinSkin", false, "close_skin 1e-4"},
        InParts{"OfAWideSkin", true, "close_skin 0.01"},
        InParts{"OnTwoRanks", true, "", "", "", "pre no", 2},
        InParts{"OfFewerAndFewer", true, "", "",
                "group gone id ${part}\ndelete_atoms group gone compress no\n", ""},
        InParts{"OfMoreAndMore", false, "",
                "region place sphere 0.0 0.0 0.0 0.3 units box\n"
                "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant "
                "2700 radius constant 0.005 length constant 0.06\n"
                "fix rods all particledistribution/discrete 32452843 1 rod 1.0\n"
                "fix pack all insert/pack seed 86028121 distributiontemplate rods insert_every 250 "
                "overlapcheck yes orientation random all_in no maxattempt 100 "
                "vel constant 20.0 0.0 0.0 region place particles_in_region 400\n"}),
    [](const auto &info) { return std::string(info.param.name); });

TEST(PairLists, HoldThePairsNearerThanTheirSkins)
{
  const Scene scene = heap();
  for (const char *keywords : {"", "close_skin 0.007", "close_skin auto"}) {
    const Report report = run_with(scene, keywords).report;
    EXPECT_EQ(report.listed, pairs_nearer_than(report.list_skin, scene));
    EXPECT_EQ(report.close, pairs_nearer_than(report.close_skin, scene));
    EXPECT_EQ(report.touching, pairs_nearer_than(0.0, scene));
    EXPECT_GT(report.touching, 20);
    EXPECT_GT(report.close, report.touching + 20);
    EXPECT_GT(report.listed, report.close + 20);
  }
}

// Contacts, their histories and the order of the sums are the same, whatever the skins; the lists
// are made again a few times, in nearly each step, or as is best.
TEST(PairLists, DoNotChangeTheMotion)
{
  const Scene scene = gas();
  const Result chosen = run_with(scene, "");
  const Result wide = run_with(scene, "close_skin 0.02");
  const Result thin = run_with(scene, "close_skin 1e-5");
  EXPECT_GT(collisions(chosen.frames), 60.0);
  EXPECT_EQ(different(wide.frames, chosen.frames), 0);
  EXPECT_EQ(different(thin.frames, chosen.frames), 0);
  EXPECT_NE(chosen.report.close_skin, 0.003);  // the first one, 0.3 diameters
  EXPECT_EQ(wide.report.close_skin, 0.02);
  EXPECT_EQ(thin.report.close_skin, 1e-5);
  EXPECT_GT(thin.report.refreshes, 5000);
  EXPECT_LT(chosen.report.refreshes, thin.report.refreshes);
  EXPECT_LT(wide.report.refreshes, chosen.report.refreshes);
  // More than LIGGGHTS asks for, so that histories pass from list to list without it.
  long neighbour_builds = -1;
  sscanf(wide.output.c_str() + wide.output.find("Neighbor list builds"),
         "Neighbor list builds = %ld", &neighbour_builds);
  EXPECT_GE(neighbour_builds, 0);
  EXPECT_GT(wide.report.builds, neighbour_builds + 5);
}

// The rods of two ranks look at the same pairs: ghosts move and turn as their owners do. Forces are
// added in another order, which these collisions multiply: 10^-15 m after the first of them.
TEST(PairLists, AreCompleteOnTwoRanks)
{
  Scene scene = gas();
  scene.steps = 2000;
  const Result one = run_with(scene, "close_skin 1e-4");
  const Result two = run_with(scene, "close_skin 1e-4", "", Mode::TwoRanks);
  ASSERT_EQ(one.frames.size(), two.frames.size());
  double largest = 0.0;
  for (size_t f = 0; f < one.frames.size(); f++)
    for (size_t k = 0; k < scene.rods.size(); k++)
      largest =
          std::max(largest, norm(one.frames[f].rods[k].position - two.frames[f].rods[k].position));
  EXPECT_LT(largest, 1e-12);
  EXPECT_GT(collisions(one.frames), 20.0);
}

// Rods at rest beside the cut at x = 0, met by rods of the other rank that were in no list: one flies
// in, one turns. The first rank moves nothing by itself and must see them come.
TEST(PairLists, SeeGhostsComeToRodsAtRest)
{
  Scene scene;
  const auto add = [&](const Vec3 &position, const Vec3 &axis, const Vec3 &velocity,
                       const Vec3 &omega) {
    Rod rod;
    rod.position = position;
    rod.axis = axis;
    rod.velocity = velocity;
    rod.omega = omega;
    scene.rods.push_back(rod);
  };
  const Vec3 none = {0.0, 0.0, 0.0}, x = {1.0, 0.0, 0.0}, y = {0.0, 1.0, 0.0};
  add({-0.02, 0.0, 0.5}, y, none, none);
  add({0.05, 0.01, 0.5}, y, {-2.0, 0.0, 0.0}, none);
  add({-0.02, 0.0, -0.5}, y, none, none);
  add({0.011, -0.08, -0.5}, x, none, {0.0, 0.0, -40.0});
  scene.skin = 0.3;  // LIGGGHTS builds no list before they meet
  scene.dt = 1e-5;
  scene.steps = 4000;
  scene.dump_every = 1000;
  const Result one = run_with(scene, ""), two = run_with(scene, "", "", Mode::TwoRanks);
  for (const Result *result : {&one, &two}) {
    ASSERT_FALSE(result->frames.empty());
    EXPECT_NE(result->output.find("Neighbor list builds = 0"), std::string::npos);
    for (const size_t at_rest : {0, 2})
      EXPECT_GT(norm(result->frames.back().rods[at_rest].velocity), 0.1) << "rod " << at_rest;
  }
  for (size_t k = 0; k < scene.rods.size(); k++)
    EXPECT_LT(norm(one.frames.back().rods[k].position - two.frames.back().rods[k].position), 1e-12);
}

// neigh_modify exclude: LIGGGHTS's own words for pairs that are not to touch.
TEST(PairLists, LeaveOutWhatTheDeckExcludes)
{
  Scene scene = heap();
  scene.types = 2;
  for (size_t k = 0; k < scene.rods.size(); k++) scene.rods[k].type = k % 3 == 0 ? 2 : 1;
  const auto touching = [&](auto &&counts) {
    long pairs = 0;
    for (size_t i = 0; i < scene.rods.size(); i++)
      for (size_t j = i + 1; j < scene.rods.size(); j++) {
        const Rod &a = scene.rods[i], &b = scene.rods[j];
        if (counts(a.type, b.type)) pairs += slow_distance(a, b) < a.radius() + b.radius();
      }
    return pairs;
  };
  const std::string material = linear_material(1e5, 5e4, 0.9, 0.3, 2);
  const auto excluded = [&](const std::string &command) {
    return run_with(scene, "", material + command + "\n").report.touching;
  };
  const long apart = excluded("neigh_modify exclude type 1 2");
  EXPECT_EQ(apart, touching([](int a, int b) { return a == b; }));
  const long of_group = excluded("group two type 2\nneigh_modify exclude group two two");
  EXPECT_EQ(of_group, touching([](int a, int b) { return a != 2 || b != 2; }));
  EXPECT_LT(apart, touching([](int, int) { return true; }));
}

// A stone among sand: what the lists hold of the sand does not grow with the stone.
TEST(PairLists, OfThinRodsIgnoreAThickOne)
{
  Scene scene = heap();
  for (Rod &rod : scene.rods) {
    rod.length *= 0.1;
    rod.diameter *= 0.1;
    rod.position = 0.1 * rod.position;
  }
  const Report without = run_with(scene, "").report;
  Rod stone;
  stone.diameter = stone.length = 0.3;
  stone.position = {0.0, 0.0, 0.6};
  scene.rods.push_back(stone);
  const Report with = run_with(scene, "").report;
  EXPECT_GT(without.listed, 10);
  EXPECT_LT(with.listed, 8 * without.listed);  // with skins 1.5 to 3 times as wide
}

// LIGGGHTS's lists hold 2,000 neighbours of a rod unless the deck allows more.
TEST(PairLists, OfVeryLongRodsNeedNoSetting)
{
  Scene scene;
  std::mt19937 random(50021);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 3000; i++) {
    Rod rod;
    rod.length = 1.0;
    rod.position = 0.4 * Vec3{any(random), any(random), any(random)};
    rod.axis = normalized({1.0, 0.05 * any(random), 0.05 * any(random)});
    scene.rods.push_back(rod);
  }
  scene.dump_every = 1;
  const Report report = run_with(scene, "").report;
  EXPECT_GT(report.touching, 1000);
  EXPECT_EQ(report.builds, 1);
}

TEST(PairLists, AreReportedLikeTheNeighbourList)
{
  Scene scene = gas();
  scene.steps = 1000;
  EXPECT_NE(run_with(scene, "").output.find("Neighbor list builds"), std::string::npos);
  const std::string quiet = run_with(scene, "", "", Mode::OneRank, "post no").output;
  EXPECT_EQ(quiet.find("Neighbor list builds"), std::string::npos);
  EXPECT_EQ(quiet.find("Rod pair"), std::string::npos);
}
