// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

namespace decks {

// Exponent p of y ~ x^p by least squares in the logarithms: of an error over the time step, the
// order of convergence.
double order_of_convergence(const std::vector<double> &x, const std::vector<double> &y);

}  // namespace decks
