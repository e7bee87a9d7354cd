// SPDX-License-Identifier: GPL-2.0-or-later
// Which rods of a bed are near each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/dump_frame.h"
#include "io/rods.h"

namespace spherocylinder {

struct Periodicity {
  std::array<double, 3> side{};  // m, of the box; 0 where it is not periodic
  std::string where;             // "path: step 5: ", for messages
};

// Throws InputError for a tilted box that is periodic.
Periodicity periodicity_of(const DumpFrame &frame);

struct ClosePair {
  std::uint32_t i, j;  // indices into the rods, i < j
  double s, t;  // where on the axes they touch, signed distance from the centres of i and j (m)
  double gap;   // distance of the surfaces, negative if they overlap (m)
  Vec3 normal;  // unit, from j to i; zero if the axes cross
  double sin_gamma;  // of the angle between the axes
};

// s and t are the closest points, of nearly parallel rods those of spread_contact (core), which
// puts the contact of rods side by side into the middle of their common length; it is asked with
// rods thicker by half of `contact_gap`, which is `largest_gap` unless given.
//
// All pairs with a gap below `largest_gap` (m), each once, in an order that depends on the rods
// only. A rod and several images of another are as many pairs.
//
// The search is that of the plug-in, NearPairs (core), on blocks of some thousand rods beside each
// other, each with the rods of other blocks that may be near its own. Time grows with the total
// length of the rods, and so does what memory a block takes.
//
// Throws InputError if a periodic side is shorter than a rod and the gap are in that direction: the
// rod would meet its own image.
std::vector<ClosePair> close_pairs(const std::vector<Rod> &rods, const Periodicity &box,
                                   double largest_gap,
                                   std::optional<double> contact_gap = std::nullopt);

}  // namespace spherocylinder
