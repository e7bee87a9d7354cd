// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of all pairs and their periodic images by search, and what they amount to. Nothing in
// common with the plug-in.
#pragma once

#include <vector>

#include "plan.h"

namespace grammar {

struct Touch {
  int i = 0, j = 0;        // ids; j = 0: a wall
  double reach = 0.0;      // sum of radii; of a wall's touch the rod's diameter
  double overlap = 0.0;    // > 0
  Vec3 normal{};           // to rod i
  Vec3 arm_i{}, arm_j{};   // from the centres to the contact point, midway in the overlap
  double stiffness = 0.0;  // of model linear
  bool plain = true;       // false: which points are closest, or on which side, hangs on round-off
};

// The distance of two axes by golden-section search along the first (to 1e-9 of its length), and
// the points where it is least, from the centres.
struct Closest {
  double distance = 0.0;
  Vec3 on_a{}, on_b{};
};
Closest closest_by_search(const Rod &a, const Rod &b, const Vec3 &b_from_a);

// Overlaps above `least` (may be negative: rods nearer than that), of a pair through each image that
// touches. A rod must not be longer than a period and a half, or images are missed.
std::vector<Touch> pair_touches(const State &state, const Material &material, double least = 0.0);
std::vector<Touch> wall_touches(const State &state, const std::vector<Wall> &walls,
                                const Material &material);

// The periods are known, and every pair touches through one image at most: they are above the two
// lengths.
bool images_are_plain(const State &state);

// Distance of a point from a wall's surface, > 0 on the inner side of the rod at `centre`.
double wall_gap(const Wall &wall, const Vec3 &point, const Vec3 &centre);

// Elastic energy that the overlaps hold, at most; negative if the model has no closed form here.
double spring_energy(const std::vector<Touch> &touches, const State &state,
                     const Material &material);

}  // namespace grammar
