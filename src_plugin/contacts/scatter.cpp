// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/scatter.h"

#include <algorithm>

#include "atom.h"
#include "pair_gran.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

SPHEROCYLINDER_INLINE void add_load(int rod, const Vec3 &force, const Vec3 &torque, PairGran &pair,
                                    Atom &atom)
{
  const double relax = pair.relax(rod);
  add_to(atom.f[rod], relax * force);
  add_to(atom.torque[rod], relax * torque);
}

}  // namespace

void LAMMPS_NS::scatter_pairs(const ContactBatch &batch, PairGran &pair, Atom &atom)
{
  const int owned = atom.nlocal;
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int i = batch.i[k], j = batch.j[k];
    const Vec3 force = batch.loads.force.get(k);
    add_load(i, force, batch.loads.torque_i.get(k), pair, atom);
    if (j < owned) add_load(j, -force, batch.loads.torque_j.get(k), pair, atom);
  }
}

void PairLoads::keep(const ContactBatch &batch, int next_rod, int owned)
{
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    if (batch.j[k] >= next_rod && batch.j[k] < owned)
      beyond_.push_back(static_cast<int>(loads_.size()));
    loads_.push_back({batch.i[k], batch.j[k], batch.loads.force.get(k), batch.loads.torque_i.get(k),
                      batch.loads.torque_j.get(k)});
  }
}

void PairLoads::add_to_own(PairGran &pair, Atom &atom, int next_rod) const
{
  const int end = std::min(next_rod, atom.nlocal);
  for (const Load &load : loads_) {
    add_load(load.i, load.force, load.torque_i, pair, atom);
    if (load.j < end) add_load(load.j, -load.force, load.torque_j, pair, atom);
  }
}

void PairLoads::add_to_later(PairGran &pair, Atom &atom, int first_rod, int next_rod) const
{
  for (const int k : beyond_) {
    const Load &load = loads_[k];
    if (load.j >= first_rod && load.j < next_rod)
      add_load(load.j, -load.force, load.torque_j, pair, atom);
  }
}

void LAMMPS_NS::scatter_walls(const ContactBatch &batch, Atom &atom)
{
  for (int k = 0; k < batch.count; k++) {
    add_to(atom.f[batch.i[k]], batch.loads.force.get(k));
    add_to(atom.torque[batch.i[k]], batch.loads.torque_i.get(k));
  }
}
