// SPDX-License-Identifier: GPL-2.0-or-later
// Work shared among threads, with the same result whatever their number.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <future>
#include <thread>
#include <vector>

namespace spherocylinder {

inline std::size_t thread_count() { return std::max(std::thread::hardware_concurrency(), 1u); }

// Calls work(begin, end) for pieces that make up 0 .. count, each piece once, from several threads.
// The pieces are `grain` long whatever the number of threads, so that sums kept piece by piece and
// added up in order do not depend on it. Passes on the exception of the earliest piece that throws.
template <class Work>
void for_each_piece(std::size_t count, std::size_t grain, Work work)
{
  const std::size_t pieces = (count + grain - 1) / grain;
  const std::size_t threads = std::min(thread_count(), pieces);
  std::vector<std::exception_ptr> failures(pieces);
  const auto run = [&](std::size_t first) {
    for (std::size_t piece = first; piece < pieces; piece += threads) {
      try {
        work(piece * grain, std::min(count, (piece + 1) * grain));
      } catch (...) {
        failures[piece] = std::current_exception();
      }
    }
  };
  std::vector<std::future<void>> others;
  for (std::size_t first = 1; first < threads; first++)
    others.push_back(std::async(std::launch::async, run, first));
  if (threads > 0) run(0);
  for (auto &other : others) other.get();
  for (const auto &failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace spherocylinder
