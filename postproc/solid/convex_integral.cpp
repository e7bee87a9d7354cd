// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/convex_integral.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace spherocylinder {
namespace {

// Stops a tolerance below round-off; 1e5 samples reach 1e-9.
constexpr std::size_t kMostSamples = 100000;

struct Sample {
  double x;
  double root;  // sqrt(A)
};

struct Bounds {
  double low, high;
};

// Integral of the square of a straight line between its end values.
double integral_of_square(double width, double left, double right)
{
  return width * (left * left + left * right + right * right) / 3.0;
}

// Value at x of the line through two samples.
double prolonged(const Sample &a, const Sample &b, double x)
{
  return a.root + (b.root - a.root) * (x - a.x) / (b.x - a.x);
}

// Bounds on the integral of A between samples i and i + 1. Samples of zero area may lie beyond
// the body, where sqrt(A) is not concave: no chord ends in one.
Bounds integral_bounds(const std::vector<Sample> &samples, std::size_t i, double largest_area)
{
  const Sample &a = samples[i];
  const Sample &b = samples[i + 1];
  const double width = b.x - a.x;
  if (a.root == 0.0 && b.root == 0.0) return {0.0, 0.0};  // see convex_volume: not inside the body

  Bounds bounds{0.0, width * largest_area};
  if (a.root > 0.0 && b.root > 0.0) bounds.low = integral_of_square(width, a.root, b.root);

  const bool from_left = i > 0 && samples[i - 1].root > 0.0 && a.root > 0.0;
  const bool from_right = i + 2 < samples.size() && samples[i + 2].root > 0.0 && b.root > 0.0;
  const double left_at_b = from_left ? prolonged(samples[i - 1], a, b.x) : 0.0;
  const double right_at_a = from_right ? prolonged(samples[i + 2], b, a.x) : 0.0;
  double high = bounds.high;
  if (from_left && from_right) {
    // Two lines, one through either end of the interval: the lower of the two is the bound.
    const double gap_a = std::max(right_at_a - a.root, 0.0);
    const double gap_b = std::max(left_at_b - b.root, 0.0);
    if (gap_a + gap_b > 0.0) {
      const double crossing = gap_a / (gap_a + gap_b);
      const double top = a.root + crossing * (left_at_b - a.root);
      high = integral_of_square(crossing * width, a.root, top) +
             integral_of_square((1.0 - crossing) * width, top, b.root);
    } else {
      high = bounds.low;
    }
  } else if (from_left) {
    high = integral_of_square(width, a.root, std::max(left_at_b, 0.0));
  } else if (from_right) {
    high = integral_of_square(width, std::max(right_at_a, 0.0), b.root);
  }
  bounds.high = std::max(std::min(bounds.high, high), bounds.low);
  return bounds;
}

}  // namespace

BoundedVolume convex_volume(const ConvexSections &sections, double tolerance, double least)
{
  // Starts with a section that has an area, so that the body lies between the zero samples on
  // either side of it.
  const auto sample = [&](double x) { return Sample{x, std::sqrt(sections.area(x))}; };
  std::vector<Sample> samples{sample(sections.low), sample(sections.inner), sample(sections.high)};
  std::vector<Sample> finer;
  std::vector<Bounds> bounds;
  while (true) {
    Bounds total{0.0, 0.0};
    bounds.clear();
    for (std::size_t i = 0; i + 1 < samples.size(); i++) {
      bounds.push_back(
          integral_bounds(samples, i, sections.largest_area(samples[i].x, samples[i + 1].x)));
      total.low += bounds.back().low;
      total.high += bounds.back().high;
    }
    const double gap = total.high - total.low;
    const double wanted = 2.0 * tolerance * std::max(total.low, least);
    if (gap <= wanted || samples.size() >= kMostSamples)
      return {0.5 * (total.low + total.high), 0.5 * gap};

    const double share = wanted / static_cast<double>(bounds.size());
    finer.clear();
    for (std::size_t i = 0; i + 1 < samples.size(); i++) {
      finer.push_back(samples[i]);
      const double middle = 0.5 * (samples[i].x + samples[i + 1].x);
      if (bounds[i].high - bounds[i].low > share && samples[i].x < middle &&
          middle < samples[i + 1].x)
        finer.push_back(sample(middle));
    }
    finer.push_back(samples.back());
    if (finer.size() == samples.size()) return {0.5 * (total.low + total.high), 0.5 * gap};
    samples.swap(finer);
  }
}

}  // namespace spherocylinder
