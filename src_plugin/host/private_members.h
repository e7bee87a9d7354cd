// SPDX-License-Identifier: GPL-2.0-or-later
// What LIGGGHTS's classes keep to themselves and rods need, all of it, each by a function.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class Atom;
class Comm;
class Compute;
class Dump;
class Fix;
class FixWallGran;
class Input;
class LAMMPS;
class Modify;
class Neighbor;
class PairGran;
class PrimitiveWall;
class RanPark;
class Region;
class TriMesh;

// The styles that a deck can name, and who makes them.
using FixCreator = Fix *(*) (LAMMPS *, int, char **);
using ComputeCreator = Compute *(*) (LAMMPS *, int, int, char **);
using CommandCreator = void (*)(LAMMPS *, int, char **);
std::map<std::string, FixCreator> &fix_styles(Modify &modify);
std::map<std::string, ComputeCreator> &compute_styles(Modify &modify);
std::map<std::string, CommandCreator> &command_styles(Input &input);

// `communicate group`: 0 is all.
int ghost_group(const Comm &comm);

// One of the messages by which LIGGGHTS brings ghosts up to date, of `ghost_swaps()` that it sends and
// receives one after the other, to itself where a rank is its own neighbour.
struct GhostSwap {
  int to_rank;
  int sent, received;  // ghosts
  const int *list;     // rods and ghosts that are sent
  int first;           // of the ghosts that are received
  const int *periods;  // between the owner and the ghost, in x, y and z; null where there are none
};
int ghost_swaps(const Comm &comm);
GhostSwap ghost_swap(const Comm &comm, int number);

// `dump_modify format`, nullptr if there was none, and how many columns the dump has.
const char *dump_format(const Dump &dump);
int dump_columns(const Dump &dump);

// A plane's position, a cylinder's radius and axis.
double *wall_parameters(PrimitiveWall &wall);

// The area that all contacts of a wall conduct heat through, where the deck gives one: `contact_area constant`.
double &given_contact_area(FixWallGran &wall);

// The cosine of the angle up to which the mesh's faces make one smooth surface: keyword curvature.
double cosine_of_curvature(const TriMesh &mesh);

// The random numbers that insertion draws: a fix's of its own, none of other fixes; a region's; and a mesh's.
std::vector<RanPark *> random_streams(Fix &fix);
RanPark *random_stream(Region &region);
RanPark *random_stream(TriMesh &mesh);

// Where such a stream is. Of numbers with a normal distribution it makes two at a time and keeps one.
struct RandomState {
  int seed, keeps_one;
  double kept;
};
RandomState random_state(RanPark &stream);
void set_random_state(RanPark &stream, const RandomState &state);

// Where a pair's contact history keeps a value, -1 if it does not: the stock models do not all tell.
int history_value(PairGran &pair, const std::string &name);

// `neigh_modify exclude`: whether the deck has any, and whether it takes out the pair i, j.
bool has_exclusions(const Neighbor &neighbor);
bool is_excluded(const Neighbor &neighbor, const Atom &atom, int i, int j);

}  // namespace LAMMPS_NS
