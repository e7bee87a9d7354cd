// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_BUOYANCY_SPHEROCYLINDER_H
#define LMP_FIX_BUOYANCY_SPHEROCYLINDER_H

#include "core/vec3.h"
#include "fix_buoyancy.h"

namespace LAMMPS_NS {

// fix buoyancy of decks with rods: the weight of the fluid that the rod itself displaces, not its
// bounding sphere, acting at the centre of the displaced volume.
//
// The style name is LIGGGHTS's; the loader creates this class for rods.
class FixBuoyancySpherocylinder : public FixBuoyancy {
 public:
  FixBuoyancySpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void post_force(int vflag) override;
  double compute_vector(int n) override;

 private:
  double density_ = 0.0, level_ = 0.0;  // of the fluid and of its surface
  int along_ = 2;                       // the surface's normal: x, y or z
  spherocylinder::Vec3 local_force_{0.0, 0.0, 0.0}, force_{0.0, 0.0, 0.0};
  bool is_summed_ = false;

  spherocylinder::Vec3 gravity();
  void add_lift(int i, const spherocylinder::Vec3 &arm, const spherocylinder::Vec3 &lift);
};

}  // namespace LAMMPS_NS

#endif
