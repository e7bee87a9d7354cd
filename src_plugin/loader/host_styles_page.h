// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace spherocylinder {

// The text of docs/with_liggghts.md.
std::string host_styles_page();

}  // namespace spherocylinder
