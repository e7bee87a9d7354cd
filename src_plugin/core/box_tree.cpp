// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/box_tree.h"

#include <algorithm>
#include <numeric>

namespace spherocylinder {

namespace {

constexpr int kLeaf = 4;  // boxes of one

double middle(const Box &box, int axis) { return (&box.low.x)[axis] + (&box.high.x)[axis]; }

int longest_side(const Box &box)
{
  const Vec3 size = box.high - box.low;
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

Box around(const Vec3 &a, const Vec3 &b)
{
  return {{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
          {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

Box united(const Box &a, const Box &b)
{
  return {around(a.low, b.low).low, around(a.high, b.high).high};
}

Box widened(const Box &box, double by)
{
  const Vec3 all = {by, by, by};
  return {box.low - all, box.high + all};
}

BoxTree::BoxTree(const std::vector<Box> &boxes) : order_(boxes.size())
{
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes.empty()) build(boxes, 0, static_cast<int>(boxes.size()));
  keep(boxes);
}

void BoxTree::keep(const std::vector<Box> &boxes)
{
  boxes_.resize(boxes.size());
  for (size_t k = 0; k < order_.size(); k++) boxes_[k] = boxes[order_[k]];
}

void BoxTree::build(const std::vector<Box> &boxes, int first, int count)
{
  const size_t place = nodes_.size();
  Box all = boxes[order_[first]];
  for (int k = 1; k < count; k++) all = united(all, boxes[order_[first + k]]);
  nodes_.push_back({all, first, count});
  if (count <= kLeaf) return;

  const int axis = longest_side(all), half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [&](int a, int b) { return middle(boxes[a], axis) < middle(boxes[b], axis); });
  build(boxes, first, half);
  nodes_[place].first = static_cast<int>(nodes_.size());
  nodes_[place].count = 0;
  build(boxes, first + half, count - half);
}

void BoxTree::move_to(const std::vector<Box> &boxes)
{
  keep(boxes);
  for (size_t place = nodes_.size(); place-- > 0;) {  // children stand behind their node
    Node &node = nodes_[place];
    if (node.count == 0) {
      node.box = united(nodes_[place + 1].box, nodes_[node.first].box);
      continue;
    }
    node.box = boxes[order_[node.first]];
    for (int k = 1; k < node.count; k++) node.box = united(node.box, boxes[order_[node.first + k]]);
  }
}

void BoxTree::find(const Box &wanted, std::vector<int> &found) const
{
  if (nodes_.empty()) return;
  std::vector<int> open = {0};
  while (!open.empty()) {
    const int place = open.back();
    open.pop_back();
    const Node &node = nodes_[place];
    if (!node.box.meets(wanted)) continue;
    if (node.count == 0) {
      open.push_back(node.first);
      open.push_back(place + 1);
    } else {
      for (int k = node.first; k < node.first + node.count; k++)
        if (boxes_[k].meets(wanted)) found.push_back(order_[k]);
    }
  }
}

}  // namespace spherocylinder
