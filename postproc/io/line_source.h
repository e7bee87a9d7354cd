// SPDX-License-Identifier: GPL-2.0-or-later
// Lines of a text file, plain or gzip, read in blocks so that a file of any size needs a few
// megabytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/byte_source.h"

namespace spherocylinder {

// Whole lines, each with its line end.
struct LineBlock {
  std::string_view text;
  std::size_t lines;
};

class LineSource {
 public:
  // Throws InputError if the file cannot be opened.
  explicit LineSource(const std::string &path);

  // The next line without its line end; false at the end of the file. Throws InputError for a last
  // line without a line end (cut off: LIGGGHTS ends every line), a line longer than a block and a
  // file that cannot be read or decompressed. Text of an earlier call is gone.
  bool next_line(std::string_view &line);

  // Up to `most` of the next lines, as many as the block at hand holds; none at the end of the
  // file. Throws as next_line.
  LineBlock next_lines(std::uint64_t most);

  const std::string &path() const { return path_; }
  std::size_t line_number() const { return line_number_; }  // of the last line given, from 1
  double part_read() const { return bytes_.part_read(); }   // of the file's bytes, 0 to 1

 private:
  void read_on();
  [[noreturn]] void fail(const std::string &what) const;

  std::string path_;
  ByteSource bytes_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // what is read and not yet given
  bool at_end_ = false;
  std::size_t line_number_ = 0;
};

}  // namespace spherocylinder
