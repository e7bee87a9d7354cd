// SPDX-License-Identifier: GPL-2.0-or-later
// Rods glued or bonded of spheres: the capsule that the spheres of each body make up.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/dump_frame.h"
#include "io/rods.h"

namespace spherocylinder {

struct GluedRod {
  // The axis runs along the line of least squares through the spheres' centres, from the sphere of
  // lowest id to that of highest. The capsule ends in the outermost spheres; its id is the body's,
  // its type that of the sphere of lowest id.
  Rod rod;
  Vec3 velocity;   // of the capsule's centre (m/s); 0 if the dump has none
  Vec3 omega;      // rad/s; the same
  double density;  // that of the sphere of lowest id (kg/m^3); 0 if the dump has none
  std::size_t spheres;
  double deviation;  // of a sphere's centre from the axis, the largest, in radii
  double least_spacing, largest_spacing;  // of neighbours along the axis, in radii
};

struct GluedRodOptions {
  std::string body = "mol";  // column
  double tolerance = 0.05;   // of deviation, and of gaps between spheres, in radii
};

// The bodies of a frame, by their numbers. Needs id, the body's column, places and radius (or
// diameter); type, velocities, omegas and density may be there.
//
// Bodies that lie across periodic boundaries are put together image by image, each sphere at the
// image nearest to one that is placed already; scaled and plain places give a centre inside the
// box.
//
// Angular velocity: that of the spheres if all of a body have the same, as rigid ones have; else
// sum of s u x v / sum of s^2 across the axis u (s: place along it), and along it the mean of the
// spheres' own, or none if the dump has no omegas.
//
// Throws InputError for a body that is no rod: fewer than two spheres, unequal radii, a sphere off
// the axis by more than the tolerance, neighbours further apart than they are thick by more than
// that.
std::vector<GluedRod> glued_rods(const DumpFrame &frame, const GluedRodOptions &options);

}  // namespace spherocylinder
