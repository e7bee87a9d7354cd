// SPDX-License-Identifier: GPL-2.0-or-later
// How the solid of a bed is spread over layers, shells and all that lies near a wall.
#pragma once

#include <vector>

#include "io/rods.h"
#include "solid/clipped_volume.h"

namespace spherocylinder {

class ClosedMesh;

// Solid below each of the heights, which rise (m^3). Exact: volume_below of every rod.
std::vector<double> volumes_below(const std::vector<Rod> &rods, const std::vector<double> &heights);

// Solid within each of the cylinders, which share an axis and of which each holds the one before
// (m^3).
//
// Each rod is cut into chords parallel to its axis, Gauss-Legendre over the depth in the rod's
// round section and evenly spaced round it, turned by another angle for every rod; what a cylinder
// leaves of a chord is exact. The rules have 6, 15, 40 ... 11094 chords, until the error is less
// than half the tolerance of the solid between this cylinder and either neighbour. The error is an
// estimate and no bound: the larger of the sum of the rods' differences between two rules and twice
// the root of the sum of their squares. Upright rods, and cylinders narrower than two rods, are
// left to clipped_volume.
std::vector<BoundedVolume> volumes_within(const std::vector<Rod> &rods,
                                          const std::vector<UprightCylinder> &cylinders,
                                          double tolerance);

struct ProfileBin {
  double low, high;  // m: height above the floor, distance from the axis, or from the wall
  double region;     // m^3
  double solid;      // m^3
  double error;      // of the solid (m^3)

  double fraction() const { return solid / region; }
};

// Edges from `low` in steps of `width`, the last at `high` (a last step below 1e-6 of the width is
// left out). Throws InputError for more than 100000.
std::vector<double> bin_edges(double low, double high, double width);

// Layers of the vessel from its floor up; `section` is its cross-section (m^2). Solid beyond the
// side wall counts in its layer. Heights in `edges` are above `floor`.
std::vector<ProfileBin> height_profile(const std::vector<Rod> &rods, double section, double floor,
                                       const std::vector<double> &edges);

// Layers of a vessel of any shape, from its lowest point up.
std::vector<ProfileBin> height_profile(const std::vector<Rod> &rods, const ClosedMesh &vessel,
                                       const std::vector<double> &edges);

// Shells about the vessel's axis between its floor and its top; edges from 0 to the radius.
std::vector<ProfileBin> radius_profile(const std::vector<Rod> &rods, const UprightCylinder &vessel,
                                       const std::vector<double> &edges, double tolerance);

// By the distance from the nearer of wall and floor, up to the vessel's top; edges from 0 to at
// most the radius or height. The last bin holds all that is further from the walls than its edge.
std::vector<ProfileBin> wall_profile(const std::vector<Rod> &rods, const UprightCylinder &vessel,
                                     const std::vector<double> &edges, double tolerance);

}  // namespace spherocylinder
