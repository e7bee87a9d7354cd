// SPDX-License-Identifier: GPL-2.0-or-later
// Random insertion by LIGGGHTS's insert/pack from rod templates.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "core/rotation.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;

namespace {

// Smallest gap between the surfaces of any two rods; `period` of a cubic periodic box, 0 if none.
double smallest_gap(const std::vector<Rod> &rods, double period = 0.0)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < rods.size(); i++)
    for (size_t j = i + 1; j < rods.size(); j++) {
      Rod image = rods[j];
      if (period > 0.0) {
        const Vec3 d = image.position - rods[i].position;
        image.position =
            image.position - period * Vec3{std::round(d.x / period), std::round(d.y / period),
                                           std::round(d.z / period)};
      }
      const double bound = 0.5 * (rods[i].length + image.length);
      if (norm(image.position - rods[i].position) > bound) continue;
      smallest =
          std::min(smallest, slow_distance(rods[i], image) - rods[i].radius() - image.radius());
    }
  return smallest;
}

struct Insertion {
  std::string boundary = "f f f";
  std::string region = "cylinder z 0.0 0.0 0.1 0.0 0.4";
  std::string templates =
      "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
      "radius constant 0.005 length constant 0.1 all_in_region vessel\n";
  std::string distribution = "1 rod 1.0";
  std::string amount = "particles_in_region 60";
  int seed = 86028121;
};

std::string insertion_deck(const Insertion &insertion, int ranks)
{
  return fmt::format(R"(atom_style spherocylinder
atom_modify map array
boundary {}
newton off
communicate single vel yes
units si
{}region box block -0.2 0.2 -0.2 0.2 0.0 0.4 units box
create_box 1 box
region vessel {} units box
neighbor 0.01 bin
neigh_modify delay 0
{}{}fix motion all nve/spherocylinder
compute contacts all contact/spherocylinder
timestep 1e-5
{}fix mixture all particledistribution/discrete 32452843 {}
fix pack all insert/pack seed {} distributiontemplate mixture insert_every once &
  overlapcheck yes orientation random all_in no maxattempt 1000 &
  vel constant 0.0 0.0 0.0 region vessel {}
thermo 1
thermo_style custom step atoms
{}run 1
)",
                     insertion.boundary, ranks > 1 ? "processors 2 1 1\n" : "", insertion.region,
                     linear_material(1e5, 1e5, 0.5, 0.2), rod_pair("linear tangential history"),
                     insertion.templates, insertion.distribution, insertion.seed, insertion.amount,
                     exact_dump("dump.rods", 1, kFrameColumns));
}

std::vector<Rod> insert(const Insertion &insertion, int ranks = 1)
{
  const DeckFolder folder;
  folder.write("in.insert", insertion_deck(insertion, ranks));
  const Outcome outcome = folder.run("in.insert", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return {};
  return read_frames(folder / "dump.rods", Scene()).back().rods;
}

class Ranks : public testing::TestWithParam<int> {};

TEST_P(Ranks, VesselIsFilledWithoutOverlap)
{
  const std::vector<Rod> rods = insert(Insertion(), GetParam());
  ASSERT_EQ(rods.size(), 60u);
  EXPECT_GT(smallest_gap(rods), 0.0);
  for (const Rod &rod : rods)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 end = rod.position + side * rod.half_cylinder() * rod.axis;
      EXPECT_LE(std::hypot(end.x, end.y) + rod.radius(), 0.1 + 1e-12);
      EXPECT_GE(end.z - rod.radius(), -1e-12);
      EXPECT_LE(end.z + rod.radius(), 0.4 + 1e-12);
    }
}

TEST_P(Ranks, PeriodicBoxIsFilledWithoutOverlapAcrossItsBoundaries)
{
  Insertion insertion;
  insertion.boundary = "p p p";
  insertion.region = "block -0.2 0.2 -0.2 0.2 0.0 0.4";
  insertion.templates =
      "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
      "radius constant 0.005 length constant 0.1\n";
  insertion.amount = "particles_in_region 600";
  const std::vector<Rod> rods = insert(insertion, GetParam());
  ASSERT_EQ(rods.size(), 600u);
  EXPECT_GT(smallest_gap(rods, 0.4), 0.0);
}

// So few rods that hardly one is rejected: then their directions are those drawn. Isotropic:
// <|u_i|> = 1/2 with variance 1/12, <u_i^2> = 1/3 with variance 4/45, for each i. The seeds are
// fixed, so that this does not fail by chance.
TEST_P(Ranks, OrientationsAreIsotropic)
{
  Insertion insertion;
  insertion.region = "block -0.2 0.2 -0.2 0.2 0.0 0.4";
  insertion.templates =
      "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
      "radius constant 0.001 length constant 0.02\n";
  insertion.amount = "particles_in_region 1000";
  const std::vector<Rod> rods = insert(insertion, GetParam());
  ASSERT_EQ(rods.size(), 1000u);
  const double n = static_cast<double>(rods.size());
  Vec3 mean{0.0, 0.0, 0.0}, mean_square{0.0, 0.0, 0.0};
  for (const Rod &rod : rods) {
    const Vec3 &u = rod.axis;
    mean = mean + (1.0 / n) * Vec3{std::fabs(u.x), std::fabs(u.y), std::fabs(u.z)};
    mean_square = mean_square + (1.0 / n) * Vec3{u.x * u.x, u.y * u.y, u.z * u.z};
  }
  double deviations = 0.0;
  for (const double m : {mean.x, mean.y, mean.z})
    deviations = std::max(deviations, std::fabs(m - 0.5) / std::sqrt(1.0 / 12.0 / n));
  for (const double m : {mean_square.x, mean_square.y, mean_square.z})
    deviations = std::max(deviations, std::fabs(m - 1.0 / 3.0) / std::sqrt(4.0 / 45.0 / n));
  expect_holds(
      {"Inserted rods: isotropy, standard deviations of mean abs(u_i), u_i^2", "1/2, 1/3", 3.0},
      deviations);
}

// 70 % rods of two sizes and 30 % spheres.
TEST_P(Ranks, SeveralTemplates)
{
  Insertion insertion;
  insertion.templates =
      "fix long all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2700 "
      "radius constant 0.004 length constant 0.08 all_in_region vessel\n"
      "fix short all particletemplate/spherocylinder 15485867 atom_type 1 density constant 1000 "
      "radius constant 0.005 length constant 0.03 all_in_region vessel\n"
      "fix ball all particletemplate/spherocylinder 32452867 atom_type 1 density constant 2700 "
      "radius constant 0.006 length constant 0.012 all_in_region vessel\n";
  // Shares of the mass, as in LIGGGHTS.
  insertion.distribution = "3 long 0.5 short 0.2 ball 0.3";
  insertion.amount = "particles_in_region 100";
  const std::vector<Rod> rods = insert(insertion, GetParam());
  ASSERT_GE(rods.size(), 95u);
  EXPECT_GT(smallest_gap(rods), 0.0);
  int spheres = 0, long_rods = 0;
  double mass = 0.0, mass_of_spheres = 0.0;
  for (const Rod &rod : rods) {
    mass += rod.mass();
    if (rod.length == rod.diameter) mass_of_spheres += rod.mass(), spheres++;
    if (std::fabs(rod.length - 0.08) < 1e-12) long_rods++;
  }
  EXPECT_GT(long_rods, 0);
  EXPECT_GT(spheres, 0);
  EXPECT_NEAR(mass_of_spheres / mass, 0.3, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Insertion, Ranks, testing::Values(1, 2),
                         [](const auto &info) { return std::to_string(info.param); });

TEST(Insertion, SeedsAreReproducible)
{
  Insertion insertion;
  const std::vector<Rod> first = insert(insertion), again = insert(insertion);
  insertion.seed = 49979687;
  const std::vector<Rod> other = insert(insertion);
  ASSERT_EQ(first.size(), again.size());
  ASSERT_EQ(first.size(), other.size());
  double same = 0.0, different = 0.0;
  for (size_t i = 0; i < first.size(); i++) {
    same += norm(first[i].position - again[i].position) + norm(first[i].axis - again[i].axis);
    different += norm(first[i].position - other[i].position);
  }
  EXPECT_EQ(same, 0.0);
  EXPECT_GT(different, 0.01);
}

// insert/pack at a second time keeps clear of the rods of the first.
TEST(Insertion, RepeatedInsertionKeepsClear)
{
  const DeckFolder folder;
  std::string deck = insertion_deck(Insertion(), 1);
  deck.replace(deck.find("insert_every once"), 17, "insert_every 20");
  deck.replace(deck.find("particles_in_region 60"), 22, "volumefraction_region 0.05");
  deck += "run 100\n";
  folder.write("in.insert", deck);
  const Outcome outcome = folder.run("in.insert");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::vector<Rod> rods = read_frames(folder / "dump.rods", Scene()).back().rods;
  EXPECT_GT(rods.size(), 70u);
  EXPECT_GT(smallest_gap(rods), 0.0);
}

// Two fixes insert in one step: the second sees the rods of the first, and those of other ranks and images.
class TwoInsertions : public testing::TestWithParam<std::pair<int, const char *>> {};

TEST_P(TwoInsertions, OfOneStepKeepClear)
{
  const auto &[ranks, boundary] = GetParam();
  const auto pour = [](const char *id, int seed, int rods) {
    return fmt::format(
        "fix {} all insert/pack seed {} distributiontemplate rods insert_every once overlapcheck yes "
        "orientation random all_in no maxattempt 500 vel constant 0.0 0.0 0.0 region pour "
        "particles_in_region {}\n",
        id, seed, rods);
  };
  const DeckFolder folder;
  folder.write(
      "in.two",
      fmt::format("atom_style spherocylinder\natom_modify map array\nboundary {}\nnewton off\n"
                  "communicate single vel yes\nunits si\n"
                  "region box block 0 1 0 1 0 1 units box\ncreate_box 1 box\n"
                  "neighbor 0.02 bin\nneigh_modify delay 0\n",
                  boundary) +
          linear_material(5e4, 1.5e4, 0.5, 0.3) + rod_pair("linear tangential history") +
          "fix rod all particletemplate/spherocylinder 15485863 atom_type 1 density constant 2500 "
          "radius constant 0.005 length constant 0.1\n"
          "fix rods all particledistribution/discrete 32452843 1 rod 1.0\n"
          "region pour block 0.06 0.94 0.06 0.94 0.06 0.94 units box\n" +
          pour("first", 49979687, 200) +
          "timestep 1e-5\nfix motion all nve/spherocylinder\nrun 10\n" + pour("a", 86028121, 230) +
          pour("b", 15485867, 260) +
          exact_dump("dump.rods", 5,
                     "id type x y z vx vy vz omegax omegay omegaz quat1 quat2 quat3 quat4 "
                     "shapex shapez") +
          "run 5\n");
  const Outcome outcome = folder.run("in.two", {Program::Lmp, ranks, 60});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table atoms = read_dump(folder / "dump.rods").back().atoms;
  ASSERT_EQ(atoms.rows.size(), 260u);
  std::vector<Rod> rods;
  for (size_t k = 0; k < atoms.rows.size(); k++) {
    Rod rod;
    rod.diameter = 2.0 * atoms.at(k, "shapex");
    rod.length = 2.0 * atoms.at(k, "shapez");
    rod.position = {atoms.at(k, "x"), atoms.at(k, "y"), atoms.at(k, "z")};
    rod.axis = spherocylinder::axis_of(
        {atoms.at(k, "quat1"), atoms.at(k, "quat2"), atoms.at(k, "quat3"), atoms.at(k, "quat4")});
    rods.push_back(rod);
  }
  EXPECT_GT(smallest_gap(rods), 0.0);
}

INSTANTIATE_TEST_SUITE_P(, TwoInsertions,
                         testing::Values(std::pair(1, "p p p"), std::pair(2, "f f f"),
                                         std::pair(4, "p p f")),
                         [](const auto &info) { return fmt::format("Ranks{}", info.param.first); });

}  // namespace
