// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace grammar {

struct Ended {
  int exit_code = 0;
  bool in_time = true;
  std::string output;  // standard output and error together
};

// Runs lmp on in.deck in its folder and waits for it, but not longer than the limit (s).
Ended run_lmp(const std::filesystem::path &folder, const std::string &lmp, int ranks,
              int time_limit);

// Throws Wrong for a signal or a run that does not end.
void check_end(const Ended &ended);

}  // namespace grammar
