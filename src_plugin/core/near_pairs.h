// SPDX-License-Identifier: GPL-2.0-or-later
// Finds the rods that are near one another.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/capsule.h"
#include "core/closest_points_batch.h"

namespace spherocylinder {

// Who searches: `run` calls work(piece) for 0 ... count - 1, each once and maybe at once, and returns when all
// are done. What is found does not depend on it.
struct SearchPieces {
  int count = 1;
  std::function<void(const std::function<void(int)> &work)> run = [](const auto &work) { work(0); };
};

// Bounding spheres of rods of aspect ratio lambda overlap lambda times as often as the rods are near.
// Here each rod is entered in the cells of a grid, some rod diameters wide, that a tube around its
// axis passes through; two rods are looked at if they share a cell. Time and memory grow with the
// length of the rods and with the number of pairs found, not with the space between the rods: cells
// are looked up by a table of as many buckets as rods want, each with the rods of its cells.
//
// No rod is overlooked: where the axes are nearer than r_i + r_j + gap, the point between their
// closest points at r_i + gap/2 from the axis of i, at most r_j + gap/2 from that of j, lies in a cell
// of both. Each tube is covered by cubes centred on points of the axis no more than `spacing` apart;
// the edge of i's cubes is 2 r_i + gap + spacing. Cells are as wide for a rod of the mean radius, whose
// cubes so touch eight at most; a thick rod among thin ones is entered in more.
class NearPairs {
 public:
  struct Pair {
    int i, j;  // i < j
  };

  // Finds all pairs (i, j), i < owned and i < j, whose surfaces are nearer than `gap` >= 0 (m). Rods
  // from `owned` on are looked at as partners only, and may lie far from the others.
  void find(const std::vector<Capsule> &rods, int owned, double gap,
            const SearchPieces &pieces = {});

  // Of the same rods some have `moved`, the others are where they were: finds the pairs of these, as
  // found() has them, at a cost that grows with their number only. False if all want to be looked at
  // again: a rod has left the grid, or the grid is full of places where rods have been.
  bool find_again(const std::vector<Capsule> &rods, const std::vector<int> &moved,
                  const SearchPieces &pieces = {});

  // The partners of rod i are partners()[first(i)] ... partners()[first(i + 1) - 1], in ascending
  // order; after find.
  int first(int i) const { return first_[i]; }
  const std::vector<int> &partners() const { return partners_; }
  // In no order; after find_again.
  const std::vector<Pair> &found() const { return found_; }

  // What the search looked at: the cells of all rods that it entered, and the pairs whose distance it
  // worked out.
  int64_t cells() const { return cells_; }
  int64_t tried() const { return tried_; }

 private:
  // A rod in a cell, and the entry before it of the same bucket. Rods are entered one after the other:
  // those before a rod's entries are the ones it shares cells with, of those entered until then.
  struct Entry {
    int rod;     // kGone: it has been entered elsewhere since
    int before;  // kNone: the first
  };
  struct Entries {
    int first, end;
  };

  // The grid: a box around the tubes of the owned rods and some space.
  Vec3 low_{}, high_{};
  double cells_a_metre_ = 0.0;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  uint32_t row_ = 0, plane_ = 0;  // from the number of a cell to that of the next in y and in z
  double spacing_ = 0.0;          // of the cubes on an axis, at most (m)
  int owned_ = 0;
  double gap_ = 0.0;

  std::vector<int> last_of_bucket_;  // its number is that of the cell, less the high bits
  uint32_t bucket_bits_ = 0;
  std::vector<Entry> entries_;
  std::vector<Entries> of_rods_;
  size_t most_entries_ = 0;  // until rods are entered anew

  // What one piece of the rods is looked up with.
  struct LookUp {
    std::vector<int> last_seen;  // of each rod: in which look-up it was a candidate last
    int look_ups = 0;
    std::vector<int> candidates, partners;
    std::vector<Pair> found;
    int64_t tried = 0;
    SegmentPairs batch{};

    void forget();
    void begin(size_t rods);
  };
  std::vector<LookUp> look_ups_;
  std::vector<int> first_, partners_;
  std::vector<Pair> found_;
  int64_t cells_ = 0, tried_ = 0;

  int cubes_on(const Segment &segment) const;
  Vec3 extent_of(const Capsule &rod) const;
  bool lies_in_grid(const Capsule &rod) const;
  void lay_grid(const std::vector<Capsule> &rods);
  void make_buckets(double cubes);
  void enter(int i, const Capsule &rod);
  template <typename Look>
  void look_up_all(const std::vector<Capsule> &rods, int number, const SearchPieces &pieces,
                   Look look);
  void look_up(const std::vector<Capsule> &rods, int i, LookUp &own) const;
  void keep_near(const std::vector<Capsule> &rods, int i, LookUp &own) const;
};

}  // namespace spherocylinder
