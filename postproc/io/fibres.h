// SPDX-License-Identifier: GPL-2.0-or-later
// Which rods of a frame are segments of a fibre: chains whose neighbours share the centre of a
// hemisphere (docs/fix_joint_spherocylinder.md). Space frame, metres.
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

// Joints give way by some percent of a diameter at most; rods that are not joined keep each other
// about a diameter away from a shared end.
constexpr double kMeetDefault = 0.1;

struct FibreOptions {
  // Of fibre and place; none: those of fix joint, if they are there.
  std::vector<std::string> columns;
  double meet = kMeetDefault;  // diameters that ends which are joined may be apart
};

// The head of i, its end along the axis, and the tail of j.
struct FibreJoint {
  std::uint32_t i, j;  // indices into the rods
  Vec3 place;          // midway between the two ends, beside i
  Vec3 shift;          // to be added to j's centre: the image of j that is beside i
};

struct Fibre {
  std::int64_t id;
  std::vector<std::uint32_t> segments;  // indices into the rods, in the order of the chain
  std::vector<Vec3> shifts;  // to be added to their centres, so that the fibre hangs together
  bool is_ring = false;      // its last head is joined to its first tail
};

constexpr std::uint32_t kNoFibre = UINT32_MAX;
constexpr std::int32_t kNoJoint = -1;

struct Fibres {
  std::vector<Fibre> all;
  std::vector<FibreJoint> joints;
  std::vector<std::uint32_t> of_rod;        // kNoFibre: a rod of its own; empty without columns
  std::vector<std::uint32_t> place_of_rod;  // in the chain, from 0
  std::vector<std::array<std::int32_t, 2>> joints_of_rod;  // at tail and head, or kNoJoint
  std::size_t parts = 0;  // of all, those that share their id with another

  bool are_there() const { return !of_rod.empty(); }

  // Whether the fix lets them touch never: neighbours, and next but one if the segment between is
  // shorter than the diameter.
  bool never_touch(std::uint32_t i, std::uint32_t j, const std::vector<Rod> &rods) const;
};

// Fibres by their ids, cut wherever a place lacks or ends do not meet, and where fix joint's column
// f_fibres[3], if it is there, says that a head is free: the parts count as fibres.
// Without the columns there are none. Throws InputError for a named column that is missing, one
// column without the other, ids, places and ends that are no whole numbers, two rods at one place,
// segments of unlike radii and a tilted box that is periodic.
Fibres fibres_of(const DumpFrame &frame, const std::vector<Rod> &rods, const FibreOptions &options);

// Those of some of the rods, by the places of these in `kept`, cut where segments are left out.
Fibres fibres_among(const Fibres &fibres, const std::vector<std::size_t> &kept);

// For programs that know rods only. Throws InputError, headed by the file's name, if the frame has
// rods in fibres.
void need_no_fibres(const DumpFrame &frame, const std::vector<Rod> &rods,
                    const FibreOptions &options, const std::string &why);

Vec3 tail_of(const Segment &segment);
Vec3 head_of(const Segment &segment);

}  // namespace spherocylinder
