// SPDX-License-Identifier: GPL-2.0-or-later
// Reads LIGGGHTS `dump custom` and `dump local` text files, plain or gzip, frame by frame, so that
// a file of any size needs memory for one frame only.
#pragma once

#include <string>
#include <string_view>

#include "io/dump_frame.h"
#include "io/line_source.h"

namespace spherocylinder {

enum class DumpKind {
  Atoms,    // `dump custom`: a row an atom, with an id of its own
  Entries,  // `dump local`: rows of a compute, which need no id
};

class DumpReader {
 public:
  // Throws InputError if the file cannot be opened.
  explicit DumpReader(const std::string &path, DumpKind kind = DumpKind::Atoms);

  // Reads the next frame. At a clean end of file returns false and leaves `frame` as it was, so
  // that after a loop `frame` is the last one. Throws InputError for anything but a whole frame of
  // finite numbers (atoms: with unique ids), and for a file without any frame.
  // The text column `element` is dropped; CRLF line ends and trailing blanks are accepted. Shows
  // its progress on a terminal. The numbers are the same for any number of cores.
  bool next(DumpFrame &frame);

 private:
  bool read_line();
  void need_line(std::string_view what);
  void read_box(DumpFrame &frame);
  void read_boundary(std::string_view words, DumpFrame &frame);
  void read_columns(std::string_view names, DumpFrame &frame);
  void read_rows(DumpFrame &frame, std::int64_t count);
  void check_ids(const DumpFrame &frame) const;
  std::int64_t integer_line(std::string_view what);
  [[noreturn]] void fail(const std::string &what) const;

  LineSource lines_;
  DumpKind kind_;
  std::string_view line_;      // the last line read, without the blanks at its end
  std::vector<bool> is_text_;  // file columns that hold words
  bool any_frame_ = false;
};

}  // namespace spherocylinder
