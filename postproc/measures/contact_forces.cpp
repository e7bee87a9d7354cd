// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/contact_forces.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "io/input_error.h"
#include "io/text.h"
#include "measures/mean_with_error.h"

namespace spherocylinder {
namespace {

struct Keyword {
  std::string_view name;
  std::size_t columns;  // 0: as many as the contact models have
};

// In the order of the columns, whatever that of the keywords
// (docs/compute_gran_local_spherocylinder.md).
constexpr std::array<Keyword, 15> kAllKeywords{{{"pos", 6},
                                                {"vel", 6},
                                                {"id", 3},
                                                {"force", 3},
                                                {"force_normal", 3},
                                                {"force_tangential", 3},
                                                {"torque", 3},
                                                {"torque_normal", 3},
                                                {"torque_tangential", 3},
                                                {"history", 0},
                                                {"contactArea", 1},
                                                {"delta", 1},
                                                {"contactPoint", 3},
                                                {"ms_id", 2},
                                                {"normal", 3}}};

std::set<std::string_view> words_of(std::string_view text)
{
  std::set<std::string_view> words;
  for (auto word = take_word(text); !word.empty(); word = take_word(text)) words.insert(word);
  return words;
}

// Number of the keyword's first column, from 1. History comes behind id and force, so that its
// length does not matter.
std::size_t first_column(const std::set<std::string_view> &words, std::string_view name)
{
  std::size_t column = 1;
  for (const Keyword &keyword : kAllKeywords) {
    if (keyword.name == name) break;
    if (words.count(keyword.name)) column += keyword.columns;
  }
  return column;
}

// K of a column c_ID[K], and its ID.
struct ComputeColumn {
  std::string_view id;
  std::size_t number;
};

std::optional<ComputeColumn> compute_column(std::string_view name)
{
  const auto open = name.find('[');
  if (name.substr(0, 2) != "c_" || open == std::string_view::npos || name.back() != ']')
    return std::nullopt;
  const auto number = to_number<std::size_t>(name.substr(open + 1, name.size() - open - 2));
  if (!number) return std::nullopt;
  return ComputeColumn{name.substr(2, open - 2), *number};
}

// Sets of rods, each named after one of its own (union-find with path halving).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t find(std::uint32_t k)
  {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }

  void join(std::uint32_t a, std::uint32_t b)
  {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

LocalForces::LocalForces(const std::string &path, LocalKind kind, const std::string &keywords,
                         const std::string &option)
    : kind_(kind), option_(option), reader_(path, DumpKind::Entries)
{
  const auto words = words_of(keywords);
  for (const std::string_view word : words)
    if (std::none_of(kAllKeywords.begin(), kAllKeywords.end(),
                     [&](const Keyword &keyword) { return keyword.name == word; }))
      throw InputError(fmt::format("{}: {} is no keyword of compute {}/gran/local", option,
                                   shown(word), kind == LocalKind::Pairs ? "pair" : "wall"));
  for (const char *wanted : {"id", "force"})
    if (!words.count(wanted))
      throw InputError(
          fmt::format("{}: '{}' is not among {}, wanted it", option, wanted, shown(keywords)));
  id_ = first_column(words, "id");
  force_ = first_column(words, "force");
}

// Where the frame has the columns `first` + 0, 1, ... of the compute.
std::vector<std::size_t> LocalForces::columns_of(std::size_t first, std::size_t count,
                                                 const char *what) const
{
  constexpr auto kNowhere = static_cast<std::size_t>(-1);
  std::vector<std::size_t> found(count, kNowhere);
  std::string_view id;
  for (std::size_t k = 0; k < frame_.columns.size(); k++) {
    const auto column = compute_column(frame_.columns[k]);
    if (!column) continue;
    if (!id.empty() && id != column->id)
      throw InputError(fmt::format("{}:{}: columns of two computes, {} and {}, wanted those of one",
                                   frame_.path, frame_.header_line, id, column->id));
    id = column->id;
    if (column->number >= first && column->number < first + count)
      found[column->number - first] = k;
  }
  for (std::size_t k = 0; k < count; k++)
    if (found[k] == kNowhere)
      throw InputError(fmt::format("{}:{}: column c_ID[{}] is missing, wanted the {} (by {})",
                                   frame_.path, frame_.header_line, first + k, what, option_));
  return found;
}

std::uint32_t LocalForces::rod_of(std::size_t row, std::size_t column,
                                  const std::unordered_map<std::int64_t, std::uint32_t> &rods,
                                  const DumpFrame &rods_frame) const
{
  const double id = frame_.value(row, column);
  const auto found = rods.find(static_cast<std::int64_t>(id));
  if (found == rods.end() || static_cast<double>(found->first) != id)
    throw InputError(fmt::format(
        "{}:{}: id {} is none of the rods of step {} of {} (do the keywords "
        "of {} fit?)",
        frame_.path, frame_.line_of(row), id, rods_frame.step, rods_frame.path, option_));
  return found->second;
}

std::vector<ContactForce> LocalForces::at_step(const DumpFrame &rods_frame,
                                               const std::vector<Rod> &rods)
{
  do {
    if (!reader_.next(frame_) || frame_.step > rods_frame.step)
      throw InputError(fmt::format("{}: holds no step {}, which {} has", frame_.path,
                                   rods_frame.step, rods_frame.path));
  } while (frame_.step < rods_frame.step);

  std::unordered_map<std::int64_t, std::uint32_t> index;
  for (std::uint32_t k = 0; k < rods.size(); k++) index[rods[k].id] = k;
  const auto ids = kind_ == LocalKind::Pairs ? columns_of(id_, 2, "rods' ids")
                                             : columns_of(id_ + 2, 1, "rod's id");
  const auto components = columns_of(force_, 3, "force");
  std::vector<ContactForce> forces;
  for (std::size_t row = 0; row < frame_.rows; row++) {
    const Vec3 force{frame_.value(row, components[0]), frame_.value(row, components[1]),
                     frame_.value(row, components[2])};
    if (kind_ == LocalKind::Walls) {
      const std::uint32_t rod = rod_of(row, ids[0], index, rods_frame);
      forces.push_back({rod, rod, force});
      continue;
    }
    const std::uint32_t i = rod_of(row, ids[0], index, rods_frame);
    const std::uint32_t j = rod_of(row, ids[1], index, rods_frame);
    if (i == j)
      throw InputError(fmt::format("{}:{}: ids {} and {} are one rod, wanted two", frame_.path,
                                   frame_.line_of(row), rods[i].id, rods[j].id));
    forces.push_back({i, j, force});
  }
  return forces;
}

ForceChains force_chains(std::size_t rods, const std::vector<ContactForce> &pairs, double factor)
{
  ForceChains chains{};
  chains.chain_of_rod.assign(rods, 0);
  if (pairs.empty()) return chains;
  chains.threshold = factor * mean_of(pairs, [](const auto &c) { return norm(c.force); }).mean;

  Sets sets(rods);
  for (const ContactForce &contact : pairs) {
    if (!(norm(contact.force) > chains.threshold)) continue;
    chains.strong++;
    sets.join(contact.i, contact.j);
  }
  std::vector<std::size_t> size(rods, 0);
  for (std::uint32_t k = 0; k < rods; k++) size[sets.find(k)]++;
  std::vector<std::uint32_t> heads;
  for (std::uint32_t k = 0; k < rods; k++)
    if (size[k] > 1) heads.push_back(k);
  std::stable_sort(heads.begin(), heads.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return size[a] > size[b]; });
  std::vector<std::uint32_t> number(rods, 0);
  for (const std::uint32_t head : heads) {
    chains.sizes.push_back(size[head]);
    number[head] = static_cast<std::uint32_t>(chains.sizes.size());
  }
  for (std::uint32_t k = 0; k < rods; k++) chains.chain_of_rod[k] = number[sets.find(k)];
  return chains;
}

}  // namespace spherocylinder
