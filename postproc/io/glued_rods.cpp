// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/glued_rods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "io/frame_columns.h"
#include "io/input_error.h"

namespace spherocylinder {
namespace {

constexpr double kLargestRadius = 1e6;  // m; what is larger is no rod

double component(const Vec3 &a, int d) { return d == 0 ? a.x : d == 1 ? a.y : a.z; }

struct Sphere {
  std::size_t row;
  Vec3 centre;
};

// Unit vector along the line of least squares through the centres: the largest principal axis,
// by powers of the second moments. For a rod, whose other two are nothing beside it, one is enough.
Vec3 direction_of(const std::vector<Sphere> &spheres, const Vec3 &mean)
{
  Vec3 u{0.0, 0.0, 0.0};
  for (const Sphere &s : spheres)
    if (const Vec3 d = s.centre - mean; norm_squared(d) > norm_squared(u)) u = d;
  if (norm_squared(u) == 0.0) return {0.0, 0.0, 1.0};
  u = (1.0 / norm(u)) * u;
  constexpr int kMostPowers = 100;
  for (int i = 0; i < kMostPowers; i++) {
    Vec3 next{0.0, 0.0, 0.0};
    for (const Sphere &s : spheres) next = next + dot(s.centre - mean, u) * (s.centre - mean);
    next = (1.0 / norm(next)) * next;
    const bool is_same = norm_squared(next - u) < 1e-32;
    u = next;
    if (is_same) break;
  }
  return u;
}

class Bodies {
 public:
  Bodies(const DumpFrame &frame, const GluedRodOptions &options)
      : frame_(frame),
        options_(options),
        id_(need_column(frame, "id")),
        body_(need_column(frame, options.body,
                          options.body == "mol" ? "--body with another that tells bodies apart"
                                                : "")),
        type_(frame.find_column("type")),
        density_(frame.find_column("density")),
        place_(frame),
        radius_(find_radius(frame)),
        velocity_(frame, {"vx", "vy", "vz"}),
        omega_(frame, {"omegax", "omegay", "omegaz"})
  {
    for (int d = 0; d < 3; d++)
      is_wrapped_[d] = frame.periodic[d] && frame.columns[place_.column(d)].back() != 'u';
  }

  std::vector<GluedRod> rods() const
  {
    std::vector<std::size_t> rows(frame_.rows);
    for (std::size_t row = 0; row < frame_.rows; row++) {
      need_body(row);
      rows[row] = row;
    }
    std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(body(a), value(a, id_)) < std::pair(body(b), value(b, id_));
    });
    std::vector<GluedRod> rods;
    for (std::size_t begin = 0; begin < rows.size();) {
      std::size_t end = begin;
      while (end < rows.size() && body(rows[end]) == body(rows[begin])) end++;
      rods.push_back(rod_of({rows.begin() + begin, rows.begin() + end}));
      begin = end;
    }
    return rods;
  }

 private:
  static std::size_t find_radius(const DumpFrame &frame)
  {
    if (const auto column = frame.find_column("diameter")) return *column;
    return need_column(frame, "radius", "'diameter'");
  }

  double value(std::size_t row, std::size_t column) const { return frame_.value(row, column); }
  double body(std::size_t row) const { return value(row, body_); }

  double radius(std::size_t row) const
  {
    return (frame_.columns[radius_] == "diameter" ? 0.5 : 1.0) * value(row, radius_);
  }

  void need_body(std::size_t row) const
  {
    constexpr double kLargest = 9007199254740992.0;  // 2^53: above, a double skips whole numbers
    const double b = body(row);
    if (!(b >= 1.0 && b < kLargest && b == std::floor(b)))
      throw InputError(
          fmt::format("{}:{}: sphere {} is of no body: {} is {}, wanted a whole number >= 1",
                      frame_.path, frame_.line_of(row), value(row, id_), options_.body, b));
  }

  [[noreturn]] void fail(std::size_t row, const std::string &what) const
  {
    throw InputError(fmt::format("{}:{}: step {}: body {} is no rod: {}", frame_.path,
                                 frame_.line_of(row), frame_.step, body(row), what));
  }

  GluedRod rod_of(const std::vector<std::size_t> &rows) const
  {
    const std::size_t first = rows[0];
    if (rows.size() < 2) fail(first, "it has 1 sphere, wanted at least 2");
    const double r = radius(first);
    if (!(r > 0.0 && r < kLargestRadius))
      fail(first,
           fmt::format("a radius is {}, wanted a number > 0, below {:g}", r, kLargestRadius));
    for (const std::size_t row : rows)
      if (std::abs(radius(row) - r) > kLengthRounding * r)
        fail(row, fmt::format("its spheres have the radii {} and {}, wanted one", r, radius(row)));

    const std::vector<Sphere> spheres = put_together(rows);
    Vec3 mean{0.0, 0.0, 0.0};
    for (const Sphere &s : spheres) mean = mean + s.centre;
    mean = (1.0 / static_cast<double>(spheres.size())) * mean;
    Vec3 u = direction_of(spheres, mean);
    if (dot(u, spheres.back().centre - spheres.front().centre) < 0.0) u = -u;

    double deviation = 0.0;
    std::vector<double> along;
    for (const Sphere &s : spheres) {
      const Vec3 d = s.centre - mean;
      along.push_back(dot(d, u));
      const double off = norm(d - along.back() * u) / r;
      if (off > options_.tolerance)
        fail(s.row, fmt::format("sphere {} lies {:.4g} radii off its axis, wanted at most {}",
                                value(s.row, id_), off, options_.tolerance));
      deviation = std::max(deviation, off);
    }
    const std::vector<double> places_of_rows = along;
    std::sort(along.begin(), along.end());
    double least = INFINITY, largest = 0.0;
    for (std::size_t i = 1; i < along.size(); i++) {
      least = std::min(least, (along[i] - along[i - 1]) / r);
      largest = std::max(largest, (along[i] - along[i - 1]) / r);
    }
    if (!(largest > 0.0)) fail(first, "its spheres are in one place, wanted a length");
    if (largest > 2.0 + options_.tolerance)
      fail(first, fmt::format("two of its spheres lie {:.4g} radii apart with none between them, "
                              "wanted at most 2 (and {})",
                              largest, options_.tolerance));

    const Vec3 omega = omega_of(spheres, places_of_rows, u);
    const double middle = 0.5 * (along.front() + along.back());
    const Capsule capsule{{wrapped(mean + middle * u), u, 0.5 * (along.back() - along.front())}, r};
    const Vec3 velocity = mean_of_rows(velocity_, spheres) + cross(omega, middle * u);
    return {{static_cast<std::int64_t>(body(first)), type(first), capsule},
            velocity_.are_there() ? velocity : Vec3{0.0, 0.0, 0.0},
            omega,
            density_ ? value(first, *density_) : 0.0,
            spheres.size(),
            deviation,
            least,
            largest};
  }

  int type(std::size_t row) const
  {
    if (!type_) return 1;
    constexpr double kLargest = 1e6;
    const double type = value(row, *type_);
    if (!(type >= 1.0 && type <= kLargest && type == std::floor(type)))
      fail(row, fmt::format("type is {}, wanted a whole number >= 1", type));
    return static_cast<int>(type);
  }

  // The spheres at images that belong together, in the order of the rows.
  std::vector<Sphere> put_together(const std::vector<std::size_t> &rows) const
  {
    std::vector<Sphere> spheres;
    for (const std::size_t row : rows) spheres.push_back({row, place_.of(row)});
    for (const Sphere &s : spheres)
      for (int d = 0; d < 3; d++)
        if (!(std::abs(component(s.centre, d)) < kLargestPlace))
          fail(s.row, fmt::format("{} is {:g} m, wanted less than {:g} m", "xyz"[d],
                                  component(s.centre, d), kLargestPlace));
    if (!lie_across(spheres)) return spheres;

    // Of those that are not placed yet, the one nearest to any that is, at its nearest image.
    const std::size_t n = spheres.size();
    std::vector<bool> placed(n, false);
    std::vector<double> distance(n, INFINITY);
    std::vector<Vec3> step(n), from(n);
    for (std::size_t next = 0, count = 0; count < n; count++) {
      if (count > 0) {
        next = n;
        for (std::size_t i = 0; i < n; i++)
          if (!placed[i] && (next == n || distance[i] < distance[next])) next = i;
        spheres[next].centre = from[next] + step[next];
      }
      placed[next] = true;
      for (std::size_t i = 0; i < n; i++) {
        if (placed[i]) continue;
        const Vec3 d = to_nearest_image(spheres[i].centre - spheres[next].centre);
        if (norm_squared(d) >= distance[i]) continue;
        distance[i] = norm_squared(d);
        step[i] = d;
        from[i] = spheres[next].centre;
      }
    }
    return spheres;
  }

  double period(int d) const { return frame_.box[d][1] - frame_.box[d][0]; }

  bool lie_across(const std::vector<Sphere> &spheres) const
  {
    for (int d = 0; d < 3; d++) {
      if (!is_wrapped_[d]) continue;
      const auto [low, high] = std::minmax_element(
          spheres.begin(), spheres.end(), [&](const Sphere &a, const Sphere &b) {
            return component(a.centre, d) < component(b.centre, d);
          });
      if (component(high->centre, d) - component(low->centre, d) > 0.5 * period(d)) return true;
    }
    return false;
  }

  Vec3 to_nearest_image(const Vec3 &a) const
  {
    const auto nearest = [&](double x, int d) {
      return is_wrapped_[d] ? x - period(d) * std::round(x / period(d)) : x;
    };
    return {nearest(a.x, 0), nearest(a.y, 1), nearest(a.z, 2)};
  }

  Vec3 wrapped(const Vec3 &a) const
  {
    const auto inside = [&](double x, int d) {
      return is_wrapped_[d] ? x - period(d) * std::floor((x - frame_.box[d][0]) / period(d)) : x;
    };
    return {inside(a.x, 0), inside(a.y, 1), inside(a.z, 2)};
  }

  static Vec3 mean_of_rows(const VectorColumns &columns, const std::vector<Sphere> &spheres)
  {
    Vec3 sum{0.0, 0.0, 0.0};
    for (const Sphere &s : spheres) sum = sum + columns.of(s.row);
    return (1.0 / static_cast<double>(spheres.size())) * sum;
  }

  Vec3 omega_of(const std::vector<Sphere> &spheres, const std::vector<double> &along,
                const Vec3 &u) const
  {
    // Numbers that were equal before they were printed are equal.
    const Vec3 own = omega_.of(spheres[0].row);
    const bool turn_alike = std::all_of(spheres.begin(), spheres.end(), [&](const Sphere &s) {
      const Vec3 w = omega_.of(s.row);
      return w.x == own.x && w.y == own.y && w.z == own.z;
    });
    if (omega_.are_there() && (turn_alike || !velocity_.are_there())) return own;
    if (!velocity_.are_there()) return {0.0, 0.0, 0.0};
    Vec3 turn{0.0, 0.0, 0.0};
    double moment = 0.0;
    for (std::size_t i = 0; i < spheres.size(); i++) {
      turn = turn + along[i] * cross(u, velocity_.of(spheres[i].row));
      moment += along[i] * along[i];
    }
    return (1.0 / moment) * turn + dot(mean_of_rows(omega_, spheres), u) * u;
  }

  const DumpFrame &frame_;
  const GluedRodOptions &options_;
  std::size_t id_, body_;
  std::optional<std::size_t> type_, density_;
  PlaceColumns place_;
  std::size_t radius_;
  VectorColumns velocity_, omega_;
  std::array<bool, 3> is_wrapped_{};  // places are inside the box, so that bodies may lie across it
};

}  // namespace

std::vector<GluedRod> glued_rods(const DumpFrame &frame, const GluedRodOptions &options)
{
  if (frame.box_is_tilted)
    throw InputError(fmt::format("{}: step {}: the box is tilted, wanted an orthogonal one",
                                 frame.path, frame.step));
  return Bodies(frame, options).rods();
}

}  // namespace spherocylinder
