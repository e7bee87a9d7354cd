// SPDX-License-Identifier: GPL-2.0-or-later
// How much of a rod lies below a horizontal plane: a closed form.
#pragma once

#include "core/capsule.h"

namespace spherocylinder {

// Volume of the rod below z = height; 0 if it lies above, all of it if below.
double volume_below(const Capsule &capsule, double height);

}  // namespace spherocylinder
