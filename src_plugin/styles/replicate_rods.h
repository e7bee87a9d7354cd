// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_REPLICATE_RODS_H
#define LMP_REPLICATE_RODS_H

#include <vector>

#include "replicate.h"
#include "styles/fibre_chains.h"

namespace LAMMPS_NS {

// Command replicate of decks with rods: LIGGGHTS's own, which gives the same id to rods of several
// ranks, and to a copy the contacts of its original. Here each copy's ids go on from the highest one
// before, on any number of ranks, and the copies of two rods that touch keep a contact of their own. So with
// fibres: each copy is whole and has an id of its own, also where it lies across a periodic boundary.
//
// The name of the command is LIGGGHTS's; the loader runs this class for rods.
class ReplicateRods : protected Replicate {
 public:
  explicit ReplicateRods(LAMMPS *lmp) : Replicate(lmp) {}
  void command(int narg, char **arg);

 private:
  int highest_id() const;
  void number_copies(const std::vector<int> &ids, int highest);
  int highest_fibre() const;
  std::vector<FibreChains::Periods> periods_of_fibres(const int *grid, int narg, char **arg) const;
  void number_fibres(const std::vector<FibreChains::Periods> &periods, const int *grid,
                     int highest);
};

}  // namespace LAMMPS_NS

#endif
