// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "contacts/contact_observer.h"
#include "pointers.h"

namespace LAMMPS_NS {

// Collects an upper bound on the highest frequency of the spring network of all contacts.
//
// A contact's spring k stretches by the difference of its two points' displacements, and
// (x_i - x_j)^2 <= 2 x_i^2 + 2 x_j^2. With that the network's stiffness is bounded by springs that
// hold each rod on its own, and a rod's highest omega^2 by the trace of I^-1 K:
//   omega^2 <= max_i sum_c f k_c / m_ic,   1/m_ic = what rod i shows at contact c,
// with f = 2 for a contact with another rod and 1 for a wall, over the normal and both tangential
// directions. Velocity Verlet is stable below 2/omega. A rod that does not give way has none.
class RateCollector : public ContactObserver, private Pointers {
 public:
  explicit RateCollector(LAMMPS *lmp) : Pointers(lmp) {}

  // Begins anew, with the owned rods and ghosts of now.
  void start();
  void see(const ContactBatch &batch) override;

  double squared_frequency(int i) const { return squared_frequency_[i]; }  // bound, 1/s^2
  int contacts(int i) const { return contacts_[i]; }                       // walls included

 private:
  std::vector<double> squared_frequency_;
  std::vector<int> contacts_;
  int standing_groups_ = 0;

  // `arm`: from the rod's centre to the point on its axis; `depth`: from there to the contact point,
  // along -normal.
  void add(int i, double factor, const ContactBatch &batch, int k, const spherocylinder::Vec3 &arm,
           double depth, const spherocylinder::Vec3 &normal);
};

}  // namespace LAMMPS_NS
