// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <limits>

namespace spherocylinder {

// Of all constants these three are written as in formulas, the others as kName.
constexpr double pi = 3.14159265358979323846;
constexpr double degrees = 57.295779513082321;  // in a radian

// No value: an empty field of a table.
constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace spherocylinder
