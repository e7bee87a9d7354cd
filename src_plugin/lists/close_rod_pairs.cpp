// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/close_rod_pairs.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "atom.h"
#include "comm.h"
#include "core/rotation.h"
#include "domain.h"
#include "host/host_limits.h"
#include "host/rod_error.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair_gran.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/ghost_user.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Of its half of the outer skin, what a rod has used up that is found again with one that has used up
// all.
constexpr double kUsedUp = 0.5;
// Of the least that a rod may move by, what it keeps of its half of the outer skin.
constexpr double kReserve = 0.5;
// Of rods and ghosts, more than so many are found again with all the others.
constexpr double kMostFoundAgain = 0.4;

// Ghosts are asked for that are so much farther than where they must be, in radii.
constexpr double kAskedBeyond = 0.15;

// How often rods are looked for that have become slow and have wide skins, in steps; how many times
// too wide.
constexpr int64_t kStepsBetweenLooks = 200;
constexpr double kTooWide = 2.0;

// Of a thread: fewer are read sooner than others are told.
constexpr int kFewestRods = 200;
constexpr int kFewestRows = 30;

bool are_nearer(const Capsule &a, const Capsule &b, double gap)
{
  const double reach = a.radius + b.radius + gap;
  if (lines_are_apart(a.segment, b.segment, reach)) return false;
  return !(closest_points(a.segment, b.segment).distance_squared >= reach * reach);
}

}  // namespace

void CloseRodPairs::reset(const PairGran &pair, double skin)
{
  leave_lists_unbuilt(*neighbor, &pair);  // they are filled here
  ghosts_ = &rods_of(lmp, "Pair gran with surface spherocylinder").ghosts();
  counts_ = RodPairCounts();
  skins_.reset(skin);
  seen_builds_ = -1;
}

// neighbor->ago is 0 in a second step, too, if a run goes on with `pre no` after a step that built.
bool CloseRodPairs::have_rods_migrated()
{
  const bool migrated = neighbor->ago == 0 && neighbor->ncalls != seen_builds_;
  seen_builds_ = neighbor->ncalls;
  return migrated;
}

// A rod has other places than that of the list after insertions and deletions in this step.
std::vector<int> CloseRodPairs::pairs_of_rods() const
{
  const std::vector<int> &ids = list_.ids();
  std::vector<int> by_place(ids.size(), 0);
  for (const Entry &entry : entries_) {
    by_place[entry.i]++;
    by_place[entry.j]++;
  }
  std::unordered_map<int, int> by_id;
  std::vector<int> counts(atom->nlocal, 0);
  const int listed = static_cast<int>(first_entry_.size()) - 1;
  for (int i = 0; i < atom->nlocal; i++) {
    const int id = atom->tag[i];
    if (i < listed && ids[i] == id) {
      counts[i] = by_place[i];
      continue;
    }
    if (by_id.empty())
      for (int k = 0; k < listed; k++) by_id[ids[k]] = by_place[k];
    const auto found = by_id.find(id);
    if (found != by_id.end()) counts[i] = found->second;
  }
  return counts;
}

void CloseRodPairs::check_rods_are_the_same() const
{
  if (!list_.is_of_present_rods())
    rod_error_one(lmp,
                  "Run: pre no cannot be used after a command has deleted, added or renamed rods, "
                  "the list of pairs is that of the rods before (expected run without pre no)");
}

// How far the owner of a ghost may be from where the ghost is, and may be while the list lasts.
double CloseRodPairs::stale_by(int i) const
{
  return i >= atom->nlocal && ghosts_->is_stale(i) ? ghosts_->slack(i) : 0.0;
}

double CloseRodPairs::may_be_stale_by(int i) const
{
  return i >= atom->nlocal && ghosts_->may_be_stale() ? ghosts_->slack(i) : 0.0;
}

// What a rod may move from its reference poses: its own half of either skin.
double CloseRodPairs::listed_half(int i, const Capsule &rod) const
{
  return list_reference_[i].radius - rod.radius - may_be_stale_by(i);
}

double CloseRodPairs::close_half(int i, const Capsule &rod) const
{
  return reference_[i].radius - rod.radius - stale_by(i);
}

// Of the fastest point of its surface, a spin about the axis left out (m/s).
double CloseRodPairs::speed_of(int i) const
{
  return norm(load(atom->v[i])) +
         list_reference_[i].segment.half_length * norm(load(atom->omega[i]));
}

double CloseRodPairs::mean_root_speed() const
{
  double sum = 0.0;
  for (int i = 0; i < atom->nlocal; i++) sum += std::sqrt(speed_of(i));
  return sum / std::max(1, atom->nlocal);
}

// The rod gets a new reference pose, from which it may move by `half`.
void CloseRodPairs::move(int i, const Capsule &rod, double half)
{
  reference_[i] = rod;
  reference_[i].radius += half + stale_by(i);
  if (moved_[i]) return;
  moved_[i] = 1;
  moved_rods_.push_back(i);
}

// The same in both lists.
void CloseRodPairs::list_at(int i, const Capsule &rod)
{
  const double speed = speed_of(i), half = skins_.close_half(speed);
  list_reference_[i] = rod;
  list_reference_[i].radius += half + skins_.beyond_half(speed) + may_be_stale_by(i);
  move(i, rod, half);
}

// What a rod may move by in any case, before its pairs are looked at again.
double CloseRodPairs::least_half(double speed) const
{
  return std::min(skins_.close_half(), skins_.close_half(speed));
}

// Whether a rod has used up a good part of its half of the outer skin.
bool CloseRodPairs::is_used_up(int i, const Capsule &rod) const
{
  const double used = kUsedUp * std::max(0.0, listed_half(i, rod) - least_half(speed_of(i)));
  return twice_shift_squared(rod.segment, list_reference_[i].segment) >= used * used;
}

// Moves a rod. False if it may come through its half of the outer skin before it moves again. Where ranks are
// to agree it stops a little before that, so that it lasts for the step in which they are told.
bool CloseRodPairs::move_on(int i, const Capsule &rod)
{
  const double shift = std::sqrt(twice_shift_squared(rod.segment, list_reference_[i].segment));
  const double left = listed_half(i, rod) - shift;
  const double speed = speed_of(i), least = least_half(speed);
  const double reserve = ghosts_->may_be_stale() ? kReserve * least : 0.0;
  if (left >= least + reserve) {
    move(i, rod, std::min(left - reserve, skins_.close_half(speed)));
    return true;
  }
  const bool lasts = reserve > 0.0 && left >= 0.5 * reserve;
  move(i, rod, lasts ? left : least);
  ends_soon_ |= lasts;
  return lasts;
}

// Of a rod that has become slow: its pairs are tested for nothing.
bool CloseRodPairs::is_skin_too_wide(int i, const Capsule &rod) const
{
  return close_half(i, rod) > kTooWide * skins_.close_half(speed_of(i));
}

// False if a ghost may have used up its half of the outer skin. Of ghosts that are in no listed pair
// only this must be known; that of the others is one loop over LIGGGHTS's arrays, or over those that have
// come. The ghosts of one rank alone are its own rods, which it looks at anyway, as long as the box keeps
// its size.
bool CloseRodPairs::ghosts_stay() const
{
  if (comm->nprocs == 1 && list_box_ == box_size()) return true;
  if (ghosts_->are_asked_for()) {
    for (const int i : ghosts_->arrived())
      if (!stays(i)) return false;
    return true;
  }
  const int owned = atom->nlocal;
  for (int i = owned; i < owned + atom->nghost; i++)
    if (!stays(i)) return false;
  return true;
}

bool CloseRodPairs::stays(int i) const
{
  const Segment &then = list_reference_[i].segment;
  const Segment now = {load(atom->x[i]), axis_of(load_quaternion(atom->quaternion[i])),
                       then.half_length};
  const double own = list_reference_[i].radius - radii_[i] - may_be_stale_by(i);
  return twice_shift_squared(now, then) <= own * own;
}

std::array<double, 3> CloseRodPairs::box_size() const
{
  return {domain->xprd, domain->yprd, domain->zprd};
}

// LIGGGHTS has stored the histories and put its rods in order. Mostly, within a run on one rank, each is
// where it was, and so are its pairs and their histories in the list. Ghosts may be other rods or images.
bool CloseRodPairs::list_goes_on(PairGran &pair, const std::vector<Capsule> &rods)
{
  const Update &now = *Pointers::update;
  const bool run_begins = now.setupflag || now.ntimestep <= now.firststep + 1;
  if (run_begins || comm->nprocs > 1 || atom->nghost > 0 || rods.size() != list_reference_.size() ||
      !list_.is_of_present_rods())
    return false;
  for (size_t i = 0; i < rods.size(); i++)
    if (rods[i].radius != radii_[i] ||
        rods[i].segment.half_length != list_reference_[i].segment.half_length)
      return false;
  return list_.goes_on(pair);
}

bool CloseRodPairs::begin_to_look(const RodThreads &threads, int rods)
{
  const double close = skins_.close();
  if (skins_.is_time_to_choose(rods) && skins_.choose(mean_root_speed())) return false;
  skin_is_new_ = skins_.close() != close;
  moving_.resize(threads.pieces_of(atom->nlocal, kFewestRods));
  for (std::vector<int> &moving : moving_) moving.clear();
  return true;
}

CloseRodPairs::Wanted CloseRodPairs::finish_to_look(const std::vector<Capsule> &rods)
{
  const bool may_be_slow = counts_.steps % kStepsBetweenLooks == 0;
  const auto is_to_move = [&](int i) {
    return skin_is_new_ || has_used_up_skin(rods[i], reference_[i], stale_by(i)) ||
           (may_be_slow && is_skin_too_wide(i, rods[i]));
  };
  bool lasts = true;
  const int owned = atom->nlocal;
  if (skin_is_new_ || may_be_slow) {
    for (int i = 0; i < owned; i++)
      if (is_to_move(i)) lasts &= move_on(i, rods[i]);
  } else {
    for (const std::vector<int> &moving : moving_)
      for (const int i : moving) lasts &= move_on(i, rods[i]);
  }
  for (const int i : tracked_ghosts())
    if (is_to_move(i)) lasts &= move_on(i, rods[i]);
  lasts = ghosts_stay() && lasts;
  ghosts_->forget_arrived();
  if (!lasts || ends_soon_on_any_)
    return skins_.widen(owned, list_.pairs()) ? Wanted::AllPairs : Wanted::SomePairs;
  return moved_rods_.empty() ? Wanted::Nothing : Wanted::ClosePairs;
}

void CloseRodPairs::count_step()
{
  skins_.work.steps++;
  skins_.work.tested += static_cast<int64_t>(entries_.size());
  counts_.steps++;
  counts_.close = static_cast<int64_t>(entries_.size());
}

bool CloseRodPairs::is_close(int i, int j) const
{
  const Segment &a = reference_[i].segment, &b = reference_[j].segment;
  const double reach = reference_[i].radius + reference_[j].radius;
  if (lines_are_apart(a, b, reach)) return false;
  return closest_points(a, b).distance_squared < reach * reach;
}

// The rods to be found again: all that have used up a good part of their half of the outer skin, so
// that it is some time until the next ones have. Ghosts of one rank are found again when the rods are whose
// images they are. False if that is not known, or rods are too many.
bool CloseRodPairs::choose_moved(const std::vector<Capsule> &rods)
{
  const int owned = atom->nlocal, nall = owned + atom->nghost;
  const bool are_images = comm->nprocs == 1;
  if (list_box_ != box_size() || (are_images && nall > owned && !atom->map_style)) return false;
  found_again_.clear();
  is_found_again_.assign(nall, 0);
  for (int i = 0; i < nall; i++) {
    const int image_of = i < owned || !are_images ? i : atom->map(atom->tag[i]);
    if (image_of < 0 || (i >= owned && are_images && image_of >= owned)) return false;
    is_found_again_[i] = image_of < i ? is_found_again_[image_of] : is_used_up(i, rods[i]);
    if (is_found_again_[i]) found_again_.push_back(i);
  }
  return static_cast<double>(found_again_.size()) <= kMostFoundAgain * nall;
}

bool CloseRodPairs::renew_some(PairGran &pair, const std::vector<Capsule> &rods)
{
  if (!choose_moved(rods)) return false;
  for (const int i : found_again_) list_at(i, rods[i]);
  if (!list_.renew_some(pair, list_reference_, found_again_, is_found_again_)) return false;
  for (const int i : list_.new_ghosts())
    if (!is_found_again_[i]) move(i, rods[i], least_half(speed_of(i)));

  ends_soon_ = ends_soon_on_any_ = false;
  skins_.work.renewed += static_cast<int64_t>(found_again_.size());
  skins_.work.cells += list_.search().cells();
  skins_.work.tried += list_.search().tried();
  counts_.renewals++;
  counts_.listed = list_.pairs();
  counts_.list_skin = skins_.listed();
  for (const int i : list_.changed_rows()) row_changes_[i] = 1;
  return true;
}

// The rows in which a moved rod is.
void CloseRodPairs::see_changed_rows()
{
  const int rows = static_cast<int>(row_changes_.size());
  for (const int m : moved_rods_) {
    if (m < rows) row_changes_[m] = 1;
    for (const int *i = list_.holders().begin(m); i != list_.holders().end(m); i++)
      row_changes_[*i] = 1;
  }
}

// By all ranks.
bool CloseRodPairs::any_rank_wants_ghosts(const std::vector<Capsule> &rods)
{
  constexpr int kWantsGhosts = 1, kEndsSoon = 2;
  const int told = ghosts_->flags_of_ranks((want_ghosts(rods) ? kWantsGhosts : 0) |
                                           (ends_soon_ ? kEndsSoon : 0));
  ends_soon_on_any_ = (told & kEndsSoon) != 0;
  return (told & kWantsGhosts) != 0;
}

// Whether a stale ghost may touch a rod.
bool CloseRodPairs::want_ghosts(const std::vector<Capsule> &rods) const
{
  for (const Entry &entry : entries_)
    if (entry.j >= atom->nlocal && ghosts_->is_stale(entry.j) &&
        are_nearer(rods[entry.i], rods[entry.j], ghosts_->slack(entry.j)))
      return true;
  return false;
}

// By all ranks. One that is stale from now on has less of its skin.
void CloseRodPairs::ask_for_ghosts(const std::vector<Capsule> &rods)
{
  wanted_ghosts_.clear();
  were_stale_.clear();
  for (const int j : tracked_ghosts()) {
    were_stale_.push_back(ghosts_->is_stale(j));
    const double gap = ghosts_->slack(j) + kAskedBeyond * rods[j].radius;
    const int *end = list_.holders().end(j);
    if (std::any_of(list_.holders().begin(j), end,
                    [&](int i) { return are_nearer(rods[i], rods[j], gap); }))
      wanted_ghosts_.push_back(j);
  }
  add_used_ghosts(lmp, wanted_ghosts_);
  ghosts_->ask_for(wanted_ghosts_);
  auto was_stale = were_stale_.cbegin();
  for (const int j : tracked_ghosts())
    if (!*was_stale++ && ghosts_->is_stale(j)) move(j, rods[j], least_half(speed_of(j)));
}

// Of one row the close pairs, which are those of before but of rods that have moved. Pairs with a contact
// flag are always kept: their parting must be seen.
void CloseRodPairs::remake_row(const NeighList &list, int i, RowMaker &maker) const
{
  const int *flags = list.listgranhistory ? list.listgranhistory->firstneigh[i] : nullptr;
  const int *neighbours = list.firstneigh[i];
  const int count = list.numneigh[i];
  const bool moved_i = moved_[i];
  int old = first_entry_[i];
  const int old_end = first_entry_[i + 1];
  for (int index = 0; index < count; index++) {
    const int j = neighbours[index];
    while (old < old_end && entries_[old].j < j) old++;
    bool close = old < old_end && entries_[old].j == j;
    if (moved_i || moved_[j]) {
      maker.looked_at++;
      close = (flags && flags[index]) || is_close(i, j);
    }
    if (close) maker.entries.push_back({i, j, index, atom->tag[j] < atom->tag[i]});
  }
  maker.walked += count;
}

void CloseRodPairs::refresh(PairGran &pair, const RodThreads &threads)
{
  see_changed_rows();
  remake_rows(pair, threads);
  counts_.refreshes++;
}

// Looks again at the pairs of rods that have moved.
void CloseRodPairs::remake_rows(PairGran &pair, const RodThreads &threads)
{
  changed_rows_.clear();
  const int rows = static_cast<int>(row_changes_.size());
  for (int i = 0; i < rows; i++)
    if (row_changes_[i]) changed_rows_.push_back({i, 0});

  const int number = static_cast<int>(changed_rows_.size());
  const int pieces = threads.pieces_of(number, kFewestRows);
  if (static_cast<int>(row_makers_.size()) < pieces) row_makers_.resize(pieces);
  for (RowMaker &maker : row_makers_) {
    maker.entries.clear();
    maker.looked_at = maker.walked = 0;
  }
  threads.run(pieces, [&](int piece) {
    RowMaker &maker = row_makers_[piece];
    const int last = RodThreads::first_of(piece + 1, pieces, number);
    for (int n = RodThreads::first_of(piece, pieces, number); n < last; n++) {
      const size_t before = maker.entries.size();
      remake_row(*pair.list, changed_rows_[n].row, maker);
      changed_rows_[n].count = static_cast<int>(maker.entries.size() - before);
    }
  });

  changed_entries_.clear();
  for (const RowMaker &maker : row_makers_) {
    changed_entries_.insert(changed_entries_.end(), maker.entries.begin(), maker.entries.end());
    skins_.work.looked_at += maker.looked_at;
    skins_.work.walked += maker.walked;
  }
  const bool fit =
      std::all_of(changed_rows_.begin(), changed_rows_.end(), [&](const ChangedRow &changed) {
        return changed.count == first_entry_[changed.row + 1] - first_entry_[changed.row];
      });
  put_rows(fit);

  for (const int i : moved_rods_) moved_[i] = 0;
  moved_rods_.clear();
  for (const ChangedRow &changed : changed_rows_) row_changes_[changed.row] = 0;
  counts_.close_skin = skins_.close();
}

// The rows between those that changed are copied as blocks, if any has become longer or shorter.
void CloseRodPairs::put_rows(bool fit)
{
  auto own = changed_entries_.cbegin();
  if (fit) {
    for (const ChangedRow &changed : changed_rows_) {
      std::copy_n(own, changed.count, entries_.begin() + first_entry_[changed.row]);
      own += changed.count;
    }
    return;
  }
  next_entries_.clear();
  auto kept = entries_.cbegin();
  size_t row = 0;
  int shift = 0;
  for (const ChangedRow &changed : changed_rows_) {
    const size_t i = changed.row;
    const auto begin = entries_.cbegin() + first_entry_[i],
               end = entries_.cbegin() + first_entry_[i + 1];
    for (; row <= i; row++) first_entry_[row] += shift;
    next_entries_.insert(next_entries_.end(), kept, begin);
    next_entries_.insert(next_entries_.end(), own, own + changed.count);
    own += changed.count;
    kept = end;
    shift += changed.count - static_cast<int>(end - begin);
  }
  for (; row < first_entry_.size(); row++) first_entry_[row] += shift;
  next_entries_.insert(next_entries_.end(), kept, entries_.cend());
  entries_.swap(next_entries_);
}

void CloseRodPairs::renew(PairGran &pair, const RodThreads &threads,
                          const std::vector<Capsule> &rods, bool migrated)
{
  double diameter = 0.0;
  for (const Capsule &rod : rods) diameter += 2.0 * rod.radius / static_cast<double>(rods.size());
  list_reference_ = rods;
  skins_.begin(diameter, mean_root_speed());

  const int count = static_cast<int>(rods.size());
  reference_.resize(count);
  radii_.resize(count);
  moved_.assign(count, 0);
  moved_rods_.clear();
  for (int i = 0; i < count; i++) {
    radii_[i] = rods[i].radius;
    list_at(i, rods[i]);
  }
  list_.renew(pair, list_reference_, migrated);
  list_box_ = box_size();
  ends_soon_ = ends_soon_on_any_ = false;

  row_changes_.assign(pair.list->inum, 1);
  first_entry_.assign(pair.list->inum + 1, 0);
  entries_.clear();
  remake_rows(pair, threads);
  // What LIGGGHTS asks for does not depend on the skin.
  if (!migrated) {
    skins_.work.renewed += static_cast<int64_t>(rods.size());
    skins_.work.cells += list_.search().cells();
    skins_.work.tried += list_.search().tried();
  }

  counts_.renewals++;
  counts_.listed = list_.pairs();
  counts_.list_skin = skins_.listed();
}
