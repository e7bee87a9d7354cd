// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/line_source.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "io/input_error.h"

namespace spherocylinder {
namespace {

constexpr std::size_t kFirstBlockBytes = std::size_t{1} << 16;
constexpr std::size_t kLargestBlockBytes = std::size_t{1} << 22;

}  // namespace

LineSource::LineSource(const std::string &path)
    : path_(path), bytes_(path), buffer_(kFirstBlockBytes)
{
}

void LineSource::fail(const std::string &what) const
{
  throw InputError(fmt::format("{}:{}: {}", path_, line_number_ + 1, what));
}

// Moves what is left to the front of the buffer, which grows until it has its full size, and fills
// up the rest.
void LineSource::read_on()
{
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (line_number_ > 0 || end_ == buffer_.size())
    buffer_.resize(std::min(2 * buffer_.size(), kLargestBlockBytes));
  if (end_ == buffer_.size())
    fail(fmt::format("the line is longer than {} bytes: not a LIGGGHTS dump file", end_));
  std::size_t got = 0;
  try {
    got = bytes_.read(buffer_.data() + end_, buffer_.size() - end_);
  } catch (const ByteSource::ReadFailure &failure) {
    fail(fmt::format("cannot be read any further: {}", failure.reason));
  }
  at_end_ = got == 0;
  end_ += got;
}

bool LineSource::next_line(std::string_view &line)
{
  const LineBlock block = next_lines(1);
  if (block.lines == 0) return false;
  line = block.text.substr(0, block.text.size() - 1);
  return true;
}

LineBlock LineSource::next_lines(std::uint64_t most)
{
  std::size_t lines = 0;
  std::size_t stop = begin_;
  while (true) {
    while (lines < most) {
      const void *line_end = std::memchr(buffer_.data() + stop, '\n', end_ - stop);
      if (line_end == nullptr) break;
      stop = static_cast<std::size_t>(static_cast<const char *>(line_end) - buffer_.data()) + 1;
      lines++;
    }
    if (lines > 0 || most == 0) break;
    if (at_end_) {
      if (begin_ == end_) break;
      fail("the file is cut off within this line, wanted a line end");
    }
    read_on();
    stop = begin_;
  }
  const LineBlock block{{buffer_.data() + begin_, stop - begin_}, lines};
  begin_ = stop;
  line_number_ += lines;
  return block;
}

}  // namespace spherocylinder
