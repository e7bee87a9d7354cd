// SPDX-License-Identifier: GPL-2.0-or-later
// Subdomains thinner than the rods' range, rods that go from rank to rank with their contacts, cuts
// that follow a filling bed: the motion is that of one rank, or the run ends with one sentence.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;

namespace {

// Forces of a rod with several contacts may be added in another order; collisions and friction make
// that round-off grow by about ten every 1,000 steps (bench/README.md).
constexpr double kSameMotion = 1e-12;  // m

using Processors = std::array<int, 3>;

const std::string kModels = "linear tangential history";
const std::string kMotion = "fix motion all nve/spherocylinder\n";

Outcome run_on(const Processors &n, const DeckFolder &folder, const std::string &deck)
{
  return folder.run(deck, {Program::Lmp, n[0] * n[1] * n[2], 60});
}

// The whole deck up to `run`; `physics` and `steps` of the scene are left to the caller.
std::string begin(const Scene &scene, const Processors &n)
{
  return preamble(scene) + fmt::format("processors {} {} {}\nread_data rods.data\nneighbor {} bin\n"
                                       "neigh_modify delay 0\ntimestep {}\n"
                                       "compute contacts all contact/spherocylinder\n",
                                       n[0], n[1], n[2], scene.skin, scene.dt);
}

struct Motion {
  std::vector<Frame> frames;
  std::string output;
};

// `between`: commands between two halves of the run.
Motion run_scene(const Scene &scene, const Processors &n, const std::string &between = "")
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  const std::string run = fmt::format("run {}\n", between.empty() ? scene.steps : scene.steps / 2);
  folder.write("in.ranks", begin(scene, n) + scene.physics +
                               exact_dump("dump.rods", scene.steps / 2, kFrameColumns) + run +
                               between + (between.empty() ? "" : run));
  const Outcome outcome = run_on(n, folder, "in.ranks");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  return {read_frames(folder / "dump.rods", scene), outcome.output};
}

// Of centres and, with the axes, of ends; by the nearest image where the box is periodic.
double difference(const Scene &scene, const Frame &a, const Frame &b)
{
  if (a.rods.size() != b.rods.size() || a.step != b.step) return INFINITY;
  double largest = 0.0;
  for (size_t i = 0; i < a.rods.size(); i++) {
    const Vec3 between = a.rods[i].position - b.rods[i].position;
    double shift[3] = {between.x, between.y, between.z};
    for (int d = 0; d < 3; d++) {
      const double side = scene.box_hi[d] - scene.box_lo[d];
      if (scene.boundary[2 * d] == 'p') shift[d] -= side * std::round(shift[d] / side);
    }
    largest = std::max({largest, norm(Vec3{shift[0], shift[1], shift[2]}),
                        norm(a.rods[i].axis - b.rods[i].axis) * a.rods[i].half_cylinder()});
  }
  return largest;
}

double touching(const Frame &frame)
{
  double sum = 0.0;
  for (const double contacts : frame.contacts) sum += contacts;
  return 0.5 * sum;
}

void expect_same_motion(const std::string &what, const Scene &scene, const Motion &one,
                        const Motion &many)
{
  ASSERT_FALSE(one.frames.empty());
  ASSERT_EQ(one.frames.size(), many.frames.size());
  expect_holds({what + ": position (m)", "one rank", kSameMotion},
               difference(scene, one.frames.back(), many.frames.back()));
  EXPECT_EQ(touching(one.frames.back()), touching(many.frames.back()));
}

void box(Scene &scene, double x, double y, double z)
{
  const double half[3] = {0.5 * x, 0.5 * y, 0.5 * z};
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -half[d];
    scene.box_hi[d] = half[d];
  }
}

// Rods of length 0.1 that do not overlap, nor their images, in random motion.
Scene periodic_gas(double x, double y, double z, int rods)
{
  std::mt19937 random(40009);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  Scene scene;
  box(scene, x, y, z);
  scene.boundary = "p p p";
  const auto is_free = [&](const Rod &rod) {
    for (Rod other : scene.rods) {
      const Vec3 at = other.position;
      for (int image = 0; image < 27; image++) {
        other.position =
            at + Vec3{x * (image % 3 - 1), y * (image / 3 % 3 - 1), z * (image / 9 - 1)};
        if (norm(other.position - rod.position) < rod.length &&
            slow_distance(other, rod) < rod.diameter)
          return false;
      }
    }
    return true;
  };
  while (scene.rods.size() < static_cast<size_t>(rods)) {
    Rod rod;
    rod.position = {x * place(random), y * place(random), z * place(random)};
    rod.axis = normalized(vector());
    rod.velocity = 2.0 * vector();
    rod.omega = 5.0 * vector();
    if (is_free(rod)) scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e5, 5e4, 0.7, 0.3) + rod_pair(kModels) + kMotion;
  scene.dt = 1e-5;
  scene.steps = 1000;
  return scene;
}

// Ghosts come from 0.12 away (length and skin): from up to three ranks off, and where a period is
// short from both sides of the same rank and from a rank's own rods.
TEST(Subdomains, SubdomainsThinnerThanTheRange)
{
  const Scene scene = periodic_gas(0.22, 0.22, 0.22, 100);
  const Motion one = run_scene(scene, {1, 1, 1});
  EXPECT_GE(touching(one.frames.back()), 3.0);
  expect_same_motion("Subdomains of half the range, 4 ranks", scene, one,
                     run_scene(scene, {4, 1, 1}));
}

TEST(Subdomains, PeriodBetweenOneAndTwoRods)
{
  const Scene scene = periodic_gas(0.15, 0.15, 0.15, 40);
  const Motion one = run_scene(scene, {1, 1, 1});
  EXPECT_NE(one.output.find("two rods may touch through two images"), std::string::npos);
  EXPECT_GE(touching(one.frames.back()), 3.0);
  expect_same_motion("Period of 1.5 rods, 4 ranks", scene, one, run_scene(scene, {4, 1, 1}));
}

// Rods pass whole subdomains between two rebuilds of the lists, half a skin of 0.16 apart.
TEST(Subdomains, ThinnerThanHalfTheSkin)
{
  Scene scene = periodic_gas(0.18, 0.22, 0.22, 24);
  scene.skin = 0.16;
  scene.steps = 2000;
  for (Rod &rod : scene.rods) rod.velocity = 3.0 * rod.velocity;
  const Motion one = run_scene(scene, {1, 1, 1});
  expect_same_motion("Subdomains of less than half the skin, 4 ranks", scene, one,
                     run_scene(scene, {4, 1, 1}));
}

// Six rods; LIGGGHTS shrinks the box of the data file to them, and again when the last is gone: cuts
// are elsewhere at once.
TEST(Subdomains, CutsThatJumpWithTheBox)
{
  Scene scene;
  for (const double z : {0.0, 0.1, 0.2, 0.3, 0.4, 10.0}) {
    scene.rods.emplace_back();
    scene.rods.back().position.z = z;
  }
  scene.boundary = "f f s";
  box(scene, 1.0, 1.0, 22.0);
  scene.physics = linear_material(1e5, 5e4, 0.7, 0.3) + rod_pair(kModels) + kMotion;
  scene.dt = 1e-5;
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.ranks", begin(scene, {1, 1, 4}) + scene.physics +
                               "run 1\ngroup far id 6\ndelete_atoms group far\nrun 1\n");
  const Outcome outcome = run_on({1, 1, 4}, folder, "in.ranks");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table thermo = read_thermo(outcome.output);
  EXPECT_EQ(thermo.at(thermo.rows.size() - 1, "Atoms"), 5.0);
}

// Pairs of crossed rods pressed together and held against sliding by friction travel through the
// cuts. Without its history a pair would begin anew with a slack tangential spring.
Scene travelling_pairs()
{
  Scene scene;
  scene.types = 2;
  box(scene, 1.0, 1.0, 1.0);
  const double force = 1.0, kn = 1e5;
  for (int k = 0; k < 6; k++) {
    Rod a;
    a.position = {-0.06 - 0.012 * k, -0.35 + 0.14 * k, -0.06 - 0.012 * k};
    a.velocity = {4.0, 0.0, 4.0};
    Rod b = a;
    b.type = 2;
    b.axis = {0.0, 1.0, 0.0};
    b.position.z += a.diameter - force / kn;
    scene.rods.push_back(a);
    scene.rods.push_back(b);
  }
  scene.physics =
      linear_material(kn, 5e4, 0.5, 0.5, 2) + rod_pair(kModels) + kMotion +
      fmt::format("group lower type 1\ngroup upper type 2\n"
                  "fix up lower addforce 0.05 0.0 {0}\nfix down upper addforce -0.05 0.0 -{0}\n",
                  force);
  scene.dt = 1e-5;
  scene.steps = 4000;
  return scene;
}

class Travelling : public testing::TestWithParam<Processors> {};

TEST_P(Travelling, PairsTakeTheirSpringsAlong)
{
  const Scene scene = travelling_pairs();
  const Motion one = run_scene(scene, {1, 1, 1}), many = run_scene(scene, GetParam());
  for (const Rod &rod : one.frames.back().rods)
    EXPECT_GT(rod.position.x, 0.02) << "not past the cut";
  EXPECT_EQ(touching(one.frames.back()), 6.0);
  expect_same_motion("Pressed pairs through the cuts", scene, one, many);
}

INSTANTIATE_TEST_SUITE_P(Subdomains, Travelling,
                         testing::Values(Processors{2, 1, 1}, Processors{1, 1, 2},
                                         Processors{2, 1, 2}, Processors{3, 1, 1},
                                         Processors{2, 2, 2}));

// A tall vessel, rods over half its height that fall on its floor.
Scene filling_vessel()
{
  Scene scene = periodic_gas(0.12, 0.12, 0.5, 40);
  scene.boundary = "f f f";
  box(scene, 0.4, 0.4, 1.2);
  for (Rod &rod : scene.rods) rod.velocity = {0.0, 0.0, -6.0};
  scene.physics = linear_material(2e4, 6e3, 0.5, 0.3) + rod_pair(kModels) + kMotion +
                  rod_wall("floor", kModels, "type 1 zplane -0.32") +
                  rod_wall("side", kModels, "type 1 zcylinder 0.12 0.0 0.0");
  scene.skin = 0.005;
  scene.dt = 2e-5;
  scene.steps = 4000;
  return scene;
}

class Filling : public testing::TestWithParam<Processors> {
 public:
  static const Motion &on_one_rank()
  {
    static const Motion motion = run_scene(filling_vessel(), {1, 1, 1});
    return motion;
  }
};

TEST_P(Filling, RodsMigrate)
{
  EXPECT_GE(touching(on_one_rank().frames.back()), 5.0);
  expect_same_motion("Filling vessel", filling_vessel(), on_one_rank(),
                     run_scene(filling_vessel(), GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Subdomains, Filling,
                         testing::Values(Processors{2, 1, 1}, Processors{1, 1, 4}));

class Balanced : public Filling {};

// Of an even division of n rods over the ranks, whole rods and one more for the cut's place: a
// bisection of 12 steps finds it to 1.2/2^12 = 0.3 mm.
double nearly_even(size_t rods, int ranks)
{
  return (std::ceil(static_cast<double>(rods) / ranks) + 1.0) * ranks / static_cast<double>(rods);
}

std::string watched(double threshold, const std::string &weight = "")
{
  return fmt::format("fix bal all balance 50 {} shift z 12 1.02{}\nthermo 50\n"
                     "thermo_style custom step atoms f_bal f_bal[1] f_bal[2] f_bal[3]\n"
                     "thermo_modify norm no lost error\n",
                     threshold, weight);
}

double worst_late_imbalance(const Table &thermo)
{
  double worst = 0.0;
  for (size_t row = thermo.rows.size() / 2; row < thermo.rows.size(); row++)
    worst = std::max(worst, thermo.at(row, "bal"));
  return worst;
}

// The cuts follow the rods down: at most as many rods move past a cut between two looks as fall
// through it, 50 steps of 0.12 mm.
TEST_P(Balanced, ByFix)
{
  Scene left = filling_vessel(), scene = left;
  const int ranks = GetParam()[2];
  left.physics += watched(100.0);
  scene.physics += watched(1.0);
  const Motion unbalanced = run_scene(left, GetParam()), balanced = run_scene(scene, GetParam());
  expect_same_motion("Filling vessel, fix balance", scene, on_one_rank(), balanced);

  const Table before = read_thermo(unbalanced.output), after = read_thermo(balanced.output);
  fmt::print("imbalance at the end: {} without, {} with\n",
             before.at(before.rows.size() - 1, "bal"), after.at(after.rows.size() - 1, "bal"));
  EXPECT_GE(before.at(before.rows.size() - 1, "bal"), 1.8);
  EXPECT_EQ(before.at(before.rows.size() - 1, "bal[2]"), 0.0);
  EXPECT_LE(worst_late_imbalance(after), nearly_even(scene.rods.size(), ranks) + 0.15);
  EXPECT_GE(after.at(after.rows.size() - 1, "bal[2]"), 5.0);
  EXPECT_DOUBLE_EQ(after.at(0, "bal[1]"), after.at(0, "bal") * scene.rods.size() / ranks);
}

// Two runs are not one twice as long: LIGGGHTS begins each with forces of its own, so that one rank
// gets the command too.
TEST_P(Balanced, ByCommandBetweenRuns)
{
  const Scene scene = filling_vessel();
  const std::string command = "balance 1.0 shift z 12 1.02\n";
  const Motion motion = run_scene(scene, GetParam(), command);
  expect_same_motion("Filling vessel, balance", scene, run_scene(scene, {1, 1, 1}, command),
                     motion);
  const std::string says = "initial/final imbalance factor = ";
  const size_t at = motion.output.find(says);
  ASSERT_NE(at, std::string::npos) << motion.output;
  double initial = 0.0, final = 0.0;
  std::istringstream(motion.output.substr(at + says.size())) >> initial >> final;
  EXPECT_GE(initial, 1.5);
  EXPECT_LE(final, nearly_even(scene.rods.size(), GetParam()[2]));
}

// The cuts follow what is touching: the motion is that of one rank, and nobody waits long. In half of 50
// steps rods fall by 3 mm, and a rod with ten close pairs costs as much as three without.
TEST_P(Balanced, ByCost)
{
  Scene scene = filling_vessel();
  scene.physics += watched(1.0, " weight neigh 0.2");
  const Motion balanced = run_scene(scene, GetParam());
  expect_same_motion("Filling vessel, fix balance by cost", scene, on_one_rank(), balanced);
  const Table after = read_thermo(balanced.output);
  fmt::print("imbalance at the end: {}\n", after.at(after.rows.size() - 1, "bal"));
  EXPECT_LE(worst_late_imbalance(after), nearly_even(scene.rods.size(), GetParam()[2]) + 0.2);
  EXPECT_GE(after.at(after.rows.size() - 1, "bal[2]"), 5.0);
}

INSTANTIATE_TEST_SUITE_P(Subdomains, Balanced,
                         testing::Values(Processors{1, 1, 2}, Processors{1, 1, 4}));

// The run must end with one sentence that holds these parts.
void expect_error(const Scene &scene, const Processors &n, const std::string &commands,
                  const std::vector<std::string> &parts)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.ranks", begin(scene, n) + scene.physics + commands);
  const Outcome outcome = run_on(n, folder, "in.ranks");
  EXPECT_NE(outcome.exit_code, 0) << outcome.output;
  std::istringstream lines(outcome.output);
  std::string line, sentence;
  int sentences = 0;
  while (std::getline(lines, line)) {
    if (line.rfind("ERROR", 0) != 0) continue;
    sentence = line;
    sentences++;
  }
  EXPECT_EQ(sentences, 1) << outcome.output;
  for (const std::string &part : parts)
    EXPECT_NE(sentence.find(part), std::string::npos)
        << "wanted: " << part << "\ngot: " << sentence;
}

Scene few_rods(const std::vector<Vec3> &places)
{
  Scene scene;
  for (const Vec3 &place : places) {
    Rod rod;
    rod.position = place;
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e5, 5e4, 0.5, 0.3) + rod_pair(kModels) + kMotion;
  scene.dt = 1e-5;
  return scene;
}

// The second rod, beside the first and half a period further, lies at both its ends.
TEST(RanksErrors, TouchThroughTwoImages)
{
  Scene scene = few_rods({{0.0, 0.0, 0.0}, {0.075, 0.00999, 0.0}});
  box(scene, 0.15, 1.0, 1.0);
  scene.boundary = "p f f";
  for (const Processors &n : {Processors{1, 1, 1}, Processors{2, 1, 1}})
    expect_error(scene, n, "neigh_modify every 1 check no\nrun 10\n",
                 {"at step 1 rods", "two periodic images", "longer than two rods"});
}

TEST(RanksErrors, PeriodThatShrinksInARun)
{
  Scene scene = few_rods({{0.0, 0.0, 0.0}});
  box(scene, 0.16, 1.0, 1.0);
  scene.boundary = "p f f";
  expect_error(scene, {2, 1, 1}, "fix squeeze all deform 1 x vel -10\nrun 1000\n",
               {"periodic in x with 0.", "its own image"});
}

TEST(RanksErrors, Balance)
{
  const Scene scene = few_rods({{0.0, 0.0, 0.0}});
  const std::string fix = "fix bal all balance ";
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"balance 1.1 shift z 10", "Balance command: expected thresh shift dimstr Niter stopthresh"},
      {"balance 0.9 shift z 10 1.1", "thresh must be >= 1 (got 0.9)"},
      {"balance 1.1 rcb z 10 1.1", "unknown style rcb (expected shift)"},
      {"balance 1.1 shift zz 10 1.1", "each at most once (got zz)"},
      {"balance 1.1 shift w 10 1.1", "x, y and z, each at most once (got w)"},
      {"balance 1.1 shift z 0 1.1", "Niter must be >= 1 (got 0)"},
      {"balance 1.1 shift z 10 0.5", "stopthresh must be >= 1 (got 0.5)"},
      {fix + "-1 1.1 shift z 10 1.1", "Fix balance (id bal): Nevery must be >= 0 (got -1)"},
      {"group one id 1\nfix bal one balance 10 1.1 shift z 10 1.1", "group must be all"},
      {fix + "10 1.1 shift z 10", "Fix balance (id bal): expected thresh shift"}};
  for (const auto &[command, says] : wrong)
    expect_error(scene, {1, 1, 1}, command + "\nrun 1\n", {says});

  expect_error(scene, {1, 1, 1},
               "run 0\nwrite_restart half\nclear\n" + preamble(scene) +
                   "read_restart half\nbalance 1.1 shift z 10 1.1\n",
               {"between read_restart and the first run"});

  Scene thin = scene;
  box(thin, 0.1, 1.0, 1.0);
  thin.skin = 0.06;
  expect_error(thin, {2, 1, 1}, fix + "10 1.1 shift x 10 1.1\nrun 1\n",
               {"cut into 2 parts in x, on average 0.05 long", "neighbour skin, 0.06"});
}

}  // namespace
