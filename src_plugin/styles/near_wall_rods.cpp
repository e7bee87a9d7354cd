// SPDX-License-Identifier: GPL-2.0-or-later
#include "near_wall_rods.h"

#include <algorithm>

#include "atom.h"
#include "atom_vec_spherocylinder.h"
#include "core/largest_components.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Skin in diameters of the thickest rod at hand. A wider one is renewed less often and holds more
// rods: in the settled bed of aspect ratio 30 half as many again as touch.
constexpr double kSkinInDiameters = 0.5;

const AtomVecSpherocylinder &style_of(const Atom &atom)
{
  return static_cast<const AtomVecSpherocylinder &>(*atom.avec);
}

}  // namespace

// A bound on the speed of any rod's end towards the wall: that of the centre in these directions
// and h |omega|. Contacts see the velocity that has just moved the rods, so that times the time
// step it bounds their way.
double NearWallRods::fastest_end(const WallSurface &surface) const
{
  const int rods = atom->nlocal;
  if (rods == 0) return 0.0;
  return surface.size_across(largest_components(atom->v[0], rods)) +
         longest_ * norm(largest_components(atom->omega[0], rods));
}

bool NearWallRods::is_near(const WallSurface &surface, int i) const
{
  const Capsule rod = style_of(*atom).capsule(i);
  if (surface.gap_of_sphere(rod.segment.centre, atom->radius[i]) > skin_) return false;
  const RodEnds ends = surface.ends_of(rod);
  return ends.count == 0 || ends.touch(rod.radius + skin_);
}

bool NearWallRods::renew(const WallSurface &surface, const int *candidates, int count,
                         int groupbit)
{
  if (known_) {
    if (count == 0) return false;
    travelled_ += update->dt * fastest_end(surface);
    if (travelled_ <= 0.5 * skin_) return false;
  }

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
  travelled_ = 0.0;
  known_ = true;
  return true;
}
