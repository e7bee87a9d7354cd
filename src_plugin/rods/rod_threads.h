// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>

#include "pointers.h"

namespace LAMMPS_NS {

// The threads of a rank, which share its rods and contacts: each works out a piece of what there is to do,
// pieces that follow each other in its order. What a thread writes must be of its own piece only, so that
// the result does not depend on how many there are. Attached to the rods.
class RodThreads : private Pointers {
 public:
  static constexpr int kMost = 1024;

  explicit RodThreads(LAMMPS *lmp);

  // By the pair style's keyword, which wins over OMP_NUM_THREADS; 0 without it. 1 without either.
  void want(int count) { wanted_ = count > 0 ? count : of_environment_; }
  int count() const { return count_; }
  // At the start of a run: how many there are, no more than the rank has processors unless threads wait
  // without one. Said when it changes.
  void begin_run();

  // How many pieces so much work is worth: no thread has less than `least` of it, but for a single one.
  int pieces_of(int work, int least) const { return std::clamp(work / least, 1, count_); }

  // Calls work(piece) for each of them, at once, and returns when all are done. Of several works the next
  // one begins when all pieces of the one before are done.
  template <typename... Works>
  void run(int pieces, Works... works) const
  {
    if (pieces == 1) return (works(0), ...);
#pragma omp parallel num_threads(pieces)
    {
      bool is_first = true;
      const auto run_next = [&](auto &work) {
        if (!is_first) wait_for_all();
        is_first = false;
        run_pieces(pieces, work);
      };
      (run_next(works), ...);
    }
  }

  // Calls work(first, last) for parts of 0 ... number - 1.
  template <typename Work>
  void run_over(int number, int least, Work work) const
  {
    const int pieces = pieces_of(number, least);
    run(pieces, [&](int piece) {
      work(first_of(piece, pieces, number), first_of(piece + 1, pieces, number));
    });
  }
  static int first_of(int piece, int pieces, int number)
  {
    return static_cast<int>(static_cast<long>(number) * piece / pieces);
  }

 private:
  int of_environment_ = 1, wanted_ = 1, count_ = 1;
  int told_ = 1, told_count_ = 1;  // of `wanted_`, and what came of it

  int from_environment() const;
  int processors_of_a_rank() const;
  // Within a parallel region.
  static void wait_for_all()
  {
#pragma omp barrier
  }
  template <typename Work>
  static void run_pieces(int pieces, Work &work)
  {
#pragma omp for schedule(static, 1) nowait
    for (int piece = 0; piece < pieces; piece++) work(piece);
  }
};

}  // namespace LAMMPS_NS
