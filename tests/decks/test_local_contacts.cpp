// SPDX-License-Identifier: GPL-2.0-or-later
// compute pair/gran/local and wall/gran/local of rods: each contact's ids, forces, point, normal
// and overlap, against closed forms, against the forces that the rods feel, against the distance
// by search and, for rods as long as thick, against LIGGGHTS's own compute.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "scene.h"
#include "slow_distance.h"

using namespace decks;

namespace {

constexpr double kGravity = 9.81;
constexpr double kStiffness = 1e5;
const char *const kWeight = "fix weight all gravity 9.81 vector 0 0 -1\n";
const char *const kMove = "fix motion all nve/spherocylinder\n";
const char *const kSlip = "linear tangential off";
const char *const kStick = "linear tangential history";

struct Contact {
  int ids[3];  // pair: rod i, rod j, across a boundary; wall: wall, end, rod
  Vec3 force, force_normal, force_tangential, torque, torque_normal;
  double overlap;
  Vec3 point, normal;
};

constexpr int kColumns = 25;

// The columns come in LIGGGHTS's order, whatever that of the keywords.
std::string local_output(const std::string &id, const std::string &style, long every)
{
  return fmt::format("compute {} all {} normal contactPoint id force force_normal "
                     "force_tangential torque torque_normal delta\n",
                     id, style) +
         exact_local_dump("dump." + id, every, id, kColumns);
}

std::vector<Contact> contacts_of(const Snapshot &snapshot)
{
  std::vector<Contact> contacts;
  for (const std::vector<double> &row : snapshot.atoms.rows) {
    EXPECT_EQ(row.size(), static_cast<size_t>(kColumns));
    const auto vector = [&](int k) { return Vec3{row[k], row[k + 1], row[k + 2]}; };
    contacts.push_back(
        {{static_cast<int>(row[0]), static_cast<int>(row[1]), static_cast<int>(row[2])},
         vector(3),
         vector(6),
         vector(9),
         vector(12),
         vector(15),
         row[18],
         vector(19),
         vector(22)});
  }
  return contacts;
}

struct Result {
  std::vector<Frame> frames;
  std::vector<Snapshot> loads;  // fx fy fz tqx tqy tqz of each rod
  std::vector<std::vector<Contact>> pairs, walls;
  Table thermo;
};

Result look(const Scene &scene, Mode mode, const std::string &thermo_columns,
            const std::string &runs)
{
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  const long every = scene.dump_every ? scene.dump_every : std::max(1L, scene.steps);
  const bool has_walls = scene.physics.find("wall/gran") != std::string::npos;
  std::string deck = preamble(scene, mode) + "read_data rods.data\n" +
                     fmt::format("neighbor {} bin\nneigh_modify delay 0\n", scene.skin) +
                     scene.physics + "compute contacts all contact/spherocylinder\n" +
                     local_output("pairs", "pair/gran/local", every);
  if (has_walls) deck += local_output("walls", "wall/gran/local", every);
  deck += fmt::format("timestep {}\n", scene.dt) + thermo_columns +
          "thermo_modify norm no lost error format float %.17g\n" +
          exact_dump("dump.rods", every, std::string(kFrameColumns) + " fx fy fz tqx tqy tqz") +
          runs;
  folder.write("in.contacts", deck);
  const Outcome outcome = folder.run("in.contacts", {Program::Lmp, mode == Mode::TwoRanks ? 2 : 1});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  Result result{read_frames(folder / "dump.rods", scene),
                read_dump(folder / "dump.rods"),
                {},
                {},
                read_thermo(outcome.output)};
  for (const Snapshot &snapshot : read_dump(folder / "dump.pairs"))
    result.pairs.push_back(contacts_of(snapshot));
  if (has_walls)
    for (const Snapshot &snapshot : read_dump(folder / "dump.walls"))
      result.walls.push_back(contacts_of(snapshot));
  EXPECT_EQ(result.pairs.size(), result.frames.size());
  return result;
}

Result look(const Scene &scene, Mode mode)
{
  return look(scene, mode, "thermo 1000000\n", fmt::format("run {}\n", scene.steps));
}

class LocalContacts : public testing::TestWithParam<Mode> {};

// Flat on a floor: at each end m g / 2, overlap m g/(2 k), the force midway in the overlap below
// the end. A rod across a trough of radius R, inclined contacts: m g/(2 cos phi) along the normal
// that points from the end to the trough's axis.
TEST_P(LocalContacts, RestingOnAFloorAndInATrough)
{
  const double R = 0.08;
  Scene scene;
  scene.box_lo[2] = -0.1;
  Rod flat, across;
  flat.axis = normalized({1.0, 0.3, 0.0});
  flat.position = {0.0, -0.4, flat.radius() + 1e-4};
  const double half = across.half_cylinder();
  across.position = {0.0, 0.4, R - std::sqrt(std::pow(R - across.radius(), 2) - half * half)};
  scene.rods = {flat, across};
  scene.physics = linear_material(kStiffness, kStiffness, 0.1, 0.0) + rod_pair(kSlip) +
                  "group flat id 1\ngroup across id 2\n"
                  "fix trough across wall/gran model linear tangential off surface spherocylinder "
                  "primitive type 1 ycylinder 0.08 0.08 0\n"
                  "fix floor flat wall/gran model linear tangential off surface spherocylinder "
                  "primitive type 1 zplane 0\n" +
                  kMove + kWeight;
  scene.dt = 1e-5;
  scene.steps = 40000;
  const Result result = look(scene, GetParam());
  const std::vector<Rod> &rods = result.frames.back().rods;
  const std::vector<Contact> &contacts = result.walls.back();
  ASSERT_EQ(contacts.size(), 4u);
  EXPECT_TRUE(result.pairs.back().empty());

  double force_error = 0.0, overlap_error = 0.0, normal_error = 0.0, point_error = 0.0;
  std::set<std::pair<int, int>> ends;
  for (const Contact &contact : contacts) {
    const bool on_floor = contact.ids[0] == 1;  // walls are counted from 0 in the deck's order
    ASSERT_EQ(contact.ids[2], on_floor ? 1 : 2);
    ends.insert({contact.ids[0], contact.ids[1]});
    const Rod &rod = rods[contact.ids[2] - 1];
    const Vec3 end = rod.position + (contact.ids[1] ? half : -half) * rod.axis;
    const Vec3 to_axis{-end.x, 0.0, R - end.z};
    const Vec3 normal = on_floor ? Vec3{0.0, 0.0, 1.0} : normalized(to_axis);
    const double force = 0.5 * rod.mass() * kGravity / normal.z;
    const double overlap = on_floor ? rod.radius() - end.z : norm(to_axis) - (R - rod.radius());
    force_error = std::max(force_error, norm(contact.force - force * normal) / force);
    overlap_error = std::max({overlap_error, std::fabs(contact.overlap * kStiffness / force - 1.0),
                              std::fabs(contact.overlap - overlap) * kStiffness / force});
    normal_error = std::max(normal_error, norm(contact.normal - normal));
    point_error = std::max(point_error,
                           norm(contact.point - (end - (rod.radius() - 0.5 * overlap) * normal)) /
                               rod.diameter);
  }
  EXPECT_EQ(ends.size(), 4u);
  // What is left of the settling; the overlap is a difference of numbers 10^4 times as large.
  expect_holds({"Wall rows at rest: force, relative", "m g/(2 cos(phi))", 1e-8}, force_error);
  expect_holds({"Wall rows at rest: overlap, relative", "m g/(2 k cos(phi))", 1e-8}, overlap_error);
  expect_holds({"Wall rows at rest: normal", "towards the trough's axis, up", 1e-12}, normal_error);
  expect_holds(
      {"Wall rows at rest: point / diameter", "below the end, midway in the overlap", 1e-12},
      point_error);
}

// On two fixed rods across it at -x1 and +x2: m g x2/(x1+x2) and m g x1/(x1+x2), at the supports.
TEST_P(LocalContacts, OnTwoSupports)
{
  const double x1 = 0.02, x2 = 0.04;
  Scene scene;
  Rod rod, left, right;
  left.axis = right.axis = {0.0, 1.0, 0.0};
  left.position.x = -x1;
  right.position.x = x2;
  rod.position.z = rod.diameter;
  scene.rods = {rod, left, right};
  scene.physics = linear_material(kStiffness, kStiffness, 0.1, 0.5) + rod_pair(kStick) +
                  "group supports id 2 3\ngroup free id 1\n"
                  "fix hold supports freeze\nfix motion free nve/spherocylinder\n" +
                  std::string(kWeight);
  scene.dt = 1e-5;
  scene.steps = 40000;
  const std::vector<Contact> contacts = look(scene, GetParam()).pairs.back();
  ASSERT_EQ(contacts.size(), 2u);
  const double weight = rod.mass() * kGravity;
  double force_error = 0.0, point_error = 0.0;
  for (const Contact &contact : contacts) {
    const bool rod_is_i = contact.ids[0] == 1;
    ASSERT_TRUE(rod_is_i || contact.ids[1] == 1);
    const bool on_left = contact.ids[rod_is_i ? 1 : 0] == 2;
    const Vec3 force = rod_is_i ? contact.force : -contact.force;
    const double share = on_left ? x2 / (x1 + x2) : x1 / (x1 + x2);
    force_error = std::max(force_error, norm((1.0 / weight) * force - Vec3{0.0, 0.0, share}));
    // The supports are held, and the free rod's overlap there is 10^-6 m: the point is D/2 - half
    // of that above the support's axis.
    const Vec3 point{on_left ? -x1 : x2, 0.0, 0.5 * (rod.diameter - contact.overlap)};
    point_error = std::max(point_error, norm(contact.point - point) / rod.diameter);
    EXPECT_EQ(contact.ids[2], 0);
  }
  // The free rod leans by 10^-5: forces and points lean with it.
  expect_holds({"Rod on two supports: rows' forces / m g", "m g x2/(x1+x2)", 1e-5}, force_error);
  expect_holds({"Rod on two supports: rows' points / diameter", "at the supports", 1e-5},
               point_error);
}

// Two rods pressed together at 60 degrees, neither at its middle, nothing moves: F = k delta along
// the common perpendicular, acting midway in the overlap, torque arm x F.
TEST_P(LocalContacts, CrossedRodsPressed)
{
  const double overlap = 2e-4, s = 0.03, t = -0.02;
  Scene scene;
  Rod a, b;
  b.axis = {0.5, std::sqrt(0.75), 0.0};
  b.diameter = 0.014;
  const Vec3 meeting{0.1, -0.05, 0.2};
  const double distance = a.radius() + b.radius() - overlap;
  a.position = meeting - s * a.axis;
  b.position = meeting + Vec3{0.0, 0.0, distance} - t * b.axis;
  scene.rods = {a, b};
  scene.physics = linear_material(kStiffness, kStiffness, 0.5, 0.0) + rod_pair(kSlip) + kMove;
  const std::vector<Contact> contacts = look(scene, GetParam()).pairs.back();
  ASSERT_EQ(contacts.size(), 1u);
  const Contact &c = contacts[0];
  const double sign = c.ids[0] == 1 ? -1.0 : 1.0;  // rod 1 lies below
  const Vec3 normal{0.0, 0.0, sign};
  const Vec3 point = meeting + Vec3{0.0, 0.0, a.radius() - 0.5 * overlap};
  const Rod &i = c.ids[0] == 1 ? a : b;
  const double force = kStiffness * overlap;
  EXPECT_EQ(c.ids[0] + c.ids[1], 3);
  // Round-off of an overlap 50 times smaller than the rods.
  expect_holds(
      {"Crossed rods pressed: force and overlap, relative", "k delta", 1e-12},
      std::max(norm(c.force - force * normal) / force, std::fabs(c.overlap / overlap - 1.0)));
  expect_holds({"Crossed rods pressed: torque / (force x diameter)", "arm x F", 1e-12},
               norm(c.torque - cross(point - i.position, force * normal)) / (force * a.diameter));
  expect_holds({"Crossed rods pressed: normal", "common perpendicular", 1e-14},
               norm(c.normal - normal));
  expect_holds({"Crossed rods pressed: point / diameter", "midway in the overlap", 1e-14},
               norm(c.point - point) / a.diameter);
}

// Rods thrown together without regard to overlap, on a floor.
Scene heap()
{
  std::mt19937 random(72019);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::normal_distribution<double> normal;
  Scene scene;
  for (int i = 0; i < 120; i++) {
    Rod rod;
    rod.diameter = i % 2 ? 0.01 : 0.014;
    rod.length = rod.diameter * (1.0 + i % 6);
    rod.position = {0.075 * any(random), 0.075 * any(random), 0.08 + 0.07 * any(random)};
    rod.axis = normalized({normal(random), normal(random), normal(random)});
    rod.velocity = {any(random), any(random), -1.0 + any(random)};
    rod.omega = {20.0 * any(random), 20.0 * any(random), 20.0 * any(random)};
    scene.rods.push_back(rod);
  }
  for (int d = 0; d < 2; d++) {
    scene.box_lo[d] = -0.11;
    scene.box_hi[d] = 0.11;
  }
  scene.box_lo[2] = -0.1;
  scene.physics = linear_material(1e4, 5e3, 0.5, 0.3) +
                  rod_wall("floor", kStick, "type 1 zplane 0.0") + kMove + kWeight;
  scene.dt = 1e-5;
  scene.steps = 300;
  scene.dump_every = 100;
  return scene;
}

Scene heap_in_a_vessel()
{
  Scene scene = heap();
  scene.physics += rod_wall("side", kStick, "type 1 zcylinder 0.107 0.0 0.0") +
                   "pair_style gran model linear tangential history surface spherocylinder "
                   "spread_contact off\npair_coeff * *\n";
  return scene;
}

Scene heap_across_boundaries()
{
  Scene scene = heap();
  scene.physics += rod_pair(kStick);
  scene.boundary = "p p f";
  for (Rod &rod : scene.rods) {
    rod.position.x += 0.11;
    rod.position.y += 0.11;
    for (double *x : {&rod.position.x, &rod.position.y})
      if (*x > 0.11) *x -= 0.22;
  }
  return scene;
}

// The way from b to a, by the nearest image.
Vec3 way(const Scene &scene, const Vec3 &a, const Vec3 &b)
{
  Vec3 d = a - b;
  if (scene.boundary != "p p f") return d;
  d.x -= 0.22 * std::round(d.x / 0.22);
  d.y -= 0.22 * std::round(d.y / 0.22);
  return d;
}

// The rows of each rod sum up to the force and the torque it felt, less its weight. What the torque
// of a row holds beyond (point - centre) x force is a couple of spread_contact: rod j feels its
// opposite. With `closest` there is none.
void expect_rows_sum_to_loads(const Scene &scene, const Result &result, size_t frame,
                              const std::string &name, bool closest)
{
  const std::vector<Rod> &rods = result.frames[frame].rods;
  std::vector<Vec3> forces, torques;
  for (const Rod &rod : rods) {
    forces.push_back({0.0, 0.0, -rod.mass() * kGravity});
    torques.push_back({0.0, 0.0, 0.0});
  }
  const auto act = [&](int id, const Vec3 &force, const Vec3 &point) {
    forces[id - 1] = forces[id - 1] + force;
    torques[id - 1] = torques[id - 1] + cross(way(scene, point, rods[id - 1].position), force);
  };
  double own_torque = 0.0;
  for (const Contact &c : result.pairs[frame]) {
    act(c.ids[0], c.force, c.point);
    act(c.ids[1], -c.force, c.point);
    const Vec3 couple = c.torque - cross(way(scene, c.point, rods[c.ids[0] - 1].position), c.force);
    torques[c.ids[0] - 1] = torques[c.ids[0] - 1] + couple;
    torques[c.ids[1] - 1] = torques[c.ids[1] - 1] - couple;
    if (closest) own_torque = std::max(own_torque, norm(couple));
  }
  for (const Contact &c : result.walls[frame]) {
    act(c.ids[2], c.force, c.point);
    own_torque = std::max(own_torque,
                          norm(c.torque - cross(c.point - rods[c.ids[2] - 1].position, c.force)));
  }
  double force_error = 0.0, torque_error = 0.0, largest_force = 0.0, largest_torque = 0.0;
  const Table &loads = result.loads[frame].atoms;
  for (size_t k = 0; k < rods.size(); k++) {
    const auto vector = [&](const char *x, const char *y, const char *z) {
      return Vec3{loads.at(k, x), loads.at(k, y), loads.at(k, z)};
    };
    const Vec3 force = vector("fx", "fy", "fz"), torque = vector("tqx", "tqy", "tqz");
    largest_force = std::max(largest_force, norm(force));
    largest_torque = std::max(largest_torque, norm(torque));
    force_error = std::max(force_error, norm(force - forces[k]));
    torque_error = std::max(torque_error, norm(torque - torques[k]));
  }
  ASSERT_GT(largest_torque, 0.0);
  expect_holds({name + ": sum of rows' forces, relative", "force each rod felt", 1e-12},
               force_error / largest_force);
  expect_holds(
      {name + ": sum of (point - centre) x force, relative", "torque each rod felt", 1e-12},
      std::max(torque_error, own_torque) / largest_torque);
}

void expect_parts_belong_together(const std::vector<Contact> &contacts)
{
  for (const Contact &c : contacts) {
    const Vec3 along = dot(c.force, c.normal) * c.normal;
    const Vec3 twist = dot(c.torque, c.normal) * c.normal;
    EXPECT_NEAR(norm(c.normal), 1.0, 1e-14);
    EXPECT_LE(norm(c.force_normal - along), 1e-14 * norm(c.force));
    EXPECT_LE(norm(c.force_tangential - (c.force - along)), 1e-14 * norm(c.force));
    EXPECT_LE(norm(c.torque_normal - twist), 1e-14 * norm(c.torque));
  }
}

// From the contact point, r_i - delta/2 along n is a point of axis i, r_j - delta/2 against n one of
// axis j; they are as far apart as the axes by search. So they are the closest points.
void expect_points_are_closest(const Scene &scene, const std::vector<Rod> &rods,
                               const std::vector<Contact> &contacts, const std::string &name)
{
  double overlap_error = 0.0, point_error = 0.0;
  for (const Contact &c : contacts) {
    const Rod &i = rods[c.ids[0] - 1];
    Rod j = rods[c.ids[1] - 1];
    j.position = i.position - way(scene, i.position, j.position);
    const double reach = i.radius() + j.radius();
    overlap_error =
        std::max(overlap_error, std::fabs(c.overlap - (reach - slow_distance(i, j))) / reach);
    Rod point;  // as long as thick: its axis is a point
    point.length = point.diameter;
    const Vec3 at = i.position + way(scene, c.point, i.position);
    point.position = at + (i.radius() - 0.5 * c.overlap) * c.normal;
    point_error = std::max(point_error, slow_distance(point, i) / reach);
    point.position = at - (j.radius() - 0.5 * c.overlap) * c.normal;
    point_error = std::max(point_error, slow_distance(point, j) / reach);
    const bool across = norm(i.position - rods[c.ids[0] - 1].position) > 0.1 ||
                        norm(j.position - rods[c.ids[1] - 1].position) > 0.1;
    EXPECT_EQ(c.ids[2], across ? 1 : 0);
  }
  // The search is good to 10^-9 of a length.
  expect_holds({name + ": rows' overlaps / diameter", "distance by search", 1e-8}, overlap_error);
  expect_holds({name + ": rows' points and normals / diameter", "lead to both axes", 1e-12},
               point_error);
}

// A wall's force acts midway in the overlap: that far beyond the plane or the cylinder.
void expect_points_are_in_walls(const std::vector<Rod> &rods, const std::vector<Contact> &contacts)
{
  for (const Contact &c : contacts) {
    const Rod &rod = rods[c.ids[2] - 1];
    const double half = rod.half_cylinder();
    const Vec3 end = rod.position + (c.ids[1] ? half : -half) * rod.axis;
    if (c.ids[0] == 0) {
      EXPECT_NEAR(c.point.z, -0.5 * c.overlap, 1e-15);
      EXPECT_LE(norm(c.normal - Vec3{0.0, 0.0, 1.0}), 1e-15);
      EXPECT_NEAR(c.overlap, rod.radius() - end.z, 1e-15);
    } else {
      const Vec3 from_axis{c.point.x, c.point.y, 0.0};
      EXPECT_NEAR(norm(from_axis), 0.107 + 0.5 * c.overlap, 1e-15);
      EXPECT_LE(norm(c.normal + normalized(from_axis)), 1e-14);
      EXPECT_NEAR(c.overlap, std::hypot(end.x, end.y) - (0.107 - rod.radius()), 1e-15);
    }
  }
}

// Each pair of touching rods once, as compute contact/spherocylinder counts them.
void expect_each_pair_once(const Frame &frame, const std::vector<Contact> &contacts)
{
  std::vector<double> counted(frame.rods.size(), 0.0);
  std::set<std::pair<int, int>> pairs;
  for (const Contact &c : contacts) {
    pairs.insert(std::minmax(c.ids[0], c.ids[1]));
    for (const int k : {0, 1}) counted[c.ids[k] - 1]++;
  }
  EXPECT_EQ(pairs.size(), contacts.size());
  EXPECT_EQ(counted, frame.contacts);
}

// `closest`: contacts sit at the closest points (spread_contact off).
void expect_rows_of_a_heap(const Scene &scene, Mode mode, const std::string &name, bool closest)
{
  const Result result = look(scene, mode);
  ASSERT_EQ(result.frames.size(), 4u);
  size_t at_walls[2] = {0, 0}, across = 0;
  for (size_t frame = 0; frame < result.frames.size(); frame++) {
    const std::vector<Rod> &rods = result.frames[frame].rods;
    ASSERT_GT(result.pairs[frame].size(), 15u);
    expect_each_pair_once(result.frames[frame], result.pairs[frame]);
    expect_rows_sum_to_loads(scene, result, frame, name, closest);
    if (closest) expect_points_are_closest(scene, rods, result.pairs[frame], name);
    expect_points_are_in_walls(rods, result.walls[frame]);
    expect_parts_belong_together(result.pairs[frame]);
    expect_parts_belong_together(result.walls[frame]);
    for (const Contact &c : result.walls[frame]) at_walls[c.ids[0]]++;
    for (const Contact &c : result.pairs[frame]) across += c.ids[2];
  }
  const bool periodic = scene.boundary == "p p f";
  EXPECT_GT(at_walls[0], 4u);
  EXPECT_GE(at_walls[1], periodic ? 0u : 5u);
  EXPECT_GE(across, periodic ? 5u : 0u);
}

TEST_P(LocalContacts, HeapInAVessel)
{
  const Scene scene = heap_in_a_vessel();
  expect_rows_of_a_heap(scene, GetParam(), "Heap in a vessel", true);
}

TEST_P(LocalContacts, HeapAcrossBoundaries)
{
  const Scene scene = heap_across_boundaries();
  expect_rows_of_a_heap(scene, GetParam(), "Heap across boundaries", false);
}

INSTANTIATE_TEST_SUITE_P(, LocalContacts, testing::Values(Mode::OneRank, Mode::TwoRanks),
                         [](const testing::TestParamInfo<Mode> &info) {
                           return name_of(info.param);
                         });

// A rod as long as thick is a sphere: LIGGGHTS's own compute of its own spheres must give the same
// rows. Elastic, since LIGGGHTS computes the forces again at output, with the velocities half a step
// later; velocities are compared at the start.
TEST(LocalContactsOfSpheres, AreThoseOfStockLiggghts)
{
  std::mt19937 random(90001);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Scene scene;
  std::string spheres, velocities;
  for (int i = 0; i < 64; i++) {
    Rod ball;
    ball.length = ball.diameter = i % 3 ? 0.022 : 0.024;
    ball.position = {0.02 * (i % 4) + 0.002 * any(random), 0.02 * (i / 4 % 4), 0.02 * (i / 16)};
    ball.velocity = {any(random), any(random), any(random)};
    ball.omega = {20.0 * any(random), 20.0 * any(random), 20.0 * any(random)};
    scene.rods.push_back(ball);
    spheres += fmt::format("{} 1 {} {} {} {} {}\n", i + 1, ball.diameter, ball.density,
                           ball.position.x, ball.position.y, ball.position.z);
    velocities += fmt::format("{} {} {} {} {} {} {}\n", i + 1, ball.velocity.x, ball.velocity.y,
                              ball.velocity.z, ball.omega.x, ball.omega.y, ball.omega.z);
  }
  const std::string stock_data =
      fmt::format("balls\n\n64 atoms\n1 atom types\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n\n"
                  "Atoms\n\n{}\nVelocities\n\n{}",
                  spheres, velocities);
  const auto deck = [](bool stock) {
    return fmt::format(R"(atom_style {0}
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
read_data balls.data
neighbor 0.004 bin
neigh_modify delay 0
fix p1 all property/global youngsModulus peratomtype 5e6
fix p2 all property/global poissonsRatio peratomtype 0.45
fix p3 all property/global coefficientRestitution peratomtypepair 1 1.0
fix p4 all property/global coefficientFriction peratomtypepair 1 0.3
fix p5 all property/global characteristicVelocity scalar 1.0
pair_style gran model hooke tangential history surface {1}
pair_coeff * *
fix motion all {2}
timestep 1e-5
compute rows all pair/gran/local pos vel id force force_normal force_tangential torque &
  torque_normal torque_tangential history contactArea delta contactPoint
{3}run 100
)",
                       stock ? "granular" : "spherocylinder", stock ? "default" : "spherocylinder",
                       stock ? "nve/sphere" : "nve/spherocylinder",
                       exact_local_dump("dump.rows", 100, "rows", stock ? 41 : 44));
  };
  const auto rows_of = [&](const std::string &data, bool stock, Program program) {
    const DeckFolder folder;
    folder.write("balls.data", data);
    folder.write("in.balls", deck(stock));
    const Outcome outcome = folder.run("in.balls", {program, 1});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    std::vector<std::vector<std::vector<double>>> steps;
    for (const Snapshot &snapshot : read_dump(folder / "dump.rows")) {
      steps.push_back(snapshot.atoms.rows);
      for (std::vector<double> &row : steps.back())
        if (!stock) row.erase(row.begin() + 36, row.begin() + 39);  // the remembered side
      std::sort(steps.back().begin(), steps.back().end(), [](const auto &a, const auto &b) {
        return std::make_pair(a[12], a[13]) < std::make_pair(b[12], b[13]);  // by ids
      });
    }
    return steps;
  };
  const auto got = rows_of(data_file(scene), false, Program::Lmp);
  const auto wanted = rows_of(stock_data, true, Program::Stock);
  // The plug-in leaves decks of spheres alone. (The sanitizers cannot be preloaded after the start.)
  if (!SPHEROCYLINDER_SANITIZED) {
    EXPECT_EQ(rows_of(stock_data, true, Program::Preloaded), wanted);
  }

  ASSERT_EQ(got.size(), 2u);
  ASSERT_EQ(wanted.size(), 2u);
  double error = 0.0;
  for (size_t step = 0; step < 2; step++) {
    ASSERT_GT(wanted[step].size(), 20u);
    ASSERT_EQ(got[step].size(), wanted[step].size());
    // Scales: of all force columns the force, of all torque columns the torque.
    const auto scale_of = [](size_t column) {
      return column < 15 || column >= 33 ? column : column < 24 ? 15 : 24;
    };
    std::vector<double> largest(41, 0.0), difference(41, 0.0);
    for (size_t k = 0; k < wanted[step].size(); k++)
      for (size_t column = 0; column < 41; column++) {
        if (step > 0 && column >= 6 && column < 12) continue;  // velocities
        // Between balls of two sizes LIGGGHTS gives the point that shares the overlap in proportion
        // to the radii, the rods' the one in its middle, where the forces act.
        const auto diameter = [&](size_t id_column) {
          return scene.rods[static_cast<size_t>(wanted[step][k][id_column]) - 1].diameter;
        };
        if (column >= 38 && diameter(12) != diameter(13)) continue;
        const double value = wanted[step][k][column];
        largest[scale_of(column)] = std::max(largest[scale_of(column)], std::fabs(value));
        difference[column] =
            std::max(difference[column], std::fabs(got[step][k].at(column) - value));
      }
    for (size_t column = 0; column < 41; column++)
      if (difference[column] > 0.0)
        error = std::max(error, difference[column] / largest[scale_of(column)]);
  }
  // Round-off over 100 steps of contact.
  expect_holds(
      {"Rows of rods with length = diameter, each column, relative", "stock LIGGGHTS", 1e-10},
      error);
}

// Each end's own tangential spring, without damping: force_tangential = -kt history. The rods turn
// on the floor, so that their ends move opposite ways; one of them is not in the compute's group.
TEST(LocalContactsHistory, EachEndOfARodHasItsOwn)
{
  const double kt = 5e4;
  Scene scene;
  scene.box_lo[2] = -0.1;
  Rod rod;
  rod.position.z = rod.radius() - 0.5 * rod.mass() * kGravity / kStiffness;
  rod.omega.z = 0.002;
  Rod other = rod;
  other.position.y = 0.3;
  scene.rods = {rod, other};
  scene.physics = linear_material(kStiffness, kt, 1.0, 0.5) + rod_pair(kStick) +
                  rod_wall("floor", kStick, "type 1 zplane 0.0") + kMove + kWeight;
  const DeckFolder folder;
  folder.write("rods.data", data_file(scene));
  folder.write("in.ends",
               preamble(scene) + "read_data rods.data\nneighbor 0.02 bin\n" + scene.physics +
                   "group second id 2\n"
                   "compute ends second wall/gran/local id force_tangential history\n" +
                   exact_local_dump("dump.ends", 100, "ends", 9) + "timestep 1e-6\nrun 100\n");
  const Outcome outcome = folder.run("in.ends");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::vector<std::vector<double>> rows = read_dump(folder / "dump.ends").back().atoms.rows;
  ASSERT_EQ(rows.size(), 2u);
  // The ends have moved by omega h/2 t = 9 10^-9 m.
  for (int end = 0; end < 2; end++) {
    const std::vector<double> &row = rows[end];
    EXPECT_EQ(row[1], end);
    EXPECT_EQ(row[2], 2.0);
    EXPECT_NEAR(row[7], (end ? 1.0 : -1.0) * 9e-9, 0.5e-9);
    for (int d = 0; d < 3; d++) EXPECT_NEAR(row[3 + d], -kt * row[6 + d], 1e-12 * kt * 9e-9);
  }
}

// compute reduce: the floor carries the weight, in each of several runs, whether they set up or not.
TEST(LocalContactsReduced, FloorCarriesTheWeight)
{
  Scene scene;
  scene.box_lo[2] = -0.1;
  Rod rod, ball;
  rod.position.z = rod.radius();
  ball.length = ball.diameter;
  ball.position = {0.1, 0.0, ball.radius()};
  scene.rods = {rod, ball};
  scene.physics = linear_material(kStiffness, kStiffness, 0.1, 0.2) + rod_pair(kStick) +
                  rod_wall("floor", kStick, "type 1 zplane 0.0") + kMove + kWeight;
  scene.dt = 1e-5;
  scene.dump_every = 10000;
  const Table thermo =
      look(scene, Mode::OneRank,
           "compute load all reduce sum c_walls[6]\ncompute deepest all reduce max c_walls[19]\n"
           "thermo_style custom step c_load c_deepest\nthermo 40000\n",
           "run 40000\nrun 0\nrun 0\nrun 10 pre no\n")
          .thermo;
  ASSERT_EQ(thermo.rows.size(), 2u);  // of the last run
  const double weight = (rod.mass() + ball.mass()) * kGravity;
  for (const std::vector<double> &row : thermo.rows) {
    EXPECT_NEAR(row[1] / weight, 1.0, 1e-8);
    EXPECT_NEAR(row[2] * kStiffness / (0.5 * rod.mass() * kGravity), 1.0, 1e-8);
  }
}

}  // namespace
