// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/contact_batch.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

void LAMMPS_NS::add_spread(ContactBatch &batch)
{
  ContactLoads &loads = batch.loads;
  const ContactArms &arms = batch.arms;
  for (int n = 0; n < batch.spread_count; n++) {
    const auto &[k, over_stiffness, couple_i, couple_j] = batch.spread[n];
    const double kn = loads.stiffness[k];
    const Vec3 sideways = kn * over_stiffness;
    loads.force.set(k, loads.force.get(k) + sideways);
    loads.torque_i.set(k,
                       loads.torque_i.get(k) + cross(arms.arm_i.get(k), sideways) + kn * couple_i);
    loads.torque_j.set(k,
                       loads.torque_j.get(k) - cross(arms.arm_j.get(k), sideways) + kn * couple_j);
  }
}

void LAMMPS_NS::take_weights(ContactBatch &batch)
{
  ContactLoads &loads = batch.loads;
  for (int k = 0; k < batch.count; k++) {
    if (batch.weight[k] == 1.0) continue;
    loads.force.set(k, batch.weight[k] * loads.force.get(k));
    loads.torque_i.set(k, batch.weight[k] * loads.torque_i.get(k));
    loads.torque_j.set(k, batch.weight[k] * loads.torque_j.get(k));
  }
}
