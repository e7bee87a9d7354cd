// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/progress.h"

#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace spherocylinder {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPatience{500};
constexpr std::chrono::milliseconds kRefresh{100};

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), on_(isatty(STDERR_FILENO) != 0), next_(Clock::now() + kPatience)
{
}

Progress::~Progress()
{
  if (!shown_) return;
  fmt::print(stderr, "\r\033[K");  // back to the left and erase to the right
  std::fflush(stderr);
}

void Progress::show(double part)
{
  if (!on_ || Clock::now() < next_) return;
  next_ = Clock::now() + kRefresh;
  shown_ = true;
  fmt::print(stderr, "\r\033[K{}, {:.0f} %", what_, 100.0 * part);
  std::fflush(stderr);
}

}  // namespace spherocylinder
