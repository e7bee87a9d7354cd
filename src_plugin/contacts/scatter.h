// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "contacts/contact_batch.h"

namespace LAMMPS_NS {

class Atom;
class PairGran;

// Forces and torques of a batch to the rods: to both of a pair where this rank owns them, relaxed as
// LIGGGHTS's pair style has it; to the rod of a wall.
void scatter_pairs(const ContactBatch &batch, PairGran &pair, Atom &atom);
void scatter_walls(const ContactBatch &batch, Atom &atom);

// Loads of the pairs of one thread, kept until all threads have worked out theirs. Then each thread adds
// those on its own rods, first those of the pairs of threads before it: so every rod gets its loads in the
// order of the list, as from scatter_pairs. (Of two rods of this rank i is the lower, see RodPairList: no
// thread adds to a rod of one before it.)
class PairLoads {
 public:
  void clear()
  {
    loads_.clear();
    beyond_.clear();
  }
  // `next_rod`: the first that is of the next thread.
  void keep(const ContactBatch &batch, int next_rod, int owned);
  void add_to_own(PairGran &pair, Atom &atom, int next_rod) const;
  // To rods of another thread, from `first_rod` on, below `next_rod`.
  void add_to_later(PairGran &pair, Atom &atom, int first_rod, int next_rod) const;

 private:
  struct Load {
    int i, j;
    spherocylinder::Vec3 force, torque_i, torque_j;
  };
  std::vector<Load> loads_;
  std::vector<int> beyond_;  // loads whose j is of another thread of this rank
};

}  // namespace LAMMPS_NS
