// SPDX-License-Identifier: GPL-2.0-or-later
// Means over beds that differ only in their seed, from the CSV files of rod_packing and
// rod_orientation or from tables of several beds with the same columns.
#pragma once

#include <string>
#include <vector>

#include "analysis/mean_with_error.h"

namespace spherocylinder {

struct PackingMean {
  std::string group;  // text of the grouping column, empty without one
  double lambda;      // total length / diameter
  std::size_t beds;
  MeanWithError vf;
  MeanWithError sin_gamma;  // <|sin gamma|>; NaN if not in the files
};

// Reads the columns lambda_mean (or lambda), vf_inner or vf_whole, mean_sin_gamma (if there) and
// `by`. Rows of one group whose lambda agrees to 0.5 % are beds of one kind. Sorted by lambda
// within a group, groups in the order they appear. Throws InputError if a file holds one bed twice:
// beds in one file are told apart by the column seed,
// or if a row is itself a mean over beds (has a standard error of V_f).
std::vector<PackingMean> packing_means(const std::vector<std::string> &files,
                                       const std::string &vf_column, const std::string &by);

struct ElevationMean {
  double low, high;  // edges of the bin (degrees)
  MeanWithError density;
  double isotropic_scatter;  // standard deviation of the density of as many isotropic rods
};

struct OrientationMean {
  std::string panel, group;  // texts of these columns, empty without one
  std::size_t beds;
  std::vector<ElevationMean> bins;
};

// Reads elevation_low_deg, elevation_high_deg, density, density_error, isotropic_fraction,
// isotropic_scatter, `by` and `panel_by`. The error is that over the beds, or of the counts for a
// single bed. Throws InputError if beds of a group have other bins, or a file holds one twice.
std::vector<OrientationMean> orientation_means(const std::vector<std::string> &files,
                                               const std::string &by, const std::string &panel_by);

}  // namespace spherocylinder
