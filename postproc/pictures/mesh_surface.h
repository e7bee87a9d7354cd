// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of walls as they are drawn: without what is between the viewer and the rods.
#pragma once

#include <optional>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "core/vec3.h"
#include "solid/clipped_volume.h"

namespace spherocylinder {

// The triangles behind what the mesh is about: those whose outer side, which looks away from the
// middle of the mesh's bounds, does not look towards the viewer. A plate through that middle stays.
vtkSmartPointer<vtkPolyData> walls_behind(vtkPolyData *mesh, const Vec3 &towards);

// Its outline as seen along `towards`, its rims, and edges at which it bends by more than 30 degrees.
vtkSmartPointer<vtkPolyData> outline_of(vtkPolyData *mesh, const Vec3 &towards);

// What is in the box, open where its faces cut.
vtkSmartPointer<vtkPolyData> mesh_within(vtkPolyData *mesh, const UprightBox &box);

// The level rectangle over the box's sides at height z, and the box's six faces.
vtkSmartPointer<vtkPolyData> level_plane(const UprightBox &box, double z);
vtkSmartPointer<vtkPolyData> box_faces(const UprightBox &box);

}  // namespace spherocylinder
