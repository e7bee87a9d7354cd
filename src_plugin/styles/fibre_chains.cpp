// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fibre_chains.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "host/rod_error.h"
#include "parallel/from_all_ranks.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

using S = FibreSegments;

// The first of the next chain's numbers.
int highest_fibre(LAMMPS *lmp, const FibreSegments &segments)
{
  int mine = 0, highest = 0;
  for (int i = 0; i < lmp->atom->nlocal; i++) mine = std::max(mine, segments.fibre(i));
  MPI_Allreduce(&mine, &highest, 1, MPI_INT, MPI_MAX, lmp->world);
  return highest;
}

// The shortest rotation that takes the unit vector a to b.
Quaternion swing(const Vec3 &a, const Vec3 &b)
{
  const Vec3 turn = cross(a, b);
  return normalized({1.0 + dot(a, b), turn.x, turn.y, turn.z});
}

// Neighbours must not lie on each other: beyond this angle between their axes they are folded.
constexpr double kFoldedCosine = -0.999;

}  // namespace

FibreChains::FibreChains(LAMMPS *lmp, std::string who)
    : Pointers(lmp),
      who_(std::move(who)),
      atoms_(rods_of(lmp, who_.c_str())),
      segments_(atoms_.attached<FibreSegments>()),
      me_(comm->me)
{
}

template <typename IsWanted>
void FibreChains::gather(IsWanted is_wanted)
{
  constexpr size_t kValues = 18;
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_wanted(i)) continue;
    const double *x = atom->x[i], *q = atom->quaternion[i], *shape = atom->shape[i];
    const double *row = segments_.rows[i];
    mine.insert(mine.end(),
                {double(atom->tag[i]), double(me_), double(i), row[S::kFibre], row[S::kPlace],
                 row[S::kEnds], shape[0], shape[2] - shape[0], x[0], x[1], x[2], q[0], q[1], q[2],
                 q[3], row[S::kBendX], row[S::kBendY], row[S::kTwist]});
  }
  const std::vector<double> all = from_all_ranks(world, mine);
  rods_.clear();
  for (size_t k = 0; k < all.size(); k += kValues) {
    const double *v = &all[k];
    rods_.push_back({int(v[0]),
                     int(v[1]),
                     int(v[2]),
                     int(v[3]),
                     int(v[4]),
                     int(v[5]),
                     v[6],
                     {load(v + 8), load_quaternion(v + 11), v[7]},
                     {v[15], v[16], v[17]}});
  }
  std::sort(rods_.begin(), rods_.end(), [](const Rod &a, const Rod &b) {
    if (a.fibre != b.fibre) return a.fibre < b.fibre;
    return a.place != b.place ? a.place < b.place : a.id < b.id;
  });
}

void FibreChains::put_back(const Rod &rod) const
{
  if (rod.rank != me_) return;
  const int i = rod.local;
  double *row = segments_.rows[i];
  row[S::kFibre] = rod.fibre;
  row[S::kPlace] = rod.place;
  row[S::kEnds] = rod.ends;
  row[S::kBendX] = rod.rest.bend_x;
  row[S::kBendY] = rod.rest.bend_y;
  row[S::kTwist] = rod.rest.twist;
  store(rod.pose.orientation, atom->quaternion[i]);
  atoms_.set_rod(i, 2.0 * atom->shape[i][0], 2.0 * atom->shape[i][2], atom->density[i],
                 segments_.shared_ends(i));
}

// The same rod, tail for head: half a turn about body x.
void FibreChains::flip(int rod)
{
  Quaternion &q = rods_[rod].pose.orientation;
  q = q * Quaternion{0.0, 1.0, 0.0, 0.0};
}

// Across a periodic boundary the nearest image.
Vec3 FibreChains::from_to(const Vec3 &a, const Vec3 &b) const
{
  double d[3];
  store(b - a, d);
  domain->minimum_image(d[0], d[1], d[2]);
  return load(d);
}

Vec3 FibreChains::end_of(int rod, bool head) const
{
  return head ? rods_[rod].pose.head() : rods_[rod].pose.tail();
}

double FibreChains::gap(int rod, bool head, int other, bool other_head) const
{
  return norm(from_to(end_of(rod, head), end_of(other, other_head)));
}

// One rod a place, from 1 without a gap but where it is said which ends are joined. Sorted by fibre and place.
void FibreChains::check_places() const
{
  int fibre = 0, wanted = 1;
  const Rod *before = nullptr;
  for (const Rod &rod : rods_) {
    if (rod.fibre != fibre) wanted = 1;
    if (before && before->fibre == rod.fibre && before->place == rod.place)
      rod_error_all(lmp,
                    "%s: rods %d and %d both have place %d of fibre %d, a joint would be named "
                    "twice; wanted one rod a place",
                    who_.c_str(), before->id, rod.id, rod.place, rod.fibre);
    if (rod.ends < 0 && rod.place != wanted)
      rod_error_all(lmp,
                    "%s: fibre %d has no rod at place %d, the next is rod %d at place %d; wanted "
                    "places from 1 without a gap",
                    who_.c_str(), rod.fibre, wanted, rod.id, rod.place);
    fibre = rod.fibre;
    wanted = rod.place + 1;
    before = &rod;
  }
}

// A joint has two ends: the head of a segment and the tail of the next, in a ring that of the first.
void FibreChains::check_ends(int first, int last) const
{
  const auto after = [&](int k) {
    if (k + 1 < last) return rods_[k + 1].place == rods_[k].place + 1 ? k + 1 : -1;
    return rods_[first].place == 1 ? first : -1;
  };
  std::vector<char> is_met(last - first, 0);
  for (int k = first; k < last; k++) {
    const int next = after(k);
    const bool head = rods_[k].ends & S::kHeadJoined;
    const bool tail = next >= 0 && (rods_[next].ends & S::kTailJoined);
    if (next >= 0) is_met[next - first] = 1;
    if (head != tail)
      rod_error_all(
          lmp,
          "%s: the head of rod %d, place %d of fibre %d, is %s and the tail of the next is %s; "
          "wanted both or neither",
          who_.c_str(), rods_[k].id, rods_[k].place, rods_[k].fibre, head ? "joined" : "free",
          tail       ? "joined"
          : next < 0 ? "not there"
                     : "free");
  }
  for (int k = first; k < last; k++)
    if (!is_met[k - first] && (rods_[k].ends & S::kTailJoined))
      rod_error_all(
          lmp,
          "%s: the tail of rod %d, place %d of fibre %d, is joined and there is no segment "
          "before it",
          who_.c_str(), rods_[k].id, rods_[k].place, rods_[k].fibre);
}

void FibreChains::check_can_join(int k, int next) const
{
  const Rod &a = rods_[k], &b = rods_[next];
  if (std::fabs(a.radius - b.radius) > kSameRadius * a.radius)
    rod_error_all(lmp,
                  "%s: rods %d and %d are joined and must have the same diameter (got %g and %g)",
                  who_.c_str(), a.id, b.id, 2.0 * a.radius, 2.0 * b.radius);
  for (const Rod *rod : {&a, &b})
    if (rod->pose.half_length < 0.5 * rod->radius)
      rod_error_all(lmp,
                    "%s: the joints of a segment must be at least its radius %g apart (got %g for "
                    "rod %d)",
                    who_.c_str(), rod->radius, 2.0 * rod->pose.half_length, rod->id);
  if (dot(a.pose.axis(), b.pose.axis()) < kFoldedCosine)
    rod_error_all(lmp, "%s: rods %d and %d are folded onto each other at their joint", who_.c_str(),
                  a.id, b.id);
}

// Places first ... last - 1 of rods_ in their order, each turned so that its head meets the next.
FibreChains::Chain FibreChains::chain_by_places(int first, int last, double tolerance)
{
  Chain chain;
  for (int k = first; k < last; k++) chain.rods.push_back(k);
  for (int k = first; k + 1 < last; k++) {
    double least = gap(k, true, k + 1, false);
    bool from_tail = false, to_head = false;
    for (const bool tail : {false, true})
      for (const bool head : {false, true}) {
        if (tail && k > first) continue;  // where it is joined already
        const double other = gap(k, !tail, k + 1, head);
        if (other >= least) continue;
        least = other;
        from_tail = tail;
        to_head = head;
      }
    const double most = tolerance * 2.0 * rods_[k].radius;
    if (least > most)
      rod_error_all(lmp,
                    "%s: rods %d and %d, places %d and %d of fibre %d, do not meet: the nearest of "
                    "their ends' centres are %g apart, wanted at most %g (%g diameters)",
                    who_.c_str(), rods_[k].id, rods_[k + 1].id, rods_[k].place, rods_[k + 1].place,
                    rods_[k].fibre, least, most, tolerance);
    if (from_tail) flip(k);
    if (to_head) flip(k + 1);
  }
  chain.is_ring = last - first > 2 &&
                  gap(last - 1, true, first, false) <= tolerance * 2.0 * rods_[first].radius;
  return chain;
}

int FibreChains::join_places(double tolerance)
{
  gather([&](int i) { return segments_.is_segment(i); });
  check_places();
  int joints = 0;
  for (int first = 0; first < static_cast<int>(rods_.size());) {
    int last = first + 1;
    while (last < static_cast<int>(rods_.size()) && rods_[last].fibre == rods_[first].fibre) last++;
    if (rods_[first].ends < 0)
      joints += join(chain_by_places(first, last, tolerance), rods_[first].fibre);
    else
      check_ends(first, last);
    first = last;
  }
  return joints;
}

// Each frame is its predecessor's, swung and not twisted; what a ring is short of in the end is shared
// by all its joints. A rod's turn about its own axis is no one else's concern.
void FibreChains::bring_frames_along(const Chain &chain)
{
  const int count = static_cast<int>(chain.rods.size());
  for (int k = 1; k < count; k++) {
    const JointedRod &before = rods_[chain.rods[k - 1]].pose;
    Quaternion &q = rods_[chain.rods[k]].pose.orientation;
    q = normalized(swing(before.axis(), axis_of(q)) * before.orientation);
  }
  if (!chain.is_ring) return;
  const double twist =
      joint_deformation(rods_[chain.rods.back()].pose, rods_[chain.rods.front()].pose).twist;
  for (int k = 1; k < count; k++) {
    Quaternion &q = rods_[chain.rods[k]].pose.orientation;
    q = normalized(q * rotation_about({0.0, 0.0, 1.0}, twist * k / count));
  }
}

int FibreChains::join(const Chain &chain, int fibre)
{
  const int count = static_cast<int>(chain.rods.size());
  const int joints = chain.is_ring ? count : count - 1;
  segments_.changes++;
  const auto rod = [&](int k) -> Rod & { return rods_[chain.rods[k % count]]; };
  for (int k = 0; k < joints; k++) check_can_join(chain.rods[k], chain.rods[(k + 1) % count]);
  bring_frames_along(chain);
  for (int k = 0; k < count; k++) {
    rod(k).fibre = fibre;
    rod(k).place = k + 1;
    rod(k).ends = 0;
  }
  for (int k = 0; k < joints; k++) {
    rod(k).ends |= S::kHeadJoined | S::kHeadShared;
    rod(k + 1).ends |= S::kTailJoined | S::kTailShared;
  }
  if (chain.is_ring) {
    rod(count - 1).ends |= S::kHeadCloses;
    rod(0).ends |= S::kTailCloses;
  }
  for (int k = 0; k + 1 < joints; k++)  // rod k + 1 lies between
    if (rod(k + 1).pose.half_length < rod(k + 1).radius) {
      const bool across = k + 2 >= count;
      rod(k).ends |= across ? S::kHeadPassesRing : S::kHeadPasses;
      rod(k + 2).ends |= across ? S::kTailPassesRing : S::kTailPasses;
    }
  if (chain.is_ring && rod(0).pose.half_length < rod(0).radius) {
    rod(count - 1).ends |= S::kHeadPassesRing;
    rod(1).ends |= S::kTailPassesRing;
  }
  for (int k = 0; k < count; k++) put_back(rod(k));
  return joints;
}

// Of each end, 2 k the tail of rod k and 2 k + 1 its head, the other that it meets; -1: none.
std::vector<int> FibreChains::partners_of_ends(double tolerance) const
{
  double reach = 0.0;
  for (const Rod &rod : rods_) reach = std::max(reach, tolerance * 2.0 * rod.radius);
  std::vector<int> partners(2 * rods_.size(), -1);
  if (rods_.empty()) return partners;

  // Cells a little wider than the reach, a whole number of them in a period.
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  double width[3];
  int64_t cells[3];
  for (int d = 0; d < 3; d++) {
    cells[d] = std::max<int64_t>(1, static_cast<int64_t>(domain->prd[d] / (1.001 * reach)));
    cells[d] = std::min<int64_t>(cells[d], 1 << 20);
    width[d] = domain->prd[d] / static_cast<double>(cells[d]);
  }
  const auto key_of = [&](const Vec3 &x, const int(&shift)[3]) {
    const double at[3] = {x.x, x.y, x.z};
    int64_t key = 0;
    for (int d = 0; d < 3; d++) {
      int64_t cell =
          static_cast<int64_t>(std::floor((at[d] - domain->boxlo[d]) / width[d])) + shift[d];
      if (periodic[d]) cell = ((cell % cells[d]) + cells[d]) % cells[d];
      key = key * ((1 << 20) + 7) + cell;
    }
    return key;
  };
  std::unordered_map<int64_t, std::vector<int>> in_cell;
  const int ends = static_cast<int>(partners.size());
  for (int e = 0; e < ends; e++) in_cell[key_of(end_of(e / 2, e % 2), {0, 0, 0})].push_back(e);

  for (int e = 0; e < ends; e++)
    for (int box = 0; box < 27; box++) {
      const int shift[3] = {box % 3 - 1, box / 3 % 3 - 1, box / 9 - 1};
      const auto found = in_cell.find(key_of(end_of(e / 2, e % 2), shift));
      if (found == in_cell.end()) continue;
      for (const int other : found->second) {
        if (other / 2 == e / 2 || other == partners[e]) continue;
        if (gap(e / 2, e % 2, other / 2, other % 2) > tolerance * 2.0 * rods_[e / 2].radius)
          continue;
        if (partners[e] >= 0)
          rod_error_all(lmp,
                        "%s: the ends of rods %d, %d and %d meet within %g diameters; wanted two "
                        "at a joint",
                        who_.c_str(), rods_[e / 2].id, rods_[partners[e] / 2].id,
                        rods_[other / 2].id, tolerance);
        partners[e] = other;
      }
    }
  for (int e = 0; e < ends; e++)
    if (partners[e] >= 0) partners[partners[e]] = e;
  return partners;
}

// The chain that begins at the tail or head of rod `start` and leaves it by the other end; 0 joints if
// it has none.
int FibreChains::walk(const std::vector<int> &partners, int start, int fibre,
                      std::vector<char> &is_done)
{
  Chain chain;
  int rod = start;
  int way_in = partners[2 * start] < 0 || partners[2 * start + 1] >= 0 ? 2 * start : 2 * start + 1;
  for (;;) {
    is_done[rod] = 1;
    chain.rods.push_back(rod);
    const int way_out = way_in ^ 1;
    if (way_in % 2) flip(rod);
    const int next = partners[way_out];
    if (next < 0) break;
    if (next / 2 == start) {
      chain.is_ring = true;
      break;
    }
    way_in = next;
    rod = next / 2;
  }
  if (chain.rods.size() == 2 && chain.is_ring)
    rod_error_all(lmp, "%s: rods %d and %d meet at both their ends", who_.c_str(),
                  rods_[chain.rods[0]].id, rods_[chain.rods[1]].id);
  return chain.rods.size() == 1 ? 0 : join(chain, fibre);
}

int FibreChains::join_meeting_ends(int groupbit, double tolerance)
{
  const int highest = highest_fibre(lmp, segments_);
  gather([&](int i) { return (atom->mask[i] & groupbit) && !segments_.is_segment(i); });
  const std::vector<int> partners = partners_of_ends(tolerance);
  std::vector<char> is_done(rods_.size(), 0);
  int joints = 0, fibre = highest;
  const auto number_of_partners = [&](int k) {
    return (partners[2 * k] >= 0) + (partners[2 * k + 1] >= 0);
  };
  for (const int wanted : {1, 2})  // chains from an end, then rings
    for (int k = 0; k < static_cast<int>(rods_.size()); k++)
      if (!is_done[k] && number_of_partners(k) == wanted)
        joints += walk(partners, k, ++fibre, is_done);
  return joints;
}

template <typename Rest>
void FibreChains::give_rest_by(Rest rest)
{
  const auto lacks_rest = [&](int ends) {
    return (ends & S::kHeadJoined) != 0 && (ends & S::kRestGiven) == 0;
  };
  int mine = 0, any = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (segments_.is_segment(i) && lacks_rest(segments_.ends(i))) mine = 1;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;
  gather([&](int i) { return segments_.is_segment(i); });
  size_t first = 0;
  for (size_t k = 0; k < rods_.size(); k++) {
    if (rods_[k].fibre != rods_[first].fibre) first = k;
    if (!lacks_rest(rods_[k].ends)) continue;
    const Rod &next = rods_[rods_[k].ends & S::kHeadCloses ? first : k + 1];
    rods_[k].rest = rest(rods_[k].pose, next.pose);
    rods_[k].ends |= S::kRestGiven;
    put_back(rods_[k]);
  }
}

// Angles do not depend on where the rods are.
void FibreChains::give_present_rest()
{
  give_rest_by([](const JointedRod &first, const JointedRod &second) {
    const JointDeformation d = joint_deformation(first, second);
    return JointRest{d.bend_x, d.bend_y, d.twist};
  });
}

// A turn about body y goes from the axis towards body x.
void FibreChains::give_rest(double curvature, double twist)
{
  give_rest_by([=](const JointedRod &first, const JointedRod &second) {
    const double length = first.half_length + second.half_length;
    return JointRest{0.0, curvature * length, twist * length};
  });
}

FibreChains::Periods FibreChains::periods_between(const Vec3 &a, const Vec3 &b) const
{
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  double way[3];
  store(b - a, way);
  Periods periods;
  for (int d = 0; d < 3; d++)
    if (periodic[d]) periods.number[d] = static_cast<int>(std::lround(way[d] / domain->prd[d]));
  return periods;
}

std::vector<FibreChains::Periods> FibreChains::periods_beyond_first()
{
  gather([&](int i) { return segments_.is_segment(i); });
  std::vector<Periods> mine(atom->nlocal);
  Periods sum;
  size_t first = 0;  // of the fibre
  for (size_t k = 0; k < rods_.size(); k++) {
    if (rods_[k].fibre != rods_[first].fibre) first = k;
    const bool follows = k > first && (rods_[k].ends & S::kTailJoined);
    const Periods step = follows ? periods_between(end_of(static_cast<int>(k) - 1, true),
                                                   end_of(static_cast<int>(k), false))
                                 : Periods();
    for (int d = 0; d < 3; d++) sum.number[d] = follows ? sum.number[d] + step.number[d] : 0;
    if (rods_[k].rank == me_) mine[rods_[k].local] = sum;
    if (!(rods_[k].ends & S::kHeadCloses)) continue;
    const Periods last =
        periods_between(end_of(static_cast<int>(k), true), end_of(static_cast<int>(first), false));
    for (int d = 0; d < 3; d++)
      if (sum.number[d] + last.number[d] != 0)
        rod_error_all(
            lmp,
            "%s: fibre %d is a ring that goes round the periodic box along %c; wanted rings "
            "that close beside themselves",
            who_.c_str(), rods_[k].fibre, "xyz"[d]);
  }
  return mine;
}

int FibreChains::cut_lost_joints()
{
  gather([&](int i) { return segments_.is_segment(i); });
  const auto is_there = [&](int fibre, int place) {
    const auto found = std::lower_bound(rods_.begin(), rods_.end(), std::make_pair(fibre, place),
                                        [](const Rod &rod, const std::pair<int, int> &wanted) {
                                          return std::make_pair(rod.fibre, rod.place) < wanted;
                                        });
    return found != rods_.end() && found->fibre == fibre && found->place == place;
  };
  const auto has_last = [&](int fibre) {
    return std::any_of(rods_.begin(), rods_.end(), [&](const Rod &rod) {
      return rod.fibre == fibre && (rod.ends & S::kHeadCloses);
    });
  };
  segments_.changes++;
  int cut = 0;
  for (const Rod &rod : rods_) {
    Rod now = rod;
    if ((rod.ends & S::kHeadJoined) &&
        !is_there(rod.fibre, rod.ends & S::kHeadCloses ? 1 : rod.place + 1))
      now.ends &= ~(S::kHeadJoined | S::kHeadCloses);
    if ((rod.ends & S::kTailJoined) &&
        !(rod.ends & S::kTailCloses ? has_last(rod.fibre) : is_there(rod.fibre, rod.place - 1)))
      now.ends &= ~(S::kTailJoined | S::kTailCloses);
    if (now.ends == rod.ends) continue;
    cut += ((rod.ends ^ now.ends) & S::kHeadJoined) != 0;
    cut += ((rod.ends ^ now.ends) & S::kTailJoined) != 0;
    put_back(now);
  }
  return cut;
}
