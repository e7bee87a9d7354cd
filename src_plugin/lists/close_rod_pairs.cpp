// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/close_rod_pairs.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "comm.h"
#include "core/rotation.h"
#include "core/skin.h"
#include "domain.h"
#include "host/host_limits.h"
#include "host/rod_error.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair_gran.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Skins to begin with, in mean diameters.
constexpr double kFirstSkin = 0.3;
constexpr double kFirstListSkin = 1.0;
constexpr double kPairsToBeginWith = 8.0;  // of a rod's own half, in the list
// Where chosen: bounds, and when: after so many renewals, which take some steps, or steps. In fewer, rods
// have hardly moved through the narrow skin.
constexpr double kThinnest = 0.05, kWidest = 1.0;
constexpr double kNarrowestBeyond = 0.5, kWidestBeyond = 4.0;
constexpr int64_t kRenewalsToChoose = 3, kFewestSteps = 200, kMostSteps = 2000;

// What the parts cost, in nanoseconds on the machine they were measured on; their ratios are what
// counts. A close pair is gathered and its closest points found, every step; a refresh of the close
// pairs walks along the list and finds the closest points of the pairs of rods that moved; a renewal of
// the list enters rods in cells and finds the closest points of those that share one.
constexpr double kTestCost = 15.0, kWalkCost = 1.5, kLookCost = 30.0;
constexpr double kCellCost = 45.0, kTryCost = 25.0;

}  // namespace

void CloseRodPairs::reset(const PairGran &pair, double skin)
{
  leave_lists_unbuilt(*neighbor, &pair);  // they are filled here
  counts_ = RodPairCounts();
  work_ = Work();
  seen_builds_ = -1;
  skin_is_chosen_ = skin == 0.0;
  if (!skin_is_chosen_) skin_ = skin;
}

// neighbor->ago is 0 in a second step, too, if a run goes on with `pre no` after a step that built.
bool CloseRodPairs::have_rods_migrated()
{
  const bool migrated = neighbor->ago == 0 && neighbor->ncalls != seen_builds_;
  seen_builds_ = neighbor->ncalls;
  return migrated;
}

void CloseRodPairs::check_rods_are_the_same() const
{
  if (!list_.is_of_present_rods())
    rod_error_one(lmp,
                  "Run: pre no cannot be used after a command has deleted, added or renamed rods, "
                  "the list of pairs is that of the rods before (expected run without pre no)");
}

// Any surface point of a rod moves at most as far as its centre plus its axis's end; a spin about
// the axis moves no surface. (a + b)^2 <= 2 a^2 + 2 b^2 saves the roots.
double CloseRodPairs::twice_shift_squared(const Segment &now, const Segment &then)
{
  return 2.0 * (norm_squared(now.centre - then.centre) +
                now.half_length * now.half_length * norm_squared(now.axis - then.axis));
}

// Gives a rod that has moved through half the skin, or any rod (`all`), a new reference pose. False if it
// may move through half the outer skin before it gets another.
bool CloseRodPairs::follow(int i, const Capsule &rod, bool all)
{
  const double half = 0.5 * skin_, rest = 0.5 * (list_skin_ - skin_);
  moved_[i] = all || twice_shift_squared(rod.segment, reference_[i].segment) > half * half;
  if (!moved_[i]) return true;
  any_moved_ = true;
  reference_[i] = rod;
  return twice_shift_squared(rod.segment, list_reference_[i]) <= rest * rest;
}

// False if a ghost may have used up its half of the outer skin. Of ghosts that are in no listed pair
// only this must be known; that of the others is one loop over LIGGGHTS's arrays. The ghosts of one
// rank alone are its own rods, which it looks at anyway, as long as the box keeps its size.
bool CloseRodPairs::ghosts_stay() const
{
  if (comm->nprocs == 1 && list_box_ == box_size()) return true;
  const int owned = atom->nlocal;
  double farthest = 0.0;
  for (int i = owned; i < owned + atom->nghost; i++) {
    const Segment &then = list_reference_[i];
    const Segment now = {load(atom->x[i]), axis_of(load_quaternion(atom->quaternion[i])),
                         then.half_length};
    farthest = std::max(farthest, twice_shift_squared(now, then));
  }
  return farthest <= 0.25 * list_skin_ * list_skin_;
}

std::array<double, 3> CloseRodPairs::box_size() const
{
  return {domain->xprd, domain->yprd, domain->zprd};
}

// False if the outer list has to be renewed.
bool CloseRodPairs::look(PairGran &pair, const std::vector<Capsule> &rods)
{
  const double skin = skin_, list_skin = list_skin_;
  const bool enough = work_.renewals >= kRenewalsToChoose && work_.steps >= kFewestSteps;
  if (enough || work_.steps >= kMostSteps) choose_skins();
  if (list_skin_ != list_skin) return false;

  const bool all = skin_ != skin;
  bool lasts = true;
  any_moved_ = false;
  const int owned = atom->nlocal;
  for (int i = 0; i < owned; i++) lasts &= follow(i, rods[i], all);
  for (const int i : tracked_ghosts()) lasts &= follow(i, rods[i], all);
  if (!lasts || !ghosts_stay()) {
    if (!skins_are_tried_) widen_list();
    return false;
  }
  if (!any_moved_) return true;
  work_.looked_at += walk(pair);
  work_.walked += list_.pairs();
  counts_.refreshes++;
  counts_.close_skin = skin_;
  return true;
}

void CloseRodPairs::count_step()
{
  work_.steps++;
  work_.tested += static_cast<int64_t>(entries_.size());
  counts_.steps++;
  counts_.close = static_cast<int64_t>(entries_.size());
}

bool CloseRodPairs::is_close(int i, int j) const
{
  const Segment &a = reference_[i].segment, &b = reference_[j].segment;
  const double reach = reference_[i].radius + reference_[j].radius + skin_;
  if (lines_are_apart(a, b, reach)) return false;
  return closest_points(a, b).distance_squared < reach * reach;
}

// Looks again at the pairs of rods that have moved, and says how many. entries_ is in the order of the
// list: both are walked at once. Pairs with a contact flag are always kept: their parting must be seen.
int64_t CloseRodPairs::walk(PairGran &pair)
{
  const NeighList &list = *pair.list;
  int **contact_flags = list.listgranhistory ? list.listgranhistory->firstneigh : nullptr;
  next_entries_.clear();
  int64_t looked_at = 0;
  size_t old = 0;
  for (int i = 0; i < list.inum; i++) {
    const int *neighbours = list.firstneigh[i];
    const int count = list.numneigh[i];
    const bool moved_i = moved_[i];
    for (int index = 0; index < count; index++) {
      const int j = neighbours[index];
      const bool was_close =
          old < entries_.size() && entries_[old].i == i && entries_[old].index == index;
      old += was_close;
      bool close = was_close;
      if (moved_i || moved_[j]) {
        looked_at++;
        close = (contact_flags && contact_flags[i][index]) || is_close(i, j);
      }
      if (close) next_entries_.push_back({i, j, index, atom->tag[j] < atom->tag[i]});
    }
  }
  entries_.swap(next_entries_);
  return looked_at;
}

void CloseRodPairs::renew(PairGran &pair, const std::vector<Capsule> &rods, bool migrated)
{
  diameter_ = 0.0;
  for (const Capsule &rod : rods) diameter_ += 2.0 * rod.radius / static_cast<double>(rods.size());
  if (list_skin_ == 0.0) {
    if (skin_is_chosen_) skin_ = kFirstSkin * diameter_;
    list_skin_ = kFirstListSkin * diameter_;
  }
  list_skin_ = std::max(list_skin_, skin_ + kNarrowestBeyond * diameter_);

  list_.renew(pair, rods, list_skin_, migrated);

  list_box_ = box_size();
  reference_ = rods;
  list_reference_.resize(rods.size());
  for (size_t i = 0; i < rods.size(); i++) list_reference_[i] = rods[i].segment;
  moved_.assign(rods.size(), 1);
  entries_.clear();
  walk(pair);
  // What LIGGGHTS asks for does not depend on the skin.
  if (!migrated) {
    work_.renewals++;
    work_.cells += list_.search().cells();
    work_.tried += list_.search().tried();
  }

  counts_.renewals++;
  counts_.listed = list_.pairs();
  counts_.list_skin = list_skin_;
  counts_.close_skin = skin_;
}

// Until the skins are chosen for what they cost: a list of few pairs may as well be a wide one.
void CloseRodPairs::widen_list()
{
  const double wanted = kPairsToBeginWith * atom->nlocal;
  const double skin = (diameter_ + list_skin_) * wanted / std::max(1, list_.pairs()) - diameter_;
  list_skin_ = std::max(list_skin_, std::min(skin, skin_ + kWidestBeyond * diameter_));
}

// Changes of less than a tenth are not worth it.
void CloseRodPairs::choose_skins()
{
  skins_are_tried_ = true;
  const double walk_cost = kWalkCost * static_cast<double>(work_.walked);
  const double refresh_cost = walk_cost + kLookCost * static_cast<double>(work_.looked_at);
  const double test_cost = kTestCost * static_cast<double>(work_.tested);
  const double renewal_cost =
      kCellCost * static_cast<double>(work_.cells) + kTryCost * static_cast<double>(work_.tried);
  work_ = Work();

  double skin = skin_;
  if (skin_is_chosen_)
    skin = std::clamp(better_skin(skin_, 0.0, diameter_, test_cost, refresh_cost),
                      kThinnest * diameter_, kWidest * diameter_);
  const double list_skin =
      std::clamp(better_skin(list_skin_, skin_, diameter_, refresh_cost, renewal_cost),
                 skin + kNarrowestBeyond * diameter_, skin + kWidestBeyond * diameter_);
  if (std::fabs(skin - skin_) > 0.1 * skin_) skin_ = skin;
  if (std::fabs(list_skin - list_skin_) > 0.1 * list_skin_) list_skin_ = list_skin;
  list_skin_ = std::max(list_skin_, skin_ + kNarrowestBeyond * diameter_);
}
