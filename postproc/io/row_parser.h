// SPDX-License-Identifier: GPL-2.0-or-later
// The atom lines of a dump as numbers, by all cores.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/line_source.h"

namespace spherocylinder {

class RowParser {
 public:
  // `columns`: names of the numbers of a line; `is_text`: for each word of a line whether it is to
  // be left out. Both must outlive the parser.
  RowParser(const std::vector<std::string> &columns, const std::vector<bool> &is_text)
      : columns_(columns), is_text_(is_text)
  {
  }

  // What is wrong with the first bad line of a block.
  struct Failure {
    std::size_t line;  // from 0
    std::string what;  // empty: it is an "ITEM:" line, so that lines are missing
  };

  // Appends the numbers of all lines to `values`; after a failure these mean nothing.
  std::optional<Failure> append(const LineBlock &block, std::vector<double> &values) const;

 private:
  std::optional<Failure> parse(std::string_view text, double *out) const;
  bool parse_line(const char *at, const char *end, double *out) const;
  std::string complaint(std::string_view line) const;

  const std::vector<std::string> &columns_;
  const std::vector<bool> &is_text_;
};

}  // namespace spherocylinder
