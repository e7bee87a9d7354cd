// SPDX-License-Identifier: GPL-2.0-or-later
// Which of many boxes meet a given one.
#pragma once

#include <vector>

#include "core/vec3.h"

namespace spherocylinder {

// Parallel to the axes of space; low <= high in each.
struct Box {
  Vec3 low, high;

  bool meets(const Box &other) const
  {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
           other.low.y <= high.y && low.z <= other.high.z && other.low.z <= high.z;
  }
};

Box around(const Vec3 &a, const Vec3 &b);
Box united(const Box &a, const Box &b);
Box widened(const Box &box, double by);

// A binary tree of boxes, halved along the longest side. Boxes may move: the tree stays as it is and goes
// on being right, though slower the more they mix.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box> &boxes);

  // The same boxes elsewhere.
  void move_to(const std::vector<Box> &boxes);

  // Adds the numbers of all boxes that meet `wanted`, in no order of meaning, each once.
  void find(const Box &wanted, std::vector<int> &found) const;

 private:
  struct Node {
    Box box;
    int first, count;  // of leaves: in order_; else count is 0 and `first` the second child
  };
  std::vector<Node> nodes_;  // a node's first child follows it
  std::vector<int> order_;
  std::vector<Box> boxes_;  // in this order

  void build(const std::vector<Box> &boxes, int first, int count);
  void keep(const std::vector<Box> &boxes);
};

}  // namespace spherocylinder
