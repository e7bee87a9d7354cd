// SPDX-License-Identifier: GPL-2.0-or-later
// What the stock fix wall/gran runs for rods: LIGGGHTS's contact models at the two ends of a rod,
// against a plane or the inside of a cylinder. Between its ends a straight rod cannot be nearer to
// either, so the two end spheres are the whole contact; each has its own history.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "atom.h"
#include "compute_gran_local_spherocylinder.h"
#include "core/contact_kinematics.h"
#include "core/rotation.h"
#include "fix_contact_property_atom_wall.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "granular_wall.h"
#include "rod_contact.h"
#include "settings.h"
#include "wall_surface.h"

namespace LIGGGHTS {
namespace Walls {

using namespace LAMMPS_NS;
using ContactModels::ForceData;
using ContactModels::SurfacesIntersectData;

template <typename ContactModel>
class GranularSpherocylinder : private Pointers, public IGranularWall {
 public:
  GranularSpherocylinder(LAMMPS *lmp, FixWallGran *parent, const int64_t hash)
      : Pointers(lmp),
        parent_(parent),
        models_{{lmp, parent, true, hash}, {lmp, parent, true, hash}},
        monitor_(lmp)
  {
  }

  void settings(int nargs, char **args, IContactHistorySetup *hsetup) override
  {
    if (parent_->is_mesh_wall())
      rod_error_all(lmp,
                    "Fix wall/gran (id %s): surface spherocylinder cannot use a mesh; rods know "
                    "planes and the inside of cylinders (primitive)",
                    parent_->id);
    for (ContactModel &model : models_) {
      Settings settings(lmp);
      model.registerSettings(settings);
      bool spread_contact = true;  // so that a wall can be given the pair style's keywords
      settings.registerOnOff("spread_contact", spread_contact, true);
      const bool understood = settings.parseArguments(nargs, args);
      model.postSettings(hsetup);
      if (!understood) error->fix_error(FLERR, parent_, settings.error_message.c_str());
    }
  }

  void init_granular() override
  {
    AtomVecSpherocylinder &rods = rods_of(lmp, "Fix wall/gran with surface spherocylinder");
    for (ContactModel &model : models_) model.connectToProperties(force->registry);
    monitor_.reset(rods);
    surface_known_ = false;
    has_tangential_ = has_tangential_model(models_[0]);
  }

  bool checkSurfaceIntersect(SurfacesIntersectData &) override { return true; }
  int get_history_offset(std::string name) override { return models_[0].get_history_offset(name); }
  bool contact_match(const std::string type, const std::string model) override
  {
    return models_[0].contact_match(type, model);
  }

  void compute_force(FixWallGran *wall, SurfacesIntersectData &sidata, bool intersectflag,
                     double *vwall, FixMeshSurface *fix_mesh, int iMesh, TriMesh *mesh,
                     int iTri) override;

 private:
  FixWallGran *parent_;
  ContactModel models_[2];  // one an end
  ContactMonitor monitor_;
  bool has_tangential_ = false;

  WallSurface surface_{};
  bool surface_known_ = false;

  // An end sphere against the wall.
  struct EndContact {
    double distance;              // of the end from the surface, negative once it is through (m)
    spherocylinder::Vec3 normal;  // unit, from the wall to the rod's side of it
    spherocylinder::Vec3 radial;  // cylinders: from the cylinder's axis to the end (m)
  };

  bool find_ends(int i, const spherocylinder::Vec3 &centre, const spherocylinder::Vec3 *arms,
                 int ends, EndContact *contacts) const;
  static double shared_load(const EndContact &one, const EndContact &other, double radius);
  spherocylinder::Vec3 wall_velocity(const EndContact &contact, const double *vwall) const;
  void report(FixWallGran &wall, const SurfacesIntersectData &sidata, const ForceData &total,
              double normal_force) const;
};

// False if no side of the wall can be told to be the rod's: its centre lies in the plane. An end that
// is through the wall while the rod's centre is not is pushed to the rod's side.
template <typename ContactModel>
bool GranularSpherocylinder<ContactModel>::find_ends(int i, const spherocylinder::Vec3 &centre,
                                                     const spherocylinder::Vec3 *arms, int ends,
                                                     EndContact *contacts) const
{
  using namespace spherocylinder;
  if (!surface_.is_cylinder) {
    const double height = surface_.height(centre);
    if (height == 0.0) return false;
    const Vec3 normal = (height > 0.0 ? 1.0 : -1.0) * surface_.unit();
    for (int k = 0; k < ends; k++)
      contacts[k] = {std::fabs(height) + dot(arms[k], normal), normal, Vec3{0.0, 0.0, 0.0}};
    return true;
  }

  if (norm_squared(surface_.radial(centre)) > surface_.radius * surface_.radius)
    rod_error_one(lmp,
                  "Fix wall/gran (id %s): rod %d is outside the cylinder at step " BIGINT_FORMAT
                  "; rods know planes and the inside of cylinders only",
                  parent_->id, atom->tag[i], update->ntimestep);
  for (int k = 0; k < ends; k++) {
    const Vec3 radial = surface_.radial(centre + arms[k]);
    const double from_axis = norm(radial);
    const double inwards = from_axis > 0.0 ? -1.0 / from_axis : 0.0;  // on the axis: touches nothing
    contacts[k] = {surface_.radius - from_axis, inwards * radial, radial};
  }
  return true;
}

// How far two ends that touch at once act as one contact, from 0 to 1: the ratio of their overlaps,
// times the cosine between their normals (0 if they face each other, as across a cylinder).
//
// Two ends that push equally along one normal feel each other: the point at end 1 gives way by
// K11 + K12, not by K11 alone, and a rod that lands flat rebounds with e only if its damping knows
// that. With one overlap at zero the other end is alone, so that the damping has no jump.
template <typename ContactModel>
double GranularSpherocylinder<ContactModel>::shared_load(const EndContact &one,
                                                         const EndContact &other, double radius)
{
  const double a = radius - one.distance, b = radius - other.distance;
  if (!(a > 0.0) || !(b > 0.0)) return 0.0;
  return std::min(a, b) / std::max(a, b) * std::max(0.0, dot(one.normal, other.normal));
}

// vwall is the velocity LIGGGHTS worked out at the rod's centre. A wall that turns about its
// cylinder's axis moves in proportion to the distance from that axis.
template <typename ContactModel>
spherocylinder::Vec3 GranularSpherocylinder<ContactModel>::wall_velocity(
    const EndContact &contact, const double *vwall) const
{
  using namespace spherocylinder;
  struct Access : FixWallGran {  // names FixWallGran's protected shear settings
    static int axis(FixWallGran &fix) { return fix.*(&Access::shearAxis_); }
    static const double *rate(FixWallGran &fix) { return fix.*(&Access::shearAxisVec_); }
  };
  if (!surface_.is_cylinder || !parent_->is_moving() || Access::axis(*parent_) < 0)
    return load(vwall);
  return cross(load(Access::rate(*parent_)), contact.radial);
}

template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::compute_force(FixWallGran *wall,
                                                         SurfacesIntersectData &sidata, bool,
                                                         double *vwall, FixMeshSurface *, int,
                                                         TriMesh *, int)
{
  using namespace spherocylinder;
  const int i = sidata.i;
  const Vec3 centre = load(atom->x[i]), axis = axis_of(load_quaternion(atom->quaternion[i]));
  const double radius = atom->shape[i][0], half_length = atom->shape[i][2] - radius;
  if (!surface_known_) {
    surface_ = surface_of(*wall->primitiveWall());
    surface_known_ = true;
  }

  // LIGGGHTS asks for every rod whose bounding sphere reaches the wall: few of them touch it.
  const int ends = half_length > 0.0 ? 2 : 1;
  const Vec3 arms[2] = {-half_length * axis, half_length * axis};
  EndContact contacts[2] = {};
  if (!find_ends(i, centre, arms, ends, contacts)) return;
  const bool touching = contacts[0].distance <= radius || (ends == 2 && contacts[1].distance <= radius);
  if (!touching) {
    ForceData none;
    if (sidata.contact_history)
      for (int k = 0; k < ends; k++) models_[k].surfacesClose(sidata, none, none);
    return;
  }

  double end_velocity[3], end_wall_velocity[3];
  sidata.v_i = end_velocity;
  sidata.v_j = end_wall_velocity;
  sidata.omega_i = atom->omega[i];
  sidata.omega_j = nullptr;
  sidata.radi = sidata.radsum = radius;
  sidata.area_ratio = 1.0;
  sidata.j = -wall->atom_type_wall();  // negative for primitive walls, as in LIGGGHTS
  sidata.contact_flags = nullptr;
  sidata.itype = atom->type[i];
  sidata.jtype = wall->atom_type_wall();
  sidata.mi = atom->rmass[i];
  sidata.computeflag = wall->computeflag();
  sidata.shearupdate = wall->shearupdate();

  auto *local = ComputeGranLocalSpherocylinder::collecting(wall->compute_wall_gran_local(),
                                                           update->ntimestep);
  ForceData total;
  double normal_force = 0.0;
  const InverseInertia inverse = {1.0 / atom->rmass[i], 1.0 / atom->inertia[i][0]};
  const double shared = ends == 2 ? shared_load(contacts[0], contacts[1], radius) : 0.0;
  const double coupling =
      shared > 0.0
          ? shared * mass_coupling(inverse, arms[0], contacts[0].normal, arms[1], contacts[1].normal)
          : 0.0;
  for (int k = 0; k < ends; k++) {
    const Vec3 &arm = arms[k];
    const EndContact &contact = contacts[k];
    ForceData i_forces, j_forces;
    if (contact.distance > radius) {
      if (sidata.contact_history) models_[k].surfacesClose(sidata, i_forces, j_forces);
      continue;
    }
    sidata.r = contact.distance;
    sidata.rsq = contact.distance * contact.distance;
    sidata.rinv = contact.distance != 0.0 ? 1.0 / contact.distance : 0.0;
    sidata.deltan = radius - contact.distance;
    sidata.cri = radius - 0.5 * sidata.deltan;
    sidata.crj = 0.0;
    store(contact.normal, sidata.en);
    store(contact.distance * contact.normal, sidata.delta);
    // With shared <= the normals' cosine the sum is at least 1/m: see the test of mass_coupling.
    sidata.meff = 1.0 / (inverse_effective_mass(inverse, arm, contact.normal) + coupling);
    store(velocity_half_a_step_ago(load(atom->v[i]), load(atom->omega[i]), arm, update->dt),
          end_velocity);
    store(wall_velocity(contact, vwall), end_wall_velocity);

    sidata.kn = sidata.kt = 0.0;  // a stock model need not set them
    models_[k].surfacesIntersect(sidata, i_forces, j_forces);
    models_[k].endSurfacesIntersect(sidata, nullptr, i_forces, j_forces);
    sidata.has_force_update = true;
    monitor_.look(i, -1, sidata.kn, sidata.meff, sidata.deltan, 2.0 * radius);
    if (ContactRates *rates = monitor_.rates())
      rates->add(i, 1.0, sidata.kn, has_tangential_ ? sidata.kt : 0.0, inverse,
                 1.0 / atom->inertia[i][2], axis, arm, sidata.cri, contact.normal);

    add_to(i_forces.delta_torque, cross(arm, load(i_forces.delta_F)));
    if (local)
      local->add_wall_contact(*wall, k, sidata, i_forces,
                              centre + arm - sidata.cri * contact.normal);
    add_contact_load(total.delta_F, total.delta_torque, 1.0, i_forces);
    normal_force += dot(load(i_forces.delta_F), contact.normal);
    if (wall->heattransfer_flag()) wall->addHeatFlux(nullptr, i, radius, sidata.deltan, 1.0);
  }

  if (sidata.computeflag) add_contact_load(atom->f[i], atom->torque[i], 1.0, total);
  report(*wall, sidata, total, normal_force);
}

// Hands the rod's whole wall load to whatever stock command has asked for it.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::report(FixWallGran &wall,
                                                  const SurfacesIntersectData &sidata,
                                                  const ForceData &total,
                                                  double normal_force) const
{
  const int i = sidata.i;
  if (sidata.computeflag && wall.store_sum_normal_force())
    *wall.get_sum_normal_force_ptr(i) += normal_force;
  if (wall.store_force_contact() && update->ntimestep % wall.store_force_contact_every() == 0)
    wall.add_contactforce_wall(i, total, 0);
  if (wall.store_force_contact_stress())
    wall.add_contactforce_stress_wall(i, total, sidata.delta, sidata.v_j, 0);
  if (wall.store_force())
    spherocylinder::add_to(wall.fix_wallforce()->array_atom[i],
                           spherocylinder::load(total.delta_F));
}

}  // namespace Walls
}  // namespace LIGGGHTS
