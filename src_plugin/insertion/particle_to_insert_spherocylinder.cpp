// SPDX-License-Identifier: GPL-2.0-or-later
#include "insertion/particle_to_insert_spherocylinder.h"

#include "atom.h"
#include "core/mass_properties.h"
#include "domain.h"
#include "host/rod_error.h"
#include "insertion/rod_insertion_list.h"
#include "region.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

ParticleToInsertSpherocylinder::ParticleToInsertSpherocylinder(LAMMPS *lmp,
                                                               const sc::FibreShape &shape,
                                                               FixPropertyAtom *fix_release)
    : ParticleToInsert(lmp, static_cast<int>(shape.segments.size()), fix_release),
      rods_(rods_of(lmp, "Fix particletemplate/spherocylinder")),
      shape_(shape)
{
}

sc::JointedRod ParticleToInsertSpherocylinder::segment_at(const sc::Vec3 &centre,
                                                          const sc::Quaternion &orientation,
                                                          int k) const
{
  const sc::JointedRod &segment = shape_.segments[k];
  if (!is_fibre()) return {centre, orientation, segment.half_length};
  return {centre + sc::rotated(segment.centre, orientation), orientation * segment.orientation,
          segment.half_length};
}

std::vector<sc::Capsule> ParticleToInsertSpherocylinder::capsules_at(const double *x,
                                                                     const double *quat) const
{
  std::vector<sc::Capsule> capsules;
  for (int k = 0; k < nparticles; k++) {
    const sc::JointedRod rod = segment_at(sc::load(x), sc::load_quaternion(quat), k);
    capsules.push_back({{rod.centre, rod.axis(), rod.half_length}, shape_.radius});
  }
  return capsules;
}

int ParticleToInsertSpherocylinder::insert()
{
  const int inserted = ParticleToInsert::insert();
  for (int k = 0; k < nparticles; k++) {
    const int i = atom->nlocal - nparticles + k;
    const sc::Quaternion orientation = segment_at(centre_, orientation_, k).orientation;
    rods_.set_rod(i, 2.0 * shape_.radius, shape_.segment_length, density_ins,
                  sc::shared_ends_of(shape_, k));
    sc::store(orientation, atom->quaternion[i]);
    sc::store(sc::angular_momentum(sc::load(omega_ins), sc::axis_of(orientation),
                                   atom->inertia[i][2], atom->inertia[i][0]),
              atom->angmom[i]);
    if (is_fibre()) join(i, k);
  }
  placed = true;
  return inserted;
}

// Segment k of the fibre: its velocity, its image, and what it is joined to.
void ParticleToInsertSpherocylinder::join(int i, int k) const
{
  using S = FibreSegments;
  const sc::Vec3 arm = sc::load(x_ins[k]) - centre_;
  sc::store(sc::load(v_ins) + sc::cross(sc::load(omega_ins), arm), atom->v[i]);
  domain->remap(atom->x[i], atom->image[i]);

  const int last = nparticles - 1;
  int ends = 0;
  if (k > 0) ends |= S::kTailJoined | S::kTailShared;
  if (k < last) ends |= S::kHeadJoined | S::kHeadShared | S::kRestGiven;
  if (shape_.is_short() && k > 1) ends |= S::kTailPasses;
  if (shape_.is_short() && k + 1 < last) ends |= S::kHeadPasses;
  double *row = rods_.attached<FibreSegments>().rows[i];
  row[S::kFibre] = fibre;
  row[S::kPlace] = k + 1;
  row[S::kEnds] = ends;
  row[S::kBendX] = k < last ? shape_.rest.bend_x : 0.0;
  row[S::kBendY] = k < last ? shape_.rest.bend_y : 0.0;
  row[S::kTwist] = k < last ? shape_.rest.twist : 0.0;
}

int ParticleToInsertSpherocylinder::check_near_set_x_v_omega(
    double *x, double *v, double *omega, double *quat,
    RegionNeighborList<interpolate_no> &neighbours)
{
  RodInsertionList &list = rods_.attached<RodInsertionList>();
  list.begin(&neighbours, r_bound_ins);
  const std::vector<sc::Capsule> capsules = capsules_at(x, quat);
  if (!fits_container(capsules) || list.overlaps(capsules[0])) return 0;
  list.add(capsules[0]);
  accept(x, v, omega, quat);
  return nparticles;
}

int ParticleToInsertSpherocylinder::set_x_v_omega(double *x, double *v, double *omega, double *quat)
{
  if (!fits_container(capsules_at(x, quat)))
    rod_error_one(lmp,
                  "Fix particletemplate/spherocylinder: all_in_region needs overlapcheck yes in "
                  "the insert command (got no): without it a rod cannot be placed again");
  accept(x, v, omega, quat);
  return nparticles;
}

bool ParticleToInsertSpherocylinder::fits_container(const std::vector<sc::Capsule> &capsules) const
{
  if (!container) return true;
  for (const sc::Capsule &capsule : capsules)
    for (const double side : {-1.0, 1.0}) {
      double end[3];
      sc::store(capsule.segment.at(side * capsule.segment.half_length), end);
      if (!container->match_shrinkby_cut(end, capsule.radius)) return false;
    }
  return true;
}

void ParticleToInsertSpherocylinder::accept(const double *x, const double *v, const double *omega,
                                            const double *quat)
{
  centre_ = sc::load(x);
  orientation_ = sc::load_quaternion(quat);
  for (int k = 0; k < nparticles; k++)
    sc::store(segment_at(centre_, orientation_, k).centre, x_ins[k]);
  sc::store(sc::load(v), v_ins);
  sc::store(sc::load(omega), omega_ins);
}
