// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/rate_collector.h"

#include "atom.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_driver.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

void RateCollector::start()
{
  const int rods = atom->nlocal + atom->nghost;
  squared_frequency_.assign(rods, 0.0);
  contacts_.assign(rods, 0);
  standing_groups_ = standing_groups(lmp);
}

void RateCollector::add(int i, double factor, const ContactBatch &batch, int k, const Vec3 &arm,
                        double depth, const Vec3 &normal)
{
  contacts_[i]++;
  if (atom->mask[i] & standing_groups_) return;
  const InverseInertia inverse = {1.0 / atom->rmass[i], 1.0 / atom->inertia[i][0]};
  const double inverse_axial = 1.0 / atom->inertia[i][2];
  const Vec3 axis = axis_of(load_quaternion(atom->quaternion[i]));
  const Vec3 contact_arm = arm - depth * normal;
  const Vec3 turn = cross(axis, contact_arm);
  const double about_normal = norm_squared(cross(contact_arm, normal));
  // Sums over two tangents t of |a x t|^2 and ((a x t).u)^2, from those over all directions.
  const double squares = 2.0 * norm_squared(contact_arm) - about_normal;
  const double along = dot(turn, normal);
  const double axial = norm_squared(turn) - along * along;
  const double tangential =
      2.0 * inverse.mass + inverse.transverse * (squares - axial) + inverse_axial * axial;
  squared_frequency_[i] +=
      factor * (batch.loads.stiffness[k] * inverse_effective_mass(inverse, arm, normal) +
                batch.loads.tangential_stiffness[k] * tangential);
}

void RateCollector::see(const ContactBatch &batch)
{
  const double factor = batch.is_wall ? 1.0 : 2.0;
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const Vec3 normal = batch.arms.normal.get(k);
    add(batch.i[k], factor, batch, k, batch.arms.arm_i.get(k), batch.depth_i(k), normal);
    if (!batch.is_wall)
      add(batch.j[k], factor, batch, k, batch.arms.arm_j.get(k), batch.depth_j(k), -normal);
  }
}
