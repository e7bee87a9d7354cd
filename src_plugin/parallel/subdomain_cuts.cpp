// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/subdomain_cuts.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <sstream>
#include <utility>

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "modify.h"
#include "neighbor.h"

using namespace LAMMPS_NS;

namespace {

double *splits(const Comm &comm, int dimension)
{
  double *const of[3] = {comm.xsplit, comm.ysplit, comm.zsplit};
  return of[dimension];
}

// Meshes hand triangles to neighbouring ranks only, and lose those that belong further away: a cut goes no
// further than its neighbours were.
bool has_mesh(const Modify &modify)
{
  return std::any_of(modify.fix, modify.fix + modify.nfix, [](const Fix *fix) {
    return strncmp(fix->style, "mesh/surface", strlen("mesh/surface")) == 0;
  });
}

}  // namespace

SubdomainCuts::SubdomainCuts(LAMMPS *lmp, const std::string &who, int narg, char **arg)
    : lmp_(lmp), who_(who)
{
  const char *const begin = who_.c_str();
  constexpr int kArguments = 5;
  if (narg < kArguments)
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
  if (narg > kArguments) read_weight(narg - kArguments, arg + kArguments);
}

void SubdomainCuts::read_weight(int narg, char **arg)
{
  const char *const begin = who_.c_str();
  if (strcmp(arg[0], "weight") != 0)
    rod_error_all(lmp_, "%s: unknown keyword %s (expected weight)", begin, arg[0]);
  if (narg < 3) rod_error_all(lmp_, "%s: expected weight neigh factor", begin);
  if (strcmp(arg[1], "neigh") != 0)
    rod_error_all(lmp_, "%s: unknown weight %s (expected neigh)", begin, arg[1]);
  pair_cost_ = deck_number(lmp_, who_, "factor of weight neigh", arg[2]);
  if (!(pair_cost_ > 0.0))
    rod_error_all(lmp_, "%s: factor of weight neigh must be > 0 (got %s)", begin, arg[2]);
  if (narg > 3)
    rod_error_all(lmp_, "%s: expected nothing after weight neigh factor (got %s)", begin, arg[3]);
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

SubdomainCuts::Load SubdomainCuts::own_load(const std::vector<int> &close_pairs) const
{
  Load load;
  load.rods = lmp_->atom->nlocal;
  if (weighs_pairs())
    load.pairs = std::accumulate(close_pairs.begin(), close_pairs.end(), static_cast<bigint>(0));
  return load;
}

SubdomainCuts::Load SubdomainCuts::sum_of_ranks(const Load &mine) const
{
  const bigint local[2] = {mine.rods, mine.pairs};
  bigint all[2] = {0, 0};
  MPI_Allreduce(local, all, 2, MPI_LMP_BIGINT, MPI_SUM, lmp_->world);
  return {all[0], all[1]};
}

double SubdomainCuts::largest_cost(const std::vector<int> &close_pairs) const
{
  const double mine = cost(own_load(close_pairs));
  double most = 0.0;
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, lmp_->world);
  return most;
}

double SubdomainCuts::imbalance(const std::vector<int> &close_pairs) const
{
  const double most = largest_cost(close_pairs), all = cost(sum_of_ranks(own_load(close_pairs)));
  return all == 0.0 ? 1.0 : most * lmp_->comm->nprocs / all;
}

bool SubdomainCuts::shift(const std::vector<int> &close_pairs) const
{
  bool moved = false;
  for (const int d : dimensions_)
    if (lmp_->comm->procgrid[d] > 1) moved = shift_along(d, close_pairs) || moved;
  return moved;
}

// What the rods below each inner cut cost, on all ranks. `places`: this rank's rods, sorted;
// `pairs_before`: close pairs of those before each of them, and of all.
std::vector<double> SubdomainCuts::costs_below(const std::vector<double> &cuts,
                                               const std::vector<double> &places,
                                               const std::vector<bigint> &pairs_before) const
{
  std::vector<bigint> local, total(2 * cuts.size());
  for (const double cut : cuts) {
    const auto rods = std::lower_bound(places.begin(), places.end(), cut) - places.begin();
    local.push_back(rods);
    local.push_back(pairs_before[rods]);
  }
  MPI_Allreduce(local.data(), total.data(), static_cast<int>(total.size()), MPI_LMP_BIGINT, MPI_SUM,
                lmp_->world);
  std::vector<double> costs;
  for (size_t c = 0; c < cuts.size(); c++) costs.push_back(cost({total[2 * c], total[2 * c + 1]}));
  return costs;
}

// Of the slabs between the cuts: the dearest over the mean.
double SubdomainCuts::slab_imbalance(const std::vector<double> &below, double all) const
{
  double dearest = 0.0, previous = 0.0;
  for (const double cost : below) {
    dearest = std::max(dearest, cost - previous);
    previous = cost;
  }
  dearest = std::max(dearest, all - previous);
  return dearest * static_cast<double>(below.size() + 1) / all;
}

// The inner cuts that part the cost evenly, by bisection of all cuts at once; the old ones if those
// found are no better, as with few iterations they may not be.
std::vector<double> SubdomainCuts::equal_cuts(int dimension, const std::vector<double> &old_cuts,
                                              const std::vector<int> &close_pairs) const
{
  const Atom *atom = lmp_->atom;
  const double lo = lmp_->domain->boxlo[dimension], length = lmp_->domain->prd[dimension];
  const double all = cost(sum_of_ranks(own_load(close_pairs)));
  if (all == 0.0) return old_cuts;

  std::vector<std::pair<double, int>> rods;  // place, close pairs
  for (int i = 0; i < atom->nlocal; i++)
    rods.emplace_back((atom->x[i][dimension] - lo) / length, weighs_pairs() ? close_pairs[i] : 0);
  std::sort(rods.begin(), rods.end());
  std::vector<double> places;
  std::vector<bigint> pairs_before = {0};
  for (const auto &[place, pairs] : rods) {
    places.push_back(place);
    pairs_before.push_back(pairs_before.back() + pairs);
  }

  const size_t n = old_cuts.size();
  std::vector<double> best = old_cuts, below(n, 0.0), above(n, 1.0), cuts(n);
  double least = slab_imbalance(costs_below(old_cuts, places, pairs_before), all);
  for (int k = 0; k < iterations_ && least > stop_threshold_; k++) {
    for (size_t c = 0; c < n; c++) cuts[c] = 0.5 * (below[c] + above[c]);
    const std::vector<double> costs = costs_below(cuts, places, pairs_before);
    for (size_t c = 0; c < n; c++) {
      const bool too_low = costs[c] * static_cast<double>(n + 1) < all * static_cast<double>(c + 1);
      (too_low ? below : above)[c] = cuts[c];
    }
    const double found = slab_imbalance(costs, all);
    if (found >= least) continue;
    least = found;
    best = cuts;
  }
  return best;
}

bool SubdomainCuts::shift_along(int dimension, const std::vector<int> &close_pairs) const
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
  const std::vector<double> inner =
      equal_cuts(dimension, {old.begin() + 1, old.end() - 1}, close_pairs);
  std::copy(inner.begin(), inner.end(), cuts.begin() + 1);
  if (parts > 3 && has_mesh(*lmp_->modify))
    for (int c = 1; c < parts; c++) cuts[c] = std::clamp(cuts[c], old[c - 1], old[c + 1]);
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
