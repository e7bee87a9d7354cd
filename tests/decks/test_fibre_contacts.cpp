// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of fibres at their joints, where two segments share a hemisphere: against one rigid rod of the
// fibre's length, across bent joints, with other fibres and walls; friction that goes from segment to segment.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "core/numbers.h"
#include "fibres.h"
#include "mesh_files.h"
#include "run_mode.h"

using namespace decks;
using spherocylinder::pi;

namespace {

constexpr double kStiffness = 1e3, kFriction = 0.3;
constexpr double kRadius = 0.002, kJoints = 0.02;  // of the fibres (m)
constexpr double kOverlap = 4e-6;                  // 10^-3 of a diameter
constexpr double kSpeed = 0.1;

Fibre fibre_of(int segments)
{
  Fibre fibre;
  fibre.segments = segments;
  fibre.radius = kRadius;
  fibre.joint_distance = kJoints;
  return fibre;
}

// Straight along x, its middle at the origin; or one rod of its length.
std::vector<Rod> straight(int segments)
{
  return straight_rods(fibre_of(segments), {-0.5 * (segments - 1) * kJoints, 0.0, 0.0},
                       {1.0, 0.0, 0.0});
}

std::vector<Rod> one_rod(int segments)
{
  Rod rod = straight(segments).front();
  rod.position = {0.0, 0.0, 0.0};
  rod.length = segments * kJoints + 2.0 * kRadius;
  return {rod};
}

// A joint at the origin, bent by `angle` towards -z.
std::vector<Rod> bent(double angle)
{
  std::vector<Rod> rods = straight(2);
  rods[1].axis = {std::cos(angle), 0.0, -std::sin(angle)};
  rods[1].position = 0.5 * kJoints * rods[1].axis;
  return rods;
}

// So heavy that what it touches hardly changes its way.
Rod slider(double length, double angle, const Vec3 &position)
{
  Rod rod;
  rod.diameter = 2.0 * kRadius;
  rod.length = length;
  rod.density = 1e13;
  rod.axis = {std::cos(angle), std::sin(angle), 0.0};
  rod.position = position;
  return rod;
}

constexpr double kLong = 0.05;

struct RideOptions {
  std::string models = "linear tangential history";
  std::string material = linear_material(kStiffness, kStiffness, 1.0, kFriction);
  Mode mode = Mode::OneRank;
};

const char *const kJoin =
    "fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3 join 1e-6\n";

// What a slider felt, at each dump.
struct Ride {
  std::vector<Vec3> force, torque;
  std::vector<double> contacts;
};

// Frozen rods, joined if they are more than one, and a slider. `course`: the runs; dumps every so many steps.
Ride ride(const std::vector<Rod> &fixed, const Rod &slider, const std::string &course, long every,
          const RideOptions &setup = {})
{
  Scene scene = fibre_scene(fibre_of(1));
  scene.rods = fixed;
  scene.rods.push_back(slider);
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write(
      "in.ride",
      preamble(scene, setup.mode) + "read_data rods.data\nneighbor 0.002 bin\n" +
          fmt::format("group slider id {}\ngroup fixed subtract all slider\n", scene.rods.size()) +
          setup.material + rod_pair(setup.models) + (fixed.size() > 1 ? kJoin : "") +
          "fix hold fixed freeze\nfix motion slider nve/spherocylinder\n"
          "compute contacts all contact/spherocylinder\ntimestep 1e-5\nthermo 100000\n" +
          exact_dump("dump.ride", every, "id fx fy fz tqx tqy tqz c_contacts") + course);
  Launch launch;
  launch.ranks = setup.mode == Mode::TwoRanks ? 2 : setup.mode == Mode::FourRanks ? 4 : 1;
  const Outcome outcome = folder.run("in.ride", launch);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  Ride ride;
  if (outcome.exit_code != 0) return ride;
  for (const Snapshot &snapshot : read_dump(folder / "dump.ride")) {
    const Table &table = snapshot.atoms;
    const size_t last = table.rows.size() - 1;
    ride.force.push_back({table.at(last, "fx"), table.at(last, "fy"), table.at(last, "fz")});
    ride.torque.push_back({table.at(last, "tqx"), table.at(last, "tqy"), table.at(last, "tqz")});
    ride.contacts.push_back(table.at(last, "c_contacts"));
  }
  return ride;
}

// Along the fibre, across the joint at the origin.
Ride slide(const std::vector<Rod> &fixed, double length, double angle,
           const RideOptions &setup = {})
{
  Rod rod = slider(length, angle, {-0.003, 0.0, 2.0 * kRadius - kOverlap});
  rod.velocity = {kSpeed, 0.0, 0.0};
  return ride(fixed, rod, "run 6000\n", 20, setup);
}

// Largest difference of the forces from the second dump on, when springs are there, over the largest force.
double difference(const Ride &a, const Ride &b)
{
  if (a.force.size() != b.force.size() || a.force.size() < 2) return std::nan("");
  double most = 0.0, largest = 0.0;
  for (size_t k = 1; k < a.force.size(); k++) {
    most = std::max(most, norm(a.force[k] - b.force[k]));
    largest = std::max(largest, norm(b.force[k]));
  }
  return most / largest;
}

// Independent: the same ride over one rigid rod as long as the fibre.
TEST(FibreJointContacts, ARodAcross)
{
  double error = 0.0, friction = 0.0, torque = 0.0, most_contacts = 0.0;
  for (const double angle : {90.0, 45.0, 20.0, 5.0}) {
    const Ride one = slide(one_rod(4), kLong, degrees(angle));
    const Ride fibre = slide(straight(4), kLong, degrees(angle));
    error = std::max(error, difference(fibre, one));
    for (size_t k = 1; k < one.force.size(); k++) {
      friction = std::max(friction, std::fabs(std::hypot(fibre.force[k].x, fibre.force[k].y) /
                                                  (kFriction * fibre.force[k].z) -
                                              1.0));
      torque =
          std::max(torque, norm(fibre.torque[k] - one.torque[k]) / (norm(one.force[k]) * kRadius));
      most_contacts = std::max(most_contacts, fibre.contacts[k]);
    }
  }
  expect_holds({"Rod that slides over a joint, 5 to 90 degrees: force, relative",
                "the same over one rigid rod", 1e-9},
               error);
  expect_holds({"Rod that slides over a joint, 5 to 90 degrees: torque/(force x r)",
                "the same over one rigid rod", 1e-9},
               torque);
  expect_holds({"Rod that slides over a joint, 5 to 90 degrees: friction, relative", "mu N", 1e-9},
               friction);
  EXPECT_EQ(most_contacts, 2.0);  // both sides of the joint
}

// Those so short for their angle that spread_contact spreads them are spread over each segment for itself.
TEST(FibreJointContacts, ARodAlmostASphere)
{
  double across = 0.0, askew = 0.0;
  for (const double diameters : {1.0025, 1.2, 2.0})
    for (const double angle : {90.0, 70.0, 45.0, 20.0, 5.0}) {
      const double length = diameters * 2.0 * kRadius;
      const double error = difference(slide(straight(4), length, degrees(angle)),
                                      slide(one_rod(4), length, degrees(angle)));
      (angle == 90.0 ? across : askew) = std::max(angle == 90.0 ? across : askew, error);
    }
  expect_holds(
      {"Rods of 1.0025 to 2 diameters that slide over a joint at 90 degrees: force, relative",
       "the same over one rigid rod", 1e-9},
      across);
  expect_holds(
      {"Rods of 1.0025 to 2 diameters that slide over a joint at 20 and 45 degrees: force, relative",
       "the same over one rigid rod", 0.25},
      askew);
}

// Rolling keeps the spring as it is, and the rod creeps along its own axis, so that it grows.
TEST(FibreJointContacts, FrictionGoesAlong)
{
  double error = 0.0, across_ranks = 0.0;
  const auto roll = [](const std::vector<Rod> &fixed, Mode mode) {
    Rod rod = slider(kLong, degrees(90.0), {-0.003, 0.0, 2.0 * kRadius - kOverlap});
    rod.velocity = {kSpeed, 1.2e-5, 0.0};
    rod.omega = {0.0, kSpeed / (kRadius - 0.5 * kOverlap), 0.0};
    RideOptions setup;
    setup.mode = mode;
    return ride(fixed, rod, "run 6000\n", 20, setup);
  };
  const Ride one = roll(one_rod(4), Mode::OneRank), fibre = roll(straight(4), Mode::OneRank);
  error = difference(fibre, one);
  for (const Mode mode : {Mode::TwoRanks, Mode::FourRanks})
    across_ranks = std::max(across_ranks, difference(roll(straight(4), mode), fibre));
  // 7.2e-7 m at the end, of 1.2e-6 that friction holds.
  EXPECT_GT(one.force.back().y, -kFriction * one.force.back().z);
  EXPECT_LT(one.force.back().y, -0.5 * kFriction * one.force.back().z);
  expect_holds({"Rod that rolls over a joint with a loaded spring: force, relative",
                "the same over one rigid rod", 1e-9},
               error);
  expect_holds({"Rod that rolls over a joint with a loaded spring, 2 and 4 ranks: force, relative",
                "one rank", 1e-12},
               across_ranks);
}

// A slider is put from place to place round the joint, without friction.
Ride visit(const std::vector<Rod> &fixed, const std::vector<Vec3> &places)
{
  std::string course;
  for (const Vec3 &at : places)
    course += fmt::format("set atom {} x {:.17g} y {:.17g} z {:.17g}\nrun 1\n", fixed.size() + 1,
                          at.x, at.y, at.z);
  RideOptions setup;
  setup.models = "linear";
  return ride(fixed, slider(kLong, degrees(90.0), places.front()), course, 1, setup);
}

constexpr double kReach = 2.0 * kRadius - kOverlap;

// Past the outside of a bent joint at a constant distance: straight, round the joint, straight. Slow method: the
// distance of the polyline is constant, and so is the force, towards the slider.
TEST(FibreJointContacts, OutsideOfABentJoint)
{
  for (const double bend : {0.2, 1.0, 5.0, 20.0, 60.0}) {
    const double angle = degrees(bend);
    std::vector<Vec3> places;
    const int n = 60;
    const double way = 2e-3;
    const Vec3 back = {std::sin(angle), 0.0, std::cos(angle)},
               ahead = {std::cos(angle), 0.0, -std::sin(angle)};
    for (int k = -n; k < 0; k++) places.push_back({way * k / n, 0.0, kReach});
    for (int k = 0; k <= n; k++)
      places.push_back(kReach * Vec3{std::sin(angle * k / n), 0.0, std::cos(angle * k / n)});
    for (int k = 1; k <= n; k++) places.push_back(kReach * back + (way * k / n) * ahead);
    const Ride ride = visit(bent(angle), places);
    ASSERT_GE(ride.force.size(), places.size());
    double error = 0.0;
    const size_t extra = ride.force.size() - places.size();
    for (size_t k = 0; k < places.size(); k++)
      error =
          std::max(error, std::fabs(norm(ride.force[k + extra]) / (kStiffness * kOverlap) - 1.0));
    expect_holds(
        {fmt::format("Past the outside of a joint bent by {:g} degrees: force, relative", bend),
         "distance of both axes together", 1e-3},
        error);
  }
}

// In the inside of a joint: along one segment and, from where it would come too near to the other, along that.
std::vector<Vec3> into_corner(double angle, double way, int n)
{
  // The lines at that distance from both axes meet here.
  const Vec3 corner = kReach * Vec3{-std::tan(0.5 * angle), 0.0, 1.0};
  const Vec3 ahead = {std::cos(angle), 0.0, std::sin(angle)};
  std::vector<Vec3> places;
  for (int k = -n; k < 0; k++) places.push_back(corner + Vec3{way * k / n, 0.0, 0.0});
  for (int k = 0; k <= n; k++) places.push_back(corner + (way * k / n) * ahead);
  return places;
}

// Slow method: both segments push for themselves, where their axes are nearest.
TEST(FibreJointContacts, InsideOfABentJoint)
{
  for (const double bend : {5.0, 20.0, 60.0}) {
    const double angle = degrees(bend);
    const std::vector<Vec3> places = into_corner(angle, 2e-3, 60);
    const Ride ride = visit(bent(-angle), places);
    ASSERT_GE(ride.force.size(), places.size());
    const size_t extra = ride.force.size() - places.size();
    const Vec3 up = {0.0, 0.0, 1.0}, back = {-std::sin(angle), 0.0, std::cos(angle)};
    double error = 0.0;
    for (size_t k = 0; k < places.size(); k++) {
      const double first = std::max(0.0, 2.0 * kRadius - dot(places[k], up));
      const double second = std::max(0.0, 2.0 * kRadius - dot(places[k], back));
      error =
          std::max(error, norm(ride.force[k + extra] - kStiffness * (first * up + second * back)));
    }
    expect_holds(
        {fmt::format("In the inside of a joint bent by {:g} degrees: force, relative", bend),
         "both segments for themselves", 1e-3},
        error / (kStiffness * kOverlap));
  }
}

// Along one segment until the other one is touched, beyond 90 degrees from the opposite side: that contact does not go
// on with the side of the first, from which the axes would have passed each other. Slow method as above.
TEST(FibreJointContacts, InsideOfASharpJoint)
{
  RideOptions smooth;
  smooth.material = linear_material(kStiffness, kStiffness, 1.0, 0.0);
  for (const double bend : {60.0, 110.0, 130.0}) {
    const double angle = degrees(bend);
    const Vec3 up = {0.0, 0.0, 1.0}, back = {-std::sin(angle), 0.0, std::cos(angle)};
    Rod rod = slider(kLong, 0.5 * pi, kReach * Vec3{-std::tan(0.5 * angle), 0.0, 1.0});
    rod.position.x -= 2e-5;
    rod.velocity = {kSpeed, 0.0, 0.0};
    const Ride ridden = ride(bent(-angle), rod, "run 30\n", 1, smooth);
    ASSERT_EQ(ridden.force.size(), 31u);
    double error = 0.0, both = 0.0;
    for (size_t k = 0; k < ridden.force.size(); k++) {
      const Vec3 place = rod.position + (1e-5 * static_cast<double>(k)) * rod.velocity;
      const double first = std::max(0.0, 2.0 * kRadius - dot(place, up));
      const double second = std::max(0.0, 2.0 * kRadius - dot(place, back));
      both = std::max(both, std::min(first, second));
      error = std::max(error, norm(ridden.force[k] - kStiffness * (first * up + second * back)));
    }
    EXPECT_GT(both, 0.5 * kOverlap);
    expect_holds(
        {fmt::format("Into the inside of a joint bent by {:g} degrees: force, relative", bend),
         "both segments for themselves", 1e-6},
        error / (kStiffness * kOverlap));
  }
}

// Of a gentle bend the two contacts go over into one: in places a twentieth of their patch apart.
TEST(FibreJointContacts, InsideOfAGentleBend)
{
  for (const double bend : {0.0, 0.2, 0.5, 1.0, 2.0}) {
    const std::vector<Vec3> places = into_corner(degrees(bend), 1.6e-4, 80);
    const Ride ride = visit(bent(-degrees(bend)), places);
    ASSERT_GE(ride.force.size(), places.size());
    double step = 0.0, least = 1.0, most = 0.0;
    for (size_t k = 1; k < ride.force.size(); k++) {
      step = std::max(step, norm(ride.force[k] - ride.force[k - 1]));
      least = std::min(least, norm(ride.force[k]));
      most = std::max(most, norm(ride.force[k]));
    }
    const double force = kStiffness * kOverlap;
    expect_holds(
        {fmt::format(
             "Over the inside of a joint bent by {:g} degrees, 2e-6 m a step: change of force, relative",
             bend),
         "no step", 0.1},
        step / force);
    EXPECT_GT(least, 0.999 * force);
    EXPECT_LT(most, 2.001 * force);
  }
}

// Each of a plane's and a cylinder's contacts with a joint is half of either segment's.
struct OnWall {
  const char *name, *wall;
};
class FibreOnWall : public testing::TestWithParam<OnWall> {};

TEST_P(FibreOnWall, JointsCountOnce)
{
  const int segments = 4;
  Scene scene = fibre_scene(fibre_of(segments));
  scene.rods = straight(segments);
  scene.rods.push_back(one_rod(segments).front());
  for (Rod &rod : scene.rods) rod.position.z = kRadius - kOverlap;
  scene.rods.back().position.y = 0.1;
  scene.files["floor.stl"] =
      stl(tiled(Sheet{{-0.3, -0.3, 0.0}, {0.6, 0.0, 0.0}, {0.0, 0.6, 0.0}}, 3, 3));
  const DeckFolder folder;
  for (const auto &[name, text] : scene.files) folder.write(name, text);
  folder.write("rods.data", data_file(scene));
  folder.write("in.floor", preamble(scene) + "read_data rods.data\nneighbor 0.002 bin\n" +
                               linear_material(kStiffness, kStiffness, 1.0, 0.0) +
                               rod_pair("linear") + GetParam().wall + kJoin +
                               "fix motion all nve/spherocylinder\ntimestep 1e-7\n" +
                               exact_dump("dump.floor", 1, "id fx fy fz") + "run 0\n");
  const Outcome outcome = folder.run("in.floor");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Table forces = read_dump(folder / "dump.floor").back().atoms;
  double error = 0.0;
  const double end = kStiffness * kOverlap;
  for (int k = 0; k < segments; k++) {
    const double expected = k == 0 || k == segments - 1 ? 1.5 * end : end;
    error = std::max(error, std::fabs(forces.at(k, "fz") / expected - 1.0));
  }
  expect_holds({fmt::format("Fibre of 4 segments on {}: force of each, relative", GetParam().name),
                "k x overlap of 5 points, joints' halved", 1e-9},
               error);
}

INSTANTIATE_TEST_SUITE_P(
    , FibreOnWall,
    testing::Values(
        OnWall{
            "a plane",
            "fix floor all wall/gran model linear surface spherocylinder primitive type 1 zplane 0.0\n"},
        OnWall{
            "a mesh",
            "fix sheet all mesh/surface file floor.stl type 1\n"
            "fix floor all wall/gran model linear surface spherocylinder mesh n_meshes 1 meshes sheet\n"}),
    [](const auto &info) { return std::string(info.param.name + 2); });

// What LIGGGHTS's other models make of a contact next to a joint, cohesion and rolling friction too.
struct Models {
  const char *name, *models;
};
class FibreModels : public testing::TestWithParam<Models> {};

TEST_P(FibreModels, SlideOverAJoint)
{
  RideOptions options;
  options.models = GetParam().models;
  options.material = linear_material(kStiffness, kStiffness, 1.0, kFriction) +
                     "fix y all property/global youngsModulus peratomtype 5e7\n"
                     "fix nu all property/global poissonsRatio peratomtype 0.3\n"
                     "fix cv all property/global characteristicVelocity scalar 0.1\n"
                     "fix gn all property/global gamman peratomtypepair 1 0\n"
                     "fix gt all property/global gammat peratomtypepair 1 0\n" +
                     pair_property("cohesionEnergyDensity", 1, 1e4) +
                     pair_property("coefficientRollingFriction", 1, 0.1);
  const Ride one = slide(one_rod(4), kLong, degrees(60.0), options);
  const Ride fibre = slide(straight(4), kLong, degrees(60.0), options);
  expect_holds({fmt::format("Rod that slides over a joint, {}: force, relative", GetParam().models),
                "the same over one rigid rod", 1e-9},
               difference(fibre, one));
}

INSTANTIATE_TEST_SUITE_P(
    , FibreModels,
    testing::Values(Models{"Hooke", "hooke tangential history"},
                    Models{"Hertz", "hertz tangential history"},
                    Models{"NoHistory", "linear tangential no_history"},
                    Models{"Sjkr", "hertz tangential history cohesion sjkr"},
                    Models{"Sjkr2", "hooke tangential history cohesion sjkr2"},
                    Models{"Cdt", "hertz tangential history rolling_friction cdt"},
                    Models{"Epsd2", "hertz tangential history rolling_friction epsd2"}),
    [](const auto &info) { return std::string(info.param.name); });

// A heavy fibre along x is drawn over what stands still at x = 0: all forces on it.
class FibreOverEdge : public testing::TestWithParam<OnWall> {};

std::vector<Vec3> draw_over(const std::vector<Rod> &rods, const std::string &wall, Mode mode)
{
  Scene scene = fibre_scene(fibre_of(1));
  scene.rods = rods;
  for (Rod &rod : scene.rods) {
    rod.density = 1e13;
    rod.position.x -= 0.003;
    rod.position.z = kRadius - kOverlap;
    rod.velocity = {kSpeed, 1.2e-5, 0.0};
  }
  const double d = 0.1;
  Mesh roof;
  for (const double side : {-1.0, 1.0})
    for (const MeshTriangle &triangle :
         tiled(Sheet{{side * d, -d, -d}, {-side * d, 0.0, d}, {0.0, 2.0 * d, 0.0}}, 1, 1))
      roof.push_back(triangle);
  const DeckFolder folder;
  folder.write("roof.stl", stl(roof));
  folder.write("rods.data", data_file(scene));
  folder.write("in.edge", preamble(scene, mode) + "read_data rods.data\nneighbor 0.002 bin\n" +
                              linear_material(kStiffness, kStiffness, 1.0, kFriction) +
                              rod_pair("linear tangential history") + wall +
                              (rods.size() > 1 ? kJoin : "") +
                              "fix motion all nve/spherocylinder\ntimestep 1e-5\n" +
                              exact_dump("dump.edge", 20, "id fx fy fz") + "run 6000\n");
  Launch launch;
  launch.ranks = mode == Mode::TwoRanks ? 2 : 1;
  const Outcome outcome = folder.run("in.edge", launch);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  std::vector<Vec3> sums;
  if (outcome.exit_code != 0) return sums;
  for (const Snapshot &snapshot : read_dump(folder / "dump.edge")) {
    Vec3 sum = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < rods.size(); k++)
      sum = sum + Vec3{snapshot.atoms.at(k, "fx"), snapshot.atoms.at(k, "fy"),
                       snapshot.atoms.at(k, "fz")};
    sums.push_back(sum);
  }
  return sums;
}

TEST_P(FibreOverEdge, AsOneRigidRod)
{
  const std::vector<Vec3> one = draw_over(one_rod(4), GetParam().wall, Mode::OneRank);
  double error[2] = {0.0, 0.0};
  for (const bool ranks : {false, true}) {
    const std::vector<Vec3> fibre =
        draw_over(straight(4), GetParam().wall, ranks ? Mode::TwoRanks : Mode::OneRank);
    ASSERT_EQ(fibre.size(), one.size());
    for (size_t k = 1; k < one.size(); k++) {
      error[ranks] = std::max(error[ranks], norm(fibre[k] - one[k]) / norm(one[k]));
    }
  }
  expect_holds({fmt::format("Fibre that is drawn over {}: force, relative", GetParam().name),
                "one rigid rod", 1e-6},
               error[0]);
  expect_holds(
      {fmt::format("Fibre that is drawn over {}, 2 ranks: force, relative", GetParam().name),
       "one rigid rod", 1e-6},
      error[1]);
}

INSTANTIATE_TEST_SUITE_P(
    , FibreOverEdge,
    testing::Values(
        OnWall{"a cylinder",
               "fix drum all wall/gran model linear tangential history surface spherocylinder "
               "primitive type 1 ycylinder 0.03 -0.03 0.0\n"},
        // Its surface goes along, so that springs last.
        OnWall{"a turning cylinder",
               "fix drum all wall/gran model linear tangential history surface spherocylinder "
               "primitive type 1 ycylinder 0.03 -0.03 0.0 shear x 3.3333333333333333\n"},
        OnWall{
            "an edge",
            "fix roof all mesh/surface file roof.stl type 1\n"
            "fix walls all wall/gran model linear tangential history surface spherocylinder mesh n_meshes 1 meshes roof\n"}),
    [](const auto &info) {
      const std::string name = info.param.name;
      return name.substr(name.rfind(' ') + 1) +
             (name.find("turning") == std::string::npos ? "" : "Turning");
    });

}  // namespace
