// SPDX-License-Identifier: GPL-2.0-or-later
// Entered under LIGGGHTS's own names, heat/gran and heat/gran/conduction, while the atom style is
// spherocylinder (loader/style_table.cpp).
#ifndef LMP_FIX_HEAT_GRAN_SPHEROCYLINDER_H
#define LMP_FIX_HEAT_GRAN_SPHEROCYLINDER_H

#include "fix_heat_gran_conduction.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;

// Conduction between touching rods: through the contact of two spheres of the rods' radii with the
// same overlap. LIGGGHTS's own loop takes bounding spheres.
class FixHeatGranSpherocylinder : public FixHeatGranCond {
 public:
  FixHeatGranSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void init() override;
  void post_force(int vflag) override;
  void cpl_evaluate(ComputePairGranLocal *caller) override;

 private:
  AtomVecSpherocylinder *rods_ = nullptr;

  double contact_area(int i, int j, double distance) const;
  double conductance(int i, int j, double area) const;
  void add_flux(int rod, double flux, const double *directed);
  void add_contact(int rod, double area);
};

}  // namespace LAMMPS_NS

#endif
