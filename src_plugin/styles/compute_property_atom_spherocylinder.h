// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "compute_property_atom.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;

// compute property/atom for rods: axis, quaternion and size are filled in here, every other column
// by LIGGGHTS's own compute.
class ComputePropertyAtomSpherocylinder : public Compute {
 public:
  ComputePropertyAtomSpherocylinder(LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputePropertyAtomSpherocylinder() override;
  void init() override;
  void compute_peratom() override;
  double memory_usage() override;

  using RodValue = double (*)(const AtomVecSpherocylinder &rods, const Atom &atom, int i);

 private:
  struct Column {
    RodValue rod_value;  // null: column `stock` of stock_
    int stock;
  };

  AtomVecSpherocylinder &rods_;
  std::vector<Column> columns_;
  std::unique_ptr<ComputePropertyAtom> stock_;
  int stock_columns_ = 0;
  std::vector<double> values_;
  std::vector<double *> rows_;
};

}  // namespace LAMMPS_NS
