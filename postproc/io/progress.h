// SPDX-License-Identifier: GPL-2.0-or-later
// One line on the terminal that says how far a long piece of work is: "bed.dump: reading, 34 %".
#pragma once

#include <chrono>
#include <string>

namespace spherocylinder {

// Writes to the standard error stream, and only if that is a terminal. Nothing shows up before
// half a second has gone by, so that short work stays silent. The line is wiped in the end.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  void show(double part);  // 0 to 1

 private:
  std::string what_;
  bool on_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace spherocylinder
