// SPDX-License-Identifier: GPL-2.0-or-later
// One time step of a LIGGGHTS `dump custom` or `dump local` text file, as numbers with named
// columns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spherocylinder {

struct DumpFrame {
  std::string path;             // file it came from, for messages
  std::size_t header_line = 0;  // line number (from 1) of the columns; rows follow without gaps

  std::int64_t step = 0;
  std::optional<double> time;                  // s, if the file has "ITEM: TIME"
  std::array<std::array<double, 2>, 3> box{};  // lower and upper bound in x, y, z (m)
  bool box_is_tilted = false;
  std::array<bool, 3> periodic{};  // in x, y, z; false too if the file does not say

  std::size_t rows = 0;
  std::vector<std::string> columns;
  std::vector<double> values;  // rows x columns, row after row; all finite

  double value(std::size_t row, std::size_t column) const
  {
    return values[row * columns.size() + column];
  }

  std::optional<std::size_t> find_column(std::string_view name) const
  {
    for (std::size_t i = 0; i < columns.size(); i++)
      if (columns[i] == name) return i;
    return std::nullopt;
  }

  std::size_t line_of(std::size_t row) const { return header_line + 1 + row; }
};

}  // namespace spherocylinder
