// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_FREEZE_SPHEROCYLINDER_H
#define LMP_FIX_FREEZE_SPHEROCYLINDER_H

#include "fix_freeze.h"

namespace LAMMPS_NS {

// fix freeze of decks with rods: as LIGGGHTS's, and frozen rods have no velocity and no angular
// velocity either, so that contacts see them at rest. What fix move drives keeps its motion.
//
// The style name is LIGGGHTS's; the loader creates this class for rods.
class FixFreezeSpherocylinder : public FixFreeze {
 public:
  FixFreezeSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void init() override;
  void post_force(int vflag) override;

 private:
  int driven_ = 0;  // groups that fix move drives

  void stop_rods();
};

}  // namespace LAMMPS_NS

#endif
