// SPDX-License-Identifier: GPL-2.0-or-later
// Of one rod. Space frame, metres.
#pragma once

#include "core/capsule.h"

namespace spherocylinder {

// Angle of the axis above the horizontal, 0 to pi/2 (rad).
double elevation(const Vec3 &axis);

double volume(const Capsule &capsule);         // m^3
double highest_point(const Capsule &capsule);  // z (m)

}  // namespace spherocylinder
