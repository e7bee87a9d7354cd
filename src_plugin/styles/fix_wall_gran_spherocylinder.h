// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_WALL_GRAN_SPHEROCYLINDER_H
#define LMP_FIX_WALL_GRAN_SPHEROCYLINDER_H

#include "fix_wall_gran.h"
#include "lists/near_wall_rods.h"
#include "styles/wall_arguments.h"
#include "walls/rod_wall.h"

namespace LAMMPS_NS {

// fix wall/gran of decks with rods: LIGGGHTS's own, but for its loop over all rods whose bounding
// spheres reach the wall. Of long rods few of them have an end there, and only those are looked at.
// A plane may move along its normal by a variable, or turn about it.
//
// The style name is LIGGGHTS's; the loader creates this class for rods and LIGGGHTS's own for
// everything else.
class FixWallGranSpherocylinder : public FixWallGran {
 public:
  FixWallGranSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void init() override;
  // Where a plane with a variable is, and how fast: the first forces of a continued run want its speed.
  void write_restart(FILE *file) override;
  void restart(char *state) override;

  // The group's rods begin their contacts with a primitive wall anew. Returns how many had one.
  int forget_contacts(int groupbit_of_rods);

 protected:
  void pre_neighbor() override;
  void pre_force(int vflag) override;
  void post_force_primitive(int vflag) override;

 private:
  RodWall *rod_wall_ = nullptr;  // null without surface spherocylinder: no rods are run then
  MovingWall wall_{};
  NearWallRods near_rods_;
  WallArguments arguments_;

  // Of a plane whose position is a variable.
  int variable_ = -1;
  double position_ = 0.0;         // m
  double speed_ = 0.0;            // along the axis, over the last step (m/s)
  bigint position_step_ = -2;     // of position_, -2: none yet
  double listed_position_ = 0.0;  // when LIGGGHTS's list was made (m)
  double thinnest_ = 0.0;         // radius of a rod of this rank (m)

  FixWallGranSpherocylinder(LAMMPS *lmp, WallArguments arguments);
  bool has_variable() const { return !arguments_.position_variable.empty(); }
  void find_variable();
  void move_plane();
  void look_at_rods();
  MovingWall moving_wall() const;
  void check_shear() const;
  void check_cylinder_is_wide_enough() const;
  void check_no_image_is_missed() const;
  void forget_contacts_of_far_rods(double **history);
};

}  // namespace LAMMPS_NS

#endif
