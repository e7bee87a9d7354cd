// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace spherocylinder {

// The skin of a list of near rods that costs least, from what the present one costs.
//
// Rods in random places have neighbours nearer than g in proportion to D + g, so that what is done
// for each pair costs a (D + skin); what is done when a rod has moved through the skin beyond
// `least`, where it is of use, costs b / (skin - least). The sum is smallest at least + sqrt(b/a).
// One call changes the free part of the skin by a factor two at most; nothing done, nothing changed.
// `per_pair`, `per_move`: both costs in the same span of time, any unit. Lengths in m.
inline double better_skin(double skin, double least, double diameter, double per_pair,
                          double per_move)
{
  const double free = skin - least;
  const double a = per_pair / (diameter + skin), b = per_move * free;
  if (!(a > 0.0)) return b > 0.0 ? skin + free : skin;
  return least + std::clamp(std::sqrt(b / a), 0.5 * free, 2.0 * free);
}

}  // namespace spherocylinder
