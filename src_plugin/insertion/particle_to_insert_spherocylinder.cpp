// SPDX-License-Identifier: GPL-2.0-or-later
#include "insertion/particle_to_insert_spherocylinder.h"

#include "atom.h"
#include "core/mass_properties.h"
#include "host/rod_error.h"
#include "insertion/rod_insertion_list.h"
#include "region.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

ParticleToInsertSpherocylinder::ParticleToInsertSpherocylinder(LAMMPS *lmp,
                                                               FixPropertyAtom *fix_release)
    : ParticleToInsert(lmp, 1, fix_release),
      rods_(rods_of(lmp, "Fix particletemplate/spherocylinder"))
{
}

int ParticleToInsertSpherocylinder::insert()
{
  const int inserted = ParticleToInsert::insert();
  const int i = atom->nlocal - 1;
  rods_.set_rod(i, diameter, total_length, density_ins);
  sc::store(orientation_, atom->quaternion[i]);
  sc::store(sc::angular_momentum(sc::load(omega_ins), sc::axis_of(orientation_),
                                 atom->inertia[i][2], atom->inertia[i][0]),
            atom->angmom[i]);
  placed = true;
  return inserted;
}

int ParticleToInsertSpherocylinder::check_near_set_x_v_omega(
    double *x, double *v, double *omega, double *quat,
    RegionNeighborList<interpolate_no> &neighbours)
{
  RodInsertionList &list = rods_.attached<RodInsertionList>();
  list.begin(&neighbours, r_bound_ins);
  const sc::Capsule capsule = capsule_at(x, quat);
  if (!fits_container(capsule) || list.overlaps(capsule)) return 0;
  list.add(capsule);
  accept(x, v, omega, quat);
  return nparticles;
}

int ParticleToInsertSpherocylinder::set_x_v_omega(double *x, double *v, double *omega, double *quat)
{
  if (!fits_container(capsule_at(x, quat)))
    rod_error_one(lmp,
                  "Fix particletemplate/spherocylinder: all_in_region needs overlapcheck yes in "
                  "the insert command (got no): without it a rod cannot be placed again");
  accept(x, v, omega, quat);
  return nparticles;
}

void ParticleToInsertSpherocylinder::scale_pti(double r_scale)
{
  ParticleToInsert::scale_pti(r_scale);
  diameter *= r_scale;
  total_length *= r_scale;
}

sc::Capsule ParticleToInsertSpherocylinder::capsule_at(const double *x, const double *quat) const
{
  return {{sc::load(x), sc::axis_of(sc::load_quaternion(quat)), 0.5 * (total_length - diameter)},
          0.5 * diameter};
}

bool ParticleToInsertSpherocylinder::fits_container(const sc::Capsule &capsule) const
{
  if (!container) return true;
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
  sc::store(sc::load(x), x_ins[0]);
  sc::store(sc::load(v), v_ins);
  sc::store(sc::load(omega), omega_ins);
  orientation_ = sc::load_quaternion(quat);
}
