// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/rods.h"

#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "analysis/input_error.h"
#include "core/mass_properties.h"
#include "core/rotation.h"

namespace spherocylinder {
namespace {

std::size_t need_column(const DumpFrame &frame, std::string_view name)
{
  if (const auto column = frame.find_column(name)) return *column;
  throw InputError(
      fmt::format("{}:{}: column '{}' is missing", frame.path, frame.header_line, name));
}

// One coordinate of the centre: value = offset + scale * column.
struct Coordinate {
  std::size_t column;
  double offset, scale;
};

Coordinate find_coordinate(const DumpFrame &frame, int direction)
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

class RodColumns {
 public:
  explicit RodColumns(const DumpFrame &frame)
      : frame_(frame),
        id_(need_column(frame, "id")),
        type_(frame.find_column("type")),
        centre_{find_coordinate(frame, 0), find_coordinate(frame, 1), find_coordinate(frame, 2)},
        shapex_(need_column(frame, "shapex")),
        shapey_(frame.find_column("shapey")),
        shapez_(need_column(frame, "shapez")),
        quaternion_{need_column(frame, "quat1"), need_column(frame, "quat2"),
                    need_column(frame, "quat3"), need_column(frame, "quat4")}
  {
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
    constexpr double largest_type = 1e6;
    const double type = frame_.value(row, *type_);
    if (!(type >= 1.0 && type <= largest_type && type == std::floor(type)))
      fail(row, fmt::format("type is {}, wanted a whole number >= 1", type));
    return static_cast<int>(type);
  }

  double coordinate(std::size_t row, int direction) const
  {
    const Coordinate &c = centre_[direction];
    return c.offset + c.scale * frame_.value(row, c.column);
  }

  double half_length(std::size_t row, double radius) const
  {
    if (!(radius > 0.0)) fail(row, fmt::format("shapex is {}, wanted a radius > 0", radius));
    const double slack = length_rounding * radius;
    if (shapey_ && std::abs(frame_.value(row, *shapey_) - radius) > slack)
      fail(row, fmt::format("shapey is {}, wanted {} as shapex has (a rod is round)",
                            frame_.value(row, *shapey_), radius));
    const double half_total = frame_.value(row, shapez_);
    if (half_total < radius - slack)
      fail(row, fmt::format("shapez is {}, wanted at least shapex, {}", half_total, radius));
    return half_total <= radius + slack ? 0.0 : half_total - radius;
  }

  Vec3 axis(std::size_t row) const
  {
    const Quaternion q{frame_.value(row, quaternion_[0]), frame_.value(row, quaternion_[1]),
                       frame_.value(row, quaternion_[2]), frame_.value(row, quaternion_[3])};
    const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(std::abs(norm - 1.0) <= quaternion_norm_tolerance))
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
  std::array<Coordinate, 3> centre_;
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
  for (std::size_t row = 0; row < frame.rows; ++row) rods.push_back(columns.rod(row));
  return rods;
}

double elevation(const Vec3 &axis)
{
  return std::atan2(std::abs(axis.z), std::hypot(axis.x, axis.y));
}

double volume(const Capsule &capsule)
{
  return mass_properties(2.0 * capsule.radius, capsule.length(), 1.0).volume;
}

}  // namespace spherocylinder
