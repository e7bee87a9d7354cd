// SPDX-License-Identifier: GPL-2.0-or-later
// A gas of colliding rods and what it must conserve.
#pragma once

#include "scene.h"

namespace decks {

struct RodGas {
  int rods = 500;
  double aspect_ratio = 10.0;    // the longest rod's
  double shortest = 1.0;         // of the lengths, as a part of the longest; evenly spread
  double volume_fraction = 0.1;  // of the periodic cube; its side must exceed two rod lengths
  double overlap = 0.015;        // about the deepest of a contact, / diameter: sets the speed
  double stiffness = 1e5;        // kn, N/m
  unsigned seed = 86028121;
};

// Rods at random places and directions that do not overlap, in random motion with as much energy
// of rotation across their axes as of translation in two directions; total momentum 0. A periodic
// cube about the origin; no physics and time step yet.
Scene scene_of(const RodGas &gas);

// The shortest contact two of these rods can have, end on end (s): pi sqrt(m_eff / kn).
double shortest_contact(const RodGas &gas);

// Kinetic energy and kn overlap^2/2 of all pairs, their distances by search.
double total_energy(const std::vector<Rod> &rods, const Scene &scene, double stiffness);

// Contacts that begin between one frame and the next; two of the same rod within a frame's
// interval may be missed.
double collisions(const std::vector<Frame> &frames);

}  // namespace decks
