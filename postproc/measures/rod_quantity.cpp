// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/rod_quantity.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/numbers.h"
#include "io/input_error.h"
#include "measures/fibre_measures.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {
namespace {

// LIGGGHTS names the output of a compute, fix or variable c_ID, f_ID, v_ID: ID alone will do.
bool stands_for(const std::string &column, const std::string &name)
{
  if (column == name) return true;
  const bool computed =
      column.rfind("c_", 0) == 0 || column.rfind("f_", 0) == 0 || column.rfind("v_", 0) == 0;
  return computed && column.substr(2) == name;
}

std::vector<double> column_values(const DumpFrame &frame, const std::string &name)
{
  for (std::size_t column = 0; column < frame.columns.size(); column++) {
    if (!stands_for(frame.columns[column], name)) continue;
    std::vector<double> values(frame.rows);
    for (std::size_t row = 0; row < frame.rows; row++) values[row] = frame.value(row, column);
    return values;
  }
  throw InputError(fmt::format("{}:{}: column '{}' is missing; there are {}", frame.path,
                               frame.header_line, name, fmt::join(frame.columns, " ")));
}

std::vector<double> need_magnitudes(const DumpFrame &frame, const char *x, const char *y,
                                    const char *z)
{
  for (const char *name : {x, y, z}) column_values(frame, name);  // complains of the one that lacks
  return magnitudes(frame, x, y, z);
}

}  // namespace

std::vector<double> magnitudes(const DumpFrame &frame, const char *x, const char *y, const char *z)
{
  const auto i = frame.find_column(x), j = frame.find_column(y), k = frame.find_column(z);
  if (!i || !j || !k) return {};
  std::vector<double> values(frame.rows);
  for (std::size_t row = 0; row < frame.rows; row++)
    values[row] = norm({frame.value(row, *i), frame.value(row, *j), frame.value(row, *k)});
  return values;
}

RodQuantity rod_quantity(const DumpFrame &frame, const std::vector<Rod> &rods,
                         const std::string &name, const Fibres &fibres)
{
  RodQuantity quantity{name, {}, 0.0, 0.0};
  if (name == "elevation") {
    for (const Rod &rod : rods)
      quantity.values.push_back(elevation(rod.capsule.segment.axis) * degrees);
    quantity.title = "elevation (deg)";
    quantity.high = 90.0;
    return quantity;
  }
  if (name == "speed") {
    quantity.title = "speed (m/s)";
    quantity.values = need_magnitudes(frame, "vx", "vy", "vz");
  } else if (name == "spin") {
    quantity.title = "angular velocity (rad/s)";
    quantity.values = need_magnitudes(frame, "omegax", "omegay", "omegaz");
  } else if (fibres.are_there() && name == "fibre") {
    quantity.values = fibre_ids(fibres);
  } else if (fibres.are_there() && name == "place") {
    quantity.title = "place in the fibre";
    quantity.values = fibre_places(fibres);
  } else if (fibres.are_there() && name == "curvature") {
    quantity.title = "curvature (1/m)";
    quantity.values = rod_curvatures(rods, fibres);
  } else {
    quantity.values = column_values(frame, name);
  }
  if (!quantity.values.empty()) {
    const auto [low, high] = std::minmax_element(quantity.values.begin(), quantity.values.end());
    quantity.low = *low;
    quantity.high = *high;
  }
  return quantity;
}

void set_range_of_most(RodQuantity &quantity)
{
  constexpr std::size_t kLeftOut = 10;  // one of so many at either end
  if (quantity.values.empty()) return;
  std::vector<double> sorted = quantity.values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t beyond = sorted.size() / kLeftOut;
  quantity.low = sorted[beyond];
  quantity.high = sorted[sorted.size() - 1 - beyond];
}

}  // namespace spherocylinder
