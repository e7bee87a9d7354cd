// SPDX-License-Identifier: GPL-2.0-or-later
// Fibres as smooth tubes. Space frame, metres.
#pragma once

#include <vector>

#include "core/vec3.h"
#include "io/fibres.h"

namespace spherocylinder {

// A circle of the tube: its centre, the tube's direction and one at right angles to that.
struct TubeRing {
  Vec3 centre, along, across;
};

// The part of a tube that a segment is.
struct TubePart {
  std::uint32_t rod, before, after;  // itself and its neighbours, or itself
  std::vector<TubeRing> rings;       // from tail to head, an odd number: the middle one half-way
  bool begins, ends;  // with a round end: where nothing is joined, or beyond a periodic boundary
};

// Through the joints runs a curve, cubic over each segment, whose direction at a joint is the mean of
// both axes; at a fibre's ends it has no curvature. It leaves the segments by an eighth of bend times
// length. Parts that follow each other have their rings at the joint in common; directions across are
// carried along without twist, but for a ring, over which what is left of a corner, of `corners`
// around, is spread.
std::vector<TubePart> tube_of(const Fibre &fibre, const Fibres &fibres,
                              const std::vector<Rod> &rods, int corners);

}  // namespace spherocylinder
