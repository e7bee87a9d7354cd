// SPDX-License-Identifier: GPL-2.0-or-later
// The numbers that go to ParaView with the rods.
#pragma once

#include <string>
#include <vector>

#include "io/dump_frame.h"
#include "pictures/rod_surface.h"

namespace spherocylinder {

// Columns of the dump, by their places, whose numbers are not already said by a rod's id, type,
// shape and axis, nor by those that `said` names.
std::vector<std::size_t> other_columns(const DumpFrame &frame,
                                       const std::vector<std::string> &said = {});

// Adds to each cell of the mesh its rod's id, type, elevation_deg, length, diameter, axis, speed
// and omega (magnitudes, if the dump has the vectors), and every column of the dump by its own name
// that is not said by these. Points get `radius`, for a tube filter on lines.
// With fibres also `fibre` (its id), `place` in the chain from 1, and `curvature` (1/m).
void attach_rod_data(const RodGeometry &geometry, const DumpFrame &frame,
                     const std::vector<Rod> &rods, const Fibres &fibres = {});

}  // namespace spherocylinder
