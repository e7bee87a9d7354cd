// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_WALL_GRAN_SPHEROCYLINDER_H
#define LMP_FIX_WALL_GRAN_SPHEROCYLINDER_H

#include "fix_wall_gran.h"
#include "near_wall_rods.h"
#include "rod_wall.h"

namespace LAMMPS_NS {

// fix wall/gran of decks with rods: LIGGGHTS's own, but for its loop over all rods whose bounding
// spheres reach the wall. Of long rods few of them have an end there, and only those are looked at.
//
// The style name is LIGGGHTS's; the loader creates this class for rods and LIGGGHTS's own for
// everything else.
class FixWallGranSpherocylinder : public FixWallGran {
 public:
  FixWallGranSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void init() override;

 protected:
  void pre_force(int vflag) override;
  void post_force_primitive(int vflag) override;

 private:
  RodWall *rod_wall_ = nullptr;  // null without surface spherocylinder: no rods are run then
  MovingWall wall_{};
  NearWallRods near_rods_;

  MovingWall moving_wall() const;
  void forget_contacts_of_far_rods(double **history);
};

}  // namespace LAMMPS_NS

#endif
