// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_MOVE_SPHEROCYLINDER_H
#define LMP_FIX_MOVE_SPHEROCYLINDER_H

#include "core/rotation.h"
#include "fix_move.h"
#include "rods/rod_driver.h"

namespace LAMMPS_NS {

// fix move of decks with rods: LIGGGHTS's own moves the centres, and the axes are turned here. Under
// `rotate` they turn with the centres; under the other styles, which prescribe no rotation, a rod
// keeps its angular velocity and its axis turns with it.
//
// The style name is LIGGGHTS's; the loader creates this class for rods.
class FixMoveSpherocylinder : public FixMove, public RodDriver {
 public:
  FixMoveSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void init() override;
  void initial_integrate(int vflag) override;
  void restart(char *state) override;

  bool drives_centres() const override { return drives_centres_; }

 private:
  bool is_rotation_, is_variable_, drives_centres_;
  spherocylinder::Vec3 direction_{0.0, 0.0, 1.0};  // of the rotation's axis, unit
  double rate_ = 0.0;                              // of the rotation (rad/s), with a sign
  bigint origin_;                                  // step at which the motion begins
  // The angle (rad) by which the axes have been turned since; not known before the first run.
  double angle_ = 0.0;
  bool angle_is_known_ = false;
  bool is_first_step_ = false;  // of a run

  double angle_now() const;
  void turn(int i, const spherocylinder::Quaternion &rotation);
  void check_first_step(int i, const double *before, double angle) const;
};

}  // namespace LAMMPS_NS

#endif
