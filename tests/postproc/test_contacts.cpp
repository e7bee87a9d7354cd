// SPDX-License-Identifier: GPL-2.0-or-later
// Near pairs of rods, and what is measured of contacts.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

#include "cli/result_table.h"
#include "core/closest_points.h"
#include "core/numbers.h"
#include "core/spread_contact.h"
#include "io/input_error.h"
#include "measures/close_pairs.h"
#include "measures/contact_forces.h"
#include "measures/contact_statistics.h"
#include "measures/orientation_statistics.h"
#include "measures/packing_theory.h"
#include "scratch_folder.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

Rod rod(const Vec3 &centre, const Vec3 &axis, double half_length, double radius)
{
  return {1, 1, {{centre, axis, half_length}, radius}};
}

// Rods at random places and directions that know nothing of each other.
std::vector<Rod> ideal_gas(std::size_t count, double side, double half_length, double radius,
                           unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, side);
  std::vector<Rod> rods;
  for (const Vec3 &axis : random_directions(count, random))
    rods.push_back(rod({place(random), place(random), place(random)}, axis, half_length, radius));
  return rods;
}

using Found = std::tuple<std::uint32_t, std::uint32_t, double, double, double>;

// All pairs of all rods with all images of all others, one by one.
std::vector<Found> pairs_by_brute_force(const std::vector<Rod> &rods, const Periodicity &box,
                                        double gap)
{
  std::vector<Found> found;
  const auto images = [&](int d) { return box.side[d] > 0.0 ? 2 : 0; };
  for (std::uint32_t i = 0; i < rods.size(); i++)
    for (std::uint32_t j = i + 1; j < rods.size(); j++)
      for (int x = -images(0); x <= images(0); x++)
        for (int y = -images(1); y <= images(1); y++)
          for (int z = -images(2); z <= images(2); z++) {
            Segment moved = rods[j].capsule.segment;
            moved.centre = moved.centre + Vec3{x * box.side[0], y * box.side[1], z * box.side[2]};
            const double radii = rods[i].capsule.radius + rods[j].capsule.radius;
            const double furthest = rods[i].capsule.segment.half_length + moved.half_length + radii;
            if (norm(moved.centre - rods[i].capsule.segment.centre) > furthest + gap) continue;
            const ClosestPoints points = closest_points(rods[i].capsule.segment, moved);
            const double g = std::sqrt(points.distance_squared) - radii;
            if (!(g < gap)) continue;
            const ClosestPoints touching =
                spread_contact(rods[i].capsule.segment, moved, radii + gap, points).points;
            found.push_back({i, j, g, touching.s, touching.t});
          }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Found> pairs_found(const std::vector<Rod> &rods, const Periodicity &box, double gap)
{
  std::vector<Found> found;
  for (const ClosePair &pair : close_pairs(rods, box, gap))
    found.push_back({pair.i, pair.j, pair.gap, pair.s, pair.t});
  std::sort(found.begin(), found.end());
  return found;
}

void expect_same_pairs(const std::vector<Rod> &rods, const Periodicity &box, double gap,
                       std::size_t least)
{
  const auto found = pairs_found(rods, box, gap), wanted = pairs_by_brute_force(rods, box, gap);
  EXPECT_GE(wanted.size(), least);
  ASSERT_EQ(found.size(), wanted.size());
  const double length = rods[0].capsule.length();
  for (std::size_t k = 0; k < found.size(); k++) {
    EXPECT_EQ(std::get<0>(found[k]), std::get<0>(wanted[k]));
    EXPECT_EQ(std::get<1>(found[k]), std::get<1>(wanted[k]));
    // Round-off of coordinates of the size of the box.
    EXPECT_NEAR(std::get<2>(found[k]), std::get<2>(wanted[k]), 1e-13);
    EXPECT_NEAR(std::get<3>(found[k]), std::get<3>(wanted[k]), 1e-9 * length);
    EXPECT_NEAR(std::get<4>(found[k]), std::get<4>(wanted[k]), 1e-9 * length);
  }
}

TEST(ClosePairs, AreThoseOfAllPairs)
{
  for (const double half : {0.0, 0.01, 0.045, 0.3}) {
    SCOPED_TRACE(half);
    expect_same_pairs(ideal_gas(300, 0.4, half, 0.005, 11), {}, 0.002, half > 0.02 ? 100 : 0);
    expect_same_pairs(ideal_gas(300, 0.1, half, 0.005, 12), {}, 0.0, 100);
  }
}

TEST(ClosePairs, AreThoseOfAllPairsAndImages)
{
  Periodicity box{{0.12, 0.0, 0.2}};
  auto rods = ideal_gas(120, 0.12, 0.05, 0.005, 13);
  expect_same_pairs(rods, box, 0.001, 500);
  // Rods may lie outside the box: unwrapped coordinates, up to a box away here.
  for (std::size_t i = 0; i < rods.size(); i += 3) rods[i].capsule.segment.centre.x -= 0.12;
  expect_same_pairs(rods, box, 0.001, 500);
}

// Boxes little larger than a rod: it meets several images of another.
TEST(ClosePairs, AreThoseOfNarrowBoxes)
{
  for (const double side : {0.013, 0.031, 0.046, 0.062, 0.093}) {
    SCOPED_TRACE(side);
    expect_same_pairs(ideal_gas(50, side, 0.0, 0.005, 16), {{side, side, side}}, 0.0, 5);
    auto rods = ideal_gas(60, side, 0.03, 0.005, 17);
    for (Rod &each : rods) {  // upright enough for the box
      Vec3 &u = each.capsule.segment.axis;
      u = (1.0 / norm({0.05 * u.x, 0.05 * u.y, 1.0})) * Vec3{0.05 * u.x, 0.05 * u.y, 1.0};
    }
    expect_same_pairs(rods, {{side, side, 0.0}}, 0.0, 15);
    // Any direction, as long as the box allows: axes of 0.9 of it less the thickness.
    const double half = std::max(0.0, 0.45 * side - 0.005);
    expect_same_pairs(ideal_gas(50, side, half, 0.005, 18), {{side, side, side}}, 0.0, 5);
  }
}

TEST(ClosePairs, OfMixedSizesAndOneFarAway)
{
  auto rods = ideal_gas(200, 0.1, 0.03, 0.004, 14);
  const auto balls = ideal_gas(100, 0.1, 0.0, 0.011, 15);
  rods.insert(rods.end(), balls.begin(), balls.end());
  rods.push_back(rod({1e7, -1e6, 5.0}, {0, 0, 1}, 0.1, 0.01));
  expect_same_pairs(rods, {}, 0.0, 100);
}

// More rods than one block of the search takes: pairs within a block, of two blocks, and of images
// of either; a thick rod that many blocks reach, and one far away.
TEST(ClosePairs, AreThoseOfAllPairsInManyBlocks)
{
  auto rods = ideal_gas(3500, 0.44, 0.03, 0.004, 19);
  rods.push_back(rod({0.25, 0.2, 0.3}, {0.6, 0, 0.8}, 0.12, 0.04));
  expect_same_pairs(rods, {}, 0.0005, 3500);
  expect_same_pairs(rods, {{0.44, 0.0, 0.0}}, 0.0005, 3500);
  expect_same_pairs(rods, {{0.0, 0.44, 0.44}}, 0.0005, 3500);
  rods.push_back(rod({1e4, -1e3, 5.0}, {0, 0, 1}, 0.1, 0.01));
  expect_same_pairs(rods, {}, 0.0005, 3500);
}

// All in one place: there is nothing to cut them by. Each meets each, n (n - 1)/2 pairs.
TEST(ClosePairs, OfRodsInOnePlace)
{
  const std::size_t n = 2100;
  const std::vector<Rod> rods(n, rod({0.1, 0.2, 0.3}, {0, 0, 1}, 0.01, 0.005));
  EXPECT_EQ(close_pairs(rods, {}, 0.0).size(), n * (n - 1) / 2);
}

// Side by side, at the same height: any point of the common length is a closest one; the pair must
// come once all the same.
TEST(ClosePairs, ParallelRodsComeOnce)
{
  std::vector<Rod> rods;
  for (int i = 0; i < 20; i++)
    rods.push_back(rod({0.01 * i, 0, 0.003 * (i % 4)}, {0, 0, 1}, 0.15, 0.005));
  EXPECT_EQ(close_pairs(rods, {}, 1e-6).size(), 19u);
  EXPECT_EQ(close_pairs(rods, {}, 0.0101).size(), 19u + 18u);
  EXPECT_EQ(close_pairs(rods, {{0.2, 0, 0}}, 1e-6).size(), 20u);  // and the last with the first
}

TEST(ClosePairs, NormalPointsToTheFirst)
{
  // Crossed at right angles, j 0.009 above i: they overlap by 0.001, touching at s = 0.02, t =
  // -0.01.
  const std::vector<Rod> rods{rod({0, 0, 0}, {1, 0, 0}, 0.05, 0.005),
                              rod({0.02, 0.01, 0.009}, {0, 1, 0}, 0.05, 0.005)};
  const auto pairs = close_pairs(rods, {}, 0.0);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].gap, -0.001, 1e-15);
  EXPECT_NEAR(pairs[0].s, 0.02, 1e-15);
  EXPECT_NEAR(pairs[0].t, -0.01, 1e-15);
  EXPECT_NEAR(pairs[0].normal.z, -1.0, 1e-15);
  EXPECT_NEAR(pairs[0].sin_gamma, 1.0, 1e-15);
}

TEST(ClosePairs, BoxesThatAreTooSmall)
{
  const std::vector<Rod> rods{rod({0, 0, 0}, {1, 0, 0}, 0.05, 0.005)};
  EXPECT_NO_THROW(close_pairs(rods, {{0.11, 0, 0}}, 0.0));
  EXPECT_THROW(close_pairs(rods, {{0.1099, 0, 0}}, 0.0), InputError);
  const std::vector<Rod> ball{rod({0, 0, 0}, {1, 0, 0}, 0.0, 0.005)};
  EXPECT_NO_THROW(close_pairs(ball, {{0.01, 0, 0}}, 0.0));
  EXPECT_THROW(close_pairs(ball, {{0.0099, 0, 0}}, 0.0), InputError);
}

// Upright rods on a square lattice, every second one raised by 0.06: four neighbours each, three at
// an edge, two at a corner. Raised and lowered rods share a length whose middle is 0.03 above the
// centre of the lower one.
TEST(Contacts, OfAParallelLattice)
{
  constexpr int kSide = 6;
  const double spacing = 0.00999, half = 0.1;
  std::vector<Rod> rods;
  for (int x = 0; x < kSide; x++)
    for (int y = 0; y < kSide; y++)
      rods.push_back(rod({spacing * x, spacing * y, 0.06 * ((x + y) % 2)}, {0, 0, 1}, half, 0.005));
  const auto pairs = close_pairs(rods, {}, 0.0);
  EXPECT_EQ(pairs.size(), 2u * kSide * (kSide - 1));
  const auto numbers = pair_contact_numbers(rods.size(), pairs);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 2u), 4);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 3u), 4 * (kSide - 2));
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 4u), (kSide - 2) * (kSide - 2));
  EXPECT_EQ(contact_kinds(rods, pairs).side_side.mean, 1.0);
  const auto positions = side_positions(rods, pairs);
  EXPECT_EQ(positions.size(), 2 * pairs.size());
  for (const double position : positions) EXPECT_NEAR(position, 0.03 / half, 1e-9);
  for (const double overlap : pair_overlaps(rods, pairs)) EXPECT_NEAR(overlap, 0.001, 1e-12);

  // The same lattice without an edge.
  const auto periodic = close_pairs(rods, {{kSide * spacing, kSide * spacing, 0.0}}, 0.0);
  EXPECT_EQ(pair_contact_numbers(rods.size(), periodic),
            std::vector<std::uint32_t>(rods.size(), 4u));
}

// Layers of parallel rods, each across the one below: a rod touches all rods of the layers above
// and below, at the lattice's places.
TEST(Contacts, OfCrossedLayers)
{
  constexpr int kAcross = 5, kLayers = 4;
  const double spacing = 0.03, half = 0.075, radius = 0.005;
  std::vector<Rod> rods;
  for (int layer = 0; layer < kLayers; layer++)
    for (int k = 0; k < kAcross; k++) {
      const double place = spacing * (k - 2);
      const bool along_x = layer % 2 == 0;
      rods.push_back(rod(along_x ? Vec3{0, place, 0.0099 * layer} : Vec3{place, 0, 0.0099 * layer},
                         along_x ? Vec3{1, 0, 0} : Vec3{0, -1, 0}, half, radius));
    }
  const auto pairs = close_pairs(rods, {}, 0.0);
  EXPECT_EQ(pairs.size(), static_cast<std::size_t>(kAcross * kAcross * (kLayers - 1)));
  const auto numbers = pair_contact_numbers(rods.size(), pairs);
  for (std::size_t k = 0; k < rods.size(); k++)
    EXPECT_EQ(numbers[k], k < kAcross || k >= kAcross * (kLayers - 1) ? 5u : 10u);
  EXPECT_EQ(contact_kinds(rods, pairs).side_side.mean, 1.0);
  auto positions = side_positions(rods, pairs);
  std::sort(positions.begin(), positions.end());
  // Of each rod's five places 0, -+0.03 and -+0.06 of 0.075.
  EXPECT_NEAR(positions[positions.size() / 5 - 1], 0.0, 1e-12);
  EXPECT_NEAR(positions[positions.size() / 5], 0.4, 1e-12);
  EXPECT_NEAR(positions.back(), 0.8, 1e-12);
  for (const ClosePair &pair : pairs) EXPECT_NEAR(pair.sin_gamma, 1.0, 1e-12);
}

TEST(Contacts, SidesAndEnds)
{
  const double h = 0.05, r = 0.005;
  // An upright rod that stands on the middle of a lying one; a rod in line with the lying one.
  const std::vector<Rod> rods{rod({0, 0, 0}, {1, 0, 0}, h, r),
                              rod({0.01, 0, h + 2 * r - 1e-5}, {0, 0, 1}, h, r),
                              rod({2 * (h + r) - 1e-5, 0, 0}, {1, 0, 0}, h, r)};
  const auto pairs = close_pairs(rods, {}, 0.0);
  ASSERT_EQ(pairs.size(), 2u);
  const CountedKinds kinds = contact_kinds(rods, pairs);
  EXPECT_EQ(kinds.side_side.mean, 0.0);
  EXPECT_EQ(kinds.side_end.mean, 0.5);
  EXPECT_EQ(kinds.end_end.mean, 0.5);
  // p = (1 + 1)/(2 + 2), of two contacts.
  EXPECT_NEAR(kinds.end_end.error, std::sqrt(0.5 * 0.5 / 2), 1e-15);
  EXPECT_EQ(side_positions(rods, pairs).size(), 1u);
  EXPECT_NEAR(side_positions(rods, pairs)[0], 0.01 / h, 1e-12);
  EXPECT_TRUE(std::isnan(contact_kinds(rods, {}).side_side.mean));
}

// Rods that know nothing of each other: as many pairs have a gap within -+ shell as the excluded
// volumes of rods thicker and thinner by it differ, in the proportions of its three parts; places
// on the sides are even; and side contacts are in proportion to |sin gamma|, so that among them its
// mean is <sin^2>/<sin>.
TEST(Contacts, OfRodsThatKnowNothingOfEachOther)
{
  const double x = 8.0, radius = 0.005, half = x * radius, side = 0.4, shell = 1e-3, n = 6000;
  const auto rods = ideal_gas(static_cast<std::size_t>(n), side, half, radius, 21);
  std::vector<ClosePair> pairs;
  for (const ClosePair &pair : close_pairs(rods, {{side, side, side}}, shell))
    if (pair.gap > -shell) pairs.push_back(pair);
  const double many = static_cast<double>(pairs.size());
  const double D = 2 * radius, L = x * D, s = pi / 4;
  const auto excluded = [&](double d) {
    return 2 * s * L * L * d + 2 * pi * L * d * d + 4.0 / 3.0 * pi * d * d * d;
  };
  const double wanted =
      0.5 * n * n * (excluded(D + shell) - excluded(D - shell)) / std::pow(side, 3);
  EXPECT_GT(wanted, 10000.0);
  EXPECT_NEAR(many, wanted, 4 * std::sqrt(wanted));

  const CountedKinds found = contact_kinds(rods, pairs);
  const ContactKinds theory = uncorrelated_contact_kinds(x, s);
  EXPECT_NEAR(theory.side_side + theory.side_end + theory.end_end, 1.0, 1e-15);
  const auto scatter = [&](double part) { return 4 * std::sqrt(part * (1 - part) / many); };
  // spread_contact counts nearly parallel rods that touch beside an end as side by side.
  EXPECT_NEAR(found.side_side.mean, theory.side_side, scatter(theory.side_side) + 0.01);
  EXPECT_NEAR(found.side_end.mean, theory.side_end, scatter(theory.side_end) + 0.01);
  EXPECT_NEAR(found.end_end.mean, theory.end_end, scatter(theory.end_end));
  const MeanWithError place = mean_of(side_positions(rods, pairs));
  EXPECT_NEAR(place.mean, 0.5, 4 * place.error);
  std::vector<double> sines;
  for (const ClosePair &pair : pairs)
    if (!at_end(pair.s, half) && !at_end(pair.t, half)) sines.push_back(pair.sin_gamma);
  EXPECT_NEAR(kIsotropicContactSinGamma, (2.0 / 3.0) / (pi / 4), 1e-15);
  EXPECT_NEAR(mean_of(sines).mean, kIsotropicContactSinGamma, 4 * mean_of(sines).error + 0.005);
}

TEST(Contacts, WithWalls)
{
  const double h = 0.05, r = 0.005, R = 0.1;
  const Vessel vessel{0.2, 0.0, R, -0.3};
  const std::vector<Rod> rods{
      rod({0.2, 0, -0.3 + r - 1e-5}, {1, 0, 0}, h, r),          // flat: both ends on the floor
      rod({0.2, 0, -0.3 + h + r - 2e-5}, {0, 0, 1}, h, r),      // upright: one end
      rod({0.2 + R - h - r + 3e-5, 0, 0.0}, {-1, 0, 0}, h, r),  // its end -u at the wall
      rod({0.2, R - r + 4e-5, 0.1}, {0, 0, 1}, h, r),           // along the wall: both ends
      rod({0.2, 0, -0.3 + r - 5e-5}, {1, 0, 0}, 0.0, r),        // a ball: one point
      rod({0.2, 0, 0.0}, {0, 0, 1}, h, r)};                     // nowhere
  const auto found = wall_contacts(rods, vessel, 0.0);
  ASSERT_EQ(found.size(), 7u);
  std::vector<std::uint32_t> numbers(rods.size(), 0);
  add_wall_contacts(numbers, found);
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{2, 1, 1, 2, 1, 0}));
  EXPECT_TRUE(found[0].at_floor);
  EXPECT_FALSE(found[2].at_plus);  // the upright one stands on its end -u
  EXPECT_FALSE(found[3].at_floor);
  EXPECT_FALSE(found[3].at_plus);
  const auto overlaps = wall_overlaps(rods, found);
  const double wanted[] = {1e-5, 1e-5, 2e-5, 3e-5, 4e-5, 4e-5, 5e-5};
  for (std::size_t k = 0; k < 7; k++) EXPECT_NEAR(overlaps[k], wanted[k] / (2 * r), 1e-12);
  // Without the cylinder only the floor counts.
  const Vessel floor{0, 0, std::numeric_limits<double>::infinity(), -0.3};
  EXPECT_EQ(wall_contacts(rods, floor, 0.0).size(), 4u);
}

TEST(Contacts, HistogramAndSpread)
{
  const auto bins = histogram({0.1, 0.1, 0.6, 3.0}, 1.0, 2);
  EXPECT_EQ(bins[0].count, 2u);
  EXPECT_EQ(bins[1].count, 1u);
  EXPECT_EQ(bins[0].part.mean, 0.5);
  EXPECT_EQ(bins[0].density().mean, 1.0);
  EXPECT_NEAR(bins[0].part.error, std::sqrt(0.5 * 0.5 / 4), 1e-15);  // p = (2 + 1)/(4 + 2)
  const Spread spread = spread_of({1.0, 2.0, 2.0});
  EXPECT_NEAR(spread.mean.mean, 5.0 / 3.0, 1e-15);
  EXPECT_NEAR(spread.root_mean_square, std::sqrt(3.0), 1e-15);
  EXPECT_EQ(spread.largest, 2.0);
  EXPECT_TRUE(std::isnan(spread_of({}).largest));
}

// Mean force 2: strong are 0-1, 1-2 and 4-5; the pair 2-3 carries just the mean and is not.
TEST(ForceChains, AreWhatStrongContactsJoin)
{
  const auto contact = [](std::uint32_t i, std::uint32_t j, double force) {
    return ContactForce{i, j, {0.0, -0.6 * force, 0.8 * force}};
  };
  const std::vector<ContactForce> contacts{contact(0, 1, 3.0),  contact(2, 1, 3.0),
                                           contact(2, 3, 2.0),  contact(5, 4, 3.5),
                                           contact(3, 4, 0.25), contact(6, 0, 0.25)};
  const ForceChains chains = force_chains(8, contacts, 1.0);
  EXPECT_NEAR(chains.threshold, 2.0, 1e-15);
  EXPECT_EQ(chains.strong, 3u);
  EXPECT_EQ(chains.sizes, (std::vector<std::size_t>{3, 2}));
  EXPECT_EQ(chains.chain_of_rod, (std::vector<std::uint32_t>{1, 1, 1, 0, 2, 2, 0, 0}));
  EXPECT_EQ(force_chains(8, contacts, 0.1).sizes, (std::vector<std::size_t>{7}));
  EXPECT_TRUE(force_chains(8, contacts, 2.0).sizes.empty());
  EXPECT_TRUE(force_chains(8, {}, 1.0).sizes.empty());
}

TEST(ResultTables, SeveralFilesBecomeOne)
{
  const std::vector<Column> columns{
      {"edge", OverFiles::Same},       {"count", OverFiles::Sum},
      {"part", OverFiles::Mean},       {"part_error", OverFiles::Error},
      {"scatter", OverFiles::Scatter}, {"most", OverFiles::Largest}};
  const Rows rows = combine_files(columns, {{{1, 10, 0.2, 9, 3, 5}},
                                            {{1, 20, 0.4, 9, 4, 7}, {2, 5, 0.7, 9, 1, 1}},
                                            {{1, 3, none, none, none, none}}});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0][0], 1);
  EXPECT_EQ(rows[0][1], 33);
  EXPECT_NEAR(rows[0][2], 0.3, 1e-15);
  EXPECT_NEAR(rows[0][3], 0.1,
              1e-15);  // deviations -+0.1, sample deviation 0.1 sqrt(2), over sqrt(2)
  EXPECT_NEAR(rows[0][4], 2.5, 1e-15);  // sqrt(3^2 + 4^2)/2
  EXPECT_EQ(rows[0][5], 7);
  EXPECT_EQ(rows[1][2], 0.7);
  EXPECT_TRUE(std::isnan(rows[1][3]));  // one file tells no error
  EXPECT_TRUE(std::isnan(combine_files({{"step", OverFiles::Same}}, {{{1}}, {{2}}})[0][0]));
}

class LocalForcesTest : public ScratchFolder {
 protected:
  static std::string local(const std::string &columns, const std::string &rows, int step = 7)
  {
    const auto count = std::count(rows.begin(), rows.end(), '\n');
    return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ENTRIES\n" +
           std::to_string(count) + "\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ENTRIES " +
           columns + "\n" + rows;
  }

  std::vector<ContactForce> read(const std::string &text, const std::string &keywords,
                                 LocalKind kind = LocalKind::Pairs)
  {
    DumpFrame frame;
    frame.path = "bed.dump";
    frame.step = 7;
    std::vector<Rod> rods;
    for (const int id : {11, 5, 8}) {
      rods.push_back(rod({0, 0, 0}, {0, 0, 1}, 0.1, 0.01));
      rods.back().id = id;
    }
    LocalForces forces(write("a.local", text), kind, keywords, "--local-keywords");
    return forces.at_step(frame, rods);
  }

  void expect_error(const std::string &text, const std::string &keywords, const std::string &what)
  {
    try {
      read(text, keywords);
      ADD_FAILURE() << "no error, wanted: " << what;
    } catch (const InputError &error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  }
};

// The columns follow LIGGGHTS's order of the keywords, not that of the command.
TEST_F(LocalForcesTest, FindsItsColumns)
{
  // pos 1-6, id 7-9, force 10-12, then history of any length.
  const std::string columns = "c_p[12] c_p[7] c_p[8] c_p[10] c_p[11] c_p[1]";
  const auto found =
      read(local(columns, "3 5 11 1 2 99\n-3 8 5 -1 -2 99\n"), "force history id pos");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].i, 1u);  // id 5 is the second of the rods
  EXPECT_EQ(found[0].j, 0u);
  EXPECT_EQ(found[0].force.x, 1.0);
  EXPECT_EQ(found[0].force.y, 2.0);
  EXPECT_EQ(found[0].force.z, 3.0);
  EXPECT_EQ(found[1].i, 2u);

  // At a wall the rod's id is the third of id.
  const auto walls =
      read(local("c_w[3] c_w[4] c_w[5] c_w[6]", "8 0 0 4\n"), "id force", LocalKind::Walls);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_EQ(walls[0].i, 2u);
  EXPECT_EQ(walls[0].force.z, 4.0);
}

TEST_F(LocalForcesTest, ReadsOnToTheStep)
{
  const std::string columns = "c_p[1] c_p[2] c_p[4] c_p[5] c_p[6]";
  const std::string two = local(columns, "5 8 1 1 1\n", 3) + local(columns, "5 8 2 2 2\n", 7);
  EXPECT_EQ(read(two, "id force")[0].force.x, 2.0);
  expect_error(local(columns, "5 8 1 1 1\n", 3), "id force", "holds no step 7, which bed.dump has");
  expect_error(local(columns, "5 8 1 1 1\n", 8), "id force", "holds no step 7");
}

TEST_F(LocalForcesTest, WrongFilesAndKeywords)
{
  const std::string columns = "c_p[1] c_p[2] c_p[4] c_p[5] c_p[6]";
  const std::string good = local(columns, "5 8 1 1 1\n");
  expect_error(good, "id force colour", "'colour' is no keyword of compute pair/gran/local");
  expect_error(good, "id pos", "'force' is not among 'id pos', wanted it");
  expect_error(good, "pos id force", "a.local:9: column c_ID[7] is missing, wanted the rods' ids");
  expect_error(local("c_p[1] c_p[2] c_p[4] c_p[5]", ""), "id force", "column c_ID[6] is missing");
  expect_error(local("c_p[1] c_q[2] c_p[4]", ""), "id force", "columns of two computes, p and q");
  expect_error(local(columns, "5 9 1 1 1\n"), "id force",
               "a.local:10: id 9 is none of the rods of step 7 of bed.dump");
  expect_error(local(columns, "5 8.5 1 1 1\n"), "id force", "id 8.5 is none");
  expect_error(local(columns, "5 5 1 1 1\n"), "id force", "ids 5 and 5 are one rod, wanted two");
}

}  // namespace
}  // namespace spherocylinder
