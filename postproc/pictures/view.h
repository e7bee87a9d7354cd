// SPDX-License-Identifier: GPL-2.0-or-later
// Where a picture is looked at from, and what lies in it.
#pragma once

#include <vector>

#include "io/rods.h"

class vtkPolyData;

namespace spherocylinder {

enum class View {
  Side,     // along +y, level
  Top,      // straight down, x to the right
  Oblique,  // from the front right, 25 degrees above the horizontal
};

struct ViewFrame {
  Vec3 right, up, towards;  // unit, orthogonal; `towards` the viewer
};

ViewFrame frame_of(View view);

// Bounding box of what is to be seen, along the picture's own directions.
class Extent {
 public:
  explicit Extent(View view);

  void include(const Vec3 &point, double radius = 0.0);
  void include(const std::vector<Rod> &rods);
  void include(vtkPolyData *mesh);
  void include(const Extent &other);  // of the same view

  bool is_empty() const { return low_[0] > high_[0]; }
  double size(int i) const { return high_[i] - low_[i]; }  // right, up, towards (m)
  double middle(int i) const { return 0.5 * (low_[i] + high_[i]); }

 private:
  ViewFrame frame_;
  double low_[3], high_[3];
};

}  // namespace spherocylinder
