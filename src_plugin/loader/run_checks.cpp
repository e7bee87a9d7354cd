// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/run_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "contacts/contact_monitor.h"
#include "core/mass_properties.h"
#include "domain.h"
#include "fix.h"
#include "fix_contact_history.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "host/rod_error.h"
#include "lammps.h"
#include "loader/rod_integrators.h"
#include "modify.h"
#include "pair_gran.h"
#include "parallel/far_rods.h"
#include "rods/atom_vec_spherocylinder.h"
#include "styles/fix_contact_history_spherocylinder.h"
#include "styles/fix_fibres_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

// Radius, mass and inertia are worked out from the same numbers by the same formula, so that
// anything beyond round-off means that another command has written one of them.
constexpr double kRoundOff = 1e-12;

bool differs(double a, double b) { return std::fabs(a - b) > kRoundOff * std::fabs(b); }

bool is_running(LAMMPS *lmp) { return lmp->update->whichflag == 1; }

// Ids and numbers that make up a message; the first, an id, is 0 if there is nothing to say.
using Found = std::array<int, 2>;

// What the first rank that has found something has found.
Found found_by_any(LAMMPS *lmp, Found found)
{
  const int mine = found[0] ? lmp->comm->me : lmp->comm->nprocs;
  int first = 0;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, lmp->world);
  if (first == lmp->comm->nprocs) return found;
  MPI_Bcast(found.data(), static_cast<int>(found.size()), MPI_INT, first, lmp->world);
  return found;
}

// Each rod has a size; its mass and inertia follow a density that was changed from outside.
void check_rods_are_whole(LAMMPS *lmp, AtomVecSpherocylinder &rods)
{
  const Atom *atom = lmp->atom;
  const FibreSegments &fibres = rods.attached<FibreSegments>();
  for (int i = 0; i < atom->nlocal; i++) {
    const int shared_ends = fibres.shared_ends(i);
    const double *shape = atom->shape[i];
    if (shape[0] == 0.0 || shape[2] == 0.0)
      rod_error_one(
          lmp,
          "Atom style spherocylinder: rod %d, made by create_atoms, has no %s; give it by "
          "set ... diameter D length L density RHO",
          atom->tag[i], shape[0] == 0.0 ? "diameter" : "length");
    const spherocylinder::MassProperties wanted = spherocylinder::mass_properties(
        2.0 * shape[0], 2.0 * shape[2], atom->density[i], shared_ends);
    if (atom->radius[i] != shape[2] || differs(atom->volume[i], wanted.volume))
      rod_error_one(
          lmp,
          "Atom style spherocylinder: the radius or volume of rod %d (length %g, diameter "
          "%g) was changed by itself; the size of a rod is changed by set ... diameter D "
          "length L",
          atom->tag[i], 2.0 * shape[2], 2.0 * shape[0]);
    if (differs(atom->inertia[i][0], wanted.inertia_transverse))
      rods.set_rod(i, 2.0 * shape[0], 2.0 * shape[2], atom->density[i], shared_ends);
    else if (differs(atom->rmass[i], wanted.mass))
      rod_error_one(lmp,
                    "Atom style spherocylinder: rod %d has mass %g but its size and density %g "
                    "make %g; change its density by set density",
                    atom->tag[i], atom->rmass[i], atom->density[i], wanted.mass);
  }
}

// Whether the box is so short that two rods may touch through two images at a time; `warn` says so.
// A rod must not reach its own image, and of two rods only one pair of images may touch at a time:
// LIGGGHTS tells contact histories apart by the rods' ids.
bool check_rods_fit_periodic_box(LAMMPS *lmp, bool warn)
{
  const Domain *domain = lmp->domain;
  double local = 0.0, longest = 0.0;
  for (int i = 0; i < lmp->atom->nlocal; i++) local = std::max(local, 2.0 * lmp->atom->radius[i]);
  for (int i = 0; i < lmp->modify->nfix; i++)
    if (lmp->modify->fix[i]->use_rad_for_cut_neigh_and_ghost())
      for (int type = 1; type <= lmp->atom->ntypes; type++)
        local = std::max(local, 2.0 * lmp->modify->fix[i]->max_rad(type));
  MPI_Allreduce(&local, &longest, 1, MPI_DOUBLE, MPI_MAX, lmp->world);

  const double period[3] = {domain->xprd, domain->yprd, domain->zprd};
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  bool twice = false;
  for (int d = 0; d < 3; d++) {
    if (!periodic[d]) continue;
    if (period[d] <= longest)
      rod_error_all(
          lmp,
          "Atom style spherocylinder: the box is periodic in %c with %g, wanted more than "
          "the longest rod's length %g (it would touch its own image)",
          'x' + d, period[d], longest);
    if (period[d] > 2.0 * longest) continue;
    twice = true;
    if (warn && lmp->comm->me == 0)
      rod_warning(lmp,
                  "Atom style spherocylinder: the box is periodic in %c with %g; below twice the "
                  "longest rod's length %g two rods may touch through two images at a time, whose "
                  "contact histories cannot be told apart: a run ends with an error if they do",
                  'x' + d, period[d], longest);
  }
  return twice;
}

// Called by all ranks when the histories of contacts are with their rods.
void check_pairs_touch_once(LAMMPS *lmp)
{
  auto *pair = dynamic_cast<PairGran *>(lmp->force->pair);
  FixContactHistory *history = pair ? pair->get_fix_history() : nullptr;
  if (!history || history->get_dnum() == 0) return;
  Found twice = {};  // two ids
  for (int i = 0; i < lmp->atom->nlocal && !twice[0]; i++)
    for (int k = 0; k < history->n_partner(i); k++)
      for (int l = 0; l < k; l++)
        if (history->partner(i, k) == history->partner(i, l))
          twice = {lmp->atom->tag[i], history->partner(i, k)};
  twice = found_by_any(lmp, twice);
  if (twice[0])
    rod_error_all(lmp,
                  "Atom style spherocylinder: at step " BIGINT_FORMAT
                  " rods %d and %d touch through "
                  "two periodic images, whose contact histories cannot be told apart; wanted a "
                  "periodic box longer than two rods",
                  lmp->update->ntimestep, twice[0], twice[1]);
}

}  // namespace

// LIGGGHTS may go on to make its lists anew, without contacts: histories first.
void RunChecks::run_begins()
{
  if (!find_fibres(lmp_) && lmp_->modify->have_restart_data_style(FixFibresSpherocylinder::kStyle))
    rod_error_all(lmp_,
                  "Atom style spherocylinder: the restart file has fibres, but no fix holds them "
                  "together (expected fix ID all joint/spherocylinder)");
  bring_histories_to_rods(lmp_);
  AtomVecSpherocylinder &rods =
      rods_of(lmp_, "Atom style spherocylinder cannot be part of another style: it");
  rods.attached<ContactMonitor>().run_begins();
  check_rods_are_whole(lmp_, rods);
  images_may_touch_twice_ = check_rods_fit_periodic_box(lmp_, true);
  moved_groups_ = check_each_rod_is_integrated_once(lmp_);
}

void RunChecks::places_change() { bring_histories_to_rods(lmp_); }

// LIGGGHTS's `restart` command writes in the middle of a run, when histories are in the pair style's list.
void RunChecks::rods_are_written() { bring_histories_to_rods(lmp_); }

void RunChecks::rods_migrate()
{
  if (is_handing_over_) return;
  if (lmp_->domain->box_change_size || lmp_->domain->box_change_shape)
    images_may_touch_twice_ = check_rods_fit_periodic_box(lmp_, !images_may_touch_twice_);
  if (images_may_touch_twice_) check_pairs_touch_once(lmp_);
  check_new_rods_are_integrated(lmp_, moved_groups_);
  is_handing_over_ = true;
  hand_over_far_rods(lmp_);
  is_handing_over_ = false;
}

void LAMMPS_NS::check_contact_styles_know_rods(LAMMPS *lmp)
{
  if (!is_running(lmp)) return;

  if (lmp->force->pair) {
    auto *pair = dynamic_cast<PairGran *>(lmp->force->pair);
    if (!pair)
      rod_error_all(lmp,
                    "Atom style spherocylinder: pair_style %s does not know rods, use pair_style "
                    "gran with surface spherocylinder",
                    lmp->force->pair_style);
    if (!pair->contact_match("surface", "spherocylinder"))
      rod_error_all(lmp, "Atom style spherocylinder: pair_style gran must be given surface "
                         "spherocylinder (without it rods would touch as their bounding spheres)");
  }
  for (int i = 0; i < lmp->modify->nfix; i++) {
    Fix *fix = lmp->modify->fix[i];
    if (strncmp(fix->style, "wall/gran", 9) != 0) continue;
    auto *wall = dynamic_cast<FixWallGran *>(fix);
    if (wall && !wall->contact_match("surface", "spherocylinder"))
      rod_error_all(lmp,
                    "Fix %s (id %s): with atom_style spherocylinder it must be given surface "
                    "spherocylinder (without it rods would touch as their bounding spheres)",
                    fix->style, fix->id);
  }
}
