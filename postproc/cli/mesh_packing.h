// SPDX-License-Identifier: GPL-2.0-or-later
// What rod_packing says of a bed in a vessel of any shape, given as a closed mesh.
#pragma once

#include <string>
#include <vector>

#include "cli/bed_packing.h"

namespace spherocylinder {

// Throws InputError for a file that cannot be used, or whose mesh is open or turned the wrong way.
MeshVessel read_vessel(const std::string &path);

// The part of the vessel in the window. Throws InputError if there is none.
RegionPacking pack_part(const BedSolid &solid, const MeshVessel &vessel, const UprightBox &window,
                        double tolerance);

// Sets whole, clipped, inner and bulk; the bulk is at least `thinnest` wide (m). Throws InputError
// for centres outside the vessel and for options of round ones.
void measure_in_mesh(const BedSolid &solid, const PackingOptions &options, double thinnest,
                     BedPacking &p);

}  // namespace spherocylinder
