// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/capsule.h"
#include "insertion/capsule_cells.h"
#include "pointers.h"

namespace LAMMPS_NS {

// Rods and fibres placed by all ranks together: each rank proposes bodies, every rank says of all of them
// whether they are clear of its own rods, and of those that overlap each other the first stays. So a body
// may reach into any rank's part of the box and across periodic boundaries; ghosts are not asked.
class SharedPlacement : protected Pointers {
 public:
  using Body = std::vector<spherocylinder::Capsule>;

  // By all ranks, before anything of this insertion is placed. `largest`: bounding radius of the largest
  // capsule to be placed (m).
  SharedPlacement(LAMMPS *lmp, double largest);

  // Of this rank's rods, of bodies that it has placed, and of the body's own images.
  bool is_clear_here(const Body &body) const;

  // Whether the whole body is in the box where that is not periodic.
  bool is_in_box(const Body &body) const;

  // By all ranks: which of this rank's bodies are placed. They are clear here.
  std::vector<char> place(const std::vector<Body> &mine);

 private:
  double largest_;
  CapsuleCells own_;

  std::vector<Body> of_all_ranks(const std::vector<Body> &mine) const;
};

}  // namespace LAMMPS_NS
