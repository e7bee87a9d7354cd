// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/joint_histories.h"

#include <algorithm>

#include "atom.h"
#include "comm.h"
#include "contacts/rod_pair_geometry.h"
#include "lists/close_rod_pairs.h"
#include "parallel/ask_ranks.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Of a pair (a, b) as kept by (b, a).
void copy_history(const double *from, bool turn, const HistoryLayout &layout, double *to)
{
  for (int value = 0; value < layout.values(); value++)
    to[value] = turn && layout.changes_sign(value) ? -from[value] : from[value];
}

// In the fold of a fibre its two segments are touched on two sides. Only where the axes had passed each other is
// the other side that of the new contact, too.
void forget_other_side(const TouchingRodPairs::Touch &touch, double *side)
{
  const Vec3 remembered = load(side);
  if (remembered_depth(remembered) < 1.0 && dot(remembered, touch.points.delta) < 0.0)
    store(kZero, side);
}

}  // namespace

// Both ranks that have a contact look for its sources in the same order: that of its rods' ids.
void JointHistories::find_new(const TouchingRodPairs &touching, const std::vector<Capsule> &rods,
                              const JointShares &shares, int **flags)
{
  new_.clear();
  sources_.clear();
  for (const TouchingRodPairs::Piece &piece : touching.pieces())
    for (int n = piece.first; n < piece.first + piece.count; n++) {
      const CloseRodPairs::Entry &entry = touching.pair(n);
      if (flags[entry.i][entry.index]) continue;
      const TouchingRodPairs::Touch touch = touching.touch(n);
      const int first = static_cast<int>(sources_.size());
      const auto look_at = [&](int segment, int other, double along) {
        for (const bool head : {false, true})
          if (shares.is_near_joint(segment, rods[segment], along, head,
                                   rods[other].segment.half_length))
            sources_.push_back({segment, shares.neighbour(segment, head), other});
      };
      const auto look_at_i = [&] { look_at(entry.i, entry.j, touch.points.s); };
      const auto look_at_j = [&] { look_at(entry.j, entry.i, touch.points.t); };
      if (entry.swapped) look_at_j();
      look_at_i();
      if (!entry.swapped) look_at_j();
      const int count = static_cast<int>(sources_.size()) - first;
      if (count > 0) new_.push_back({n, first, count});
    }
}

// Of the contact of two rods, null if they are not in contact or this rank has neither. `swapped`: b is
// before a in it.
const double *JointHistories::values_of(const TouchingRodPairs &touching, int a, int b,
                                        const PairHistories &histories, bool &swapped) const
{
  const std::vector<CloseRodPairs::Entry> &close = touching.close();
  for (const auto &[i, j] : {std::pair(a, b), std::pair(b, a)}) {
    if (i >= atom->nlocal) continue;
    auto entry =
        std::lower_bound(close.begin(), close.end(), i,
                         [](const CloseRodPairs::Entry &one, int rod) { return one.i < rod; });
    for (; entry != close.end() && entry->i == i; ++entry)
      if (entry->j == j && histories.flags[i][entry->index]) {
        swapped = i == b;
        return histories.values_of(i, entry->index);
      }
  }
  return nullptr;
}

void JointHistories::hand_over(const TouchingRodPairs &touching, const std::vector<Capsule> &rods,
                               const JointShares &shares, const PairHistories &histories,
                               const HistoryLayout &layout)
{
  find_new(touching, rods, shares, histories.flags);
  std::vector<int> open;  // whose source may be on other ranks only
  for (size_t k = 0; k < new_.size(); k++) {
    const CloseRodPairs::Entry &entry = touching.pair(new_[k].touch);
    double *values = histories.values_of(entry.i, entry.index);
    for (int n = 0; n < new_[k].count; n++) {
      const auto &[segment, neighbour, other] = sources_[new_[k].first + n];
      if (neighbour >= atom->nlocal && other >= atom->nlocal) {
        open.push_back(static_cast<int>(k));
        break;
      }
      bool swapped = false;
      const double *from = values_of(touching, neighbour, other, histories, swapped);
      if (!from) continue;
      copy_history(from, swapped != (entry.i == other), layout, values);
      break;
    }
  }
  if (comm->nprocs > 1) ask_others(touching, histories, layout, open);
  if (histories.remember_sides())
    for (const New &contact : new_) {
      const CloseRodPairs::Entry &entry = touching.pair(contact.touch);
      forget_other_side(touching.touch(contact.touch),
                        histories.values_of(entry.i, entry.index) + histories.side);
    }
}

// All sources of the open ones are asked for, by ids; whoever owns the other rod answers, as history of the
// segment with it.
void JointHistories::ask_others(const TouchingRodPairs &touching, const PairHistories &histories,
                                const HistoryLayout &layout, const std::vector<int> &open)
{
  std::vector<int> asked;
  for (const int k : open)
    for (int n = 0; n < new_[k].count; n++) {
      const Source &source = sources_[new_[k].first + n];
      asked.push_back(atom->tag[source.neighbour]);
      asked.push_back(atom->tag[source.other]);
    }
  const Answers answers =
      ask_ranks(world, asked, 2, layout.values(), [&](const int *ids, double *values) {
        for (const CloseRodPairs::Entry &entry : touching.close()) {
          if (!histories.flags[entry.i][entry.index]) continue;
          const int i = atom->tag[entry.i], j = atom->tag[entry.j];
          const bool swapped = i == ids[1] && j == ids[0];
          if (!swapped && !(i == ids[0] && j == ids[1])) continue;
          if ((swapped ? entry.i : entry.j) >= atom->nlocal) continue;
          copy_history(histories.values_of(entry.i, entry.index), swapped, layout, values);
          return true;
        }
        return false;
      });

  int question = 0;
  for (const int k : open) {
    const CloseRodPairs::Entry &entry = touching.pair(new_[k].touch);
    const double *from = nullptr;
    for (int n = 0; n < new_[k].count; n++, question++) {
      if (from) continue;
      from = answers.of(question);
      const bool turn = entry.i == sources_[new_[k].first + n].other;
      if (from) copy_history(from, turn, layout, histories.values_of(entry.i, entry.index));
    }
  }
}
