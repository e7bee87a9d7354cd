// SPDX-License-Identifier: GPL-2.0-or-later
// The two plots of the study: solid fraction against aspect ratio, distribution of the elevation.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "figures/bed_means.h"
#include "figures/figure.h"

namespace spherocylinder {

struct LiteraturePoint {
  double lambda;       // total length / diameter
  double vf, error;    // error 0 if none is given
  std::string kind;    // experiment or simulation
  std::string label;   // points with the same label share a symbol and a line of the key
  bool checked;        // read in its source, or in one that cites it; if not, drawn hollow
};

// Columns lambda (>= 1), vf (0 to 1), vf_error (>= 0, may be empty), kind, label, checked (yes or
// no). Throws InputError for anything else.
std::vector<LiteraturePoint> read_literature(const std::string &path);

// What the values of a grouping column are called in a figure.
using Names = std::map<std::string, std::string>;

// Figure 3. Curves: Parkhouse and Kelly from lambda = e on, where they have their maximum, and
// random contacts from lambda = 5 on, since they hold for long rods. `left_out` gets a sentence for
// each literature point beyond the axes.
Figure packing_figure(const std::vector<PackingMean> &means,
                      const std::vector<LiteraturePoint> &literature, const Names &names,
                      std::vector<std::string> &left_out);

// Figure 4: fraction of the rods over that of isotropic rods against elevation, on a scale on which
// equal lengths are equal solid angles. One panel for each value of the panels' column. The band
// is one standard deviation of as many isotropic rods as the group with fewest has, which its label
// says. `by_lambda`: groups are called by their aspect ratio.
Figure orientation_figure(const std::vector<OrientationMean> &means, const Names &names,
                          bool by_lambda);

}  // namespace spherocylinder
