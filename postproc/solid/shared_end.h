// SPDX-License-Identifier: GPL-2.0-or-later
// What two neighbours of a fibre have in common about the end they share.
#pragma once

#include "core/capsule.h"
#include "solid/convex_integral.h"

namespace spherocylinder {

// Angle between the axes, 0 in line (rad).
double bend_angle(const Vec3 &axis, const Vec3 &next);

// The volume that both have in common, the head of `a` at the tail of `b`, of one radius r.
//
// At a bend theta they share the ball about the end, but for a wedge of the angle theta on the
// inner side. There the two tubes share, on either side of the plane half-way between them, what
// the other tube has up to that plane: y tan(theta/2) long at the depth y, together
//   (4/3) r^3 tan(theta/2).
// So V = (4/3) pi r^3 (1 - theta/(2 pi)) + (4/3) r^3 tan(theta/2), the ball in line, as long as both
// cylinders are longer than r tan(theta/2). An end that is drawn away by d along the mean axis takes
// pi r^2 d off. Sharper bends of short segments, and ends further apart than 0.02 r, are left to
// overlap_volume. The error: of what ends that are apart across the axis do.
BoundedVolume shared_end_volume(const Capsule &a, const Capsule &b);

}  // namespace spherocylinder
