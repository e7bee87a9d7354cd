// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/csv_table.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "analysis/input_error.h"
#include "analysis/output_file.h"
#include "analysis/text.h"

namespace spherocylinder {
namespace {

std::vector<std::string> split(const std::string &line, const std::string &place)
{
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      fields.back() += line[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  if (quoted) throw InputError(fmt::format("{}: a double quote is not closed on this line", place));
  return fields;
}

}  // namespace

CsvTable::CsvTable(const std::string &path) : path_(path), header_{0, {}}
{
  note_input(path);
  std::error_code unknown;  // said when it is opened
  if (std::filesystem::is_directory(path, unknown))
    throw InputError(fmt::format("{}: is a folder, wanted a CSV file", path));
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: cannot be opened", path));
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    line = trimmed_end(line);
    if (line.empty() || line[0] == '#') continue;
    const std::string place = fmt::format("{}:{}", path, number);
    Row row{number, split(line, place)};
    if (header_.line == 0) {
      header_ = std::move(row);
      for (const std::string &name : header_.fields)
        if (std::count(header_.fields.begin(), header_.fields.end(), name) > 1)
          throw InputError(fmt::format("{}: column {} appears twice", place, shown(name)));
      continue;
    }
    if (row.fields.size() != header_.fields.size())
      throw InputError(fmt::format("{}: {} fields, wanted {} as the header has", place,
                                   row.fields.size(), header_.fields.size()));
    rows_.push_back(std::move(row));
  }
  if (header_.line == 0) throw InputError(fmt::format("{}: is empty, wanted a header line", path));
  if (rows_.empty()) throw InputError(fmt::format("{}: holds no rows below its header", path));
}

std::size_t CsvTable::index_of(const std::string &column) const
{
  const auto &names = header_.fields;
  const auto found = std::find(names.begin(), names.end(), column);
  if (found == names.end())
    throw InputError(fmt::format("{}:{}: column '{}' is missing; there are {}", path_, header_.line,
                                 column, shown(fmt::format("{}", fmt::join(names, " ")), 200)));
  return static_cast<std::size_t>(found - names.begin());
}

bool CsvTable::has(const std::string &column) const
{
  return std::find(header_.fields.begin(), header_.fields.end(), column) != header_.fields.end();
}

const std::string &CsvTable::text(std::size_t row, const std::string &column) const
{
  return rows_[row].fields[index_of(column)];
}

double CsvTable::number(std::size_t row, const std::string &column) const
{
  const std::string &field = text(row, column);
  const auto number = to_number<double>(field);
  if (!number || !std::isfinite(*number))
    throw InputError(
        fmt::format("{}: {} is {}, wanted a finite number", place(row), column, shown(field)));
  return *number;
}

bool CsvTable::is_empty(std::size_t row, const std::string &column) const
{
  return text(row, column).empty();
}

std::string CsvTable::place(std::size_t row) const
{
  return fmt::format("{}:{}", path_, rows_[row].line);
}

}  // namespace spherocylinder
