// SPDX-License-Identifier: GPL-2.0-or-later
// Means over beds that differ only in their seed, from the CSV files of rod_packing and
// rod_orientation or from tables of several beds with the same columns.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "analysis/csv_table.h"
#include "analysis/mean_with_error.h"

namespace spherocylinder {

constexpr double unbounded = std::numeric_limits<double>::infinity();

// A number of the table. Throws InputError if it is not from `low` to `high`.
double number_between(const CsvTable &table, std::size_t row, const std::string &column, double low,
                      double high);

struct PackingMean {
  std::string group;  // text of the grouping column, empty without one
  double lambda;      // total length / diameter
  std::size_t beds;
  MeanWithError vf;         // error NaN for a single bed
  MeanWithError sin_gamma;  // <|sin gamma|>; NaN if not in the files
};

// Reads the columns lambda_mean (or lambda), vf_inner or vf_whole, mean_sin_gamma (if there) and
// `by`. Rows of one group whose lambda agrees to 0.5 % are beds of one kind. Sorted by lambda
// within a group, groups in the order they appear. Throws InputError if a file holds one bed twice:
// beds in one file are told apart by the column seed, if a row is itself a mean over beds (has a
// standard error of V_f), or if a fraction is not from 0 to 1.
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
  double isotropic_rods;  // how many the isotropic scatter is of: the rods of all beds
  std::vector<ElevationMean> bins;
};

// Reads elevation_low_deg, elevation_high_deg, density, density_error, isotropic_fraction,
// isotropic_scatter, `by` and `panel_by`. The error is that over the beds, or of the counts for a
// single bed. Throws InputError if beds of a group have other bins, or a file holds one twice.
std::vector<OrientationMean> orientation_means(const std::vector<std::string> &files,
                                               const std::string &by, const std::string &panel_by);

}  // namespace spherocylinder
