// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/capsule.h"

namespace LAMMPS_NS {

class Domain;

// Capsules in cells, and whether another one overlaps any of them or of their images across the box's
// periodic boundaries. Anywhere in space; a touch counts as an overlap.
class CapsuleCells {
 public:
  // `largest`: bounding radius of the largest capsule that will be added or asked about (m).
  CapsuleCells(const Domain &domain, double largest);

  void add(const spherocylinder::Capsule &capsule);
  bool overlaps(const spherocylinder::Capsule &capsule) const;

  // Whether the capsules of one body overlap images of that body.
  bool overlap_own_images(const std::vector<spherocylinder::Capsule> &body) const;

 private:
  struct Place {
    int64_t cell[3];
  };

  double lo_[3], period_[3], width_[3];  // period_: 0 if the box is not periodic there
  int64_t cells_[3];                     // in a period
  std::vector<spherocylinder::Capsule> capsules_;
  std::unordered_map<int64_t, std::vector<int>> in_cell_;

  Place place_of(const spherocylinder::Vec3 &x) const;
  int64_t key_of(const Place &place) const;
  bool touch(const spherocylinder::Capsule &a, const spherocylinder::Capsule &b,
             bool images_only) const;
};

}  // namespace LAMMPS_NS
