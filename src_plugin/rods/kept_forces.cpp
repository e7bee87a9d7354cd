// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/kept_forces.h"

#include <algorithm>
#include <map>

#include <mpi.h>

#include "atom.h"
#include "lammps.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

// No value of a rod or of a contact.
constexpr double kMark = 0x1.f04ce5p-1001;

}  // namespace

std::array<double, 13> KeptForces::state_of(const Atom &atom, int i)
{
  const double *x = atom.x[i], *v = atom.v[i], *w = atom.omega[i], *q = atom.quaternion[i];
  return {x[0], x[1], x[2], v[0], v[1], v[2], w[0], w[1], w[2], q[0], q[1], q[2], q[3]};
}

bool KeptForces::are_written() const { return lmp_->update->whichflag == 1; }

int KeptForces::pack(int i, double *buffer) const
{
  for (int d = 0; d < 3; d++) {
    buffer[d] = lmp_->atom->f[i][d];
    buffer[3 + d] = lmp_->atom->torque[i][d];
  }
  buffer[6] = kMark;
  return kNumbers;
}

bool KeptForces::take(int i, const double *end)
{
  if (end[-1] != kMark) return false;
  Kept kept{static_cast<double>(lmp_->atom->tag[i]), state_of(*lmp_->atom, i), {}, {}};
  std::copy(end - kNumbers, end - 1, kept.forces.begin());
  std::copy_n(lmp_->atom->angmom[i], 3, kept.angmom.begin());
  kept_.push_back(kept);
  return true;
}

// By id. If rods have gone to other ranks since they were read, of all ranks.
std::map<double, KeptForces::Kept> KeptForces::of_my_rods() const
{
  std::map<double, Kept> by_id;
  for (const Kept &kept : kept_) by_id[kept.id] = kept;
  int lacks_one = 0, any_lacks_one = 0;
  for (int i = 0; i < lmp_->atom->nlocal; i++) lacks_one |= by_id.count(lmp_->atom->tag[i]) == 0;
  MPI_Allreduce(&lacks_one, &any_lacks_one, 1, MPI_INT, MPI_MAX, lmp_->world);
  if (!any_lacks_one) return by_id;

  int ranks;
  MPI_Comm_size(lmp_->world, &ranks);
  const int mine = static_cast<int>(kept_.size());
  std::vector<int> sizes(ranks), starts(ranks, 0);
  MPI_Allgather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, lmp_->world);
  for (int rank = 1; rank < ranks; rank++) starts[rank] = starts[rank - 1] + sizes[rank - 1];
  std::vector<Kept> all(starts.back() + sizes.back());
  MPI_Datatype type;
  MPI_Type_contiguous(sizeof(Kept), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Allgatherv(kept_.data(), mine, type, all.data(), sizes.data(), starts.data(), type,
                 lmp_->world);
  MPI_Type_free(&type);
  for (const Kept &kept : all) by_id[kept.id] = kept;
  return by_id;
}

// One rod that is another, is new or is gone may act on all.
void KeptForces::look_at_rods()
{
  const std::map<double, Kept> all = of_my_rods();
  std::vector<Kept> mine;
  for (int i = 0; i < lmp_->atom->nlocal; i++) {
    const auto found = all.find(lmp_->atom->tag[i]);
    if (found != all.end() && found->second.state == state_of(*lmp_->atom, i))
      mine.push_back(found->second);
  }
  const bigint counts[3] = {static_cast<bigint>(kept_.size()), lmp_->atom->nlocal,
                            static_cast<bigint>(mine.size())};
  bigint totals[3];
  MPI_Allreduce(counts, totals, 3, MPI_LMP_BIGINT, MPI_SUM, lmp_->world);
  if (totals[0] != totals[1] || totals[1] != totals[2]) mine.clear();
  kept_ = mine;
}

void KeptForces::use(bool they_hold)
{
  const std::map<double, Kept> all = of_my_rods();
  kept_.clear();
  if (!they_hold) return;
  for (int i = 0; i < lmp_->atom->nlocal; i++) {
    const auto found = all.find(lmp_->atom->tag[i]);
    if (found == all.end()) continue;
    const std::array<double, 6> &forces = found->second.forces;
    std::copy_n(found->second.angmom.begin(), 3, lmp_->atom->angmom[i]);
    for (int d = 0; d < 3; d++) {
      lmp_->atom->f[i][d] = forces[d];
      lmp_->atom->torque[i][d] = forces[3 + d];
    }
  }
}
