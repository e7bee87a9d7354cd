// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/fibre_partings.h"

#include <algorithm>

#include "atom.h"
#include "core/closest_points.h"
#include "lists/fibre_joints.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

using S = FibreSegments;

}  // namespace

EndsChange EndsChange::broken(const FibreSegments &segments, int first, int second)
{
  return {segments.fibre(first),
          {segments.place(first), S::kHeadJoined, S::kHeadParts | S::kHeadBroken},
          {segments.place(second), S::kTailJoined, 0}};
}

void FibrePartings::find(const FibreJoints &joints, const FibreSegments &segments)
{
  pairs_.clear();
  if (!segments.rows) return;
  const auto add = [&](int i, int place, int of_first, int of_second) {
    const int fibre = segments.fibre(i);
    std::vector<int> seconds = joints.at(fibre, place);
    // Next but one: only where one of the two joints between has gone.
    const bool is_open = (segments.ends(i) & S::kHeadJoined) == 0 ||
                         std::any_of(seconds.begin(), seconds.end(), [&](int k) {
                           return (segments.ends(k) & S::kTailJoined) == 0;
                         });
    if (!is_open) return;
    pairs_.push_back(
        {i, seconds, {fibre, {segments.place(i), of_first, 0}, {place, of_second, 0}}});
  };
  for (int i = 0; i < atom->nlocal; i++) {
    if (!segments.is_segment(i)) continue;
    const int ends = segments.ends(i), place = segments.place(i);
    const bool closes = (ends & S::kHeadCloses) != 0;
    if (ends & S::kHeadParts) add(i, closes ? 1 : place + 1, S::kHeadParts, 0);
    if (ends & S::kHeadPasses) add(i, place + 2, S::kHeadPasses, S::kTailPasses);
    if (ends & S::kHeadPassesRing) add(i, closes ? 2 : 1, S::kHeadPassesRing, S::kTailPassesRing);
  }
}

void FibrePartings::add_ghosts(std::vector<int> &ghosts) const
{
  for (const Pair &pair : pairs_)
    for (const int k : pair.seconds)
      if (k >= atom->nlocal) ghosts.push_back(k);
}

// Of a rod that is not at hand, all images are farther away than any that touches.
bool FibrePartings::are_apart(const Pair &pair) const
{
  const auto &rods = static_cast<const AtomVecSpherocylinder &>(*atom->avec);
  const Capsule first = rods.capsule(pair.first);
  return std::all_of(pair.seconds.begin(), pair.seconds.end(), [&](int k) {
    const Capsule second = rods.capsule(k);
    const double touching = first.radius + second.radius;
    return closest_points(first.segment, second.segment).distance_squared > touching * touching;
  });
}

void FibrePartings::add_parted(std::vector<EndsChange> &changes) const
{
  for (const Pair &pair : pairs_)
    if (are_apart(pair)) changes.push_back(pair.change);
}
