// SPDX-License-Identifier: GPL-2.0-or-later
// What the stock pair_style gran runs for rods: LIGGGHTS's contact models at the closest points of
// two rods' axes. One class per combination of contact models, chosen when the deck is read.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "atom.h"
#include "batched_linear.h"
#include "comm.h"
#include "compute_gran_local_spherocylinder.h"
#include "core/contact_kinematics.h"
#include "core/five_step_search.h"
#include "false_histories.h"
#include "force.h"
#include "granular_pair_style.h"
#include "fix_move_spherocylinder.h"
#include "linear_pair_forces.h"
#include "linear_slider.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "rod_contact.h"
#include "rod_pair_geometry.h"
#include "settings.h"
#include "sudden_overlaps.h"

namespace LIGGGHTS {
namespace PairStyles {

using namespace LAMMPS_NS;
using ContactModels::ForceData;
using ContactModels::SurfacesIntersectData;

template <typename ContactModel>
class GranularSpherocylinder : private Pointers, public IGranularPairStyle {
 public:
  GranularSpherocylinder(LAMMPS *lmp, PairGran *parent, const int64_t hash)
      : Pointers(lmp),
        parent_(parent),
        model_(lmp, parent, false, hash),
        monitor_(lmp),
        slider_(lmp),
        linear_(lmp),
        close_pairs_(lmp),
        false_histories_(lmp),
        sudden_overlaps_(lmp)
  {
  }

  ~GranularSpherocylinder() override
  {
    auto *rods = dynamic_cast<AtomVecSpherocylinder *>(atom->avec);
    if (!rods) return;
    if (rods->pair_counts == &close_pairs_.counts()) rods->pair_counts = nullptr;
    if (rods->touching_pairs == &touching_pairs_) rods->touching_pairs = nullptr;
    if (rods->sudden_overlaps == &sudden_overlaps_) rods->sudden_overlaps = nullptr;
  }

  int64_t hashcode() override { return model_.hashcode(); }

  void settings(int nargs, char **args, IContactHistorySetup *hsetup) override
  {
    Settings settings(lmp);
    model_.registerSettings(settings);
    slider_.register_settings(model_, settings);
    settings.registerOnOff("spread_contact", spread_contact_, true);
    settings.registerOnOff("effective_mass", effective_mass_, true);
    bool sudden_overlap = false;
    settings.registerOnOff("sudden_overlap", sudden_overlap, false);
    SearchKeywords search;
    std::vector<char *> others = args_without_search(lmp, nargs, args, search);
    const int n_others = static_cast<int>(others.size());
    const bool understood = settings.parseArguments(n_others, others.data());
    model_.postSettings(hsetup);
    if (!understood) error->all(FLERR, settings.error_message.c_str());
    batched_ = BatchedLinear<ContactModel>::value && linear_.values().understand(n_others, others.data());
    sudden_overlaps_.allow(sudden_overlap);
    close_skin_ = search.close_skin;
    if (!search.five_step)
      touching_pairs_.search_by(spherocylinder::closest_points);
    else if (spread_contact_)  // which goes by the closest points
      touching_pairs_.search_by(spherocylinder::closest_points_in_five_steps);
    else
      touching_pairs_.search_by(spherocylinder::five_step_points);
    has_settings_ = true;
  }

  void init_granular() override
  {
    if (!has_settings_)
      rod_error_all(lmp, "Pair gran with surface spherocylinder: a restart file does not hold its "
                         "keywords, give pair_style and pair_coeff again after read_restart");
    AtomVecSpherocylinder &rods = rods_of(lmp, "Pair gran with surface spherocylinder");
    if (force->newton_pair)
      rod_error_all(lmp, "Pair gran with surface spherocylinder requires newton off (got newton on)");
    if (parent_->storeContactForces() || parent_->storeContactForcesStress())
      rod_error_all(lmp,
                    "Pair gran with surface spherocylinder stores no contact forces, as fix "
                    "continuum/weighted wants them (expected compute pair/gran/local)");
    model_.connectToProperties(force->registry);
    slider_.connect(model_, force->registry);
    highest_type_ = force->registry.max_type();
    side_offset_ = model_.get_history_offset("rod_normal");
    spring_offset_ = history_offset("shearx");
    monitor_.reset(rods);
    has_tangential_ = has_tangential_model(model_);
    if (has_tangential_) check_friction(lmp);
    if (batched_)
      linear_.values().connect(force->registry, BatchedLinear<ContactModel>::kTangential);
    close_pairs_.reset(*parent_, close_skin_);
    rods.pair_counts = &close_pairs_.counts();
    rods.touching_pairs = &touching_pairs_;
    rods.sudden_overlaps = &sudden_overlaps_;
  }

  void write_restart_settings(FILE *fp) override
  {
    int64_t hash = model_.hashcode();
    fwrite(&hash, sizeof(int64_t), 1, fp);
  }

  void read_restart_settings(FILE *fp, int64_t hash) override
  {
    int64_t stored = -1;
    if (comm->me == 0 && fread(&stored, sizeof(int64_t), 1, fp) != 1)
      error->one(FLERR, "Pair gran: restart file ends within the pair style");
    if (comm->me == 0 && (hash != -1 ? hash : stored) != model_.hashcode())
      error->one(FLERR, "Pair gran: restart file was written with other contact models");
    model_.postSettings(parent_);  // a history as long as the stored one, until init_granular
  }

  bool contact_match(const std::string type, const std::string model) override
  {
    return model_.contact_match(type, model);
  }
  int get_history_offset(const std::string name) override
  {
    return model_.get_history_offset(name);
  }
  double stressStrainExponent() override { return model_.stressStrainExponent(); }

  void compute_force(PairGran *pair, int eflag, int vflag, int addflag) override;

 private:
  PairGran *parent_;
  ContactModel model_;
  ContactMonitor monitor_;
  bool spread_contact_ = true;  // continuous rule for nearly parallel rods
  bool effective_mass_ = true;  // of damping: that of the contact, else of the rods' masses
  bool has_tangential_ = false;
  double close_skin_ = 0.0;    // of the close pairs (m), 0: chosen automatically
  int highest_type_ = 0;       // that material properties are there for
  bool has_settings_ = false;  // false for a pair style made by read_restart
  // Where a pair's history keeps the remembered normal and the tangential spring, -1 if it does not.
  int side_offset_ = -1;
  int spring_offset_ = -1;

  LinearSlider slider_;
  LinearPairForces linear_;
  bool batched_ = false;  // the forces of a usual step are left to linear_

  // Of owned and ghost rods, gathered once a step: the contact loop reads them side by side.
  std::vector<spherocylinder::Capsule> rods_;
  std::vector<RodMotion> motions_;
  RodKinds kinds_;
  CloseRodPairs close_pairs_;
  TouchingRodPairs touching_pairs_;
  FalseHistories false_histories_;
  SuddenOverlaps sudden_overlaps_;
  using Touch = TouchingRodPairs::Touch;

  int history_offset(const std::string &name) const;
  void read_rod(int i);
  void read_rods(bool all);
  void read_masses(int frozen_bit);
  spherocylinder::InverseInertia inverse_inertia(int i) const;
  bool single_contacts_wanted(PairGran &pair) const;
  void compute_each(PairGran &pair, int **first_flags, double **first_history,
                    ComputeGranLocalSpherocylinder *local);
  void turn_spring(const SurfacesIntersectData &sidata) const;
  void separate(SurfacesIntersectData &sidata, ForceData &i_forces, ForceData &j_forces);
  void report(PairGran &pair, SurfacesIntersectData &sidata, ForceData &i_forces) const;
};

// Where the models keep a value of this name; the stock ones do not all tell.
template <typename ContactModel>
int GranularSpherocylinder<ContactModel>::history_offset(const std::string &name) const
{
  struct Access : PairGran {  // names PairGran's protected list of history values
    static const std::vector<HistoryArg> &values(PairGran &pair) { return pair.*(&Access::history_arg); }
  };
  const auto &values = Access::values(*parent_);
  for (size_t k = 0; k < values.size(); k++)
    if (values[k].name == name) return static_cast<int>(k);
  return -1;
}

// The tangential spring turns with the pair about its normal, by the mean of the two spins; LIGGGHTS
// turns it with the normal only. Two spheres keep LIGGGHTS's spring, so that they move as its own do.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::turn_spring(const SurfacesIntersectData &sidata) const
{
  using namespace spherocylinder;
  if (!sidata.contact_history || !sidata.computeflag || !sidata.shearupdate) return;
  const int i = sidata.i, j = sidata.j;
  if (rods_[i].segment.half_length == 0.0 && rods_[j].segment.half_length == 0.0) return;
  double *spring = sidata.contact_history + spring_offset_;
  store(turned_spring(load(spring), load(sidata.en), motions_[i].omega, motions_[j].omega, 1.0,
                      update->dt),
        spring);
}

// A pair that no longer touches forgets its contact.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::separate(SurfacesIntersectData &sidata,
                                                    ForceData &i_forces, ForceData &j_forces)
{
  if (!sidata.contact_flags || *sidata.contact_flags == 0) return;
  sidata.has_force_update = false;
  model_.surfacesClose(sidata, i_forces, j_forces);
  *sidata.contact_flags = 0;
  if (side_offset_ >= 0)
    for (int d = 0; d < 3; d++) sidata.contact_history[side_offset_ + d] = 0.0;
}

template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::read_rod(int i)
{
  using namespace spherocylinder;
  const double *shape = atom->shape[i];
  rods_[i] = {{load(atom->x[i]), axis_of(load_quaternion(atom->quaternion[i])),
               shape[2] - shape[0]},
              shape[0]};
  motions_[i].velocity = load(atom->v[i]);
  motions_[i].omega = load(atom->omega[i]);
}

// All rods, or those that the lists of pairs have to do with.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::read_rods(bool all)
{
  const int owned = atom->nlocal, nall = owned + atom->nghost;
  rods_.resize(nall);
  motions_.resize(nall);
  for (int i = 0; i < (all ? nall : owned); i++) read_rod(i);
  if (!all)
    for (const int i : close_pairs_.tracked_ghosts()) read_rod(i);
}

// Masses and inertias are those of the last time LIGGGHTS built its lists, when rods may have come,
// gone or changed.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::read_masses(int frozen_bit)
{
  const int nall = atom->nlocal + atom->nghost;
  const int driven_bits = groups_driven_by_fix_move(lmp);
  linear_.forget_kinds();
  kinds_.clear();
  for (int i = 0; i < nall; i++) {
    const bool frozen = atom->mask[i] & frozen_bit;
    motions_[i].inverse = {frozen ? 0.0 : 1.0 / atom->rmass[i],
                           frozen || !effective_mass_ ? 0.0 : 1.0 / atom->inertia[i][0],
                           (atom->mask[i] & driven_bits) != 0};
    kinds_.add(atom->type[i], rods_[i], motions_[i].inverse);
  }
}

// What rod i gives way by, whatever its damping goes by.
template <typename ContactModel>
spherocylinder::InverseInertia GranularSpherocylinder<ContactModel>::inverse_inertia(int i) const
{
  const double mass = motions_[i].inverse.mass;
  return {mass, mass == 0.0 ? 0.0 : 1.0 / atom->inertia[i][0]};
}

template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::compute_force(PairGran *pair, int eflag, int vflag,
                                                         int)
{
  if (eflag || vflag)
    pair->ev_setup(eflag, vflag);
  else
    pair->evflag = pair->vflag_fdotr = 0;

  const bool migrated = close_pairs_.have_rods_migrated();
  // With `pre no` a run begins with its first step.
  const bool run_begins = update->setupflag || update->ntimestep == update->firststep + 1;
  if (migrated || run_begins) check_types_have_properties(lmp, highest_type_);
  if (!migrated && run_begins) close_pairs_.check_rods_are_the_same();
  close_pairs_.update(*pair, rods_, migrated, [this](bool all) { read_rods(all); });
  if (migrated) read_masses(pair->freeze_group_bit());
  int **first_flags = pair->listgranhistory ? pair->listgranhistory->firstneigh : nullptr;
  double **first_history = pair->listgranhistory ? pair->listgranhistory->firstdouble : nullptr;
  touching_pairs_.find(close_pairs_.entries(), rods_, atom->tag, first_flags);
  if (side_offset_ >= 0 && (migrated || run_begins))
    false_histories_.drop(touching_pairs_.touching(), rods_, first_flags, first_history,
                          pair->dnum(), side_offset_);
  close_pairs_.counts().touching = static_cast<int64_t>(touching_pairs_.touching().size());

  auto *local = ComputeGranLocalSpherocylinder::collecting(pair->cpl(), update->ntimestep);
  if (local) local->begin_rows();
  if (batched_ && !local && !single_contacts_wanted(*pair))
    linear_.compute(*pair, touching_pairs_, rods_, motions_, kinds_,
                    {side_offset_, spring_offset_}, spread_contact_, monitor_, sudden_overlaps_);
  else
    compute_each(*pair, first_flags, first_history, local);
  sudden_overlaps_.end_step(migrated);
}

// Whether something in this step asks for more than forces and torques.
template <typename ContactModel>
bool GranularSpherocylinder<ContactModel>::single_contacts_wanted(PairGran &pair) const
{
  return pair.evflag || !pair.computeflag() || !pair.shearupdate() || monitor_.rates() ||
         pair.store_sum_normal_force();
}

// Any models, one contact after the other.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::compute_each(PairGran &pair, int **first_flags,
                                                        double **first_history,
                                                        ComputeGranLocalSpherocylinder *local)
{
  using namespace spherocylinder;
  double **f = atom->f, **torque = atom->torque;
  const int *type = atom->type;
  const int nlocal = atom->nlocal, dnum = pair.dnum();
  const double dt = update->dt;
  const bool remember = side_offset_ >= 0 && first_history;

  SurfacesIntersectData sidata;
  ForceData i_forces, j_forces;
  double velocity_i[3], velocity_j[3];
  sidata.is_wall = false;
  sidata.area_ratio = 1.0;
  sidata.computeflag = pair.computeflag();
  sidata.shearupdate = pair.shearupdate();
  sidata.v_i = velocity_i;
  sidata.v_j = velocity_j;
  model_.beginPass(sidata, i_forces, j_forces);
  ContactRates *rates = monitor_.rates();

  for (const CloseRodPairs::Entry &entry : touching_pairs_.parted()) {
    sidata.i = entry.i;
    sidata.j = entry.j;
    sidata.contact_flags = &first_flags[entry.i][entry.index];
    sidata.contact_history =
        first_history ? &first_history[entry.i][dnum * entry.index] : nullptr;
    separate(sidata, i_forces, j_forces);
  }

  for (const Touch &touch : touching_pairs_.touching()) {
    const int i = touch.i, j = touch.j;
    const Capsule &rod_i = rods_[i], &rod_j = rods_[j];
    const double reach = rod_i.radius + rod_j.radius;
    sidata.contact_flags = first_flags ? &first_flags[i][touch.index] : nullptr;
    sidata.contact_history = first_history ? &first_history[i][dnum * touch.index] : nullptr;
    sidata.i = i;
    sidata.j = j;
    sidata.radi = rod_i.radius;
    sidata.radj = rod_j.radius;
    sidata.radsum = reach;
    sidata.itype = type[i];
    sidata.jtype = type[j];
    sidata.mi = atom->rmass[i];
    sidata.mj = atom->rmass[j];
    sidata.omega_i = atom->omega[i];
    sidata.omega_j = atom->omega[j];

    double *side = remember ? sidata.contact_history + side_offset_ : nullptr;
    const RodPairGeometry contact =
        geometry_of(touch, rods_, atom->tag, side, spread_contact_);
    sidata.deltan = contact.overlap;
    sidata.r = reach - contact.overlap;
    sidata.rsq = sidata.r * sidata.r;
    sidata.rinv = sidata.r != 0.0 ? 1.0 / sidata.r : 0.0;
    const double half_overlap = 0.5 * (reach - contact.distance);  // the contact is midway
    sidata.cri = rod_i.radius - half_overlap;
    sidata.crj = rod_j.radius - half_overlap;
    store(contact.normal, sidata.en);
    store(contact.distance * contact.normal, sidata.delta);
    if (side && sidata.computeflag && sidata.shearupdate)
      store(remembered_side(contact.normal, contact.overlap / reach), side);

    const RodMotion &motion_i = motions_[i], &motion_j = motions_[j];
    const Vec3 arm_i = contact.s * rod_i.segment.axis, arm_j = contact.t * rod_j.segment.axis;
    const Vec3 normal = contact.normal;
    store(velocity_half_a_step_ago(motion_i.velocity, motion_i.omega, arm_i, dt), velocity_i);
    store(velocity_half_a_step_ago(motion_j.velocity, motion_j.omega, arm_j, dt), velocity_j);
    const double inverse_mass =
        inverse_effective_mass(shown_to(motion_j.inverse, motion_i.inverse), arm_i, normal) +
        inverse_effective_mass(shown_to(motion_i.inverse, motion_j.inverse), arm_j, normal);
    sudden_overlaps_.look(i, j, contact.overlap / reach, inverse_mass != 0.0);
    if (inverse_mass == 0.0) continue;  // both frozen: nothing to move
    sidata.meff = contact.share / inverse_mass;

    double *spring = nullptr;
    if (spring_offset_ >= 0 && sidata.contact_history) {
      spring = sidata.contact_history + spring_offset_;
      turn_spring(sidata);
      slider_.note_spring(spring);
    }
    i_forces.reset();
    j_forces.reset();
    sidata.kn = sidata.kt = 0.0;  // a stock model need not set them
    model_.surfacesIntersect(sidata, i_forces, j_forces);
    if (spring) slider_.limit(sidata, spring, i_forces, j_forces);
    model_.endSurfacesIntersect(sidata, nullptr, i_forces, j_forces);
    sidata.has_force_update = true;
    monitor_.look(i, j, sidata.kn, sidata.meff, sidata.deltan, reach);
    if (rates) {
      const double kt = has_tangential_ ? sidata.kt : 0.0;
      rates->add(i, 2.0, sidata.kn, kt, inverse_inertia(i), 1.0 / atom->inertia[i][2],
                 rod_i.segment.axis, arm_i, sidata.cri, normal);
      rates->add(j, 2.0, sidata.kn, kt, inverse_inertia(j), 1.0 / atom->inertia[j][2],
                 rod_j.segment.axis, arm_j, sidata.crj, -normal);
    }

    const Vec3 sideways = sidata.kn * contact.sideways;
    add_to(i_forces.delta_F, sideways);
    add_to(j_forces.delta_F, -sideways);
    add_to(i_forces.delta_torque,
           cross(arm_i, load(i_forces.delta_F)) + sidata.kn * contact.couple_i);
    add_to(j_forces.delta_torque,
           cross(arm_j, load(j_forces.delta_F)) + sidata.kn * contact.couple_j);
    if (sidata.computeflag) {
      add_contact_load(f[i], torque[i], pair.relax(i), i_forces);
      if (j < nlocal) add_contact_load(f[j], torque[j], pair.relax(j), j_forces);
    }
    report(pair, sidata, i_forces);
    if (local)
      local->add_pair_contact(sidata, i_forces,
                              rod_i.segment.centre + arm_i - sidata.cri * normal);
  }

  model_.endPass(sidata, i_forces, j_forces);
}

// Hands the contact to whatever stock command has asked for it.
template <typename ContactModel>
void GranularSpherocylinder<ContactModel>::report(PairGran &pair, SurfacesIntersectData &sidata,
                                                  ForceData &i_forces) const
{
  const int i = sidata.i, j = sidata.j, nlocal = atom->nlocal;

  if (sidata.computeflag && pair.store_sum_normal_force()) {
    const double along = i_forces.delta_F[0] * sidata.en[0] + i_forces.delta_F[1] * sidata.en[1] +
                         i_forces.delta_F[2] * sidata.en[2];
    *pair.get_sum_normal_force_ptr(i) += along;
    if (j < nlocal) *pair.get_sum_normal_force_ptr(j) += along;
  }
  if (pair.evflag) {
    // The virial of a rigid body takes the distance of the centres, not of the contact points.
    double between[3];
    for (int d = 0; d < 3; d++) between[d] = atom->x[i][d] - atom->x[j][d];
    pair.ev_tally_xyz(i, j, nlocal, force->newton_pair, 0.0, 0.0, i_forces.delta_F[0],
                      i_forces.delta_F[1], i_forces.delta_F[2], between[0], between[1],
                      between[2]);
  }
}

}  // namespace PairStyles
}  // namespace LIGGGHTS
