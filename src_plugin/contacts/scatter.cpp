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

void SharedScatter::begin(const TouchingRodPairs &touching, PairGran &pair, Atom &atom)
{
  touching_ = &touching;
  pair_ = &pair;
  atom_ = &atom;
  const std::vector<TouchingRodPairs::Piece> &pieces = touching.pieces();
  if (parts_.size() < pieces.size()) parts_.resize(pieces.size());
  next_rods_.resize(pieces.size());
  for (size_t k = 0; k < pieces.size(); k++) {
    parts_[k].next_rod = std::min(pieces[k].next_rod, atom.nlocal);
    parts_[k].next_pair = pieces[k].first;
    next_rods_[k] = parts_[k].next_rod;
    parts_[k].later_rods.resize(pieces.size());
    parts_[k].later.resize(pieces.size());
  }
  if (waits_.size() < static_cast<size_t>(atom.nlocal)) waits_.resize(atom.nlocal, 0);
}

// Of a rod of a thread after this one, mostly the next.
int SharedScatter::later_piece_of(int piece, int rod) const
{
  do piece++;
  while (rod >= next_rods_[piece]);
  return piece;
}

void SharedScatter::find_later_rods(int piece)
{
  Part &own = parts_[piece];
  for (std::vector<int> &rods : own.later_rods) rods.clear();
  for (std::vector<Load> &loads : own.later) loads.clear();
  const auto [first, count, first_rod, next_rod] = touching_->pieces()[piece];
  for (int n = first; n < first + count; n++) {
    const int j = touching_->pair(n).j;
    if (j >= next_rod && j < atom_->nlocal) own.later_rods[later_piece_of(piece, j)].push_back(j);
  }
  fetch_next(piece);
}

// Forces and torques were cleared by one thread for all.
void SharedScatter::fetch_next(int piece) const
{
  const TouchingRodPairs::Piece &pairs = touching_->pieces()[piece];
  const int first = parts_[piece].next_pair,
            last = std::min(first + kBatch, pairs.first + pairs.count);
  for (int n = first; n < last; n++) {
    const int j = touching_->pair(n).j;
    if (j >= parts_[piece].next_rod) continue;
    fetch_early_to_write(atom_->f[j]);
    fetch_early_to_write(atom_->torque[j]);
  }
}

void SharedScatter::find_waiting_rods(int piece)
{
  Part &own = parts_[piece];
  for (int before = 0; before < piece; before++)
    for (const int j : parts_[before].later_rods[piece])
      if (!waits_[j]) {
        waits_[j] = 1;
        own.waiting_rods.push_back(j);
      }
}

void SharedScatter::add(int piece, const ContactBatch &batch)
{
  const Adder rods(*pair_, *atom_);
  Part &own = parts_[piece];
  const int owned = atom_->nlocal;
  const auto add_own = [&](int rod, const Vec3 &force, const Vec3 &torque) {
    if (waits_[rod])
      own.waiting.push_back({rod, force, torque});
    else
      rods.add(rod, force, torque);
  };
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int j = batch.j[k];
    const Vec3 force = batch.loads.force.get(k);
    add_own(batch.i[k], force, batch.loads.torque_i.get(k));
    if (j < own.next_rod)
      add_own(j, -force, batch.loads.torque_j.get(k));
    else if (j < owned)
      own.later[later_piece_of(piece, j)].push_back({j, -force, batch.loads.torque_j.get(k)});
  }
  own.next_pair += batch.count;
  fetch_next(piece);
}

void SharedScatter::add_to_waiting_rods(int piece)
{
  const Adder rods(*pair_, *atom_);
  Part &own = parts_[piece];
  for (int before = 0; before < piece; before++)
    for (const Load &load : parts_[before].later[piece])
      rods.add(load.rod, load.force, load.torque);
  for (const Load &load : own.waiting) rods.add(load.rod, load.force, load.torque);
  own.waiting.clear();
  for (const int rod : own.waiting_rods) waits_[rod] = 0;
  own.waiting_rods.clear();
}

void LAMMPS_NS::scatter_walls(const ContactBatch &batch, Atom &atom)
{
  for (int k = 0; k < batch.count; k++) {
    add_to(atom.f[batch.i[k]], batch.loads.force.get(k));
    add_to(atom.torque[batch.i[k]], batch.loads.torque_i.get(k));
  }
}
