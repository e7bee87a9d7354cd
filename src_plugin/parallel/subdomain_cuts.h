// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

namespace LAMMPS_NS {

class LAMMPS;

// Where the box is cut into the ranks' subdomains: the splits of LIGGGHTS's Comm, moved along one
// dimension after the other until the slabs between them hold equal numbers of rods.
//
// Cuts are fractions of the box, 0 and 1 at its ends. They stay a neighbour skin apart. Rods that
// belong further away than to the next rank then are handed over by the atom style (far_rods.h).
class SubdomainCuts {
 public:
  // arg: thresh shift dimstr Niter stopthresh. `who` begins the messages ("Fix balance (id b)").
  SubdomainCuts(LAMMPS *lmp, const std::string &who, int narg, char **arg);

  static constexpr int kArguments = 5;

  // What must hold at the start of a run: an orthogonal box with room for the cuts.
  void init() const;

  // The largest number of rods of a rank over the mean; 1 if there are no rods.
  double imbalance() const;
  double threshold() const { return threshold_; }

  // Moves the cuts for the rods as they lie now; whether any has moved. The caller hands the rods
  // over: Domain::set_local_box, Comm::setup, Comm::exchange.
  bool shift() const;

  // "z cuts: 0 0.5 1", a dimension after the other.
  std::string text() const;

 private:
  LAMMPS *lmp_;
  std::string who_;
  double threshold_ = 1.0;       // imbalance above which the cuts are moved
  double stop_threshold_ = 1.0;  // of the slabs, at which bisection stops
  int iterations_ = 0;           // bisections at most
  std::vector<int> dimensions_;

  bool shift_along(int dimension) const;
  std::vector<double> equal_cuts(int dimension, const std::vector<double> &old_cuts) const;
};

}  // namespace LAMMPS_NS
