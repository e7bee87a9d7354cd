// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/gather_pairs.h"

#include <algorithm>

#include "atom.h"
#include "contacts/rod_pair_geometry.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_driver.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

void set_place(ContactBatch &batch, int k, const RodPairGeometry &place, const Vec3 &axis_i,
               const Vec3 &axis_j)
{
  ContactArms &arms = batch.arms;
  arms.arm_i.set(k, place.s * axis_i);
  arms.arm_j.set(k, place.t * axis_j);
  arms.normal.set(k, place.normal);
  arms.distance[k] = place.distance;
  arms.overlap[k] = place.overlap;
  arms.mass_share[k] = place.share;
}

}  // namespace

void PairGatherer::read_rod(int i)
{
  rods_[i] = static_cast<const AtomVecSpherocylinder &>(*atom->avec).capsule(i);
  motions_[i].velocity = load(atom->v[i]);
  motions_[i].omega = load(atom->omega[i]);
}

void PairGatherer::read_rods(bool all, const std::vector<int> &ghosts)
{
  const int owned = atom->nlocal, nall = owned + atom->nghost;
  rods_.resize(nall);
  motions_.resize(nall);
  for (int i = 0; i < (all ? nall : owned); i++) read_rod(i);
  if (!all)
    for (const int i : ghosts) read_rod(i);
}

void PairGatherer::read_masses(int frozen_groups, bool effective_mass)
{
  const int nall = atom->nlocal + atom->nghost;
  const int driven = groups_with_driven_centres(lmp);
  kinds_.clear();
  for (int i = 0; i < nall; i++) {
    const bool frozen = atom->mask[i] & frozen_groups;
    motions_[i].inverse = {frozen ? 0.0 : 1.0 / atom->rmass[i],
                           frozen || !effective_mass ? 0.0 : 1.0 / atom->inertia[i][0],
                           (atom->mask[i] & driven) != 0};
    kinds_.add(atom->type[i], rods_[i], motions_[i].inverse);
  }
}

void PairGatherer::set_motion(ContactArms &arms, int k, int i, int j) const
{
  arms.velocity_i.set(k, motions_[i].velocity);
  arms.velocity_j.set(k, motions_[j].velocity);
  arms.omega_i.set(k, motions_[i].omega);
  arms.omega_j.set(k, motions_[j].omega);
}

void PairGatherer::set_kinds(ContactBatch &batch, int k) const
{
  const int i = batch.i[k], j = batch.j[k];
  ContactArms &arms = batch.arms;
  const InverseInertia &own_i = motions_[i].inverse, &own_j = motions_[j].inverse;
  const InverseInertia inverse_i = shown_to(own_j, own_i), inverse_j = shown_to(own_i, own_j);
  arms.inverse_mass_i[k] = inverse_i.mass;
  arms.inverse_mass_j[k] = inverse_j.mass;
  arms.inverse_inertia_i[k] = inverse_i.transverse;
  arms.inverse_inertia_j[k] = inverse_j.transverse;
  arms.radius_i[k] = rods_[i].radius;
  arms.radius_j[k] = rods_[j].radius;
  // Two spheres keep LIGGGHTS's spring, so that they move as its own do.
  const bool spheres = rods_[i].segment.half_length == 0.0 && rods_[j].segment.half_length == 0.0;
  arms.turning[k] = spheres ? 0.0 : 1.0;
  batch.type_i[k] = atom->type[i];
  batch.type_j[k] = atom->type[j];
}

void PairGatherer::fill(ContactBatch &batch, const std::vector<TouchingRodPairs::Touch> &touching,
                        size_t first, const PairHistories &histories, bool spread)
{
  ContactArms &arms = batch.arms;
  batch.count = static_cast<int>(std::min<size_t>(kBatch, touching.size() - first));
  batch.spread_count = 0;
  const bool remember = histories.remember_sides();
  for (int k = 0; k < batch.count; k++) {
    const TouchingRodPairs::Touch &touch = touching[first + k];
    const int i = touch.i, j = touch.j;
    const Capsule &rod_i = rods_[i], &rod_j = rods_[j];
    batch.i[k] = i;
    batch.j[k] = j;
    batch.flags[k] = histories.flags_of(i, touch.index);
    batch.history[k] = histories.values_of(i, touch.index);
    const double *side = remember ? batch.history[k] + histories.side : nullptr;

    // Few contacts need more than their closest points; what geometry_of gives minds the side.
    if (touch.distance == 0.0 || (spread && touch.nearly_parallel)) {
      const RodPairGeometry place = geometry_of(touch, rods_, atom->tag, side, spread);
      set_place(batch, k, place, rod_i.segment.axis, rod_j.segment.axis);
      arms.side.set(k, kZero);
      if (spread && touch.nearly_parallel)
        batch.spread[batch.spread_count++] = {k, place.sideways, place.couple_i, place.couple_j};
    } else {
      set_place(batch, k, closest_geometry(touch, rod_i.radius + rod_j.radius), rod_i.segment.axis,
                rod_j.segment.axis);
      arms.side.set(k, side ? load(side) : kZero);
    }
    set_motion(arms, k, i, j);
    const int64_t kind = kinds_.of_pair(i, j);
    const bool is_known = kind != RodKinds::kNone && kind == batch.kind[k];
    batch.kind[k] = kind;
    if (!is_known) set_kinds(batch, k);
  }
}
