// SPDX-License-Identifier: GPL-2.0-or-later
// closest_points and spread_contact over ten million pairs of segments in all families of poses.
//
// The distance is compared with the nine faces of the problem in quadruple precision. A point
// c + s u in double precision is off by an epsilon or so of its coordinates, so that a distance
// below 1/1000 of the coordinates has no twelve digits; there the bound is in epsilons of the
// coordinates (tests/unit/closest_points_test.cpp).
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "claim.h"
#include "closest_points_reference.h"
#include "core/closest_points.h"
#include "core/spread_contact.h"
#include "results_file.h"
#include "segment_families.h"

using namespace spherocylinder;

namespace {

constexpr int kPairs = 850000;  // of each family: 1.02e7 in all
constexpr double kRelative = 1e-12;
constexpr double kRoundOff = 4.0 * kEpsilon;  // of the coordinates
constexpr double kBedOverlap = 0.05;          // of the diameter

Segment reversed(const Segment &segment)
{
  return {segment.centre, -segment.axis, segment.half_length};
}

double distance(const Segment &i, const Segment &j)
{
  return std::sqrt(closest_points(i, j).distance_squared);
}

// Distance of the contact points of the second rule.
double spread_distance(const Segment &i, const Segment &j, double reach)
{
  return reach - spread_contact(i, j, reach, closest_points(i, j)).overlap;
}

std::string text_of(const Segment &segment)
{
  const Vec3 &c = segment.centre, &u = segment.axis;
  return fmt::format("({:.17g} {:.17g} {:.17g}) ({:.17g} {:.17g} {:.17g}) {:.17g}", c.x, c.y, c.z,
                     u.x, u.y, u.z, segment.half_length);
}

struct Worst {
  double relative = 0.0;     // |d - d_ref|/d_ref, where d_ref > 1/1000 of the coordinates
  double of_epsilons = 0.0;  // |d - d_ref| / (epsilon coordinates)
  double of_diameter = 0.0;  // |d - d_ref| / diameter, for pairs that touch
  double swapped = 0.0;      // |d(i, j) - d(j, i)| / (epsilon coordinates)
  double reversed = 0.0;     // the same for u -> -u
  // Of the second rule, / diameter, for pairs that touch as rods in a bed do.
  double spread_swapped = 0.0, spread_reversed = 0.0;
  int resolved = 0, touching = 0;
  Pair pair{};  // of the worst relative error

  void add(const SizedPair &sized);
};

void keep_larger(double &worst, double value) { worst = std::max(worst, value); }

void Worst::add(const SizedPair &sized)
{
  const auto &[i, j] = sized.pair;
  const double diameter = sized.diameter, unit = kEpsilon * scale_of(sized.pair);
  const double d = distance(i, j);
  const long double reference = distance_by_faces(i, j);
  const double error = static_cast<double>(std::fabs(d - reference));

  keep_larger(of_epsilons, error / unit);
  if (kRelative * reference >= 4.0 * unit) {
    resolved++;
    if (error > relative * static_cast<double>(reference)) {
      relative = error / static_cast<double>(reference);
      pair = sized.pair;
    }
  }
  keep_larger(swapped, std::fabs(d - distance(j, i)) / unit);
  for (const double other : {distance(::reversed(i), j), distance(i, ::reversed(j)),
                             distance(::reversed(i), ::reversed(j))})
    keep_larger(reversed, std::fabs(d - other) / unit);

  if (d >= diameter) return;
  touching++;
  keep_larger(of_diameter, error / diameter);
  if (d < (1.0 - kBedOverlap) * diameter) return;
  const double spread = spread_distance(i, j, diameter);
  keep_larger(spread_swapped, std::fabs(spread - spread_distance(j, i, diameter)) / diameter);
  for (const double other :
       {spread_distance(::reversed(i), j, diameter), spread_distance(i, ::reversed(j), diameter)})
    keep_larger(spread_reversed, std::fabs(spread - other) / diameter);
}

}  // namespace

TEST(SweepGeometry, AllFamilies)
{
  ResultsFile csv("geometry.csv",
                  "family,pairs,pairs_above_1/1000_of_coordinates,worst_relative_error,"
                  "worst_error_in_epsilons_of_coordinates,touching_pairs,"
                  "worst_error_of_touching_pairs_over_diameter,"
                  "swap_i_j_in_epsilons_of_coordinates,reverse_axes_in_epsilons_of_coordinates,"
                  "spread_contact_swap_over_diameter,spread_contact_reverse_over_diameter,"
                  "worst_pose_i: (centre_m) (axis) half_length_m,worst_pose_j");
  Worst all;
  for (const Family &family : families()) {
    RandomRods random(15485863);
    Worst worst;
    for (int k = 0; k < kPairs; k++) worst.add(any_size(family, random));
    csv.row("{},{},{},{:.2e},{:.2f},{},{:.1e},{:.2f},{:.2f},{:.1e},{:.1e},{},{}", family.name,
            kPairs, worst.resolved, worst.relative, worst.of_epsilons, worst.touching,
            worst.of_diameter, worst.swapped, worst.reversed, worst.spread_swapped,
            worst.spread_reversed, text_of(worst.pair.i), text_of(worst.pair.j));
    fmt::print("{:<22} relative {:.1e} ({:.0f} % of pairs), {:.2f} eps; touching {:.1e} D; swap "
               "{:.2f} eps, reverse {:.2f} eps; spread: swap {:.1e} D, reverse {:.1e} D\n",
               family.name, worst.relative, 100.0 * worst.resolved / kPairs, worst.of_epsilons,
               worst.of_diameter, worst.swapped, worst.reversed, worst.spread_swapped,
               worst.spread_reversed);
    std::fflush(stdout);
    keep_larger(all.relative, worst.relative);
    keep_larger(all.of_epsilons, worst.of_epsilons);
    keep_larger(all.swapped, worst.swapped);
    keep_larger(all.reversed, worst.reversed);
  }
  decks::expect_holds(
      {"Distance of segments, relative", "nine faces, quadruple precision", kRelative},
      all.relative);
  decks::expect_holds(
      {"Distance of segments, of the coordinates", "nine faces, quadruple precision", kRoundOff},
      all.of_epsilons * kEpsilon);
  // Either of two distances may be off by the bound above.
  decks::expect_holds(
      {"Distance of segments, i and j swapped, of the coordinates", "same pair", 2.0 * kRoundOff},
      all.swapped * kEpsilon);
  decks::expect_holds(
      {"Distance of segments, u -> -u, of the coordinates", "same pair", 2.0 * kRoundOff},
      all.reversed * kEpsilon);
}
