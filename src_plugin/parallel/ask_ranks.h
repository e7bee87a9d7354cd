// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <mpi.h>

#include "parallel/from_all_ranks.h"

namespace LAMMPS_NS {

// What a question of any rank has been answered, by whichever rank knows.
class Answers {
 public:
  Answers(int values, std::vector<double> rows) : width_(1 + values), rows_(std::move(rows)) {}
  // Of this rank's question n: null if no rank has answered.
  const double *of(int n) const
  {
    const double *row = &rows_[static_cast<size_t>(n) * width_];
    return row[0] != 0.0 ? row + 1 : nullptr;
  }

 private:
  int width_;
  std::vector<double> rows_;
};

// Collective; for questions that are few. `asked`: of this rank, `numbers` for each question.
// `answer(question, values)` is called for those of all ranks, and is true on at most one of them, which has
// filled in the values.
template <typename Answer>
Answers ask_ranks(MPI_Comm world, const std::vector<int> &asked, int numbers, int values,
                  Answer answer)
{
  const std::vector<int> questions = from_all_ranks(world, asked);
  const int all = static_cast<int>(questions.size()), own = static_cast<int>(asked.size());
  if (all == 0) return {values, {}};
  int up_to_own = 0;
  MPI_Scan(&own, &up_to_own, 1, MPI_INT, MPI_SUM, world);
  const int width = 1 + values;
  std::vector<double> answers(static_cast<size_t>(all / numbers) * width, 0.0), sum(answers.size());
  for (int n = 0; n < all / numbers; n++) {
    double *row = &answers[static_cast<size_t>(n) * width];
    if (answer(&questions[n * numbers], row + 1)) row[0] = 1.0;
  }
  MPI_Allreduce(answers.data(), sum.data(), static_cast<int>(sum.size()), MPI_DOUBLE, MPI_SUM,
                world);
  const auto first = sum.begin() + static_cast<std::ptrdiff_t>((up_to_own - own) / numbers) * width;
  return {values, {first, first + static_cast<std::ptrdiff_t>(own / numbers) * width}};
}

}  // namespace LAMMPS_NS
