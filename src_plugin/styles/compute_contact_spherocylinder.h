// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/spherocylinder, ComputeContactSpherocylinder)

#else

#ifndef LMP_COMPUTE_CONTACT_SPHEROCYLINDER_H
#define LMP_COMPUTE_CONTACT_SPHEROCYLINDER_H

#include <vector>

#include "compute.h"

namespace LAMMPS_NS {

// Contacts of each rod with other rods, by true shape, and overlap statistics of a group.
class ComputeContactSpherocylinder : public Compute {
 public:
  ComputeContactSpherocylinder(LAMMPS *lmp, int &iarg, int narg, char **arg);
  void init() override;
  void init_list(int id, class NeighList *ptr) override;
  void compute_peratom() override;
  void compute_vector() override;
  double memory_usage() override;

 private:
  class NeighList *list_ = nullptr;
  std::vector<double> contacts_;
  // This rank's share; a contact with a ghost counts half here, half on the ghost's rank.
  double pairs_ = 0.0;            // contacts with both rods in the group
  double overlap_sum_ = 0.0;      // of overlap / diameter over those
  double largest_overlap_ = 0.0;  // overlap / diameter
  double values_[5] = {};

  void visit_contacts();
};

}  // namespace LAMMPS_NS

#endif
#endif
