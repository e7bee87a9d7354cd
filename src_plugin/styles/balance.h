// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMMAND_CLASS

CommandStyle(balance, Balance)

#else

#ifndef LMP_BALANCE_H
#define LMP_BALANCE_H

#include "pointers.h"

namespace LAMMPS_NS {

class ClosePairCounts;

// Moves the cuts between the ranks' subdomains once, between two runs, and hands the rods over.
class Balance : protected Pointers {
 public:
  explicit Balance(LAMMPS *lmp) : Pointers(lmp) {}
  void command(int narg, char **arg);

 private:
  void begin(ClosePairCounts &counts);
};

}  // namespace LAMMPS_NS

#endif
#endif
