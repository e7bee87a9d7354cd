// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/near_wall_rods.h"

#include <algorithm>

#include "atom.h"
#include "lists/rod_shifts.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Skin in diameters of the thickest rod at hand. A wider one is renewed less often and holds more
// rods: in the settled bed of aspect ratio 30 half as many again as touch.
constexpr double kSkinInDiameters = 0.5;
// Of the skin, what ends may come nearer before the list is made anew; the rest is for rounding.
constexpr double kUsedOfSkin = 0.99;

AtomVecSpherocylinder &style_of(const Atom &atom)
{
  return static_cast<AtomVecSpherocylinder &>(*atom.avec);
}

}  // namespace

bool NearWallRods::is_near(const WallSurface &surface, int i) const
{
  const Capsule rod = style_of(*atom).capsule(i);
  if (surface.gap_of_sphere(rod.segment.centre, atom->radius[i]) > skin_) return false;
  if (surface.is_outside(rod.segment.centre))
    return std::sqrt(surface.closest_at_outside(rod.segment).distance_squared) <=
           surface.radius + rod.radius + skin_;
  const RodEnds ends = surface.ends_of(rod);
  return ends.count == 0 || ends.touch(rod.radius + skin_);
}

bool NearWallRods::renew(const WallSurface &surface, const int *candidates, int count, int groupbit)
{
  RodShifts &shifts = style_of(*atom).attached<RodShifts>();
  if (known_ && version_ == shifts.version()) {
    if (count == 0) return false;
    const double nearer = shifts.farthest(longest_) + norm(surface.point - surface_point_) +
                          std::fabs(surface.radius - surface_radius_);
    if (nearer <= kUsedOfSkin * skin_) return false;
  }
  shifts.keep_poses();
  version_ = shifts.version();
  surface_point_ = surface.point;
  surface_radius_ = surface.radius;

  double thickest = 0.0;
  longest_ = 0.0;
  for (int k = 0; k < count; k++) {
    const double *shape = atom->shape[candidates[k]];
    thickest = std::max(thickest, 2.0 * shape[0]);
    longest_ = std::max(longest_, shape[2] - shape[0]);
  }
  skin_ = kSkinInDiameters * thickest;
  near_.clear();
  far_.clear();
  for (int k = 0; k < count; k++) {
    const int i = candidates[k];
    if (!(atom->mask[i] & groupbit)) continue;
    (is_near(surface, i) ? near_ : far_).push_back(i);
  }
  known_ = true;
  return true;
}
