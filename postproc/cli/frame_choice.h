// SPDX-License-Identifier: GPL-2.0-or-later
// Which frames of a dump a tool works on: --frame first|last|all|STEP.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "io/dump_frame.h"

namespace spherocylinder {

struct FrameChoice {
  enum class Kind { First, Last, All, Step };
  Kind kind = Kind::Last;
  std::int64_t step = 0;  // for Kind::Step
};

// Throws InputError unless the word is first, last, all or a whole number >= 0.
FrameChoice parse_frame_choice(const std::string &word);

// Calls `work` for each chosen frame in file order; reads no further than needed. Throws
// InputError if the wanted step is not in the file.
void for_each_frame(const std::string &path, const FrameChoice &choice,
                    const std::function<void(const DumpFrame &)> &work);

}  // namespace spherocylinder
