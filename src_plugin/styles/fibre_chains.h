// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/rod_joint.h"
#include "pointers.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;
class FibreSegments;

// Makes chains of rods, what is done once to a fibre: all ranks see all of its rods and come to the same
// result, each writes its own rods. Every function is called by all ranks; `who` begins its errors.
class FibreChains : protected Pointers {
 public:
  // Radii of neighbours may differ by what printing six digits costs.
  static constexpr double kSameRadius = 1e-5;

  FibreChains(LAMMPS *lmp, std::string who);

  // Joins the segments that have a fibre and a place, but are not joined yet: those at places that follow
  // each other, by the ends that are nearest. They must meet within `tolerance` diameters. Returns the
  // number of joints.
  int join_places(double tolerance);

  // Makes chains of the group's rods that are no segments yet and whose ends meet within `tolerance`
  // diameters. Returns the number of joints.
  int join_meeting_ends(int groupbit, double tolerance);

  // Gives the joints that have none a state without load: as they are now, or the same curvature (1/m,
  // towards body x) and twist (rad/m) everywhere.
  void give_present_rest();
  void give_rest(double curvature, double twist);

  // Of this rank's rods: by how many periods of the box each segment is beyond its place beside the first of
  // its chain; of rods that are no segments 0. A ring that goes round a periodic box is an error.
  struct Periods {
    int number[3] = {0, 0, 0};
  };
  std::vector<Periods> periods_beyond_first();

  // After rods have gone: the joints they had are no more. Returns their number.
  int cut_lost_joints();

 private:
  struct Rod {
    int id, rank, local;  // place in memory of its rank
    int fibre, place, ends;
    double radius;
    spherocylinder::JointedRod pose;
    spherocylinder::JointRest rest;
  };
  // In the order of the chain, heads towards the next.
  struct Chain {
    std::vector<int> rods;
    bool is_ring = false;
  };

  std::string who_;
  AtomVecSpherocylinder &atoms_;
  FibreSegments &segments_;
  int me_ = 0;
  std::vector<Rod> rods_;

  template <typename IsWanted>
  void gather(IsWanted is_wanted);
  void put_back(const Rod &rod) const;
  void flip(int rod);
  spherocylinder::Vec3 from_to(const spherocylinder::Vec3 &a, const spherocylinder::Vec3 &b) const;
  Periods periods_between(const spherocylinder::Vec3 &a, const spherocylinder::Vec3 &b) const;
  spherocylinder::Vec3 end_of(int rod, bool head) const;
  double gap(int rod, bool head, int other, bool other_head) const;
  void check_places() const;
  void check_ends(int first, int last) const;
  void check_can_join(int k, int next) const;
  Chain chain_by_places(int first, int last, double tolerance);
  int join(const Chain &chain, int fibre);
  void bring_frames_along(const Chain &chain);
  std::vector<int> partners_of_ends(double tolerance) const;
  int walk(const std::vector<int> &partners, int start, int fibre, std::vector<char> &is_done);
  template <typename Rest>
  void give_rest_by(Rest rest);
};

}  // namespace LAMMPS_NS
