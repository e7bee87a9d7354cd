// SPDX-License-Identifier: GPL-2.0-or-later
// What a deck's dump says of its rods at one time step.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/vec3.h"

namespace grammar {

using spherocylinder::Vec3;

struct Rod {
  int id = 0, type = 1;
  Vec3 x{}, v{}, omega{}, axis{}, force{}, torque{};
  int image[3] = {0, 0, 0};
  double radius = 0.0, length = 0.0, density = 0.0, mass = 0.0;
  double quaternion_norm = 1.0;
  double contacts = 0.0;  // as compute contact/spherocylinder says

  double half_cylinder() const { return 0.5 * length - radius; }
  double inertia_axial() const;
  double inertia_transverse() const;
  Vec3 angular_momentum() const;  // about its own centre
  double kinetic_energy() const;  // of translation and rotation
};

struct Box {
  double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {0.0, 0.0, 0.0};
  bool periodic[3] = {false, false, false};
  bool fixed[3] = {true, true, true};  // neither periodic nor following the rods
  bool exact = false;                  // a dump's head gives its bounds with six digits only

  double period(int d) const { return hi[d] - lo[d]; }
  // The difference of two positions to the nearest image.
  Vec3 nearest(Vec3 difference) const;
};

struct State {
  long step = 0;
  Box box;
  std::map<int, Rod> rods;  // by id
};

// The columns that read_states wants; the first is the id.
extern const char *const kColumns;

// A dump command with enough digits to get every bit back, and its dump_modify.
std::string dump_commands(const std::string &id, const std::string &file, long every);

// Throws std::runtime_error for a file that is not such a dump.
std::vector<State> read_states(const std::filesystem::path &file);

// Where the periodic bounds are those of `known` to the digits of a dump's head, they are taken
// from there.
void make_exact(Box &box, const Box &known);

inline double component(const Vec3 &a, int d) { return d == 0 ? a.x : d == 1 ? a.y : a.z; }
inline double &component(Vec3 &a, int d) { return d == 0 ? a.x : d == 1 ? a.y : a.z; }
bool finite(const Vec3 &a);

// A vector turned by `angle` about the unit vector `about` (Rodrigues).
Vec3 turned(const Vec3 &a, const Vec3 &about, double angle);

}  // namespace grammar
