// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(joint/spherocylinder, FixJointSpherocylinder)

#else

#ifndef LMP_FIX_JOINT_SPHEROCYLINDER_H
#define LMP_FIX_JOINT_SPHEROCYLINDER_H

#include <string>
#include <vector>

#include "core/joint_constants.h"
#include "core/joint_strength.h"
#include "core/rod_joint.h"
#include "fix.h"
#include "lists/fibre_joints.h"
#include "lists/fibre_partings.h"
#include "rods/ghost_user.h"

namespace LAMMPS_NS {

class FibreSegments;
class RodThreads;

// Holds the segments of flexible fibres together: the elastic joints of core/rod_joint.h, measured anew
// from the poses of rods and ghosts in each step. Each rank adds to its own rods only. What is not elastic, the
// bend without load after yielding and which joints broke, is in the rods' rows of FibreSegments.
class FixJointSpherocylinder : public Fix, public GhostUser {
 public:
  FixJointSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void post_create() override;
  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void post_force(int vflag) override;
  void post_run() override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  void add_used_ghosts(std::vector<int> &ghosts) const override;

  // A bound on what the joints of owned rod i add to the square of the highest frequency (1/s^2), damping
  // counted; as of the last step.
  double squared_frequency(int i) const { return squared_frequency_[i]; }

  // Across, of a joint between two rods like rod i (N/m).
  double shear_stiffness(int i) const
  {
    return stretch_factor_ * joint_stiffness(beam_half(i), beam_half(i)).shear;
  }

  // A joint as of the last step: its two rods, the load on the first, what is energy and what it is without
  // load.
  struct State {
    int first, second;
    const spherocylinder::JointLoad &load;
    const spherocylinder::JointStrain &strain;
    const spherocylinder::JointChannels &stiffness;
    const spherocylinder::JointRest &rest;
    double distance;  // of joints (m)
  };
  int joints() const { return static_cast<int>(joints_.joints().size()); }
  State state(int k) const;

 private:
  enum class Rest { Straight, Present };

  FibreJoints joints_;
  const RodThreads *threads_ = nullptr;
  FibreSegments *segments_ = nullptr;
  double youngs_modulus_ = 0.0;  // Pa, 0: property/global youngsModulus, by type
  double poissons_ratio_ = 0.0;
  bool has_poissons_ratio_ = false;
  double stretch_factor_ = 1.0, bend_factor_ = 1.0;
  spherocylinder::JointChannels ratios_{0.0, 0.0, 0.0, 0.0};  // damping
  Rest rest_ = Rest::Straight;
  double rest_curvature_ = 0.0, rest_twist_ = 0.0;  // 1/m, rad/m
  double join_ = 0.0;                               // diameters, 0: nothing
  double yield_stress_ = 0.0, yield_moment_ = 0.0;  // Pa, N m; both 0: elastic
  spherocylinder::JointStrength strength_;

  // Of each joint in joints_, what stays while rods and ghosts stay where they are in memory.
  struct Constants {
    spherocylinder::JointChannels stiffness, damping;
    spherocylinder::JointRest rest;
    double yield_moment;  // N m
  };
  std::vector<Constants> constants_;
  std::vector<spherocylinder::JointLoad> loads_;
  std::vector<spherocylinder::JointStrain> strains_;  // in the last step
  FibrePartings partings_;
  bool any_partings_ = false;  // on any rank
  double reported_ = 0.0;      // joints that had broken when the log was last told
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
  void check_material(int type) const;
  spherocylinder::BeamHalf beam_half(int i) const;
  spherocylinder::JointedMass jointed_mass(int i) const;
  void check_same_diameter(int i, int j) const;
  void renew();
  void check_rest() const;
  void find_frequencies();
  void compute_load(int k);
  void compute_loads();
  bool is_plastic() const { return yield_stress_ > 0.0 || yield_moment_ > 0.0; }
  void yield(int k);
  std::vector<EndsChange> changes_of_ends();
  void part();
  double sum_of_rows(double (*value)(const FibreSegments &, int)) const;
  double broken_joints() const;
  void report_broken(double now);
  void tally(int k);
};

}  // namespace LAMMPS_NS

#endif
#endif
