// SPDX-License-Identifier: GPL-2.0-or-later
// The rods of a dump as an input of stock LIGGGHTS: bodies of fix multisphere, glued of spheres.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/dump_frame.h"
#include "io/rods.h"

namespace spherocylinder {

// How many spheres a rod gets: so many, or as few as lie no further apart than `spacing` radii.
struct SphereCount {
  std::optional<int> spheres;     // >= 2
  std::optional<double> spacing;  // radii, > 0

  int of(const Capsule &rod) const;
};

// Places of the centres along the rod's axis, from its centre (m): n >= 2, evenly from the centre
// of one end's hemisphere to that of the other.
std::vector<double> sphere_places(double half_length, int n);

// Rods of one size and type, which share a template.
struct RodKind {
  int type;
  double radius, half_length;  // m
  double density;              // kg/m^3
  int spheres;
  std::vector<std::size_t> rods;  // rows
};

// The kinds in the order of their first rods. `density` (kg/m^3) is that of all rods; without it
// the dump's column `density` is read. Throws InputError for rods without a density or without
// length, and for more spheres than a template can hold.
std::vector<RodKind> rod_kinds(const DumpFrame &frame, const std::vector<Rod> &rods,
                               const SphereCount &count, std::optional<double> density);

using BoxBounds = std::array<std::array<double, 2>, 3>;  // m

// The box the bodies are put into. Periodic directions are the dump's. Others are the dump's too,
// made wider where a sphere would lie outside, or, if there is a `margin` (m), the rods' own extent
// and so much more on either side.
BoxBounds multisphere_box(const DumpFrame &frame, const std::vector<Rod> &rods,
                          std::optional<double> margin);

// `boundary`, the box as a region and create_box, with as many types as the rods have unless the
// deck has set the variable `types`; the variable `rod_mass` (kg) if all rods are of one kind.
std::string box_commands(const BoxBounds &box, const std::array<bool, 3> &periodic,
                         const std::vector<RodKind> &kinds);

// A line a sphere, as fix particletemplate/multisphere reads it: x y z radius, the axis along z.
std::string template_file(const RodKind &kind);

// Templates with mass and inertia of the true rods, the bodies, and what puts them there: a run of
// one step of 1e-15 of the deck's own, after which all that was needed for it is gone again.
// `template_paths`: the file of each kind. Rows without velocities are at rest. Rods outside a
// periodic box are put in by its periods. Throws InputError for half of a velocity.
std::string body_commands(const DumpFrame &frame, const std::vector<Rod> &rods,
                          const std::vector<RodKind> &kinds, const BoxBounds &box,
                          const std::vector<std::string> &template_paths);

}  // namespace spherocylinder
