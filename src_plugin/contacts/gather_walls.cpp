// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/gather_walls.h"

#include <algorithm>

#include "atom.h"
#include "contacts/rod_kinds.h"
#include "fix_wall_gran.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

double LAMMPS_NS::coupling_of_ends(const RodEnds &ends, double radius,
                                   const InverseInertia &inverse)
{
  if (ends.count < 2) return 0.0;
  const EndContact &one = ends.contacts[0], &other = ends.contacts[1];
  const double a = radius - one.distance, b = radius - other.distance;
  if (!(a > 0.0) || !(b > 0.0)) return 0.0;
  const double cosine = std::max(0.0, dot(one.normal, other.normal));
  const double shared = std::min(a, b) / std::max(a, b) * cosine;
  if (shared == 0.0) return 0.0;
  return shared * mass_coupling(inverse, ends.arms[0], one.normal, ends.arms[1], other.normal);
}

void WallGatherer::begin(const FixWallGran &fix, bool effective_mass, bool types_are_kinds)
{
  types_are_kinds_ = types_are_kinds;
  fix_ = &fix;
  wall_type_ = fix.atom_type_wall();
  turning_ = effective_mass ? 1.0 : 0.0;
}

Capsule WallGatherer::capsule(int i) const
{
  return static_cast<const AtomVecSpherocylinder &>(*atom->avec).capsule(i);
}

WallGatherer::Inertia WallGatherer::inertia_of(const RodEnds &ends, double radius, int i) const
{
  const InverseInertia inverse = {1.0 / atom->rmass[i], turning_ / atom->inertia[i][0]};
  return {inverse, turning_ * coupling_of_ends(ends, radius, inverse)};
}

void WallGatherer::add_end(ContactBatch &batch, const MovingWall &wall, int i, int end,
                           const Capsule &rod, const RodEnds &ends, const Inertia &inertia,
                           double *history) const
{
  const Vec3 &arm = ends.arms[end];
  const EndContact &contact = ends.contacts[end];
  ContactArms &arms = batch.arms;
  const int k = batch.count++;
  batch.i[k] = i;
  batch.j[k] = -1;
  batch.type_i[k] = atom->type[i];
  batch.type_j[k] = wall_type_;
  batch.kind[k] = types_are_kinds_ ? atom->type[i] : RodKinds::kNone;
  batch.end[k] = end;
  batch.flags[k] = nullptr;
  batch.history[k] = history;
  arms.arm_i.set(k, arm);
  arms.velocity_i.set(k, load(atom->v[i]));
  arms.velocity_j.set(k, wall.velocity_at(contact, rod.segment.centre + arm));
  arms.omega_i.set(k, load(atom->omega[i]));
  arms.inverse_mass_i[k] = inertia.inverse.mass;
  arms.inverse_inertia_i[k] = inertia.inverse.transverse;
  arms.radius_i[k] = rod.radius;
  arms.normal.set(k, contact.normal);
  arms.distance[k] = contact.distance;
  arms.overlap[k] = rod.radius - contact.distance;
  arms.mass_share[k] = 1.0;
  if (inertia.coupling != 0.0) {
    const double alone = inverse_effective_mass(inertia.inverse, arm, contact.normal);
    arms.mass_share[k] = alone / (alone + inertia.coupling);
  }
  arms.side.set(k, kZero);
}

void WallGatherer::check_not_at_outside(const WallSurface &surface, int i) const
{
  if (surface.gap_of_sphere(load(atom->x[i]), atom->radius[i]) > 0.0) return;
  rod_error_one(lmp,
                "Fix wall/gran (id %s): rod %d is outside the cylinder at step " BIGINT_FORMAT
                "; rods know planes and the inside of cylinders only",
                fix_->id, atom->tag[i], update->ntimestep);
}
