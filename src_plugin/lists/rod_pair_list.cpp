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

using namespace LAMMPS_NS;
using namespace spherocylinder;

bool RodPairList::is_listed(int i, int j) const
{
  const int include = neighbor->includegroup;
  if (include && !(atom->mask[j] & group->bitmask[include])) return false;
  return !has_exclusions(*neighbor) || !is_excluded(*neighbor, *atom, i, j);
}

// Of pairs that are in the list before, too; both lists name partners in ascending order.
void RodPairList::keep_histories(int dnum)
{
  const int owned = static_cast<int>(std::min(now_.first.size(), before_.first.size())) - 1;
  for (int i = 0; i < owned; i++) {
    int old = before_.first[i];
    const int old_end = before_.first[i + 1];
    for (int k = now_.first[i]; k < now_.first[i + 1]; k++) {
      while (old < old_end && before_.partners[old] < now_.partners[k]) old++;
      if (old == old_end || before_.partners[old] != now_.partners[k]) continue;
      now_.flags[k] = before_.flags[old];
      std::copy_n(&before_.history[dnum * old], dnum, &now_.history[dnum * k]);
    }
  }
}

void RodPairList::fetch_histories(const NeighList &list, int dnum)
{
  FixContactHistory &stored = *list.fix_history;
  const int owned = static_cast<int>(now_.first.size()) - 1;
  for (int i = 0; i < owned; i++)
    for (int m = 0; m < stored.n_partner(i); m++)
      for (int k = now_.first[i]; k < now_.first[i + 1]; k++) {
        if (atom->tag[now_.partners[k]] != stored.partner(i, m)) continue;
        now_.flags[k] = 1;
        stored.contacthistory(i, m, &now_.history[dnum * k]);
      }
}

void RodPairList::hand_over(NeighList &list)
{
  const int owned = static_cast<int>(now_.first.size()) - 1;
  list.grow(atom->nmax);
  list.inum = owned;
  NeighList *histories = list.listgranhistory;
  if (histories) histories->grow(atom->nmax);
  for (int i = 0; i < owned; i++) {
    const int first = now_.first[i];
    list.ilist[i] = i;
    list.numneigh[i] = now_.first[i + 1] - first;
    list.firstneigh[i] = now_.partners.data() + first;
    if (!histories) continue;
    histories->firstneigh[i] = now_.flags.data() + first;
    if (histories->dnum) histories->firstdouble[i] = now_.history.data() + histories->dnum * first;
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
  return static_cast<int>(ids_.size()) == atom->nlocal + atom->nghost &&
         std::equal(ids_.begin(), ids_.end(), atom->tag);
}

void RodPairList::renew(PairGran &pair, const std::vector<Capsule> &rods, double gap, bool migrated)
{
  NeighList &list = *pair.list;
  const int owned = neighbor->includegroup ? atom->nfirst : atom->nlocal;
  near_.find(rods, owned, gap);

  if (!migrated) std::swap(now_, before_);  // else nothing of the old list is asked for
  now_.first.resize(owned + 1);
  now_.partners.clear();
  for (int i = 0; i < owned; i++) {
    now_.first[i] = pairs();
    for (int k = near_.first(i); k < near_.first(i + 1); k++) {
      const int j = near_.partners()[k];
      if (is_listed(i, j)) now_.partners.push_back(j);
    }
  }
  now_.first[owned] = pairs();

  const int dnum = list.listgranhistory ? list.listgranhistory->dnum : 0;
  now_.flags.assign(pairs(), 0);
  now_.history.assign(static_cast<size_t>(dnum) * pairs(), 0.0);
  if (list.listgranhistory) {
    if (migrated)
      fetch_histories(list, dnum);
    else
      keep_histories(dnum);
  }
  hand_over(list);

  if (migrated) ids_.assign(atom->tag, atom->tag + atom->nlocal + atom->nghost);
  ghosts_.clear();
  for (const int j : now_.partners)
    if (j >= atom->nlocal) ghosts_.push_back(j);
  std::sort(ghosts_.begin(), ghosts_.end());
  ghosts_.erase(std::unique(ghosts_.begin(), ghosts_.end()), ghosts_.end());
}
