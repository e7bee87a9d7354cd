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
#include "run_mode.h"

using namespace decks;
using spherocylinder::pi;

namespace {

class FibreContacts : public RunMode {};

constexpr double kStiffness = 1e3, kFriction = 0.3;
constexpr double kRadius = 0.002, kJoints = 0.02;  // of the fibres (m)
constexpr double kOverlap = 4e-6;                  // 10^-3 of a diameter
constexpr double kSpeed = 0.1;

Fibre slid_fibre(int segments)
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
  const Fibre fibre = slid_fibre(segments);
  return straight_rods(fibre, {-0.5 * (segments - 1) * kJoints, 0.0, 0.0}, {1.0, 0.0, 0.0});
}

std::vector<Rod> one_rod(int segments)
{
  Rod rod = straight(segments).front();
  rod.position = {0.0, 0.0, 0.0};
  rod.length = segments * kJoints + 2.0 * kRadius;
  return {rod};
}

// So heavy that what it touches hardly changes its way.
Rod slider(double length, double angle, const Vec3 &position, const Vec3 &velocity)
{
  Rod rod;
  rod.diameter = 2.0 * kRadius;
  rod.length = length;
  rod.density = 1e13;
  rod.axis = {std::cos(angle), std::sin(angle), 0.0};
  rod.position = position;
  rod.velocity = velocity;
  return rod;
}

// What a slider felt, at each dump.
struct Ride {
  std::vector<Vec3> force, torque;
  std::vector<double> contacts;
};

// A slider rides over frozen rods, which are joined if they are more than one.
Ride ride(const std::vector<Rod> &fixed, const Rod &slider, long steps, Mode mode = Mode::OneRank)
{
  Scene scene = fibre_scene(slid_fibre(1));
  scene.rods = fixed;
  scene.rods.push_back(slider);
  scene.dt = 1e-5;
  const long every = steps / 200;
  const std::string joints =
      fixed.size() > 1 ? "fix joints all joint/spherocylinder youngsModulus 1e7 poissonsRatio 0.3 "
                         "join 1e-6\n"
                       : "";
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.ride",
               preamble(scene, mode) + "read_data rods.data\nneighbor 0.002 bin\n" +
                   fmt::format("group slider id {}\ngroup fixed subtract all slider\n",
                               scene.rods.size()) +
                   linear_material(kStiffness, kStiffness, 1.0, kFriction) +
                   rod_pair("linear tangential history") + joints +
                   "fix hold fixed freeze\nfix motion slider nve/spherocylinder\n"
                   "compute contacts all contact/spherocylinder\n" +
                   fmt::format("timestep {}\nthermo {}\n", scene.dt, steps) +
                   exact_dump("dump.ride", every,
                              "id fx fy fz tqx tqy tqz c_contacts") +
                   fmt::format("run {}\n", steps));
  const int ranks = mode == Mode::TwoRanks ? 2 : mode == Mode::FourRanks ? 4 : 1;
  Launch launch;
  launch.ranks = ranks;
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

TEST(FibreContacts, Look)
{
  for (const double angle : {90.0, 45.0, 20.0, 5.0, 0.0}) {
    for (const double length : {0.05, 0.0042}) {
    const Rod rod = slider(length, degrees(angle), {-0.005, 0.0, 2.0 * kRadius - kOverlap},
                           {kSpeed, 0.0, 0.0});
    const Ride one = ride(one_rod(4), rod, 10000), fibre = ride(straight(4), rod, 10000);
    double normal = 0, friction = 0, step = 0, step_f = 0;
    for (size_t k = 10; k < one.force.size(); k++) {
      normal = std::max(normal, std::fabs(fibre.force[k].z / one.force[k].z - 1.0));
      friction = std::max(friction, std::fabs(fibre.force[k].x / one.force[k].x - 1.0));
      step = std::max(step, std::fabs(fibre.force[k].z -fibre.force[k-1].z)/one.force[k].z);
      step_f = std::max(step_f, std::fabs((fibre.force[k].x -fibre.force[k-1].x)/one.force[k].x));
    }
    for (size_t k = 0; k < one.force.size(); k++) if (k % 5 == 0 || std::fabs(fibre.force[k].z-fibre.force[k-1].z) > .05*one.force[k].z) fmt::print("  {} z {} x {} y {} tx {} n {} \n", -0.005+.05*k/1000, fibre.force[k].z/one.force[k].z, fibre.force[k].x, fibre.force[k].y, fibre.torque[k].z, fibre.contacts[k]);
    fmt::print("{} {}: {} {} steps {} {} one {} {}\n", angle, length, normal, friction, step, step_f, one.force[50].z, one.force[50].x);
    }
  }
}

}  // namespace
