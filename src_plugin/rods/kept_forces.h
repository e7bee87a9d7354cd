// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of the step at which the command `restart` wrote a file within a run. The next step begins with them:
// worked out again they would be those of the velocities at the step's end, and not those half a kick before.
#pragma once

#include <array>
#include <map>
#include <vector>

namespace LAMMPS_NS {

class Atom;
class LAMMPS;

// Attached to the rods.
class KeptForces {
 public:
  // Numbers of a rod in the file, its last: force, torque and a mark that they are there.
  static constexpr int kNumbers = 7;

  explicit KeptForces(LAMMPS *lmp) : lmp_(lmp) {}

  // Whether rods are written with them: within a run.
  bool are_written() const;
  int pack(int rod, double *buffer) const;

  // Of a rod that has just been read: whether the last numbers of it are such, which then are kept.
  bool take(int rod, const double *end);

  // By all ranks, when a run begins: those of rods that have not been moved since.
  void look_at_rods();
  // By all ranks, when forces have been worked out: puts those of the file in their place, if `they_hold`.
  void use(bool they_hold);

 private:
  struct Kept {
    double id;
    std::array<double, 13> state;
    std::array<double, 6> forces;
    std::array<double, 3> angmom;  // which integrators set from omega when a run begins
  };
  std::map<double, Kept> of_my_rods() const;
  static std::array<double, 13> state_of(const Atom &atom, int rod);

  LAMMPS *lmp_;
  std::vector<Kept> kept_;  // of the rods that this rank has read
};

}  // namespace LAMMPS_NS
