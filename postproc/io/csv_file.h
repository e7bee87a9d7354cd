// SPDX-License-Identifier: GPL-2.0-or-later
// A CSV file with one header line. Names carry the unit: height_m.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "io/output_file.h"

namespace spherocylinder {

class CsvFile {
 public:
  // An empty path makes every call do nothing. Throws InputError if the file cannot be written.
  CsvFile(const std::string &path, const std::vector<std::string> &names);

  void row(const std::vector<double> &values);  // NaN is written as an empty field

  // Call when all is written: throws InputError if some of it did not reach the disk. Without it
  // the file stays as it was.
  void close();

 private:
  std::optional<OutputFile> output_;
  std::ofstream file_;
  std::size_t columns_;
};

}  // namespace spherocylinder
