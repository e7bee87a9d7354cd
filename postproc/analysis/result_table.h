// SPDX-License-Identifier: GPL-2.0-or-later
// A table of numbers, frame after frame of one file, or as mean and standard error over several
// files (beds poured with other seeds), and the CSV file it goes to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/csv_file.h"
#include "analysis/mean_with_error.h"

namespace spherocylinder {

// What becomes of a column when the same row of several files becomes one.
enum class OverFiles {
  same,   // it is alike in all files (the edge of a bin); left empty where it is not
  sum,    // counts
  mean,   // over the files that have a value
  error,  // standard error of the mean in the column before, over the files that have a value
  largest,
  scatter,  // standard deviation of a mean of one file: goes down with the square root of their
            // number
};

struct Column {
  std::string name;
  OverFiles over_files;
};

using Rows = std::vector<std::vector<double>>;  // NaN is an empty field

// Rows of several files as one table: row by row, as many as the longest has. A standard error
// needs two files with a value, else it is NaN.
Rows combine_files(const std::vector<Column> &columns, const std::vector<Rows> &files);

class ResultTable {
 public:
  // An empty path writes nothing. With `several_files` each frame added is a file.
  ResultTable(std::string path, std::vector<Column> columns, bool several_files);

  // Throws InputError if the file cannot be written, with several files too.
  void add(const Rows &rows);

  // Writes what several files give together.
  void finish();

  const std::vector<Column> &columns() const { return columns_; }
  Rows combined() const { return combine_files(columns_, files_); }

 private:
  void write(const Rows &rows);

  std::string path_;
  std::vector<Column> columns_;
  bool several_files_;
  std::vector<Rows> files_;
  std::optional<CsvFile> csv_;  // opened only once there is something to write
};

// "  name   mean -+ error" for each column of one row that has an error behind it.
void print_means(const std::vector<Column> &columns, const std::vector<double> &row);

}  // namespace spherocylinder
