// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/touching_rod_pairs.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace spherocylinder;

// Both ranks that see a pair across their border must get the same points, to the last bit, and of
// equally near ones the choice depends on the order: it is that of the rods' ids.
void TouchingRodPairs::find(const std::vector<CloseRodPairs::Entry> &close,
                            const std::vector<Capsule> &rods, const int *tag, int **contact_flags)
{
  touching_.clear();
  parted_.clear();
  for (size_t start = 0; start < close.size(); start += kBatch) {
    const int count = static_cast<int>(std::min<size_t>(kBatch, close.size() - start));
    const CloseRodPairs::Entry *entries = &close[start];
    bool swapped[kBatch];
    for (int k = 0; k < count; k++) {
      const int i = entries[k].i, j = entries[k].j;
      swapped[k] = tag[j] < tag[i];
      const Capsule &first = rods[swapped[k] ? j : i], &second = rods[swapped[k] ? i : j];
      batch_.set(k, first.segment, second.segment, first.radius + second.radius);
    }
    search_(batch_);

    for (int k = 0; k < count; k++) {
      const CloseRodPairs::Entry &entry = entries[k];
      if (batch_.uncertain[k] != 0.0) {
        const int first = swapped[k] ? entry.j : entry.i, second = swapped[k] ? entry.i : entry.j;
        make_certain(batch_, k, rods[first].segment, rods[second].segment);
      }
      const double reach = batch_.reach[k];
      if (batch_.distance_squared[k] >= reach * reach) {
        if (contact_flags && contact_flags[entry.i][entry.index]) parted_.push_back(entry);
        continue;
      }
      ClosestPoints points = batch_.get(k);
      if (swapped[k]) points = {points.t, points.s, -points.delta, points.distance_squared};
      // Where the batch is uncertain, spread_contact is to look for itself.
      touching_.push_back({entry.i, entry.j, entry.index, points,
                           std::sqrt(points.distance_squared),
                           batch_.uncertain[k] != 0.0 || batch_.nearly_parallel[k] != 0.0});
    }
  }
}
