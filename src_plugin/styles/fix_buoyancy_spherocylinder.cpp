// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_buoyancy_spherocylinder.h"

#include <cmath>
#include <cstring>

#include "atom.h"
#include "core/immersed_part.h"
#include "core/rotation.h"
#include "fix_gravity.h"
#include "force.h"
#include "host/rod_error.h"
#include "modify.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

// LIGGGHTS's constructor has checked the keywords and their numbers of values.
FixBuoyancySpherocylinder::FixBuoyancySpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixBuoyancy(lmp, narg, arg)
{
  rods_of(lmp, "Fix buoyancy");
  for (int k = 3; k + 1 < narg; k += 2) {
    if (strcmp(arg[k], "density") == 0) density_ = force->numeric(FLERR, arg[k + 1]);
    if (strcmp(arg[k], "level") == 0) level_ = force->numeric(FLERR, arg[k + 1]);
    if (strcmp(arg[k], "dim") == 0) along_ = arg[k + 1][0] - 'x';
  }
}

sc::Vec3 FixBuoyancySpherocylinder::gravity()
{
  double g[3];
  static_cast<FixGravity *>(modify->find_fix_style_strict("gravity", 0))->get_gravity(g);
  for (int d = 0; d < 3; d++)
    if (d != along_ && g[d] != 0.0)
      rod_error_all(lmp, "Fix buoyancy (id %s): gravity must be along dim %c (got %g %g %g)", id,
                    'x' + along_, g[0], g[1], g[2]);
  return sc::load(g);
}

// Of a segment of a fibre, the ball about a shared point is in both neighbours: half of it is taken off each.
void FixBuoyancySpherocylinder::post_force(int)
{
  const sc::Vec3 g = gravity();
  local_force_ = {0.0, 0.0, 0.0};
  is_summed_ = false;
  const double magnitude = sc::norm(g);
  if (magnitude == 0.0) return;
  const sc::Vec3 up = (-1.0 / magnitude) * g;
  const double surface = level_ * (&up.x)[along_];
  const auto &fibres = rods_of(lmp, "Fix buoyancy").attached<FibreSegments>();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *x = atom->x[i];
    if (region_ && !region_->match(x[0], x[1], x[2])) continue;
    const double *shape = atom->shape[i];
    const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
    const sc::Capsule rod = {{sc::load(x), axis, shape[2] - shape[0]}, shape[0]};
    const sc::ImmersedPart part = sc::immersed_part(rod, up, surface);
    add_lift(i, part.centroid, (-density_ * part.volume) * g);
    if (fibres.shared_ends(i) == 0) continue;
    for (const double side : {-1.0, 1.0}) {
      const int shared = side < 0.0 ? FibreSegments::kTailShared : FibreSegments::kHeadShared;
      if (!(fibres.ends(i) & shared)) continue;
      const sc::Vec3 end = (side * rod.segment.half_length) * axis;
      const sc::Capsule ball = {{rod.segment.centre + end, axis, 0.0}, rod.radius};
      const sc::ImmersedPart twice = sc::immersed_part(ball, up, surface);
      add_lift(i, end + twice.centroid, (0.5 * density_ * twice.volume) * g);
    }
  }
}

// At `arm` from the centre of rod i.
void FixBuoyancySpherocylinder::add_lift(int i, const sc::Vec3 &arm, const sc::Vec3 &lift)
{
  sc::add_to(atom->f[i], lift);
  sc::add_to(atom->torque[i], sc::cross(arm, lift));
  local_force_ = local_force_ + lift;
}

double FixBuoyancySpherocylinder::compute_vector(int n)
{
  if (!is_summed_) MPI_Allreduce(&local_force_.x, &force_.x, 3, MPI_DOUBLE, MPI_SUM, world);
  is_summed_ = true;
  return (&force_.x)[n];
}
