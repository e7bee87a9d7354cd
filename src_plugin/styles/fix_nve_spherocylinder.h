// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(nve/spherocylinder, FixNVESpherocylinder)

#else

#ifndef LMP_FIX_NVE_SPHEROCYLINDER_H
#define LMP_FIX_NVE_SPHEROCYLINDER_H

#include "fix_nve.h"

namespace LAMMPS_NS {

// Velocity-Verlet translation, and rotation as half kick of the angular momentum, exact free
// rotation of a symmetric top, half kick.
class FixNVESpherocylinder : public FixNVE {
 public:
  FixNVESpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void final_integrate() override;
};

}  // namespace LAMMPS_NS

#endif
#endif
