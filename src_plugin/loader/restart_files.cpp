// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/restart_files.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>
#include <system_error>

#include <dlfcn.h>
#include <mpi.h>
#include <unistd.h>

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "force.h"
#include "host/closing_mark.h"
#include "host/restart_header.h"
#include "host/rod_error.h"
#include "host/written_files.h"
#include "lammps.h"
#include "loader/random_streams.h"
#include "modify.h"
#include "pair_gran.h"
#include "read_restart.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/kept_forces.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace spherocylinder {

namespace {

constexpr char kPlugin[] = "spherocylinder ";
constexpr char kPart[] = "part ";
constexpr char kPair[] = "pair_style ";
constexpr char kWall[] = "wall ";
constexpr char kPhysics[] = "physics ";

bool starts_with(const std::string &text, const std::string &start)
{
  return text.compare(0, start.size(), start) == 0;
}

// The deck's words about contacts, and those of the restart file until a run begins. Attached to the rods.
struct Models {
  explicit Models(LAMMPS *) {}
  std::string pair;
  std::map<std::string, std::string> walls;  // by id, of those too that are gone
  std::map<std::string, std::string> fixes;  // all of each command, the same
  std::string coefficients;                  // of pair_coeff
  std::vector<std::string> restarted, random;
  std::string physics;  // of the restart file
};

Models *models_of(LAMMPS *lmp)
{
  auto *rods = dynamic_cast<AtomVecSpherocylinder *>(lmp->atom->avec);
  return rods ? &rods->attached<Models>() : nullptr;
}

std::string joined(int first, int narg, char **arg)
{
  std::string text;
  for (int k = first; k < narg; k++) text += (k > first ? " " : "") + std::string(arg[k]);
  return text;
}

// A wall's models and shape, without the numbers that say where it is.
std::string wall_models(int narg, char **arg)
{
  int end = 3;
  while (end < narg && strcmp(arg[end], "primitive") != 0 && strcmp(arg[end], "mesh") != 0) end++;
  std::string shape;
  if (end + 3 < narg && strcmp(arg[end], "primitive") == 0)
    shape = std::string(" primitive ") + arg[end + 3];
  else if (end < narg)
    shape = std::string(" ") + arg[end];
  return joined(3, end, arg) + shape;
}

std::vector<std::string> lines_of(const Models &models, const LAMMPS *lmp)
{
  std::vector<std::string> lines;
  if (lmp->force->pair && !models.pair.empty()) lines.push_back(kPair + models.pair);
  for (const auto &[id, words] : models.walls)
    if (lmp->modify->find_fix(id.c_str()) >= 0) lines.push_back(kWall + id + ": " + words);
  return lines;
}

// What forces follow from, in eight digits.
std::string physics_of(const Models &models, const LAMMPS *lmp)
{
  std::string text = models.pair + "\n" + models.coefficients;
  for (int i = 0; i < lmp->modify->nfix; i++) {
    const auto words = models.fixes.find(lmp->modify->fix[i]->id);
    if (words != models.fixes.end()) text += "\n" + words->second;
  }
  text += "\n" + std::to_string(lmp->force->newton_pair);
  char digits[64];
  snprintf(digits, sizeof(digits), "%s%08lx dt %a", kPhysics, check_sum_of(text), lmp->update->dt);
  return digits;
}

// The text of the lowest rank that has one, on all ranks, which must all call it.
std::string told_by_any(LAMMPS *lmp, const std::string &mine)
{
  int rank, first, length = static_cast<int>(mine.size());
  MPI_Comm_rank(lmp->world, &rank);
  const int candidate = mine.empty() ? INT_MAX : rank;
  MPI_Allreduce(&candidate, &first, 1, MPI_INT, MPI_MIN, lmp->world);
  if (first == INT_MAX) return {};
  MPI_Bcast(&length, 1, MPI_INT, first, lmp->world);
  std::string text = mine;
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, first, lmp->world);
  return text;
}

bool has_parts(const std::string &name) { return name.find('%') != std::string::npos; }

std::string part_name(const std::string &name, const std::string &part)
{
  const size_t place = name.find('%');
  return place == std::string::npos ? name : name.substr(0, place) + part + name.substr(place + 1);
}

// Where a link leads.
std::string real_place(const std::string &name)
{
  std::error_code failed;
  if (!std::filesystem::is_symlink(name, failed)) return name;
  return std::filesystem::weakly_canonical(name, failed).string();
}

std::string cannot_write(const std::string &name, const std::string &reason)
{
  return "Restart file " + name + " cannot be written whole: " + reason +
         " (wanted a disk that takes all of it)";
}

// Before LIGGGHTS opens it, whose sentence would name the file beside.
std::string fault_of_opening(const std::string &name, const std::string &beside_it)
{
  FILE *file = fopen(beside_it.c_str(), "wb");
  if (!file) return cannot_write(name, strerror(errno));
  fclose(file);
  return {};
}

std::string fault_of_closing(const std::string &name, const std::string &beside_it,
                             const std::vector<std::string> &lines, std::string &check)
{
  const std::string cut = was_cut(beside_it);
  if (!cut.empty()) return cannot_write(name, cut);
  const std::string fault = close_with_mark(beside_it, lines, check);
  return fault.empty() ? "" : cannot_write(name, fault);
}

std::string fault_of_renaming(const std::string &name, const std::string &beside_it)
{
  std::error_code failed;
  const std::string target = real_place(name);
  std::filesystem::rename(beside_it, target, failed);
  return failed ? cannot_write(name, failed.message()) : "";
}

// The eight digits of each rank's file, on all ranks.
std::vector<std::string> checks_of_all(LAMMPS *lmp, const std::string &mine)
{
  std::vector<char> all(8 * static_cast<size_t>(lmp->comm->nprocs));
  std::string sent = mine;
  sent.resize(8, '0');
  MPI_Allgather(sent.data(), 8, MPI_CHAR, all.data(), 8, MPI_CHAR, lmp->world);
  std::vector<std::string> checks;
  for (int rank = 0; rank < lmp->comm->nprocs; rank++)
    checks.emplace_back(&all[8 * static_cast<size_t>(rank)], 8);
  return checks;
}

}  // namespace

// One file by rank 0, or with % one by each rank and a base by rank 0, which goes to its place last and knows
// the others' check sums: files of two steps do not pass for one restart.
void write_whole_restart(LAMMPS *lmp, const std::string &name,
                         const std::function<void(const std::string &)> &write)
{
  const bool parts = has_parts(name);
  const bool has_base = lmp->comm->me == 0;
  const std::string base = part_name(name, "base");
  const std::string part = part_name(name, std::to_string(lmp->comm->me));
  int in_place = is_plain_file(real_place(base));
  MPI_Bcast(&in_place, 1, MPI_INT, 0, lmp->world);
  if (!in_place) return write(name);

  const auto end_if = [&](const std::string &mine) {
    const std::string fault = told_by_any(lmp, mine);
    if (fault.empty()) return;
    if (has_base) remove(beside(base).c_str());
    if (parts) remove(beside(part).c_str());
    rod_error_all(lmp, "%s", fault.c_str());
  };
  std::string fault;
  if (has_base) fault = fault_of_opening(base, beside(base));
  if (parts && fault.empty()) fault = fault_of_opening(part, beside(part));
  end_if(fault);
  {
    const FilesAppearWhole off(false);
    write(beside(name));
  }

  const std::string version = kPlugin + std::string(SPHEROCYLINDER_VERSION) + " step " +
                              std::to_string(lmp->update->ntimestep);
  std::string check;
  if (parts) {
    end_if(fault_of_closing(part, beside(part), {version, kPart + std::to_string(lmp->comm->me)},
                            check));
  }
  std::vector<std::string> lines = {version};
  if (parts)
    for (const std::string &of_part : checks_of_all(lmp, check)) lines.push_back(kPart + of_part);
  if (const Models *models = models_of(lmp))
    for (const std::string &line : lines_of(*models, lmp)) lines.push_back(line);
  if (const Models *models = models_of(lmp)) lines.push_back(physics_of(*models, lmp));
  for (const std::string &line : random_lines(lmp)) lines.push_back(line);
  end_if(has_base ? fault_of_closing(base, beside(base), lines, check) : "");

  if (parts) end_if(fault_of_renaming(part, beside(part)));
  end_if(has_base ? fault_of_renaming(base, beside(base)) : "");
}

namespace {

// As read_restart finds the newest file of a pattern with *. Called by rank 0.
std::string newest_of(LAMMPS *lmp, const std::string &pattern)
{
  using FileSearch = void (*)(ReadRestart *, char *, char *);
  static const auto search = reinterpret_cast<FileSearch>(
      dlsym(RTLD_DEFAULT, "_ZN9LAMMPS_NS11ReadRestart11file_searchEPcS1_"));
  std::string name = pattern;
  std::vector<char> found(pattern.size() + 32);
  ReadRestart reader(lmp);
  search(&reader, name.data(), found.data());
  return found.data();
}

std::string refused(const std::string &name, const std::string &reason)
{
  return "Restart file " + name + " is not whole: " + reason +
         " (wanted a file as write_restart left it)";
}

// Of one file. Of an old one without a mark, or one of LIGGGHTS alone, the header must do: of no rods, or where
// the deck says so.
std::string fault_of_reading(const std::string &name, bool unchecked, MarkedFile &file)
{
  if (access(name.c_str(), R_OK) != 0)
    return "Restart file " + name + " cannot be read: " + strerror(errno);
  file = read_marked_file(name);
  if (file.has_mark) return file.fault.empty() ? "" : refused(name, file.fault);
  const RestartHeader header = read_restart_header(name);
  if (!header.fault.empty()) return refused(name, header.fault);
  if (unchecked || header.atom_style != "spherocylinder") return {};
  return refused(name, file.fault +
                           ", it was cut short or an older plug-in wrote it, which read_restart "
                           "FILE unchecked reads as it is");
}

std::string fault_of_part(const std::string &name, const std::string &wanted, int number)
{
  const MarkedFile file = read_marked_file(name);
  if (!file.fault.empty()) return refused(name, file.fault);
  if (file.check != wanted || file.lines.size() < 2 ||
      file.lines[1] != kPart + std::to_string(number))
    return refused(name, "it is of another step or run than its base");
  return {};
}

std::string all_lines(const std::vector<std::string> &lines)
{
  std::string text;
  for (const std::string &line : lines) text += line + "\n";
  return text;
}

}  // namespace

std::vector<std::string> check_restart_before_it_is_read(LAMMPS *lmp, int &narg, char **arg)
{
  const bool unchecked = narg == 2 && strcmp(arg[1], "unchecked") == 0;
  if (unchecked) narg = 1;
  if (narg != 1) return {};  // LIGGGHTS says what is wrong

  std::string name = arg[0], fault;
  MarkedFile base;
  if (lmp->comm->me == 0) {
    if (name.find('*') != std::string::npos) name = newest_of(lmp, name);
    fault = fault_of_reading(part_name(name, "base"), unchecked, base);
  }
  fault = told_by_any(lmp, fault);
  if (!fault.empty()) rod_error_all(lmp, "%s", fault.c_str());
  name = told_by_any(lmp, lmp->comm->me == 0 ? name : "");
  std::istringstream text(
      told_by_any(lmp, lmp->comm->me == 0 ? all_lines(base.lines) : std::string()));
  std::vector<std::string> lines, checks;
  for (std::string line; std::getline(text, line);)
    if (starts_with(line, kPart))
      checks.push_back(line.substr(strlen(kPart)));
    else
      lines.push_back(line);

  for (size_t k = lmp->comm->me; k < checks.size() && fault.empty(); k += lmp->comm->nprocs)
    fault = fault_of_part(part_name(name, std::to_string(k)), checks[k], static_cast<int>(k));
  fault = told_by_any(lmp, fault);
  if (!fault.empty()) rod_error_all(lmp, "%s", fault.c_str());
  return lines;
}

void restart_was_read(LAMMPS *lmp, const std::vector<std::string> &lines)
{
  Models *models = models_of(lmp);
  if (!models || lines.empty()) return;
  for (size_t k = 1; k < lines.size(); k++)
    if (starts_with(lines[k], kPhysics))
      models->physics = lines[k];
    else
      (is_random_line(lines[k]) ? models->random : models->restarted).push_back(lines[k]);
  std::istringstream first(lines[0]);
  std::string plugin, version;
  first >> plugin >> version;
  if (version != SPHEROCYLINDER_VERSION && lmp->comm->me == 0)
    rod_warning(
        lmp, "Command read_restart: the file was written by version %s of the plug-in (this is %s)",
        version.c_str(), SPHEROCYLINDER_VERSION);
}

void say_what_a_data_file_lacks(LAMMPS *lmp)
{
  if (!models_of(lmp) || lmp->comm->me != 0) return;
  auto *pair = dynamic_cast<PairGran *>(lmp->force->pair);
  if (!pair || pair->dnum() == 0) return;
  for (FILE *out : {lmp->screen, lmp->logfile})
    if (out)
      fputs("Contact histories are not in data files, contacts begin anew when one is read; "
            "write_restart keeps them\n",
            out);
}

void keep_models(LAMMPS *lmp, const char *command, int narg, char **arg)
{
  Models *models = models_of(lmp);
  if (!models) return;
  if (strcmp(command, "pair_coeff") == 0) models->coefficients = joined(0, narg, arg);
  if (strcmp(command, "fix") == 0 && narg > 2) models->fixes[arg[0]] = joined(0, narg, arg);
  const bool is_pair = strcmp(command, "pair_style") == 0 && narg > 0;
  const bool is_wall =
      strcmp(command, "fix") == 0 && narg > 2 && strncmp(arg[2], "wall/gran", 9) == 0;
  if (!is_pair && !is_wall) return;
  if (is_pair)
    models->pair = joined(0, narg, arg);
  else
    models->walls[arg[0]] = wall_models(narg, arg);
}

void say_which_models_differ(LAMMPS *lmp)
{
  Models *models = models_of(lmp);
  if (!models || models->restarted.empty()) return;
  const std::vector<std::string> then = std::move(models->restarted);
  const std::vector<std::string> now = lines_of(*models, lmp);
  models->restarted.clear();
  if (lmp->comm->me != 0) return;
  const auto told = [](const std::vector<std::string> &lines,
                       const std::vector<std::string> &others) {
    std::string text;
    for (const std::string &line : lines)
      if (std::find(others.begin(), others.end(), line) == others.end())
        text += (text.empty() ? "" : "; ") + line;
    return text.empty() ? std::string("nothing else") : text;
  };
  if (then != now)
    rod_warning(lmp,
                "Command read_restart: contact models or walls are others than the file's (in the "
                "file: %s; now: %s)",
                told(then, now).c_str(), told(now, then).c_str());
}

void look_at_restarted_rods(LAMMPS *lmp)
{
  const Models *models = models_of(lmp);
  if (models && !models->physics.empty())
    rods_of(lmp, "Command read_restart").attached<KeptForces>().look_at_rods();
}

void go_on_with_forces(LAMMPS *lmp)
{
  Models *models = models_of(lmp);
  if (!models || models->physics.empty()) return;
  rods_of(lmp, "Command read_restart")
      .attached<KeptForces>()
      .use(models->physics == physics_of(*models, lmp));
  models->physics.clear();
}

void go_on_with_random_numbers(LAMMPS *lmp)
{
  Models *models = models_of(lmp);
  if (!models || models->random.empty()) return;
  set_random_streams(lmp, models->random);
  models->random.clear();
}

}  // namespace spherocylinder
