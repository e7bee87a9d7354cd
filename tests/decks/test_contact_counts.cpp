// SPDX-License-Identifier: GPL-2.0-or-later
// compute contact/spherocylinder on rods thrown into a box without regard to overlap, against all
// pairs by an independent method.
#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;

namespace {

Scene heap()
{
  std::mt19937 random(50021);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::normal_distribution<double> normal;
  Scene scene;
  for (int i = 0; i < 150; i++) {
    Rod rod;
    rod.diameter = i % 2 ? 0.01 : 0.016;
    rod.length = rod.diameter * (1.0 + i % 8);
    rod.position = 0.1 * Vec3{any(random), any(random), any(random)};
    rod.axis = normalized({normal(random), normal(random), normal(random)});
    scene.rods.push_back(rod);
  }
  return scene;
}

TEST(ContactCounts, AgreeWithAllPairsOnOneRankAndTwo)
{
  const Scene scene = heap();
  const size_t n = scene.rods.size();
  std::vector<double> contacts(n, 0.0);
  double pairs = 0.0, overlaps = 0.0, largest = 0.0;
  for (size_t i = 0; i < n; i++)
    for (size_t j = i + 1; j < n; j++) {
      const double reach = scene.rods[i].radius() + scene.rods[j].radius();  // the mean diameter
      const double overlap = (reach - slow_distance(scene.rods[i], scene.rods[j])) / reach;
      if (overlap <= 0.0) continue;
      contacts[i]++;
      contacts[j]++;
      pairs++;
      overlaps += overlap;
      largest = std::max(largest, overlap);
    }
  ASSERT_GT(pairs, 50.0);

  for (const Mode mode : {Mode::OneRank, Mode::TwoRanks}) {
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("in.count",
                 preamble(scene, mode) + "read_data rods.data\nneighbor 0.02 bin\n" +
                     linear_material(1e3, 1e3, 0.5, 0.2) + rod_pair("linear tangential history") +
                     "fix motion all nve/spherocylinder\n"
                     "compute contacts all contact/spherocylinder\ntimestep 1e-6\n"
                     "thermo_style custom step c_contacts[1] c_contacts[2] c_contacts[3] "
                     "c_contacts[4]\nthermo_modify norm no format float %.17g\n" +
                     exact_dump("dump.count", 1, kFrameColumns) + "run 0\n");
    const Outcome outcome = folder.run("in.count", {Program::Lmp, mode == Mode::TwoRanks ? 2 : 1});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_EQ(read_frames(folder / "dump.count", scene).back().contacts, contacts);
    const std::vector<double> totals = read_thermo(outcome.output).rows.at(0);
    EXPECT_DOUBLE_EQ(totals[1], 2.0 * pairs / static_cast<double>(n));
    EXPECT_DOUBLE_EQ(totals[2], pairs);
    // The search is good to 10^-9 of a length.
    expect_holds(
        {"compute contact: mean and largest overlap, relative", "all pairs, by search", 1e-8},
        std::max(std::fabs(totals[3] * pairs / overlaps - 1.0),
                 std::fabs(totals[4] / largest - 1.0)));
  }
}

}  // namespace
