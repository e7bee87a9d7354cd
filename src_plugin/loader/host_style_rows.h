// SPDX-License-Identifier: GPL-2.0-or-later
// The rows of host_styles(), a file a kind or several kinds.
#pragma once

#include <vector>

#include "loader/host_styles.h"

namespace spherocylinder {

std::vector<HostStyle> fix_rows();
std::vector<HostStyle> compute_rows();
std::vector<HostStyle> command_rows();  // Command and BuiltIn
std::vector<HostStyle> other_rows();

}  // namespace spherocylinder
