// SPDX-License-Identifier: GPL-2.0-or-later
// Files ParaView opens: poly data, and a list of them with times (.pvd).
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;

namespace spherocylinder {

// Compressed .vtp. Throws InputError if the file cannot be written.
void write_poly_data(const std::string &path, vtkPolyData *data);

class TimeSeries {
 public:
  explicit TimeSeries(std::string path) : path_(std::move(path)) {}

  // `file` lies in the same folder as the .pvd.
  void add(double time, const std::string &file);
  bool has(const std::string &file) const;
  void write() const;
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    double time;
    std::string file;
  };

  std::string path_;
  std::vector<Entry> entries_;
};

}  // namespace spherocylinder
