// SPDX-License-Identifier: GPL-2.0-or-later
// Templates of fibres: what insertion commands put in, whole and clear of all else, on any number of ranks.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "core/numbers.h"
#include "core/rotation.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;
using spherocylinder::pi;

namespace {

constexpr double kRadius = 0.002, kDensity = 1000.0;

const char *const kColumns =
    "id type x y z vx vy vz omegax omegay omegaz quat1 quat2 quat3 quat4 shapex shapez mass "
    "f_fibres[1] f_fibres[2]";

struct Insertion {
  std::string boundary = "p p f";
  std::string templates =
      "fix fibre all particletemplate/spherocylinder 15485863 atom_type 1 density constant 1000 "
      "radius constant 0.002 length constant 0.3 segments 8\n";
  std::string distribution = "1 fibre 1.0";
  std::string pour =
      "fix pack all insert/pack seed 86028121 distributiontemplate mixture insert_every once verbose no "
      "overlapcheck yes orientation random all_in no maxattempt 1000 vel constant 0.0 0.0 0.0 "
      "region all particles_in_region 100\n";
  std::string before, joints = "youngsModulus 1e7 poissonsRatio 0.3";
  std::string run = "run 1\n", thermo = "step atoms f_joints f_joints[5]";
  double step = 1e-6;
};

// A box of 0.4, which is less than two fibres' lengths.
std::string deck_of(const Insertion &insertion, int ranks)
{
  return fmt::format(R"(atom_style spherocylinder
atom_modify map array
boundary {}
newton off
communicate single vel yes
units si
{}region all block -0.2 0.2 -0.2 0.2 0.0 0.4 units box
create_box 1 all
region small block -0.05 0.05 -0.05 0.05 0.1 0.2 units box
neighbor 0.01 bin
neigh_modify delay 0
{}{}{}fix joints all joint/spherocylinder {}
fix motion all nve/spherocylinder
timestep {}
{}fix mixture all particledistribution/discrete 32452843 {}
{}compute contacts all contact/spherocylinder
thermo 1
thermo_style custom {}
thermo_modify lost error format float %.17g
{}{})",
                     insertion.boundary, ranks > 1 ? "processors * * *\n" : "", insertion.before,
                     linear_material(1e4, 1e4, 0.5, 0.2), rod_pair("linear tangential history"),
                     insertion.joints, insertion.step, insertion.templates, insertion.distribution,
                     insertion.pour, insertion.thermo, exact_dump("dump.rods", 1, kColumns),
                     insertion.run);
}

struct Segment {
  Rod rod;
  double mass;
  int fibre, place;
};

std::vector<Segment> segments_of(const Table &atoms)
{
  std::vector<Segment> segments;
  for (size_t k = 0; k < atoms.rows.size(); k++) {
    const auto at = [&](const char *column) { return atoms.at(k, column); };
    Segment s;
    s.rod.position = {at("x"), at("y"), at("z")};
    s.rod.axis = spherocylinder::axis_of({at("quat1"), at("quat2"), at("quat3"), at("quat4")});
    s.rod.velocity = {at("vx"), at("vy"), at("vz")};
    s.rod.omega = {at("omegax"), at("omegay"), at("omegaz")};
    s.rod.diameter = 2.0 * at("shapex");
    s.rod.length = 2.0 * at("shapez");
    s.mass = at("mass");
    s.fibre = static_cast<int>(at("f_fibres[1]"));
    s.place = static_cast<int>(at("f_fibres[2]"));
    segments.push_back(s);
  }
  return segments;
}

struct Result {
  std::vector<Segment> segments;  // of the last frame
  Table thermo;
  std::vector<Snapshot> frames;
};

Result insert(const Insertion &insertion, int ranks)
{
  const DeckFolder folder;
  folder.write("in.fibres", deck_of(insertion, ranks));
  const Outcome outcome = folder.run("in.fibres", {Program::Lmp, ranks});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  if (outcome.exit_code != 0) return {};
  Result result;
  result.frames = read_dump(folder / "dump.rods");
  result.segments = segments_of(result.frames.back().atoms);
  result.thermo = read_thermo(outcome.output);
  return result;
}

// The segments of each fibre by their places; rods that are none have fibre 0.
std::map<int, std::vector<Segment>> fibres_in(const std::vector<Segment> &segments)
{
  std::map<int, std::vector<Segment>> fibres;
  for (const Segment &s : segments)
    if (s.fibre > 0) fibres[s.fibre].push_back(s);
  for (auto &[id, fibre] : fibres)
    std::sort(fibre.begin(), fibre.end(),
              [](const Segment &a, const Segment &b) { return a.place < b.place; });
  return fibres;
}

using Period = double[3];  // of the box, 0 where it is not periodic

Vec3 nearest_image(Vec3 d, const Period &period)
{
  double way[3] = {d.x, d.y, d.z};
  for (int k = 0; k < 3; k++)
    if (period[k] > 0.0) way[k] -= period[k] * std::round(way[k] / period[k]);
  return {way[0], way[1], way[2]};
}

// From the head of each segment to the tail of the next, the largest.
double largest_gap_at_joints(const std::map<int, std::vector<Segment>> &fibres,
                             const Period &period)
{
  double largest = 0.0;
  for (const auto &[id, fibre] : fibres)
    for (size_t k = 0; k + 1 < fibre.size(); k++) {
      const Rod &a = fibre[k].rod, &b = fibre[k + 1].rod;
      const Vec3 head = a.position + a.half_cylinder() * a.axis;
      const Vec3 tail = b.position - b.half_cylinder() * b.axis;
      largest = std::max(largest, norm(nearest_image(tail - head, period)));
    }
  return largest;
}

// Smallest gap of two rods' surfaces, all images; but of neighbours in a fibre not the one at their joint.
double smallest_gap(const std::vector<Segment> &segments, const Period &period)
{
  double smallest = std::numeric_limits<double>::infinity();
  const auto images = [&](int d) { return period[d] > 0.0 ? 1 : 0; };
  for (size_t i = 0; i < segments.size(); i++)
    for (size_t j = i; j < segments.size(); j++) {
      const Segment &a = segments[i], &b = segments[j];
      // Of short segments the next but one, too.
      const int nearest_places = a.rod.half_cylinder() < a.rod.radius() ? 2 : 1;
      const bool are_neighbours = i == j || (a.fibre > 0 && a.fibre == b.fibre &&
                                             std::abs(a.place - b.place) <= nearest_places);
      const Vec3 nearest = nearest_image(b.rod.position - a.rod.position, period);
      for (int x = -images(0); x <= images(0); x++)
        for (int y = -images(1); y <= images(1); y++)
          for (int z = -images(2); z <= images(2); z++) {
            if (are_neighbours && x == 0 && y == 0 && z == 0) continue;
            Rod image = b.rod;
            image.position =
                a.rod.position + nearest + Vec3{x * period[0], y * period[1], z * period[2]};
            if (norm(image.position - a.rod.position) > 0.5 * (a.rod.length + image.length))
              continue;
            smallest =
                std::min(smallest, slow_distance(a.rod, image) - a.rod.radius() - image.radius());
          }
    }
  return smallest;
}

// rho (pi r^2 N h + 4/3 pi r^3), of all segments together the cylinder between the outer hemispheres' centres.
double mass_of_fibre(double length)
{
  return kDensity * (pi * kRadius * kRadius * (length - 2.0 * kRadius) +
                     4.0 / 3.0 * pi * kRadius * kRadius * kRadius);
}

void expect_whole(const std::map<int, std::vector<Segment>> &fibres, size_t number, int segments)
{
  EXPECT_EQ(fibres.size(), number);
  for (const auto &[id, fibre] : fibres) {
    ASSERT_EQ(fibre.size(), static_cast<size_t>(segments)) << "fibre " << id;
    for (int k = 0; k < segments; k++) EXPECT_EQ(fibre[k].place, k + 1);
  }
}

struct Case {
  const char *name;
  int ranks;
  const char *boundary;
  const char *shape;  // keywords of the template
  int segments, fibres;
};

void PrintTo(const Case &c, std::ostream *out) { *out << c.name; }

class FibreInsertion : public testing::TestWithParam<Case> {};

// Fibres three quarters of the box long: parts of two and four ranks are shorter than they are.
TEST_P(FibreInsertion, PutsInWholeFibresClearOfAllElseAndWithoutLoad)
{
  const Case &c = GetParam();
  Insertion insertion;
  insertion.boundary = c.boundary;
  insertion.templates =
      "fix fibre all particletemplate/spherocylinder 15485863 atom_type 1 density constant 1000 "
      "radius constant 0.002 length constant 0.3 " +
      std::string(c.shape) + "\n";
  insertion.pour.replace(insertion.pour.find("region 100"), 10, fmt::format("region {}", c.fibres));
  const Result result = insert(insertion, c.ranks);
  const auto fibres = fibres_in(result.segments);
  expect_whole(fibres, c.fibres, c.segments);
  ASSERT_EQ(result.segments.size(), static_cast<size_t>(c.fibres) * c.segments);

  Period period;
  for (int d = 0; d < 3; d++) period[d] = c.boundary[2 * d] == 'p' ? 0.4 : 0.0;
  EXPECT_GT(smallest_gap(result.segments, period), 0.0);
  expect_holds({"Inserted fibres: neighbours' shared points apart / diameter", "0", 1e-12},
               largest_gap_at_joints(fibres, period) / (2.0 * kRadius));
  double mass = 0.0;
  for (const Segment &s : result.segments) mass += s.mass;
  expect_holds({"Inserted fibres: mass, relative", "rho (pi r^2 N h + 4/3 pi r^3)", 1e-12},
               std::fabs(mass / (c.fibres * mass_of_fibre(0.3)) - 1.0));

  // Bending stiffness EI/h: energies over that of joints that are bent by one radian each.
  const Table &thermo = result.thermo;
  const size_t last = thermo.rows.size() - 1;
  const double h = (0.3 - 2.0 * kRadius) / c.segments;
  const double joints = c.fibres * (c.segments - 1.0);
  const double of_a_radian = 0.5 * joints * 1e7 * pi * std::pow(kRadius, 4) / 4.0 / h;
  EXPECT_EQ(thermo.rows[last].at(3), joints);
  expect_holds({"Inserted fibres: energy of joints over theirs at 1 rad", "0", 1e-12},
               thermo.rows[last].at(2) / of_a_radian);
  // In the box where it is not periodic.
  for (const Segment &s : result.segments) {
    const double reach = s.rod.half_cylinder() * std::fabs(s.rod.axis.z) + kRadius;
    if (period[2] == 0.0) {
      EXPECT_GE(s.rod.position.z - reach, -1e-12);
      EXPECT_LE(s.rod.position.z + reach, 0.4 + 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , FibreInsertion,
    testing::Values(Case{"OneRank", 1, "p p f", "segments 8", 8, 100},
                    Case{"TwoRanks", 2, "p p p", "segments 8", 8, 100},
                    Case{"FourRanks", 4, "p p f", "segments 8", 8, 100},
                    Case{"Bounded", 2, "f f f", "segments 3", 3, 100},
                    Case{"ManyShort", 4, "p p p", "segments 80", 80, 25},
                    Case{"Curved", 2, "p p f", "segments 12 rest_curvature 15", 12, 100},
                    Case{"Twisted", 1, "p p p", "segments 12 rest_curvature 9 rest_twist 20", 12,
                         100}),
    [](const auto &info) { return std::string(info.param.name); });

class InsertedFibres : public testing::TestWithParam<int> {};

// Each segment moves as its place in the rigid fibre does: v0 + omega x r of the centre of mass.
TEST_P(InsertedFibres, MoveAsARigidBodyAtFirst)
{
  for (const char *inserter :
       {"insert/pack seed 86028121 distributiontemplate mixture insert_every once region all "
        "particles_in_region 30",
        "insert/rate/region seed 86028121 distributiontemplate mixture nparticles 30 particlerate "
        "1e8 insert_every 1 region all"}) {
    std::string command = fmt::format("fix pour all {}\n", inserter);
    command.insert(command.find(" region all"),
                   " overlapcheck yes orientation random all_in no maxattempt 500 "
                   "vel constant 1 2 3 omega constant 40 -30 20");
    Insertion insertion;
    insertion.templates =
        "fix fibre all particletemplate/spherocylinder 15485863 atom_type 1 density constant 1000 "
        "radius constant 0.002 length constant 0.2 segments 6 rest_curvature 9\n";
    insertion.pour = command;
    const Result result = insert(insertion, GetParam());
    const auto fibres = fibres_in(result.segments);
    expect_whole(fibres, 30, 6);
    const Period period = {0.4, 0.4, 0.0};
    const Vec3 v0 = {1.0, 2.0, 3.0}, omega = {40.0, -30.0, 20.0};
    double largest = 0.0;
    for (const auto &[id, fibre] : fibres) {
      std::vector<Vec3> places;
      Vec3 moment{0.0, 0.0, 0.0};
      double mass = 0.0;
      for (const Segment &s : fibre) {
        places.push_back(nearest_image(s.rod.position - fibre[0].rod.position, period));
        moment = moment + s.mass * places.back();
        mass += s.mass;
      }
      for (size_t k = 0; k < fibre.size(); k++) {
        const Vec3 arm = places[k] - (1.0 / mass) * moment;
        largest = std::max(largest, norm(fibre[k].rod.velocity - v0 - cross(omega, arm)));
        largest = std::max(largest, norm(fibre[k].rod.omega - omega));
      }
    }
    // The step in which they are put in has turned them by half its forces: those of joints at rest.
    expect_holds({"Inserted fibres: velocity (m/s) and spin (rad/s)", "v0 + omega x r", 1e-9},
                 largest);
  }
}

// Rods, fibres and spheres of one distribution, and two commands in one step: ids of fibres are their own.
TEST_P(InsertedFibres, SeveralTemplatesAndCommandsInOneStep)
{
  Insertion insertion;
  insertion.templates =
      "fix fibre all particletemplate/spherocylinder 15485863 atom_type 1 density constant 1000 "
      "radius constant 0.002 length constant 0.3 segments 8\n"
      "fix short all particletemplate/spherocylinder 15485867 atom_type 1 density constant 1000 "
      "radius constant 0.003 length constant 0.05 segments 2\n"
      "fix rod all particletemplate/spherocylinder 32452867 atom_type 1 density constant 1000 "
      "radius constant 0.002 length constant 0.1\n";
  insertion.distribution = "3 fibre 0.5 short 0.2 rod 0.3";
  const auto pour = [](const char *id, int seed, int number) {
    return fmt::format(
        "fix {} all insert/pack seed {} distributiontemplate mixture insert_every once verbose no overlapcheck "
        "yes orientation random all_in no maxattempt 1000 vel constant 0 0 0 region all "
        "particles_in_region {}\n",
        id, seed, number);
  };
  insertion.pour = pour("first", 86028121, 90) + pour("second", 49979687, 200);
  const Result result = insert(insertion, GetParam());
  const auto fibres = fibres_in(result.segments);
  size_t in_fibres = 0, shares[3] = {0, 0, 0};
  double masses[3] = {0.0, 0.0, 0.0};
  for (const auto &[id, fibre] : fibres) {
    const bool is_short = fibre[0].rod.diameter > 0.005;
    ASSERT_EQ(fibre.size(), is_short ? 2u : 8u);
    in_fibres += fibre.size();
    shares[is_short]++;
    for (const Segment &s : fibre) masses[is_short] += s.mass;
  }
  for (const Segment &s : result.segments)
    if (s.fibre == 0) shares[2]++, masses[2] += s.mass;
  // The shares of numbers follow from those of masses; commands round them up or down.
  EXPECT_NEAR(static_cast<double>(shares[0] + shares[1] + shares[2]), 200.0, 8.0);
  EXPECT_EQ(in_fibres + shares[2], result.segments.size());
  const double mass = masses[0] + masses[1] + masses[2];
  EXPECT_NEAR(masses[0] / mass, 0.5, 0.06);
  EXPECT_NEAR(masses[2] / mass, 0.3, 0.06);
  EXPECT_GT(smallest_gap(result.segments, {0.4, 0.4, 0.0}), 0.0);
  EXPECT_LE(largest_gap_at_joints(fibres, {0.4, 0.4, 0.0}), 1e-15);
}

// LIGGGHTS counts fibres: as many as are wanted in the region, or as much of their volume or mass.
TEST_P(InsertedFibres, ARegionIsKeptAtItsNumberVolumeAndMass)
{
  const double volume = mass_of_fibre(0.1) / kDensity, region = 0.4 * 0.4 * 0.2;
  for (const std::string &amount : {std::string("particles_in_region 40"),
                                    fmt::format("volumefraction_region {}", 40.2 * volume / region),
                                    fmt::format("mass_in_region {}", 40.2 * volume * kDensity)}) {
    Insertion insertion;
    insertion.boundary = "p p f";
    insertion.step = 2e-5;
    insertion.joints += " stretch_factor 0.01";
    insertion.templates =
        "fix fibre all particletemplate/spherocylinder 15485863 atom_type 1 density constant 1000 "
        "radius constant 0.002 length constant 0.1 segments 4\n";
    insertion.pour =
        "region feed block -0.2 0.2 -0.2 0.2 0.15 0.35 units box\n"
        "fix pack all insert/pack seed 86028121 distributiontemplate mixture insert_every 20 "
        "overlapcheck yes orientation random all_in no maxattempt 1000 vel constant 30 0 0 "
        "region feed " +
        amount + "\n";
    insertion.run = "run 61\n";
    const Result result = insert(insertion, GetParam());
    int checked = 0;
    for (const Snapshot &frame : result.frames) {
      if (frame.step % 20 != 1) continue;
      double inside = 0.0;
      for (const auto &[id, fibre] : fibres_in(segments_of(frame.atoms))) {
        ASSERT_EQ(fibre.size(), 4u);
        for (const Segment &s : fibre)
          inside += 0.25 * (s.rod.position.z >= 0.15 && s.rod.position.z <= 0.35);
      }
      // What is put in the region reaches out of it with some segments.
      EXPECT_GT(inside, 25.0) << amount;
      EXPECT_LE(inside, 41.0) << amount;
      checked++;
    }
    EXPECT_EQ(checked, 4);
  }
}

// The whole fibre in the vessel: the spheres at all joints and ends.
TEST_P(InsertedFibres, AllInRegionHoldsEverySegment)
{
  Insertion insertion;
  insertion.boundary = "f f f";
  insertion.before = "region vessel cylinder z 0 0 0.1 0.02 0.38 units box\n";
  insertion.templates =
      "fix fibre all particletemplate/spherocylinder 15485863 atom_type 1 density constant 1000 "
      "radius constant 0.002 length constant 0.18 segments 5 rest_curvature 6 all_in_region vessel\n";
  insertion.pour.replace(insertion.pour.find("region all"), 10, "region vessel");
  const Result result = insert(insertion, GetParam());
  expect_whole(fibres_in(result.segments), 100, 5);
  for (const Segment &s : result.segments)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 end = s.rod.position + side * s.rod.half_cylinder() * s.rod.axis;
      EXPECT_LE(std::hypot(end.x, end.y) + kRadius, 0.1 + 1e-12);
      EXPECT_GE(end.z - kRadius, 0.02 - 1e-12);
      EXPECT_LE(end.z + kRadius, 0.38 + 1e-12);
    }
}

// A stream brings fibres to its face at the speed across it, and lets each go as one when its centre is
// there: with velocity and spin of a rigid body, drawn once.
TEST_P(InsertedFibres, AStreamReleasesFibresAsOne)
{
  const DeckFolder folder;
  folder.write("face.stl",
               "solid face\nfacet normal 0 0 1\nouter loop\nvertex -0.1 -0.1 0.2\nvertex 0.1 -0.1 "
               "0.2\nvertex 0.1 0.1 0.2\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex "
               "-0.1 -0.1 0.2\nvertex 0.1 0.1 0.2\nvertex -0.1 0.1 0.2\nendloop\nendfacet\n"
               "endsolid face\n");
  Insertion insertion;
  insertion.boundary = "f f f";
  insertion.step = 2e-5;
  insertion.joints += " stretch_factor 0.01";
  insertion.templates =
      "fix fibre all particletemplate/spherocylinder 15485863 atom_type 1 density constant 1000 "
      "radius constant 0.002 length constant 0.05 segments 4\n";
  insertion.pour =
      "fix face all mesh/surface/planar file face.stl type 1\n"
      "fix pour all insert/stream seed 86028121 distributiontemplate mixture nparticles 6 "
      "particlerate 600 overlapcheck yes all_in no orientation constant 0.7071 0 0.7071 0 "
      "vel uniform 0. 0. -2.0 0.2 0.2 0.2 omega constant 0. 0. 30. insertion_face face "
      "extrude_length 0.1\n";
  insertion.run = "run 4000\n";
  folder.write("in.fibres", deck_of(insertion, GetParam()));
  const Outcome outcome = folder.run("in.fibres", {Program::Lmp, GetParam()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto frames = read_dump(folder / "dump.rods");
  const auto at_end = fibres_in(segments_of(frames.back().atoms));
  expect_whole(at_end, 6, 4);

  std::map<int, bool> was_released;
  int released = 0;
  double largest_stretch = 0.0, largest_spin = 0.0;
  for (const Snapshot &frame : frames)
    for (const auto &[id, fibre] : fibres_in(segments_of(frame.atoms))) {
      int turning = 0;
      Vec3 centre{0.0, 0.0, 0.0}, velocity{0.0, 0.0, 0.0};
      double mass = 0.0;
      for (const Segment &s : fibre) {
        turning += s.rod.omega.z != 0.0;
        centre = centre + s.mass * s.rod.position;
        velocity = velocity + s.mass * s.rod.velocity;
        mass += s.mass;
      }
      centre = (1.0 / mass) * centre;
      velocity = (1.0 / mass) * velocity;
      ASSERT_TRUE(turning == 0 || turning == 4)
          << "fibre " << id << " in part, step " << frame.step;
      if (turning == 0) {
        EXPECT_EQ(velocity.z, fibre[0].rod.velocity.z);
        EXPECT_GE(centre.z, 0.2 - 2.0 * 2e-5 * 2.0);
        const std::map<int, std::vector<Segment>> one{{id, fibre}};
        largest_stretch = std::max(largest_stretch, largest_gap_at_joints(one, {0.0, 0.0, 0.0}));
      } else if (!was_released[id]) {
        was_released[id] = true;
        released++;
        EXPECT_NEAR(centre.z, 0.2, 2.0 * 2e-5 * 2.2);
        EXPECT_LE(std::fabs(velocity.x), 0.2);
        EXPECT_NE(velocity.x, 0.0);
        for (const Segment &s : fibre) {
          const Vec3 arm = s.rod.position - centre;
          largest_spin = std::max(
              largest_spin, norm(s.rod.velocity - velocity - cross(Vec3{0.0, 0.0, 30.0}, arm)));
        }
      }
    }
  EXPECT_EQ(released, 6);
  expect_holds({"Fibres from a stream: velocity at the release (m/s)", "v0 + omega x r", 1e-12},
               largest_spin);
  EXPECT_LE(largest_stretch, 1e-15);  // until then
}

INSTANTIATE_TEST_SUITE_P(, InsertedFibres, testing::Values(1, 2, 4));

// A restart in the middle of pouring: fibres there keep their ids, new ones have others, and all goes on with the
// bits of a run that was not interrupted.
TEST_P(InsertedFibres, PouringGoesOnFromARestart)
{
  const auto deck = [](const char *run) {
    Insertion insertion;
    insertion.joints += " stretch_factor 0.01 damping 0.1";
    insertion.step = 1e-5;
    insertion.templates =
        "fix fibre all particletemplate/spherocylinder 15485863 atom_type 1 density constant 1000 "
        "radius constant 0.002 length constant 0.1 segments 4\n";
    insertion.pour =
        "region feed block -0.2 0.2 -0.2 0.2 0.1 0.3 units box\n"
        "fix pour all insert/rate/region seed 86028121 distributiontemplate mixture nparticles 60 "
        "particlerate 5e4 verbose no insert_every 10 overlapcheck yes orientation random all_in no "
        "maxattempt 500 vel constant 0 0 -1 region feed\n";
    insertion.run = run;
    return insertion;
  };
  const int ranks = GetParam();
  const DeckFolder folder;
  folder.write("in.first", deck_of(deck("run 55\nwrite_restart half\nrun 130\n"), ranks));
  std::string second = deck_of(deck("run 130\n"), ranks);
  const std::string box = "create_box 1 all\n";
  second.replace(second.find(box), box.size(), "read_restart half\n");
  const std::string region = "region all block -0.2 0.2 -0.2 0.2 0.0 0.4 units box\n";
  second.erase(second.find(region), region.size());
  folder.write("in.second", second);

  const Outcome first = folder.run("in.first", {Program::Lmp, ranks});
  ASSERT_EQ(first.exit_code, 0) << first.output;
  std::map<long, std::map<int, std::vector<Segment>>> whole_run;
  for (const Snapshot &frame : read_dump(folder / "dump.rods"))
    whole_run[frame.step] = fibres_in(segments_of(frame.atoms));
  const Outcome outcome = folder.run("in.second", {Program::Lmp, ranks});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(read_thermo(outcome.output).rows.back().at(3), 180.0);

  ASSERT_GT(whole_run[55].size(), 10u);
  ASSERT_LT(whole_run[55].size(), 50u);
  expect_whole(whole_run[185], 60, 4);
  size_t frames = 0;
  double different = 0.0;
  for (const Snapshot &frame : read_dump(folder / "dump.rods")) {
    const auto fibres = fibres_in(segments_of(frame.atoms));
    const auto &wanted = whole_run[frame.step];
    ASSERT_EQ(fibres.size(), wanted.size()) << frame.step;
    for (const auto &[id, fibre] : fibres) {
      ASSERT_EQ(wanted.count(id), 1u);
      for (size_t k = 0; k < fibre.size(); k++)
        different += norm(fibre[k].rod.position - wanted.at(id)[k].rod.position) +
                     norm(fibre[k].rod.omega - wanted.at(id)[k].rod.omega);
    }
    EXPECT_LT(largest_gap_at_joints(fibres, {0.4, 0.4, 0.0}), 0.02 * kRadius);
    frames++;
  }
  EXPECT_EQ(frames, 131u);
  EXPECT_EQ(different, 0.0);
}

// Copies of fibres, also of those across the periodic boundary, are whole and have ids of their own.
TEST_P(InsertedFibres, ReplicateCopiesThemWhole)
{
  Insertion insertion;
  insertion.boundary = "p p p";
  insertion.pour.replace(insertion.pour.find("particles_in_region 100"), 23,
                         "particles_in_region 30");
  insertion.run = "run 1\nreplicate 2 1 2 offset 0.4 0.4 0.4 shift 0 0 0\nrun 1\n";
  const Result result = insert(insertion, GetParam());
  const auto fibres = fibres_in(result.segments);
  expect_whole(fibres, 120, 8);
  const Period period = {0.8, 0.4, 0.8};
  EXPECT_LE(largest_gap_at_joints(fibres, period), 1e-14);
  EXPECT_GT(smallest_gap(result.segments, period), 0.0);
  EXPECT_EQ(result.thermo.rows.back().at(3), 840.0);
}

struct Mistake {
  const char *name, *find, *replace, *says;
};

void PrintTo(const Mistake &mistake, std::ostream *out) { *out << mistake.name; }

class FibreTemplate : public testing::TestWithParam<Mistake> {};

TEST_P(FibreTemplate, EndsWithOneSentence)
{
  const Mistake &mistake = GetParam();
  for (const int ranks : {1, 2}) {
    const DeckFolder folder;
    Insertion insertion;
    insertion.thermo = "step atoms";
    std::string deck = deck_of(insertion, ranks);
    const size_t at = deck.find(mistake.find);
    ASSERT_NE(at, std::string::npos);
    folder.write("in.fibres", deck.replace(at, std::string(mistake.find).size(), mistake.replace));
    const Outcome outcome = folder.run("in.fibres", {Program::Lmp, ranks});
    EXPECT_NE(outcome.exit_code, 0) << outcome.output;
    EXPECT_LT(outcome.exit_code, 128) << outcome.output;
    EXPECT_NE(outcome.output.find(mistake.says), std::string::npos) << outcome.output;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , FibreTemplate,
    testing::Values(
        Mistake{"NoSegment", "segments 8", "segments 0",
                "Fix particletemplate/spherocylinder (id fibre): segments must be >= 1 (got 0)"},
        Mistake{"NegativeNumber", "segments 8", "segments -3", "segments must be >= 1 (got -3)"},
        Mistake{"HalfASegment", "segments 8", "segments 2.5", "segments must be"},
        Mistake{"Word", "segments 8", "segments many", "segments must be"},
        Mistake{"NoNumber", "segments 8", "segments", "not enough arguments after segments"},
        Mistake{"TooMany", "segments 8", "segments 200",
                "joints must be at least a radius 0.002 apart, in a length of 0.3 segments <= 148 "
                "(got 200, joints 0.00148 apart)"},
        Mistake{"CurvatureOfARod", "segments 8", "segments 1 rest_curvature 3",
                "rest_curvature is of the joints of a fibre and wants segments >= 2 (got 1)"},
        Mistake{"TwistOfARod", "segments 8", "rest_twist 3",
                "rest_twist is of the joints of a fibre and wants segments >= 2 (got 1)"},
        Mistake{"TouchesItself", "segments 8", "segments 8 rest_curvature 21.2",
                "with this rest_curvature 21.2 and rest_twist 0 the fibre overlaps itself by 0.00"},
        Mistake{
            "FoldsItsJoints", "segments 8", "segments 8 rest_curvature 90",
            "rest_curvature and rest_twist must turn a joint by less than 179 degrees (got 190"},
        Mistake{"NotACurvature", "segments 8", "segments 8 rest_curvature bent",
                "rest_curvature must be a number (got bent)"},
        Mistake{"NoJoints",
                "fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3", "",
                "segments 8 makes fibres, but no fix holds them together (expected fix ID all "
                "joint/spherocylinder)"},
        Mistake{"OtherGroup", "fix joints all joint", "group some id 1\nfix joints some joint",
                "fibres must be in group some of fix joint/spherocylinder, which holds them "
                "together"},
        Mistake{"NoModulus", "youngsModulus 1e7 ", "",
                "no youngsModulus is given; wanted the keyword or fix ID all property/global"},
        Mistake{"ZeroModulus", "fix joints all joint/spherocylinder youngsModulus 1e7",
                "fix E all property/global youngsModulus peratomtype -5\n"
                "fix joints all joint/spherocylinder",
                "youngsModulus of atom type 1 must be > 0 (got -5)"},
        Mistake{"NoRoom", "maxattempt 1000", "maxattempt 1",
                "of 100 fibres; use a larger region, fewer fibres or more attempts"},
        Mistake{"RegionTooSmall", "segments 8", "segments 8 all_in_region small",
                "region small is too small for the rod: it holds a length of"},
        Mistake{
            "CopiesNotAPeriodApart", "run 1\n",
            "run 1\nreplicate 2 1 1 offset 0.5 0.4 0.4 shift 0 0 0\n",
            "Replicate: fibres lie across the periodic boundary along x and want copies a period "
            "0.4 apart (got offset 0.5)"}),
    [](const auto &info) { return std::string(info.param.name); });

}  // namespace
