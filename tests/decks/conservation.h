// SPDX-License-Identifier: GPL-2.0-or-later
// Runs of a gas of rods that measure what it keeps.
#pragma once

#include "rod_gas.h"

namespace decks {

// The largest deviation over the frames of a run, relative to the sum of the magnitudes of what
// adds up at the start; contacts that began.
struct Conserved {
  double error = 0.0;
  double collisions = 0.0;
  double energy_left = 1.0;  // part of the initial kinetic energy
};

// With damping, friction and history in a periodic box, where momentum is kept.
Conserved momentum_in_periodic_gas(const RodGas &gas, long steps);

// The same rods without walls, held together by a central force in proportion to their mass and
// distance, which keeps the angular momentum about its centre.
Conserved angular_momentum_in_a_trap(const RodGas &gas, long steps);

// Energy of an elastic frictionless gas, in units of the initial energy of one rod.
struct EnergyDrift {
  double dt = 0.0;  // s
  double collisions = 0.0;
  double drift = 0.0;    // at the end
  double largest = 0.0;  // deviation at any frame
};

// `contacts`: duration of the run in shortest contacts, `steps_per_contact` steps each.
EnergyDrift energy_of_elastic_gas(const RodGas &gas, int steps_per_contact, double contacts,
                                  bool spread_contact);

// The same, read only while nothing touches, when all energy is kinetic: no matter what the energy of
// a contact is. For gases so thin that this happens often.
struct EnergyBetweenContacts {
  double dt = 0.0;  // s
  double collisions = 0.0;
  int readings = 0;
  double drift = 0.0;           // at the last reading
  double largest = 0.0;         // at any reading
  double largest_change = 0.0;  // from one reading to the next
};
EnergyBetweenContacts energy_between_contacts(const RodGas &gas, int steps_per_contact,
                                              double contacts, bool spread_contact);

// How far the trapped gas with damping and friction is from that on one rank. Its rods have several
// contacts at a time, and forces added in another order differ by round-off.
struct RankDifference {
  Mode mode;
  long step;
  double contacts;  // at that step
  double position;  // largest of the centres and, with the axes, of the ends (m)
};

std::vector<RankDifference> difference_of_ranks(const RodGas &gas, const std::vector<Mode> &modes,
                                                long steps, long every);

}  // namespace decks
