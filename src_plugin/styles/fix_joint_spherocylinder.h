// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(joint/spherocylinder, FixJointSpherocylinder)

#else

#ifndef LMP_FIX_JOINT_SPHEROCYLINDER_H
#define LMP_FIX_JOINT_SPHEROCYLINDER_H

#include <string>
#include <vector>

#include "core/joint_constants.h"
#include "core/rod_joint.h"
#include "fix.h"
#include "lists/fibre_joints.h"
#include "rods/ghost_user.h"

namespace LAMMPS_NS {

class FibreSegments;
class RodThreads;

// Holds the segments of flexible fibres together: the elastic joints of core/rod_joint.h, measured anew
// from the poses of rods and ghosts in each step. Each rank adds to its own rods only.
class FixJointSpherocylinder : public Fix, public GhostUser {
 public:
  FixJointSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void post_create() override;
  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void post_force(int vflag) override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  void add_used_ghosts(std::vector<int> &ghosts) const override;

  // A bound on what the joints of owned rod i add to the square of the highest frequency (1/s^2), damping
  // counted; as of the last step.
  double squared_frequency(int i) const { return squared_frequency_[i]; }

 private:
  enum class Rest { Straight, Present };

  FibreJoints joints_;
  const RodThreads *threads_ = nullptr;
  double youngs_modulus_ = 0.0;  // Pa, 0: property/global youngsModulus, by type
  double poissons_ratio_ = 0.0;
  bool has_poissons_ratio_ = false;
  double stretch_factor_ = 1.0, bend_factor_ = 1.0;
  spherocylinder::JointChannels ratios_{0.0, 0.0, 0.0, 0.0};  // damping
  Rest rest_ = Rest::Straight;
  double rest_curvature_ = 0.0, rest_twist_ = 0.0;  // 1/m, rad/m
  double join_ = 0.0;                               // diameters, 0: nothing

  // Of each joint in joints_, what stays while rods and ghosts stay where they are in memory.
  struct Constants {
    spherocylinder::JointChannels stiffness, damping;
    spherocylinder::JointRest rest;
  };
  std::vector<Constants> constants_;
  std::vector<spherocylinder::JointLoad> loads_;
  std::vector<spherocylinder::JointStrain> strains_;  // in the last step
  std::vector<double> squared_frequency_;
  std::vector<double> moduli_, ratios_of_types_;  // by type
  int standing_groups_ = 0;
  bigint seen_builds_ = -1;
  int seen_rods_ = 0, owned_ = 0;

  void parse(int narg, char **arg);
  bool is_damped() const;
  spherocylinder::JointChannels energy() const;
  std::string name() const;
  std::vector<double> material(double value, bool is_given, const char *keyword,
                               const char *property) const;
  void check_group(const FibreSegments &segments) const;
  spherocylinder::BeamHalf beam_half(int i) const;
  spherocylinder::JointedMass jointed_mass(int i) const;
  void check_same_diameter(int i, int j) const;
  void renew();
  void find_frequencies();
  void compute_load(int k);
  void tally(int k);
};

}  // namespace LAMMPS_NS

#endif
#endif
