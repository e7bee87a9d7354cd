// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(joint/spherocylinder/local, ComputeJointLocalSpherocylinder)

#else

#ifndef LMP_COMPUTE_JOINT_LOCAL_SPHEROCYLINDER_H
#define LMP_COMPUTE_JOINT_LOCAL_SPHEROCYLINDER_H

#include <vector>

#include "compute.h"
#include "styles/fix_joint_spherocylinder.h"

namespace LAMMPS_NS {

class FibreSegments;

// One row a joint of fibres, on the rank of its first rod: where it is, what it bears and how it is bent, as fix
// joint/spherocylinder worked it out in the last step.
class ComputeJointLocalSpherocylinder : public Compute {
 public:
  ComputeJointLocalSpherocylinder(LAMMPS *lmp, int &iarg, int narg, char **arg);
  void init() override;
  void compute_local() override;
  double memory_usage() override;

 private:
  const FibreSegments &segments_;
  const FixJointSpherocylinder *joints_ = nullptr;
  std::vector<int> columns_;  // by places in the list of names
  std::vector<double> numbers_;
  std::vector<double *> rows_;

  void put_row(const FixJointSpherocylinder::State &joint);
};

}  // namespace LAMMPS_NS

#endif
#endif
