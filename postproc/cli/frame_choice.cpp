// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/frame_choice.h"

#include <fmt/format.h>

#include "io/dump_reader.h"
#include "io/input_error.h"
#include "io/text.h"

namespace spherocylinder {

FrameChoice parse_frame_choice(const std::string &word)
{
  if (word == "first") return {FrameChoice::Kind::First};
  if (word == "last") return {FrameChoice::Kind::Last};
  if (word == "all") return {FrameChoice::Kind::All};
  const auto step = to_number<std::int64_t>(word);
  if (!step || *step < 0)
    throw InputError(
        fmt::format("--frame: must be first, last, all or a step >= 0 (got {})", shown(word)));
  return {FrameChoice::Kind::Step, *step};
}

void for_each_frame(const std::string &path, const FrameChoice &choice,
                    const std::function<void(const DumpFrame &)> &work)
{
  using Kind = FrameChoice::Kind;
  DumpReader reader(path);
  DumpFrame frame;
  std::size_t frames = 0;
  std::int64_t first_step = 0;
  while (reader.next(frame)) {
    if (++frames == 1) first_step = frame.step;
    if (choice.kind == Kind::All) {
      work(frame);
    } else if (choice.kind == Kind::First ||
               (choice.kind == Kind::Step && frame.step == choice.step)) {
      work(frame);
      return;
    }
  }
  if (choice.kind == Kind::Last) work(frame);
  if (choice.kind == Kind::Step)
    throw InputError(fmt::format("{}: step {} is not among its {} steps, {} to {}", path,
                                 choice.step, frames, first_step, frame.step));
}

}  // namespace spherocylinder
