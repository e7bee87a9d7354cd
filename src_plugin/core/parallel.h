// SPDX-License-Identifier: GPL-2.0-or-later
// Work shared among threads, with the same result whatever their number.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <future>
#include <optional>
#include <thread>
#include <vector>

namespace spherocylinder {

constexpr int kMostThreads = 1024;

// The number that OMP_NUM_THREADS holds, of a list the first, which is meant for the outermost level.
// Nothing unless it is a whole number from 1 to kMostThreads.
inline std::optional<int> threads_in(const char *text)
{
  char *end = nullptr;
  const long count = std::strtol(text, &end, 10);
  const bool is_number = end != text && (*end == '\0' || *end == ',');
  if (!is_number || count < 1 || count > kMostThreads) return std::nullopt;
  return static_cast<int>(count);
}

// As many as OMP_NUM_THREADS says, without it as there are processors.
inline std::size_t thread_count()
{
  const char *wanted = std::getenv("OMP_NUM_THREADS");
  const int processors = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
  return static_cast<std::size_t>(wanted ? threads_in(wanted).value_or(processors) : processors);
}

// Calls work(begin, end) for pieces that make up 0 .. count, each piece once, from several threads, each of
// which takes the next piece when it is done with one. The pieces are `grain` long whatever the number of
// threads, so that sums kept piece by piece and added up in order do not depend on it. Passes on the
// exception of the earliest piece that throws.
template <class Work>
void for_each_piece(std::size_t count, std::size_t grain, Work work)
{
  const std::size_t pieces = (count + grain - 1) / grain;
  const std::size_t threads = std::min(thread_count(), pieces);
  std::vector<std::exception_ptr> failures(pieces);
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t piece = next++; piece < pieces; piece = next++) {
      try {
        work(piece * grain, std::min(count, (piece + 1) * grain));
      } catch (...) {
        failures[piece] = std::current_exception();
      }
    }
  };
  std::vector<std::future<void>> others;
  for (std::size_t other = 1; other < threads; other++)
    others.push_back(std::async(std::launch::async, run));
  run();
  for (auto &other : others) other.get();
  for (const auto &failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace spherocylinder
