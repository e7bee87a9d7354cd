// SPDX-License-Identifier: GPL-2.0-or-later
// A CSV file with one header line, read back; fields are asked for by the name of their column.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace spherocylinder {

class CsvTable {
 public:
  // Fields may stand in double quotes (a quote inside doubled); empty lines and lines that begin
  // with # are comments. Throws InputError with the line if a row has more or fewer fields than
  // the header, a quote is not closed, or a column's name appears twice.
  explicit CsvTable(const std::string &path);

  const std::string &path() const { return path_; }
  std::size_t rows() const { return rows_.size(); }
  bool has(const std::string &column) const;

  // Throw InputError with file and line if there is no such column, or number() if the field is
  // not a finite number.
  const std::string &text(std::size_t row, const std::string &column) const;
  double number(std::size_t row, const std::string &column) const;
  bool is_empty(std::size_t row, const std::string &column) const;

  // "FILE:LINE", for messages about a row.
  std::string place(std::size_t row) const;

 private:
  struct Row {
    std::size_t line;  // from 1
    std::vector<std::string> fields;
  };

  std::size_t index_of(const std::string &column) const;

  std::string path_;
  Row header_;
  std::vector<Row> rows_;
};

}  // namespace spherocylinder
