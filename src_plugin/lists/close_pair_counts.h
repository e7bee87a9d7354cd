// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pointers.h"

namespace LAMMPS_NS {

// How many close pairs each rod is in, as it was when last counted; the number goes with the rod from rank
// to rank, in a fix property/atom of its own. 0 for a rod that is new since.
class ClosePairCounts : protected Pointers {
 public:
  // `of`: whose counts they are, part of the property's id.
  ClosePairCounts(LAMMPS *lmp, const std::string &of);

  // Makes the property, and takes it away.
  void begin();
  void end();

  // Counts within a run, in which ids stay. Before the first step of one there is nothing to count.
  void count();
  // Before a run: counts if the lists of the run before are of this rank's rods, in the same places;
  // else false.
  bool count_if_rods_stay();

  // By rod of this rank: as last counted, and as they are if the lists are of these rods.
  std::vector<int> counted() const;
  std::vector<int> now() const;

 private:
  std::string id_;

  double *numbers() const;
};

}  // namespace LAMMPS_NS
