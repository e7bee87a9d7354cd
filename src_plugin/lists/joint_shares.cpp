// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/joint_shares.h"

#include <algorithm>

#include "atom.h"
#include "core/closest_points.h"
#include "neighbor.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/fibre_segments.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

const FibreSegments &segments_of(const Atom &atom)
{
  return static_cast<AtomVecSpherocylinder &>(*atom.avec).attached<FibreSegments>();
}

}  // namespace

bool JointShares::bring_up_to_date()
{
  const FibreSegments &segments = segments_of(*atom);
  if (!segments.rows) return false;
  const Seen now = {neighbor->ncalls, neighbor->lastcall, atom->nlocal, atom->nghost,
                    segments.changes};
  if (now.builds == seen_.builds && now.last_build == seen_.last_build && now.rods == seen_.rods &&
      now.ghosts == seen_.ghosts && now.changes == seen_.changes)
    return true;
  seen_ = now;
  joints_.list_places();
  const int nall = atom->nlocal + atom->nghost;
  neighbours_.assign(nall, {-1, -1});
  for (int i = 0; i < nall; i++) {
    if (segments.fibre(i) == 0) continue;
    const int ends = segments.ends(i);
    if (ends & FibreSegments::kTailJoined) neighbours_[i][0] = joints_.partner_at_hand(i, false);
    if (ends & FibreSegments::kHeadJoined) neighbours_[i][1] = joints_.partner_at_hand(i, true);
  }
  return true;
}

// A contact that is farther from the joint is all of its rod (core/joint_share.h).
bool JointShares::is_near_joint(int i, const Capsule &rod, double s, bool head, double other) const
{
  if (neighbours_[i][head] < 0) return false;
  const double half = rod.segment.half_length;
  return half - (head ? s : -s) < std::min(half, other) + rod.radius;
}

void JointShares::share_at_end(Share &share, int i, bool head, const Capsule &rod, double s,
                               const Segment &other, double reach) const
{
  const double half = rod.segment.half_length;
  const LinePatch own = patch_on_line(line_through_end(rod.segment, head), other, reach);
  if (is_all_before_joint(own, longest_shared(half, half, other.half_length, rod.radius))) return;
  // In a ring as well, a tail is joined to the head.
  const Segment next =
      static_cast<const AtomVecSpherocylinder &>(*atom->avec).capsule(neighbours_[i][head]).segment;
  const LinePatch of_next = patch_on_line(line_through_end(next, !head), other, reach);
  const double longest = longest_shared(half, next.half_length, other.half_length, rod.radius);
  share.share *= share_at_joint(own, of_next, longest);
  if (share.share == 0.0 || (head ? s : -s) < half) return;
  const double along = closest_points(next, other).s;
  const double beyond =
      reach_beyond_joint(own, of_next, longest, next.half_length + (head ? along : -along));
  if (beyond > 0.0) share.beyond = head ? beyond : -beyond;
}

JointShares::Share JointShares::of_one(int i, int j, const std::vector<Capsule> &rods,
                                       double s) const
{
  const FibreSegments &segments = segments_of(*atom);
  const double reach = rods[i].radius + rods[j].radius;
  const Segment &other = rods[j].segment;
  Share share;
  for (const bool head : {false, true})
    if (is_near_joint(i, rods[i], s, head, other.half_length) &&
        !segments.never_touch(neighbours_[i][head], j))
      share_at_end(share, i, head, rods[i], s, other, reach);
  return share;
}

JointShares::Share JointShares::of_rod(int i, const Capsule &rod, double s, const Segment &other,
                                       double reach, int groupbit) const
{
  Share share;
  for (const bool head : {false, true})
    if (is_near_joint(i, rod, s, head, other.half_length) &&
        (atom->mask[neighbours_[i][head]] & groupbit))
      share_at_end(share, i, head, rod, s, other, reach);
  return share;
}

double JointShares::of_end(int i, bool head, int groupbit) const
{
  const int next = neighbours_[i][head];
  return next >= 0 && (atom->mask[next] & groupbit) ? 0.5 : 1.0;
}
