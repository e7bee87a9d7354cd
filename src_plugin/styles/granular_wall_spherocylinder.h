// SPDX-License-Identifier: GPL-2.0-or-later
// What the stock fix wall/gran runs for rods: LIGGGHTS's contact models at the two ends of a rod,
// against a plane or the inside of a cylinder. Between its ends a straight rod cannot be nearer to
// either, so the two end spheres are the whole contact; each has its own history.
#pragma once

#include "atom.h"
#include "batched_linear.h"
#include "compute_gran_local_spherocylinder.h"
#include "fix_contact_property_atom_wall.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "linear_slider.h"
#include "linear_wall_forces.h"
#include "rod_contact.h"
#include "rod_wall.h"
#include "settings.h"

namespace LIGGGHTS {
namespace Walls {

using namespace LAMMPS_NS;
using ContactModels::ForceData;
using ContactModels::SurfacesIntersectData;

template <typename ContactModel>
class GranularSpherocylinder : private Pointers, public RodWall {
 public:
  GranularSpherocylinder(LAMMPS *lmp, FixWallGran *parent, const int64_t hash)
      : Pointers(lmp),
        parent_(parent),
        models_{{lmp, parent, true, hash}, {lmp, parent, true, hash}},
        monitor_(lmp),
        slider_(lmp),
        linear_(lmp)
  {
  }

  void settings(int nargs, char **args, IContactHistorySetup *hsetup) override
  {
    if (parent_->is_mesh_wall())
      rod_error_all(lmp,
                    "Fix wall/gran (id %s): surface spherocylinder cannot use a mesh; rods know "
                    "planes and the inside of cylinders (primitive)",
                    parent_->id);
    // A wall may be given the pair style's keywords.
    bool spread_contact = true, sudden_overlap = false;
    SearchKeywords search;
    std::vector<char *> others = args_without_search(lmp, nargs, args, search);
    const int n_others = static_cast<int>(others.size());
    for (ContactModel &model : models_) {
      Settings settings(lmp);
      model.registerSettings(settings);
      slider_.register_settings(model, settings);
      settings.registerOnOff("spread_contact", spread_contact, true);
      settings.registerOnOff("effective_mass", effective_mass_, true);
      settings.registerOnOff("sudden_overlap", sudden_overlap, false);
      const bool understood = settings.parseArguments(n_others, others.data());
      model.postSettings(hsetup);
      if (!understood) error->fix_error(FLERR, parent_, settings.error_message.c_str());
    }
    batched_ = BatchedLinear<ContactModel>::value && linear_.values().understand(n_others, others.data());
  }

  void init_granular() override
  {
    AtomVecSpherocylinder &rods = rods_of(lmp, "Fix wall/gran with surface spherocylinder");
    for (ContactModel &model : models_) model.connectToProperties(force->registry);
    slider_.connect(models_[0], force->registry);
    monitor_.reset(rods);
    has_tangential_ = has_tangential_model(models_[0]);
    if (has_tangential_) check_friction(lmp);
    if (batched_)
      linear_.values().connect(force->registry, BatchedLinear<ContactModel>::kTangential);
  }

  bool checkSurfaceIntersect(SurfacesIntersectData &) override { return true; }
  int get_history_offset(std::string name) override { return models_[0].get_history_offset(name); }
  bool contact_match(const std::string type, const std::string model) override
  {
    return models_[0].contact_match(type, model);
  }

  void compute_forces(FixWallGran &fix, const MovingWall &wall, const std::vector<int> &rods,
                      double **history) override;
  void part(int i, double *history) override;

  // For the loop of LIGGGHTS's own fix, which the rods' fix does not run.
  void compute_force(FixWallGran *, SurfacesIntersectData &, bool, double *, FixMeshSurface *, int,
                     TriMesh *, int) override
  {
    rod_error_one(lmp, "Fix %s (id %s): surface spherocylinder was asked for one sphere's contact",
                  parent_->style, parent_->id);
  }

 private:
  FixWallGran *parent_;
  ContactModel models_[2];  // one an end
  ContactMonitor monitor_;
  bool effective_mass_ = true;  // of damping: that of the contact, else the rod's mass
  bool has_tangential_ = false;

  LinearSlider slider_;
  LinearWallForces linear_;
  bool batched_ = false;  // the forces of a usual step are left to linear_

  bool single_contacts_wanted(FixWallGran &fix) const;
  void part(SurfacesIntersectData &sidata);
  void compute_rod(FixWallGran &fix, const MovingWall &wall, SurfacesIntersectData &sidata);
  void report(FixWallGran &fix, const SurfacesIntersectData &sidata, const ForceData &total,
              double normal_force) const;
};

template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::compute_forces(FixWallGran &fix, const MovingWall &wall,
                                                          const std::vector<int> &rods,
                                                          double **history)
{
  if (batched_ && !single_contacts_wanted(fix)) {
    linear_.compute(fix, wall, rods, history, monitor_);
    return;
  }
  SurfacesIntersectData sidata;
  sidata.is_wall = true;
  for (const int i : rods) {
    sidata.i = i;
    sidata.contact_history = history ? history[i] : nullptr;
    compute_rod(fix, wall, sidata);
  }
}

// Whether something in this step asks for more than forces and torques.
template <typename ContactModel>
bool GranularSpherocylinder<ContactModel>::single_contacts_wanted(FixWallGran &fix) const
{
  return !fix.computeflag() || !fix.shearupdate() || monitor_.rates() ||
         fix.store_sum_normal_force() || fix.store_force_contact() ||
         fix.store_force_contact_stress() || fix.store_force() || fix.heattransfer_flag() ||
         ComputeGranLocalSpherocylinder::collecting(fix.compute_wall_gran_local(),
                                                    update->ntimestep);
}

template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::part(int i, double *history)
{
  SurfacesIntersectData sidata;
  sidata.is_wall = true;
  sidata.i = i;
  sidata.contact_history = history;
  part(sidata);
}

template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::part(SurfacesIntersectData &sidata)
{
  ForceData none;
  for (ContactModel &model : models_) model.surfacesClose(sidata, none, none);
}

// Any models, one contact after the other.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::compute_rod(FixWallGran &fix, const MovingWall &wall,
                                                       SurfacesIntersectData &sidata)
{
  using namespace spherocylinder;
  const int i = sidata.i;
  const Capsule rod = static_cast<const AtomVecSpherocylinder &>(*atom->avec).capsule(i);
  if (wall.surface.is_outside(rod.segment.centre)) {
    check_not_at_outside(lmp, fix, wall.surface, i);
    return;
  }
  const RodEnds ends = wall.surface.ends_of(rod);
  if (!ends.touch(rod.radius)) {
    if (sidata.contact_history && ends.count > 0) part(sidata);
    return;
  }

  double end_velocity[3], end_wall_velocity[3];
  sidata.v_i = end_velocity;
  sidata.v_j = end_wall_velocity;
  sidata.omega_i = atom->omega[i];
  sidata.omega_j = nullptr;
  sidata.radi = sidata.radsum = rod.radius;
  sidata.area_ratio = 1.0;
  sidata.j = -fix.atom_type_wall();  // negative for primitive walls, as in LIGGGHTS
  sidata.contact_flags = nullptr;
  sidata.itype = atom->type[i];
  sidata.jtype = fix.atom_type_wall();
  sidata.mi = atom->rmass[i];
  sidata.computeflag = fix.computeflag();
  sidata.shearupdate = fix.shearupdate();

  auto *local = ComputeGranLocalSpherocylinder::collecting(fix.compute_wall_gran_local(),
                                                           update->ntimestep);
  ForceData total;
  double normal_force = 0.0;
  const InverseInertia inverse = {1.0 / atom->rmass[i], 1.0 / atom->inertia[i][0]};
  const double turning = effective_mass_ ? 1.0 : 0.0;  // that damping knows of
  const InverseInertia damped = {inverse.mass, turning * inverse.transverse};
  const double coupling = turning * coupling_of_ends(ends, rod.radius, inverse);
  for (int k = 0; k < ends.count; k++) {
    const Vec3 &arm = ends.arms[k];
    const EndContact &contact = ends.contacts[k];
    ForceData i_forces, j_forces;
    if (contact.distance > rod.radius) {
      if (sidata.contact_history) models_[k].surfacesClose(sidata, i_forces, j_forces);
      continue;
    }
    sidata.r = contact.distance;
    sidata.rsq = contact.distance * contact.distance;
    sidata.rinv = contact.distance != 0.0 ? 1.0 / contact.distance : 0.0;
    sidata.deltan = rod.radius - contact.distance;
    sidata.cri = rod.radius - 0.5 * sidata.deltan;
    sidata.crj = 0.0;
    store(contact.normal, sidata.en);
    store(contact.distance * contact.normal, sidata.delta);
    sidata.meff = 1.0 / (inverse_effective_mass(damped, arm, contact.normal) + coupling);
    store(velocity_half_a_step_ago(load(atom->v[i]), load(atom->omega[i]), arm, update->dt),
          end_velocity);
    store(wall.velocity_at(contact, rod.segment.centre + arm), end_wall_velocity);

    sidata.kn = sidata.kt = 0.0;  // a stock model need not set them
    // Model linear has no history values before the tangential model's, one set an end.
    double *spring = sidata.contact_history ? sidata.contact_history + k * fix.dnum() / 2 : nullptr;
    if (spring) slider_.note_spring(spring);
    models_[k].surfacesIntersect(sidata, i_forces, j_forces);
    if (spring) slider_.limit(sidata, spring, i_forces, j_forces);
    models_[k].endSurfacesIntersect(sidata, nullptr, i_forces, j_forces);
    sidata.has_force_update = true;
    monitor_.look(i, -1, sidata.kn, sidata.meff, sidata.deltan, 2.0 * rod.radius);
    if (ContactRates *rates = monitor_.rates())
      rates->add(i, 1.0, sidata.kn, has_tangential_ ? sidata.kt : 0.0, inverse,
                 1.0 / atom->inertia[i][2], rod.segment.axis, arm, sidata.cri, contact.normal);

    add_to(i_forces.delta_torque, cross(arm, load(i_forces.delta_F)));
    if (local)
      local->add_wall_contact(fix, k, sidata, i_forces,
                              rod.segment.centre + arm - sidata.cri * contact.normal);
    add_contact_load(total.delta_F, total.delta_torque, 1.0, i_forces);
    normal_force += dot(load(i_forces.delta_F), contact.normal);
    if (fix.heattransfer_flag()) fix.addHeatFlux(nullptr, i, rod.radius, sidata.deltan, 1.0);
  }

  if (sidata.computeflag) add_contact_load(atom->f[i], atom->torque[i], 1.0, total);
  report(fix, sidata, total, normal_force);
}

// Hands the rod's whole wall load to whatever stock command has asked for it.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::report(FixWallGran &fix,
                                                  const SurfacesIntersectData &sidata,
                                                  const ForceData &total,
                                                  double normal_force) const
{
  const int i = sidata.i;
  if (sidata.computeflag && fix.store_sum_normal_force())
    *fix.get_sum_normal_force_ptr(i) += normal_force;
  if (fix.store_force_contact() && update->ntimestep % fix.store_force_contact_every() == 0)
    fix.add_contactforce_wall(i, total, 0);
  if (fix.store_force_contact_stress())
    fix.add_contactforce_stress_wall(i, total, sidata.delta, sidata.v_j, 0);
  if (fix.store_force())
    spherocylinder::add_to(fix.fix_wallforce()->array_atom[i],
                           spherocylinder::load(total.delta_F));
}

}  // namespace Walls
}  // namespace LIGGGHTS
