// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>

#include "contacts/contact_batch.h"
#include "core/contact_kinematics.h"
#include "pointers.h"
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

using EndHistories = std::array<double *, 2>;

// From a rod at a wall to contacts of its ends, or to the one with the outside of a cylinder. A wall is body
// j: at rest but for its surface, and of infinite mass; a spring at it does not turn about the normal.
class WallGatherer : protected Pointers {
 public:
  explicit WallGatherer(LAMMPS *lmp) : Pointers(lmp) {}

  // At the start of a step. `effective_mass`: whether damping knows of the rod's turning. `spread`: whether
  // contacts with the outside of a cylinder are spread over the rod. `types_are_kinds`: all that a law makes
  // of a rod's material follows from its type.
  void begin(const FixWallGran &fix, bool effective_mass, bool spread, bool types_are_kinds);

  // Adds the ends of rod i that touch to the batch, which must have room for two. `histories`: of the
  // two ends, null without. `not_touching(end)` is called for the others.
  template <typename NotTouching>
  void add(ContactBatch &batch, const MovingWall &wall, int i, const EndHistories &histories,
           NotTouching not_touching)
  {
    const spherocylinder::Capsule rod = capsule(i);
    if (wall.surface.is_outside(rod.segment.centre)) {
      if (!add_outside(batch, wall, i, rod, histories[0])) not_touching(0);
      not_touching(1);
      return;
    }
    const RodEnds ends = wall.surface.ends_of(rod);
    const bool any = ends.touch(rod.radius);
    const Inertia inertia = any ? inertia_of(ends, rod.radius, i) : Inertia{};
    for (int end = 0; end < ends.count; end++) {
      if (any && ends.contacts[end].distance <= rod.radius)
        add_end(batch, wall, i, end, rod, ends, inertia, histories[end]);
      else
        not_touching(end);
    }
  }

 private:
  const FixWallGran *fix_ = nullptr;
  int wall_type_ = 0;
  bool types_are_kinds_ = false, spread_ = true;
  double turning_ = 1.0;  // share of the rod's turning that damping knows of

  struct Inertia {
    spherocylinder::InverseInertia inverse;
    double coupling;  // of its two ends, 1/kg
  };
  spherocylinder::Capsule capsule(int i) const;
  Inertia inertia_of(const RodEnds &ends, double radius, int i) const;
  void add_end(ContactBatch &batch, const MovingWall &wall, int i, int end,
               const spherocylinder::Capsule &rod, const RodEnds &ends, const Inertia &inertia,
               double *history) const;
  // The contact of a rod outside of a cylinder. False if it does not touch.
  bool add_outside(ContactBatch &batch, const MovingWall &wall, int i,
                   const spherocylinder::Capsule &rod, double *history) const;
  // What does not depend on which part of the rod touches. Returns the contact's place in the batch.
  int add_contact(ContactBatch &batch, const MovingWall &wall, int i,
                  const spherocylinder::Capsule &rod, const spherocylinder::Vec3 &arm,
                  const EndContact &contact, const spherocylinder::InverseInertia &inverse,
                  double *history) const;
  spherocylinder::InverseInertia inverse_of(int i) const;
};

}  // namespace LAMMPS_NS
