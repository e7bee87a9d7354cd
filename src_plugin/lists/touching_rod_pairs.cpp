// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/touching_rod_pairs.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace spherocylinder;

void TouchingRodPairs::make_room(size_t close)
{
  // Lanes are written and read up to a batch behind the last.
  const size_t room = close + kBatch;
  if (of_close_.size() >= room) return;
  of_close_.resize(room);
  for (std::vector<double> *numbers :
       {&s_, &t_, &delta_x_, &delta_y_, &delta_z_, &distance_squared_, &nearly_parallel_})
    numbers->resize(room);
}

// Both ranks that see a pair across their border must get the same points, to the last bit, and of
// equally near ones the choice depends on the order: it is that of the rods' ids.
void TouchingRodPairs::set_batch(size_t start, int count, const std::vector<Capsule> &rods)
{
  const CloseRodPairs::Entry *entries = close_->data() + start;
  for (int k = 0; k < count; k++) {
    const Capsule *i = &rods[entries[k].i], *j = &rods[entries[k].j];
    const bool swap = entries[k].swapped;
    first_[k] = swap ? j : i;
    second_[k] = swap ? i : j;
    swapped_[k] = swap;
  }
  std::fill(first_ + count, first_ + kBatch, first_[0]);
  std::fill(second_ + count, second_ + kBatch, second_[0]);
  set_pairs(batch_, first_, second_);
}

void TouchingRodPairs::make_certain(int count)
{
  for (int k = 0; k < count; k++) {
    if (batch_.uncertain[k] == 0.0) continue;
    spherocylinder::make_certain(batch_, k, first_[k]->segment, second_[k]->segment);
    batch_.nearly_parallel[k] = 1.0;  // spread_contact is to look for itself
  }
}

// Without a branch a pair: which of the close ones touch is not to be guessed. Each is written behind
// the last that does.
void TouchingRodPairs::keep_touching(size_t start, int count, int **contact_flags)
{
  const CloseRodPairs::Entry *entries = close_->data() + start;
  int n = count_;
  int *of_close = of_close_.data();
  double *s = s_.data(), *t = t_.data(), *x = delta_x_.data(), *y = delta_y_.data(),
         *z = delta_z_.data(), *distance_squared = distance_squared_.data(),
         *nearly_parallel = nearly_parallel_.data();
  for (int k = 0; k < count; k++) {
    const bool touches = batch_.touches(k);
    of_close[n] = static_cast<int>(start) + k;
    s[n] = batch_.s[k];
    t[n] = batch_.t[k];
    x[n] = batch_.delta.x[k];
    y[n] = batch_.delta.y[k];
    z[n] = batch_.delta.z[k];
    distance_squared[n] = batch_.distance_squared[k];
    nearly_parallel[n] = batch_.nearly_parallel[k];
    n += touches;
    const bool is_flagged = contact_flags && contact_flags[entries[k].i][entries[k].index];
    if (is_flagged & !touches) parted_.push_back(entries[k]);
  }
  count_ = n;
}

void TouchingRodPairs::find(const std::vector<CloseRodPairs::Entry> &close,
                            const std::vector<Capsule> &rods, int **contact_flags)
{
  close_ = &close;
  count_ = 0;
  parted_.clear();
  make_room(close.size());
  for (size_t start = 0; start < close.size(); start += kBatch) {
    const int count = static_cast<int>(std::min<size_t>(kBatch, close.size() - start));
    set_batch(start, count, rods);
    search_(batch_);
    if (any_above(batch_.uncertain, 0.0, count)) make_certain(count);
    swap_pairs(batch_, swapped_);
    keep_touching(start, count, contact_flags);
  }
}

TouchingRodPairs::Touch TouchingRodPairs::touch(int n) const
{
  const CloseRodPairs::Entry &entry = pair(n);
  return {entry.i,
          entry.j,
          entry.index,
          {s_[n], t_[n], {delta_x_[n], delta_y_[n], delta_z_[n]}, distance_squared_[n]},
          std::sqrt(distance_squared_[n]),
          nearly_parallel_[n] != 0.0};
}
