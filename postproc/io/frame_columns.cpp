// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/frame_columns.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/input_error.h"

namespace spherocylinder {

std::size_t need_column(const DumpFrame &frame, std::string_view name, std::string_view instead)
{
  if (const auto column = frame.find_column(name)) return *column;
  throw InputError(fmt::format("{}:{}: column '{}' is missing{}{}", frame.path, frame.header_line,
                               name, instead.empty() ? "" : ", wanted it or ", instead));
}

PlaceColumns::PlaceColumns(const DumpFrame &frame)
    : frame_(frame), coordinates_{find(frame, 0), find(frame, 1), find(frame, 2)}
{
}

PlaceColumns::Coordinate PlaceColumns::find(const DumpFrame &frame, int direction)
{
  const std::string plain(1, "xyz"[direction]);
  for (const auto &name : {plain, plain + "u"})
    if (const auto column = frame.find_column(name)) return {*column, 0.0, 1.0};
  for (const auto &name : {plain + "s", plain + "su"}) {
    const auto column = frame.find_column(name);
    if (!column) continue;
    if (frame.box_is_tilted)
      throw InputError(fmt::format("{}:{}: column '{}' scaled by a tilted box, wanted '{}'",
                                   frame.path, frame.header_line, name, plain));
    const auto [low, high] = frame.box[direction];
    return {*column, low, high - low};
  }
  return {need_column(frame, plain), 0.0, 1.0};
}

double PlaceColumns::of(std::size_t row, int direction) const
{
  const Coordinate &c = coordinates_[direction];
  return c.offset + c.scale * frame_.value(row, c.column);
}

Vec3 PlaceColumns::of(std::size_t row) const { return {of(row, 0), of(row, 1), of(row, 2)}; }

VectorColumns::VectorColumns(const DumpFrame &frame, const std::array<std::string, 3> &names)
    : frame_(frame)
{
  const auto is_there = [&](const std::string &name) {
    return frame.find_column(name).has_value();
  };
  if (std::none_of(names.begin(), names.end(), is_there)) return;
  columns_.emplace();
  for (int d = 0; d < 3; d++) (*columns_)[d] = need_column(frame, names[d]);
}

Vec3 VectorColumns::of(std::size_t row) const
{
  if (!columns_) return {0.0, 0.0, 0.0};
  const auto &c = *columns_;
  return {frame_.value(row, c[0]), frame_.value(row, c[1]), frame_.value(row, c[2])};
}

namespace {

int significant_digits(double number)
{
  const std::string text = fmt::format("{}", std::abs(number));
  std::string digits;
  for (const char c : text.substr(0, text.find('e')))
    if (c != '.') digits += c;
  const auto first = digits.find_first_not_of('0');
  if (first == std::string::npos) return 0;
  return static_cast<int>(digits.find_last_not_of('0') - first) + 1;
}

}  // namespace

int digits_of_column(const DumpFrame &frame, std::size_t column)
{
  constexpr std::size_t kRowsLookedAt = 1000;
  int digits = 0;
  for (std::size_t row = 0; row < std::min(frame.rows, kRowsLookedAt); row++)
    digits = std::max(digits, significant_digits(frame.value(row, column)));
  return digits;
}

}  // namespace spherocylinder
