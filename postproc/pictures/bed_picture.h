// SPDX-License-Identifier: GPL-2.0-or-later
// A picture of a bed of rods, drawn off-screen. Needs an X display (see pictures/display.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "io/rods.h"
#include "measures/rod_quantity.h"
#include "pictures/view.h"
#include "solid/clipped_volume.h"

namespace spherocylinder {

using Box = std::array<std::array<double, 2>, 3>;  // lower and upper bound in x, y, z (m)

struct DrawnVessel {
  UprightCylinder cylinder;  // as much as is to be drawn, in the vessel's own frame
  int axis = 2;              // x, y or z of space along which that frame's z runs
  bool goes_on_below = false, goes_on_above = false;  // beyond the ends of what is drawn
};

struct DrawnMesh {
  enum class Kind {
    Walls,  // to be looked through, without those between the viewer and the rods
    Floor,  // the same, but for a level plane below the rods: darker
    Body,   // seen from outside
  };
  Kind kind;
  vtkSmartPointer<vtkPolyData> surface;
};

struct PictureOptions {
  int width = 1200, height = 900;  // pixels
  View view = View::Oblique;
  double background[3] = {1.0, 1.0, 1.0};
  std::optional<DrawnVessel> vessel;
  std::optional<Box> box;         // its edges are drawn
  std::vector<DrawnMesh> meshes;  // the picture is aimed at them too
  std::optional<Extent> seen;     // the picture is aimed at this too
  bool aim_at_rods = true;        // else at vessel, box and what is seen, wherever the rods are
  std::string caption;
  int font_size = 0;  // pixels; 0: as large as fits
  bool colour_bar = true;
  int resolution = 16;  // corners around a rod
  bool blend = true;    // colours of a fibre's segments into each other
};

// The corners of the box.
std::array<Vec3, 8> corners_of(const Box &box);

// Parallel projection, so that the scale bar holds everywhere; the part in front of the rods is
// cut off the vessel's wall and those of meshes. There may be no rods if the picture is aimed at something else. Writes
// a PNG. Throws InputError if the letters leave no room, if the graphics driver cannot draw so
// large a picture, or if the file cannot be written.
void write_bed_picture(const std::string &path, const std::vector<Rod> &rods, const Fibres &fibres,
                       const RodQuantity &colour, const PictureOptions &options);

}  // namespace spherocylinder
