// SPDX-License-Identifier: GPL-2.0-or-later
// Per-rod arrays: which of LIGGGHTS's they are, how wide, and where their values go.
#pragma once

#include <array>
#include <type_traits>
#include <variant>

#include "atom.h"

namespace LAMMPS_NS {

// Where the values of a field go. All but forces move with a rod to another place in memory.
enum Travel : unsigned {
  kForward = 1,          // to ghosts, each step
  kForwardVelocity = 2,  // the same, where ghosts have velocities
  kReverse = 4,          // from ghosts to their owners, added
  kBorder = 8,           // to new ghosts
  kBorderVelocity = 16,
  kWhole = 32,  // with the rod to another rank and to a restart file

  // Of these, what a ghost's gain across a periodic boundary:
  kGainsPeriod = 64,     // the period
  kGainsBoxSpeed = 128,  // the speed at which a box that shears parts from its image
  kStays = 256,          // follows from the others, or is a constant
};

struct RodField {
  using WholeNumbers = int *Atom::*;
  using Numbers = double *Atom::*;
  using Rows = double **Atom::*;

  const char *name;
  std::variant<WholeNumbers, Numbers, Rows> array;
  int width;         // of a row
  unsigned travel;   // Travel
  int sent = width;  // values of a row that travel, its first
};

static_assert(std::is_same_v<tagint, int>, "images are handled as int");

// x must come first of a whole rod: read_restart looks for it there. Size and density travel; mass,
// volume, area and inertia are worked out again at the other side, to the same bits.
inline const std::array<RodField, 20> &rod_fields()
{
  constexpr unsigned kVelocity = kForwardVelocity | kBorderVelocity;
  static const std::array<RodField, 20> fields = {{
      {"x", &Atom::x, 3, kForward | kBorder | kWhole | kGainsPeriod},
      {"tag", &Atom::tag, 1, kBorder | kWhole},
      {"type", &Atom::type, 1, kBorder | kWhole},
      {"mask", &Atom::mask, 1, kBorder | kWhole},
      {"image", &Atom::image, 1, kWhole},
      {"v", &Atom::v, 3, kVelocity | kWhole | kGainsBoxSpeed},
      {"shape", &Atom::shape, 3, kBorder | kWhole, 1},
      {"radius", &Atom::radius, 1, kBorder | kWhole},
      {"density", &Atom::density, 1, kBorder | kWhole},
      {"quaternion", &Atom::quaternion, 4, kForward | kBorder | kWhole},
      {"omega", &Atom::omega, 3, kVelocity | kWhole},
      {"angmom", &Atom::angmom, 3, kWhole},
      {"f", &Atom::f, 3, kReverse},
      {"torque", &Atom::torque, 3, kReverse},
      {"rmass", &Atom::rmass, 1, kStays},
      {"volume", &Atom::volume, 1, kStays},
      {"area", &Atom::area, 1, kStays},
      {"inertia", &Atom::inertia, 3, kStays},
      {"blockiness", &Atom::blockiness, 2, kStays},
      {"vfrac", &Atom::vfrac, 1, kStays},
  }};
  return fields;
}

// Numbers of a rod that travel so.
inline int rod_field_size(unsigned travel)
{
  int size = 0;
  for (const RodField &field : rod_fields())
    if (field.travel & travel) size += field.sent;
  return size;
}

}  // namespace LAMMPS_NS
