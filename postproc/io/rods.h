// SPDX-License-Identifier: GPL-2.0-or-later
// The rods of a dump frame as geometry. Space frame, metres.
#pragma once

#include <cstdint>
#include <vector>

#include "core/capsule.h"
#include "io/dump_frame.h"

namespace spherocylinder {

struct Rod {
  std::int64_t id;
  int type;  // 1 if the dump has no column `type`
  Capsule capsule;

  bool is_sphere() const { return capsule.segment.half_length == 0.0; }  // then it has no axis
};

// Dumps print about six digits, so that a unit quaternion comes back with a norm up to 1e-5 away
// from 1; what is further away than this was never a unit quaternion.
constexpr double kQuaternionNormTolerance = 1e-3;

// Relative; six printed digits of two lengths that were equal.
constexpr double kLengthRounding = 2e-5;

// Rods in the order of the frame's rows. Reads id, x y z (or xu yu zu, or xs ys zs or xsu ysu zsu
// scaled by the box), shapex (radius), shapez (half the total length) and quat1..4 (w, x, y, z; the
// axis is body z turned by it, renormalised). shapez within rounding of shapex is a sphere. Throws
// InputError with the line for a missing column or a row that is no rod.
std::vector<Rod> rods_of(const DumpFrame &frame);

double largest_diameter(const std::vector<Rod> &rods);  // m; 0 for none

// How far each rod's surface can be off because the dump's places and quaternions are rounded (m),
// where it has a contact: the gap of two rods is off by up to the sum of both. The numbers have six
// digits (LIGGGHTS leaves out zeros at the end), or as many as any of the places, or of the
// quaternions, has in the first thousand rows. A coordinate is off by half a unit in its last
// digit, d_x, so that the centre is by up to sqrt(3) d_x; a quaternion's component by d_q, the axis
// by an angle of up to 4 d_q. Radii and lengths, of which a dump holds few different ones, are left
// out.
std::vector<double> place_roundings(const DumpFrame &frame, const std::vector<Rod> &rods);

}  // namespace spherocylinder
