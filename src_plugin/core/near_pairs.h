// SPDX-License-Identifier: GPL-2.0-or-later
// Finds the rods that are near one another.
#pragma once

#include <cstdint>
#include <vector>

#include "core/capsule.h"
#include "core/closest_points_batch.h"

namespace spherocylinder {

// Bounding spheres of rods of aspect ratio lambda overlap lambda times as often as the rods are near.
// Here each rod is entered in the cells of a grid, some rod diameters wide, that a tube around its
// axis passes through; two rods are looked at if they share a cell. Time and memory grow with the
// length of the rods and with the number of pairs found.
//
// No rod is overlooked: where the axes are nearer than r_i + r_j + gap, the point between their
// closest points at r_i + gap/2 from the axis of i, at most r_j + gap/2 from that of j, lies in a cell
// of both. Each tube is covered by cubes centred on points of the axis no more than `spacing` apart;
// the edge of i's cubes is 2 r_i + gap + spacing. Cells are as wide for a rod of the mean radius, whose
// cubes so touch eight at most; a thick rod among thin ones is entered in more.
class NearPairs {
 public:
  // Finds all pairs (i, j), i < owned and i < j, whose surfaces are nearer than `gap` >= 0 (m). Rods
  // from `owned` on are looked at as partners only, and may lie far from the others.
  void find(const std::vector<Capsule> &rods, int owned, double gap);

  // The partners of rod i are partners()[first(i)] ... partners()[first(i + 1) - 1], in ascending
  // order.
  int first(int i) const { return first_[i]; }
  const std::vector<int> &partners() const { return partners_; }

  // What the search looked at: the cells of all rods, and the pairs whose distance it worked out.
  int64_t cells() const { return static_cast<int64_t>(cells_of_rods_.size()); }
  int64_t tried() const { return tried_; }

 private:
  // The grid: a box around the tubes of the owned rods.
  Vec3 low_{};
  double cells_a_metre_ = 0.0;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  double spacing_ = 0.0;  // of the cubes on an axis, at most (m)

  std::vector<int> first_of_cell_, rods_in_cells_;  // rods of each cell, ascending
  std::vector<int> first_of_rod_, cells_of_rods_;   // cells of each rod
  std::vector<int> last_seen_;                      // of each rod: whose candidate it was last
  std::vector<int> first_, partners_, candidates_;
  int64_t tried_ = 0;
  SegmentPairs batch_{};

  int cubes_on(const Segment &segment) const;
  void lay_grid(const std::vector<Capsule> &rods, int owned, double gap);
  void enter_rod(const Capsule &rod, double gap);
  void enter_rods(const std::vector<Capsule> &rods, double gap);
  void keep_near(const std::vector<Capsule> &rods, int i, double gap);
};

}  // namespace spherocylinder
