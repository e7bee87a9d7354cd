// SPDX-License-Identifier: GPL-2.0-or-later
// What is measured of the contacts of a bed. Two rods, or a rod's end and a wall, touch where the
// gap of their surfaces is below the gap that was asked for.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "io/fibres.h"
#include "io/rods.h"
#include "measures/close_pairs.h"
#include "measures/mean_with_error.h"
#include "measures/packing_measures.h"

namespace spherocylinder {

// An end of a rod at the floor or at the inside of the vessel's wall: straight rods inside a
// cylinder touch nowhere else. A rod that lies flat has two.
struct WallContact {
  std::uint32_t rod;  // index into the rods
  bool at_floor;      // else at the cylinder
  bool at_plus;       // at the end +u of the axis (always, if the rod is a sphere)
  double gap;         // m, negative if it overlaps
};

// A vessel of infinite radius is a floor alone.
std::vector<WallContact> wall_contacts(const std::vector<Rod> &rods, const Vessel &vessel,
                                       double largest_gap);

// Contacts of each rod.
std::vector<std::uint32_t> pair_contact_numbers(std::size_t rods,
                                                const std::vector<ClosePair> &pairs);
void add_wall_contacts(std::vector<std::uint32_t> &numbers, const std::vector<WallContact> &walls);

// A closest point at the end of the axis lies on the hemisphere, else on the cylinder. Spheres are
// all end.
bool at_end(double position, double half_length);

// Parts of all pairs that touch with their sides, with a side and an end, and with their ends.
struct ContactKinds {
  double side_side, side_end, end_end;
};

struct CountedKinds {
  MeanWithError side_side, side_end, end_end;
};

// Ends that segments of fibres share are sides.
CountedKinds contact_kinds(const std::vector<Rod> &rods, const std::vector<ClosePair> &pairs,
                           const Fibres &fibres = {});

// The same for rods of diameter D and cylinder length x D that know nothing of each other. The
// volume from which the centre of one is kept by the other (Onsager, Ann. N. Y. Acad. Sci. 51
// (1949) 627)
//   2 s x^2 D^3 + 2 pi x D^3 + (4/3) pi D^3,  s = <|sin gamma|>,
// grows by dD through a shell 2 s L^2 + 4 pi L D + 4 pi D^2 (L = x D) where the pair touches in
// these three ways: side by side, 2 s x^2; side to end, 4 pi x; end to end, 4 pi.
ContactKinds uncorrelated_contact_kinds(double x, double mean_sin_gamma);

// Positions |s|/(h/2) of all side contacts, 0 at the centre and 1 at the end of the cylinder; each
// pair has up to two.
std::vector<double> side_positions(const std::vector<Rod> &rods,
                                   const std::vector<ClosePair> &pairs);

// Overlaps over the mean of the two diameters, of those pairs that overlap; at a wall over the
// rod's.
std::vector<double> pair_overlaps(const std::vector<Rod> &rods,
                                  const std::vector<ClosePair> &pairs);
std::vector<double> wall_overlaps(const std::vector<Rod> &rods,
                                  const std::vector<WallContact> &walls);

struct Spread {
  MeanWithError mean;
  double root_mean_square, largest;  // NaN for no values
};

Spread spread_of(const std::vector<double> &values);

struct HistogramBin {
  double low, high;
  std::size_t count;
  MeanWithError part;  // of all values
  MeanWithError density() const { return {part.mean / (high - low), part.error / (high - low)}; }
};

// Equal bins from 0 to `high`; values above are counted by the fractions only.
std::vector<HistogramBin> histogram(const std::vector<double> &values, double high,
                                    std::size_t bins);

// <|sin gamma|> of touching pairs that know nothing of each other, for long isotropic rods: they
// meet in proportion to |sin gamma|, so that it is <sin^2>/<sin> = (2/3)/(pi/4).
constexpr double kIsotropicContactSinGamma = 0.84882636315677518;

}  // namespace spherocylinder
