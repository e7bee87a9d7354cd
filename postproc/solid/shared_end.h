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
// cylinders are longer than r tan(theta/2). An end that is drawn away by d along the mean axis takes d
// times what both have in the plane half-way off, a half disc and half an ellipse,
// (pi r^2/2)(1 + 1/cos(theta/2)). The error is that of ends d apart in any direction: on the outer
// side both are the same sphere over the angle theta, whose area 2 theta r^2 can lose up to d; in line
// discs sqrt(2 r d) deep lose a rim of d. Where it exceeds r^3/1000, and in sharp bends of short
// segments, overlap_volume finds the volume.
BoundedVolume shared_end_volume(const Capsule &a, const Capsule &b);

}  // namespace spherocylinder
