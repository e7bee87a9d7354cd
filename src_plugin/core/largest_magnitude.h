// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace spherocylinder {

// Largest |value| of many; 0 of none. Values that are no numbers make it any number or none.
double largest_magnitude(const double *values, int count);

}  // namespace spherocylinder
