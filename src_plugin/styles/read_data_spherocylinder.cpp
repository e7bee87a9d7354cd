// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/read_data_spherocylinder.h"

#include <cstdio>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "host/rod_error.h"
#include "read_data.h"
#include "styles/data_file_check.h"
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
    std::string fault;
    if (comm->me == 0) fault = fault_of(file, narg, arg);
    int size = static_cast<int>(fault.size());
    MPI_Bcast(&size, 1, MPI_INT, 0, world);
    fault.resize(size);
    MPI_Bcast(fault.data(), size, MPI_CHAR, 0, world);
    if (size > 0)
      rod_error_all(lmp, "Command read_data: data file %s, %s", file.c_str(), fault.c_str());
  }
  ReadData(lmp).command(narg, arg);
}

// Empty, too, if the file cannot be opened: LIGGGHTS says so.
std::string ReadDataSpherocylinder::fault_of(const std::string &file, int narg, char **arg) const
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
  if (!stream) return "";
  std::string fault = fault_of_data_file(stream, surroundings);
  if (is_compressed)
    pclose(stream);
  else
    fclose(stream);
  return fault;
}
