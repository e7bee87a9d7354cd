// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_heat_gran_spherocylinder.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "fix_property_atom.h"
#include "host/rod_error.h"
#include "lists/lists_in_use.h"
#include "lists/touching_rod_pairs.h"
#include "math_const.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
using MathConst::MY_PI;

namespace {

// LIGGGHTS's numbers for `contact_area overlap`, `constant` and `projection`.
enum AreaMode { kOverlap, kConstant, kProjection };

// Of the circle in which two spheres meet; of the smaller one's section if it is inside the other.
double area_of_meeting_circle(double radius_i, double radius_j, double distance)
{
  const double smaller = std::min(radius_i, radius_j);
  if (distance < std::max(radius_i, radius_j)) return MY_PI * smaller * smaller;
  const double to_plane =
      (distance * distance + radius_i * radius_i - radius_j * radius_j) / (2.0 * distance);
  return MY_PI * std::max(0.0, radius_i * radius_i - to_plane * to_plane);
}

}  // namespace

FixHeatGranSpherocylinder::FixHeatGranSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixHeatGranCond(lmp, narg, arg)
{
}

void FixHeatGranSpherocylinder::init()
{
  FixHeatGranCond::init();
  rods_ = &rods_of(lmp, style);
}

double FixHeatGranSpherocylinder::contact_area(int i, int j, double distance) const
{
  if (area_calculation_mode_ == kConstant) return fixed_contact_area_;
  const double radius_i = atom->shape[i][0], radius_j = atom->shape[j][0];
  if (area_calculation_mode_ == kProjection) {
    const double larger = std::max(radius_i, radius_j);
    return MY_PI * larger * larger;
  }
  double overlap = radius_i + radius_j - distance;
  if (area_correction_flag_) overlap *= deltan_ratio_[atom->type[i] - 1][atom->type[j] - 1];
  return area_of_meeting_circle(radius_i, radius_j, radius_i + radius_j - overlap);
}

// Heat per time and degree (W/K), as LIGGGHTS's manual gives it: 4 k_i k_j/(k_i + k_j) sqrt(A).
double FixHeatGranSpherocylinder::conductance(int i, int j, double area) const
{
  const double k_i = conductivity_[atom->type[i] - 1], k_j = conductivity_[atom->type[j] - 1];
  if (std::min(k_i, k_j) < SMALL_FIX_HEAT_GRAN) return 0.0;
  return 4.0 * k_i * k_j / (k_i + k_j) * std::sqrt(area);
}

// Half of the directed flux (W m), flux times the way between the centres, belongs to each of the two.
void FixHeatGranSpherocylinder::add_flux(int rod, double flux, const double *directed)
{
  heatFlux[rod] += flux;
  for (int d = 0; d < 3; d++) directionalHeatFlux[rod][d] += 0.5 * directed[d];
}

void FixHeatGranSpherocylinder::add_contact(int rod, double area)
{
  if (!store_contact_data_) return;
  conduction_contact_area_[rod] += area;
  n_conduction_contacts_[rod] += 1.0;
}

// A pair whose partner is a ghost is also seen by the ghost's owner, who adds its part.
void FixHeatGranSpherocylinder::post_force(int)
{
  updatePtrs();
  if (store_contact_data_) {
    fix_conduction_contact_area_->set_all(0.0);
    fix_n_conduction_contacts_->set_all(0.0);
  }
  const TouchingRodPairs *pairs = rods_->attached<ListsInUse>().touching_pairs;
  if (!pairs) return;
  const int nlocal = atom->nlocal, *mask = atom->mask;
  pairs->for_each([&](const TouchingRodPairs::Touch &touch) {
    const int i = touch.i, j = touch.j;
    if (!((mask[i] | mask[j]) & groupbit)) return;
    const double area = contact_area(i, j, touch.distance);
    const double flux = (Temp[j] - Temp[i]) * conductance(i, j, area);
    double directed[3];
    for (int d = 0; d < 3; d++) directed[d] = flux * (atom->x[i][d] - atom->x[j][d]);
    add_flux(i, flux, directed);
    add_contact(i, area);
    if (j >= nlocal) return;
    add_flux(j, -flux, directed);
    add_contact(j, area);
  });
  if (!store_contact_data_) return;
  for (int i = 0; i < nlocal; i++)
    if (n_conduction_contacts_[i] > 0.0) conduction_contact_area_[i] /= n_conduction_contacts_[i];
}

void FixHeatGranSpherocylinder::cpl_evaluate(ComputePairGranLocal *)
{
  rod_error_all(lmp,
                "Fix %s (id %s): heat of single contacts is not available with rods (use "
                "f_heatFlux)",
                style, id);
}
