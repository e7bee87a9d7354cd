// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/csv_file.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "analysis/input_error.h"

namespace spherocylinder {

CsvFile::CsvFile(const std::string &path, const std::vector<std::string> &names)
    : path_(path), columns_(names.size())
{
  if (path_.empty()) return;
  file_.open(path_);
  if (!file_) throw InputError(fmt::format("{}: cannot be opened for writing", path_));
  file_ << fmt::format("{}\n", fmt::join(names, ","));
}

void CsvFile::row(const std::vector<double> &values)
{
  if (values.size() != columns_) throw std::logic_error("CSV row and header differ in length");
  if (path_.empty()) return;
  std::string line;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) line += ',';
    if (!std::isnan(values[i])) line += fmt::format("{:.10g}", values[i]);
  }
  file_ << line << '\n';
}

void CsvFile::close()
{
  if (path_.empty()) return;
  file_.close();
  if (!file_) throw InputError(fmt::format("{}: could not be written to its end", path_));
}

}  // namespace spherocylinder
