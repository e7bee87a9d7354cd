// SPDX-License-Identifier: GPL-2.0-or-later
// Nanoseconds per query of the core's kernels, on rods as they lie in a dense bed: centres within a
// rod's length of each other, any direction. Of the kernels that work on many at once the column
// `each` is what counts.
//   cmake --preset release -DSPHEROCYLINDER_BENCHMARKS=ON && cmake --build --preset release
//   build/release/bench_kernels
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/closest_points.h"
#include "core/closest_points_batch.h"
#include "core/linear_contact.h"
#include "core/mass_properties.h"
#include "core/near_pairs.h"
#include "core/rotation.h"
#include "core/rotation_batch.h"
#include "core/spread_contact.h"

using namespace spherocylinder;

namespace {

constexpr int kRods = 1024;
constexpr double kReach = 1.0;  // the sum of two radii

Vec3 random_direction(std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  const Vec3 v{normal(random), normal(random), normal(random)};
  return (1.0 / norm(v)) * v;
}

std::vector<Segment> random_segments(double lambda)
{
  std::mt19937 random(104729);
  std::uniform_real_distribution<double> place(0.0, 0.5 * lambda);
  std::vector<Segment> segments;
  for (int k = 0; k < kRods; k++)
    segments.push_back({{place(random), place(random), place(random)},
                        random_direction(random),
                        0.5 * (lambda - 1.0)});
  return segments;
}

template <typename Query>
void over_pairs(benchmark::State &state, Query query)
{
  const auto segments = random_segments(static_cast<double>(state.range(0)));
  size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(query(segments[k % kRods], segments[(7 * k + 1) % kRods]));
    k++;
  }
}

void ClosestPointsOfRods(benchmark::State &state)
{
  over_pairs(state, [](const Segment &i, const Segment &j) { return closest_points(i, j); });
}

void set_time_of_each(benchmark::State &state, int many)
{
  using benchmark::Counter;
  state.counters["each"] = Counter(many, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

// Pairs gathered from the rods, worked out and read.
void ClosestPointsBatch(benchmark::State &state)
{
  const auto segments = random_segments(static_cast<double>(state.range(0)));
  SegmentPairs batch{};
  size_t first = 0;
  for (auto _ : state) {
    for (int k = 0; k < kBatch; k++, first++)
      batch.set(k, segments[first % kRods], segments[(7 * first + 1) % kRods], kReach);
    closest_points(batch);
    for (int k = 0; k < kBatch; k++) benchmark::DoNotOptimize(batch.get(k));
  }
  set_time_of_each(state, kBatch);
}

// The same pairs again and again, in place: the arithmetic alone.
void ClosestPointsBatchInPlace(benchmark::State &state)
{
  const auto segments = random_segments(static_cast<double>(state.range(0)));
  SegmentPairs batch{};
  for (int k = 0; k < kBatch; k++) batch.set(k, segments[k], segments[7 * k + 1], kReach);
  for (auto _ : state) {
    closest_points(batch);
    benchmark::ClobberMemory();
  }
  set_time_of_each(state, kBatch);
}

// The contact law in place; crossed rods with friction and a spring.
void LinearContactsInPlace(benchmark::State &state)
{
  LinearContacts batch{};
  const auto segments = random_segments(30.0);
  for (int k = 0; k < kBatch; k++) {
    const Vec3 u = segments[2 * k].axis, v = segments[2 * k + 1].axis, n = cross(u, v);
    batch.axis_i.set(k, u);
    batch.axis_j.set(k, v);
    batch.normal.set(k, (1.0 / norm(n)) * n);
    batch.velocity_i.set(k, 0.1 * v);
    batch.omega_j.set(k, 3.0 * u);
    batch.inverse_mass_i[k] = batch.inverse_mass_j[k] = 1.0;
    batch.inverse_inertia_i[k] = batch.inverse_inertia_j[k] = 0.1;
    batch.radius_i[k] = batch.radius_j[k] = 0.5;
    batch.s[k] = 0.3 * k;
    batch.t[k] = -0.2 * k;
    batch.overlap[k] = 0.01;
    batch.distance[k] = 0.99;
    batch.stiffness[k] = 1e4;
    batch.tangential_stiffness[k] = 5e3;
    batch.share[k] = batch.turning[k] = 1.0;
    batch.two_beta[k] = 0.4;
    batch.friction[k] = 0.3;
  }
  const LinearOptions law{Tangential::History, true, false, 1e-5};
  for (auto _ : state) {
    linear_contacts(batch, law);
    benchmark::ClobberMemory();
  }
  set_time_of_each(state, kBatch);
}

// All pairs with surfaces nearer than 1.5 diameters of 4,096 rods, 5 % solid; a rod.
void NearPairsSearch(benchmark::State &state)
{
  constexpr int kMany = 4096;
  const double lambda = static_cast<double>(state.range(0));
  const double box = std::cbrt(kMany * 0.7854 * lambda / 0.05);
  std::mt19937 random(104729);
  std::uniform_real_distribution<double> place(0.0, box);
  std::vector<Capsule> rods;
  for (int k = 0; k < kMany; k++)
    rods.push_back({{{place(random), place(random), place(random)},
                     random_direction(random),
                     0.5 * (lambda - 1.0)},
                    0.5});
  NearPairs near;
  for (auto _ : state) near.find(rods, kMany, 1.5);
  set_time_of_each(state, kMany);
  state.counters["pairs_each"] = static_cast<double>(near.partners().size()) / kMany;
}

void LinesAreApart(benchmark::State &state)
{
  over_pairs(state,
             [](const Segment &i, const Segment &j) { return lines_are_apart(i, j, kReach); });
}

void SpreadContact(benchmark::State &state)
{
  over_pairs(state, [](const Segment &i, const Segment &j) {
    ClosestPoints touching = closest_points(i, j);
    touching.distance_squared = 0.99 * kReach * kReach;
    return spread_contact(i, j, kReach, touching);
  });
}

void RotateFreely(benchmark::State &state)
{
  const MassProperties rod = mass_properties(0.01, 0.1, 2700.0);
  Quaternion q{1.0, 0.0, 0.0, 0.0};
  const Vec3 angular_momentum{1e-5, 2e-5, 3e-7};
  for (auto _ : state) {
    q = rotate_freely(q, angular_momentum, rod.inertia_axial, rod.inertia_transverse, 2e-5);
    benchmark::DoNotOptimize(q);
  }
}

// A batch of 32 rods, as the integrator has them.
void RotateFreelyInBatches(benchmark::State &state)
{
  const MassProperties rod = mass_properties(0.01, 0.1, 2700.0);
  const double inertia[] = {rod.inertia_transverse, rod.inertia_transverse, rod.inertia_axial};
  const double start[] = {1.0, 0.0, 0.0, 0.0};
  RodRotations rods{};
  for (int k = 0; k < kBatch; k++) rods.set(k, {1e-5, 2e-5, 3e-7 * k}, inertia, start);
  for (auto _ : state) {
    rotate_freely(rods, 2e-5);
    benchmark::DoNotOptimize(rods);
  }
  set_time_of_each(state, kBatch);
}

BENCHMARK(ClosestPointsOfRods)->ArgName("lambda")->Arg(3)->Arg(10)->Arg(30)->Arg(100);
BENCHMARK(ClosestPointsBatch)->ArgName("lambda")->Arg(3)->Arg(10)->Arg(30)->Arg(100);
BENCHMARK(ClosestPointsBatchInPlace)->ArgName("lambda")->Arg(30);
BENCHMARK(LinearContactsInPlace);
BENCHMARK(NearPairsSearch)->ArgName("lambda")->Arg(3)->Arg(10)->Arg(30)->Arg(100);
BENCHMARK(LinesAreApart)->ArgName("lambda")->Arg(30);
BENCHMARK(SpreadContact)->ArgName("lambda")->Arg(30);
BENCHMARK(RotateFreely);
BENCHMARK(RotateFreelyInBatches);

}  // namespace
