// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/compute_joint_local_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "atom.h"
#include "core/joint_strength.h"
#include "domain.h"
#include "host/rod_error.h"
#include "modify.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

using S = FibreSegments;

// In this order without arguments, and as put_row() works them out.
constexpr const char *kColumns[] = {
    "id1",     "id2",       "fibre",          "place", "x",      "y",      "z",  "fx",
    "fy",      "fz",        "axial",          "shear", "mx",     "my",     "mz", "bending",
    "torsion", "curvature", "rest_curvature", "twist", "energy", "plastic"};
constexpr int kCount = std::size(kColumns);

double *put(double *row, const Vec3 &a)
{
  store(a, row);
  return row + 3;
}

}  // namespace

ComputeJointLocalSpherocylinder::ComputeJointLocalSpherocylinder(LAMMPS *lmp, int &iarg, int narg,
                                                                 char **arg)
    : Compute(lmp, iarg, narg, arg),
      segments_(rods_of(lmp, "Compute joint/spherocylinder/local").attached<FibreSegments>())
{
  local_flag = 1;
  timeflag = 1;
  for (int k = iarg; k < narg; k++) {
    const std::string name = arg[k];
    const auto *found = std::find(std::begin(kColumns), std::end(kColumns), name);
    if (found == std::end(kColumns)) {
      std::string all;
      for (const char *column : kColumns) all += std::string(" ") + column;
      rod_error_all(lmp, "Compute %s (id %s): unknown value %s (expected any of%s)", style, id,
                    arg[k], all.c_str());
    }
    columns_.push_back(static_cast<int>(found - kColumns));
  }
  if (columns_.empty())
    for (int k = 0; k < kCount; k++) columns_.push_back(k);
  size_local_cols = columns_.size() == 1 ? 0 : static_cast<int>(columns_.size());
}

void ComputeJointLocalSpherocylinder::init()
{
  joints_ = dynamic_cast<const FixJointSpherocylinder *>(
      modify->find_fix_style_strict("joint/spherocylinder", 0));
  if (!joints_)
    rod_error_all(lmp,
                  "Compute %s (id %s): no fix holds joints (expected fix ID all "
                  "joint/spherocylinder)",
                  style, id);
}

void ComputeJointLocalSpherocylinder::put_row(const FixJointSpherocylinder::State &joint)
{
  const JointLoad &load_1 = joint.load;
  const JointStrain &strain = joint.strain;
  const int i = joint.first, j = joint.second;
  const Vec3 sum =
      axis_of(load_quaternion(atom->quaternion[i])) + axis_of(load_quaternion(atom->quaternion[j]));
  const Vec3 mean = 1.0 / norm(sum) * sum;
  double place[3];
  store(load_1.point, place);
  domain->remap(place);

  double all[kCount];
  double *out = all;
  *out++ = atom->tag[i];
  *out++ = atom->tag[j];
  *out++ = segments_.fibre(i);
  *out++ = segments_.place(i);
  out = put(out, load(place));
  out = put(out, load_1.force);
  const double axial = dot(load_1.force, mean), torsion = dot(load_1.couple, mean);
  *out++ = axial;
  *out++ = norm(load_1.force - axial * mean);
  out = put(out, load_1.couple);
  *out++ = norm(load_1.couple - torsion * mean);
  *out++ = torsion;
  *out++ = std::sqrt(strain.bend_squared()) / joint.distance;
  *out++ = std::hypot(joint.rest.bend_x, joint.rest.bend_y) / joint.distance;
  *out++ = strain.twist / joint.distance;
  const JointChannels energy = joint_energies(strain, joint.stiffness, joint.rest);
  *out++ = energy.stretch + energy.shear + energy.bend + energy.twist;
  *out++ = segments_.rows[i][S::kPlasticWork];
  for (const int column : columns_) numbers_.push_back(all[column]);
}

void ComputeJointLocalSpherocylinder::compute_local()
{
  invoked_local = update->ntimestep;
  numbers_.clear();
  for (int k = 0; k < joints_->joints(); k++) {
    const FixJointSpherocylinder::State joint = joints_->state(k);
    if (joint.first >= atom->nlocal) continue;  // another rank's
    if (!(atom->mask[joint.first] & atom->mask[joint.second] & groupbit)) continue;
    put_row(joint);
  }
  const size_t width = columns_.size();
  size_local_rows = static_cast<int>(numbers_.size() / width);
  rows_.resize(size_local_rows);
  for (int k = 0; k < size_local_rows; k++) rows_[k] = &numbers_[k * width];
  vector_local = numbers_.data();
  array_local = rows_.data();
}

double ComputeJointLocalSpherocylinder::memory_usage()
{
  return static_cast<double>(numbers_.capacity() * sizeof(double) +
                             rows_.capacity() * sizeof(double *));
}
