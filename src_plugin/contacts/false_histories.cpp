// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/false_histories.h"

#include <algorithm>

#include "atom.h"
#include "contacts/rod_pair_geometry.h"
#include "host/rod_error.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Of p - q, over the sum of the radii. In one step of a contact that is not warned about for its step
// or overlap p - q moves by less than 0.2 (see kSuddenOverlap).
constexpr double kFarthestMove = 0.5;

}  // namespace

void FalseHistories::drop(const TouchingRodPairs &touching, const std::vector<Capsule> &rods,
                          int **flags, double **histories, int dnum, int side_offset)
{
  touching.for_each([&](const TouchingRodPairs::Touch &touch) {
    if (!flags[touch.i][touch.index]) return;
    double *history = &histories[touch.i][dnum * touch.index];
    const Vec3 side = load(history + side_offset);
    if (norm_squared(side) == 0.0) return;
    const double reach = rods[touch.i].radius + rods[touch.j].radius;
    const double moved = norm(touch.points.delta - remembered_delta(side, reach));
    if (moved <= kFarthestMove * reach) return;
    flags[touch.i][touch.index] = 0;
    std::fill_n(history, dnum, 0.0);
    if (!warned_) warn(touch.i, touch.j);
  });
}

void FalseHistories::warn(int i, int j)
{
  warned_ = true;
  rod_warning(lmp,
              "Rod contacts: at step " BIGINT_FORMAT " the contact history of rods %d and %d does "
              "not belong to where they are, as after a command that moved or renamed one of them; "
              "it is dropped, and so are others like it",
              update->ntimestep, std::min(atom->tag[i], atom->tag[j]),
              std::max(atom->tag[i], atom->tag[j]));
}
