// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of whole fibres, from those of their segments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/fibres.h"
#include "measures/close_pairs.h"
#include "measures/contact_statistics.h"
#include "measures/mean_with_error.h"

namespace spherocylinder {

// Without the pairs that never touch, neighbours and those next but one across a short segment.
void leave_out_joints(const std::vector<Rod> &rods, const Fibres &fibres,
                      std::vector<ClosePair> &pairs);

// Of a rod that touches two neighbours one contact is left out if it lies on the hemisphere they
// share, which is no surface where the neighbour's cylinder covers it: the other counts. If both
// lie there, the first counts. So a fibre in line has the contacts of one long rod, but of a rod
// beside it that is nearly parallel: that touches each segment that it lies along.
void leave_out_doubles(const std::vector<Rod> &rods, const Fibres &fibres,
                       std::vector<ClosePair> &pairs);

// At walls a shared end counts once, for the segment whose tail it is.
void leave_out_doubles(const Fibres &fibres, std::vector<WallContact> &walls);

struct FibreContacts {
  std::size_t between;                  // contacts of two fibres; rods of their own are fibres too
  std::size_t with_itself;              // of two segments of one fibre
  MeanWithError per_fibre, with_walls;  // contacts of a fibre with others, and at walls too
  MeanWithError touched;                // other fibres that a fibre touches
};

// `body`: number of the fibre of each rod, below `bodies`. Of contacts without doubles.
FibreContacts fibre_contacts(const std::vector<std::uint32_t> &body, std::size_t bodies,
                             const std::vector<ClosePair> &pairs,
                             const std::vector<WallContact> &walls);

}  // namespace spherocylinder
