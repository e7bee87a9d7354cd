// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/host_checks.h"

#include <cstring>
#include <sstream>
#include <string>

#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "dump.h"
#include "fix.h"
#include "force.h"
#include "group.h"
#include "host/private_members.h"
#include "host/rod_error.h"
#include "lammps.h"
#include "loader/host_styles.h"
#include "loader/run_checks.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "region.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/ghost_user.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace spherocylinder {

namespace {

bool has_rods(const LAMMPS *lmp) { return dynamic_cast<AtomVecSpherocylinder *>(lmp->atom->avec); }

bool is(const char *a, const char *b) { return strcmp(a, b) == 0; }

// `who` as the deck's writer knows it: "Fix move (id m)".
void check(LAMMPS *lmp, HostKind kind, const char *name, const std::string &who)
{
  const HostStyle *row = name ? find_host_style(kind, name) : nullptr;
  if (row && row->verdict == Verdict::Refused)
    rod_error_all(lmp, "%s with atom_style spherocylinder: %s", who.c_str(), row->sentence);
}

void check(LAMMPS *lmp, HostKind kind, const char *name)
{
  if (name) check(lmp, kind, name, std::string(word_for(kind)) + " " + name);
}

void check_with_id(LAMMPS *lmp, HostKind kind, const char *name, const char *id)
{
  check(lmp, kind, name, std::string(word_for(kind)) + " " + name + " (id " + id + ")");
}

void check_box(LAMMPS *lmp)
{
  if (lmp->domain->triclinic) check(lmp, HostKind::Box, "triclinic");
  if (lmp->domain->dimension == 2) check(lmp, HostKind::Box, "dimension 2");
}

// A region of the style prism makes a triclinic box.
void check_create_box(LAMMPS *lmp, const char *region_id)
{
  const int found = lmp->domain->find_region(const_cast<char *>(region_id));
  if (found >= 0 && is(lmp->domain->regions[found]->style, "prism"))
    check(lmp, HostKind::Box, "triclinic");
}

void check_change_box(LAMMPS *lmp, int narg, char **arg)
{
  for (int k = 1; k < narg; k++)
    if (is(arg[k], "triclinic") || is(arg[k], "xy") || is(arg[k], "xz") || is(arg[k], "yz"))
      check(lmp, HostKind::Box, "triclinic");
}

void check_atom_style(LAMMPS *lmp, int narg, char **arg)
{
  if (narg < 1 || !is(arg[0], "hybrid")) return;
  for (int k = 1; k < narg; k++)
    if (is(arg[k], "spherocylinder")) check(lmp, HostKind::AtomStyle, "hybrid");
}

// mesh/surface/stress/servo: the modules are named after the style.
void check_mesh_modules(LAMMPS *lmp, const char *style)
{
  const std::string prefix = "mesh/surface/";
  std::string rest = style;
  if (rest.compare(0, prefix.size(), prefix) != 0) return;
  rest.erase(0, prefix.size());
  while (!rest.empty()) {
    const std::string module = rest.substr(0, rest.find('/'));
    check(lmp, HostKind::MeshModule, module.c_str());
    rest.erase(0, module.size() + 1);
  }
}

void check_fix(LAMMPS *lmp, const char *style, const char *id)
{
  check_with_id(lmp, HostKind::Fix, style, id);
  check_mesh_modules(lmp, style);
}

// The style that a command's words name.
void check_words(LAMMPS *lmp, const char *command, int narg, char **arg)
{
  if (is(command, "fix") && narg > 2)
    check_fix(lmp, arg[2], arg[0]);
  else if (is(command, "compute") && narg > 2)
    check_with_id(lmp, HostKind::Compute, arg[2], arg[0]);
  else if (is(command, "dump") && narg > 2)
    check_with_id(lmp, HostKind::Dump, arg[2], arg[0]);
  else if (is(command, "write_dump") && narg > 1)
    check(lmp, HostKind::Dump, arg[1]);
  else if (is(command, "pair_style") && narg > 0)
    check(lmp, HostKind::Pair, arg[0]);
  else if (is(command, "run_style") && narg > 0)
    check(lmp, HostKind::Integrate, arg[0]);
  else if (is(command, "units") && narg > 0)
    check(lmp, HostKind::Units, arg[0]);
  else if (is(command, "create_box") && narg > 1)
    check_create_box(lmp, arg[1]);
  else if (is(command, "change_box"))
    check_change_box(lmp, narg, arg);
}

// LIGGGHTS finds rods of other ranks and images when it renews its lists. Settings of neigh_modify that
// put this off let rods pass through each other.
void renew_lists_in_time(LAMMPS *lmp)
{
  Neighbor &neighbor = *lmp->neighbor;
  if (neighbor.every <= 1 && neighbor.delay <= 1 && !neighbor.build_once) return;
  if (lmp->comm->me == 0)
    rod_warning(
        lmp,
        "Command neigh_modify with atom_style spherocylinder: every 1 delay 0 check yes are "
        "used (got every %d delay %d check %s once %s), later ones would miss contacts",
        neighbor.every, neighbor.delay, neighbor.dist_check ? "yes" : "no",
        neighbor.build_once ? "yes" : "no");
  neighbor.every = 1;
  neighbor.delay = 0;
  neighbor.dist_check = 1;
  neighbor.build_once = 0;
}

void check_ghosts(LAMMPS *lmp)
{
  const int group = ghost_group(*lmp->comm);
  if (group > 0)
    rod_error_all(
        lmp,
        "Command communicate with atom_style spherocylinder: group %s leaves out rods of "
        "other ranks and images, whose contacts would be missed; use communicate single vel "
        "yes",
        lmp->group->names[group]);
}

// Whether the deck has made or changed what `run pre no` does not prepare, since the last run that was
// prepared: it goes on with LIGGGHTS's lists of fixes by number, so that a new one is not called, and
// behind one that is gone others are called in its place, or memory that is no fix's. Attached to the
// rods.
struct Unprepared {
  explicit Unprepared(LAMMPS *) {}
  bool any = false;
};

bool &unprepared(LAMMPS *lmp)
{
  return static_cast<AtomVecSpherocylinder &>(*lmp->atom->avec).attached<Unprepared>().any;
}

constexpr const char *kToBePrepared[] = {"fix",  "unfix",      "compute",     "uncompute",
                                         "dump", "pair_style", "thermo_style"};

void check_run(LAMMPS *lmp, int narg, char **arg)
{
  if (lmp->update->first_update == 0 || !unprepared(lmp)) return;
  for (int k = 1; k + 1 < narg && !is(arg[k], "every"); k++)
    if (is(arg[k], "pre") && is(arg[k + 1], "no"))
      rod_error_all(
          lmp, "Command run: pre no cannot be used after fix, unfix, compute, uncompute, dump, "
               "pair_style or thermo_style, it goes on with those of the run before (expected "
               "run without pre no)");
}

// Fixes and computes of ours under names that LIGGGHTS has not, which look at no rods of other ranks but those
// that touch.
constexpr const char *kReadNoGhosts[] = {"balance",
                                         "check/timestep/spherocylinder",
                                         "contact/spherocylinder",
                                         "erotate/spherocylinder",
                                         "fibres/spherocylinder",
                                         "hinge/spherocylinder",
                                         "joint/spherocylinder/local",
                                         "limit/omega",
                                         "nve/spherocylinder",
                                         "particletemplate/spherocylinder",
                                         "rest/spherocylinder"};

// Whoever is in no table, as a style of another library, is taken to read ghosts.
bool reads_ghosts(HostKind kind, const char *style)
{
  for (const char *own : kReadNoGhosts)
    if (is(style, own)) return false;
  if (strncmp(style, "mesh/surface", 12) == 0) return false;  // with any modules
  const HostStyle *row = find_host_style(kind, style);
  return !row || row->reads_ghosts;
}

// Whether ghosts that touch nothing may be left out of a step's messages (rods/needed_ghosts.h).
void see_who_reads_ghosts(LAMMPS *lmp)
{
  NeededGhosts &ghosts = static_cast<AtomVecSpherocylinder &>(*lmp->atom->avec).ghosts();
  ghosts.begin_run();
  const auto look = [&](HostKind kind, const char *style, const char *id) {
    if (reads_ghosts(kind, style))
      ghosts.send_all_for(std::string(word_for(kind)) + " " + style + " (id " + id + ")");
  };
  for (int i = 0; i < lmp->modify->nfix; i++) {
    const Fix *fix = lmp->modify->fix[i];
    if (!dynamic_cast<const GhostUser *>(fix)) look(HostKind::Fix, fix->style, fix->id);
  }
  for (int i = 0; i < lmp->modify->ncompute; i++) {
    const Compute *compute = lmp->modify->compute[i];
    look(HostKind::Compute, compute->style, compute->id);
  }
}

void say_if_rods_cannot_touch(LAMMPS *lmp)
{
  if (!lmp->force->pair && lmp->comm->me == 0)
    rod_warning(lmp, "Atom style spherocylinder: there is no pair_style, rods pass through each "
                     "other");
}

// LIGGGHTS goes through the words of a dump's format, one a column, without looking whether there is one.
void check_dump_format(LAMMPS *lmp, Dump &dump)
{
  if (!is(dump.style, "custom") && !is(dump.style, "local")) return;
  const char *format = dump_format(dump);
  if (!format) return;
  std::istringstream stream(format);
  int words = 0;
  for (std::string word; stream >> word;) words++;
  const int columns = dump_columns(dump);
  if (words < columns)
    rod_error_all(lmp,
                  "Dump %s (id %s): the format of dump_modify must have a word for each of the %d "
                  "columns (got %d)",
                  dump.style, dump.id, columns, words);
}

// LIGGGHTS asks for atom types that start from 1 then.
void check_there_is_a_rod(LAMMPS *lmp)
{
  if (lmp->atom->natoms > 0) return;
  for (int i = 0; i < lmp->modify->nfix; i++)
    if (strncmp(lmp->modify->fix[i]->style, "particletemplate/", 17) == 0) return;
  rod_error_all(
      lmp, "Atom style spherocylinder: there is no rod and no fix particletemplate/spherocylinder "
           "to make one; wanted rods from read_data, create_atoms or an insertion");
}

}  // namespace

void check_command_before(LAMMPS *lmp, const char *command, int narg, char **arg)
{
  if (is(command, "atom_style")) check_atom_style(lmp, narg, arg);
  if (!has_rods(lmp)) return;
  check(lmp, HostKind::BuiltIn, command);
  check(lmp, HostKind::Command, command);
  check_words(lmp, command, narg, arg);
  if (is(command, "run")) check_run(lmp, narg, arg);
  for (const char *changing : kToBePrepared)
    if (is(command, changing)) unprepared(lmp) = true;
}

void check_command_after(LAMMPS *lmp)
{
  if (has_rods(lmp)) check_box(lmp);
}

void check_styles_at_run_start(LAMMPS *lmp)
{
  if (!has_rods(lmp)) return;
  unprepared(lmp) = false;
  renew_lists_in_time(lmp);
  check_ghosts(lmp);
  check_contact_styles_know_rods(lmp);  // before the pair style looks at stored histories
  if (lmp->update->whichflag == 1) {
    if (!(lmp->update->dt > 0.0))
      rod_error_all(
          lmp,
          "Command timestep with atom_style spherocylinder: the time step must be > 0 (got %g)",
          lmp->update->dt);
    check_there_is_a_rod(lmp);
    say_if_rods_cannot_touch(lmp);
  }
  check_box(lmp);
  check(lmp, HostKind::Units, lmp->update->unit_style);
  check(lmp, HostKind::Integrate, lmp->update->integrate_style);
  check(lmp, HostKind::Pair, lmp->force->pair_style);
  for (int i = 0; i < lmp->modify->nfix; i++)
    check_fix(lmp, lmp->modify->fix[i]->style, lmp->modify->fix[i]->id);
  for (int i = 0; i < lmp->modify->ncompute; i++) {
    const Compute *compute = lmp->modify->compute[i];
    check_with_id(lmp, HostKind::Compute, compute->style, compute->id);
  }
  for (int i = 0; i < lmp->output->ndump; i++) {
    Dump *dump = lmp->output->dump[i];
    check_with_id(lmp, HostKind::Dump, dump->style, dump->id);
    check_dump_format(lmp, *dump);
  }
  see_who_reads_ghosts(lmp);
}

}  // namespace spherocylinder
