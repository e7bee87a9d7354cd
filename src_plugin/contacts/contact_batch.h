// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>

#include "core/contact_arms.h"

namespace LAMMPS_NS {

// Contacts on their way from rods to forces: gathered from touching pairs or from a wall, worked out by
// a law, scattered to the rods and shown to observers. Only the first `count` are of meaning.
struct ContactBatch {
  int count = 0;
  bool is_wall = false;  // j is a wall
  bool is_mesh = false;  // made of triangles

  spherocylinder::ContactArms arms{};
  spherocylinder::ContactLoads loads{};

  // Places in memory; of a wall j is -1.
  int i[spherocylinder::kBatch]{}, j[spherocylinder::kBatch]{};
  int type_i[spherocylinder::kBatch]{}, type_j[spherocylinder::kBatch]{};
  // One number for all that does not move of both, > 0, or RodKinds::kNone. What a law has once worked
  // out for a place in the batch holds while its number stays.
  int64_t kind[spherocylinder::kBatch]{};
  int end[spherocylinder::kBatch]{};     // at a wall: 0 at -u, 1 at +u; at a mesh: the triangle
  int *flags[spherocylinder::kBatch]{};  // of LIGGGHTS's contact, null without
  double *history[spherocylinder::kBatch]{};  // the models' values, null without

  // The share of its load that a contact has, where it may have less: at a mesh (spherocylinder::SurfaceContact),
  // at a joint of a fibre (core/joint_share.h).
  spherocylinder::Doubles weight{};

  // What contacts spread over nearly parallel rods push beside the law's force, over the stiffness
  // (spherocylinder::RodContact); and those at a joint, over their share (JointShares::Share).
  struct Spread {
    int k;
    spherocylinder::Vec3 sideways, couple_i, couple_j;  // m, m^2
  };
  Spread spread[2 * spherocylinder::kBatch];  // and beside it at a joint
  int spread_count = 0;

  // Of pairs, once a law has had its say: overlap over the sum of the radii.
  spherocylinder::Doubles depth{};

  double reach(int k) const { return arms.radius_i[k] + arms.radius_j[k]; }
  bool can_move(int k) const { return loads.inverse_mass[k] != 0.0; }
  // Of the contact point from the end of arm_i, against the normal (m): midway in the overlap.
  double depth_i(int k) const { return arms.radius_i[k] - 0.5 * (reach(k) - arms.distance[k]); }
  double depth_j(int k) const { return arms.radius_j[k] - 0.5 * (reach(k) - arms.distance[k]); }
};

// Adds what contacts spread over nearly parallel rods push beside the law's force.
void add_spread(ContactBatch &batch);
// Of loads that contacts share, each takes its own.
void take_weights(ContactBatch &batch);

}  // namespace LAMMPS_NS
