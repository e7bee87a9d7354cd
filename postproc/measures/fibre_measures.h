// SPDX-License-Identifier: GPL-2.0-or-later
// Fibres as wholes: their length, how far they are stretched and bent, what their segments share.
#pragma once

#include <vector>

#include "io/fibres.h"
#include "io/rods.h"
#include "measures/mean_with_error.h"
#include "solid/convex_integral.h"

namespace spherocylinder {

// From the centre of the outer hemisphere of the first segment to that of the last, across periodic
// boundaries (m). Zero for a ring.
Vec3 end_to_end(const Fibre &fibre, const std::vector<Rod> &rods);

// The same along the segments; of a ring all the way round (m).
double contour_length(const Fibre &fibre, const std::vector<Rod> &rods);

// Of each rod: its fibre's id and its place in the chain from 1, 0 for a rod of its own.
std::vector<double> fibre_ids(const Fibres &fibres);
std::vector<double> fibre_places(const Fibres &fibres);

enum class Rings { Kept, LeftOut };

// Each fibre as the straight rod of its length and radius, along its end-to-end vector, about the
// centre of its contour, with the fibre's id and its first segment's type; then the rods that are in
// no fibre. A ring has no end-to-end vector: kept, it stands upright, and its length is that of its
// contour; those whose ends meet are left out with the rings.
std::vector<Rod> fibre_bodies(const std::vector<Rod> &rods, const Fibres &fibres, Rings rings);

// The bend of each joint over the distance of joints, half a segment to either side (1/m).
std::vector<double> joint_curvatures(const std::vector<Rod> &rods, const Fibres &fibres);

// Mean of the joints a rod has; 0 without any (1/m).
std::vector<double> rod_curvatures(const std::vector<Rod> &rods, const Fibres &fibres);

// Axes of segments so many places apart in a chain.
struct TangentCorrelation {
  std::size_t places;
  double distance;  // mean, along the chain (m)
  std::size_t pairs;
  MeanWithError cosine;  // of the angle between the axes; each fibre's mean is one value
};

struct FibreShapes {
  std::size_t fibres, rings, parts, segments;
  MeanWithError segments_a_fibre, contour;  // m
  MeanWithError stretch;                    // end-to-end over contour length; rings left out
  MeanWithError curvature;                  // mean over a fibre's joints (1/m)
  // -h/ln <cos> over joints, h their mean distance; infinite for straight ones, NaN for a mean
  // cosine <= 0 (m).
  double persistence;
  std::vector<TangentCorrelation> correlation;  // from 0 places on
};

FibreShapes fibre_shapes(const std::vector<Rod> &rods, const Fibres &fibres);

// An end that two segments share.
struct SharedEnd {
  Rod ball;              // about it, as thick as they are
  BoundedVolume beyond;  // what they share beside the ball (m^3)
  double reach;          // from its centre to all they share (m)
};

std::vector<SharedEnd> shared_ends(const std::vector<Rod> &rods, const Fibres &fibres);

}  // namespace spherocylinder
