// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "contacts/contact_observer.h"

namespace LAMMPS_NS {

class LAMMPS;
class SuddenOverlaps;

// Where fixes and commands find the contacts of all pairs and walls. Attached to the rods.
class ContactState {
 public:
  explicit ContactState(LAMMPS *) {}

  // From now on, until it leaves, an observer sees every contact.
  void join(ContactObserver &observer) { observers_.push_back(&observer); }
  void leave(ContactObserver &observer)
  {
    observers_.erase(std::remove(observers_.begin(), observers_.end(), &observer),
                     observers_.end());
  }
  const ContactObservers &observers() const { return observers_; }

  // Of the pair style that a restart file held, until another takes its contacts over: the models' hash code
  // and values of a contact.
  struct Restarted {
    int64_t hashcode = 0;
    int values = 0;
  };
  Restarted restarted;

  SuddenOverlaps *sudden_overlaps = nullptr;  // the pair style's, set by it; null without one

 private:
  ContactObservers observers_;
};

}  // namespace LAMMPS_NS
