// SPDX-License-Identifier: GPL-2.0-or-later
// All that rod_contacts says of one bed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cli/beds.h"
#include "measures/contact_forces.h"
#include "measures/contact_statistics.h"
#include "measures/fibre_contacts.h"

namespace spherocylinder {

struct ContactNumbers {
  MeanWithError per_rod;
  std::vector<std::size_t> rods_with;  // 0, 1, 2 ... contacts

  std::size_t rods_that_have(std::size_t contacts) const
  {
    return contacts < rods_with.size() ? rods_with[contacts] : 0;
  }
};

// Forces between rods, or of walls on rods.
struct MeasuredForces {
  std::vector<ContactForce> contacts;
  std::vector<double> sizes;  // of the forces, in the same order (N)
  Spread spread;              // of the sizes
  Vec3 sum;                   // of the forces; of walls: what they carry (N)
};

struct BedContacts {
  std::int64_t step;
  std::size_t rods;
  std::vector<ClosePair> pairs;  // without the joints of fibres, and those that count twice
  std::size_t doubtful_pairs;    // of which the dump's digits do not tell, see place_roundings
  std::vector<WallContact> walls;
  std::optional<FibreShapes> fibres;
  std::optional<FibreContacts> of_fibres;
  std::size_t doubles;  // contacts left out: on an end that two segments share
  ContactNumbers between_rods, with_walls;
  MeanWithError without_contact;  // part of the rods
  CountedKinds kinds;
  ContactKinds uncorrelated;
  MeanWithError side_position, sin_gamma;  // of the pairs
  double sin_gamma_of_all;
  std::vector<double> overlaps, wall_overlaps;
  Spread overlap, wall_overlap;
  std::optional<MeasuredForces> pair_forces, wall_forces;
  std::size_t forces_apart;  // pairs with a force whose gap is not below the one asked for
  ForceChains chains;        // of the pairs' forces
  MeanWithError strong;      // part of the pairs' forces that is strong
  MeanWithError in_chains;   // part of the rods
};

// Rods touch where the gap of their surfaces is below `gap` diameters of the thickest rod. Without
// a vessel no walls are looked for; without forces nothing is said of them. For `strong` see
// force_chains. Throws InputError if centres of rods lie outside the vessel.
BedContacts measure_contacts(const Bed &bed, const std::optional<Vessel> &vessel, double gap,
                             std::optional<std::vector<ContactForce>> pair_forces,
                             std::optional<std::vector<ContactForce>> wall_forces, double strong);

}  // namespace spherocylinder
