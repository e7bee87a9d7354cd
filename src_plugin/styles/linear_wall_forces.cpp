// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear_wall_forces.h"

#include <algorithm>

#include "atom.h"
#include "fix_wall_gran.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

constexpr Vec3 kZero = {0.0, 0.0, 0.0};
constexpr int kSpring = 3;  // values of an end's history

}  // namespace

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

void LAMMPS_NS::check_not_at_outside(LAMMPS *lmp, const FixWallGran &fix,
                                     const WallSurface &surface, int i)
{
  const Atom &atom = *lmp->atom;
  if (surface.gap_of_sphere(load(atom.x[i]), atom.radius[i]) > 0.0) return;
  rod_error_one(lmp,
                "Fix wall/gran (id %s): rod %d is outside the cylinder at step " BIGINT_FORMAT
                "; rods know planes and the inside of cylinders only",
                fix.id, atom.tag[i], lmp->update->ntimestep);
}

// A wall is rod j of the batch: at rest but for its surface, and of infinite mass; its spring does
// not turn about the normal. What is zero stays so from the start.
LinearWallForces::LinearWallForces(LAMMPS *lmp) : Pointers(lmp) {}

void LinearWallForces::add(int i, int wall_type, const Capsule &rod, const InverseInertia &inverse,
                           const Vec3 &arm, const EndContact &contact, double coupling,
                           const Vec3 &wall_velocity, double *spring)
{
  LinearContacts &c = contacts_;
  const int k = count_++;
  ends_[k] = {i, spring};
  c.axis_i.set(k, arm);
  c.s[k] = 1.0;
  c.velocity_i.set(k, load(atom->v[i]));
  c.velocity_j.set(k, wall_velocity);
  c.omega_i.set(k, load(atom->omega[i]));
  c.inverse_mass_i[k] = inverse.mass;
  c.inverse_inertia_i[k] = inverse.transverse;
  c.radius_i[k] = rod.radius;
  c.normal.set(k, contact.normal);
  c.distance[k] = contact.distance;
  c.overlap[k] = rod.radius - contact.distance;
  c.share[k] = 1.0;
  if (coupling != 0.0) {
    const double alone = inverse_effective_mass(inverse, arm, contact.normal);
    c.share[k] = alone / (alone + coupling);
  }
  c.spring.set(k, spring ? load(spring) : kZero);
  c.side.set(k, kZero);
  values_.set(c, k, atom->type[i], wall_type, values_.aspect_scaling ? rod.aspect_ratio() : 1.0);
}

void LinearWallForces::finish_batch(ContactMonitor &monitor)
{
  LinearContacts &c = contacts_;
  linear_contacts(c, values_.law);
  for (int k = 0; k < count_; k++) {
    const auto [i, spring] = ends_[k];
    if (spring) store(c.spring.get(k), spring);
    monitor.look(i, -1, c.stiffness[k], c.effective_mass[k], c.overlap[k],
                 2.0 * c.radius_i[k]);
    add_to(atom->f[i], c.force.get(k));
    add_to(atom->torque[i], c.torque_i.get(k));
  }
  count_ = 0;
}

void LinearWallForces::compute(FixWallGran &fix, const MovingWall &wall,
                               const std::vector<int> &rods, double **history,
                               ContactMonitor &monitor)
{
  const auto &style = static_cast<const AtomVecSpherocylinder &>(*atom->avec);
  const int wall_type = fix.atom_type_wall();
  values_.law.dt = update->dt;  // a fix may change it during a run
  const double turning = values_.effective_mass ? 1.0 : 0.0;  // that damping knows of

  for (const int i : rods) {
    const Capsule rod = style.capsule(i);
    if (wall.surface.is_outside(rod.segment.centre)) {
      check_not_at_outside(lmp, fix, wall.surface, i);
      continue;
    }
    const RodEnds ends = wall.surface.ends_of(rod);
    if (!ends.touch(rod.radius)) {
      if (history) std::fill_n(history[i], kSpring * ends.count, 0.0);
      continue;
    }
    const InverseInertia inverse = {1.0 / atom->rmass[i], turning / atom->inertia[i][0]};
    const double coupling = turning * coupling_of_ends(ends, rod.radius, inverse);
    for (int end = 0; end < ends.count; end++) {
      const EndContact &contact = ends.contacts[end];
      double *spring = history ? history[i] + kSpring * end : nullptr;
      if (contact.distance > rod.radius) {
        if (spring) store(kZero, spring);
        continue;
      }
      add(i, wall_type, rod, inverse, ends.arms[end], contact, coupling,
          wall.velocity_at(contact, rod.segment.centre + ends.arms[end]), spring);
      if (count_ == kBatch) finish_batch(monitor);
    }
  }
  if (count_ > 0) finish_batch(monitor);
}
