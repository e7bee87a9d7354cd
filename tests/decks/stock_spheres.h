// SPDX-License-Identifier: GPL-2.0-or-later
// Rods of length = diameter as the stock liggghts reads them.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace decks {

// A data file of LIGGGHTS's atom_style granular, which has no length and no axis, in a cube from `low` to `high`
// (m).
std::string granular_data_file(const std::vector<Rod> &balls, double low, double high);

}  // namespace decks
