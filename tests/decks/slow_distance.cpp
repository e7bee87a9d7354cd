// SPDX-License-Identifier: GPL-2.0-or-later
#include "slow_distance.h"

#include <algorithm>
#include <cmath>

namespace decks {

double slow_distance(const Rod &a, const Rod &b)
{
  const auto distance_at = [&](double s) {
    const Vec3 from = a.position + s * a.axis - b.position;
    const double h = b.half_cylinder();
    const double t = std::max(-h, std::min(h, dot(from, b.axis)));
    return norm(from - t * b.axis);
  };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double lo = -a.half_cylinder(), hi = a.half_cylinder();
  for (int k = 0; k < 45; k++) {
    const double width = hi - lo;
    if (distance_at(hi - golden * width) < distance_at(lo + golden * width))
      hi = lo + golden * width;
    else
      lo = hi - golden * width;
  }
  return std::min({distance_at(0.5 * (lo + hi)), distance_at(-a.half_cylinder()),
                   distance_at(a.half_cylinder())});
}

}  // namespace decks
