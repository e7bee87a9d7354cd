// SPDX-License-Identifier: GPL-2.0-or-later
#include "insertion/shared_placement.h"

#include <algorithm>
#include <cmath>

#include <mpi.h>

#include "atom.h"
#include "domain.h"
#include "parallel/from_all_ranks.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
using spherocylinder::Capsule;

namespace {

double largest_of_all(LAMMPS *lmp, double largest)
{
  const double *radius = lmp->atom->radius;
  for (int i = 0; i < lmp->atom->nlocal; i++) largest = std::max(largest, radius[i]);
  double all = 0.0;
  MPI_Allreduce(&largest, &all, 1, MPI_DOUBLE, MPI_MAX, lmp->world);
  return all;
}

}  // namespace

SharedPlacement::SharedPlacement(LAMMPS *lmp, double largest)
    : Pointers(lmp), largest_(largest_of_all(lmp, largest)), own_(*domain, largest_)
{
  const AtomVecSpherocylinder &rods = rods_of(lmp, "Insertion of rods");
  for (int i = 0; i < atom->nlocal; i++) own_.add(rods.capsule(i));
}

bool SharedPlacement::is_clear_here(const Body &body) const
{
  for (const Capsule &capsule : body)
    if (own_.overlaps(capsule)) return false;
  return !own_.overlap_own_images(body);
}

bool SharedPlacement::is_in_box(const Body &body) const
{
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (const Capsule &capsule : body) {
    double centre[3], axis[3];
    spherocylinder::store(capsule.segment.centre, centre);
    spherocylinder::store(capsule.segment.axis, axis);
    for (int d = 0; d < 3; d++) {
      const double reach = capsule.segment.half_length * std::fabs(axis[d]) + capsule.radius;
      if (!periodic[d] &&
          (centre[d] - reach < domain->boxlo[d] || centre[d] + reach > domain->boxhi[d]))
        return false;
    }
  }
  return true;
}

std::vector<SharedPlacement::Body> SharedPlacement::of_all_ranks(
    const std::vector<Body> &mine) const
{
  std::vector<double> numbers;
  for (const Body &body : mine) {
    numbers.push_back(static_cast<double>(body.size()));
    for (const Capsule &capsule : body) {
      const spherocylinder::Segment &s = capsule.segment;
      numbers.insert(numbers.end(), {s.centre.x, s.centre.y, s.centre.z, s.axis.x, s.axis.y,
                                     s.axis.z, s.half_length, capsule.radius});
    }
  }
  const std::vector<double> all = from_all_ranks(world, numbers);
  std::vector<Body> bodies;
  for (size_t k = 0; k < all.size();) {
    bodies.emplace_back(static_cast<size_t>(all[k++]));
    for (Capsule &capsule : bodies.back()) {
      capsule = {{spherocylinder::load(&all[k]), spherocylinder::load(&all[k + 3]), all[k + 6]},
                 all[k + 7]};
      k += 8;
    }
  }
  return bodies;
}

std::vector<char> SharedPlacement::place(const std::vector<Body> &mine)
{
  const int count = static_cast<int>(mine.size());
  int first = 0;
  MPI_Scan(&count, &first, 1, MPI_INT, MPI_SUM, world);
  first -= count;
  const std::vector<Body> all = of_all_ranks(mine);
  std::vector<int> is_clear_of_mine(all.size()), is_clear(all.size());
  for (int k = 0; k < static_cast<int>(all.size()); k++)
    is_clear_of_mine[k] = (k >= first && k < first + count) || is_clear_here(all[k]);
  MPI_Allreduce(is_clear_of_mine.data(), is_clear.data(), static_cast<int>(all.size()), MPI_INT,
                MPI_MIN, world);

  CapsuleCells placed(*domain, largest_);
  std::vector<char> is_placed(count, 0);
  for (int k = 0; k < static_cast<int>(all.size()); k++) {
    const auto overlaps = [&](const Capsule &capsule) { return placed.overlaps(capsule); };
    if (!is_clear[k] || std::any_of(all[k].begin(), all[k].end(), overlaps)) continue;
    const bool is_mine = k >= first && k < first + count;
    for (const Capsule &capsule : all[k]) {
      placed.add(capsule);
      if (is_mine) own_.add(capsule);
    }
    if (is_mine) is_placed[k - first] = 1;
  }
  return is_placed;
}
