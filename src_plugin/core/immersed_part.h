// SPDX-License-Identifier: GPL-2.0-or-later
// The part of a rod below a level surface.
#pragma once

#include "core/capsule.h"

namespace spherocylinder {

struct ImmersedPart {
  double volume;  // m^3
  Vec3 centroid;  // from the rod's centre, space frame (m); 0 where nothing is immersed
};

// The part of the rod on the side of the plane through `surface * up` that `up`, a unit vector,
// points away from.
//
// The rod is cut into discs across its axis. On the disc at s from the centre, whose own centre is
// H(s) above the surface, the immersed part is the circular segment below the chord at
// t = -H/sin(tilt) from the disc's centre, with tilt the angle between axis and `up`:
//   area   rho^2 (pi/2 + asin(t/rho)) + t sqrt(rho^2 - t^2)
//   moment -2/3 (rho^2 - t^2)^(3/2) along the steepest line of the disc
// Their integrals over s are exact to about 1e-9 of the rod's volume (Gauss-Legendre between the
// places where the chord enters or leaves the discs).
ImmersedPart immersed_part(const Capsule &rod, const Vec3 &up, double surface);

}  // namespace spherocylinder
