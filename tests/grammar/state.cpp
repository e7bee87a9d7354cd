// SPDX-License-Identifier: GPL-2.0-or-later
#include "state.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace grammar {

const char *const kColumns =
    "id type ix iy iz x y z vx vy vz omegax omegay omegaz shapex shapez density mass "
    "quat1 quat2 quat3 quat4 fx fy fz tqx tqy tqz c_contacts";

namespace {

constexpr size_t kIntegers = 5, kAll = 29;

// Cylinder and the two hemispheres together, of one density.
double cylinder_share(const Rod &rod)
{
  const double h = 2.0 * rod.half_cylinder();
  return h / (h + 4.0 / 3.0 * rod.radius);
}

Rod rod_from(const std::vector<double> &c)
{
  Rod rod;
  rod.id = static_cast<int>(c[0]);
  rod.type = static_cast<int>(c[1]);
  for (int d = 0; d < 3; d++) rod.image[d] = static_cast<int>(c[2 + d]);
  const auto vector = [&](size_t k) { return Vec3{c[k], c[k + 1], c[k + 2]}; };
  rod.x = vector(5);
  rod.v = vector(8);
  rod.omega = vector(11);
  rod.radius = c[14];
  rod.length = 2.0 * c[15];
  rod.density = c[16];
  rod.mass = c[17];
  const double w = c[18], x = c[19], y = c[20], z = c[21];
  rod.quaternion_norm = std::sqrt(w * w + x * x + y * y + z * z);
  rod.axis = {2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z};
  rod.force = vector(22);
  rod.torque = vector(25);
  rod.contacts = c[28];
  return rod;
}

std::vector<double> numbers_of(const std::string &line)
{
  std::vector<double> numbers;
  const char *at = line.c_str();
  char *end = nullptr;
  for (double value = std::strtod(at, &end); end != at; value = std::strtod(at, &end)) {
    numbers.push_back(value);
    at = end;
  }
  return numbers;
}

void read_box(std::ifstream &in, const std::string &header, Box &box)
{
  std::istringstream words(header);
  std::string word;
  for (int k = 0; k < 3; k++) words >> word;  // ITEM: BOX BOUNDS
  for (int d = 0; d < 3; d++) {
    words >> word;
    box.periodic[d] = word == "pp";
    box.fixed[d] = word == "ff";
    std::string line;
    std::getline(in, line);
    const std::vector<double> bounds = numbers_of(line);
    if (bounds.size() < 2) throw std::runtime_error("a dump without bounds of the box");
    box.lo[d] = bounds[0];
    box.hi[d] = bounds[1];
  }
}

}  // namespace

double Rod::inertia_axial() const
{
  const double share = cylinder_share(*this);
  return mass * radius * radius * (0.5 * share + 0.4 * (1.0 - share));
}

double Rod::inertia_transverse() const
{
  const double share = cylinder_share(*this), h = 2.0 * half_cylinder(), r = radius;
  return mass * (share * (h * h / 12.0 + r * r / 4.0) +
                 (1.0 - share) * (0.4 * r * r + h * h / 4.0 + 3.0 / 8.0 * h * r));
}

Vec3 Rod::angular_momentum() const
{
  return inertia_transverse() * omega +
         (inertia_axial() - inertia_transverse()) * dot(omega, axis) * axis;
}

double Rod::kinetic_energy() const
{
  return 0.5 * mass * norm_squared(v) + 0.5 * dot(omega, angular_momentum());
}

Vec3 Box::nearest(Vec3 difference) const
{
  for (int d = 0; d < 3; d++)
    if (periodic[d]) {
      double &along = component(difference, d);
      along -= period(d) * std::round(along / period(d));
    }
  return difference;
}

std::string dump_commands(const std::string &id, const std::string &file, long every)
{
  std::string format;
  for (size_t k = 0; k < kAll; k++) format += k < kIntegers ? "%d " : "%.17g ";
  format.pop_back();
  return fmt::format("dump {0} all custom {1} {2} {3}\ndump_modify {0} first yes format \"{4}\"\n",
                     id, every, file, kColumns, format);
}

std::vector<State> read_states(const std::filesystem::path &file)
{
  std::ifstream in(file);
  if (!in) throw std::runtime_error("no dump " + file.filename().string());
  std::vector<State> states;
  std::string line;
  while (std::getline(in, line)) {
    if (line.rfind("ITEM: TIMESTEP", 0) == 0) {
      std::getline(in, line);
      states.emplace_back();
      states.back().step = std::atol(line.c_str());
    } else if (line.rfind("ITEM: BOX BOUNDS", 0) == 0) {
      read_box(in, line, states.back().box);
    } else if (line.rfind("ITEM: NUMBER", 0) == 0) {
      std::getline(in, line);
    } else if (line.rfind("ITEM:", 0) != 0) {
      const std::vector<double> numbers = numbers_of(line);
      if (numbers.size() != kAll || states.empty())
        throw std::runtime_error("a broken line in " + file.filename().string() + ": " + line);
      const Rod rod = rod_from(numbers);
      if (!states.back().rods.emplace(rod.id, rod).second)
        throw std::runtime_error(
            fmt::format("two rods of id {} at step {}", rod.id, states.back().step));
    }
  }
  return states;
}

void make_exact(Box &box, const Box &known)
{
  box.exact = true;
  for (int d = 0; d < 3; d++) {
    if (!box.periodic[d]) continue;
    const auto differ = [](double rounded, double known_bound) {
      return std::fabs(rounded - known_bound) > 5.1e-6 * std::fabs(known_bound);
    };
    if (differ(box.lo[d], known.lo[d]) || differ(box.hi[d], known.hi[d])) box.exact = false;
  }
  for (int d = 0; d < 3; d++)
    if (box.exact && box.periodic[d]) {
      box.lo[d] = known.lo[d];
      box.hi[d] = known.hi[d];
    }
}

bool finite(const Vec3 &a)
{
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

Vec3 turned(const Vec3 &a, const Vec3 &about, double angle)
{
  return std::cos(angle) * a + std::sin(angle) * cross(about, a) +
         (1.0 - std::cos(angle)) * dot(about, a) * about;
}

}  // namespace grammar
