// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/surface_contacts.h"

namespace LAMMPS_NS {

// What is kept of the contacts of each rod with the meshes of a wall: where they were in the last step,
// and what the contact models keep of them. Moves with the rods, to other ranks and to restart files.
class MeshHistories {
 public:
  struct Contact {
    int mesh;         // of the wall, from 0
    int place;        // on the rod: spherocylinder::OnRod
    int triangle_id;  // LIGGGHTS's
    int part;         // of the triangle: see spherocylinder::SurfaceContact
    double along;     // of the point on the axis (m)
    spherocylinder::Vec3 normal;
    spherocylinder::Vec3 place_in_mesh;  // of the point on the axis, from the triangle's centre (m)
    std::vector<double> values;          // of the models

    // The triangle in the present MeshSurface, if its topology() is still this.
    int triangle = -1, topology = -1;
  };
  using Contacts = std::vector<Contact>;

  // How many values the models keep of a contact.
  void keep(int values) { values_ = values; }
  int values() const { return values_; }

  Contacts &of(int rod) { return contacts_[rod]; }

  // LIGGGHTS's calls of a fix with values of rods.
  void grow(int rods) { contacts_.resize(rods); }
  void copy(int from, int to) { contacts_[to] = contacts_[from]; }
  void clear(int rod) { contacts_[rod].clear(); }
  // Numbers of a rod in a buffer, which begins with how many contacts follow.
  int size(int rod) const;
  int pack(int rod, double *buffer) const;
  int unpack(int rod, const double *buffer);
  double memory_usage() const;

 private:
  int values_ = 0;
  std::vector<Contacts> contacts_;
};

}  // namespace LAMMPS_NS
