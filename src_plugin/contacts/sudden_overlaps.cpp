// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/sudden_overlaps.h"

#include <cmath>

#include "atom.h"
#include "comm.h"
#include "core/vec3.h"
#include "host/rod_error.h"
#include "lists/joint_shares.h"
#include "parallel/from_all_ranks.h"
#include "update.h"

using namespace LAMMPS_NS;

void SuddenOverlaps::take(Seen &seen)
{
  for (const auto &[i, j, overlap, movable] : seen.deep_) {
    const int id = atom->tag[i], other_id = atom->tag[j];
    if (!allowed_)
      now_.push_back({std::min(id, other_id), std::max(id, other_id), i, j, overlap, movable});
  }
  seen.deep_.clear();
}

// All ranks' deep overlaps of the step before, on each rank.
void SuddenOverlaps::gather_before()
{
  std::vector<int> ids;
  for (const Deep &deep : before_) {
    ids.push_back(deep.id);
    ids.push_back(deep.other_id);
  }
  const std::vector<int> all = from_all_ranks(world, ids);
  before_.clear();
  for (size_t k = 0; k < all.size(); k += 2)
    before_.push_back({all[k], all[k + 1], 0, 0, 0.0, false});
}

bool SuddenOverlaps::was_there(int id, int other_id) const
{
  return std::binary_search(before_.begin(), before_.end(),
                            Deep{std::min(id, other_id), std::max(id, other_id), 0, 0, 0.0, false});
}

// Whether a contact goes on from one with the next segment of either rod's fibre, or may do so where another
// rank only has that one.
bool SuddenOverlaps::goes_on(const Deep &deep, const JointShares &shares) const
{
  const std::array<int, 3> i_or_next = shares.with_neighbours(deep.i),
                           j_or_next = shares.with_neighbours(deep.j);
  for (const int i : i_or_next)
    for (const int j : j_or_next) {
      if (i < 0 || j < 0 || (i == deep.i && j == deep.j)) continue;
      if (was_there(atom->tag[i], atom->tag[j]) || (i >= atom->nlocal && j >= atom->nlocal))
        return true;
    }
  return false;
}

void SuddenOverlaps::end_step(bool migrated, const JointShares *shares)
{
  if (allowed_) return;
  if (migrated && comm->nprocs > 1 && !is_first_) gather_before();
  if (!is_first_ && !(shares && shares->have_changed())) {
    bool sorted = false;
    for (const Deep &deep : now_) {
      if (deep.overlap <= kSudden || !deep.movable) continue;
      if (!sorted) std::sort(before_.begin(), before_.end());
      sorted = true;
      if (was_there(deep.id, deep.other_id) || (shares && goes_on(deep, *shares))) continue;
      end_run(deep);
    }
  }
  is_first_ = false;
  before_.swap(now_);
  now_.clear();
}

void SuddenOverlaps::end_run(const Deep &found) const
{
  using namespace spherocylinder;
  const double diameter = atom->shape[found.i][0] + atom->shape[found.j][0];
  const double way = update->dt * norm(load(atom->v[found.i]) - load(atom->v[found.j])) / diameter;
  rod_error_one(
      lmp,
      "Pair gran with surface spherocylinder: rods %d and %d overlap by %g of the diameter "
      "at step " BIGINT_FORMAT " and hardly touched in the step before, so that some command "
      "or fix has put one of them there (by their velocities they come %g diameters nearer "
      "in a step); wanted at most %g at once, or sudden_overlap on in pair_style",
      found.id, found.other_id, found.overlap, update->ntimestep, way, kSudden);
}
