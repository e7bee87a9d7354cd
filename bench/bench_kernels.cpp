// SPDX-License-Identifier: GPL-2.0-or-later
// Nanoseconds per query of the core's kernels, on rods as they lie in a dense bed: centres within a
// rod's length of each other, any direction.
//   cmake --preset release -DSPHEROCYLINDER_BENCHMARKS=ON && cmake --build --preset release
//   build/release/bench_kernels
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "core/closest_points.h"
#include "core/mass_properties.h"
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
  for (int k = 0; k < kRods; ++k)
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
    ++k;
  }
}

void ClosestPointsOfRods(benchmark::State &state)
{
  over_pairs(state, [](const Segment &i, const Segment &j) { return closest_points(i, j); });
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
  state.SetItemsProcessed(state.iterations() * kBatch);
}

BENCHMARK(ClosestPointsOfRods)->ArgName("lambda")->Arg(3)->Arg(10)->Arg(30)->Arg(100);
BENCHMARK(LinesAreApart)->ArgName("lambda")->Arg(30);
BENCHMARK(SpreadContact)->ArgName("lambda")->Arg(30);
BENCHMARK(RotateFreely);
BENCHMARK(RotateFreelyInBatches);

}  // namespace
