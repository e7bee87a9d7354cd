// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_gran_spherocylinder.h"

#include <algorithm>

#include "atom.h"
#include "fix_property_atom.h"
#include "primitive_wall.h"

using namespace LAMMPS_NS;
using spherocylinder::Vec3;

FixWallGranSpherocylinder::FixWallGranSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixWallGran(lmp, narg, arg), near_rods_(lmp)
{
}

void FixWallGranSpherocylinder::init()
{
  FixWallGran::init();
  rod_wall_ = dynamic_cast<RodWall *>(impl);
  if (primitiveWall_) wall_ = moving_wall();
  near_rods_.forget();
}

// LIGGGHTS gives `shear` along the cylinder's axis as a velocity, across it as a rate about the
// axis.
MovingWall FixWallGranSpherocylinder::moving_wall() const
{
  MovingWall wall{surface_of(*primitiveWall_), {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  if (!shear_) return wall;
  if (wall.surface.is_cylinder && shearAxis_ >= 0) {
    wall.turning = spherocylinder::load(shearAxisVec_);
  } else {
    double sliding[3] = {0.0, 0.0, 0.0};
    sliding[shearDim_] = vshear_;
    wall.sliding = spherocylinder::load(sliding);
  }
  return wall;
}

void FixWallGranSpherocylinder::pre_force(int vflag)
{
  if (rebuildPrimitiveNeighlist_) near_rods_.forget();
  FixWallGran::pre_force(vflag);
}

void FixWallGranSpherocylinder::post_force_primitive(int vflag)
{
  if (!rod_wall_) {
    FixWallGran::post_force_primitive(vflag);
    return;
  }
  double **history = dnum() > 0 ? fix_history_primitive_->array_atom : nullptr;
  int *candidates = nullptr;
  const int count = primitiveWall_->getNeighbors(candidates);
  if (near_rods_.renew(wall_.surface, candidates, count, groupbit) && history)
    forget_contacts_of_far_rods(history);
  rod_wall_->compute_forces(*this, wall_, near_rods_.near(), history);
}

// As LIGGGHTS does: the models forget the contact of a rod within its bounding sphere's reach; of
// one beyond it nothing is left.
void FixWallGranSpherocylinder::forget_contacts_of_far_rods(double **history)
{
  for (const int i : near_rods_.far()) {
    const bool beyond =
        wall_.surface.gap_of_sphere(spherocylinder::load(atom->x[i]), atom->radius[i]) > 0.0;
    if (beyond)
      std::fill_n(history[i], dnum(), 0.0);
    else
      rod_wall_->part(i, history[i]);
  }
}
