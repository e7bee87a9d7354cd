// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/result_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/numbers.h"

namespace spherocylinder {
namespace {

double combined(OverFiles rule, const std::vector<double> &values,
                const std::vector<double> &values_before)
{
  double sum = 0.0, squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  switch (rule) {
    case OverFiles::Same: {
      const bool alike =
          !values.empty() && std::equal(values.begin() + 1, values.end(), values.begin());
      return alike ? values[0] : none;
    }
    case OverFiles::Sum: return values.empty() ? none : sum;
    case OverFiles::Mean: return mean_of(values).mean;
    case OverFiles::Error: return mean_of(values_before).error;
    case OverFiles::Largest:
      return values.empty() ? none : *std::max_element(values.begin(), values.end());
    case OverFiles::Scatter:
      return values.empty() ? none : std::sqrt(squares) / static_cast<double>(values.size());
  }
  return none;
}

}  // namespace

Rows combine_files(const std::vector<Column> &columns, const std::vector<Rows> &files,
                   MissingRows missing)
{
  std::size_t longest = 0;
  for (const Rows &rows : files) longest = std::max(longest, rows.size());
  Rows together(longest);
  for (std::size_t row = 0; row < longest; row++) {
    std::vector<double> before;
    for (std::size_t column = 0; column < columns.size(); column++) {
      std::vector<double> values;
      const bool is_zero =
          missing == MissingRows::Zero && columns[column].over_files != OverFiles::Same;
      for (const Rows &rows : files) {
        if (row >= rows.size() && is_zero) values.push_back(0.0);
        if (row < rows.size() && !std::isnan(rows[row][column]))
          values.push_back(rows[row][column]);
      }
      together[row].push_back(combined(columns[column].over_files, values, before));
      before = std::move(values);
    }
  }
  return together;
}

RowTable::RowTable(std::string path, std::vector<Column> columns, bool several_files,
                   MissingRows missing)
    : path_(std::move(path)),
      columns_(std::move(columns)),
      several_files_(several_files),
      missing_(missing)
{
}

void RowTable::add(const Rows &rows)
{
  if (!csv_) {
    std::vector<std::string> names;
    for (const Column &column : columns_) names.push_back(column.name);
    csv_.emplace(path_, names);
  }
  if (several_files_)
    files_.push_back(rows);
  else
    write(rows);
}

void RowTable::write(const Rows &rows)
{
  for (const std::vector<double> &row : rows) csv_->row(row);
}

void RowTable::finish()
{
  if (!csv_) return;
  if (several_files_) write(combine_files(columns_, files_, missing_));
  csv_->close();
}

void RowTable::print_means() const
{
  const std::vector<double> row = combine_files(columns_, files_, missing_)[0];
  for (std::size_t i = 0; i + 1 < columns_.size(); i++)
    if (columns_[i + 1].over_files == OverFiles::Error && !std::isnan(row[i]))
      fmt::print("  {:<34} {:12.6g} -+ {:.2g}\n", columns_[i].name, row[i], row[i + 1]);
}

}  // namespace spherocylinder
