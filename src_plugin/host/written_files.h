// SPDX-License-Identifier: GPL-2.0-or-later
// The files that LIGGGHTS writes, from its opening of each to its closing: LIGGGHTS itself does not look
// whether the disk has taken what it wrote.
#pragma once

#include <cstdio>
#include <string>

namespace spherocylinder {

// After LIGGGHTS has opened a file or a pipe.
void watch_file(FILE *stream, const char *name, const char *mode);

// Closes a stream by `close`, as whose result it returns, and sees whether the file is whole.
int close_watched_file(FILE *stream, int (*close)(FILE *));

// What is wrong with a file that is not whole, as a sentence with its name; empty if all are. Each is told
// once, those that are still open too.
std::string next_cut_file();

// Why the file of that name was not whole when it was closed, empty if it was. It is not told again.
std::string was_cut(const std::string &name);

// When the process ends, a file that is cut and was not told is told, and the exit code is 1.
void look_at_files_at_exit();

}  // namespace spherocylinder
