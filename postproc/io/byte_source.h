// SPDX-License-Identifier: GPL-2.0-or-later
// Bytes of a file, plain or gzip (told apart by its first two bytes).
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <zlib.h>

namespace spherocylinder {

class ByteSource {
 public:
  // Throws InputError if the file cannot be opened, or is being written by this run.
  explicit ByteSource(const std::string &path);

  // Up to `most` of the next bytes; 0 at the end of the file only. Throws ReadFailure if it cannot
  // be read or decompressed, or holds more than compressed data (zlib's own gzread drops the rest).
  std::size_t read(char *bytes, std::size_t most);

  double part_read() const;  // of the file's bytes, 0 to 1; 0 where it has no size

  struct ReadFailure {
    std::string reason;
  };

 private:
  std::size_t read_file(char *bytes, std::size_t most);
  std::size_t inflate_some(char *bytes, std::size_t most);
  void need_input();

  struct FileCloser {
    void operator()(std::FILE *file) const { std::fclose(file); }
  };
  struct StreamEnder {
    void operator()(z_stream *stream) const;
  };

  std::unique_ptr<std::FILE, FileCloser> file_;
  std::unique_ptr<z_stream, StreamEnder> stream_;  // of a gzip file
  std::vector<unsigned char> input_;               // read and not yet given or decompressed
  std::size_t begin_ = 0, end_ = 0;                // of it
  bool in_member_ = true;                          // of a gzip file, which may have several
  double bytes_read_ = 0.0, file_bytes_ = 0.0;
};

}  // namespace spherocylinder
