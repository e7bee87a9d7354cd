// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/scatter.h"

#include <algorithm>

#include "atom.h"
#include "pair_gran.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Of all rods; pair style and arrays stand still while loads are added.
class Adder {
 public:
  Adder(PairGran &pair, const Atom &atom) : pair_(pair), f_(atom.f), torque_(atom.torque) {}

  SPHEROCYLINDER_INLINE void add(int rod, const Vec3 &force, const Vec3 &torque) const
  {
    const double relax = pair_.relax(rod);
    add_to(f_[rod], relax * force);
    add_to(torque_[rod], relax * torque);
  }

 private:
  PairGran &pair_;
  double **const f_, **const torque_;
};

}  // namespace

void LAMMPS_NS::scatter_pairs(const ContactBatch &batch, PairGran &pair, Atom &atom)
{
  const Adder rods(pair, atom);
  const int owned = atom.nlocal;
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int i = batch.i[k], j = batch.j[k];
    const Vec3 force = batch.loads.force.get(k);
    rods.add(i, force, batch.loads.torque_i.get(k));
    if (j < owned) rods.add(j, -force, batch.loads.torque_j.get(k));
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
  const Adder rods(pair, atom);
  const int end = std::min(next_rod, atom.nlocal);
  for (const Load &load : loads_) {
    rods.add(load.i, load.force, load.torque_i);
    if (load.j < end) rods.add(load.j, -load.force, load.torque_j);
  }
}

void PairLoads::add_to_later(PairGran &pair, Atom &atom, int first_rod, int next_rod) const
{
  const Adder rods(pair, atom);
  for (const int k : beyond_) {
    const Load &load = loads_[k];
    if (load.j >= first_rod && load.j < next_rod) rods.add(load.j, -load.force, load.torque_j);
  }
}

void LAMMPS_NS::scatter_walls(const ContactBatch &batch, Atom &atom)
{
  for (int k = 0; k < batch.count; k++) {
    add_to(atom.f[batch.i[k]], batch.loads.force.get(k));
    add_to(atom.torque[batch.i[k]], batch.loads.torque_i.get(k));
  }
}
