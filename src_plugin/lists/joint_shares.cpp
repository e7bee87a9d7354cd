// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/joint_shares.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atom.h"
#include "core/closest_points.h"
#include "neighbor.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/fibre_segments.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

const FibreSegments &segments_of(const Atom &atom)
{
  return static_cast<AtomVecSpherocylinder &>(*atom.avec).attached<FibreSegments>();
}

double distance(const Segment &a, const Segment &b)
{
  return std::sqrt(closest_points(a, b).distance_squared);
}

// Of one axis, from its point at s, all that may lie nearer than `reach` to the line of the other, nearest at t (m): a
// patch is a part of it. Without bound where an end is nearest, or along parallel axes.
double half_chord(const Segment &rod, double s, const Segment &other, double t, double reach)
{
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  constexpr double kRounding = 1.0 + 1e-6;
  if (!(std::fabs(s) < rod.half_length && std::fabs(t) < other.half_length)) return kInfinite;
  const double cosine = dot(rod.axis, other.axis), squared_sine = 1.0 - cosine * cosine;
  const double squared = reach * reach - norm_squared(rod.at(s) - other.at(t));
  if (!(squared_sine > 1e-6)) return kInfinite;
  return kRounding * std::sqrt(std::max(0.0, squared) / squared_sine);
}

}  // namespace

bool JointShares::bring_up_to_date()
{
  segments_ = &segments_of(*atom);
  const FibreSegments &segments = *segments_;
  if (!segments.rows) return false;
  const Seen now = {neighbor->ncalls, neighbor->lastcall, atom->nlocal, atom->nghost,
                    segments.changes};
  if (segments.changes != seen_.changes) changed_step_ = update->ntimestep;
  // A command may have changed rods before a run.
  const Update &step = *update;
  const bool run_begins = step.setupflag || step.ntimestep <= step.firststep + 1;
  if (!run_begins && now.builds == seen_.builds && now.last_build == seen_.last_build &&
      now.rods == seen_.rods && now.ghosts == seen_.ghosts && now.changes == seen_.changes)
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
  const double of_joint = share_at_joint(own, of_next, longest);
  const double before = share.share;
  share.share *= of_joint;
  share.push = of_joint * share.push;
  if (share.share == 0.0) return;
  // Positions inwards of the two ends; where one is at its end, it reaches on to the other's.
  const ClosestPoints nearest = closest_points(next, other);
  const double within = half - (head ? s : -s);
  const double within_next = next.half_length + (head ? nearest.s : -nearest.s);
  double beyond_next = 0.0;
  const double sine = norm(cross(rod.segment.axis, next.axis));
  if (!(within > 0.0)) {
    const double beyond = reach_beyond_joint(own, of_next, longest, within_next, sine,
                                             reach - distance(rod.segment, other));
    if (beyond > 0.0) share.beyond = head ? beyond : -beyond;
  } else if (!(within_next > 0.0)) {
    beyond_next = reach_beyond_joint(of_next, own, longest, within, sine,
                                     reach - std::sqrt(nearest.distance_squared));
  }
  const ShareSlope slope = slope_of_share(own, of_next, longest);
  if (slope.fall == 0.0) return;
  const ClosestPoints points = closest_points(extended(rod.segment, share.beyond), other);
  const ClosestPoints points_next =
      closest_points(extended(next, head ? -beyond_next : beyond_next), other);
  const auto square = [reach](const ClosestPoints &at) {
    const double overlap = std::max(0.0, reach - std::sqrt(at.distance_squared));
    return overlap * overlap;
  };
  // E = k/2 (w d^2 + w' d'^2), both of which change as the mean moves, or either as its own does.
  const double squares =
      square(points) - 0.5 * (1.0 - slope.by_own) * (square(points) + square(points_next));
  const bool at_end = std::fabs(points.t) >= other.half_length;
  const Vec3 outward = (head ? 1.0 : -1.0) * rod.segment.axis;
  share.push = share.push -
               (0.5 * before * slope.fall * squares) * advance_on_line(outward, other, own, at_end);
}

JointShares::Share JointShares::of_one(int i, int j, const std::vector<Capsule> &rods, double s,
                                       double t) const
{
  const double reach = rods[i].radius + rods[j].radius;
  const Segment &other = rods[j].segment;
  Share share;
  const double half = half_chord(rods[i].segment, s, other, t, reach);
  for (const bool head : {false, true})
    if (is_near_joint(i, rods[i], s, head, other.half_length) &&
        half >= rods[i].segment.half_length - (head ? s : -s) &&
        !segments_->never_touch(neighbours_[i][head], j))
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
