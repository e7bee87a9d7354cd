// SPDX-License-Identifier: GPL-2.0-or-later
// VTK aborts the process if it cannot reach an X display, even to draw off-screen.
#pragma once

#include <string>

namespace spherocylinder {

// Returns if an X display can be reached. Otherwise starts this program again, with the same
// arguments, under xvfb-run (a display without a screen) and does not return. Throws InputError if
// that is not installed or does not help.
void need_display(char **argv);

// Whether a folder of PATH holds this program.
bool is_on_path(const std::string &program);

}  // namespace spherocylinder
