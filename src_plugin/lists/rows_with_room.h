// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

namespace LAMMPS_NS {

// Rows that stand one after the other in arrays, each with some room behind it: where a row begins
// and how long it is. A row that outgrows its room goes to the end; its old place stays empty until all
// rows are laid anew.
class RowsWithRoom {
 public:
  // No rows; places are given again from the first on.
  void clear(int rows)
  {
    rows_.assign(rows, {});
    end_ = 0;
  }

  int rows() const { return static_cast<int>(rows_.size()); }
  int first(int row) const { return rows_[row].first; }
  int count(int row) const { return rows_[row].count; }
  // Of all arrays, the length that is needed.
  int end() const { return end_; }

  // Gives the row this length. True if it begins in another place, where nothing of it is yet.
  bool set_count(int row, int count)
  {
    Row &own = rows_[row];
    own.count = count;
    if (count <= own.room) return false;
    own.first = end_;
    own.room = count + kRoom + (own.room > 0 ? count / 2 : 0);
    end_ += own.room;
    return true;
  }

 private:
  static constexpr int kRoom = 2;
  struct Row {
    int first = 0, count = 0, room = 0;
  };
  std::vector<Row> rows_;
  int end_ = 0;
};

// Of each number, those that have it in their rows, in no order.
class Holders {
 public:
  void clear(int numbers)
  {
    rows_.clear(numbers);
    holders_.clear();
  }

  void add(int number, int holder)
  {
    const int n = rows_.count(number), first = rows_.first(number);
    if (rows_.set_count(number, n + 1)) {
      holders_.resize(rows_.end());
      for (int k = 0; k < n; k++) holders_[rows_.first(number) + k] = holders_[first + k];
    }
    holders_[rows_.first(number) + n] = holder;
  }

  void remove(int number, int holder)
  {
    int *own = holders_.data() + rows_.first(number);
    const int last = rows_.count(number) - 1;
    int k = 0;
    while (k < last && own[k] != holder) k++;
    own[k] = own[last];
    rows_.set_count(number, last);
  }

  const int *begin(int number) const { return holders_.data() + rows_.first(number); }
  const int *end(int number) const { return begin(number) + rows_.count(number); }

 private:
  RowsWithRoom rows_;
  std::vector<int> holders_;
};

}  // namespace LAMMPS_NS
