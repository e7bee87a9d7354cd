// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <vector>

#include "contacts/contact_batch.h"
#include "contacts/rod_kinds.h"
#include "core/contact_kinematics.h"
#include "lists/joint_shares.h"
#include "pointers.h"
#include "rods/atom_vec_spherocylinder.h"
#include "walls/moving_wall.h"

namespace LAMMPS_NS {

class FixWallGran;

// How far two ends of a rod that touch a wall at once act as one contact, from 0 to 1: the ratio of
// their overlaps, times the cosine between their normals (0 if they face each other, as across a
// cylinder).
//
// Two ends that push equally along one normal feel each other: the point at end 1 gives way by
// K11 + K12, not by K11 alone, and a rod that lands flat rebounds with e only if its damping knows
// that. With one overlap at zero the other end is alone, so that the damping has no jump.
//
// Returns K12 times that share, in 1/kg: what an end's inverse effective mass gains. With the share
// at most the cosine, their sum is at least 1/m: see the test of mass_coupling.
double coupling_of_ends(const RodEnds &ends, double radius,
                        const spherocylinder::InverseInertia &inverse);

// Of its load at either end, what a rod bears.
using EndShares = std::array<double, 2>;

using EndHistories = std::array<double *, 2>;

// From a rod at a wall to contacts of its ends, or to the one with the outside of a cylinder. A wall is body
// j: at rest but for its surface, and of infinite mass; a spring at it does not turn about the normal.
class WallGatherer : protected Pointers {
 public:
  explicit WallGatherer(LAMMPS *lmp) : Pointers(lmp) {}

  // At the start of a step. `effective_mass`: whether damping knows of the rod's turning. `spread`: whether
  // contacts with the outside of a cylinder are spread over the rod. `types_are_kinds`: all that a law makes
  // of a rod's material follows from its type. `shares`: of fibres, null without.
  void begin(const FixWallGran &fix, bool effective_mass, bool spread, bool types_are_kinds,
             const JointShares *shares);

  // Adds the ends of rod i that touch to the batch, which must have room for two. `histories`: of the
  // two ends, null without. `not_touching(end)` is called for the others.
  template <typename NotTouching>
  SPHEROCYLINDER_INLINE void add(ContactBatch &batch, const MovingWall &wall, int i,
                                 const EndHistories &histories, NotTouching not_touching) const
  {
    const spherocylinder::Capsule rod = avec_->capsule(i);
    if (wall.surface.is_outside(rod.segment.centre)) {
      if (!add_outside(batch, wall, i, rod, histories[0])) not_touching(0);
      not_touching(1);
      return;
    }
    const RodEnds ends = wall.surface.ends_of(rod);
    const bool any = ends.touch(rod.radius);
    const Inertia inertia = any ? inertia_of(ends, rod.radius, i) : Inertia{};
    const EndShares shares = any && shares_ ? shares_of_ends(i) : EndShares{1.0, 1.0};
    for (int end = 0; end < ends.count; end++) {
      if (any && ends.contacts[end].distance <= rod.radius)
        add_end(batch, wall, i, end, rod, ends, inertia, shares, histories[end]);
      else
        not_touching(end);
    }
  }

  // Of fibres: contacts of rods with the outside of a cylinder that begin next to a joint go on from that of the
  // rod on the other side. `history`: rows of all rods, `values` of a contact. Collective.
  void hand_over_outside(const WallSurface &surface, const std::vector<int> &rods, double **history,
                         int values) const;

 private:
  const FixWallGran *fix_ = nullptr;
  int wall_type_ = 0;
  bool types_are_kinds_ = false, spread_ = true;
  double turning_ = 1.0;  // share of the rod's turning that damping knows of
  const JointShares *shares_ = nullptr;

  // Of the rods.
  const AtomVecSpherocylinder *avec_ = nullptr;
  double **v_ = nullptr, **omega_ = nullptr, **inertia_ = nullptr, *mass_ = nullptr;
  const int *type_ = nullptr;

  struct Inertia {
    spherocylinder::InverseInertia inverse;
    double coupling;  // of its two ends, 1/kg
  };
  SPHEROCYLINDER_INLINE spherocylinder::InverseInertia inverse_of(int i) const
  {
    return {1.0 / mass_[i], turning_ / inertia_[i][0]};
  }
  SPHEROCYLINDER_INLINE Inertia inertia_of(const RodEnds &ends, double radius, int i) const
  {
    const spherocylinder::InverseInertia inverse = inverse_of(i);
    return {inverse, turning_ * coupling_of_ends(ends, radius, inverse)};
  }
  SPHEROCYLINDER_INLINE void add_end(ContactBatch &batch, const MovingWall &wall, int i, int end,
                                     const spherocylinder::Capsule &rod, const RodEnds &ends,
                                     const Inertia &inertia, const EndShares &shares,
                                     double *history) const
  {
    const spherocylinder::Vec3 &arm = ends.arms[end];
    const EndContact &contact = ends.contacts[end];
    const int k = add_contact(batch, wall, i, rod, arm, contact, inertia.inverse, history);
    batch.end[k] = end;
    if (shares_) batch.weight[k] = shares[end];
    if (inertia.coupling == 0.0 && shares[end] == 1.0) return;
    // A push w f at each end makes this one give way by w K11 + w' K12.
    const double alone = inverse_effective_mass(inertia.inverse, arm, contact.normal);
    batch.arms.mass_share[k] = alone / (shares[end] * alone + shares[1 - end] * inertia.coupling);
  }
  EndShares shares_of_ends(int i) const;
  JointShares::Share share_outside(const WallSurface &surface, int i,
                                   const spherocylinder::Capsule &rod,
                                   const spherocylinder::ClosestPoints &closest) const;
  // The contact of a rod outside of a cylinder. False if it does not touch.
  bool add_outside(ContactBatch &batch, const MovingWall &wall, int i,
                   const spherocylinder::Capsule &rod, double *history) const;
  // What does not depend on which part of the rod touches. Returns the contact's place in the batch.
  SPHEROCYLINDER_INLINE int add_contact(ContactBatch &batch, const MovingWall &wall, int i,
                                        const spherocylinder::Capsule &rod,
                                        const spherocylinder::Vec3 &arm, const EndContact &contact,
                                        const spherocylinder::InverseInertia &inverse,
                                        double *history) const
  {
    spherocylinder::ContactArms &arms = batch.arms;
    const int k = batch.count++;
    batch.i[k] = i;
    batch.j[k] = -1;
    batch.type_i[k] = type_[i];
    batch.type_j[k] = wall_type_;
    batch.kind[k] = types_are_kinds_ ? type_[i] : RodKinds::kNone;
    batch.end[k] = 0;
    batch.flags[k] = nullptr;
    batch.history[k] = history;
    arms.arm_i.set(k, arm);
    arms.velocity_i.set(k, spherocylinder::load(v_[i]));
    arms.velocity_j.set(k, wall.velocity_at(contact, rod.segment.centre + arm));
    arms.omega_i.set(k, spherocylinder::load(omega_[i]));
    arms.inverse_mass_i[k] = inverse.mass;
    arms.inverse_inertia_i[k] = inverse.transverse;
    arms.radius_i[k] = rod.radius;
    arms.normal.set(k, contact.normal);
    arms.distance[k] = contact.distance;
    arms.overlap[k] = rod.radius - contact.distance;
    arms.mass_share[k] = 1.0;
    arms.side.set(k, spherocylinder::kZero);
    return k;
  }
};

}  // namespace LAMMPS_NS
