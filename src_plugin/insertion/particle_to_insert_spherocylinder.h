// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/capsule.h"
#include "core/fibre_shape.h"
#include "core/rotation.h"
#include "particleToInsert.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;
class Region;

// One rod, or one fibre with all its segments, on its way into the simulation: LIGGGHTS draws position,
// velocity and orientation, this class checks the true shape against the rods already there and fills the
// atoms' arrays.
class ParticleToInsertSpherocylinder : public ParticleToInsert {
 public:
  // The shape outlives it.
  ParticleToInsertSpherocylinder(LAMMPS *lmp, const spherocylinder::FibreShape &shape,
                                 FixPropertyAtom *fix_release);

  Region *container = nullptr;  // the spheres of all ends must lie in it; none if null
  bool placed = false;          // insert() was called since the owner cleared it
  int fibre = 0;                // the id of the fibre to be; of a rod 0

  bool is_fibre() const { return nparticles > 1; }
  const spherocylinder::FibreShape &shape() const { return shape_; }
  // Where its centre of mass was put; x_ins are its segments' centres, across periodic boundaries too.
  const spherocylinder::Vec3 &centre() const { return centre_; }

  // As it would be at x, turned by quat.
  std::vector<spherocylinder::Capsule> capsules_at(const double *x, const double *quat) const;
  bool fits_container(const std::vector<spherocylinder::Capsule> &capsules) const;
  // v and omega are a rigid body's.
  void accept(const double *x, const double *v, const double *omega, const double *quat);

  int insert() override;
  int check_near_set_x_v_omega(double *x, double *v, double *omega, double *quat,
                               RegionNeighborList<interpolate_no> &neighbours) override;
  int set_x_v_omega(double *x, double *v, double *omega, double *quat) override;

 private:
  AtomVecSpherocylinder &rods_;
  const spherocylinder::FibreShape &shape_;
  spherocylinder::Vec3 centre_ = spherocylinder::kZero;
  spherocylinder::Quaternion orientation_ = {1.0, 0.0, 0.0, 0.0};

  spherocylinder::JointedRod segment_at(const spherocylinder::Vec3 &centre,
                                        const spherocylinder::Quaternion &orientation, int k) const;
  void join(int i, int k) const;
};

}  // namespace LAMMPS_NS
