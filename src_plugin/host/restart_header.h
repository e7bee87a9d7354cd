// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace spherocylinder {

// What LIGGGHTS reads first of a restart file, and believes.
struct RestartHeader {
  std::string fault;  // why it is none, empty if it is one
  std::string atom_style;
  int ranks = 0;  // that wrote it
};

// Of a file of this machine's byte order; each of its counts is compared with the file's length.
RestartHeader read_restart_header(const std::string &path);

}  // namespace spherocylinder
