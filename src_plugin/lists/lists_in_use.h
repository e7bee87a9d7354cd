// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {

class CloseRodPairs;
class LAMMPS;
struct RodPairCounts;
class TouchingRodPairs;

// Of the pair style's lists what others read; null without a pair style. Attached to the rods.
struct ListsInUse {
  explicit ListsInUse(LAMMPS *) {}

  const RodPairCounts *counts = nullptr;
  const CloseRodPairs *close_pairs = nullptr;
  const TouchingRodPairs *touching_pairs = nullptr;  // when the forces were last computed
};

}  // namespace LAMMPS_NS
