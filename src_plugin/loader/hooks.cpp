// SPDX-License-Identifier: GPL-2.0-or-later
// How the plug-in enters a stock LIGGGHTS. libliggghts calls its own exported functions through
// its procedure linkage table, so that a library found earlier in symbol look-up (this one, linked
// before it or named in LD_PRELOAD) stands in front of them. Eight functions, and those of
// dump_diameter.cpp and file_hooks.cpp, are enough:
//   LAMMPS::post_create  runs after construction and after the `clear` command
//   Atom::new_avec       is asked for every atom style
//   Input::execute_command, LAMMPS::init  where rods meet what LIGGGHTS offers: refused styles end here
//   Finish::end          prints the statistics after a run
//   WriteRestart::write  writes a restart file
//   Output::setup, Output::write  write dumps, restarts and the log, where files that are cut end the run
// All call the original and add to it.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <dlfcn.h>

#include "atom.h"
#include "error.h"
#include "finish.h"
#include "host/host_version.h"
#include "host/rod_error.h"
#include "host/written_files.h"
#include "input.h"
#include "lammps.h"
#include "lists/rod_pair_report.h"
#include "loader/host_build.h"
#include "loader/host_checks.h"
#include "loader/restart_files.h"
#include "loader/style_table.h"
#include "output.h"
#include "universe.h"
#include "update.h"
#include "write_restart.h"

#define EXPORT __attribute__((visibility("default")))

namespace {

template <typename Function>
Function next_symbol(const char *mangled_name)
{
  void *symbol = dlsym(RTLD_NEXT, mangled_name);
  if (!symbol) {
    fprintf(stderr,
            "ERROR: libspherocylinder: host program must be LIGGGHTS %s (got one without %s)\n",
            spherocylinder::kHostVersion, mangled_name);
    exit(1);
  }
  return reinterpret_cast<Function>(symbol);
}

void check_host(LAMMPS_NS::LAMMPS *lmp)
{
  const char *version = lmp->universe->version;
  std::string got;
  if (!spherocylinder::is_supported_host(version))
    got = version ? version : "no version";
  else
    got = spherocylinder::foreign_build(lmp);
  if (got.empty()) return;
  char text[400];
  snprintf(text, sizeof(text),
           "libspherocylinder: host program must be LIGGGHTS %s as Debian builds it (got: %s)",
           spherocylinder::kHostVersion, got.c_str());
  lmp->error->all(FLERR, text);
}

// Error::one prints and calls MPI_Abort, which flushes nothing: line by line, so that its sentence
// also reaches a file or a pipe.
void flush_every_line(LAMMPS_NS::LAMMPS *lmp)
{
  if (lmp->screen) setvbuf(lmp->screen, nullptr, _IOLBF, 0);
  if (lmp->logfile) setvbuf(lmp->logfile, nullptr, _IOLBF, 0);
}

// A file that has grown past the limit of the shell is one that is cut, not the end of the process in silence.
void watch_files()
{
  signal(SIGXFSZ, SIG_IGN);
  spherocylinder::look_at_files_at_exit();
}

void end_if_a_file_is_cut(LAMMPS_NS::LAMMPS *lmp)
{
  const std::string cut = spherocylinder::next_cut_file();
  if (cut.empty()) return;
  if (ferror(stdout) || (lmp->screen && ferror(lmp->screen)))
    fprintf(stderr, "ERROR: %s\n", cut.c_str());
  rod_error_one(lmp, "%s", cut.c_str());
}

void print_banner_once(LAMMPS_NS::LAMMPS *lmp)
{
  static bool printed = false;
  if (printed || lmp->universe->me != 0) return;
  printed = true;
  if (lmp->universe->uscreen) fputs(spherocylinder::banner(), lmp->universe->uscreen);
  if (lmp->universe->ulogfile) fputs(spherocylinder::banner(), lmp->universe->ulogfile);
}

}  // namespace

namespace LAMMPS_NS {

EXPORT void LAMMPS::post_create()
{
  using PostCreate = void (*)(LAMMPS *);
  static const auto original = next_symbol<PostCreate>("_ZN9LAMMPS_NS6LAMMPS11post_createEv");
  original(this);
  check_host(this);
  flush_every_line(this);
  watch_files();
  spherocylinder::add_styles(this);
  print_banner_once(this);
}

// The first call, for style `atomic`, comes while the LAMMPS object is still being built: only the
// name may be looked at.
EXPORT AtomVec *Atom::new_avec(const char *style, char *suffix, int &sflag)
{
  using NewAvec = AtomVec *(*) (Atom *, const char *, char *, int &);
  static const auto original = next_symbol<NewAvec>("_ZN9LAMMPS_NS4Atom8new_avecEPKcPcRi");
  if (AtomVec *ours = spherocylinder::create_atom_style(style, lmp)) {
    sflag = 0;
    return ours;
  }
  return original(this, style, suffix, sflag);
}

EXPORT int Input::execute_command()
{
  using ExecuteCommand = int (*)(Input *);
  static const auto original =
      next_symbol<ExecuteCommand>("_ZN9LAMMPS_NS5Input15execute_commandEv");
  LAMMPS *const lammps = lmp;
  spherocylinder::check_command_before(lammps, command, narg, arg);
  const bool reads_restart = strcmp(command, "read_restart") == 0;
  std::vector<std::string> lines;
  if (reads_restart)
    lines = spherocylinder::check_restart_before_it_is_read(lammps, narg, arg);
  else
    spherocylinder::keep_models(lammps, command, narg, arg);
  const int unknown = [&] {
    const spherocylinder::FilesAppearWhole whole(strncmp(command, "write_", 6) == 0);
    return original(this);
  }();
  if (reads_restart) spherocylinder::restart_was_read(lammps, lines);
  if (strcmp(command, "write_data") == 0) spherocylinder::say_what_a_data_file_lacks(lammps);
  spherocylinder::check_command_after(lammps);
  end_if_a_file_is_cut(lammps);
  return unknown;
}

EXPORT void LAMMPS::init()
{
  using Init = void (*)(LAMMPS *);
  static const auto original = next_symbol<Init>("_ZN9LAMMPS_NS6LAMMPS4initEv");
  spherocylinder::check_styles_at_run_start(this);
  if (update->whichflag == 1) {
    spherocylinder::say_which_models_differ(this);
    spherocylinder::look_at_restarted_rods(this);
  }
  original(this);
}

// Also within a run, by the command `restart`.
EXPORT void WriteRestart::write(char *file)
{
  using Write = void (*)(WriteRestart *, char *);
  static const auto original = next_symbol<Write>("_ZN9LAMMPS_NS12WriteRestart5writeEPc");
  spherocylinder::write_whole_restart(lmp, file,
                                      [this](std::string name) { original(this, name.data()); });
}

EXPORT void Output::setup(int memory)
{
  using Setup = void (*)(Output *, int);
  static const auto original = next_symbol<Setup>("_ZN9LAMMPS_NS6Output5setupEi");
  {
    const spherocylinder::FilesAppearWhole frames;
    original(this, memory);
  }
  spherocylinder::go_on_with_forces(lmp);
  spherocylinder::go_on_with_random_numbers(lmp);
  end_if_a_file_is_cut(lmp);
}

EXPORT void Output::write(bigint step)
{
  using Write = void (*)(Output *, bigint);
  static const auto original = next_symbol<Write>("_ZN9LAMMPS_NS6Output5writeEl");
  {
    const spherocylinder::FilesAppearWhole frames;
    original(this, step);
  }
  end_if_a_file_is_cut(lmp);
}

// `run ... post no` asks for the loop time alone, flag 0.
EXPORT void Finish::end(int flag)
{
  using End = void (*)(Finish *, int);
  static const auto original = next_symbol<End>("_ZN9LAMMPS_NS6Finish3endEi");
  original(this, flag);
  if (flag) report_rod_pairs(lmp);
}

}  // namespace LAMMPS_NS
