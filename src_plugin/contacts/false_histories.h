// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "lists/touching_rod_pairs.h"
#include "pointers.h"

namespace LAMMPS_NS {

// Drops contact histories that are not those of the pair that has them: where the rods' closest points
// are elsewhere than they were when the history was kept. It is then another rod's, or a rod has been
// put elsewhere since; its spring, and the side it remembers, would push the wrong way.
class FalseHistories : protected Pointers {
 public:
  explicit FalseHistories(LAMMPS *lmp) : Pointers(lmp) {}

  // To be called whenever histories come from elsewhere or a command may have moved rods: in the step
  // after LIGGGHTS has handed rods over, and in the first one of a run. `flags`, `histories`: rows of
  // LIGGGHTS's list, with dnum values a pair, the remembered side at side_offset.
  void drop(const TouchingRodPairs &touching, const std::vector<spherocylinder::Capsule> &rods,
            int **flags, double **histories, int dnum, int side_offset);

 private:
  bool warned_ = false;

  void warn(int i, int j);
};

}  // namespace LAMMPS_NS
