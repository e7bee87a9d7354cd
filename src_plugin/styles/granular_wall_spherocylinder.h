// SPDX-License-Identifier: GPL-2.0-or-later
// What the stock fix wall/gran runs for rods: LIGGGHTS's contact models at the two ends of a rod,
// against a plane or the inside of a cylinder. Between its ends a straight rod cannot be nearer to
// either, so the two end spheres are the whole contact; each has its own history.
#pragma once

#include <cmath>
#include <memory>

#include "atom.h"
#include "core/contact_kinematics.h"
#include "core/rotation.h"
#include "fix_contact_property_atom_wall.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "granular_wall.h"
#include "primitive_wall.h"
#include "rod_contact.h"
#include "settings.h"

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

  // Where an end sphere is relative to the wall.
  struct EndContact {
    double distance;               // of its centre from the wall's surface, negative once through
    spherocylinder::Vec3 normal;   // from the wall to the rod's side of it
  };

  // The rod's centre relative to the wall: tells which side of the wall the rod is on.
  struct Side {
    spherocylinder::Vec3 to_wall;  // from the rod's centre to the nearest point of the wall
    spherocylinder::Vec3 radial;   // cylinders: from the cylinder's axis to the rod's centre
    bool is_cylinder;
  };

  Side side_of(PrimitiveWall &wall, int i) const;
  bool touches(PrimitiveWall &wall, const Side &side, spherocylinder::Vec3 end, double radius,
               EndContact &contact) const;
  spherocylinder::Vec3 wall_velocity(const Side &side, PrimitiveWall &wall,
                                     const spherocylinder::Vec3 &end, const double *vwall) const;
  void report(FixWallGran &wall, const SurfacesIntersectData &sidata, const ForceData &total,
              double normal_force) const;
};

template <typename ContactModel>
typename GranularSpherocylinder<ContactModel>::Side
GranularSpherocylinder<ContactModel>::side_of(PrimitiveWall &wall, int i) const
{
  using namespace spherocylinder;
  double to_wall[3] = {}, radial[3] = {};
  wall.resolveContact(atom->x[i], 0.0, to_wall);
  const bool is_cylinder = wall.axis() >= 0;
  if (is_cylinder) wall.calcRadialDistance(atom->x[i], radial);
  const Side side = {load(to_wall), load(radial), is_cylinder};
  if (is_cylinder && dot(side.to_wall, side.radial) < 0.0)
    rod_error_one(lmp,
                  "Fix wall/gran (id %s): rod %d touches the cylinder from outside at step "
                  BIGINT_FORMAT "; rods know planes and the inside of cylinders only",
                  parent_->id, atom->tag[i], update->ntimestep);
  return side;
}

// An end that is through the wall while the rod's centre is not is still pushed to the rod's side.
template <typename ContactModel>
bool GranularSpherocylinder<ContactModel>::touches(PrimitiveWall &wall, const Side &side,
                                                   spherocylinder::Vec3 end, double radius,
                                                   EndContact &contact) const
{
  using namespace spherocylinder;
  double point[3], delta[3] = {};
  store(end, point);
  wall.resolveContact(point, 0.0, delta);
  const Vec3 to_wall = load(delta);
  const double distance = norm(to_wall);

  if (!side.is_cylinder) {
    const bool through = dot(to_wall, side.to_wall) < 0.0;
    contact.distance = through ? -distance : distance;
    // At a distance of zero the rod's side is all that is known.
    const Vec3 away = distance == 0.0 ? -side.to_wall : through ? to_wall : -to_wall;
    const double length = norm(away);
    if (length == 0.0) return false;  // the rod lies in the plane: neither side is its own
    contact.normal = (1.0 / length) * away;
  } else {
    double radial[3];
    const double from_axis = wall.calcRadialDistance(point, radial);
    if (from_axis == 0.0) return false;  // on the cylinder's axis
    const bool through = dot(to_wall, load(radial)) < 0.0;
    contact.distance = through ? -distance : distance;
    contact.normal = (-1.0 / from_axis) * load(radial);
  }
  return contact.distance <= radius;
}

// vwall is the velocity LIGGGHTS worked out at the rod's centre. A wall that turns about its
// cylinder's axis moves in proportion to the distance from that axis.
template <typename ContactModel>
spherocylinder::Vec3 GranularSpherocylinder<ContactModel>::wall_velocity(
    const Side &side, PrimitiveWall &wall, const spherocylinder::Vec3 &end,
    const double *vwall) const
{
  using namespace spherocylinder;
  struct Access : FixWallGran {  // names FixWallGran's protected shear settings
    static int axis(FixWallGran &fix) { return fix.*(&Access::shearAxis_); }
    static const double *rate(FixWallGran &fix) { return fix.*(&Access::shearAxisVec_); }
  };
  if (!side.is_cylinder || !parent_->is_moving() || Access::axis(*parent_) < 0) return load(vwall);
  double point[3], radial[3];
  store(end, point);
  wall.calcRadialDistance(point, radial);
  return cross(load(Access::rate(*parent_)), load(radial));
}

template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::compute_force(FixWallGran *wall,
                                                         SurfacesIntersectData &sidata, bool,
                                                         double *vwall, FixMeshSurface *, int,
                                                         TriMesh *, int)
{
  using namespace spherocylinder;
  const int i = sidata.i;
  PrimitiveWall &primitive = *wall->primitiveWall();
  const Side side = side_of(primitive, i);
  const Vec3 centre = load(atom->x[i]), axis = axis_of(load_quaternion(atom->quaternion[i]));
  const double radius = atom->shape[i][0], half_length = atom->shape[i][2] - radius;

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

  ForceData total;
  double normal_force = 0.0;
  const int ends = half_length > 0.0 ? 2 : 1;
  for (int k = 0; k < ends; k++) {
    const Vec3 arm = (k == 0 ? -half_length : half_length) * axis;
    const Vec3 end = centre + arm;
    ForceData i_forces, j_forces;
    EndContact contact;
    if (!touches(primitive, side, end, radius, contact)) {
      if (sidata.contact_history) models_[k].surfacesClose(sidata, i_forces, j_forces);
      continue;
    }
    sidata.r = contact.distance;
    sidata.rsq = contact.distance * contact.distance;
    sidata.rinv = contact.distance != 0.0 ? 1.0 / contact.distance : 0.0;
    sidata.deltan = radius - contact.distance;
    store(contact.normal, sidata.en);
    store(contact.distance * contact.normal, sidata.delta);
    sidata.meff = 1.0 / inverse_effective_mass(atom->rmass[i], atom->inertia[i][0], arm,
                                               contact.normal);
    store(velocity_at(load(atom->v[i]), load(atom->omega[i]), arm), end_velocity);
    store(wall_velocity(side, primitive, end, vwall), end_wall_velocity);

    models_[k].surfacesIntersect(sidata, i_forces, j_forces);
    models_[k].endSurfacesIntersect(sidata, nullptr, i_forces, j_forces);
    sidata.has_force_update = true;
    monitor_.look(sidata, 2.0 * radius);

    add_to(i_forces.delta_torque, cross(arm, load(i_forces.delta_F)));
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
