// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/read_data_spherocylinder.h"

#include <cstdio>
#include <cstring>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "host/rod_error.h"
#include "read_data.h"
#include "styles/fibre_chains.h"
#include "styles/fix_fibres_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

bool ends_with(const std::string &text, const std::string &end)
{
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

void ReadDataSpherocylinder::command(int narg, char **arg)
{
  if (narg > 0) {
    std::string file = arg[0];
    const size_t star = file.find('*');
    if (narg == 2 && star != std::string::npos)
      file.replace(star, 1, std::to_string(update->ntimestep));
    DataFileVerdict verdict;
    if (comm->me == 0) verdict = look_through(file, narg, arg);
    std::string &fault = verdict.fault;
    int size = static_cast<int>(fault.size()), has_fibres = verdict.has_fibres;
    MPI_Bcast(&size, 1, MPI_INT, 0, world);
    MPI_Bcast(&has_fibres, 1, MPI_INT, 0, world);
    fault.resize(size);
    MPI_Bcast(fault.data(), size, MPI_CHAR, 0, world);
    if (size > 0)
      rod_error_all(lmp, "Command read_data: data file %s, %s", file.c_str(), fault.c_str());
    if (has_fibres) return read_with_fibres(narg, arg);
  }
  ReadData(lmp).command(narg, arg);
}

// LIGGGHTS lets a fix read a section. Segments meet to within what printing six digits of centre and
// axis costs.
void ReadDataSpherocylinder::read_with_fibres(int narg, char **arg)
{
  constexpr double kMeet = 1e-3;
  if (domain->box_exist)
    rod_error_all(lmp, "Command read_data: a data file with a section Fibres makes the simulation "
                       "box; there is one already");
  fibres_of(lmp);
  std::string words[] = {"fix", FixFibresSpherocylinder::kId, FixFibresSpherocylinder::kHeader,
                         FixFibresSpherocylinder::kSection};
  std::vector<char *> args(arg, arg + narg);
  for (std::string &word : words) args.push_back(word.data());
  ReadData(lmp).command(static_cast<int>(args.size()), args.data());
  const int joints = FibreChains(lmp, "Command read_data").join_places(kMeet);
  if (comm->me != 0 || joints == 0) return;
  for (FILE *out : {screen, logfile})
    if (out) fprintf(out, "  %d joints of fibres\n", joints);
}

// None, too, if the file cannot be opened: LIGGGHTS says so.
DataFileVerdict ReadDataSpherocylinder::look_through(const std::string &file, int narg,
                                                     char **arg) const
{
  DataFileSurroundings surroundings;
  surroundings.adds = narg == 2 && strcmp(arg[1], "add") == 0;
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int d = 0; d < 3; d++) {
    // In a triclinic box a rod's place is not within lo and hi.
    surroundings.periodic[d] = periodic[d] || domain->triclinic;
    if (!surroundings.adds) continue;
    surroundings.lo[d] = domain->boxlo[d];
    surroundings.hi[d] = domain->boxhi[d];
  }
  if (surroundings.adds) surroundings.types = atom->ntypes;
  for (int k = 1; k + 3 < narg; k += 4) {
    if (strcmp(arg[k], "fix") != 0) break;
    if (strcmp(arg[k + 2], "NULL") != 0) surroundings.fix_headers.push_back(arg[k + 2]);
    surroundings.fix_sections.push_back(arg[k + 3]);
  }

  const bool is_compressed = ends_with(file, ".gz");
  FILE *stream =
      is_compressed ? popen(("gunzip -c '" + file + "'").c_str(), "r") : fopen(file.c_str(), "r");
  if (!stream) return {};
  DataFileVerdict verdict = look_through_data_file(stream, surroundings);
  if (is_compressed)
    pclose(stream);
  else
    fclose(stream);
  return verdict;
}
