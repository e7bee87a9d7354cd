// SPDX-License-Identifier: GPL-2.0-or-later
// The volume of a convex body from the areas of its plane sections, with a bound on the error.
#pragma once

#include <functional>

namespace spherocylinder {

struct BoundedVolume {
  double value;  // m^3
  double error;  // the true volume is within value -+ error (round-off apart), m^3
};

struct ConvexSections {
  // Area of the section at x, zero outside the body (m^2).
  std::function<double(double)> area;
  // An upper bound on the areas between two x.
  std::function<double(double, double)> largest_area;
  double low, inner, high;  // the body lies between low and high; at inner its area is not zero (m)
};

// By the Brunn-Minkowski theorem the root of the area of parallel sections of a convex body is a
// concave function of their position: between two samples it lies above their chord and below the
// neighbouring chords prolonged. The two give a lower and an upper bound on the volume; intervals
// are halved until the bounds are closer than 2 tolerance max(volume found, least).
BoundedVolume convex_volume(const ConvexSections &sections, double tolerance, double least);

}  // namespace spherocylinder
