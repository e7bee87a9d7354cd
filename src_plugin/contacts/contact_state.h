// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {

class LAMMPS;
class SuddenOverlaps;

// What all pair and wall contacts of a simulation share. Attached to the rods.
struct ContactState {
  explicit ContactState(LAMMPS *) {}

  // Largest overlap of any contact, walls included, over the (mean) diameter of its rods, since the
  // run began; this rank's contacts.
  double largest_overlap = 0.0;

  SuddenOverlaps *sudden_overlaps = nullptr;  // of the pair style, null without one
};

}  // namespace LAMMPS_NS
