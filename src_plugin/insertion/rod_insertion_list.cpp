// SPDX-License-Identifier: GPL-2.0-or-later
#include "insertion/rod_insertion_list.h"

#include <algorithm>
#include <vector>

#include "atom.h"
#include "bounding_box.h"
#include "core/closest_points.h"
#include "domain.h"
#include "error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using spherocylinder::Capsule;

namespace {

double bounding_radius_of(const Capsule &capsule) { return 0.5 * capsule.length(); }

}  // namespace

RodInsertionList::RodInsertionList(LAMMPS *lmp)
    : Pointers(lmp), rods_(rods_of(lmp, "Insertion of rods")), bins_(lmp)
{
}

void RodInsertionList::begin(const void *insertion, double bounding_radius)
{
  if (insertion == insertion_ && step_ == update->ntimestep) return;
  insertion_ = insertion;
  step_ = update->ntimestep;

  // LIGGGHTS forgets its ghosts when the first fix of a step has inserted.
  std::vector<Capsule> there;
  const std::vector<Capsule> *ghosts = rods_.ghosts().before_insertion();
  const int count = ghosts ? atom->nlocal : atom->nlocal + atom->nghost;
  for (int i = 0; i < count; i++) there.push_back(rods_.capsule(i));
  if (ghosts) there.insert(there.end(), ghosts->begin(), ghosts->end());
  double largest = bounding_radius;
  for (const Capsule &rod : there) largest = std::max(largest, bounding_radius_of(rod));

  // A new rod's centre is on this rank; a rod it can reach lies within two bounding radii of it.
  BoundingBox box(domain->sublo[0], domain->subhi[0], domain->sublo[1], domain->subhi[1],
                  domain->sublo[2], domain->subhi[2]);
  box.extendByDelta(2.0 * largest);
  bins_.reset();
  capsules_.clear();
  if (!bins_.setBoundingBox(box, largest, true, true))
    error->one(FLERR, "Insertion of spherocylinders: this rank's subdomain is empty");

  for (const Capsule &rod : there) {
    double centre[3];
    spherocylinder::store(rod.segment.centre, centre);
    if (bins_.isInBoundingBox(centre)) add(rod);
  }
}

bool RodInsertionList::overlaps(const Capsule &capsule)
{
  double centre[3];
  spherocylinder::store(capsule.segment.centre, centre);
  near_.clear();
  if (!bins_.hasOverlapWith(centre, bounding_radius_of(capsule), near_)) return false;
  for (const int k : near_) {
    const Capsule &other = capsules_[k];
    const double reach = capsule.radius + other.radius;
    if (closest_points(capsule.segment, other.segment).distance_squared <= reach * reach)
      return true;
  }
  return false;
}

void RodInsertionList::add(const Capsule &capsule)
{
  double centre[3];
  spherocylinder::store(capsule.segment.centre, centre);
  bins_.insert(centre, bounding_radius_of(capsule), static_cast<int>(capsules_.size()));
  capsules_.push_back(capsule);
}
