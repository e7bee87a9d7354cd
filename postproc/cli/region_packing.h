// SPDX-License-Identifier: GPL-2.0-or-later
// The solid of one region of a bed, its overlaps counted twice and once.
#pragma once

#include <vector>

#include "cli/beds.h"
#include "solid/closed_mesh.h"

namespace spherocylinder {

// NaN where there is no such region.
struct RegionPacking {
  double radius;       // m, NaN for what is no cylinder
  double bottom, top;  // m
  double volume;       // m^3
  double fraction;
  double error;         // bound on the error of the fraction
  double net_fraction;  // less the overlaps of pairs whose contact lies in the region
};

// Where two rods overlap, and how much.
struct Overlap {
  Vec3 place;  // half-way between the closest points
  BoundedVolume volume;
};

// Of all pairs that do, each volume to 1 %.
std::vector<Overlap> overlaps_of(const Bed &bed);

// With the images of rods over periodic boundaries.
RegionPacking pack_box(const Bed &bed, const UprightBox &box, const std::vector<Overlap> &overlaps,
                       double tolerance);
RegionPacking pack_mesh(const Bed &bed, const ClosedMesh &mesh,
                        const std::vector<Overlap> &overlaps, double tolerance);

}  // namespace spherocylinder
