// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers that rods can be coloured by or that go to ParaView with them.
#pragma once

#include <string>
#include <vector>

#include "io/dump_frame.h"
#include "io/fibres.h"
#include "io/rods.h"

namespace spherocylinder {

struct RodQuantity {
  std::string title;  // with the unit, as it stands beside a colour bar
  std::vector<double> values;
  double low, high;  // range to show: 0 to 90 for the elevation, else that of the values
};

// `name` is elevation, speed (of the centre), spin (|omega|), id, contacts (the column of that
// name, or c_contacts, f_contacts ...) or any column of the dump; of fibres also fibre (its id),
// place (in the chain, from 1) and curvature. Throws InputError if the dump lacks the column.
RodQuantity rod_quantity(const DumpFrame &frame, const std::vector<Rod> &rods,
                         const std::string &name, const Fibres &fibres = {});

// Sets the range to the values' own but for the lowest and the highest tenth of them.
void set_range_of_most(RodQuantity &quantity);

// Magnitude of the vector in three columns, row by row; empty if one is missing.
std::vector<double> magnitudes(const DumpFrame &frame, const char *x, const char *y, const char *z);

}  // namespace spherocylinder
