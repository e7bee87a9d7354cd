// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "vec3.h"

namespace spherocylinder {

// Largest |x|, |y| and |z| of `count` vectors, as LIGGGHTS keeps them: x y z x y z ...; zero of
// none. Values that are no numbers make them any number or none.
Vec3 largest_components(const double *rows, int count);

}  // namespace spherocylinder
