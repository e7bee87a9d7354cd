// SPDX-License-Identifier: GPL-2.0-or-later
#include "rod_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "atom.h"
#include "atom_vec_spherocylinder.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_contact_history.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "pair_gran.h"
#include "property_registry.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

// Radius, mass and inertia are worked out from the same numbers by the same formula, so that
// anything beyond round-off means that another command has written one of them.
constexpr double kRoundOff = 1e-12;

std::string formatted(const char *format, va_list arguments)
{
  char text[512];
  vsnprintf(text, sizeof(text), format, arguments);
  return text;
}

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

}  // namespace

void LAMMPS_NS::rod_error_all(LAMMPS *lmp, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  lmp->error->all(FLERR, text.c_str());
  std::abort();  // not reached: Error::all ends the program
}

void LAMMPS_NS::rod_error_one(LAMMPS *lmp, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  lmp->error->one(FLERR, text.c_str());
  std::abort();  // not reached: Error::one ends the program
}

void LAMMPS_NS::rod_warning(LAMMPS *lmp, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  lmp->error->warning(FLERR, text.c_str());
  // A rank other than the first has no log file, and with -screen none or FILE no screen either.
  if (!lmp->screen && !lmp->logfile) fprintf(stderr, "WARNING: %s\n", text.c_str());
}

AtomVecSpherocylinder &LAMMPS_NS::rods_of(LAMMPS *lmp, const char *who)
{
  auto *rods = dynamic_cast<AtomVecSpherocylinder *>(lmp->atom->avec);
  if (!rods)
    rod_error_all(lmp, "%s requires atom_style spherocylinder (got %s)", who,
                  lmp->atom->atom_style);
  return *rods;
}

// A length (m), or 0 for `auto`.
static double close_skin_of(LAMMPS *lmp, const char *value)
{
  if (strcmp(value, "auto") == 0) return 0.0;
  char *end = nullptr;
  const double skin = strtod(value, &end);
  if (*end != '\0' || !(skin > 0.0) || !std::isfinite(skin))
    rod_error_all(lmp, "Surface spherocylinder: close_skin must be auto or a length > 0 (got %s)", value);
  return skin;
}

std::vector<char *> LAMMPS_NS::args_without_search(LAMMPS *lmp, int nargs, char **args,
                                                   SearchKeywords &search)
{
  std::vector<char *> others;
  search = SearchKeywords();
  for (int k = 0; k < nargs; k++) {
    const bool is_skin = strcmp(args[k], "close_skin") == 0;
    if (!is_skin && strcmp(args[k], "search") != 0) {
      others.push_back(args[k]);
      continue;
    }
    const char *value = ++k < nargs ? args[k] : "nothing";
    if (is_skin)
      search.close_skin = close_skin_of(lmp, value);
    else if (strcmp(value, "five_step") == 0 || strcmp(value, "exact") == 0)
      search.five_step = value[0] == 'f';
    else
      rod_error_all(lmp, "Surface spherocylinder: search must be exact or five_step (got %s)", value);
  }
  // Every keyword has one value; LIGGGHTS's reader takes it for granted.
  if (others.size() % 2 == 1)
    rod_error_all(lmp,
                  "Surface spherocylinder: the keywords behind the models must each have a value (the "
                  "last word, %s, has none)",
                  others.back());
  return others;
}

void LAMMPS_NS::check_atom_style_is_alone(LAMMPS *lmp)
{
  rods_of(lmp, "Atom style spherocylinder cannot be part of another style: it");
}

void LAMMPS_NS::check_rods_are_whole(LAMMPS *lmp, AtomVecSpherocylinder &rods)
{
  const Atom *atom = lmp->atom;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *shape = atom->shape[i];
    if (shape[0] == 0.0 || shape[2] == 0.0)
      rod_error_one(lmp,
                    "Atom style spherocylinder: rod %d, made by create_atoms, has no %s; give it by "
                    "set ... diameter D length L density RHO",
                    atom->tag[i], shape[0] == 0.0 ? "diameter" : "length");
    const spherocylinder::MassProperties wanted =
        spherocylinder::mass_properties(2.0 * shape[0], 2.0 * shape[2], atom->density[i]);
    if (atom->radius[i] != shape[2] || differs(atom->volume[i], wanted.volume))
      rod_error_one(lmp,
                    "Atom style spherocylinder: the radius or volume of rod %d (length %g, diameter "
                    "%g) was changed by itself; the size of a rod is changed by set ... diameter D "
                    "length L",
                    atom->tag[i], 2.0 * shape[2], 2.0 * shape[0]);
    if (differs(atom->inertia[i][0], wanted.inertia_transverse))
      rods.set_rod(i, 2.0 * shape[0], 2.0 * shape[2], atom->density[i]);
    else if (differs(atom->rmass[i], wanted.mass))
      rod_error_one(lmp,
                    "Atom style spherocylinder: rod %d has mass %g but its size and density %g "
                    "make %g; change its density by set density",
                    atom->tag[i], atom->rmass[i], atom->density[i], wanted.mass);
  }
}

// A rod must not reach its own image, and of two rods only one pair of images may touch at a time:
// LIGGGHTS tells contact histories apart by the rods' ids.
bool LAMMPS_NS::check_rods_fit_periodic_box(LAMMPS *lmp, bool warn)
{
  const Domain *domain = lmp->domain;
  double local = 0.0, longest = 0.0;
  for (int i = 0; i < lmp->atom->nlocal; i++)
    local = std::max(local, 2.0 * lmp->atom->radius[i]);
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
      rod_error_all(lmp,
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

void LAMMPS_NS::check_pairs_touch_once(LAMMPS *lmp)
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
                  "Atom style spherocylinder: at step " BIGINT_FORMAT " rods %d and %d touch through "
                  "two periodic images, whose contact histories cannot be told apart; wanted a "
                  "periodic box longer than two rods",
                  lmp->update->ntimestep, twice[0], twice[1]);
}

void LAMMPS_NS::check_types_have_properties(LAMMPS *lmp, int highest)
{
  const Atom *atom = lmp->atom;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (atom->type[i] > highest)
      rod_error_one(lmp,
                    "Pair gran: rod %d has atom type %d at step " BIGINT_FORMAT ", but materials were "
                    "set up for types up to %d, the highest in use when LIGGGHTS last did so "
                    "(expected run without pre no after a command that changes types)",
                    atom->tag[i], atom->type[i], lmp->update->ntimestep, highest);
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
      rod_error_all(lmp,
                    "Atom style spherocylinder: pair_style gran must be given surface "
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

void LAMMPS_NS::check_friction(LAMMPS *lmp)
{
  PropertyRegistry &registry = lmp->force->registry;
  double **friction = nullptr;
  registry.connect("coeffFrict", friction, "surface spherocylinder");
  for (int i = 1; friction && i <= registry.max_type(); i++)
    for (int j = 1; j <= registry.max_type(); j++)
      if (!(friction[i][j] >= 0.0))
        rod_error_all(lmp,
                      "Surface spherocylinder: coefficientFriction must be >= 0 (got %g for atom types "
                      "%d and %d)",
                      friction[i][j], i, j);
}
