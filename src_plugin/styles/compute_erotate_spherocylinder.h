// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(erotate/spherocylinder, ComputeErotateSpherocylinder)

#else

#ifndef LMP_COMPUTE_EROTATE_SPHEROCYLINDER_H
#define LMP_COMPUTE_EROTATE_SPHEROCYLINDER_H

#include "compute.h"

namespace LAMMPS_NS {

// Rotational kinetic energy of a group of rods, J.
class ComputeErotateSpherocylinder : public Compute {
 public:
  ComputeErotateSpherocylinder(LAMMPS *lmp, int &iarg, int narg, char **arg);
  void init() override;
  double compute_scalar() override;
};

}  // namespace LAMMPS_NS

#endif
#endif
