// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/joint_shares.h"

#include "atom.h"
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

// A contact that is a radius from the joint is all of its rod (core/joint_share.h).
bool JointShares::is_near_joint(int i, const Capsule &rod, double s, bool head) const
{
  if (neighbours_[i][head] < 0) return false;
  return rod.segment.half_length - (head ? s : -s) < rod.radius;
}

double JointShares::at_end(int i, bool head, const Capsule &rod, const Segment &other,
                           double reach) const
{
  const LinePatch own = patch_on_line(line_through_end(rod.segment, head), other, reach);
  if (is_all_before_joint(own, rod.radius)) return 1.0;
  const int next = neighbours_[i][head];
  const Capsule beyond = static_cast<const AtomVecSpherocylinder &>(*atom->avec).capsule(next);
  // Which end of it is joined: the tail to this one's head, in a ring as well.
  const EndLine line = line_through_end(beyond.segment, !head);
  return share_at_joint(own, patch_on_line(line, other, reach), rod.radius);
}

double JointShares::of_pair(int i, int j, const std::vector<Capsule> &rods, double s,
                            double t) const
{
  const FibreSegments &segments = segments_of(*atom);
  const double reach = rods[i].radius + rods[j].radius;
  const auto of_one = [&](int own, int other, double at) {
    double share = 1.0;
    for (const bool head : {false, true})
      if (is_near_joint(own, rods[own], at, head) &&
          !segments.never_touch(neighbours_[own][head], other))
        share *= at_end(own, head, rods[own], rods[other].segment, reach);
    return share;
  };
  return of_one(i, j, s) * of_one(j, i, t);
}

double JointShares::of_rod(int i, const Capsule &rod, double s, const Segment &other, double reach,
                           int groupbit) const
{
  double share = 1.0;
  for (const bool head : {false, true})
    if (is_near_joint(i, rod, s, head) && (atom->mask[neighbours_[i][head]] & groupbit))
      share *= at_end(i, head, rod, other, reach);
  return share;
}

double JointShares::of_end(int i, bool head, int groupbit) const
{
  const int next = neighbours_[i][head];
  return next >= 0 && (atom->mask[next] & groupbit) ? 0.5 : 1.0;
}
