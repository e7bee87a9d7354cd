// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/fibres.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "io/frame_columns.h"
#include "io/input_error.h"

namespace spherocylinder {
namespace {

constexpr const char *kFibreColumn = "f_fibres[1]", *kPlaceColumn = "f_fibres[2]",
                     *kEndsColumn = "f_fibres[3]";

// Of the ends (FibreSegments::kHeadJoined of the plug-in).
constexpr std::int64_t kHeadJoined = 2;

// A ring of two would need curved rods.
constexpr std::size_t kFewestInARing = 3;

// A row that is a segment.
struct Place {
  std::int64_t fibre, place;
  std::uint32_t rod;
};

class FibreColumns {
 public:
  FibreColumns(const DumpFrame &frame, const std::vector<Rod> &rods, const FibreOptions &options)
      : frame_(frame), rods_(rods)
  {
    if (!options.columns.empty()) {
      fibre_ = need_column(frame, options.columns[0]);
      place_ = need_column(frame, options.columns[1]);
      return;
    }
    const auto fibre = frame.find_column(kFibreColumn), place = frame.find_column(kPlaceColumn);
    if (!fibre && !place) return;
    fibre_ = need_column(frame, kFibreColumn);
    place_ = need_column(frame, kPlaceColumn);
    ends_ = frame.find_column(kEndsColumn);
  }

  bool are_there() const { return fibre_.has_value(); }

  // By fibre and place.
  std::vector<Place> places() const
  {
    std::vector<Place> found;
    for (std::uint32_t row = 0; row < rods_.size(); row++) {
      const std::int64_t fibre = whole_number(row, *fibre_, 0);
      if (fibre > 0) found.push_back({fibre, whole_number(row, *place_, 1), row});
    }
    std::sort(found.begin(), found.end(), [](const Place &a, const Place &b) {
      return std::pair(a.fibre, a.place) < std::pair(b.fibre, b.place);
    });
    for (std::size_t k = 1; k < found.size(); k++)
      if (found[k].fibre == found[k - 1].fibre && found[k].place == found[k - 1].place)
        fail(found[k].rod,
             fmt::format("is at place {} of fibre {}, where rod {} is too, wanted one at a place",
                         found[k].place, found[k].fibre, rods_[found[k - 1].rod].id));
    return found;
  }

  // Not known to be free: it may have broken, and the ends still meet.
  bool may_be_joined(std::uint32_t row) const
  {
    return !ends_ || (whole_number(row, *ends_, 0) & kHeadJoined) != 0;
  }

  [[noreturn]] void fail(std::uint32_t row, const std::string &what) const
  {
    throw InputError(
        fmt::format("{}:{}: rod {} {}", frame_.path, frame_.line_of(row), rods_[row].id, what));
  }

 private:
  std::int64_t whole_number(std::uint32_t row, std::size_t column, int least) const
  {
    constexpr double kLargest = 9007199254740992.0;  // 2^53: above, a double skips whole numbers
    const double value = frame_.value(row, column);
    if (!(value >= least && value < kLargest && value == std::floor(value)))
      fail(row, fmt::format("has {} {}, wanted a whole number >= {}", frame_.columns[column], value,
                            least));
    return static_cast<std::int64_t>(value);
  }

  const DumpFrame &frame_;
  const std::vector<Rod> &rods_;
  std::optional<std::size_t> fibre_, place_, ends_;
};

class Chains {
 public:
  Chains(const DumpFrame &frame, const std::vector<Rod> &rods, const FibreColumns &columns,
         double meet)
      : rods_(rods), columns_(columns), meet_(meet), roundings_(place_roundings(frame, rods))
  {
    for (int d = 0; d < 3; d++) {
      if (!frame.periodic[d]) continue;
      if (frame.box_is_tilted)
        throw InputError(
            fmt::format("{}: step {}: the periodic box is tilted, wanted an upright one for fibres",
                        frame.path, frame.step));
      side_[d] = frame.box[d][1] - frame.box[d][0];
    }
    found_.of_rod.assign(rods.size(), kNoFibre);
    found_.place_of_rod.assign(rods.size(), 0);
    found_.joints_of_rod.assign(rods.size(), {kNoJoint, kNoJoint});
  }

  Fibres find(const std::vector<Place> &places)
  {
    for (std::size_t begin = 0; begin < places.size();) {
      std::size_t end = begin;
      while (end < places.size() && places[end].fibre == places[begin].fibre) end++;
      add_chains({places.begin() + begin, places.begin() + end});
      begin = end;
    }
    return std::move(found_);
  }

 private:
  using Iterator = std::vector<Place>::const_iterator;

  // All parts of the fibre with these places.
  void add_chains(const std::vector<Place> &places)
  {
    const std::size_t first = found_.all.size();
    start(places[0]);
    for (std::size_t k = 1; k < places.size(); k++) {
      const Place &before = places[k - 1], &next = places[k];
      if (next.place != before.place + 1 || !join(before.rod, next.rod))
        start(next);
      else
        append(next);
    }
    const std::size_t parts = found_.all.size() - first;
    const bool closes = places[0].place == 1 && places.size() >= kFewestInARing &&
                        join(places.back().rod, places[0].rod);
    if (closes && parts == 1) found_.all.back().is_ring = true;
    // A ring that is cut somewhere: its last part goes on with its first.
    if (closes && parts > 1) put_last_before_first(first);
    if (found_.all.size() - first > 1) found_.parts += found_.all.size() - first;
    for (std::size_t f = first; f < found_.all.size(); f++)
      set_shifts(static_cast<std::uint32_t>(f));
  }

  void start(const Place &place) { found_.all.push_back({place.fibre, {place.rod}, {}}); }
  void append(const Place &place) { found_.all.back().segments.push_back(place.rod); }

  void put_last_before_first(std::size_t first)
  {
    std::vector<std::uint32_t> &head = found_.all[first].segments;
    std::vector<std::uint32_t> whole = std::move(found_.all.back().segments);
    whole.insert(whole.end(), head.begin(), head.end());
    head = std::move(whole);
    found_.all.pop_back();
  }

  void set_shifts(std::uint32_t fibre)
  {
    Fibre &chain = found_.all[fibre];
    Vec3 shift{0.0, 0.0, 0.0};
    for (std::size_t k = 0; k < chain.segments.size(); k++) {
      const std::uint32_t rod = chain.segments[k];
      if (k > 0) shift = shift + found_.joints[found_.joints_of_rod[rod][0]].shift;
      chain.shifts.push_back(shift);
      found_.of_rod[rod] = fibre;
      found_.place_of_rod[rod] = static_cast<std::uint32_t>(k);
    }
  }

  // Whether the head of i and the tail of j meet.
  bool join(std::uint32_t i, std::uint32_t j)
  {
    if (!columns_.may_be_joined(i)) return false;
    const Capsule &a = rods_[i].capsule, &b = rods_[j].capsule;
    const Vec3 head = head_of(a.segment), between = tail_of(b.segment) - head;
    const auto back = [&](double x, int d) {
      return side_[d] > 0.0 ? -side_[d] * std::round(x / side_[d]) : 0.0;
    };
    const Vec3 shift{back(between.x, 0), back(between.y, 1), back(between.z, 2)};
    const Vec3 apart = between + shift;
    if (!(norm(apart) <= 2.0 * meet_ * a.radius + roundings_[i] + roundings_[j])) return false;
    if (std::abs(a.radius - b.radius) > 2.0 * kLengthRounding * a.radius)
      columns_.fail(j, fmt::format("has the radius {}, its neighbour in a fibre, rod {}, has {}, "
                                   "wanted one radius",
                                   b.radius, rods_[i].id, a.radius));
    found_.joints_of_rod[i][1] = found_.joints_of_rod[j][0] =
        static_cast<std::int32_t>(found_.joints.size());
    found_.joints.push_back({i, j, head + 0.5 * apart, shift});
    return true;
  }

  const std::vector<Rod> &rods_;
  const FibreColumns &columns_;
  double meet_;
  std::vector<double> roundings_;
  std::array<double, 3> side_{};
  Fibres found_;
};

}  // namespace

bool Fibres::never_touch(std::uint32_t i, std::uint32_t j, const std::vector<Rod> &rods) const
{
  if (!are_there() || of_rod[i] == kNoFibre || of_rod[i] != of_rod[j]) return false;
  // The next of a rod over its tail or head.
  const auto next = [&](std::uint32_t rod, int end) {
    const std::int32_t joint = joints_of_rod[rod][end];
    return joint == kNoJoint ? rod : end == 0 ? joints[joint].i : joints[joint].j;
  };
  for (const int end : {0, 1}) {
    const std::uint32_t neighbour = next(i, end);
    if (neighbour == i) continue;
    if (neighbour == j) return true;
    const Capsule &between = rods[neighbour].capsule;
    if (between.segment.half_length < between.radius && next(neighbour, end) == j) return true;
  }
  return false;
}

Fibres fibres_of(const DumpFrame &frame, const std::vector<Rod> &rods, const FibreOptions &options)
{
  const FibreColumns columns(frame, rods, options);
  if (!columns.are_there()) return {};
  return Chains(frame, rods, columns, options.meet).find(columns.places());
}

Fibres fibres_among(const Fibres &fibres, const std::vector<std::size_t> &kept)
{
  if (!fibres.are_there()) return {};
  std::vector<std::uint32_t> place(fibres.of_rod.size(), kNoFibre);
  for (std::size_t k = 0; k < kept.size(); k++) place[kept[k]] = static_cast<std::uint32_t>(k);
  Fibres found;
  found.of_rod.assign(kept.size(), kNoFibre);
  found.place_of_rod.assign(kept.size(), 0);
  found.joints_of_rod.assign(kept.size(), {kNoJoint, kNoJoint});
  for (const FibreJoint &joint : fibres.joints) {
    const std::uint32_t i = place[joint.i], j = place[joint.j];
    if (i == kNoFibre || j == kNoFibre) continue;
    found.joints_of_rod[i][1] = found.joints_of_rod[j][0] =
        static_cast<std::int32_t>(found.joints.size());
    found.joints.push_back({i, j, joint.place, joint.shift});
  }
  for (const Fibre &fibre : fibres.all) {
    bool goes_on = false;
    for (std::size_t k = 0; k < fibre.segments.size(); k++) {
      const std::uint32_t rod = place[fibre.segments[k]];
      if (rod == kNoFibre) {
        goes_on = false;
        continue;
      }
      if (!goes_on) found.all.push_back({fibre.id, {}, {}});
      goes_on = true;
      found.of_rod[rod] = static_cast<std::uint32_t>(found.all.size()) - 1;
      found.place_of_rod[rod] = fibres.place_of_rod[fibre.segments[k]];
      found.all.back().segments.push_back(rod);
      found.all.back().shifts.push_back(fibre.shifts[k]);
    }
    if (goes_on && found.all.back().segments.size() == fibre.segments.size())
      found.all.back().is_ring = fibre.is_ring;
  }
  return found;
}

void need_no_fibres(const DumpFrame &frame, const std::vector<Rod> &rods,
                    const FibreOptions &options, const std::string &why)
{
  const FibreColumns columns(frame, rods, options);
  if (!columns.are_there()) return;
  const std::vector<Place> places = columns.places();
  if (!places.empty())
    throw InputError(fmt::format("{}: step {}: {} of its {} rods are segments of fibres, wanted "
                                 "none: {}",
                                 frame.path, frame.step, places.size(), rods.size(), why));
}

Vec3 tail_of(const Segment &segment) { return segment.at(-segment.half_length); }
Vec3 head_of(const Segment &segment) { return segment.at(segment.half_length); }

}  // namespace spherocylinder
