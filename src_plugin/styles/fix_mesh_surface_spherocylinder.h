// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_MESH_SURFACE_SPHEROCYLINDER_H
#define LMP_FIX_MESH_SURFACE_SPHEROCYLINDER_H

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "fix_mesh_surface.h"
#include "fix_wall_gran.h"
#include "host/rod_error.h"
#include "modify.h"
#include "styles/mesh_file_check.h"

namespace LAMMPS_NS {

// fix mesh/surface and its variants of decks with rods. A servo wall takes its lowest speed from the
// smallest particle's radius: the rods' own, not that of their bounding spheres.
class FixMeshSurfaceSpherocylinder : public FixMeshSurface {
 public:
  FixMeshSurfaceSpherocylinder(LAMMPS *lmp, int narg, char **arg)
      : FixMeshSurface(lmp, narg, with_whole_file(lmp, narg, arg))
  {
  }

  // LIGGGHTS tells by its contact history of the mesh, which walls of rods do not have.
  void pre_delete(bool unfixflag) override
  {
    for (int k = 0; unfixflag && k < modify->nfix; k++) {
      auto *wall = dynamic_cast<FixWallGran *>(modify->fix[k]);
      if (!wall || !wall->is_mesh_wall()) continue;
      FixMeshSurface **const meshes = wall->mesh_list();
      if (std::find(meshes, meshes + wall->n_meshes(), this) != meshes + wall->n_meshes())
        rod_error_all(lmp,
                      "Fix %s (id %s): can not unfix while fix wall/gran (id %s) is active on the "
                      "mesh: unfix that first",
                      style, id, wall->id);
    }
    FixMeshSurface::pre_delete(unfixflag);
  }

  void init() override
  {
    std::vector<double> radii(atom->nlocal);
    for (int i = 0; i < atom->nlocal; i++) radii[i] = atom->shape[i][0];
    double *const bounding = atom->radius;
    atom->radius = radii.data();
    FixMeshSurface::init();
    atom->radius = bounding;
  }

 private:
  // The arguments, once the STL file that they name is found to be whole.
  static char **with_whole_file(LAMMPS *lmp, int narg, char **arg)
  {
    for (int k = 3; lmp->comm->me == 0 && k + 1 < narg; k++) {
      if (strcmp(arg[k], "file") != 0) continue;
      const std::string name = arg[k + 1];
      const std::string end = name.substr(name.size() - std::min<size_t>(4, name.size()));
      std::ifstream file(name);
      if (!file || (end != ".stl" && end != ".STL")) break;
      const std::string fault = fault_of_stl_file(file);
      if (!fault.empty())
        rod_error_one(lmp, "Fix %s (id %s): mesh file %s, %s", arg[2], arg[0], name.c_str(),
                      fault.c_str());
      break;
    }
    return arg;
  }
};

}  // namespace LAMMPS_NS

#endif
