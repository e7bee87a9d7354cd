// SPDX-License-Identifier: GPL-2.0-or-later
// A table of a sweep, in bench/results of the build folder. Those of bench/results are kept copies.
#pragma once

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

class ResultsFile {
 public:
  // The header names the columns with their units. Rows reach the disk as they come, so that a
  // sweep that is stopped leaves what it has.
  ResultsFile(const std::string &name, const std::string &header) : file_(open(name))
  {
    if (!file_) throw std::runtime_error("cannot write " RESULTS_FOLDER "/" + name);
    line(header);
  }
  ~ResultsFile() { std::fclose(file_); }
  ResultsFile(const ResultsFile &) = delete;
  ResultsFile &operator=(const ResultsFile &) = delete;

  template <class... Values>
  void row(const char *format, const Values &...values)
  {
    line(fmt::format(fmt::runtime(format), values...));
  }

 private:
  std::FILE *file_;

  static std::FILE *open(const std::string &name)
  {
    std::filesystem::create_directories(RESULTS_FOLDER);
    return std::fopen((RESULTS_FOLDER "/" + name).c_str(), "w");
  }

  void line(const std::string &text)
  {
    fmt::print(file_, "{}\n", text);
    std::fflush(file_);
  }
};
