// SPDX-License-Identifier: GPL-2.0-or-later
// The two solid fractions of a bed of rods in an upright cylindrical vessel.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "io/rods.h"
#include "solid/clipped_volume.h"

namespace spherocylinder {

class ClosedMesh;

struct Vessel {
  double x = 0.0, y = 0.0;  // of its axis (m)
  double radius = 0.0;      // m
  double floor = 0.0;       // height of the floor (m)
};

// What the user sets of the inner cylinder; the rest follows from the bed.
struct InnerOverride {
  std::optional<double> radius, bottom, top;  // m
};

struct SolidFraction {
  UprightCylinder region;
  double fraction;
  double error;  // bound on the error of the fraction
};

struct BedHeight {
  double highest_centre;  // z of the highest rod's centre (m)
  double highest_point;   // z of the highest point of any rod (m)
};

BedHeight bed_height(const std::vector<Rod> &rods);

// Rods whose centre is outside the vessel's wall or below its floor.
std::size_t count_outside(const std::vector<Rod> &rods, const Vessel &vessel);

// Volume of all rods, whole (m^3).
double total_volume(const std::vector<Rod> &rods);

// The vessel from its floor up to `top`.
UprightCylinder vessel_up_to(const Vessel &vessel, double top);

// Concentric with `whole`, at its mid-height, radius and height both 2^(-1/3) of it: half its
// volume, clear of wall, floor and free surface.
UprightCylinder inner_half(const UprightCylinder &whole);

// Solid within the region, to within `tolerance` of it or of each rod that is cut, whichever is
// looser.
BoundedVolume solid_within(const std::vector<Rod> &rods, const UprightCylinder &region,
                           double tolerance);
BoundedVolume solid_within(const std::vector<Rod> &rods, const UprightBox &region,
                           double tolerance);
BoundedVolume solid_within(const std::vector<Rod> &rods, const ClosedMesh &region,
                           double tolerance);

// Solid within the region over the region's volume, to within `tolerance` of the fraction or of
// each rod that is cut, whichever is looser: the error says.
SolidFraction solid_fraction(const std::vector<Rod> &rods, const UprightCylinder &region,
                             double tolerance);

}  // namespace spherocylinder
