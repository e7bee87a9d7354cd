// SPDX-License-Identifier: GPL-2.0-or-later
// The end of a file that is whole: lines of text about it, then its length and check sum,
//   closing bytes 00000000000000062110 check 1a2b3c4d
//   end of file
// `bytes` is the length of what was there before, `check` the CRC-32 of all bytes that come before this
// word. LIGGGHTS reads a restart file as far as its last rod and sees none of it.
#pragma once

#include <string>
#include <vector>

namespace spherocylinder {

// Appends `lines` and the mark to a file, and sees that the disk has all of it. Returns what went wrong,
// empty if nothing; `check` gets the eight digits.
std::string close_with_mark(const std::string &path, const std::vector<std::string> &lines,
                            std::string &check);

// CRC-32 of a text.
unsigned long check_sum_of(const std::string &text);

struct MarkedFile {
  std::string fault;  // why the file is not whole, empty if it is
  bool has_mark = false;
  std::string check;               // the eight digits
  std::vector<std::string> lines;  // between LIGGGHTS's part and the mark
};

// Reads the file from end to end.
MarkedFile read_marked_file(const std::string &path);

}  // namespace spherocylinder
