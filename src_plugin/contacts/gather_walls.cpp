// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/gather_walls.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "comm.h"
#include "contacts/rod_kinds.h"
#include "fix_wall_gran.h"
#include "host/rod_error.h"
#include "parallel/ask_ranks.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

double LAMMPS_NS::coupling_of_ends(const RodEnds &ends, double radius,
                                   const InverseInertia &inverse)
{
  if (ends.count < 2) return 0.0;
  const EndContact &one = ends.contacts[0], &other = ends.contacts[1];
  const double a = radius - one.distance, b = radius - other.distance;
  if (!(a > 0.0) || !(b > 0.0)) return 0.0;
  const double cosine = std::max(0.0, dot(one.normal, other.normal));
  const double shared = std::min(a, b) / std::max(a, b) * cosine;
  if (shared == 0.0) return 0.0;
  return shared * mass_coupling(inverse, ends.arms[0], one.normal, ends.arms[1], other.normal);
}

void WallGatherer::begin(const FixWallGran &fix, bool effective_mass, bool spread,
                         bool types_are_kinds, const JointShares *shares)
{
  shares_ = shares;
  spread_ = spread;
  types_are_kinds_ = types_are_kinds;
  fix_ = &fix;
  wall_type_ = fix.atom_type_wall();
  turning_ = effective_mass ? 1.0 : 0.0;
  avec_ = static_cast<const AtomVecSpherocylinder *>(atom->avec);
  v_ = atom->v;
  omega_ = atom->omega;
  inertia_ = atom->inertia;
  mass_ = atom->rmass;
  type_ = atom->type;
}

EndShares WallGatherer::shares_of_ends(int i) const
{
  return {shares_->of_end(i, false, fix_->groupbit), shares_->of_end(i, true, fix_->groupbit)};
}

JointShares::Share WallGatherer::share_outside(const WallSurface &surface, int i,
                                               const Capsule &rod,
                                               const ClosestPoints &closest) const
{
  return shares_->of_rod(i, rod, closest.s, surface.axis_beside(rod.segment),
                         surface.radius + rod.radius, fix_->groupbit);
}

void WallGatherer::hand_over_outside(const WallSurface &surface, const std::vector<int> &rods,
                                     double **history, int values) const
{
  const auto is_empty = [values](const double *of_end) {
    return std::all_of(of_end, of_end + values, [](double value) { return value == 0.0; });
  };
  struct Open {
    int rod, count;
  };
  std::vector<Open> open;  // whose neighbour another rank has
  std::vector<int> asked;
  for (const int i : rods) {
    const Capsule rod = avec_->capsule(i);
    if (!surface.is_outside(rod.segment.centre) || !is_empty(history[i])) continue;
    const ClosestPoints closest = surface.closest_at_outside(rod.segment);
    const double reach = surface.radius + rod.radius;
    if (closest.distance_squared > reach * reach) continue;
    if (!(share_outside(surface, i, rod, closest).share > 0.0)) continue;
    int count = 0;
    for (const bool head : {false, true}) {
      if (!shares_->is_near_joint(i, rod, closest.s, head, rod.segment.half_length)) continue;
      const int next = shares_->neighbour(i, head);
      if (!(atom->mask[next] & fix_->groupbit)) continue;
      if (next >= atom->nlocal) {
        asked.push_back(atom->tag[next]);
        count++;
      } else if (!is_empty(history[next])) {
        std::copy_n(history[next], values, history[i]);
      }
    }
    if (count > 0) open.push_back({i, count});
  }
  if (comm->nprocs == 1) return;
  const Answers answers = ask_ranks(world, asked, 1, values, [&](const int *id, double *out) {
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->tag[i] == *id) {
        std::copy_n(history[i], values, out);
        return !is_empty(out);
      }
    return false;
  });
  int question = 0;
  for (const Open &one : open)
    for (int n = 0; n < one.count; n++, question++)
      if (const double *from = answers.of(question)) std::copy_n(from, values, history[one.rod]);
}

bool WallGatherer::add_outside(ContactBatch &batch, const MovingWall &wall, int i,
                               const Capsule &rod, double *history) const
{
  constexpr double kRounding = 1e-9;  // over the cylinder's radius
  ClosestPoints closest = wall.surface.closest_at_outside(rod.segment);
  const double nearest = std::sqrt(closest.distance_squared) - wall.surface.radius;
  if (nearest > rod.radius) return false;
  if (nearest < -kRounding * wall.surface.radius)
    rod_error_one(
        lmp,
        "Fix wall/gran (id %s): the axis of rod %d is across the cylinder at step " BIGINT_FORMAT
        ": %g below its surface, with its centre outside; wanted a rod inside or outside",
        fix_->id, atom->tag[i], update->ntimestep, -nearest);
  JointShares::Share at_joint;
  if (shares_) {
    at_joint = share_outside(wall.surface, i, rod, closest);
    if (at_joint.share == 0.0) return false;
  }
  const double beyond = at_joint.beyond;
  const Capsule reaching = {extended(rod.segment, beyond), rod.radius};
  if (beyond != 0.0) closest = wall.surface.closest_at_outside(reaching.segment);
  const RodContact touch =
      moved(wall.surface.contact_at_outside(reaching, closest, spread_), 0.5 * beyond, 0.0);
  const double from_axis = std::sqrt(touch.points.distance_squared);
  const Vec3 arm = touch.points.s * rod.segment.axis;
  const EndContact contact = {from_axis - wall.surface.radius,
                              (1.0 / from_axis) * touch.points.delta,
                              wall.surface.radial(rod.segment.centre + arm)};
  const int k = add_contact(batch, wall, i, rod, arm, contact, inverse_of(i), history);
  if (shares_) batch.weight[k] = at_joint.share;
  batch.arms.overlap[k] = touch.overlap;
  batch.arms.mass_share[k] = touch.share;
  batch.spread[batch.spread_count++] = {k, touch.sideways, touch.couple_i, touch.couple_j};
  if (at_joint.share < 1.0) {
    const Vec3 push = (1.0 / at_joint.share) * at_joint.push;
    batch.spread[batch.spread_count++] = {k, push, -cross(touch.points.delta, push), kZero};
  }
  return true;
}
