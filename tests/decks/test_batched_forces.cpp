// SPDX-License-Identifier: GPL-2.0-or-later
// The law that works out model linear's contacts in batches against LIGGGHTS's contact models called
// one contact after the other, unobserved and under all observers.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <sstream>

#include <fmt/format.h>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

enum class Law { InBatches, LaneByLane };

// All that may look at the contacts, in each step.
constexpr const char *kObservers = R"(
fix look all check/timestep/spherocylinder 1 1.0 warn no
compute temperature all temp
compute press all pressure temperature virial
fix virial all ave/time 1 1 1 c_press file virial
compute rows all pair/gran/local id force torque contactPoint
dump rows all local 1 dump.rows c_rows[1] c_rows[2] c_rows[3] c_rows[4]
compute ends all wall/gran/local id force
dump ends all local 1 dump.ends c_ends[1] c_ends[2]
)";

enum Type { kHard = 1, kSoft = 2, kFixed = 3 };
constexpr int kTypes = 3;

// Sixty rods crosswise in layers on a floor, pressed into each other and in motion: beside each
// other (nearly parallel), across each other, some of them spheres; eighty contacts, which drive
// the heap apart. Two more rods are driven through each other elsewhere, and two fixed ones lie in
// each other with a third on top.
Scene heap()
{
  std::mt19937 random(104743);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto vector = [&](double size) {
    return size * Vec3{any(random), any(random), any(random)};
  };
  constexpr double kSpacing = 0.0099;
  Scene scene;
  scene.types = kTypes;
  scene.skin = 0.01;
  for (int layer = 0; layer < 6; layer++)
    for (int k = 0; k < 10; k++) {
      Rod rod;
      rod.diameter = 0.01 + 2e-4 * any(random);
      rod.length = k == 4 || k == 5 ? rod.diameter : 0.06 + 0.03 * any(random);
      const double across = kSpacing * (k - 4.5);
      const Vec3 slant = vector(2e-3);
      rod.axis = normalized((layer % 2 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0}) + slant);
      rod.position = {layer % 2 ? across : 2e-3 * any(random),
                      layer % 2 ? 2e-3 * any(random) : across, kSpacing * (layer + 0.49)};
      rod.velocity = vector(0.3);
      rod.omega = vector(10.0);
      scene.rods.push_back(rod);
    }

  for (const double side : {-1.0, 1.0}) {
    Rod rod;
    rod.type = kSoft;
    rod.position = {0.3, 0.3 + 1e-3 * side, 0.3 + 0.0055 * side};
    rod.axis = side < 0.0 ? Vec3{1.0, 0.2, 0.0} : Vec3{0.3, 1.0, 0.1};
    rod.axis = normalized(rod.axis);
    rod.velocity.z = -7.0 * side;
    scene.rods.push_back(rod);
  }

  for (const double angle : {-0.3, 0.3}) {
    Rod rod;
    rod.type = kFixed;
    rod.position = {-0.3 + 0.005 * angle, -0.3, 0.1};
    rod.axis = {std::cos(angle), std::sin(angle), 0.0};
    scene.rods.push_back(rod);
  }
  Rod loose;
  loose.position = {-0.3, -0.3, 0.11 - 5e-7};  // about its weight
  loose.axis = {0.0, 1.0, 0.0};
  loose.velocity = {0.1, 0.2, 0.0};
  scene.rods.push_back(loose);

  scene.box_lo[2] = -0.1;
  scene.dt = 1e-5;
  scene.steps = 600;
  scene.dump_every = 100;
  return scene;
}

// A pair's own values, so that a mix-up of types would show.
std::string material()
{
  const auto kn = [](int i, int j) { return i == kSoft && j == kSoft ? 5e3 : 1e5 + 2e4 * (i + j); };
  return pair_property("kn", kTypes, kn) +
         pair_property("kt", kTypes, [&](int i, int j) { return 0.6 * kn(i, j); }) +
         pair_property("coefficientRestitution", kTypes,
                       [](int i, int j) { return 0.4 + 0.05 * (i + j); }) +
         pair_property("coefficientFriction", kTypes,
                       [](int i, int j) { return 0.2 + 0.05 * (i + j); });
}

Scene heap(const std::string &tangential, const std::string &keywords, Law law)
{
  Scene scene = heap();
  const std::string usual = "linear tangential " + tangential;
  const std::string models = law == Law::InBatches ? usual : lane_by_lane(usual);
  scene.physics =
      material() + no_rolling_friction(kTypes) +
      fmt::format("pair_style gran model {} surface spherocylinder {}\n", models, keywords) +
      "pair_coeff * *\n" + rod_wall("floor", models, "type 1 zplane 0.0 " + keywords) +
      "group fixed type 3\ngroup loose type 1 2\nfix hold fixed freeze\n"
      "fix weight all gravity 9.81 vector 0.0 0.0 -1.0\n"
      "fix motion loose nve/spherocylinder\n";
  return scene;
}

std::vector<Frame> run_heap(const std::string &tangential, const std::string &keywords, Law law,
                            Mode mode = Mode::OneRank, const std::string &observers = "")
{
  Scene scene = heap(tangential, keywords, law);
  scene.physics += observers;
  return run(scene, mode);
}

double contacts(const Frame &frame)
{
  double sum = 0.0;
  for (const double of_rod : frame.contacts) sum += of_rod;
  return 0.5 * sum;
}

struct Case {
  const char *name, *tangential, *keywords;
};

void PrintTo(const Case &c, std::ostream *out) { *out << c.name; }

class BatchedForces : public testing::TestWithParam<Case> {};

// Rounding of the forces, 1e-16 of some ten newtons a step, on rods of some grams, and what a few
// contacts make of it. A heap held together for longer would not do with spread_contact off: as
// rods turn past parallel their closest point runs along them, and any rounding grows.
constexpr double kSameMotion = 1e-12;

void expect_same(const std::string &what, const std::vector<Frame> &frames,
                 const std::vector<Frame> &each)
{
  expect_holds({"Contacts in batches, " + what + ": position (m)",
                "LIGGGHTS's models, one contact after the other", kSameMotion},
               largest_difference(frames, each));
}

}  // namespace

TEST_P(BatchedForces, SameMotionAsOneContactAfterTheOther)
{
  const auto [name, tangential, keywords] = GetParam();
  const std::vector<Frame> each = run_heap(tangential, keywords, Law::LaneByLane);
  const std::vector<Frame> batched = run_heap(tangential, keywords, Law::InBatches);
  expect_same("all models", batched, each);
  // The two round differently: to the last bit equal, one and the same would have run twice.
  EXPECT_GT(largest_difference(batched, each), 0.0);
  EXPECT_GT(contacts(each[0]), 70.0);
}

// Whoever looks on changes nothing, to the last bit, under either law.
TEST_P(BatchedForces, AreTheSameUnderObservation)
{
  const auto [name, tangential, keywords] = GetParam();
  for (const Law law : {Law::InBatches, Law::LaneByLane})
    EXPECT_EQ(largest_difference(run_heap(tangential, keywords, law),
                                 run_heap(tangential, keywords, law, Mode::OneRank, kObservers)),
              0.0)
        << (law == Law::InBatches ? "in batches" : "lane by lane");
}

INSTANTIATE_TEST_SUITE_P(
    Models, BatchedForces,
    testing::Values(Case{"Off", "off", ""}, Case{"NoHistory", "no_history", ""},
                    Case{"History", "history", ""},
                    Case{"LiggghtsSlider", "history", "limit_tangential_damping off"},
                    Case{"AspectScaling", "history", "aspect_scaling on"},
                    Case{"LimitForce", "history", "limitForce on"},
                    Case{"WithoutTangentialDamping", "history", "tangential_damping off"},
                    Case{"AtTheClosestPoint", "history", "spread_contact off"},
                    Case{"ParticleMass", "history", "effective_mass off"},
                    Case{"FiveSteps", "history", "search five_step sudden_overlap on"},
                    Case{"FiveStepsAtTheClosestPoint", "history",
                         "search five_step spread_contact off sudden_overlap on"}),
    [](const auto &info) { return std::string(info.param.name); });

// To the last bit.
TEST(BatchedForcesKeywords, NamedDefaultsAreTheDefaults)
{
  const std::string named = "search exact effective_mass on spread_contact on";
  EXPECT_EQ(largest_difference(run_heap("history", "", Law::InBatches),
                               run_heap("history", named, Law::InBatches)),
            0.0);
}

// The border cuts the heap in the middle.
TEST(BatchedForcesOnRanks, SameMotionOnTwo)
{
  expect_same("2 ranks", run_heap("history", "", Law::InBatches, Mode::TwoRanks),
              run_heap("history", "", Law::LaneByLane));
}

// Two pairs of two materials in a row with one rod alone before them, which flies out of the box: the last
// rod takes its place in memory, and the pairs change theirs in the batch.
TEST(BatchedForcesOfFewKinds, KeepTheirMaterialsWhenARodLeaves)
{
  constexpr double kOverlap = 4e-4, kSoftest = 2e4;
  const auto kn = [](int i, int j) { return i == 2 && j == 2 ? 10.0 * kSoftest : kSoftest; };
  Scene scene;
  scene.types = 2;
  Rod alone;
  alone.position = {0.9, 0.0, 0.999};
  alone.velocity = {0.0, 0.0, 400.0};
  scene.rods.push_back(alone);
  for (const int type : {1, 2})
    for (const double side : {-1.0, 1.0}) {
      Rod rod;
      rod.type = type;
      rod.position = {0.4 * (type - 1.5), 0.0, 0.5 * side * (rod.diameter - kOverlap)};
      rod.axis = side < 0.0 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
      scene.rods.push_back(rod);
    }
  for (const Law law : {Law::InBatches, Law::LaneByLane}) {
    const std::string models = "linear tangential history";
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("in.kinds",
                 preamble(scene) + "read_data rods.data\nneighbor 0.005 bin\n" +
                     pair_property("kn", 2, kn) + pair_property("kt", 2, kn) +
                     pair_property("coefficientRestitution", 2, 1.0) +
                     pair_property("coefficientFriction", 2, 0.2) + no_rolling_friction(2) +
                     rod_pair(law == Law::InBatches ? models : lane_by_lane(models)) + R"(
fix motion all nve/spherocylinder
timestep 1e-7
variable soft equal fz[3]
variable hard equal fz[5]
thermo_style custom step atoms v_soft v_hard
thermo_modify lost ignore norm no format float %.17g
thermo 100
run 200
)");
    const Outcome outcome = folder.run("in.kinds");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const auto rows = read_thermo(outcome.output).rows;
    EXPECT_EQ(rows.front()[1], 5.0);
    EXPECT_EQ(rows.back()[1], 4.0);
    for (const auto &row : rows) {  // in 2e-5 s the rods part by 1e-3 of their overlap
      EXPECT_NEAR(row[2], kSoftest * kOverlap, 1e-2 * kSoftest * kOverlap) << "step " << row[0];
      EXPECT_NEAR(row[3], 10.0 * kSoftest * kOverlap, 1e-1 * kSoftest * kOverlap);
    }
  }
}

// Two fixed rods lie in each other: there is nothing to move, no force and no NaN. fix freeze takes
// the forces off them but sums them up first, in steps of batches too.
TEST(BatchedForcesOfFixedRods, DoNotExist)
{
  const DeckFolder folder;
  const Scene scene = heap("history", "", Law::InBatches);
  folder.write("rods.data", data_file(scene));
  folder.write("in.fixed", preamble(scene) + "read_data rods.data\nneighbor 0.01 bin\n" +
                               scene.physics + R"(timestep 1e-5
fix sum all ave/time 1 1 1 f_hold[1] f_hold[2] f_hold[3] file forces
thermo 100
run 100
)");
  const Outcome outcome = folder.run("in.fixed");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  std::istringstream lines(folder.read("forces"));
  int steps = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream values(line);
    double step = -1.0, x = NAN, y = NAN, z = NAN;
    values >> step >> x >> y >> z;
    ASSERT_TRUE(std::isfinite(norm(Vec3{x, y, z}))) << line;
    steps++;
  }
  EXPECT_GE(steps, 100);
}

// The scene does what it is for: the soft rods' axes pass each other and are pushed back the way
// they came, the loose rod stays up.
TEST(BatchedForcesScene, RodsAreDrivenThroughEachOther)
{
  const std::vector<Frame> frames = run_heap("history", "", Law::InBatches);
  double lowest = 1.0;
  for (const Frame &frame : frames)
    lowest = std::min(lowest, frame.rods[61].position.z - frame.rods[60].position.z);
  EXPECT_LT(lowest, 0.0);
  EXPECT_GT(frames.back().rods[61].velocity.z - frames.back().rods[60].velocity.z, 0.0);
  EXPECT_GT(frames.back().rods.back().position.z, 0.109);
}
