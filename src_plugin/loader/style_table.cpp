// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/style_table.h"

#include <cstring>
#include <map>
#include <memory>
#include <string>

#include "atom.h"
#include "contacts/contact_styles.h"
#include "delete_atoms.h"
#include "host/private_members.h"
#include "input.h"
#include "lammps.h"
#include "loader/run_checks.h"
#include "modify.h"
#include "read_data.h"
#include "replicate.h"
#include "rods/atom_vec_spherocylinder.h"
#include "set.h"
#include "styles/balance.h"
#include "styles/compute_contact_spherocylinder.h"
#include "styles/compute_erotate_spherocylinder.h"
#include "styles/compute_gran_local_spherocylinder.h"
#include "styles/compute_joint_local_spherocylinder.h"
#include "styles/compute_property_atom_spherocylinder.h"
#include "styles/delete_atoms_spherocylinder.h"
#include "styles/displace_rods.h"
#include "styles/fix_balance.h"
#include "styles/fix_buoyancy_spherocylinder.h"
#include "styles/fix_check_timestep_spherocylinder.h"
#include "styles/fix_contact_history_spherocylinder.h"
#include "styles/fix_external_spherocylinder.h"
#include "styles/fix_fibres_spherocylinder.h"
#include "styles/fix_freeze_spherocylinder.h"
#include "styles/fix_heat_gran_spherocylinder.h"
#include "styles/fix_hinge_spherocylinder.h"
#include "styles/fix_insert_spherocylinder.h"
#include "styles/fix_joint_spherocylinder.h"
#include "styles/fix_limit_omega.h"
#include "styles/fix_mesh_surface_spherocylinder.h"
#include "styles/fix_move_spherocylinder.h"
#include "styles/fix_neighlist_mesh_spherocylinder.h"
#include "styles/fix_nve_spherocylinder.h"
#include "styles/fix_particletemplate_spherocylinder.h"
#include "styles/fix_rest_spherocylinder.h"
#include "styles/fix_wall_gran_spherocylinder.h"
#include "styles/read_data_spherocylinder.h"
#include "styles/replicate_rods.h"
#include "styles/set_spherocylinder.h"
#include "styles/velocity_of_rods.h"

using namespace LAMMPS_NS;

namespace spherocylinder {

namespace {

template <typename T>
Fix *create_fix(LAMMPS *lmp, int narg, char **arg)
{
  return new T(lmp, narg, arg);
}

template <typename T>
Compute *create_compute(LAMMPS *lmp, int iarg, int narg, char **arg)
{
  return new T(lmp, iarg, narg, arg);
}

bool has_rods(LAMMPS *lmp) { return dynamic_cast<AtomVecSpherocylinder *>(lmp->atom->avec); }

template <typename T>
void run_command(LAMMPS *lmp, int narg, char **arg)
{
  T(lmp).command(narg, arg);
}

// Fixes and commands of LIGGGHTS's names: ours with rods, LIGGGHTS's own without.
template <typename WithRods, typename Without>
Fix *create_fix_for(LAMMPS *lmp, int narg, char **arg)
{
  if (has_rods(lmp)) return new WithRods(lmp, narg, arg);
  return new Without(lmp, narg, arg);
}

template <typename WithRods, typename Without>
void run_command_for(LAMMPS *lmp, int narg, char **arg)
{
  if (has_rods(lmp))
    WithRods(lmp).command(narg, arg);
  else
    Without(lmp).command(narg, arg);
}

template <typename OfRods, typename Stock>
Fix *create_insertion(LAMMPS *lmp, int narg, char **arg)
{
  if (has_rods(lmp)) return new OfRods(lmp, InsertionArguments(lmp, narg, arg));
  return new Stock(lmp, narg, arg);
}

Compute *create_property_atom(LAMMPS *lmp, int iarg, int narg, char **arg)
{
  if (has_rods(lmp)) return new ComputePropertyAtomSpherocylinder(lmp, iarg, narg, arg);
  return new ComputePropertyAtom(lmp, iarg, narg, arg);
}

Compute *create_gran_local(LAMMPS *lmp, int iarg, int narg, char **arg)
{
  if (has_rods(lmp)) return new ComputeGranLocalSpherocylinder(lmp, iarg, narg, arg);
  return new ComputePairGranLocal(lmp, iarg, narg, arg);
}

}  // namespace

// The style headers list themselves below, in LIGGGHTS's own way.
void add_styles(LAMMPS *lmp)
{
  register_contact_styles();

  auto &fixes = fix_styles(*lmp->modify);
  auto &computes = compute_styles(*lmp->modify);
  auto &commands = command_styles(*lmp->input);
#define FIX_CLASS
#define FixStyle(key, Class) fixes[#key] = &create_fix<Class>;
#include "styles/fix_balance.h"
#include "styles/fix_check_timestep_spherocylinder.h"
#include "styles/fix_fibres_spherocylinder.h"
#include "styles/fix_hinge_spherocylinder.h"
#include "styles/fix_joint_spherocylinder.h"
#include "styles/fix_limit_omega.h"
#include "styles/fix_nve_spherocylinder.h"
#include "styles/fix_particletemplate_spherocylinder.h"
#include "styles/fix_rest_spherocylinder.h"
#undef FixStyle
#undef FIX_CLASS
  fixes["buoyancy"] = &create_fix_for<FixBuoyancySpherocylinder, FixBuoyancy>;
  fixes["contacthistory"] = &create_fix_for<FixContactHistorySpherocylinder, FixContactHistory>;
  fixes["external"] = &create_fix_for<FixExternalSpherocylinder, FixExternal>;
  fixes["freeze"] = &create_fix_for<FixFreezeSpherocylinder, FixFreeze>;
  fixes["mesh/surface"] = &create_fix_for<FixMeshSurfaceSpherocylinder, FixMeshSurface>;
  fixes["move"] = &create_fix_for<FixMoveSpherocylinder, FixMove>;
  fixes["neighlist/mesh"] = &create_fix_for<FixNeighlistMeshSpherocylinder, FixNeighlistMesh>;
  fixes["wall/gran"] = &create_fix_for<FixWallGranSpherocylinder, FixWallGran>;
  fixes["heat/gran"] = fixes["heat/gran/conduction"] =
      &create_fix_for<FixHeatGranSpherocylinder, FixHeatGranCond>;
  fixes["insert/pack"] = &create_insertion<FixInsertPackSpherocylinder, FixInsertPack>;
  fixes["insert/rate/region"] =
      &create_insertion<FixInsertRateRegionSpherocylinder, FixInsertRateRegion>;
  fixes["insert/stream"] = &create_insertion<FixInsertStreamSpherocylinder, FixInsertStream>;
#define COMPUTE_CLASS
#define ComputeStyle(key, Class) computes[#key] = &create_compute<Class>;
#include "styles/compute_contact_spherocylinder.h"
#include "styles/compute_erotate_spherocylinder.h"
#include "styles/compute_joint_local_spherocylinder.h"
#undef ComputeStyle
#undef COMPUTE_CLASS
#define COMMAND_CLASS
#define CommandStyle(key, Class) commands[#key] = &run_command<Class>;
#include "styles/balance.h"
#undef CommandStyle
#undef COMMAND_CLASS
  commands["delete_atoms"] = &run_command_for<DeleteAtomsSpherocylinder, DeleteAtoms>;
  commands["displace_atoms"] = &run_command_for<DisplaceRods, DisplaceAtoms>;
  commands["read_data"] = &run_command_for<ReadDataSpherocylinder, ReadData>;
  commands["replicate"] = &run_command_for<ReplicateRods, Replicate>;
  commands["set"] = &run_command_for<SetSpherocylinder, Set>;
  commands["velocity"] = &run_command_for<VelocityOfRods, Velocity>;
  computes["property/atom"] = &create_property_atom;
  computes["pair/gran/local"] = computes["wall/gran/local"] = &create_gran_local;
}

AtomVec *create_atom_style(const char *name, LAMMPS *lmp)
{
#define ATOM_CLASS
#define AtomStyle(key, Class)                      \
  if (strcmp(name, #key) == 0) {                   \
    auto *rods = new Class(lmp);                   \
    rods->watch(std::make_unique<RunChecks>(lmp)); \
    return rods;                                   \
  }
#include "rods/atom_vec_spherocylinder.h"
#undef AtomStyle
#undef ATOM_CLASS
  return nullptr;
}

const char *banner()
{
  return "Sphero-cylinders for LIGGGHTS " SPHEROCYLINDER_VERSION
         ": atom_style spherocylinder, surface spherocylinder, model linear, "
         "fix nve/spherocylinder limit/omega check/timestep/spherocylinder "
         "particletemplate/spherocylinder rest/spherocylinder joint/spherocylinder hinge/spherocylinder "
         "balance, command "
         "balance, "
         "compute erotate/spherocylinder contact/spherocylinder joint/spherocylinder/local\n";
}

}  // namespace spherocylinder
