// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "atom.h"

namespace LAMMPS_NS {

// What keyword aspect_scaling multiplies a contact's stiffness by: the rod's aspect ratio, of two rods
// the harmonic mean, as of two springs in series. j < 0: a wall.
inline double aspect_scale(const Atom &atom, int i, int j)
{
  const auto aspect_ratio = [&](int rod) { return atom.shape[rod][2] / atom.shape[rod][0]; };
  const double own = aspect_ratio(i);
  if (j < 0) return own;
  const double other = aspect_ratio(j);
  return 2.0 * own * other / (own + other);
}

}  // namespace LAMMPS_NS
