// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/rod_pair_list.h"

#include <algorithm>

#include "atom.h"
#include "fix_contact_history.h"
#include "group.h"
#include "host/private_members.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair_gran.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_threads.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Of a thread: fewer are looked up sooner than others are told.
constexpr int kFewestRods = 20;

}  // namespace

// For the search of so many rods.
SearchPieces RodPairList::pieces_of(int rods) const
{
  const RodThreads &threads =
      static_cast<AtomVecSpherocylinder &>(*atom->avec).attached<RodThreads>();
  const int count = threads.pieces_of(rods, kFewestRods);
  return {count, [&threads, count](const auto &work) { threads.run(count, work); }};
}

bool RodPairList::is_listed(int i, int j) const
{
  const int include = neighbor->includegroup;
  if (include && !(atom->mask[j] & group->bitmask[include])) return false;
  if (fibres_ && fibres_->never_touch(i, j)) return false;
  return !has_exclusions(*neighbor) || !is_excluded(*neighbor, *atom, i, j);
}

void RodPairList::begin_row()
{
  partners_.clear();
  flags_.clear();
  history_.clear();
}

// A pair without a contact.
void RodPairList::add(int partner)
{
  partners_.push_back(partner);
  flags_.push_back(0);
  history_.resize(history_.size() + dnum_, 0.0);
}

// A pair as it is, or was.
void RodPairList::add_as(const Contents &contents, int place)
{
  partners_.push_back(contents.partners[place]);
  flags_.push_back(contents.flags[place]);
  const double *values = contents.history.data() + static_cast<size_t>(dnum_) * place;
  history_.insert(history_.end(), values, values + dnum_);
}

// Row i becomes the one that was made. True if the arrays have had to grow.
bool RodPairList::put_row(int i)
{
  const int count = static_cast<int>(partners_.size());
  pairs_ += count - now_.rows.count(i);
  now_.rows.set_count(i, count);
  const size_t needed = now_.rows.end();
  const bool grows = now_.partners.size() < needed;
  if (grows) {
    const size_t room = needed + needed / 4;
    now_.partners.resize(room);
    now_.flags.resize(room);
    now_.history.resize(room * dnum_);
  }
  const size_t first = now_.rows.first(i);
  std::copy(partners_.begin(), partners_.end(), now_.partners.begin() + first);
  std::copy(flags_.begin(), flags_.end(), now_.flags.begin() + first);
  std::copy(history_.begin(), history_.end(), now_.history.begin() + dnum_ * first);
  return grows;
}

// Pairs that are in the list before, too, have their histories; both name partners in ascending order.
void RodPairList::keep_row(int i, const int *partner, const int *end)
{
  const bool has_before = i < before_.rows.rows();
  int old = has_before ? before_.rows.first(i) : 0;
  const int old_end = has_before ? old + before_.rows.count(i) : 0;
  for (; partner != end; partner++) {
    if (!is_listed(i, *partner)) continue;
    while (old < old_end && before_.partners[old] < *partner) old++;
    if (old < old_end && before_.partners[old] == *partner)
      add_as(before_, old);
    else
      add(*partner);
  }
}

void RodPairList::fetch_histories(const NeighList &list)
{
  FixContactHistory &stored = *list.fix_history;
  for (int i = 0; i < now_.rows.rows(); i++)
    for (int m = 0; m < stored.n_partner(i); m++)
      for (int k = now_.rows.first(i); k < now_.rows.first(i) + now_.rows.count(i); k++) {
        if (atom->tag[now_.partners[k]] != stored.partner(i, m)) continue;
        now_.flags[k] = 1;
        stored.contacthistory(i, m, &now_.history[static_cast<size_t>(dnum_) * k]);
      }
}

void RodPairList::hand_over_row(NeighList &list, int i)
{
  const int first = now_.rows.first(i);
  list.numneigh[i] = now_.rows.count(i);
  list.firstneigh[i] = now_.partners.data() + first;
  NeighList *histories = list.listgranhistory;
  if (!histories) return;
  histories->firstneigh[i] = now_.flags.data() + first;
  if (dnum_) histories->firstdouble[i] = now_.history.data() + static_cast<size_t>(dnum_) * first;
}

void RodPairList::hand_over(NeighList &list)
{
  const int owned = now_.rows.rows();
  list.grow(atom->nmax);
  list.inum = owned;
  if (list.listgranhistory) list.listgranhistory->grow(atom->nmax);
  for (int i = 0; i < owned; i++) {
    list.ilist[i] = i;
    hand_over_row(list, i);
  }
  // Others that share the list have copies of its arrays.
  for (int k = 0; k < neighbor->nlist; k++) {
    NeighList *copy = neighbor->lists[k];
    if (copy->listcopy != &list) continue;
    copy->inum = list.inum;
    copy->ilist = list.ilist;
    copy->numneigh = list.numneigh;
    copy->firstneigh = list.firstneigh;
  }
}

bool RodPairList::is_of_present_rods() const
{
  return owned_ == atom->nlocal && static_cast<int>(ids_.size()) == owned_ + atom->nghost &&
         std::equal(ids_.begin(), ids_.end(), atom->tag);
}

void RodPairList::renew(PairGran &pair, const std::vector<Capsule> &rods, bool migrated)
{
  NeighList &list = *pair.list;
  const int owned = neighbor->includegroup ? atom->nfirst : atom->nlocal;
  near_.find(rods, owned, 0.0, pieces_of(owned));
  const auto &fibres = rods_of(lmp, "Pair gran").attached<FibreSegments>();
  fibres_ = fibres.rows ? &fibres : nullptr;
  seen_fibres_ = fibres.changes;

  // What LIGGGHTS has stored is asked for after it has migrated the rods, else the old list.
  std::swap(now_, before_);
  if (migrated) before_.rows.clear(0);
  dnum_ = list.listgranhistory ? list.listgranhistory->dnum : 0;
  now_.rows.clear(owned);
  holders_.clear(static_cast<int>(rods.size()));
  pairs_ = 0;
  for (int i = 0; i < owned; i++) {
    begin_row();
    const int *partners = near_.partners().data();
    keep_row(i, partners + near_.first(i), partners + near_.first(i + 1));
    put_row(i);
    for (const int j : partners_) holders_.add(j, i);
  }
  if (migrated && list.listgranhistory) fetch_histories(list);
  hand_over(list);

  owned_ = atom->nlocal;
  if (migrated) ids_.assign(atom->tag, atom->tag + atom->nlocal + atom->nghost);
  see_ghosts();
}

bool RodPairList::goes_on(PairGran &pair)
{
  if (neighbor->includegroup || has_exclusions(*neighbor)) return false;
  if (rods_of(lmp, "Pair gran").attached<FibreSegments>().changes != seen_fibres_) return false;
  hand_over(*pair.list);  // whose arrays LIGGGHTS may have made anew
  return true;
}

void RodPairList::see_ghosts()
{
  ghosts_.clear();
  for (int j = atom->nlocal; j < atom->nlocal + atom->nghost; j++)
    if (holders_.begin(j) != holders_.end(j)) ghosts_.push_back(j);
}

// Pairs of a moved rod stay if they are found again or in contact. What has not changed is left alone.
void RodPairList::remake_row(int i, const NearPairs::Pair *found, const NearPairs::Pair *end,
                             const std::vector<char> &is_moved)
{
  const int first = now_.rows.first(i), old_end = first + now_.rows.count(i);
  begin_row();
  bool is_same = true;
  for (int old = first; old < old_end || found != end;) {
    if (found != end && (old == old_end || found->j < now_.partners[old])) {
      add(found->j);
      holders_.add(found->j, i);
      is_same = false;
      found++;
      continue;
    }
    const int j = now_.partners[old];
    const bool is_found = found != end && found->j == j;
    found += is_found;
    if (is_found || !(is_moved[i] || is_moved[j]) || now_.flags[old])
      add_as(now_, old);
    else {
      holders_.remove(j, i);
      is_same = false;
    }
    old++;
  }
  if (is_same) return;
  grown_ |= put_row(i);
  remade_.push_back(i);
}

bool RodPairList::renew_some(PairGran &pair, const std::vector<Capsule> &rods,
                             const std::vector<int> &moved, const std::vector<char> &is_moved)
{
  if (!near_.find_again(rods, moved, pieces_of(static_cast<int>(moved.size())))) return false;
  found_.clear();
  for (const NearPairs::Pair &found : near_.found())
    if (is_listed(found.i, found.j)) found_.push_back(found);
  std::sort(found_.begin(), found_.end(), [](const NearPairs::Pair &a, const NearPairs::Pair &b) {
    return a.i != b.i ? a.i < b.i : a.j < b.j;
  });

  changed_.clear();
  for (const int m : moved) {
    if (m < now_.rows.rows()) changed_.push_back(m);
    changed_.insert(changed_.end(), holders_.begin(m), holders_.end(m));
  }
  for (const NearPairs::Pair &found : found_) changed_.push_back(found.i);
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());

  remade_.clear();
  grown_ = false;
  const NearPairs::Pair *found = found_.data(), *end = found + found_.size();
  for (const int i : changed_) {
    const NearPairs::Pair *of_row = found;
    while (found != end && found->i == i) found++;
    remake_row(i, of_row, found, is_moved);
  }
  if (grown_)
    hand_over(*pair.list);
  else
    for (const int i : remade_) hand_over_row(*pair.list, i);
  see_new_ghosts();
  return true;
}

void RodPairList::see_new_ghosts()
{
  new_ghosts_.clear();
  for (const NearPairs::Pair &found : found_)
    if (found.j >= atom->nlocal && !std::binary_search(ghosts_.begin(), ghosts_.end(), found.j))
      new_ghosts_.push_back(found.j);
  std::sort(new_ghosts_.begin(), new_ghosts_.end());
  new_ghosts_.erase(std::unique(new_ghosts_.begin(), new_ghosts_.end()), new_ghosts_.end());
  const auto known = static_cast<std::ptrdiff_t>(ghosts_.size());
  ghosts_.insert(ghosts_.end(), new_ghosts_.begin(), new_ghosts_.end());
  std::inplace_merge(ghosts_.begin(), ghosts_.begin() + known, ghosts_.end());
}
