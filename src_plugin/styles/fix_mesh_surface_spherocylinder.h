// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_MESH_SURFACE_SPHEROCYLINDER_H
#define LMP_FIX_MESH_SURFACE_SPHEROCYLINDER_H

#include <vector>

#include "atom.h"
#include "fix_mesh_surface.h"

namespace LAMMPS_NS {

// fix mesh/surface and its variants of decks with rods. A servo wall takes its lowest speed from the
// smallest particle's radius: the rods' own, not that of their bounding spheres.
class FixMeshSurfaceSpherocylinder : public FixMeshSurface {
 public:
  using FixMeshSurface::FixMeshSurface;

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
