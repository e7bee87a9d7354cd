// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/rod_shifts.h"

#include <limits>

#include "atom.h"
#include "update.h"

using namespace LAMMPS_NS;

double RodShifts::farthest(double half_length)
{
  const size_t rods = atom->nlocal;
  if (positions_.size() != 3 * rods) return std::numeric_limits<double>::infinity();
  if (rods == 0) return 0.0;
  // In the first step of a run rods may have been moved since the last, which had the same number.
  if (step_ != update->ntimestep || update->setupflag)
    shift_ = spherocylinder::largest_shift(atom->x[0], positions_.data(), atom->quaternion[0],
                                           quaternions_.data(), atom->nlocal);
  step_ = update->ntimestep;
  return shift_.centre + half_length * shift_.orientation;
}

bool RodShifts::are_kept_in_this_step() const
{
  return step_ == update->ntimestep && !update->setupflag &&
         positions_.size() == 3 * static_cast<size_t>(atom->nlocal) && shift_.centre == 0.0 &&
         shift_.orientation == 0.0;
}

void RodShifts::keep_poses()
{
  if (are_kept_in_this_step()) return;
  version_++;
  const int rods = atom->nlocal;
  step_ = update->ntimestep;
  shift_ = {0.0, 0.0};
  positions_.clear();
  quaternions_.clear();
  if (rods == 0) return;
  positions_.assign(atom->x[0], atom->x[0] + 3 * rods);
  quaternions_.assign(atom->quaternion[0], atom->quaternion[0] + 4 * rods);
}
