// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/wall_observers.h"

#include "atom.h"
#include "contact_interface.h"
#include "fix_contact_property_atom_wall.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

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
