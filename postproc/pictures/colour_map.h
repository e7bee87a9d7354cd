// SPDX-License-Identifier: GPL-2.0-or-later
// Colours for numbers.
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

namespace spherocylinder {

// Viridis (S. van der Walt and N. Smith, matplotlib, CC0): equal steps of the number look like
// equal steps of colour, in grey and to the colour-blind too. From `low` to `high`.
vtkSmartPointer<vtkLookupTable> viridis(double low, double high);

}  // namespace spherocylinder
