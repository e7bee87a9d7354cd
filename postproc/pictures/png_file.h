// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

class vtkRenderWindow;

namespace spherocylinder {

// Writes what the window shows, averaged down by `shrink` each way. Throws InputError if the file
// cannot be written.
void write_png(vtkRenderWindow *window, const std::string &path, int shrink = 1);

}  // namespace spherocylinder
