// SPDX-License-Identifier: GPL-2.0-or-later
// A file that a program writes, whole or not at all.
#pragma once

#include <string>
#include <vector>

namespace spherocylinder {

// What is written goes to a new file beside PATH (.bed.a1B2c3.csv for bed.csv) that takes PATH's
// place at the end: until then, and after a failure, what was there before stays. Through a link
// the file it leads to is written. A name that stands for no ordinary file (/dev/stdout, a pipe) is
// written to directly.
class OutputFile {
 public:
  // Throws InputError if nothing can be written there, if this run reads the same file, or if it
  // is writing it already.
  explicit OutputFile(const std::string &path);
  OutputFile(OutputFile &&other) noexcept;
  OutputFile &operator=(OutputFile &&) = delete;
  ~OutputFile();

  const std::string &path() const { return path_; }
  const std::string &working_path() const { return working_path_; }  // where to write

  // To be called when all is written and closed. Throws InputError if it cannot take its place.
  void finish();

 private:
  void leave();

  std::string path_, target_, working_path_;  // target_: path_, or what it links to
  bool open_ = true;
};

// A file that holds this text. Throws InputError if not all of it reached the disk.
void write_file(const std::string &path, const std::string &text);

// Files that are of use only together. At its end they are taken away, unless they were all kept: after a
// failure nothing is left of them.
class FilesTogether {
 public:
  FilesTogether() = default;
  FilesTogether(const FilesTogether &) = delete;
  FilesTogether &operator=(const FilesTogether &) = delete;
  ~FilesTogether();

  // After it was written.
  void add(const std::string &path) { paths_.push_back(path); }
  void keep() { paths_.clear(); }

 private:
  std::vector<std::string> paths_;
};

// Says that this run reads a file. Throws InputError if it writes the same one.
void note_input(const std::string &path);

}  // namespace spherocylinder
