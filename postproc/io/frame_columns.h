// SPDX-License-Identifier: GPL-2.0-or-later
// Columns of a frame that atoms of every shape have: where they are found, and how many digits of
// them the dump holds.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/vec3.h"
#include "io/dump_frame.h"

namespace spherocylinder {

// Throws InputError if there is none. `instead`: what else would do, for the message.
std::size_t need_column(const DumpFrame &frame, std::string_view name,
                        std::string_view instead = "");

constexpr double kLargestPlace = 1e9;  // m; what is further away overflows volumes and grids

// Places: x y z, or xu yu zu, or xs ys zs or xsu ysu zsu scaled by the box, in this order of
// preference for each direction. Throws InputError if there is none, and for scaled ones in a
// tilted box.
class PlaceColumns {
 public:
  explicit PlaceColumns(const DumpFrame &frame);

  Vec3 of(std::size_t row) const;  // m; not looked at
  double of(std::size_t row, int direction) const;

  std::size_t column(int direction) const { return coordinates_[direction].column; }
  double scale(int direction) const { return coordinates_[direction].scale; }

 private:
  struct Coordinate {  // value = offset + scale * column
    std::size_t column;
    double offset, scale;
  };
  static Coordinate find(const DumpFrame &frame, int direction);

  const DumpFrame &frame_;
  std::array<Coordinate, 3> coordinates_;
};

// Three columns that are there together or not at all, else InputError.
class VectorColumns {
 public:
  VectorColumns(const DumpFrame &frame, const std::array<std::string, 3> &names);

  bool are_there() const { return columns_.has_value(); }
  Vec3 of(std::size_t row) const;  // zero if they are not there
  const std::array<std::size_t, 3> &columns() const { return *columns_; }

 private:
  const DumpFrame &frame_;
  std::optional<std::array<std::size_t, 3>> columns_;
};

constexpr int kLeastDigits = 6;  // LIGGGHTS's own

// Decimal digits that tell any number of a column from all others, zeros at either end left out:
// the most that one of the first thousand rows has.
int digits_of_column(const DumpFrame &frame, std::size_t column);

}  // namespace spherocylinder
