// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/capsule.h"
#include "core/rotation.h"
#include "particleToInsert.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;
class Region;

// One rod on its way into the simulation: LIGGGHTS draws position, velocity and orientation, this
// class checks the true shape against the rods already there and fills the atom's arrays.
class ParticleToInsertSpherocylinder : public ParticleToInsert {
 public:
  ParticleToInsertSpherocylinder(LAMMPS *lmp, FixPropertyAtom *fix_release);

  double diameter = 0.0;        // m
  double total_length = 0.0;    // m
  Region *container = nullptr;  // both end spheres must lie in it; none if null
  bool placed = false;          // insert() was called since the owner cleared it

  int insert() override;
  int check_near_set_x_v_omega(double *x, double *v, double *omega, double *quat,
                               RegionNeighborList<interpolate_no> &neighbours) override;
  int set_x_v_omega(double *x, double *v, double *omega, double *quat) override;
  void scale_pti(double r_scale) override;

 private:
  AtomVecSpherocylinder &rods_;
  spherocylinder::Quaternion orientation_ = {1.0, 0.0, 0.0, 0.0};

  spherocylinder::Capsule capsule_at(const double *x, const double *quat) const;
  bool fits_container(const spherocylinder::Capsule &capsule) const;
  void accept(const double *x, const double *v, const double *omega, const double *quat);
};

}  // namespace LAMMPS_NS
