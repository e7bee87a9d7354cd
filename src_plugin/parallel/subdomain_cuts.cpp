// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/subdomain_cuts.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "neighbor.h"

using namespace LAMMPS_NS;

namespace {

double *splits(const Comm &comm, int dimension)
{
  double *const of[3] = {comm.xsplit, comm.ysplit, comm.zsplit};
  return of[dimension];
}

// How many rods lie below each inner cut, on all ranks. `places`: this rank's rods, sorted.
std::vector<bigint> count_below(const std::vector<double> &places, const std::vector<double> &cuts,
                                MPI_Comm world)
{
  std::vector<bigint> local, total(cuts.size());
  for (const double cut : cuts)
    local.push_back(std::lower_bound(places.begin(), places.end(), cut) - places.begin());
  MPI_Allreduce(local.data(), total.data(), static_cast<int>(cuts.size()), MPI_LMP_BIGINT, MPI_SUM,
                world);
  return total;
}

// Of the slabs between the cuts: the fullest over the mean.
double slab_imbalance(const std::vector<bigint> &below, bigint all)
{
  bigint fullest = 0, previous = 0;
  for (const bigint count : below) {
    fullest = std::max(fullest, count - previous);
    previous = count;
  }
  fullest = std::max(fullest, all - previous);
  return static_cast<double>(fullest) * static_cast<double>(below.size() + 1) /
         static_cast<double>(all);
}

}  // namespace

SubdomainCuts::SubdomainCuts(LAMMPS *lmp, const std::string &who, int narg, char **arg)
    : lmp_(lmp), who_(who)
{
  const char *const begin = who_.c_str();
  if (narg != kArguments)
    rod_error_all(lmp, "%s: expected thresh shift dimstr Niter stopthresh", begin);

  threshold_ = deck_number(lmp_, who_, "thresh", arg[0]);
  if (!(threshold_ >= 1.0)) rod_error_all(lmp, "%s: thresh must be >= 1 (got %s)", begin, arg[0]);
  if (strcmp(arg[1], "shift") != 0)
    rod_error_all(lmp, "%s: unknown style %s (expected shift)", begin, arg[1]);
  const std::string dimensions = arg[2];
  for (const char letter : dimensions) {
    const int d = letter - 'x';
    if (d < 0 || d > 2 || std::find(dimensions_.begin(), dimensions_.end(), d) != dimensions_.end())
      rod_error_all(lmp, "%s: dimstr must be made of x, y and z, each at most once (got %s)", begin,
                    arg[2]);
    dimensions_.push_back(d);
  }
  iterations_ = deck_whole_number(lmp_, who_, "Niter", arg[3]);
  if (iterations_ < 1) rod_error_all(lmp, "%s: Niter must be >= 1 (got %s)", begin, arg[3]);
  stop_threshold_ = deck_number(lmp_, who_, "stopthresh", arg[4]);
  if (!(stop_threshold_ >= 1.0))
    rod_error_all(lmp, "%s: stopthresh must be >= 1 (got %s)", begin, arg[4]);
}

void SubdomainCuts::init() const
{
  if (lmp_->domain->triclinic)
    rod_error_all(lmp_, "%s requires an orthogonal box (got a triclinic one)", who_.c_str());
  for (const int d : dimensions_) {
    const int parts = lmp_->comm->procgrid[d];
    const double room = lmp_->domain->prd[d] / parts, least = lmp_->neighbor->skin;
    if (parts > 1 && room < least)
      rod_error_all(lmp_,
                    "%s: the box is cut into %d parts in %c, on average %g long, wanted at least "
                    "the neighbour skin, %g",
                    who_.c_str(), parts, 'x' + d, room, least);
  }
}

double SubdomainCuts::imbalance() const
{
  const bigint mine = lmp_->atom->nlocal;
  bigint most = 0, all = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_LMP_BIGINT, MPI_MAX, lmp_->world);
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, lmp_->world);
  return all == 0 ? 1.0 : static_cast<double>(most) * lmp_->comm->nprocs / static_cast<double>(all);
}

bool SubdomainCuts::shift() const
{
  bool moved = false;
  for (const int d : dimensions_)
    if (lmp_->comm->procgrid[d] > 1) moved = shift_along(d) || moved;
  return moved;
}

// The inner cuts that part the rods evenly, by bisection of all cuts at once; the old ones if those
// found are no better, as with few iterations they may not be.
std::vector<double> SubdomainCuts::equal_cuts(int dimension,
                                              const std::vector<double> &old_cuts) const
{
  const Atom *atom = lmp_->atom;
  const double lo = lmp_->domain->boxlo[dimension], length = lmp_->domain->prd[dimension];
  std::vector<double> places;
  for (int i = 0; i < atom->nlocal; i++) places.push_back((atom->x[i][dimension] - lo) / length);
  std::sort(places.begin(), places.end());

  bigint mine = atom->nlocal, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, lmp_->world);
  if (all == 0) return old_cuts;

  const size_t n = old_cuts.size();
  std::vector<double> best = old_cuts, below(n, 0.0), above(n, 1.0), cuts(n);
  double least = slab_imbalance(count_below(places, old_cuts, lmp_->world), all);
  for (int k = 0; k < iterations_ && least > stop_threshold_; k++) {
    for (size_t c = 0; c < n; c++) cuts[c] = 0.5 * (below[c] + above[c]);
    const std::vector<bigint> counts = count_below(places, cuts, lmp_->world);
    for (size_t c = 0; c < n; c++) {
      const bool too_low =
          counts[c] * static_cast<bigint>(n + 1) < all * static_cast<bigint>(c + 1);
      (too_low ? below : above)[c] = cuts[c];
    }
    const double found = slab_imbalance(counts, all);
    if (found >= least) continue;
    least = found;
    best = cuts;
  }
  return best;
}

bool SubdomainCuts::shift_along(int dimension) const
{
  const Comm &comm = *lmp_->comm;
  double *split = splits(comm, dimension);
  const int parts = comm.procgrid[dimension];
  const double least = lmp_->neighbor->skin / lmp_->domain->prd[dimension];
  if (parts * least > 1.0)
    rod_error_all(lmp_,
                  "%s: the box has become too short in %c, %g for %d parts of at least the "
                  "neighbour skin, %g",
                  who_.c_str(), 'x' + dimension, lmp_->domain->prd[dimension], parts,
                  lmp_->neighbor->skin);

  const std::vector<double> old(split, split + parts + 1);
  std::vector<double> cuts = old;
  const std::vector<double> inner = equal_cuts(dimension, {old.begin() + 1, old.end() - 1});
  std::copy(inner.begin(), inner.end(), cuts.begin() + 1);
  for (int c = 1; c < parts; c++) cuts[c] = std::max(cuts[c], cuts[c - 1] + least);
  for (int c = parts - 1; c > 0; c--) cuts[c] = std::min(cuts[c], cuts[c + 1] - least);
  if (cuts == old) return false;
  std::copy(cuts.begin(), cuts.end(), split);
  lmp_->comm->uniform = 0;
  return true;
}

std::string SubdomainCuts::text() const
{
  std::ostringstream out;
  for (int d = 0; d < 3; d++) {
    out << "  " << static_cast<char>('x' + d) << " cuts:";
    for (int c = 0; c <= lmp_->comm->procgrid[d]; c++) out << ' ' << splits(*lmp_->comm, d)[c];
    out << '\n';
  }
  return out.str();
}
