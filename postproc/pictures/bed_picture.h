// SPDX-License-Identifier: GPL-2.0-or-later
// A picture of a bed of rods, drawn off-screen. Needs an X display (see pictures/display.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/clipped_volume.h"
#include "analysis/rod_quantity.h"
#include "analysis/rods.h"

namespace spherocylinder {

enum class View {
  side,     // along +y, level
  top,      // straight down, x to the right
  oblique,  // from the front right, 25 degrees above the horizontal
};

using Box = std::array<std::array<double, 2>, 3>;  // lower and upper bound in x, y, z (m)

struct PictureOptions {
  int width = 1200, height = 900;  // pixels
  View view = View::oblique;
  double background[3] = {1.0, 1.0, 1.0};
  std::optional<UprightCylinder> vessel;  // as much of it as is to be drawn
  bool vessel_goes_on = false;  // above what is drawn
  bool only_vessel = false;     // the picture is aimed at the vessel, wherever the rods are
  std::optional<Box> box;       // its edges are drawn
  std::string caption;
  int font_size = 0;  // pixels; 0: as large as fits
  bool colour_bar = true;
  int resolution = 16;  // corners around a rod
};

// Unit vector from what is seen towards the viewer.
Vec3 towards_viewer(View view);

// Parallel projection, so that the scale bar holds everywhere; the part in front of the rods is
// cut off the vessel's wall. There may be no rods if the picture is aimed at the vessel. Writes a
// PNG. Throws InputError if the letters leave no room, if the graphics driver cannot draw so large
// a picture, or if the file cannot be written.
void write_bed_picture(const std::string &path, const std::vector<Rod> &rods,
                       const RodQuantity &colour, const PictureOptions &options);

}  // namespace spherocylinder
