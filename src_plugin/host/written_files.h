// SPDX-License-Identifier: GPL-2.0-or-later
// The files that LIGGGHTS writes, from its opening of each to its closing: LIGGGHTS itself does not look
// whether the disk has taken what it wrote.
#pragma once

#include <cstdio>
#include <string>

namespace spherocylinder {

// Opens a file by `open`, as whose result it returns.
FILE *open_watched_file(const char *name, const char *mode,
                        FILE *(*open)(const char *, const char *) );

// Of a file that another library opens for LIGGGHTS while files appear whole: VTK takes away what it could not
// write and goes on, so that the file must be there in the end.
void expect_file(const char *name, const char *mode);

// Closes a stream by `close`, as whose result it returns, and sees whether the file is whole.
int close_watched_file(FILE *stream, int (*close)(FILE *));

// What is wrong with a file that is not whole, as a sentence with its name; empty if all are. Each is told
// once, those that are still open too.
std::string next_cut_file();

// Why the file of that name was not whole when it was closed, empty if it was. It is not told again.
std::string was_cut(const std::string &name);

// While it lives, files that this thread opens anew are written beside their places, as hidden ones: closed
// meanwhile, they are put there if they are whole and taken away if they are cut; still open at its end, as
// they are.
class FilesAppearWhole {
 public:
  explicit FilesAppearWhole(bool they_do = true);
  ~FilesAppearWhole();
  FilesAppearWhole(const FilesAppearWhole &) = delete;
  FilesAppearWhole &operator=(const FilesAppearWhole &) = delete;

 private:
  bool before_;
};

// The hidden file beside a file's place, which no pattern with * finds.
std::string beside(const std::string &name);

// Whether there is a file of that name, or may be one: no pipe and no device.
bool is_plain_file(const std::string &name);

// When the process ends, a file that is cut and was not told is told, and the exit code is 1.
void look_at_files_at_exit();

}  // namespace spherocylinder
