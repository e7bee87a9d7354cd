// SPDX-License-Identifier: GPL-2.0-or-later
// The tree against asking every box.
#include "core/box_tree.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "test_support.h"

using namespace spherocylinder;

namespace {

std::vector<int> by_trying_all(const std::vector<Box> &boxes, const Box &wanted)
{
  std::vector<int> found;
  for (size_t k = 0; k < boxes.size(); k++)
    if (boxes[k].meets(wanted)) found.push_back(static_cast<int>(k));
  return found;
}

std::vector<int> by_tree(const BoxTree &tree, const Box &wanted)
{
  std::vector<int> found;
  tree.find(wanted, found);
  std::sort(found.begin(), found.end());
  return found;
}

// Points, flat ones and large ones; whole coordinates now and then, so that some just touch.
Box random_box(RandomRods &random)
{
  const auto whole = [](const Vec3 &a) -> Vec3 {
    return {std::round(a.x), std::round(a.y), std::round(a.z)};
  };
  const Vec3 at = random.vector(10.0), size = random.vector(random.log_uniform(1e-3, 5.0));
  switch (random.below(4)) {
    case 0: return around(at, at);
    case 1: return around(whole(at), whole(at + size));
    case 2: return around(at, at + Vec3{size.x, 0.0, size.z});
    default: return around(at, at + size);
  }
}

std::vector<Box> random_boxes(RandomRods &random, int count)
{
  std::vector<Box> boxes;
  for (int k = 0; k < count; k++) boxes.push_back(random_box(random));
  return boxes;
}

void expect_all_once(const BoxTree &tree, const std::vector<Box> &boxes, RandomRods &random)
{
  for (int k = 0; k < 200; k++) {
    const Box wanted = random_box(random);
    const std::vector<int> found = by_tree(tree, wanted), slow = by_trying_all(boxes, wanted);
    ASSERT_TRUE(std::includes(found.begin(), found.end(), slow.begin(), slow.end()));
    ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
  }
}

}  // namespace

// Independent slow method. None is missed or named twice, whatever the number of boxes, also when
// all of them have moved anywhere else.
TEST(BoxTree, MissesNoBox)
{
  RandomRods random(15485863);
  for (const int count : {1, 2, 3, 4, 5, 8, 9, 17, 100, 1000}) {
    const std::vector<Box> boxes = random_boxes(random, count);
    BoxTree tree(boxes);
    expect_all_once(tree, boxes, random);
    const std::vector<Box> others = random_boxes(random, count);
    tree.move_to(others);
    expect_all_once(tree, others, random);
  }
}

// Independent slow method: those that meet the wanted one, no others.
TEST(BoxTree, FindsNoOtherBox)
{
  RandomRods random(15487469);
  const std::vector<Box> boxes = random_boxes(random, 1000);
  const BoxTree tree(boxes);
  size_t others = 0;
  for (int k = 0; k < 1000; k++) {
    const Box wanted = random_box(random);
    others += by_tree(tree, wanted).size() - by_trying_all(boxes, wanted).size();
  }
  EXPECT_EQ(others, 0u);
}

TEST(BoxTree, OfNoBoxesFindsNone)
{
  std::vector<int> found = {7};
  BoxTree().find(around({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}), found);
  BoxTree tree(std::vector<Box>{});
  tree.move_to({});
  tree.find(around({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}), found);
  EXPECT_EQ(found, std::vector<int>{7});  // what was there stays
}

// Boxes at one place cannot be halved by their middles.
TEST(BoxTree, OfEqualBoxesFindsAll)
{
  const Box box = around({1.0, 2.0, 3.0}, {2.0, 3.0, 4.0});
  const BoxTree tree(std::vector<Box>(100, box));
  EXPECT_EQ(by_tree(tree, around({2.0, 3.0, 4.0}, {5.0, 5.0, 5.0})).size(), 100u);  // a corner
  EXPECT_EQ(by_tree(tree, around({2.1, 3.0, 4.0}, {5.0, 5.0, 5.0})).size(), 0u);
}

// Closed form, read off the coordinates.
TEST(Box, AroundUnitedWidened)
{
  const Box box = around({1.0, -2.0, 3.0}, {0.0, 2.0, 3.0});
  EXPECT_EQ(box.low.x, 0.0);
  EXPECT_EQ(box.high.y, 2.0);
  EXPECT_EQ(box.low.z, box.high.z);
  const Box wide = widened(box, 0.5);
  EXPECT_EQ(wide.low.z, 2.5);
  EXPECT_EQ(wide.high.z, 3.5);
  const Box both = united(box, around({5.0, 0.0, 0.0}, {6.0, 0.0, 0.0}));
  EXPECT_EQ(both.low.y, -2.0);
  EXPECT_EQ(both.high.x, 6.0);
  EXPECT_EQ(both.low.z, 0.0);
}
