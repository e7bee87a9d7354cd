// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/observers.h"

#include "atom.h"
#include "contact_interface.h"
#include "contacts/contact_rates.h"
#include "contacts/contact_rows.h"
#include "fix_contact_property_atom_wall.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "pair_gran.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

void PairVirial::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int i = batch.i[k], j = batch.j[k];
    const Vec3 between = load(atom->x[i]) - load(atom->x[j]), force_on_i = batch.loads.force.get(k);
    pair_.ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, 0.0, 0.0, force_on_i.x, force_on_i.y,
                       force_on_i.z, between.x, between.y, between.z);
  }
}

template <typename Host>
void NormalForceSums<Host>::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int j = batch.j[k];
    const double along = dot(batch.loads.force.get(k), batch.arms.normal.get(k));
    *host_.get_sum_normal_force_ptr(batch.i[k]) += along;
    if (j >= 0 && j < atom->nlocal) *host_.get_sum_normal_force_ptr(j) += along;
  }
}
namespace LAMMPS_NS {
template class NormalForceSums<PairGran>;
template class NormalForceSums<FixWallGran>;
}  // namespace LAMMPS_NS

void RateCollector::add(int i, double factor, const ContactBatch &batch, int k, const Vec3 &arm,
                        double depth, const Vec3 &normal)
{
  const bool frozen = atom->mask[i] & frozen_groups_;
  const InverseInertia inverse = {frozen ? 0.0 : 1.0 / atom->rmass[i],
                                  frozen ? 0.0 : 1.0 / atom->inertia[i][0]};
  rates_.add(i, factor, batch.loads.stiffness[k], batch.loads.tangential_stiffness[k], inverse,
             1.0 / atom->inertia[i][2], axis_of(load_quaternion(atom->quaternion[i])), arm, depth,
             normal);
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

void RowWriter::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int i = batch.i[k];
    const Vec3 normal = batch.arms.normal.get(k);
    const ContactRow row = {i,
                            batch.j[k],
                            batch.loads.force.get(k),
                            batch.loads.torque_i.get(k),
                            normal,
                            load(atom->x[i]) + batch.arms.arm_i.get(k) - batch.depth_i(k) * normal,
                            batch.arms.velocity_j.get(k),
                            batch.history[k],
                            batch.arms.radius_i[k],
                            batch.arms.radius_j[k],
                            batch.arms.distance[k],
                            batch.arms.overlap[k]};
    if (wall_)
      rows_.add_wall_contact(*wall_, batch.end[k], row);
    else
      rows_.add_pair_contact(row);
  }
}

// LIGGGHTS's stress of a wall goes by the last of the rod's contacts.
void WallLoads::see(const ContactBatch &batch)
{
  LIGGGHTS::ContactModels::ForceData total;
  for (int k = 0; k < batch.count; k++) {
    const int i = batch.i[k];
    add_to(total.delta_F, batch.loads.force.get(k));
    add_to(total.delta_torque, batch.loads.torque_i.get(k));
    if (k + 1 < batch.count && batch.i[k + 1] == i) continue;
    if (fix_.store_force_contact() && update->ntimestep % fix_.store_force_contact_every() == 0)
      fix_.add_contactforce_wall(i, total, 0);
    if (fix_.store_force_contact_stress()) {
      double delta[3], wall_velocity[3];
      store(batch.arms.distance[k] * batch.arms.normal.get(k), delta);
      store(batch.arms.velocity_j.get(k), wall_velocity);
      fix_.add_contactforce_stress_wall(i, total, delta, wall_velocity, 0);
    }
    if (fix_.store_force()) add_to(fix_.fix_wallforce()->array_atom[i], load(total.delta_F));
    total.reset();
  }
}

void WallHeat::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++)
    fix_.addHeatFlux(nullptr, batch.i[k], batch.arms.radius_i[k], batch.arms.overlap[k], 1.0);
}
