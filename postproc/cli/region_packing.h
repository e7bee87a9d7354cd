// SPDX-License-Identifier: GPL-2.0-or-later
// The solid of one region of a bed, its overlaps counted twice and once.
#pragma once

#include <cmath>
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

// Of all pairs that do, each volume to 1 %. Segments of a fibre that never touch are left out.
std::vector<Overlap> overlaps_of(const Bed &bed);

// What is summed up as solid: the rods, less the ends that segments of fibres share.
struct BedSolid {
  // Without overlaps none are taken off anywhere.
  explicit BedSolid(const Bed &bed_, std::vector<Overlap> overlaps_ = {});

  const Bed &bed;
  std::vector<Overlap> overlaps;  // twice in it
  std::vector<SharedEnd> shared;
  std::vector<Rod> balls;  // those of `shared`

  double volume() const;  // m^3
};

// Of the solid within the region: less the balls about shared ends, cut as rods are, and what else
// is shared there, which counts where the ball's centre is: that is the error of what is cut.
BoundedVolume solid_within(const BedSolid &solid, const UprightCylinder &region, double tolerance);

// Takes off from the solid what is shared beside the balls, and adds the error. `holds(place)` and
// `cuts(ball)` are asked of the centre of each and of a ball that holds all of it.
template <class Holds, class Cuts>
void take_off_beyond(const std::vector<SharedEnd> &shared, Holds holds, Cuts cuts,
                     BoundedVolume &solid)
{
  for (const SharedEnd &end : shared) {
    const Segment &at = end.ball.capsule.segment;
    if (holds(at.centre)) solid.value -= end.beyond.value;
    if (holds(at.centre)) solid.error += end.beyond.error;
    if (cuts(Capsule{at, end.reach})) solid.error += std::abs(end.beyond.value);
  }
}

// With the images of rods over periodic boundaries.
RegionPacking pack_box(const BedSolid &solid, const UprightBox &box, double tolerance);
RegionPacking pack_mesh(const BedSolid &solid, const ClosedMesh &mesh, double tolerance);

}  // namespace spherocylinder
