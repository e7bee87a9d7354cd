// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "atom.h"
#include "contacts/contact_batch.h"
#include "contacts/rod_kinds.h"
#include "core/capsule.h"
#include "lists/touching_rod_pairs.h"
#include "pointers.h"
#include "rods/atom_vec_spherocylinder.h"

namespace LAMMPS_NS {

// Where LIGGGHTS keeps the contacts of pairs, rows of the neighbour list; null where there is none.
struct PairHistories {
  int **flags = nullptr;
  double **values = nullptr;
  int width = 0;  // values of a contact
  int side = -1;  // where they keep the remembered normal, -1 if they do not

  bool remember_sides() const { return side >= 0 && values; }
  int *flags_of(int i, int index) const { return flags ? &flags[i][index] : nullptr; }
  double *values_of(int i, int index) const { return values ? &values[i][width * index] : nullptr; }
};

// From touching pairs of rods to batches of contacts. Keeps what it read of owned and ghost rods, side by
// side.
class PairGatherer : protected Pointers {
 public:
  explicit PairGatherer(LAMMPS *lmp) : Pointers(lmp) {}

  // Poses and motions of all rods.
  void read_all(const RodThreads &threads);
  // Of one at a time, by any threads.
  class Reader {
   public:
    Reader(const AtomVecSpherocylinder &avec, const Atom &atom, PairGatherer &gatherer)
        : avec_(&avec),
          v_(atom.v),
          omega_(atom.omega),
          rods_(gatherer.rods_.data()),
          states_(gatherer.states_.data())
    {
    }
    SPHEROCYLINDER_INLINE const spherocylinder::Capsule &read(int i) const
    {
      rods_[i] = avec_->capsule(i);
      states_[i] = {spherocylinder::load(v_[i]), spherocylinder::load(omega_[i]),
                    rods_[i].segment.axis};
      return rods_[i];
    }

   private:
    const AtomVecSpherocylinder *avec_;
    double **v_, **omega_;
    spherocylinder::Capsule *rods_;
    spherocylinder::RodState *states_;
  };
  Reader reader();
  // Masses, inertias and kinds of all rods, when rods may have come, gone or changed. Rods of
  // `frozen_groups` do not give way.
  void read_masses(int frozen_groups, bool effective_mass);

  // Whether sizes, masses and types of owned rods still are those that were read.
  bool rods_are_as_read(int frozen_groups, bool effective_mass) const;

  const std::vector<spherocylinder::Capsule> &rods() const { return rods_; }

  // As many of the touching pairs of a piece as a batch holds, from the place `first` on. `spread`: nearly
  // parallel rods are spread over.
  void fill(ContactBatch &batch, const TouchingRodPairs &touching,
            const TouchingRodPairs::Piece &piece, int first, const PairHistories &histories,
            bool spread) const;

 private:
  std::vector<spherocylinder::Capsule> rods_;
  std::vector<spherocylinder::RodState> states_;
  // Of the effective mass: zero for a frozen rod, its turning zero with effective_mass off.
  std::vector<spherocylinder::InverseInertia> inverses_;
  RodKinds kinds_;

  spherocylinder::InverseInertia inverse_of(int i, int frozen_groups, int driven_groups,
                                            bool effective_mass) const;
  void set_kind(ContactBatch &batch, int k) const;
  static void push_at_joints(ContactBatch &batch, const TouchingRodPairs &touching, int first);
  void place_otherwise(ContactBatch &batch, int k, const TouchingRodPairs::Touch &touch,
                       const double *side, bool spread) const;
};

}  // namespace LAMMPS_NS
