// SPDX-License-Identifier: GPL-2.0-or-later
// What the reader promises of any bytes whatever. Used by the fuzz target and by the unit test that
// replays its corpus.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "analysis/dump_reader.h"
#include "analysis/input_error.h"
#include "analysis/rods.h"

namespace spherocylinder {

inline void promise(bool kept, const char *what)
{
  if (kept) return;
  std::fprintf(stderr, "broken promise of the dump reader: %s\n", what);
  std::abort();
}

// Reads all frames and their rods. Returns the sentence of the error, or nothing for a good file.
// Ends the program if a promise is broken: finite numbers, unit axes, one printable sentence that
// names the file, and no other exception.
inline std::string read_dump_bytes(const std::string &path)
{
  try {
    DumpReader reader(path);
    DumpFrame frame;
    while (reader.next(frame)) {
      promise(frame.values.size() == frame.rows * frame.columns.size(), "as many values as told");
      for (const double value : frame.values) promise(std::isfinite(value), "finite values");
      for (const Rod &rod : rods_of(frame)) {
        promise(rod.id >= 1 && rod.type >= 1, "id and type from 1");
        promise(rod.capsule.radius > 0.0 && rod.capsule.segment.half_length >= 0.0, "real sizes");
        promise(std::abs(norm(rod.capsule.segment.axis) - 1.0) < 1e-12, "unit axes");
      }
    }
  } catch (const InputError &error) {
    const std::string sentence = error.what();
    promise(sentence.find(path) == 0, "the error names the file first");
    for (const char c : sentence) promise(c >= ' ' && c <= '~', "a printable sentence");
    promise(sentence.size() < path.size() + 300, "a sentence, not a flood");
    return sentence;
  }
  return "";
}

}  // namespace spherocylinder
