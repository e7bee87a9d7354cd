// SPDX-License-Identifier: GPL-2.0-or-later
// A table of numbers, frame after frame of one file, or as mean and standard error over several
// files (beds poured with other seeds), and the CSV file it goes to.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/csv_file.h"
#include "measures/mean_with_error.h"

namespace spherocylinder {

// What becomes of a column when the same row of several files becomes one.
enum class OverFiles {
  Same,   // it is alike in all files (the edge of a bin); left empty where it is not
  Sum,    // counts
  Mean,   // over the files that have a value
  Error,  // standard error of the mean in the column before, over the files that have a value
  Largest,
  Scatter,  // standard deviation of a mean of one file: goes down with the square root of their
            // number
};

struct Column {
  std::string name;
  OverFiles over_files;
};

using Rows = std::vector<std::vector<double>>;  // NaN is an empty field

// The columns of a table, each with the number of an Item that is written there.
template <class Item>
class Fields {
 public:
  template <class Number>  // of an item: convertible to double
  Fields &add(const std::string &name, OverFiles rule, Number number)
  {
    columns_.push_back({name, rule});
    numbers_.push_back([number](const Item &item) { return static_cast<double>(number(item)); });
    return *this;
  }

  // A mean and its standard error; a suffix of the unit is said apart: mean_z, "_m" give the
  // columns mean_z_m and mean_z_error_m.
  template <class Mean>  // of an item: MeanWithError
  Fields &add_mean(const std::string &name, Mean mean, const std::string &unit = "")
  {
    add(name + unit, OverFiles::Mean, [mean](const Item &item) { return mean(item).mean; });
    return add(name + "_error" + unit, OverFiles::Error,
               [mean](const Item &item) { return mean(item).error; });
  }

  // Those of a part of the item.
  template <class Part, class Other>
  Fields &add_part(const Fields<Part> &fields, Other part)
  {
    for (std::size_t k = 0; k < fields.columns().size(); k++)
      add(fields.columns()[k].name, fields.columns()[k].over_files,
          [number = fields.number(k), part](const Item &item) { return number(part(item)); });
    return *this;
  }

  const std::vector<Column> &columns() const { return columns_; }
  const std::function<double(const Item &)> &number(std::size_t column) const
  {
    return numbers_[column];
  }

  std::vector<double> row(const Item &item) const
  {
    std::vector<double> row;
    for (const auto &number : numbers_) row.push_back(number(item));
    return row;
  }

 private:
  std::vector<Column> columns_;
  std::vector<std::function<double(const Item &)>> numbers_;
};

// Rows that a file has fewer than another.
enum class MissingRows {
  LeftOut,  // the file says nothing of them
  Zero,     // its counts, and their means, are 0 there
};

// Rows of several files as one table: row by row, as many as the longest has. A standard error
// needs two files with a value, else it is NaN.
Rows combine_files(const std::vector<Column> &columns, const std::vector<Rows> &files,
                   MissingRows missing = MissingRows::LeftOut);

// The rows of a table on their way to a file.
class RowTable {
 public:
  // An empty path writes nothing. With `several_files` each call of add is a file.
  RowTable(std::string path, std::vector<Column> columns, bool several_files, MissingRows missing);

  // Throws InputError if the file cannot be written, with several files too.
  void add(const Rows &rows);

  // Writes what several files give together.
  void finish();

  // What several files give together: "  name   mean -+ error" for each column of the first row
  // that has an error behind it.
  void print_means() const;

 private:
  void write(const Rows &rows);

  std::string path_;
  std::vector<Column> columns_;
  bool several_files_;
  MissingRows missing_;
  std::vector<Rows> files_;
  std::optional<CsvFile> csv_;  // opened only once there is something to write
};

// A RowTable of Items.
template <class Item>
class ResultTable {
 public:
  ResultTable(std::string path, Fields<Item> fields, bool several_files,
              MissingRows missing = MissingRows::LeftOut)
      : fields_(std::move(fields)),
        table_(std::move(path), fields_.columns(), several_files, missing)
  {
  }

  void add(const Item &item) { table_.add({fields_.row(item)}); }

  void add_all(const std::vector<Item> &items)
  {
    Rows rows;
    for (const Item &item : items) rows.push_back(fields_.row(item));
    table_.add(rows);
  }

  void finish() { table_.finish(); }
  void print_means() const { table_.print_means(); }

 private:
  Fields<Item> fields_;
  RowTable table_;
};

}  // namespace spherocylinder
