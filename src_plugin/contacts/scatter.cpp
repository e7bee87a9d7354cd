// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/scatter.h"

#include "atom.h"
#include "pair_gran.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

void LAMMPS_NS::scatter_pairs(const ContactBatch &batch, PairGran &pair, Atom &atom)
{
  double **f = atom.f, **torque = atom.torque;
  const int owned = atom.nlocal;
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int i = batch.i[k], j = batch.j[k];
    const Vec3 force = batch.loads.force.get(k);
    const double relax_i = pair.relax(i);
    add_to(f[i], relax_i * force);
    add_to(torque[i], relax_i * batch.loads.torque_i.get(k));
    if (j >= owned) continue;
    const double relax_j = pair.relax(j);
    add_to(f[j], -relax_j * force);
    add_to(torque[j], relax_j * batch.loads.torque_j.get(k));
  }
}

void LAMMPS_NS::scatter_walls(const ContactBatch &batch, Atom &atom)
{
  for (int k = 0; k < batch.count; k++) {
    add_to(atom.f[batch.i[k]], batch.loads.force.get(k));
    add_to(atom.torque[batch.i[k]], batch.loads.torque_i.get(k));
  }
}
