// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/fibre_joints.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "atom.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

using S = FibreSegments;

}  // namespace

FibreJoints::FibreJoints(LAMMPS *lmp)
    : Pointers(lmp),
      rods_(rods_of(lmp, "Fix joint/spherocylinder")),
      segments_(rods_.attached<FibreSegments>())
{
}

JointedRod FibreJoints::rod(int i) const
{
  return {load(atom->x[i]), load_quaternion(atom->quaternion[i]),
          atom->shape[i][2] - atom->shape[i][0]};
}

// Farther than both rods' lengths the partner is another image: the right one is not at hand.
int FibreJoints::partner_at_hand(int i, bool head) const
{
  const int ends = segments_.ends(i), fibre = segments_.fibre(i);
  const bool closes = (ends & (head ? S::kHeadCloses : S::kTailCloses)) != 0;
  // Who closes a ring from its last place is told by that alone.
  const bool any_place = closes && !head;
  const int place = closes ? 1 : segments_.place(i) + (head ? 1 : -1);
  const auto before = [](const Place &a, const Place &b) {
    return std::tie(a.fibre, a.place) < std::tie(b.fibre, b.place);
  };
  const Place lowest = {fibre, any_place ? 0 : place, 0};
  const Place highest = {fibre, any_place ? std::numeric_limits<int>::max() : place, 0};
  const auto begin = std::lower_bound(places_.begin(), places_.end(), lowest, before);
  const auto end = std::upper_bound(begin, places_.end(), highest, before);

  const JointedRod self = rod(i);
  const Vec3 meeting = head ? self.head() : self.tail();
  int partner = -1;
  double least = 0.0;
  for (auto found = begin; found != end; found++) {
    if (any_place && !(segments_.ends(found->index) & S::kHeadCloses)) continue;
    const JointedRod other = rod(found->index);
    const double gap = norm((head ? other.tail() : other.head()) - meeting);
    if (gap > 2.0 * (self.half_length + other.half_length)) continue;
    if (partner >= 0 && gap >= least) continue;
    partner = found->index;
    least = gap;
  }
  return partner;
}

int FibreJoints::partner_of(int i, bool head, const char *who) const
{
  const int partner = partner_at_hand(i, head);
  if (partner < 0)
    rod_error_one(
        lmp,
        "%s: at step " BIGINT_FORMAT " the rod that rod %d, place %d of fibre %d, is joined "
        "to at its %s is not at hand; it is lost, as with too long a time step, or farther away than ghosts reach "
        "(without a pair style: communicate single cutoff R)",
        who, update->ntimestep, atom->tag[i], segments_.place(i), segments_.fibre(i),
        head ? "head" : "tail");
  return partner;
}

std::vector<int> FibreJoints::at(int fibre, int place) const
{
  std::vector<int> found;
  auto it = std::lower_bound(places_.begin(), places_.end(), std::make_pair(fibre, place),
                             [](const Place &a, const std::pair<int, int> &wanted) {
                               return std::make_pair(a.fibre, a.place) < wanted;
                             });
  for (; it != places_.end() && it->fibre == fibre && it->place == place; it++)
    found.push_back(it->index);
  return found;
}

void FibreJoints::list_places()
{
  places_.clear();
  if (!segments_.rows) return;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (segments_.fibre(i) > 0) places_.push_back({segments_.fibre(i), segments_.place(i), i});
  std::sort(places_.begin(), places_.end(), [](const Place &a, const Place &b) {
    return std::tie(a.fibre, a.place, a.index) < std::tie(b.fibre, b.place, b.index);
  });
}

void FibreJoints::find(const char *who)
{
  joints_.clear();
  list_places();
  if (!segments_.rows) return;
  for (int i = 0; i < atom->nlocal; i++) {
    if (segments_.fibre(i) == 0) continue;
    if (segments_.ends(i) & S::kTailJoined) {
      const int partner = partner_of(i, false, who);
      if (partner >= atom->nlocal) joints_.push_back({partner, i});  // else found from its head
    }
    if (segments_.ends(i) & S::kHeadJoined) joints_.push_back({i, partner_of(i, true, who)});
  }
}
