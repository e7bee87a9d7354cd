// SPDX-License-Identifier: GPL-2.0-or-later
// Fibres of a dump: what is joined, what is shared, bent and touched.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "cli/bed_packing.h"
#include "cli/mesh_packing.h"
#include "core/numbers.h"
#include "fibre_frames.h"
#include "io/fibres.h"
#include "io/input_error.h"
#include "measures/fibre_contacts.h"
#include "measures/fibre_measures.h"
#include "meshes.h"
#include "solid/capsule_measures.h"
#include "solid/overlap_volume.h"
#include "solid/shared_end.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

constexpr double kR = 0.005;

Bed bed_of(const DumpFrame &frame, const FibreBed &fibres)
{
  Bed bed{frame, fibres.rods, 0, fibres_of(frame, fibres.rods, {}), {}};
  bed.stretched = fibre_bodies(bed.rods, bed.fibres, Rings::Kept);
  return bed;
}

double ball() { return 4.0 / 3.0 * pi * kR * kR * kR; }

// Two segments of length h with this bend between them.
FibreBed bent_pair(double bend, double h)
{
  FibreBed fibre;
  fibre.add_chain(1, points_on_arc({0.1, 0.2, 0.3}, h, 2, bend), kR);
  return fibre;
}

std::string refusal(const FibreBed &fibres, const FibreOptions &options = {})
{
  try {
    fibres_of(fibres.frame(), fibres.rods, options);
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}

// Ball and wedges against the common body by sections, which knows nothing of joints.
TEST(Fibres, SharedEndIsTheCommonBody)
{
  for (const double bend : {0.0, 0.01, 0.1, 0.5, 1.0, 1.5, 2.2}) {
    const FibreBed fibre = bent_pair(bend, 10.0 * kR);
    const Capsule &a = fibre.rods[0].capsule, &b = fibre.rods[1].capsule;
    const BoundedVolume found = shared_end_volume(a, b), slow = overlap_volume(a, b, 1e-7);
    EXPECT_NEAR(found.value, slow.value, slow.error + 1e-9 * ball()) << bend;
  }
  const FibreBed line = bent_pair(0.0, 8.0 * kR);
  EXPECT_NEAR(shared_end_volume(line.rods[0].capsule, line.rods[1].capsule).value, ball(),
              1e-13 * ball());
}

// A bend of short segments has no closed form.
TEST(Fibres, SharpBendOfShortSegments)
{
  const FibreBed fibre = bent_pair(2.4, 1.5 * kR);
  const Capsule &a = fibre.rods[0].capsule, &b = fibre.rods[1].capsule;
  const BoundedVolume found = shared_end_volume(a, b), slow = overlap_volume(a, b, 1e-7);
  EXPECT_NEAR(found.value, slow.value, found.error + slow.error);
}

// Ends that are drawn apart, along the axis and across it.
TEST(Fibres, EndsApartAreWithinTheError)
{
  std::mt19937 random(15485863);
  std::uniform_real_distribution<double> size(-9.0, -1.0), bends(0.0, 1.0);
  for (const Vec3 &direction : random_directions(200, random)) {
    FibreBed fibre = bent_pair(bends(random), 8.0 * kR);
    Capsule &a = fibre.rods[0].capsule, &b = fibre.rods[1].capsule;
    b.segment.centre = b.segment.centre + std::pow(10.0, size(random)) * kR * direction;
    const BoundedVolume found = shared_end_volume(a, b), slow = overlap_volume(a, b, 1e-6);
    EXPECT_NEAR(found.value, slow.value, found.error + slow.error);
    EXPECT_LE(found.error, 1e-3 * kR * kR * kR);
  }
}

// The union of a bent fibre and its part above a plane through a joint, by counting points.
TEST(Fibres, BentFibreCountsItsSolidOnce)
{
  FibreBed fibre;
  fibre.add_chain(1, points_on_arc({0.0, 0.0, 0.0}, 4.0 * kR, 4, 0.6), kR);
  const DumpFrame frame = fibre.frame();
  const Bed bed = bed_of(frame, fibre);
  const double plane = fibre.rods[1].capsule.segment.at(2.0 * kR).z;
  PackingOptions options;
  options.region.emplace(-1.0, 1.0, -1.0, 1.0, plane, 1.0);
  const BedPacking found = measure_packing(bed, options);

  // Additive recurrence by the root of x^4 = x + 1, which fills a box evenly.
  constexpr int kPoints = 3'000'000;
  constexpr double kRoot = 1.2207440846057596;
  const Vec3 low{-1.5 * kR, -1.1 * kR, -1.5 * kR}, side{16.5 * kR, 2.2 * kR, 13.0 * kR};
  const auto part = [](int k, int power) {
    const double x = 0.5 + k / std::pow(kRoot, power);
    return x - std::floor(x);
  };
  std::size_t all = 0, above = 0;
  for (int k = 1; k <= kPoints; k++) {
    const Vec3 p = low + Vec3{part(k, 1) * side.x, part(k, 2) * side.y, part(k, 3) * side.z};
    for (const Rod &rod : fibre.rods) {
      const Segment &s = rod.capsule.segment;
      const double along = std::clamp(dot(p - s.centre, s.axis), -s.half_length, s.half_length);
      if (norm_squared(p - s.at(along)) > kR * kR) continue;
      all++;
      above += p.z > plane;
      break;
    }
  }
  const double cell = side.x * side.y * side.z / kPoints;
  const double counted = 5e-4 * found.rods_volume;  // of the points
  EXPECT_NEAR(found.rods_volume, cell * static_cast<double>(all), counted);
  EXPECT_NEAR(found.region.fraction * found.region.volume, cell * static_cast<double>(above),
              counted + found.region.error * found.region.volume);
  EXPECT_EQ(found.overlaps, 0u);
}

// The same beds as fibres of eight and as rods of the same length.
struct SameBed {
  SameBed()
  {
    std::mt19937 random(32452843);
    std::uniform_real_distribution<double> across(-0.05, 0.05), up(0.05, 0.12);
    std::int64_t id = 0;
    for (const Vec3 &axis : random_directions(40, random)) {
      const double h = 2.0 * kR;
      const Vec3 centre{across(random), across(random), up(random)};
      whole.add({{centre, axis, 4.0 * h}, kR});
      fibres.add_chain(++id, points_in_line(centre - 4.0 * h * axis, axis, h, 8), kR);
    }
  }

  void expect_same(const PackingOptions &options, double profiles = 1e-9,
                   const std::array<bool, 3> &periodic = {},
                   const std::array<std::array<double, 2>, 3> &box = {
                       {{-0.2, 0.2}, {-0.2, 0.2}, {0, 0.3}}})
  {
    const DumpFrame a = whole.frame(periodic, box), b = fibres.frame(periodic, box);
    const Bed rods{a, whole.rods, 0}, chains = bed_of(b, fibres);
    const BedPacking one = measure_packing(rods, options), other = measure_packing(chains, options);
    EXPECT_EQ(other.fibres->fibres, 40u);
    EXPECT_EQ(other.fibres->segments, 320u);
    const auto same = [](double x, double y, double tolerance) {
      if (std::isnan(x))
        EXPECT_TRUE(std::isnan(y));
      else
        EXPECT_NEAR(x, y, tolerance * std::abs(x));
    };
    same(one.rods_volume, other.rods_volume, 1e-12);
    same(one.lambda.mean, other.lambda.mean, 1e-12);
    same(one.height.highest_centre, other.height.highest_centre, 1e-12);
    same(one.height.highest_point, other.height.highest_point, 1e-12);
    same(one.mean_elevation_deg, other.mean_elevation_deg, 1e-9);
    same(one.mean_sin_gamma, other.mean_sin_gamma, 1e-9);
    same(one.bulk_margin, other.bulk_margin, 1e-12);
    same(one.whole.fraction, other.whole.fraction, 1e-12);
    const auto same_region = [&](const RegionPacking &x, const RegionPacking &y) {
      if (std::isnan(x.fraction)) return;
      EXPECT_NEAR(x.fraction, y.fraction, x.error + y.error + 1e-12 * x.fraction);
      if (x.error == 0.0) EXPECT_LT(y.error, 1e-12);
    };
    same_region(one.clipped, other.clipped);
    same_region(one.inner, other.inner);
    same_region(one.bulk, other.bulk);
    same_region(one.region, other.region);
    if (!options.holds_bed(a)) return;
    const PackingProfiles p = measure_profiles(rods, options, 0.01),
                          q = measure_profiles(chains, options, 0.01);
    for (const auto &[x, y] : {std::pair{&p.height, &q.height}, std::pair{&p.radius, &q.radius},
                               std::pair{&p.wall, &q.wall}}) {
      ASSERT_EQ(x->size(), y->size());
      for (std::size_t k = 0; k < x->size(); k++)
        EXPECT_NEAR((*x)[k].solid, (*y)[k].solid,
                    2.0 * ((*x)[k].error + (*y)[k].error) + profiles * one.rods_volume);
    }
  }

  FibreBed whole, fibres;
};

TEST(Fibres, InLineTheyPackAsRods)
{
  SameBed beds;
  PackingOptions vessel;
  vessel.vessel = Vessel{0.0, 0.0, 0.2, 0.0};
  vessel.tolerance = 1e-6;
  beds.expect_same(vessel);
  PackingOptions box;
  box.box.emplace(-0.2, 0.2, -0.2, 0.2, 0.0, 0.3);
  box.tolerance = 1e-6;
  beds.expect_same(box);
  PackingOptions region;
  region.region.emplace(-0.02, 0.03, -0.04, 0.05, 0.06, 0.1);
  region.tolerance = 1e-6;
  beds.expect_same(region);
  PackingOptions mesh;
  mesh.mesh = std::make_shared<MeshVessel>(
      MeshVessel{"box.stl", ClosedMesh(poly_data_of(box_mesh({-0.2, 0.2, -0.2, 0.2, 0.0, 0.3})))});
  mesh.tolerance = 1e-5;
  mesh.region.emplace(-0.02, 0.03, -0.04, 0.05, 0.06, 0.1);
  beds.expect_same(mesh);
}

// Layers have a closed form: the same to round-off, with images over all sides too.
TEST(Fibres, InLineTheirLayersAreThoseOfRods)
{
  SameBed beds;
  beds.expect_same({}, 1e-12, {true, true, false}, {{{-0.2, 0.2}, {-0.2, 0.2}, {0, 0.3}}});
  beds.expect_same({}, 1e-12, {true, true, true}, {{{-0.2, 0.2}, {-0.2, 0.2}, {0.02, 0.2}}});
}

// Layers and regions that fill a space together have all of a bent fibre.
TEST(Fibres, PartsOfABentFibreAddUp)
{
  FibreBed fibre;
  fibre.add_chain(1, points_on_arc({0.02, 0.0, 0.02}, 4.0 * kR, 6, 0.5), kR);
  const DumpFrame frame = fibre.frame({true, true, false}, {{{0, 0.3}, {0, 0.3}, {0, 0.3}}});
  const Bed bed = bed_of(frame, fibre);
  const BedPacking all = measure_packing(bed, {});
  const PackingProfiles profiles = measure_profiles(bed, {}, 0.7 * kR);
  double solid = 0.0;
  for (const ProfileBin &bin : profiles.height) solid += bin.solid;
  EXPECT_NEAR(solid, all.rods_volume, 1e-12 * all.rods_volume);
  EXPECT_GT(profiles.height[8].error, 0.0);  // of joints that edges cut
}

// Chord, curvature, cosines of an arc that lies over two periodic boundaries.
TEST(Fibres, ShapeOfAnArc)
{
  const int n = 10;
  const double h = 8.0 * kR, bend = 0.1;
  FibreBed fibre;
  fibre.add_chain(3, points_on_arc({0.05, 0.0, 0.05}, h, n, bend), kR);
  const std::array<std::array<double, 2>, 3> box{{{0, 0.2}, {-1, 1}, {0, 0.1}}};
  for (Rod &rod : fibre.rods) {
    Vec3 &c = rod.capsule.segment.centre;
    c.x -= 0.2 * std::floor(c.x / 0.2);
    c.z -= 0.1 * std::floor(c.z / 0.1);
  }
  const Fibres fibres = fibres_of(fibre.frame({true, false, true}, box), fibre.rods, {});
  ASSERT_EQ(fibres.all.size(), 1u);
  EXPECT_EQ(fibres.joints.size(), 9u);
  const FibreShapes shapes = fibre_shapes(fibre.rods, fibres);
  const double chord = h * std::sin(0.5 * n * bend) / std::sin(0.5 * bend);
  EXPECT_NEAR(norm(end_to_end(fibres.all[0], fibre.rods)), chord, 1e-12 * chord);
  EXPECT_NEAR(shapes.stretch.mean, chord / (n * h), 1e-12);
  EXPECT_NEAR(shapes.contour.mean, n * h, 1e-12);
  EXPECT_NEAR(shapes.curvature.mean, bend / h, 1e-10 * bend / h);
  EXPECT_NEAR(shapes.persistence, -h / std::log(std::cos(bend)), 1e-9);
  ASSERT_EQ(shapes.correlation.size(), 10u);
  for (int k = 0; k < n; k++) {
    EXPECT_NEAR(shapes.correlation[k].cosine.mean, std::cos(k * bend), 1e-12);
    EXPECT_NEAR(shapes.correlation[k].distance, k * h, 1e-12);
    EXPECT_EQ(shapes.correlation[k].pairs, static_cast<std::size_t>(n - k));
  }
  const std::vector<Rod> bodies = fibre_bodies(fibre.rods, fibres, Rings::LeftOut);
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0].id, 3);
  EXPECT_NEAR(bodies[0].capsule.aspect_ratio(), n * h / (2.0 * kR) + 1.0, 1e-10);
  EXPECT_NEAR(elevation(bodies[0].capsule.segment.axis), 0.5 * (n - 1) * bend, 1e-12);
}

// Freely turning joints: <cos> = exp(-h/P) for bends whose cosine has that mean.
TEST(Fibres, PersistenceOfARandomChain)
{
  const double h = 4.0 * kR, bend = 0.3;
  std::mt19937 random(49979687);
  std::uniform_real_distribution<double> turns(0.0, 2.0 * pi);
  FibreBed bed;
  for (int fibre = 1; fibre <= 300; fibre++) {
    Vec3 u{0.0, 0.0, 1.0}, p{0.0, 0.0, 0.0};
    std::vector<Vec3> points{p};
    for (int k = 0; k < 20; k++) {
      p = p + h * u;
      points.push_back(p);
      const Vec3 side = std::abs(u.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
      const Vec3 e = (1.0 / norm(cross(u, side))) * cross(u, side), f = cross(u, e);
      const double turn = turns(random);
      u = std::cos(bend) * u + std::sin(bend) * (std::cos(turn) * e + std::sin(turn) * f);
      u = (1.0 / norm(u)) * u;
    }
    bed.add_chain(fibre, points, kR);
  }
  const FibreShapes shapes = fibre_shapes(bed.rods, fibres_of(bed.frame(), bed.rods, {}));
  EXPECT_NEAR(shapes.persistence, -h / std::log(std::cos(bend)), 1e-9);
  for (const TangentCorrelation &c : shapes.correlation)
    if (c.places >= 2 && c.places < 10)
      EXPECT_NEAR(c.cosine.mean, std::pow(std::cos(bend), double(c.places)), 5.0 * c.cosine.error);
}

TEST(Fibres, RingsAndParts)
{
  FibreBed bed;
  std::vector<Vec3> circle;
  for (int k = 0; k <= 12; k++)
    circle.push_back({0.05 * std::cos(k * pi / 6), 0.05 * std::sin(k * pi / 6), 0.0});
  bed.add_chain(1, circle, kR);
  bed.add_chain(2, points_in_line({0.2, 0, 0}, {0, 0, 1}, 0.03, 6), kR);
  bed.add({{{0.4, 0, 0}, {0, 0, 1}, 0.02}, kR});
  Fibres fibres = fibres_of(bed.frame(), bed.rods, {});
  ASSERT_EQ(fibres.all.size(), 2u);
  EXPECT_TRUE(fibres.all[0].is_ring);
  EXPECT_FALSE(fibres.all[1].is_ring);
  EXPECT_EQ(fibres.joints.size(), 12u + 5u);
  EXPECT_EQ(fibres.parts, 0u);
  EXPECT_EQ(fibre_bodies(bed.rods, fibres, Rings::Kept).size(), 3u);
  EXPECT_EQ(fibre_bodies(bed.rods, fibres, Rings::LeftOut).size(), 2u);
  // Of the ring all twelve ends are shared.
  const double h = 2.0 * bed.rods[0].capsule.segment.half_length;
  double wedge = 4.0 / 3.0 * kR * kR * kR * (std::tan(pi / 12) - pi / 12);
  double ring = 0.0;
  for (const SharedEnd &end : shared_ends(bed.rods, fibres))
    if (end.ball.capsule.segment.centre.x < 0.1) ring += end.beyond.value;
  EXPECT_NEAR(ring, 12.0 * wedge, 1e-12 * ball());
  EXPECT_NEAR(fibre_shapes(bed.rods, fibres).contour.mean, (12 * h + 0.18) / 2.0, 1e-12);

  // A segment of each goes: the ring is one fibre, open; the other is two parts.
  FibreBed cut;
  for (std::size_t k = 0; k < bed.rods.size(); k++)
    if (k != 4 && k != 14) cut.add(bed.rods[k].capsule, bed.fibre[k], bed.place[k]);
  fibres = fibres_of(cut.frame(), cut.rods, {});
  ASSERT_EQ(fibres.all.size(), 3u);
  EXPECT_FALSE(fibres.all[0].is_ring);
  EXPECT_EQ(fibres.all[0].segments.size(), 11u);
  EXPECT_EQ(fibres.all[1].segments.size(), 2u);
  EXPECT_EQ(fibres.all[2].segments.size(), 3u);
  EXPECT_EQ(fibres.parts, 2u);
}

// Ends further apart than the tolerance are not joined, and a fibre is two parts there.
TEST(Fibres, EndsThatDoNotMeet)
{
  FibreBed bed;
  bed.add_chain(1, points_in_line({0, 0, 0}, {1, 0, 0}, 0.03, 4), kR);
  for (std::size_t k = 2; k < 4; k++) bed.rods[k].capsule.segment.centre.z += 1.5e-3;
  EXPECT_EQ(fibres_of(bed.frame(), bed.rods, {}).all.size(), 2u);
  FibreOptions wide;
  wide.meet = 0.2;
  EXPECT_EQ(fibres_of(bed.frame(), bed.rods, wide).all.size(), 1u);
}

// Where fix joint says that a head is free, ends that still meet are not joined.
TEST(Fibres, BrokenJoint)
{
  FibreBed bed;
  bed.add_chain(1, points_in_line({0, 0, 0}, {1, 0, 0}, 0.03, 3), kR);
  DumpFrame frame = bed.frame();
  std::vector<double> values;
  for (std::size_t row = 0; row < 3; row++) {
    for (std::size_t k = 0; k < frame.columns.size(); k++) values.push_back(frame.value(row, k));
    values.push_back(std::vector<double>{2.0, 1.0, 8.0}[row]);
  }
  frame.columns.push_back("f_fibres[3]");
  frame.values = values;
  const Fibres fibres = fibres_of(frame, bed.rods, {});
  ASSERT_EQ(fibres.all.size(), 2u);
  EXPECT_EQ(fibres.all[0].segments.size(), 2u);
  EXPECT_EQ(fibres.joints.size(), 1u);
}

TEST(Fibres, RefusesWhatIsNoFibre)
{
  FibreBed bed;
  bed.add_chain(4, points_in_line({0, 0, 0}, {1, 0, 0}, 0.03, 3), kR);
  EXPECT_EQ(refusal(bed), "");
  FibreBed twice = bed;
  twice.place[2] = 2;
  EXPECT_EQ(refusal(twice), "fibres.dump:12: rod 3 is at place 2 of fibre 4, where rod 2 is too, "
                            "wanted one at a place");
  FibreBed none = bed;
  none.place[1] = 0;
  EXPECT_EQ(refusal(none), "fibres.dump:11: rod 2 has f_fibres[2] 0, wanted a whole number >= 1");
  FibreBed negative = bed;
  negative.fibre[0] = -1;
  EXPECT_EQ(refusal(negative),
            "fibres.dump:10: rod 1 has f_fibres[1] -1, wanted a whole number >= 0");
  FibreBed thick = bed;
  thick.rods[1].capsule.radius = 1.01 * kR;
  EXPECT_NE(refusal(thick).find("its neighbour in a fibre, rod 1, has 0.005, wanted one radius"),
            std::string::npos);
  FibreOptions others;
  others.columns = {"c_f", "c_p"};
  EXPECT_EQ(refusal(bed, others), "fibres.dump:9: column 'c_f' is missing");
}

// A rod across a fibre in line, before, at and beyond a joint: one contact as on one long rod.
TEST(Fibres, ContactAtAJointCountsOnce)
{
  for (const double s : {-0.5, -0.01, 0.0, 0.01, 0.5})
    for (const double turn : {0.5 * pi, 0.25 * pi}) {
      FibreBed bed;
      bed.add_chain(1, points_in_line({0, 0, 0}, {1, 0, 0}, 0.05, 3), kR);
      bed.add({{{0.05 + s * kR, 0, 1.9 * kR}, {std::cos(turn), std::sin(turn), 0}, 0.03}, kR});
      const Fibres fibres = fibres_of(bed.frame(), bed.rods, {});
      auto pairs = close_pairs(bed.rods, {}, 0.0);
      EXPECT_GE(pairs.size(), 3u);
      leave_out_joints(bed.rods, fibres, pairs);
      leave_out_doubles(bed.rods, fibres, pairs);
      EXPECT_EQ(pairs.size(), 1u) << s;
      EXPECT_NEAR(pairs[0].gap, -0.1 * kR, 1e-12) << s;
    }
}

// Two fibres that cross with their joints one above the other.
TEST(Fibres, JointOnJointIsOneContact)
{
  FibreBed bed;
  bed.add_chain(1, points_in_line({-0.05, 0, 0}, {1, 0, 0}, 0.05, 2), kR);
  bed.add_chain(2, points_in_line({0, -0.05, 1.9 * kR}, {0, 1, 0}, 0.05, 2), kR);
  const Fibres fibres = fibres_of(bed.frame(), bed.rods, {});
  auto pairs = close_pairs(bed.rods, {}, 0.0);
  EXPECT_EQ(pairs.size(), 6u);
  leave_out_joints(bed.rods, fibres, pairs);
  EXPECT_EQ(pairs.size(), 4u);
  leave_out_doubles(bed.rods, fibres, pairs);
  EXPECT_EQ(pairs.size(), 1u);
  EXPECT_EQ(contact_kinds(bed.rods, pairs, fibres).side_side.mean, 1.0);
  const FibreContacts found = fibre_contacts({0, 0, 1, 1}, 2, pairs, {});
  EXPECT_EQ(found.between, 1u);
  EXPECT_EQ(found.per_fibre.mean, 1.0);
}

// On the floor a fibre of n segments has n + 1 contacts; one that comes back on itself touches itself.
TEST(Fibres, WallsAndSelfContacts)
{
  FibreBed bed;
  bed.add_chain(1, points_in_line({0, 0, 0.9 * kR}, {1, 0, 0}, 0.05, 4), kR);
  Fibres fibres = fibres_of(bed.frame(), bed.rods, {});
  auto walls = wall_contacts(bed.rods, {0.0, 0.0, INFINITY, 0.0}, 0.0);
  EXPECT_EQ(walls.size(), 8u);
  leave_out_doubles(fibres, walls);
  EXPECT_EQ(walls.size(), 5u);

  FibreBed hairpin;  // 8 radii a side, back beside its first segment
  hairpin.add_chain(
      1,
      {{0, 0, 0}, {8 * kR, 0, 0}, {8 * kR, 5 * kR, 0}, {2 * kR, 5 * kR, 0}, {2 * kR, 1.9 * kR, 0}},
      kR);
  fibres = fibres_of(hairpin.frame(), hairpin.rods, {});
  auto pairs = close_pairs(hairpin.rods, {}, 0.0);
  leave_out_joints(hairpin.rods, fibres, pairs);
  leave_out_doubles(hairpin.rods, fibres, pairs);
  const FibreContacts found = fibre_contacts({0, 0, 0, 0}, 1, pairs, {});
  EXPECT_EQ(found.with_itself, 1u);
  EXPECT_EQ(found.between, 0u);
}

// Segments shorter than thick: those next but one overlap, and are no contacts; those further are.
TEST(Fibres, NextButOneOfShortSegments)
{
  FibreBed bed;
  bed.add_chain(1, points_in_line({0, 0, 0}, {1, 0, 0}, 1.5 * kR, 6), kR);
  const Fibres fibres = fibres_of(bed.frame(), bed.rods, {});
  auto pairs = close_pairs(bed.rods, {}, 0.0);
  EXPECT_EQ(pairs.size(), 5u + 4u);
  leave_out_joints(bed.rods, fibres, pairs);
  EXPECT_TRUE(pairs.empty());
}

TEST(Fibres, PartsOfWhatIsShown)
{
  FibreBed bed;
  bed.add_chain(1, points_in_line({0, 0, 0}, {1, 0, 0}, 0.05, 6), kR);
  const Fibres some = fibres_among(fibres_of(bed.frame(), bed.rods, {}), {0, 1, 3, 4, 5});
  ASSERT_EQ(some.all.size(), 2u);
  EXPECT_EQ(some.all[0].segments, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(some.all[1].segments, (std::vector<std::uint32_t>{2, 3, 4}));
  EXPECT_EQ(some.joints.size(), 3u);
}

}  // namespace
}  // namespace spherocylinder
