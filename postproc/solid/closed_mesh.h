// SPDX-License-Identifier: GPL-2.0-or-later
// A body of any shape, by the closed surface of triangles about it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "core/capsule.h"
#include "solid/clipped_volume.h"
#include "solid/prism_volume.h"

class vtkImplicitPolyDataDistance;

namespace spherocylinder {

// Why the mesh of triangles is no surface that encloses a body, its triangles counter-clockwise as
// seen from outside: the rest of a sentence about it, with what is wanted. Nothing if it is one.
std::optional<std::string> fault_of_surface(vtkPolyData *mesh);

class ClosedMesh {
 public:
  // Of a surface without faults.
  explicit ClosedMesh(vtkPolyData *mesh);
  ClosedMesh(ClosedMesh &&) noexcept;
  ClosedMesh(const ClosedMesh &) = delete;
  ~ClosedMesh();

  const std::vector<Triangle> &triangles() const { return triangles_; }
  UprightBox bounds() const;
  double volume() const { return volume_; }  // m^3

  // From the surface, < 0 inside (m). Not for several threads at a time.
  double distance(const Vec3 &point) const;

  // How a rod lies to it: a rod very near to the surface is taken for one that is cut. Not for
  // several threads at a time.
  enum class Place { Inside, Outside, Cut };
  Place place_of(const Capsule &rod) const;

  // What is in the window; nothing if that is empty. Slices thinner than a millionth of the mesh's
  // size are not cut off: STL files have seven digits.
  std::optional<ClosedMesh> part_within(const UprightBox &window) const;

  // Whether it is the body that the planes of its triangles enclose, to 1e-4 of its volume.
  bool is_convex() const;

  // What is at least the margin away from the planes of all triangles, for a convex one (else it is
  // a part of that); nothing if that is empty.
  std::optional<ClosedMesh> inset(double margin) const;

  // Scaled about the middle of its bounds.
  ClosedMesh scaled(double factor) const;

 private:
  vtkSmartPointer<vtkPolyData> mesh_;
  std::vector<Triangle> triangles_;
  double volume_;
  vtkSmartPointer<vtkImplicitPolyDataDistance> distance_;
};

}  // namespace spherocylinder
