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

// Of a thread: fewer are read sooner than others are told.
constexpr int kFewestRods = 200;
// How many contacts ahead rods are asked for.
constexpr int kAhead = 2 * kBatch;

}  // namespace

PairGatherer::Reader PairGatherer::reader()
{
  const int nall = atom->nlocal + atom->nghost;
  rods_.resize(nall);
  states_.resize(nall);
  return {static_cast<const AtomVecSpherocylinder &>(*atom->avec), *atom, *this};
}

void PairGatherer::read_all(const RodThreads &threads)
{
  const Reader reader = this->reader();
  threads.run_over(atom->nlocal + atom->nghost, kFewestRods, [reader](int first, int last) {
    for (int i = first; i < last; i++) reader.read(i);
  });
}

void PairGatherer::read_masses(int frozen_groups, bool effective_mass)
{
  const int nall = atom->nlocal + atom->nghost;
  const int driven = groups_with_driven_centres(lmp);
  inverses_.resize(nall);
  kinds_.clear();
  for (int i = 0; i < nall; i++) {
    inverses_[i] = inverse_of(i, frozen_groups, driven, effective_mass);
    kinds_.add(atom->type[i], rods_[i], inverses_[i]);
  }
}

InverseInertia PairGatherer::inverse_of(int i, int frozen_groups, int driven_groups,
                                        bool effective_mass) const
{
  const bool frozen = atom->mask[i] & frozen_groups;
  return {frozen ? 0.0 : 1.0 / atom->rmass[i],
          frozen || !effective_mass ? 0.0 : 1.0 / atom->inertia[i][0],
          (atom->mask[i] & driven_groups) != 0};
}

bool PairGatherer::rods_are_as_read(int frozen_groups, bool effective_mass) const
{
  const int driven = groups_with_driven_centres(lmp);
  for (int i = 0; i < atom->nlocal; i++) {
    const Capsule now = static_cast<const AtomVecSpherocylinder &>(*atom->avec).capsule(i);
    const InverseInertia inverse = inverse_of(i, frozen_groups, driven, effective_mass);
    if (now.radius != rods_[i].radius || now.segment.half_length != rods_[i].segment.half_length ||
        inverse.mass != inverses_[i].mass || inverse.transverse != inverses_[i].transverse ||
        !kinds_.may_be(i, atom->type[i], now, inverse))
      return false;
  }
  return true;
}

void PairGatherer::set_kind(ContactBatch &batch, int k) const
{
  const int i = batch.i[k], j = batch.j[k];
  const int64_t kind = kinds_.of_pair(i, j);
  if (kind != RodKinds::kNone && kind == batch.kind[k]) return;
  batch.kind[k] = kind;
  ContactArms &arms = batch.arms;
  const InverseInertia &own_i = inverses_[i], &own_j = inverses_[j];
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

// What is not just the closest points of two axes that differ.
void PairGatherer::place_otherwise(ContactBatch &batch, int k, const TouchingRodPairs::Touch &touch,
                                   const double *side, bool spread) const
{
  const RodPairGeometry place = geometry_of(touch, rods_, atom->tag, side, spread);
  ContactArms &arms = batch.arms;
  arms.arm_i.set(k, place.s * rods_[touch.i].segment.axis);
  arms.arm_j.set(k, place.t * rods_[touch.j].segment.axis);
  arms.normal.set(k, place.normal);
  arms.distance[k] = place.distance;
  arms.overlap[k] = place.overlap;
  arms.mass_share[k] = place.share;
  arms.side.set(k, kZero);  // which has been minded
  if (spread && touch.nearly_parallel)
    batch.spread[batch.spread_count++] = {k, place.sideways, place.couple_i, place.couple_j};
}

void PairGatherer::fill(ContactBatch &batch, const TouchingRodPairs &touching,
                        const TouchingRodPairs::Piece &piece, int first,
                        const PairHistories &of_pairs, bool spread) const
{
  // Copies, which no store into the batch may change.
  const PairHistories histories = of_pairs;
  const TouchingRodPairs::Pairs pairs = touching.pairs();
  const RodState *states = states_.data();
  ContactArms &arms = batch.arms;
  const RodState *states_i[kBatch], *states_j[kBatch];
  batch.count = std::min(kBatch, piece.first + piece.count - first);
  const bool remember = histories.remember_sides();
  const int end = piece.first + piece.count;
  if (touching.are_rods_far())
    for (int n = first + kAhead; n < std::min(first + kAhead + kBatch, end); n++)
      fetch_early(states[pairs[n].j]);
  const int count = batch.count;
  for (int k = 0; k < count; k++) {
    const CloseRodPairs::Entry pair = pairs[first + k];
    const int i = pair.i, j = pair.j;
    batch.i[k] = i;
    batch.j[k] = j;
    batch.flags[k] = histories.flags_of(i, pair.index);
    batch.history[k] = histories.values_of(i, pair.index);
    states_i[k] = &states[i];
    states_j[k] = &states[j];
    arms.side.set(k, remember ? load(batch.history[k] + histories.side) : kZero);
  }
  const int64_t kind_of_all = kinds_.of_all_pairs();
  if (kind_of_all == RodKinds::kNone || any_differs(batch.kind, kind_of_all, batch.count))
    for (int k = 0; k < batch.count; k++) set_kind(batch, k);

  if (const double *shares = touching.shares(first)) std::copy_n(shares, count, batch.weight);
  const ClosestLanes points = touching.lanes(first);
  std::fill(states_i + batch.count, states_i + kBatch, states_i[0]);
  std::fill(states_j + batch.count, states_j + kBatch, states_j[0]);
  batch.spread_count = 0;
  const bool all_placed = place_at_closest_points(arms, states_i, states_j, points, batch.count);
  for (int k = 0; !all_placed && k < batch.count; k++)
    if (points.distance_squared[k] == 0.0 || (spread && points.nearly_parallel[k] != 0.0))
      place_otherwise(batch, k, touching.touch(first + k),
                      remember ? batch.history[k] + histories.side : nullptr, spread);
  if (touching.shares(first)) push_at_joints(batch, touching, first);
}

void PairGatherer::push_at_joints(ContactBatch &batch, const TouchingRodPairs &touching, int first)
{
  for (int k = 0; k < batch.count; k++) {
    if (batch.weight[k] == 1.0) continue;
    const double scale = 1.0 / batch.weight[k];
    const Vec3 on_i = scale * touching.push_i(first + k), on_j = scale * touching.push_j(first + k);
    const Vec3 delta = batch.arms.distance[k] * batch.arms.normal.get(k);
    // The push on i acts where j is touched, and the other way round.
    batch.spread[batch.spread_count++] = {k, on_i - on_j, -cross(delta, on_i), cross(delta, on_j)};
  }
}
