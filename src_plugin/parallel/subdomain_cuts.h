// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "lmptype.h"

namespace LAMMPS_NS {

class LAMMPS;

// Where the box is cut into the ranks' subdomains: the splits of LIGGGHTS's Comm, moved along one
// dimension after the other until the slabs between them cost the same: as many rods, or, by `weight
// neigh`, rods that cost 1 each and so much more for each of their close pairs.
//
// Cuts are fractions of the box, 0 and 1 at its ends. They stay a neighbour skin apart. Rods that
// belong further away than to the next rank then are handed over by the atom style (far_rods.h).
class SubdomainCuts {
 public:
  // arg: thresh shift dimstr Niter stopthresh, weight neigh F if wanted. `who` begins the messages
  // ("Fix balance (id b)").
  SubdomainCuts(LAMMPS *lmp, const std::string &who, int narg, char **arg);

  // What must hold at the start of a run: an orthogonal box with room for the cuts.
  void init() const;

  // Whether rods are to be weighed by their close pairs; `close_pairs`, below, are then those of each
  // rod of this rank, else they are not looked at.
  bool weighs_pairs() const { return pair_cost_ > 0.0; }

  // What the rank costs that has most to do, in rods.
  double largest_cost(const std::vector<int> &close_pairs) const;
  // The same over the mean; 1 if there are no rods.
  double imbalance(const std::vector<int> &close_pairs) const;
  double threshold() const { return threshold_; }

  // Moves the cuts for the rods as they lie now; whether any has moved. The caller hands the rods
  // over: Domain::set_local_box, Comm::setup, Comm::exchange.
  bool shift(const std::vector<int> &close_pairs) const;

  // "z cuts: 0 0.5 1", a dimension after the other.
  std::string text() const;

 private:
  LAMMPS *lmp_;
  std::string who_;
  double threshold_ = 1.0;       // imbalance above which the cuts are moved
  double stop_threshold_ = 1.0;  // of the slabs, at which bisection stops
  int iterations_ = 0;           // bisections at most
  std::vector<int> dimensions_;
  double pair_cost_ = 0.0;  // of a close pair to each of its rods, over that of a rod without any

  // Whole numbers, whose sums are the same on any number of ranks.
  struct Load {
    bigint rods = 0, pairs = 0;
  };
  double cost(const Load &load) const
  {
    return static_cast<double>(load.rods) + pair_cost_ * static_cast<double>(load.pairs);
  }

  void read_weight(int narg, char **arg);
  Load own_load(const std::vector<int> &close_pairs) const;
  Load sum_of_ranks(const Load &mine) const;
  bool shift_along(int dimension, const std::vector<int> &close_pairs) const;
  std::vector<double> equal_cuts(int dimension, const std::vector<double> &old_cuts,
                                 const std::vector<int> &close_pairs) const;
  std::vector<double> costs_below(const std::vector<double> &cuts,
                                  const std::vector<double> &places,
                                  const std::vector<bigint> &pairs_before) const;
  double slab_imbalance(const std::vector<double> &below, double all) const;
};

}  // namespace LAMMPS_NS
