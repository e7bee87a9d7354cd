// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes that change their size: periodic images move, and with `remap x` rods do, without any velocity.
#include <cmath>
#include <ostream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene.h"

using namespace decks;

namespace {

struct Case {
  const char *name;
  int axis;            // of the deformation
  std::string change;  // the fix, or commands between two runs
  double lo, hi;       // of the box at the end
  double apart;        // of the two centres then, without the period (m)
};

void PrintTo(const Case &c, std::ostream *out) { *out << c.name; }

constexpr double kStiffness = 2e4;

// Two rods at right angles, so heavy that they stay where they are, on either side of a periodic face.
Scene rods_at_a_face(int axis, double place)
{
  Scene scene;
  for (const double side : {-1.0, 1.0}) {
    Rod rod;
    double x[3] = {0.03, 0.02, -0.04}, u[3] = {0.0, 0.0, 0.0};
    x[axis] = side * place;
    u[(axis + (side < 0.0 ? 1 : 2)) % 3] = 1.0;
    rod.position = {x[0], x[1], x[2]};
    rod.axis = {u[0], u[1], u[2]};
    rod.length = 0.05;
    rod.density = 2.7e7;
    scene.rods.push_back(rod);
  }
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.3;
    scene.box_hi[d] = 0.3;
  }
  scene.boundary = axis == 0 ? "p f f" : axis == 1 ? "f p f" : "f f p";
  return scene;
}

std::string deck_of(const Case &c, const char *grid)
{
  const Scene scene = rods_at_a_face(c.axis, 0.2825);
  std::string start = preamble(scene);
  start.insert(start.find("newton"), grid);
  const bool between = c.change.find("change_box") != std::string::npos;
  return start + "read_data rods.data\nneighbor 0.1 bin\nneigh_modify delay 0\n" +
         linear_material(kStiffness, 5.7e3, 0.5, 0.2) + rod_pair("linear tangential history") +
         "fix motion all nve/spherocylinder\ntimestep 1e-6\n"
         "compute fx all reduce max fx\ncompute fy all reduce max fy\ncompute fz all reduce max fz\n"
         "thermo_style custom step c_fx c_fy c_fz\nthermo 1000\nthermo_modify norm no lost error\n" +
         (between ? "run 10\n" + c.change + "\nrun 10\n" : c.change + "\nrun 5000\n");
}

const Case kCases[] = {
    {"RemapNone", 0, "fix squeeze all deform 1 x vel -6.0 remap none units box", -0.285, 0.285,
     0.565},
    {"Slower", 1, "fix squeeze all deform 1 y vel -5.8 remap none units box", -0.2855, 0.2855,
     0.565},
    {"AlongZ", 2, "fix squeeze all deform 1 z final -0.285 0.2852 remap none units box", -0.285,
     0.2852, 0.565},
    {"EveryTenSteps", 0, "fix squeeze all deform 10 x vel -6.0 remap none units box", -0.285, 0.285,
     0.565},
    // Centres keep their fractions of the box: the gap shrinks with it.
    {"RemapX", 0, "fix squeeze all deform 1 x scale 0.22 remap x units box", -0.066, 0.066,
     0.22 * 0.565},
    {"ChangeBox", 0, "change_box all x final -0.2864 0.2864 units box", -0.2864, 0.2864, 0.565},
    {"ChangeBoxRemap", 2, "change_box all z scale 0.22 remap units box", -0.066, 0.066,
     0.22 * 0.565},
};

class Deform : public testing::TestWithParam<Case> {};

}  // namespace

// Force = kn (D - (period - distance of the centres)), less what the rods give way: they weigh 20 kg.
TEST_P(Deform, MovesImages)
{
  const Case &c = GetParam();
  const double wanted = kStiffness * (0.01 - (c.hi - c.lo - c.apart));
  ASSERT_GT(wanted, 40.0);
  for (const char *grid : {"", "processors 2 1 1\n", "processors 1 2 1\n", "processors 1 1 2\n",
                           "processors 2 2 1\n"}) {
    const std::string numbers = grid;
    const int ranks = numbers.empty() ? 1 : numbers == "processors 2 2 1\n" ? 4 : 2;
    const DeckFolder folder;
    folder.write("rods.data", data_file(rods_at_a_face(c.axis, 0.2825)));
    folder.write("in.deform", deck_of(c, grid));
    const Outcome outcome = folder.run("in.deform", {Program::Lmp, ranks, 60});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const Table thermo = read_thermo(outcome.output);
    EXPECT_NEAR(thermo.rows.back()[1 + c.axis], wanted, 0.02 * wanted) << grid;
  }
}

INSTANTIATE_TEST_SUITE_P(, Deform, testing::ValuesIn(kCases),
                         [](const auto &info) { return std::string(info.param.name); });
