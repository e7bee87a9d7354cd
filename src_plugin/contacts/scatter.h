// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "contacts/contact_batch.h"
#include "core/prefetch.h"
#include "lists/touching_rod_pairs.h"

namespace LAMMPS_NS {

class Atom;
class PairGran;

// Forces and torques of a batch to the rods: to both of a pair where this rank owns them, relaxed as
// LIGGGHTS's pair style has it; to the rod of a wall.
void scatter_pairs(const ContactBatch &batch, PairGran &pair, Atom &atom);
void scatter_walls(const ContactBatch &batch, Atom &atom);

// The same by several threads, each with a piece of the touching pairs. Every rod gets its loads in the order
// of the list, as from scatter_pairs: of two rods of this rank i is the lower (see RodPairList), so that a
// thread adds to none of one before it; a rod that pairs of threads before have a load for waits for these.
class SharedScatter {
 public:
  // Before the pieces, in this order, all of them done with the one before.
  void begin(const TouchingRodPairs &touching, PairGran &pair, Atom &atom);
  void find_later_rods(int piece);
  // Then of each batch of a piece, after all have found theirs.
  void find_waiting_rods(int piece);
  void add(int piece, const ContactBatch &batch);
  // After all have added theirs.
  void add_to_waiting_rods(int piece);

 private:
  struct Load {
    int rod;
    spherocylinder::Vec3 force, torque;
  };
  struct alignas(spherocylinder::kCacheLine) Part {
    int next_rod;
    int next_pair = 0;  // to be added
    // By thread, those after this one: its rods with pairs of this one, and what they get of these.
    std::vector<std::vector<int>> later_rods;
    std::vector<std::vector<Load>> later;
    std::vector<int> waiting_rods;  // of this one, with pairs of threads before
    std::vector<Load> waiting;
  };
  const TouchingRodPairs *touching_ = nullptr;
  PairGran *pair_ = nullptr;
  Atom *atom_ = nullptr;
  std::vector<Part> parts_;
  std::vector<int> next_rods_;  // of each thread, where the next one's begin
  std::vector<char> waits_;     // of each owned rod

  void fetch_next(int piece) const;
  int later_piece_of(int piece, int rod) const;
};

}  // namespace LAMMPS_NS
