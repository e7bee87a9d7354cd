// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_MESH_SURFACE_SPHEROCYLINDER_H
#define LMP_FIX_MESH_SURFACE_SPHEROCYLINDER_H

#include <algorithm>
#include <vector>

#include "atom.h"
#include "fix_mesh_surface.h"
#include "fix_wall_gran.h"
#include "host/rod_error.h"
#include "modify.h"

namespace LAMMPS_NS {

// fix mesh/surface and its variants of decks with rods. A servo wall takes its lowest speed from the
// smallest particle's radius: the rods' own, not that of their bounding spheres.
class FixMeshSurfaceSpherocylinder : public FixMeshSurface {
 public:
  using FixMeshSurface::FixMeshSurface;

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
};

}  // namespace LAMMPS_NS

#endif
