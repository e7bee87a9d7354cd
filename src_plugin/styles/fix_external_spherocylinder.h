// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_EXTERNAL_SPHEROCYLINDER_H
#define LMP_FIX_EXTERNAL_SPHEROCYLINDER_H

#include "fix_external.h"

namespace LAMMPS_NS {

// fix external of decks with rods: as LIGGGHTS's, with forces that are 0 until the calling program
// gives them. (LIGGGHTS adds what happens to be in the memory, to rods that come in later too.)
//
// The style name is LIGGGHTS's; the loader creates this class for rods.
class FixExternalSpherocylinder : public FixExternal {
 public:
  FixExternalSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void grow_arrays(int nmax) override;
  void set_arrays(int i) override;

 private:
  int rows_;  // of fexternal
};

}  // namespace LAMMPS_NS

#endif
