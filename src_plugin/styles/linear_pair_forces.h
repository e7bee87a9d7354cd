// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "core/contact_kinematics.h"
#include "core/linear_contact.h"
#include "linear_model_values.h"
#include "pointers.h"
#include "rod_contact.h"
#include "rod_kinds.h"
#include "rod_pair_geometry.h"
#include "sudden_overlaps.h"
#include "touching_rod_pairs.h"

namespace LAMMPS_NS {

class PairGran;

// What a contact needs of a rod's motion.
struct RodMotion {
  spherocylinder::Vec3 velocity, omega;
  // Of the effective mass: zero for a frozen rod, its turning zero with effective_mass off.
  spherocylinder::InverseInertia inverse;
};

// Where a pair's history keeps the remembered normal and the tangential spring, -1 if it does not.
struct HistoryOffsets {
  int side, spring;
};

// The batched contact loop of model linear.
//
// LIGGGHTS's contact models are called once a contact, each through a common record. For the
// combination most decks with rods use (linear; tangential off, no_history or history; no cohesion,
// no rolling friction) the same forces are worked out in batches instead (core/linear_contact.h).
// The models themselves remain in charge of settings, history and material properties, and of every
// step in which some other command wants to see single contacts.
class LinearPairForces : protected Pointers {
 public:
  explicit LinearPairForces(LAMMPS *lmp) : Pointers(lmp) { forget_kinds(); }

  LinearModelValues &values() { return values_; }

  // Adds the forces and torques of all touching pairs to their rods, and keeps the histories.
  void compute(PairGran &pair, const TouchingRodPairs &pairs,
               const std::vector<spherocylinder::Capsule> &rods,
               const std::vector<RodMotion> &motions, const RodKinds &kinds,
               HistoryOffsets offsets, bool spread, ContactMonitor &monitor,
               SuddenOverlaps &sudden_overlaps);

  // Rods may be of other kinds than before, or materials have changed.
  void forget_kinds() { std::fill_n(kinds_in_batch_, spherocylinder::kBatch, RodKinds::kNone); }

 private:
  LinearModelValues values_;
  spherocylinder::LinearContacts contacts_{};
  int kinds_in_batch_[spherocylinder::kBatch];  // RodKinds::of_pair, of each contact
  struct Spread {
    int k;
    RodPairGeometry place;
  };
  Spread spread_[spherocylinder::kBatch];  // those of the batch that are spread over nearly parallel rods
  int spread_count_ = 0;

  // What goes into contact k of the batch.
  void set_place(int k, const RodPairGeometry &place);
  void add_spread();
  void set_motion(int k, const spherocylinder::Capsule &rod_i, const RodMotion &motion_i,
                  const spherocylinder::Capsule &rod_j, const RodMotion &motion_j);
  void set_kinds(int k, int i, int j, const spherocylinder::Capsule &rod_i,
                 const spherocylinder::InverseInertia &inverse_i,
                 const spherocylinder::Capsule &rod_j,
                 const spherocylinder::InverseInertia &inverse_j);
};

}  // namespace LAMMPS_NS
