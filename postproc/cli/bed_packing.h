// SPDX-License-Identifier: GPL-2.0-or-later
// All that rod_packing says of one bed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/beds.h"
#include "cli/region_packing.h"
#include "cli/result_table.h"
#include "measures/packing_measures.h"
#include "measures/solid_profile.h"

namespace spherocylinder {

struct MeshVessel {
  std::string path;
  ClosedMesh mesh;
};

struct PackingOptions {
  std::optional<Vessel> vessel;            // or
  std::shared_ptr<const MeshVessel> mesh;  // or
  std::optional<UprightBox>
      box;  // with walls; or none of them: the dump's box, periodic in x and y
  std::optional<UprightBox> region;  // any, whatever holds the bed; alone, nothing else is measured
  double floor = 0.0;                // of that box, unless it is periodic in z too (m)
  InnerOverride inner;
  std::optional<double> bulk_margin;  // m
  double tolerance = 1e-4;

  // Whether more than the region is asked for.
  bool holds_bed(const DumpFrame &frame) const
  {
    return vessel || mesh || box || (frame.periodic[0] && frame.periodic[1]);
  }
};

struct AspectRatios {
  double mean, smallest, largest;  // total length over diameter, mean over the rods

  // Wider than the rounding of a dump.
  bool several() const { return largest - smallest > 1e-4 * mean; }
};

struct BedPacking {
  std::int64_t step;
  std::size_t rods, spheres;
  std::optional<FibreShapes> fibres;  // that rods are segments of
  AspectRatios lambda;                // of whole fibres
  bool has_axes;                      // not all are spheres, or rings
  double mean_elevation_deg;          // NaN without any, as mean_sin_gamma
  double mean_sin_gamma;
  BedHeight height;
  double rods_volume;     // m^3, overlaps counted twice, ends that segments share once
  std::size_t overlaps;   // pairs that overlap
  double overlap_volume;  // m^3, summed over these pairs
  double overlap_error;   // bound (m^3)
  RegionPacking whole;    // volume of all rods, whole, over the vessel's up to the highest centre
  RegionPacking clipped;  // only what lies in that volume
  RegionPacking inner;
  double bulk_margin;  // m
  RegionPacking bulk;
  RegionPacking region;          // the user's own
  bool vessel_is_convex = true;  // else there is neither inner nor bulk

  bool has_rods() const { return has_axes; }  // for which there are theories
};

// Throws InputError if centres of rods lie outside the vessel or the options do not fit the bed.
BedPacking measure_packing(const Bed &bed, const PackingOptions &options);

// With those of fibres if there are any.
Fields<BedPacking> packing_fields(bool with_fibres);

struct PackingProfiles {
  std::vector<ProfileBin> height, radius, wall;  // the latter two empty for a periodic box
};

// Bins `width` wide (m). Heights end above the highest point of any rod, with a full bin.
PackingProfiles measure_profiles(const Bed &bed, const PackingOptions &options, double width);

struct ProfileRow {
  std::int64_t step;
  ProfileBin bin;
};

Fields<ProfileRow> profile_fields();
std::vector<ProfileRow> profile_rows(const Bed &bed, const std::vector<ProfileBin> &bins);

}  // namespace spherocylinder
