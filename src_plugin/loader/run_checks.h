// SPDX-License-Identifier: GPL-2.0-or-later
// What must hold of the rods while a run goes on. Each failure is one sentence that says who, what, the
// value seen and the value wanted. Styles of LIGGGHTS that do not know rods: host_styles.h.
#pragma once

#include "rods/rod_watcher.h"

namespace LAMMPS_NS {

class LAMMPS;

// Keeps the contact histories with their rods, hands over those that have come far, and looks at each
// of these occasions whether the rods are sound.
class RunChecks : public RodWatcher {
 public:
  explicit RunChecks(LAMMPS *lmp) : lmp_(lmp) {}
  void run_begins() override;
  void places_change() override;
  void rods_are_written() override;
  void rods_migrate() override;

 private:
  LAMMPS *lmp_;
  bool images_may_touch_twice_ = false;
  int moved_groups_ = -1;  // groups whose rods a fix moves or freezes; all where nothing runs
  bool is_handing_over_ = false;
};

// Without our surface model the stock pair and wall would use the rods' bounding spheres.
void check_contact_styles_know_rods(LAMMPS *lmp);

}  // namespace LAMMPS_NS
