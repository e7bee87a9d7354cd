// SPDX-License-Identifier: GPL-2.0-or-later
// Files ParaView opens: poly data, and a list of them with times (.pvd).
#pragma once

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

  // `file` lies in the same folder as the .pvd. Files of one time are its parts, numbered from 0.
  void add(double time, const std::string &file, int part = 0);
  bool has(const std::string &file) const;
  void write() const;

 private:
  struct Entry {
    double time;
    std::string file;
    int part;
  };

  std::string path_;
  std::vector<Entry> entries_;
};

}  // namespace spherocylinder
