// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/csv_file.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "io/input_error.h"

namespace spherocylinder {

CsvFile::CsvFile(const std::string &path, const std::vector<std::string> &names)
    : columns_(names.size())
{
  if (path.empty()) return;
  output_.emplace(path);
  file_.open(output_->working_path());
  if (!file_) throw InputError(fmt::format("{}: cannot be opened for writing", path));
  file_ << fmt::format("{}\n", fmt::join(names, ","));
}

void CsvFile::row(const std::vector<double> &values)
{
  if (values.size() != columns_) throw std::logic_error("CSV row and header differ in length");
  if (!output_) return;
  std::string line;
  for (std::size_t i = 0; i < values.size(); i++) {
    if (i > 0) line += ',';
    if (!std::isnan(values[i])) line += fmt::format("{:.10g}", values[i]);
  }
  file_ << line << '\n';
}

void CsvFile::close()
{
  if (!output_) return;
  file_.close();
  if (!file_) throw InputError(fmt::format("{}: could not be written to its end", output_->path()));
  output_->finish();
}

}  // namespace spherocylinder
