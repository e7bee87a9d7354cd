// SPDX-License-Identifier: GPL-2.0-or-later
// Reads LIGGGHTS `dump custom` text files frame by frame, so that a file of any size needs memory
// for one frame only.
#pragma once

#include <fstream>
#include <string>
#include <string_view>

#include "analysis/dump_frame.h"

namespace spherocylinder {

class DumpReader {
 public:
  // Throws InputError if the file cannot be opened.
  explicit DumpReader(const std::string &path);

  // Reads the next frame. At a clean end of file returns false and leaves `frame` as it was, so
  // that after a loop `frame` is the last one. Throws InputError for anything but a whole frame of
  // finite numbers with unique ids, and for a file without any frame.
  // The text column `element` is dropped; CRLF line ends and trailing blanks are accepted.
  bool next(DumpFrame &frame);

 private:
  bool read_line();
  void need_line(std::string_view what);
  void read_box(DumpFrame &frame);
  void read_columns(std::string_view names, DumpFrame &frame);
  void read_rows(DumpFrame &frame, std::int64_t count);
  void read_row(DumpFrame &frame, std::size_t row);
  void check_ids(const DumpFrame &frame) const;
  std::int64_t integer_line(std::string_view what);
  [[noreturn]] void fail(const std::string &what) const;

  std::string path_;
  std::ifstream file_;
  std::string buffer_;     // the line with its blanks at the end
  std::string_view line_;  // the line without them
  std::size_t line_number_ = 0;
  std::vector<bool> is_text_;  // file columns that hold words
  bool any_frame_ = false;
};

}  // namespace spherocylinder
