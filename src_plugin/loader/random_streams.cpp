// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/random_streams.h"

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <sstream>

#include <mpi.h>

#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "fix_mesh_surface.h"
#include "host/private_members.h"
#include "lammps.h"
#include "modify.h"
#include "region.h"
#include "styles/fix_insert_spherocylinder.h"

using namespace LAMMPS_NS;

namespace spherocylinder {

namespace {

constexpr char kRandom[] = "random ";

struct Named {
  std::string name;
  RanPark *stream;
};

std::vector<Named> streams_of(LAMMPS *lmp)
{
  std::vector<Named> streams;
  for (int i = 0; i < lmp->modify->nfix; i++) {
    Fix &fix = *lmp->modify->fix[i];
    int number = 0;
    for (RanPark *stream : random_streams(fix))
      streams.push_back({std::string("fix ") + fix.id + " " + std::to_string(++number), stream});
    if (auto *mesh = dynamic_cast<FixMeshSurface *>(&fix))
      streams.push_back({std::string("mesh ") + fix.id + " 1", random_stream(*mesh->triMesh())});
  }
  for (int i = 0; i < lmp->domain->nregion; i++)
    streams.push_back({std::string("region ") + lmp->domain->regions[i]->id + " 1",
                       random_stream(*lmp->domain->regions[i])});
  return streams;
}

std::string text_of(const RandomState &state)
{
  char text[64];
  snprintf(text, sizeof(text), " %d %d %a", state.seed, state.keeps_one,
           state.keeps_one ? state.kept : 0.0);
  return text;
}

}  // namespace

bool is_random_line(const std::string &line) { return line.rfind(kRandom, 0) == 0; }

std::vector<std::string> random_lines(LAMMPS *lmp)
{
  bool inserts = false;
  for (int i = 0; i < lmp->modify->nfix; i++)
    inserts = inserts || strncmp(lmp->modify->fix[i]->style, "insert/", 7) == 0;
  std::vector<std::string> lines;
  if (!inserts) return lines;
  for (const Named &named : streams_of(lmp)) {
    const RandomState mine = random_state(*named.stream);
    std::vector<RandomState> all(lmp->comm->nprocs);
    MPI_Allgather(&mine, sizeof(mine), MPI_BYTE, all.data(), sizeof(mine), MPI_BYTE, lmp->world);
    std::string line = kRandom + named.name;
    for (const RandomState &state : all) line += text_of(state);
    lines.push_back(line);
  }
  return lines;
}

void set_random_streams(LAMMPS *lmp, const std::vector<std::string> &lines)
{
  for (int i = 0; i < lmp->modify->nfix; i++)
    if (auto *stream = dynamic_cast<FixInsertStreamSpherocylinder *>(lmp->modify->fix[i]))
      stream->find_out_share();  // before it goes on
  const std::vector<Named> streams = streams_of(lmp);
  for (const std::string &line : lines) {
    std::istringstream words(line);
    std::string kind, id, number, kept;
    words >> kind >> kind >> id >> number;
    std::vector<RandomState> states;
    for (RandomState state; words >> state.seed >> state.keeps_one >> kept;) {
      state.kept = strtod(kept.c_str(), nullptr);
      states.push_back(state);
    }
    if (static_cast<int>(states.size()) != lmp->comm->nprocs) continue;
    for (const Named &named : streams)
      if (named.name == kind + " " + id + " " + number)
        set_random_state(*named.stream, states[lmp->comm->me]);
  }
}

}  // namespace spherocylinder
