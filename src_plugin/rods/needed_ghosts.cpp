// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/needed_ghosts.h"

#include <algorithm>
#include <cstddef>

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "core/rotation.h"
#include "domain.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_fields.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// A message begins with the number of poses beside those that are sent in each step, or with this: all
// follow, in the order of the swap.
constexpr double kAll = -1.0;
// Of the slack, for rounding.
constexpr double kOfSlack = 1.0 - 1e-9;
// Flags in a number of a message, exactly.
constexpr int kFlags = 32;

int words_of(int flags) { return (flags + kFlags - 1) / kFlags; }

}  // namespace

void NeededGhosts::begin_run()
{
  brought_step_ = -1;
  reader_.clear();
  counts_ = GhostCounts();
}

bool NeededGhosts::may_be_stale() const { return comm->nprocs > 1 && reader_.empty(); }

void NeededGhosts::forget()
{
  asked_for_ = false;
  arrived_.clear();
}

double NeededGhosts::radius_of(int i) const { return atom->shape[i][0]; }

int NeededGhosts::flags_of_ranks(int mine) const
{
  int all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_BOR, world);
  return all;
}

void NeededGhosts::see_arrived(int ghost)
{
  arrived_.push_back(ghost);
  has_arrived_[ghost - first_ghost_] = 1;
}

void NeededGhosts::forget_arrived()
{
  for (const int ghost : arrived_) has_arrived_[ghost - first_ghost_] = 0;
  arrived_.clear();
}

/* ----------------------------------------------------------------------
   who gets what: backwards through the swaps
------------------------------------------------------------------------- */

// Where LIGGGHTS sends to and receives, after it has made new ghosts.
void NeededGhosts::see_swaps()
{
  swaps_.clear();
  swaps_.resize(ghost_swaps(*comm));
  for (size_t k = 0; k < swaps_.size(); k++)
    swaps_[k].of_host = ghost_swap(*comm, static_cast<int>(k));
  first_ghost_ = atom->nlocal;
  arrived_.clear();
  has_arrived_.assign(atom->nghost, 0);
}

NeededGhosts::Swap &NeededGhosts::swap_from(const int *list)
{
  for (Swap &swap : swaps_)
    if (swap.of_host.list == list) return swap;
  rod_error_one(lmp, "Atom style spherocylinder: ghosts are sent that LIGGGHTS has not chosen");
}

NeededGhosts::Swap &NeededGhosts::swap_to(int first)
{
  for (Swap &swap : swaps_)
    if (swap.of_host.received > 0 && swap.of_host.first == first) return swap;
  rod_error_one(lmp, "Atom style spherocylinder: ghosts come that LIGGGHTS has not chosen");
}

void NeededGhosts::ask_for(const std::vector<int> &wanted)
{
  const bool first = !asked_for_;
  if (first) see_swaps();
  is_sent_.assign(atom->nghost, 0);
  for (const int ghost : wanted) is_sent_[ghost - first_ghost_] = 1;
  is_asking_ = true;
  comm->reverse_comm();
  is_asking_ = false;
  asked_for_ = true;
  counts_.asked++;
  if (!first) comm->forward_comm();
}

// What ranks behind this one want of these ghosts has been added.
int NeededGhosts::pack_asked(int n, int first, double *buf)
{
  if (n == 0) return 0;
  std::vector<int> &received = swap_to(first).received;
  received.clear();
  const int words = words_of(n);
  for (int w = 0; w < words; w++) {
    uint32_t flags = 0;
    for (int k = kFlags * w; k < std::min(n, kFlags * (w + 1)); k++)
      if (is_sent_[first + k - first_ghost_]) {
        flags |= 1u << (k % kFlags);
        received.push_back(first + k);
      }
    buf[w] = flags;
  }
  return words;
}

// The poses of this step are at the other side, but of those that have been left out until now.
void NeededGhosts::unpack_asked(int n, const int *list, const double *buf)
{
  if (n == 0) return;
  Swap &swap = swap_from(list);
  const Vec3 period = period_across(*domain, swap.of_host.periods);
  std::vector<Kept> kept;
  swap.sent.clear();
  auto old = swap.kept.cbegin();
  for (int k = 0; k < n; k++) {
    while (old != swap.kept.cend() && old->place < k) ++old;
    const int i = list[k];
    if (static_cast<uint32_t>(buf[k / kFlags]) >> (k % kFlags) & 1u) {
      swap.sent.push_back(i);
      if (i >= first_ghost_) is_sent_[i - first_ghost_] = 1;
    } else if (old != swap.kept.cend() && old->place == k) {
      kept.push_back(*old);
    } else {
      kept.push_back({i, k, across(i, period)});
    }
  }
  swap.kept.swap(kept);
  swap.is_new = true;
}

/* ----------------------------------------------------------------------
   poses
------------------------------------------------------------------------- */

Segment NeededGhosts::across(int i, const Vec3 &period) const
{
  const double *shape = atom->shape[i];
  return {load(atom->x[i]) + period, axis_of(load_quaternion(atom->quaternion[i])),
          shape[2] - shape[0]};
}

// What is stale here, too, moves when a pose comes only, but in the first message after ghosts were asked for:
// until then it may have been asked for here.
bool NeededGhosts::is_as_it_was(const Swap &swap, int i) const
{
  return !swap.is_new && !sends_all_ && i >= first_ghost_ && is_stale(i) &&
         !has_arrived_[i - first_ghost_];
}

// What is stale here is sent whenever it is another.
double NeededGhosts::slack_squared_here(int i) const
{
  const double most = i >= first_ghost_ && is_stale(i) ? 0.0 : kOfSlack * slack(i);
  return most * most;
}

int NeededGhosts::pack(unsigned travel, int n, const int *list, const GhostGain &gain, double *buf)
{
  if (n == 0) return 0;
  if (asked_for_) return pack_needed(travel, swap_from(list), gain, buf);
  const int numbers = pack_rod_fields(*atom, travel, n, list, gain, buf);
  count(list, n, numbers);
  return numbers;
}

int NeededGhosts::pack_needed(unsigned travel, Swap &swap, const GhostGain &gain, double *buf)
{
  others_.clear();
  places_.clear();
  for (Kept &kept : swap.kept) {
    if (is_as_it_was(swap, kept.rod)) continue;
    const Segment now = across(kept.rod, gain.period);
    const double shift = twice_shift_squared(now, kept.sent);
    if (!sends_all_ && shift <= slack_squared_here(kept.rod)) continue;
    kept.sent = now;
    others_.push_back(kept.rod);
    places_.push_back(kept.place);
  }
  swap.is_new = false;
  const int number = static_cast<int>(others_.size()), sent = static_cast<int>(swap.sent.size());
  double *out = buf;
  const auto put = [&](unsigned fields, int rods, const int *list) {
    out += pack_rod_fields(*atom, fields, rods, list, gain, out);
  };
  if (number > 0 && others_.size() == swap.kept.size()) {
    *out++ = kAll;
    put(travel, swap.of_host.sent, swap.of_host.list);
  } else {
    *out++ = number;
    put(travel, sent, swap.sent.data());
    for (const int place : places_) *out++ = place;
    put(kForward, number, others_.data());
  }
  const int numbers = static_cast<int>(out - buf);
  count(swap.of_host.list, sent + number, numbers);
  return numbers;
}

void NeededGhosts::unpack(unsigned travel, int n, int first, const double *buf)
{
  if (n == 0) return;
  if (!asked_for_) {
    unpack_rod_fields(*atom, travel, n, first, buf);
    return;
  }
  const Swap &swap = swap_to(first);
  const double number = *buf++;
  if (number == kAll) {
    unpack_rod_fields(*atom, travel, n, first, buf);
    for (int k = 0; k < n; k++) see_arrived(first + k);
    return;
  }
  buf = unpack_rod_fields(*atom, travel, swap.received, buf);
  places_.clear();
  for (int k = 0; k < static_cast<int>(number); k++)
    places_.push_back(first + static_cast<int>(*buf++));
  unpack_rod_fields(*atom, kForward, places_, buf);
  for (const int ghost : swap.received) see_arrived(ghost);
  for (const int ghost : places_) see_arrived(ghost);
}

void NeededGhosts::bring_all_before_insertion()
{
  if (brought_step_ == update->ntimestep) return;
  brought_step_ = update->ntimestep;
  sends_all_ = true;
  comm->forward_comm();
  sends_all_ = false;
  before_insertion_.clear();
  const auto &rods = static_cast<const AtomVecSpherocylinder &>(*atom->avec);
  for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++)
    before_insertion_.push_back(rods.capsule(i));
}

const std::vector<spherocylinder::Capsule> *NeededGhosts::before_insertion() const
{
  return brought_step_ == update->ntimestep ? &before_insertion_ : nullptr;
}

// A rank's messages to itself are none.
void NeededGhosts::count(const int *list, int poses, int numbers)
{
  if (comm->nprocs == 1) return;
  for (int k = 0; k < ghost_swaps(*comm); k++) {
    const GhostSwap swap = ghost_swap(*comm, k);
    if (swap.list != list || swap.to_rank == comm->me) continue;
    counts_.messages++;
    counts_.poses += poses;
    counts_.bytes += static_cast<int64_t>(sizeof(double)) * numbers;
  }
}
