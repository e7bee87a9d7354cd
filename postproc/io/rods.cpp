// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/rods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/rotation.h"
#include "io/frame_columns.h"
#include "io/input_error.h"

namespace spherocylinder {
namespace {

// What is larger is no rod; volumes and grids would overflow.
constexpr double kLargestSize = 1e6;  // radius (m)
constexpr double kLargestAspectRatio = 1e6;

// Half a unit in the last of so many digits of a number.
double half_last_digit(int digits, double number)
{
  const double size = std::abs(number);
  return size > 0.0 ? 0.5 * std::pow(10.0, std::floor(std::log10(size)) + 1.0 - digits) : 0.0;
}

class RodColumns {
 public:
  explicit RodColumns(const DumpFrame &frame)
      : frame_(frame),
        id_(need_column(frame, "id")),
        type_(frame.find_column("type")),
        centre_(frame),
        shapex_(need_column(frame, "shapex")),
        shapey_(frame.find_column("shapey")),
        shapez_(need_column(frame, "shapez")),
        quaternion_{need_column(frame, "quat1"), need_column(frame, "quat2"),
                    need_column(frame, "quat3"), need_column(frame, "quat4")}
  {
  }

  std::vector<double> place_roundings(const std::vector<Rod> &rods) const
  {
    int digits = kLeastDigits, quaternion_digits = kLeastDigits;
    for (int d = 0; d < 3; d++)
      digits = std::max(digits, digits_of_column(frame_, centre_.column(d)));
    for (const std::size_t column : quaternion_)
      quaternion_digits = std::max(quaternion_digits, digits_of_column(frame_, column));
    const double turn = 4.0 * half_last_digit(quaternion_digits, 0.5);
    std::vector<double> roundings;
    for (std::size_t row = 0; row < rods.size(); row++) {
      double place = 0.0;
      for (int d = 0; d < 3; d++)
        place = std::max(place, centre_.scale(d) *
                                    half_last_digit(digits, frame_.value(row, centre_.column(d))));
      roundings.push_back(std::sqrt(3.0) * place + turn * rods[row].capsule.segment.half_length);
    }
    return roundings;
  }

  Rod rod(std::size_t row) const
  {
    const double radius = frame_.value(row, shapex_);
    return {static_cast<std::int64_t>(frame_.value(row, id_)),
            type_ ? type(row) : 1,
            {{{coordinate(row, 0), coordinate(row, 1), coordinate(row, 2)},
              axis(row),
              half_length(row, radius)},
             radius}};
  }

 private:
  int type(std::size_t row) const
  {
    constexpr double kLargestType = 1e6;
    const double type = frame_.value(row, *type_);
    if (!(type >= 1.0 && type <= kLargestType && type == std::floor(type)))
      fail(row, fmt::format("type is {}, wanted a whole number >= 1", type));
    return static_cast<int>(type);
  }

  double coordinate(std::size_t row, int direction) const
  {
    const double x = centre_.of(row, direction);
    if (!(std::abs(x) < kLargestPlace))
      fail(row, fmt::format("{} is {:g} m, wanted less than {:g} m", "xyz"[direction], x,
                            kLargestPlace));
    return x;
  }

  double half_length(std::size_t row, double radius) const
  {
    if (!(radius > 0.0)) fail(row, fmt::format("shapex is {}, wanted a radius > 0", radius));
    const double slack = kLengthRounding * radius;
    if (shapey_ && std::abs(frame_.value(row, *shapey_) - radius) > slack)
      fail(row, fmt::format("shapey is {}, wanted {} as shapex has (a rod is round)",
                            frame_.value(row, *shapey_), radius));
    const double half_total = frame_.value(row, shapez_);
    if (!(radius < kLargestSize && half_total < kLargestAspectRatio * radius))
      fail(row,
           fmt::format("shapex is {} and shapez {}, wanted less than {:g} m and an aspect ratio "
                       "below {:g}",
                       radius, half_total, kLargestSize, kLargestAspectRatio));
    if (half_total < radius - slack)
      fail(row, fmt::format("shapez is {}, wanted at least shapex, {}", half_total, radius));
    return half_total <= radius + slack ? 0.0 : half_total - radius;
  }

  Vec3 axis(std::size_t row) const
  {
    const Quaternion q{frame_.value(row, quaternion_[0]), frame_.value(row, quaternion_[1]),
                       frame_.value(row, quaternion_[2]), frame_.value(row, quaternion_[3])};
    const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(std::abs(norm - 1.0) <= kQuaternionNormTolerance))
      fail(row, fmt::format("the norm of quat1..4 is {:.6g}, wanted 1", norm));
    return axis_of(normalized(q));
  }

  [[noreturn]] void fail(std::size_t row, const std::string &what) const
  {
    throw InputError(fmt::format("{}:{}: rod {}: {}", frame_.path, frame_.line_of(row),
                                 frame_.value(row, id_), what));
  }

  const DumpFrame &frame_;
  std::size_t id_;
  std::optional<std::size_t> type_;
  PlaceColumns centre_;
  std::size_t shapex_;
  std::optional<std::size_t> shapey_;
  std::size_t shapez_;
  std::array<std::size_t, 4> quaternion_;
};

}  // namespace

std::vector<Rod> rods_of(const DumpFrame &frame)
{
  const RodColumns columns(frame);
  std::vector<Rod> rods;
  rods.reserve(frame.rows);
  for (std::size_t row = 0; row < frame.rows; row++) rods.push_back(columns.rod(row));
  return rods;
}

double largest_diameter(const std::vector<Rod> &rods)
{
  double diameter = 0.0;
  for (const Rod &rod : rods) diameter = std::max(diameter, 2.0 * rod.capsule.radius);
  return diameter;
}

std::vector<double> place_roundings(const DumpFrame &frame, const std::vector<Rod> &rods)
{
  return RodColumns(frame).place_roundings(rods);
}

}  // namespace spherocylinder
