// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "contacts/contact_observer.h"
#include "lmptype.h"
#include "pointers.h"

namespace LAMMPS_NS {

// Watches the contacts of all pairs and walls, whatever model made them: warns once a run if the time
// step is far too long or an overlap far too deep, and keeps the largest overlap. Attached to the rods.
// Of rods that stand, at a wall, it says nothing.
class ContactMonitor final : public ContactObserver, private Pointers {
 public:
  explicit ContactMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  // At the start of each run.
  void run_begins();
  void see(const ContactBatch &batch) override
  {
    Seen seen;
    look(batch, seen);
    take(seen);
  }

  // The same in two halves, the first for threads that look at batches at once.
  class Seen {
    friend class ContactMonitor;
    struct Overlap {
      int i, j;
      double over_diameter;
    };
    // Each deeper than those before, and than the largest when the step began.
    std::vector<Overlap> deeper;
    struct Stiff {
      int i;
      double stiffness, mass;
    };
    std::optional<Stiff> stiff;  // the first for which the step is too long
  };
  void look(const ContactBatch &batch, Seen &seen) const;
  // In the order of the contacts; leaves it empty.
  void take(Seen &seen);

  // Of any contact of this rank since the run began, walls included, over the (mean) diameter of its rods.
  double largest_overlap() const { return largest_overlap_; }

 private:
  bool time_step_warned_ = false, overlap_warned_ = false;
  int standing_groups_ = 0;
  double largest_overlap_ = 0.0;
  bigint step_ = -1;             // of the largest overlap so far
  double largest_before_ = 0.0;  // before that step, over the diameter

  void note_overlap(int i, int j, double overlap);
  void warn_overlap(int i, int j);
  void warn_time_step(int i, double stiffness, double effective_mass);
};

}  // namespace LAMMPS_NS
