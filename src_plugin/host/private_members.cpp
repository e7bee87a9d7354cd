// SPDX-License-Identifier: GPL-2.0-or-later
// C++ does not check access on the arguments of an explicit template instantiation
// ([temp.explicit]/13), so that a private member's pointer can be handed to a friend function there.
// Protected members are named from a class derived for it.
#include "host/private_members.h"

#include "atom.h"
#include "comm.h"
#include "dump.h"
#include "fix_insert.h"
#include "fix_particledistribution_discrete.h"
#include "fix_template_sphere.h"
#include "fix_wall_gran.h"
#include "input.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_gran.h"
#include "primitive_wall.h"
#include "random_park.h"
#include "region.h"
#include "tri_mesh.h"

namespace LAMMPS_NS {

// Not in an unnamed namespace: the friend is looked up beside its tag.
template <typename Tag, typename Tag::type Member>
struct ExposeMember {
  friend typename Tag::type member(Tag) { return Member; }
};

#define EXPOSE_MEMBER(Tag, Class, name, ...) \
  struct Tag {                               \
    using type = __VA_ARGS__ Class::*;       \
    friend type member(Tag);                 \
  };                                         \
  template struct ExposeMember<Tag, &Class::name>;

EXPOSE_MEMBER(FixMap, Modify, fix_map, std::map<std::string, FixCreator> *)
EXPOSE_MEMBER(ComputeMap, Modify, compute_map, std::map<std::string, ComputeCreator> *)
EXPOSE_MEMBER(CommandMap, Input, command_map, std::map<std::string, CommandCreator> *)
EXPOSE_MEMBER(GhostGroup, Comm, bordergroup, int)
EXPOSE_MEMBER(DumpFormat, Dump, format_user, char *)
EXPOSE_MEMBER(DumpColumns, Dump, size_one, int)
EXPOSE_MEMBER(WallParameters, PrimitiveWall, param, double *)
EXPOSE_MEMBER(WallContactArea, FixWallGran, fixed_contact_area_, double)

EXPOSE_MEMBER(MeshCurvature, SurfaceMeshBase, curvature_, double)

EXPOSE_MEMBER(InsertionStream, FixInsert, random, RanPark *)
EXPOSE_MEMBER(DistributionStream, FixParticledistributionDiscrete, random, RanPark *)
EXPOSE_MEMBER(TemplateStream, FixTemplateSphere, random_insertion, RanPark *)
EXPOSE_MEMBER(TemplateVolumeStream, FixTemplateSphere, random_mc, RanPark *)
EXPOSE_MEMBER(RegionStream, Region, random, RanPark *)
EXPOSE_MEMBER(MeshStream, MultiNodeMesh<3>, random_, RanPark *)
EXPOSE_MEMBER(StreamKeepsOne, RanPark, save, int)
EXPOSE_MEMBER(StreamKept, RanPark, second, double)

#undef EXPOSE_MEMBER

namespace {

struct PairAccess : PairGran {
  static const std::vector<HistoryArg> &history(PairGran &pair)
  {
    return pair.*(&PairAccess::history_arg);
  }
};

struct CommAccess : Comm {
  static int swaps(const Comm &comm) { return comm.*(&CommAccess::nswap); }
  static GhostSwap swap(const Comm &comm, int k)
  {
    return {(comm.*(&CommAccess::sendproc))[k],
            (comm.*(&CommAccess::sendnum))[k],
            (comm.*(&CommAccess::recvnum))[k],
            (comm.*(&CommAccess::sendlist))[k],
            (comm.*(&CommAccess::firstrecv))[k],
            (comm.*(&CommAccess::pbc_flag))[k] ? (comm.*(&CommAccess::pbc))[k] : nullptr};
  }
};

struct Exclusion : Neighbor {
  static bool any(const Neighbor &neighbor) { return neighbor.*(&Exclusion::exclude) != 0; }
  static bool of(const Neighbor &neighbor, int i, int j, const Atom &atom)
  {
    return (neighbor.*(&Exclusion::exclusion))(i, j, atom.type[i], atom.type[j], atom.mask,
                                               atom.molecule) != 0;
  }
};

}  // namespace

std::map<std::string, FixCreator> &fix_styles(Modify &modify)
{
  return *(modify.*member(FixMap()));
}

std::map<std::string, ComputeCreator> &compute_styles(Modify &modify)
{
  return *(modify.*member(ComputeMap()));
}

std::map<std::string, CommandCreator> &command_styles(Input &input)
{
  return *(input.*member(CommandMap()));
}

int ghost_group(const Comm &comm) { return comm.*member(GhostGroup()); }

int ghost_swaps(const Comm &comm) { return CommAccess::swaps(comm); }

GhostSwap ghost_swap(const Comm &comm, int number) { return CommAccess::swap(comm, number); }

const char *dump_format(const Dump &dump) { return dump.*member(DumpFormat()); }

int dump_columns(const Dump &dump) { return dump.*member(DumpColumns()); }

double *wall_parameters(PrimitiveWall &wall) { return wall.*member(WallParameters()); }

double &given_contact_area(FixWallGran &wall) { return wall.*member(WallContactArea()); }

double cosine_of_curvature(const TriMesh &mesh) { return mesh.*member(MeshCurvature()); }

std::vector<RanPark *> random_streams(Fix &fix)
{
  if (auto *insertion = dynamic_cast<FixInsert *>(&fix))
    return {insertion->*member(InsertionStream())};
  if (auto *distribution = dynamic_cast<FixParticledistributionDiscrete *>(&fix))
    return {distribution->*member(DistributionStream())};
  if (auto *particle = dynamic_cast<FixTemplateSphere *>(&fix))
    return {particle->*member(TemplateStream()), particle->*member(TemplateVolumeStream())};
  return {};
}

RanPark *random_stream(Region &region) { return region.*member(RegionStream()); }

RanPark *random_stream(TriMesh &mesh) { return mesh.*member(MeshStream()); }

RandomState random_state(RanPark &stream)
{
  return {stream.state(), stream.*member(StreamKeepsOne()), stream.*member(StreamKept())};
}

void set_random_state(RanPark &stream, const RandomState &state)
{
  stream.reset(state.seed);
  stream.*member(StreamKeepsOne()) = state.keeps_one;
  stream.*member(StreamKept()) = state.kept;
}

int history_value(PairGran &pair, const std::string &name)
{
  const auto &values = PairAccess::history(pair);
  for (size_t k = 0; k < values.size(); k++)
    if (values[k].name == name) return static_cast<int>(k);
  return -1;
}

bool has_exclusions(const Neighbor &neighbor) { return Exclusion::any(neighbor); }

bool is_excluded(const Neighbor &neighbor, const Atom &atom, int i, int j)
{
  return Exclusion::of(neighbor, i, j, atom);
}

}  // namespace LAMMPS_NS
