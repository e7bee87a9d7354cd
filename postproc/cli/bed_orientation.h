// SPDX-License-Identifier: GPL-2.0-or-later
// All that rod_orientation says of one bed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cli/beds.h"
#include "cli/result_table.h"
#include "measures/orientation_statistics.h"
#include "measures/packing_theory.h"

namespace spherocylinder {

enum class NearWall { Nearest, Side, Floor };

// What has an axis: a segment, or a fibre, from end to end. Rods of their own are both.
enum class AxisOf { Segment, Fibre };

struct OrientationOptions {
  std::optional<Vessel> vessel;
  std::size_t bins = 18;
  BinSpacing spacing = BinSpacing::EqualSolidAngle;
  NearWall wall = NearWall::Nearest;  // that distances are taken from
  std::optional<double> wall_width;   // of a bin of the distance (m)
  double near = 0.1;                  // gap of near rods, in diameters of the thickest
  double half_contacts = kHalfContactsPerRod;
  AxisOf by = AxisOf::Segment;
};

// What is measured of any set of rods: a bed, or those at some distance from a wall.
struct Order {
  std::size_t rods;                             // with an axis
  MeanWithError elevation, abs_uz, uz_squared;  // elevation in rad
  NematicOrder nematic;
  double squared_order;
  AzimuthalOrder azimuthal;
  MeanWithError radial;  // NaN without a vessel's axis
  MeanWithError sin_gamma;
  MeanWithError random_contact;  // V_f that <|sin gamma|> lets expect
};

struct WallBin {
  double low, high;  // distance of the centre from the wall (m)
  Order order;
  std::vector<ElevationBin> histogram;
};

struct MeasuredFraction {
  double whole, inner;   // as rod_packing gives them
  double half_contacts;  // with which random contacts give the inner one
};

struct BedOrientation {
  std::int64_t step;
  double lambda;  // number mean of the rods with an axis, of fibres of all their length
  Order order;
  NematicTensor tensor;
  std::vector<ElevationBin> histogram;
  double chi_squared;
  std::size_t near_pairs;
  MeanWithError near_sin_gamma;
  double random_contact_isotropic;  // V_f of isotropic rods
  std::optional<MeasuredFraction> measured;
  std::vector<WallBin> by_wall;
  std::optional<FibreShapes> fibres;
};

// Without a width of the bins by distance takes a quarter of a rod, and keeps it in the options for
// the beds that follow. Throws InputError for a bed without a rod longer than a sphere, rods
// outside the vessel, or bins that are too many.
BedOrientation measure_orientation(const Bed &bed, OrientationOptions &options);

// With those of fibres if there are any.
Fields<BedOrientation> orientation_fields(bool with_fibres);

// A bin of the elevation, of the bed or, with `low` and `high`, of a bin of the distance.
struct ElevationRow {
  std::int64_t step;
  std::size_t number;  // from 1
  ElevationBin bin;
  double low, high;  // m
};

// A bin of the distance.
struct WallRow {
  std::int64_t step;
  WallBin bin;
};

// Axes so many places apart along a fibre.
struct CorrelationRow {
  std::int64_t step;
  TangentCorrelation correlation;
};

Fields<CorrelationRow> correlation_fields();
std::vector<CorrelationRow> correlation_rows(const BedOrientation &bed);
Fields<ElevationRow> elevation_fields();
Fields<WallRow> wall_fields();
Fields<ElevationRow> wall_elevation_fields();
std::vector<ElevationRow> elevation_rows(const BedOrientation &bed);
std::vector<WallRow> wall_rows(const BedOrientation &bed);
std::vector<ElevationRow> wall_elevation_rows(const BedOrientation &bed);

}  // namespace spherocylinder
