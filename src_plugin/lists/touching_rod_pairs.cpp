// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/touching_rod_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lists/joint_shares.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Of a thread: fewer are done sooner than others are told.
constexpr int kFewestClosePairs = 100;
constexpr int kPastAll = std::numeric_limits<int>::max();
// How many pairs ahead rods are asked for.
constexpr int kAhead = 2 * kBatch;
// What is kept of so many rods is near a core in any case.
constexpr size_t kMostNearRods = 5000;

}  // namespace

void TouchingRodPairs::make_room(size_t close)
{
  // Lanes are written and read up to a batch behind the last.
  const size_t room = close + kBatch;
  if (shares_ && share_.size() < room) {
    for (std::vector<double> *numbers : {&share_, &beyond_i_, &beyond_j_}) numbers->resize(room);
    push_i_.resize(room);
    push_j_.resize(room);
  }
  if (of_close_.size() >= room) return;
  of_close_.resize(room);
  for (std::vector<double> *numbers :
       {&s_, &t_, &delta_x_, &delta_y_, &delta_z_, &distance_squared_, &nearly_parallel_})
    numbers->resize(room);
}

// Both ranks that see a pair across their border must get the same points, to the last bit, and of
// equally near ones the choice depends on the order: it is that of the rods' ids.
void TouchingRodPairs::Searcher::set(const CloseRodPairs::Entry *entries, int count,
                                     const std::vector<Capsule> &rods)
{
  for (int k = 0; k < count; k++) {
    const Capsule *i = &rods[entries[k].i], *j = &rods[entries[k].j];
    const bool swap = entries[k].swapped;
    first[k] = swap ? j : i;
    second[k] = swap ? i : j;
    swapped[k] = swap;
  }
  std::fill(first + count, first + kBatch, first[0]);
  std::fill(second + count, second + kBatch, second[0]);
  set_pairs(batch, first, second);
}

void TouchingRodPairs::Searcher::make_certain(int count)
{
  for (int k = 0; k < count; k++) {
    if (batch.uncertain[k] == 0.0) continue;
    spherocylinder::make_certain(batch, k, first[k]->segment, second[k]->segment);
    batch.nearly_parallel[k] = 1.0;  // spread_contact is to look for itself
  }
}

// Without a branch a pair: which of the close ones touch is not to be guessed. Each is written behind
// the last that does.
void TouchingRodPairs::keep_touching(Piece &piece, Searcher &searcher, int start, int count,
                                     int **contact_flags)
{
  const CloseRodPairs::Entry *entries = close_->data() + start;
  const SegmentPairs &batch = searcher.batch;
  int n = piece.first + piece.count;
  int *of_close = of_close_.data();
  double *s = s_.data(), *t = t_.data(), *x = delta_x_.data(), *y = delta_y_.data(),
         *z = delta_z_.data(), *distance_squared = distance_squared_.data(),
         *nearly_parallel = nearly_parallel_.data();
  for (int k = 0; k < count; k++) {
    const bool touches = batch.touches(k);
    of_close[n] = start + k;
    s[n] = batch.s[k];
    t[n] = batch.t[k];
    x[n] = batch.delta.x[k];
    y[n] = batch.delta.y[k];
    z[n] = batch.delta.z[k];
    distance_squared[n] = batch.distance_squared[k];
    nearly_parallel[n] = batch.nearly_parallel[k];
    n += touches;
    const bool is_flagged = contact_flags && contact_flags[entries[k].i][entries[k].index];
    if (is_flagged & !touches) searcher.parted.push_back(entries[k]);
  }
  piece.count = n - piece.first;
}

void TouchingRodPairs::place_beyond(int n, const Segment &i, const Segment &j, double beyond_i,
                                    double beyond_j, bool swapped)
{
  const Segment a = extended(i, beyond_i), b = extended(j, beyond_j);
  ClosestPoints points = swapped ? closest_points(b, a) : closest_points(a, b);
  if (swapped) points = {points.t, points.s, -points.delta, points.distance_squared};
  points = on_rods(points, beyond_i, beyond_j);
  s_[n] = points.s;
  t_[n] = points.t;
  delta_x_[n] = points.delta.x;
  delta_y_[n] = points.delta.y;
  delta_z_[n] = points.delta.z;
  distance_squared_[n] = points.distance_squared;
}

// Those that are a neighbour's are taken out, the others move up.
void TouchingRodPairs::share(Piece &piece, Searcher &searcher, const std::vector<Capsule> &rods,
                             int **contact_flags)
{
  int n = piece.first;
  for (int from = piece.first; from < piece.first + piece.count; from++) {
    const CloseRodPairs::Entry &entry = pair(from);
    const JointShares::Share of_i = shares_->of_one(entry.i, entry.j, rods, s_[from], t_[from]);
    const JointShares::Share of_j = shares_->of_one(entry.j, entry.i, rods, t_[from], s_[from]);
    const double share = of_i.share * of_j.share;
    if (!(share > 0.0)) {
      if (contact_flags && contact_flags[entry.i][entry.index]) searcher.parted.push_back(entry);
      continue;
    }
    share_[n] = share;
    push_i_[n] = of_j.share * of_i.push;
    push_j_[n] = of_i.share * of_j.push;
    beyond_i_[n] = of_i.beyond;
    beyond_j_[n] = of_j.beyond;
    if (of_i.beyond != 0.0 || of_j.beyond != 0.0)
      place_beyond(from, rods[entry.i].segment, rods[entry.j].segment, of_i.beyond, of_j.beyond,
                   entry.swapped);
    if (n != from) {
      of_close_[n] = of_close_[from];
      for (std::vector<double> *numbers :
           {&s_, &t_, &delta_x_, &delta_y_, &delta_z_, &distance_squared_, &nearly_parallel_})
        (*numbers)[n] = (*numbers)[from];
    }
    n++;
  }
  piece.count = n - piece.first;
}

// Pieces of about as many close pairs, which begin with a rod's first: all pairs with a rod in the place of
// i are in one.
void TouchingRodPairs::cut(const RodThreads &threads,
                           const std::vector<CloseRodPairs::Entry> &close, size_t rods)
{
  close_ = &close;
  make_room(close.size());
  const int pairs = static_cast<int>(close.size());
  const int pieces = threads.pieces_of(pairs, kFewestClosePairs);
  pieces_.clear();
  for (int piece = 0, first = 0; piece < pieces; piece++) {
    first = std::max(first, RodThreads::first_of(piece, pieces, pairs));
    while (piece > 0 && first < pairs && close[first].i == close[first - 1].i) first++;
    const int next_rod = first < pairs ? close[first].i : kPastAll;
    if (piece > 0) pieces_.back().next_rod = next_rod;
    pieces_.push_back({first, 0, piece == 0 ? 0 : next_rod, kPastAll});
  }
  are_rods_far_ = pieces > 1 || rods > kMostNearRods;
  if (searchers_.size() < pieces_.size()) searchers_.resize(pieces);
}

void TouchingRodPairs::find(int piece, const std::vector<Capsule> &rods, int **contact_flags)
{
  Piece own = pieces_[piece];  // not beside those that other threads write
  Searcher &searcher = searchers_[piece];
  const CloseRodPairs::Entry *close = close_->data();
  const bool are_far = are_rods_far();
  const bool is_last = piece + 1 == static_cast<int>(pieces_.size());
  const int end = is_last ? static_cast<int>(close_->size()) : pieces_[piece + 1].first;
  searcher.parted.clear();
  own.count = 0;
  for (int start = own.first; start < end; start += kBatch) {
    const int count = std::min(kBatch, end - start);
    if (are_far)
      for (int k = start + kAhead; k < std::min(start + kAhead + kBatch, end); k++)
        fetch_early(rods[close[k].j]);
    searcher.set(close + start, count, rods);
    search_(searcher.batch);
    if (any_above(searcher.batch.uncertain, 0.0, count)) searcher.make_certain(count);
    swap_pairs(searcher.batch, searcher.swapped);
    keep_touching(own, searcher, start, count, contact_flags);
  }
  if (shares_) share(own, searcher, rods, contact_flags);
  pieces_[piece].count = own.count;
}

int TouchingRodPairs::count() const
{
  int count = 0;
  for (const Piece &piece : pieces_) count += piece.count;
  return count;
}

TouchingRodPairs::Touch TouchingRodPairs::touch(int n) const
{
  const CloseRodPairs::Entry &entry = pair(n);
  return {entry.i,
          entry.j,
          entry.index,
          {s_[n], t_[n], {delta_x_[n], delta_y_[n], delta_z_[n]}, distance_squared_[n]},
          std::sqrt(distance_squared_[n]),
          nearly_parallel_[n] != 0.0,
          shares_ ? beyond_i_[n] : 0.0,
          shares_ ? beyond_j_[n] : 0.0};
}
