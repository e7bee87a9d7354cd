// SPDX-License-Identifier: GPL-2.0-or-later
// The rods' fields (rod_fields.h) to and from LIGGGHTS's buffers: to ghosts and back, to other ranks,
// to restart files.
#pragma once

#include <vector>

#include "core/vec3.h"

namespace LAMMPS_NS {

class Atom;
class Domain;

// How far a ghost lies from its owner, whose period numbers are these; null: there is none between.
spherocylinder::Vec3 period_across(const Domain &domain, const int *pbc);

// Of a ghost over its owner, across a periodic boundary (kGainsPeriod, kGainsBoxSpeed).
struct GhostGain {
  spherocylinder::Vec3 period = {0.0, 0.0, 0.0};     // m, or 1 in lamda coordinates
  spherocylinder::Vec3 box_speed = {0.0, 0.0, 0.0};  // m/s
  int box_speed_groups = 0;                          // bits of the groups whose rods gain it
};

// The fields that travel so (Travel), of the n rods in `list`. Returns the number of values.
int pack_rod_fields(Atom &atom, unsigned travel, int n, const int *list, const GhostGain &gain,
                    double *buf);

// Into rods first ... first + n - 1. Returns where the buffer goes on.
const double *unpack_rod_fields(Atom &atom, unsigned travel, int n, int first, const double *buf);

// Into these rods.
const double *unpack_rod_fields(Atom &atom, unsigned travel, const std::vector<int> &rods,
                                const double *buf);

// Forces and torques on n ghosts, and onto their owners.
int pack_sums(Atom &atom, int n, int first, double *buf);
void add_sums(Atom &atom, int n, const int *list, const double *buf);

}  // namespace LAMMPS_NS
