// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(balance, FixBalance)

#else

#ifndef LMP_FIX_BALANCE_H
#define LMP_FIX_BALANCE_H

#include <optional>
#include <vector>

#include "fix.h"
#include "lists/close_pair_counts.h"
#include "parallel/subdomain_cuts.h"

namespace LAMMPS_NS {

// Moves the cuts between the ranks' subdomains during a run, so that each rank keeps about as much to do
// as the others while a bed fills. It only moves cuts, just before rods are handed from rank
// to rank anyway.
class FixBalance : public Fix {
 public:
  FixBalance(LAMMPS *lmp, int narg, char **arg);
  int setmask() override;
  void post_create() override;
  void pre_delete(bool unfixed) override;
  void init() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void post_run() override;
  double compute_scalar() override;
  double compute_vector(int n) override;

 private:
  SubdomainCuts cuts_;
  std::optional<ClosePairCounts> counts_;  // where they are weighed
  double imbalance_before_ = 1.0;          // when the cuts were last looked at
  double shifts_ = 0.0;

  void balance();
  std::vector<int> pairs_now() const;
};

}  // namespace LAMMPS_NS

#endif
#endif
