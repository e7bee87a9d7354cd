// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of random rods with surfaces of all kinds against slow methods, and what must not
// matter.
#include "core/surface_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>

#include <gtest/gtest.h>

#include "surface_contacts_support.h"
#include "surface_reference.h"

using namespace spherocylinder;

namespace {

constexpr int kPoses = 10000;  // of each surface, times ten surfaces

// Features are asked 1e-5 radii beyond their bounds, where a foot is hardly one: places that are
// nearer than this are one, distances are off by (1e-5 r)^2/(2 distance).
constexpr double kSeam = 1e-4;

struct Kind {
  const char *name;
  std::function<Mesh(RandomRods &)> make;
  int meshes;
};
void PrintTo(const Kind &kind, std::ostream *out) { *out << kind.name; }

const std::vector<Kind> &kinds()
{
  static const std::vector<Kind> all = {
      {"ConvexPolyhedra", [](RandomRods &r) { return hull_mesh(r, 4 + r.below(9)); }, 40},
      {"Cube",
       [](RandomRods &) {
         return box_mesh({1.0, 1.0, 1.0});
       },
       1},
      {"Brick",
       [](RandomRods &) {
         return box_mesh({1.0, 0.3, 0.4});
       },
       1},
      {"Plate",
       [](RandomRods &) {
         return box_mesh({1.0, 1.0, 0.05});
       },
       1},
      {"Step", [](RandomRods &) { return step_mesh(); }, 1},
      {"FreeTriangles", [](RandomRods &r) { return triangle_mesh(r); }, 40},
      {"Spike", [](RandomRods &) { return spike_mesh(); }, 1},
      {"Tube", [](RandomRods &) { return tube_mesh(16, 1.0, 0.1); }, 1},
      {"Waves", [](RandomRods &r) { return waves_mesh(r, 4, 0.2); }, 20},
      {"SteepWaves", [](RandomRods &r) { return waves_mesh(r, 4, 0.6); }, 20},
  };
  return all;
}

class ContactsOn : public testing::TestWithParam<Kind> {
 protected:
  // Calls with meshes, their surfaces (all edges sharp) and rods of lambda 1, 2, 10, 30 near them.
  void for_poses(
      int poses,
      const std::function<void(const Mesh &, const TriangleSurface &, const Capsule &)> &f)
  {
    const double aspect_ratios[] = {1.0, 2.0, 10.0, 30.0};
    for (int m = 0; m < GetParam().meshes; m++) {
      const Mesh mesh = GetParam().make(random_);
      const TriangleSurface surface(mesh, 0.0);
      for (int k = 0; k < poses / GetParam().meshes; k++) {
        const double radius = random_.log_uniform(0.02, 0.5);
        f(mesh, surface, rod_near(random_, mesh, radius, aspect_ratios[k % 4]));
      }
    }
  }

  RandomRods random_{104729};
};

bool is_of_end(const SurfaceContact &contact) { return contact.place != OnRod::kBetween; }
double sign_of(OnRod place) { return place == OnRod::kEndMinus ? -1.0 : 1.0; }

// Contacts of two runs as the same places with the same load, whatever the features are called; of
// poses near a seam, both are asked only for the same sum.
bool are_same(const Contacts &a, const Capsule &rod_a, const Contacts &b, const Capsule &rod_b,
              const std::function<Vec3(const Vec3 &)> &image, double tolerance)
{
  if (a.size() != b.size()) return false;
  const double ratio = rod_b.radius / rod_a.radius;
  std::vector<bool> used(b.size(), false);
  for (const SurfaceContact &one : a) {
    bool found = false;
    for (size_t k = 0; k < b.size() && !found; k++) {
      const SurfaceContact &other = b[k];
      found = !used[k] && one.place == other.place &&
              std::fabs(ratio * one.along - other.along) <= tolerance * rod_b.radius &&
              std::fabs(ratio * one.distance - other.distance) <= tolerance * rod_b.radius &&
              norm(image(one.normal) - other.normal) <= tolerance &&
              std::fabs(one.weight - other.weight) <= tolerance;
      if (found) used[k] = true;
    }
    if (!found) return false;
  }
  return true;
}

Vec3 as_it_is(const Vec3 &a) { return a; }

}  // namespace

// Independent slow method: golden section along the axis to each triangle. Only where the axis is
// nearest between its ends to an edge that an end touches too, may what the ends bear take its
// place.
TEST_P(ContactsOn, TheNearestIsAtTheDistanceOfTheAxis)
{
  Failures missing, wrong, superfluous;
  for_poses(kPoses / 20, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    const double r = rod.radius, slow = distance_of_axis(rod.segment, mesh, 1.1 * r);
    const Contacts contacts = contacts_of(rod, surface);
    double nearest = 1.1 * r, of_ends = 0.0;
    for (const SurfaceContact &contact : contacts) {
      nearest = std::min(nearest, contact.distance);
      if (is_of_end(contact) && contact.feature != OnSurface::kFace)
        of_ends += r - contact.distance;
    }
    const std::string pose = text_of(rod) + text_of(contacts) + "\nslow " + std::to_string(slow);
    if (slow > r * (1.0 + 1e-9)) superfluous.add(!contacts.empty(), pose);
    if (slow > r * (1.0 - 1e-9)) return;
    missing.add(contacts.empty(), pose);
    if (contacts.empty()) return;
    wrong.add(std::fabs(nearest - slow) > 1e-7 * r && !(nearest > slow && of_ends > r - slow),
              pose);
  });
  EXPECT_EQ(missing.count(), 0) << missing.text();
  EXPECT_EQ(wrong.count(), 0) << wrong.text();
  EXPECT_EQ(superfluous.count(), 0) << superfluous.text();
}

// Closed form: normal (p - q)/|p - q| of a point p of the axis and q of the surface, |p - q| <= r.
TEST_P(ContactsOn, EachIsAPlaceOfTheSurface)
{
  Failures wrong;
  for_poses(kPoses / 20, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    const double r = rod.radius, h = rod.segment.half_length;
    const Contacts contacts = contacts_of(rod, surface);
    bool all_right = true;
    for (const SurfaceContact &c : contacts) {
      const Vec3 p = c.on_axis(rod.segment), q = c.on_surface(rod.segment);
      const bool at_end = is_of_end(c) ? std::fabs(c.along - sign_of(c.place) * h) < 1e-12 * r
                                       : std::fabs(c.along) < h;
      const bool is_right = at_end && c.weight > 0.0 && c.weight <= 1.0 && c.distance > 0.0 &&
                            c.distance <= r && std::fabs(norm(c.normal) - 1.0) < 1e-12 &&
                            norm(p - q - c.distance * c.normal) < 1e-12 * (1.0 + h) &&
                            nearest_on_triangle(mesh[c.triangle], q).distance < 2e-5 * r;
      all_right = all_right && is_right;  // also false of a NaN
    }
    wrong.add(!all_right, text_of(rod) + text_of(contacts));
  });
  EXPECT_EQ(wrong.count(), 0) << wrong.text();
}

// Independent slow method: an end's contacts are the minima of the distance from its centre, but
// for faces that others hide from it, and places near which the axis comes nearer farther in.
TEST_P(ContactsOn, OfEndsAreTheMinimaOfTheDistance)
{
  Failures missing, twice, no_minimum, light;
  for_poses(kPoses, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    const double r = rod.radius, h = rod.segment.half_length;
    const Contacts contacts = contacts_of(rod, surface);
    const auto pose = [&] { return text_of(rod) + text_of(contacts); };
    for (const OnRod place : {OnRod::kEndMinus, OnRod::kEndPlus}) {
      if (h == 0.0 && place == OnRod::kEndPlus) continue;  // a sphere has one end
      const Vec3 end = rod.segment.at(sign_of(place) * h);
      for (const Nearest &minimum : minima_of_distance(mesh, end, r * (1.0 - 1e-9), kSeam * r)) {
        int found = 0;
        double weight = 0.0;
        for (const SurfaceContact &c : contacts)
          if (c.place == place && norm(c.on_surface(rod.segment) - minimum.point) < kSeam * r &&
              std::fabs(c.distance - minimum.distance) < 1e-7 * r) {
            found++;
            weight += c.weight;
          }
        // Where the axis comes nearer farther in, an end at an edge fades out.
        const bool comes_nearer = dot(end - minimum.point, sign_of(place) * rod.segment.axis) > 0.0;
        missing.add(found == 0 && !comes_nearer &&
                        sight_of(mesh, end, minimum.point, kSeam * r) == Sight::kFree,
                    pose);
        twice.add(found > 1, pose);
        light.add(found == 1 && !comes_nearer && weight != 1.0, pose);  // nothing is smooth here
      }
      std::vector<Nearest> all;
      for (const SurfaceContact &c : contacts) {
        if (c.place != place) continue;
        if (all.empty()) all = minima_of_distance(mesh, end, 1.1 * r, 1e-12);
        const auto is_it = [&](const Nearest &minimum) {
          return norm(c.on_surface(rod.segment) - minimum.point) < kSeam * r;
        };
        no_minimum.add(std::none_of(all.begin(), all.end(), is_it), pose);
      }
    }
  });
  EXPECT_EQ(missing.count(), 0) << missing.text();
  EXPECT_EQ(twice.count(), 0) << twice.text();
  EXPECT_EQ(light.count(), 0) << light.text();
  EXPECT_EQ(no_minimum.count(), 0) << no_minimum.text();
}

// Independent slow method: the end sees the foot of each contact of its with a face.
TEST_P(ContactsOn, OfEndsHaveNoFaceBehindAnother)
{
  Failures hidden;
  for_poses(kPoses / 10, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    const Contacts contacts = contacts_of(rod, surface);
    for (const SurfaceContact &c : contacts)
      if (c.feature == OnSurface::kFace)
        hidden.add(sight_of(mesh, c.on_axis(rod.segment), c.on_surface(rod.segment),
                            kSeam * rod.radius) == Sight::kHidden,
                   [&] { return text_of(rod) + text_of(contacts); });
  });
  EXPECT_EQ(hidden.count(), 0) << hidden.text();
}

// A rotation, a shift and a scale of both.
TEST_P(ContactsOn, FollowMotionAndScale)
{
  Failures differ;
  for_poses(kPoses / 20, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    const double scale = kDiameters[random_.below(5)], angle = random_.uniform(-kPi, kPi);
    const Vec3 about = random_.direction(), shift = random_.vector(3.0 * scale);
    const auto turn = [&](const Vec3 &a) { return turned(a, about, angle); };
    Mesh moved;
    for (const auto &[a, b, c] : mesh)
      moved.push_back({scale * turn(a) + shift, scale * turn(b) + shift, scale * turn(c) + shift});
    const Capsule image = {{scale * turn(rod.segment.centre) + shift,
                            RandomRods::unit(turn(rod.segment.axis)),
                            scale * rod.segment.half_length},
                           scale * rod.radius};
    const Contacts a = contacts_of(rod, surface),
                   b = contacts_of(image, TriangleSurface(moved, 0.0));
    differ.add(!are_same(a, rod, b, image, turn, 1e-9), text_of(rod) + text_of(a) + text_of(b));
    if (scale != 1.0) return;  // a surface moves as one body, which keeps its size
    TriangleSurface same = surface;
    same.move_to(moved);
    const Contacts c = contacts_of(image, same);
    differ.add(!are_same(b, image, c, image, as_it_is, 1e-9),
               "move_to " + text_of(rod) + text_of(b) + text_of(c));
  });
  EXPECT_EQ(differ.count(), 0) << differ.text();
}

// The order of the triangles, of their corners, and with it which side their normals are on.
TEST_P(ContactsOn, IgnoreOrderAndOrientation)
{
  Failures differ;
  for_poses(kPoses / 20, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    Mesh other = mesh;
    for (size_t k = other.size(); k > 1; k--)
      std::swap(other[k - 1], other[random_.below(static_cast<int>(k))]);
    for (Corners &corners : other) {
      if (random_.below(2)) std::swap(corners[0], corners[1]);
      std::rotate(corners.begin(), corners.begin() + random_.below(3), corners.end());
    }
    const Contacts a = contacts_of(rod, surface), b = contacts_of(rod, TriangleSurface(other, 0.0));
    differ.add(!are_same(a, rod, b, rod, as_it_is, 1e-9), text_of(rod) + text_of(a) + text_of(b));
  });
  EXPECT_EQ(differ.count(), 0) << differ.text();
}

// Nor which end is the positive one.
TEST_P(ContactsOn, IgnoreTheSignOfTheAxis)
{
  Failures differ;
  for_poses(kPoses / 20, [&](const Mesh &, const TriangleSurface &surface, const Capsule &rod) {
    if (rod.segment.half_length == 0.0) return;
    Capsule back = rod;
    back.segment.axis = -rod.segment.axis;
    const Contacts a = contacts_of(rod, surface);
    Contacts b = contacts_of(back, surface);
    for (SurfaceContact &contact : b) {
      contact.along = -contact.along;
      if (is_of_end(contact))
        contact.place = contact.place == OnRod::kEndMinus ? OnRod::kEndPlus : OnRod::kEndMinus;
    }
    differ.add(!are_same(a, rod, b, rod, as_it_is, 1e-9), text_of(rod) + text_of(a) + text_of(b));
  });
  EXPECT_EQ(differ.count(), 0) << differ.text();
}

// The same surface of smaller triangles: four for one, and four for each of these.
TEST_P(ContactsOn, IgnoreSubdivision)
{
  Failures differ, differ_again;
  for_poses(kPoses / 50, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    const Contacts a = contacts_of(rod, surface);
    const Mesh finer = four_for_one(mesh);
    const Contacts b = contacts_of(rod, TriangleSurface(finer, 0.0));
    differ.add(!are_same(a, rod, b, rod, as_it_is, 1e-9), text_of(rod) + text_of(a) + text_of(b));
    const Contacts c = contacts_of(rod, TriangleSurface(four_for_one(finer), 0.0));
    differ_again.add(!are_same(a, rod, c, rod, as_it_is, 1e-9),
                     text_of(rod) + text_of(a) + text_of(c));
  });
  EXPECT_EQ(differ.count(), 0) << differ.text();
  EXPECT_EQ(differ_again.count(), 0) << differ_again.text();
}

// Features farther from the axis than the radius may be given or not, with a memory or without.
TEST_P(ContactsOn, IgnoreFarFeatures)
{
  Failures differ, differ_later, differ_smooth;
  for_poses(kPoses / 30, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    const Contacts all = contacts_of(rod, surface), few = near_contacts_of(rod, surface, mesh);
    differ.add(!are_same(all, rod, few, rod, as_it_is, 0.0),
               text_of(rod) + text_of(all) + text_of(few));
    const Memory memory = memory_of(few);
    const Contacts all_later = contacts_of(rod, surface, memory),
                   few_later = near_contacts_of(rod, surface, mesh, memory);
    differ_later.add(!are_same(all_later, rod, few_later, rod, as_it_is, 0.0),
                     text_of(rod) + text_of(all_later) + text_of(few_later));
    const TriangleSurface smooth(mesh, 1.0);
    const Contacts all_smooth = contacts_of(rod, smooth, memory),
                   few_smooth = near_contacts_of(rod, smooth, mesh, memory);
    differ_smooth.add(!are_same(all_smooth, rod, few_smooth, rod, as_it_is, 0.0),
                      text_of(rod) + text_of(all_smooth) + text_of(few_smooth));
  });
  EXPECT_EQ(differ.count(), 0) << differ.text();
  EXPECT_EQ(differ_later.count(), 0) << "remembered, " << differ_later.text();
  EXPECT_EQ(differ_smooth.count(), 0) << "remembered, smooth, " << differ_smooth.text();
}

// A rod that stays where it is, with its own contacts as the memory of the last step.
TEST_P(ContactsOn, StayWhereTheRodStays)
{
  Failures differ, differ_smooth;
  for_poses(kPoses / 25, [&](const Mesh &mesh, const TriangleSurface &surface, const Capsule &rod) {
    const Contacts first = near_contacts_of(rod, surface, mesh),
                   second = near_contacts_of(rod, surface, mesh, memory_of(first));
    differ.add(!are_same(first, rod, second, rod, as_it_is, 0.0),
               text_of(rod) + text_of(first) + text_of(second));
    const TriangleSurface smooth(mesh, 1.0);
    const Contacts third = near_contacts_of(rod, smooth, mesh),
                   fourth = near_contacts_of(rod, smooth, mesh, memory_of(third));
    differ_smooth.add(!are_same(third, rod, fourth, rod, as_it_is, 0.0),
                      "smooth " + text_of(rod) + text_of(third) + text_of(fourth));
  });
  EXPECT_EQ(differ.count(), 0) << differ.text();
  EXPECT_EQ(differ_smooth.count(), 0) << differ_smooth.text();
}

INSTANTIATE_TEST_SUITE_P(Surfaces, ContactsOn, testing::ValuesIn(kinds()),
                         [](const auto &info) { return std::string(info.param.name); });
