// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/compute_contact_spherocylinder.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "contacts/contact_monitor.h"
#include "core/closest_points.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "host/rod_error.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "pair.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using spherocylinder::Capsule;

ComputeContactSpherocylinder::ComputeContactSpherocylinder(LAMMPS *lmp, int &iarg, int narg,
                                                           char **arg)
    : Compute(lmp, iarg, narg, arg)
{
  if (narg != iarg)
    rod_error_all(lmp, "Compute %s (id %s): unexpected argument %s", style, id, arg[iarg]);
  rods_of(lmp, "Compute contact/spherocylinder");
  peratom_flag = 1;
  size_peratom_cols = 0;
  vector_flag = 1;
  size_vector = 5;
  extvector = 0;
  vector = values_;
}

void ComputeContactSpherocylinder::init()
{
  if (!force->pair)
    rod_error_all(lmp, "Compute %s (id %s) requires a pair style to be defined", style, id);
  const int irequest = neighbor->request((void *) this);
  NeighRequest *request = neighbor->requests[irequest];
  request->half = 0;
  request->gran = 1;
  request->pair = 0;
  request->compute = 1;
  request->occasional = 1;
}

void ComputeContactSpherocylinder::init_list(int, NeighList *ptr) { list_ = ptr; }

void ComputeContactSpherocylinder::visit_contacts()
{
  const AtomVecSpherocylinder &rods = rods_of(lmp, "Compute contact/spherocylinder");
  const int *mask = atom->mask;
  const int nlocal = atom->nlocal;
  if (static_cast<int>(contacts_.size()) < atom->nmax) contacts_.resize(atom->nmax);
  vector_atom = contacts_.data();
  std::fill(contacts_.begin(), contacts_.end(), 0.0);
  pairs_ = overlap_sum_ = largest_overlap_ = 0.0;

  neighbor->build_one(list_->index);
  for (int ii = 0; ii < list_->inum; ii++) {
    const int i = list_->ilist[ii];
    if (!(mask[i] & groupbit)) continue;
    const Capsule rod_i = rods.capsule(i);
    for (int jj = 0; jj < list_->numneigh[i]; jj++) {
      const int j = list_->firstneigh[i][jj] & NEIGHMASK;
      if (!(mask[j] & groupbit)) continue;
      const double bound = atom->radius[i] + atom->radius[j];
      const Capsule rod_j = rods.capsule(j);
      if (norm_squared(rod_i.segment.centre - rod_j.segment.centre) >= bound * bound) continue;
      const double reach = rod_i.radius + rod_j.radius;
      const double distance_squared = closest_points(rod_i.segment, rod_j.segment).distance_squared;
      if (distance_squared >= reach * reach) continue;

      // With newton off a pair across ranks is in both ranks' lists.
      const double share = j < nlocal ? 1.0 : 0.5;
      const double overlap = (reach - std::sqrt(distance_squared)) / reach;  // reach = mean D
      contacts_[i] += 1.0;
      if (j < nlocal) contacts_[j] += 1.0;
      pairs_ += share;
      overlap_sum_ += share * overlap;
      largest_overlap_ = std::max(largest_overlap_, overlap);
    }
  }
}

void ComputeContactSpherocylinder::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  visit_contacts();
}

// 1: contacts a rod; 2: contacts (pairs); 3: mean and 4: largest overlap over the mean diameter;
// 5: the largest of any contact, walls included, in any step since the run began
void ComputeContactSpherocylinder::compute_vector()
{
  invoked_vector = update->ntimestep;
  visit_contacts();
  const double local[2] = {pairs_, overlap_sum_};
  const double local_peaks[2] = {
      largest_overlap_,
      rods_of(lmp, "Compute contact/spherocylinder").attached<ContactMonitor>().largest_overlap()};
  double total[2], peaks[2];
  MPI_Allreduce(local, total, 2, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(local_peaks, peaks, 2, MPI_DOUBLE, MPI_MAX, world);
  const double rods_in_group = static_cast<double>(group->count(igroup));
  values_[0] = rods_in_group > 0.0 ? 2.0 * total[0] / rods_in_group : 0.0;
  values_[1] = total[0];
  values_[2] = total[0] > 0.0 ? total[1] / total[0] : 0.0;
  values_[3] = peaks[0];
  values_[4] = peaks[1];
}

double ComputeContactSpherocylinder::memory_usage()
{
  return static_cast<double>(contacts_.capacity() * sizeof(double));
}
