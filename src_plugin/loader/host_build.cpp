// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/host_build.h"

#include <cstdio>
#include <cstring>

#include <dlfcn.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace spherocylinder {

namespace {

// A function that the host must or must not have; its mangled name carries the types.
struct Mark {
  const char *symbol;
  bool wanted;
  const char *otherwise;
};

constexpr Mark kMarks[] = {
    {"_ZN9LAMMPS_NS19AtomVecSuperquadricC1EPNS_6LAMMPSE", false, "it is built with superquadrics"},
    {"_ZN9LAMMPS_NS17AtomVecConvexHullC1EPNS_6LAMMPSE", false, "it is built with convex hulls"},
    {"_ZN9LAMMPS_NS6Output5writeEl", true, "its time steps have not 64 bits (LAMMPS_SMALLSMALL)"},
    {"_ZN9LAMMPS_NS13AtomVecAtomic9data_atomEPdiPPc", true,
     "its ids have not 32 bits (LAMMPS_BIGBIG)"},
    {"_ZN9LAMMPS_NS6LAMMPSC1EiPPcP19ompi_communicator_t", true, "it is not built with Open MPI"},
};

// A number that a new object holds, at the place where this plug-in's headers put it.
struct Member {
  const char *name;
  long seen, wanted;
};

}  // namespace

std::string foreign_build(LAMMPS *lmp)
{
  for (const Mark &mark : kMarks)
    if ((dlsym(RTLD_DEFAULT, mark.symbol) != nullptr) != mark.wanted) return mark.otherwise;

  int ranks = 0;
  MPI_Comm_size(lmp->world, &ranks);
  const Member members[] = {
      {"Atom::ntypes", lmp->atom->ntypes, 0},
      {"Atom::sortfreq", lmp->atom->sortfreq, 1000},
      {"Comm::nprocs", lmp->comm->nprocs, ranks},
      {"Domain::dimension", lmp->domain->dimension, 3},
      {"Domain::box_exist", lmp->domain->box_exist, 0},
      {"Force::newton_pair", lmp->force->newton_pair, 1},
      {"Modify::nfix", lmp->modify->nfix, 0},
      {"Neighbor::every", lmp->neighbor->every, 1},
      {"Neighbor::delay", lmp->neighbor->delay, 10},
      {"Neighbor::oneatom", lmp->neighbor->oneatom, 2000},
      {"Output::ndump", lmp->output->ndump, 0},
      {"Update::ntimestep", static_cast<long>(lmp->update->ntimestep), 0},
  };
  for (const Member &member : members) {
    if (member.seen == member.wanted) continue;
    char text[200];
    snprintf(text, sizeof(text), "its classes are laid out otherwise (%s is %ld where %ld stands)",
             member.name, member.seen, member.wanted);
    return text;
  }
  return "";
}

}  // namespace spherocylinder
