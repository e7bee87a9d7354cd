// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_REPLICATE_RODS_H
#define LMP_REPLICATE_RODS_H

#include <vector>

#include "replicate.h"

namespace LAMMPS_NS {

// Command replicate of decks with rods: LIGGGHTS's own, which gives the same id to rods of several
// ranks, and to a copy the contacts of its original. Here each copy's ids go on from the highest one
// before, on any number of ranks, and the copies of two rods that touch keep a contact of their own.
//
// The name of the command is LIGGGHTS's; the loader runs this class for rods.
class ReplicateRods : protected Replicate {
 public:
  explicit ReplicateRods(LAMMPS *lmp) : Replicate(lmp) {}
  void command(int narg, char **arg);

 private:
  int highest_id() const;
  void number_copies(const std::vector<int> &ids, int highest);
};

}  // namespace LAMMPS_NS

#endif
