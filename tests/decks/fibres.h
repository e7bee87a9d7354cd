// SPDX-License-Identifier: GPL-2.0-or-later
// Fibres of equal segments as scenes, and the beam they are slices of.
#pragma once

#include <string>
#include <vector>

#include "deck_run.h"
#include "scene.h"

namespace decks {

struct Fibre {
  int segments = 9;
  double joint_distance = 0.02;  // h (m)
  double radius = 0.002;
  double youngs_modulus = 1e7, poissons_ratio = 0.3;
  double density = 1000.0;
  double stretch_factor = 1.0;

  double bending_rigidity() const;  // E I (N m^2)
  double bend_stiffness() const { return bending_rigidity() / joint_distance; }
  double twist_stiffness() const { return bend_stiffness() / (1.0 + poissons_ratio); }
  double shear_stiffness() const;    // kappa G A/h (N/m)
  double stretch_stiffness() const;  // E A/h
  double mass_per_length() const;
  double segment_mass() const { return mass_per_length() * joint_distance; }  // of an inner one
  double cap_mass() const;                                                    // of one hemisphere
  // The lowest angular frequency of a clamped fibre of the length L: 1.8751^2 sqrt(E I/rho_l)/L^2.
  double lowest_frequency(double length) const;
  // A step well below what stretch, shear, bending and twist allow.
  double time_step() const;
};

// Straight along `direction`, the first segment's centre at `start`.
std::vector<Rod> straight_rods(const Fibre &fibre, const Vec3 &start, const Vec3 &direction);

// Pair style (its springs of 1000 N/m), joints and motion; the rods are joined where their ends meet.
std::string fibre_physics(const Fibre &fibre, const std::string &keywords = "");

// Group `clamp`: the rod with id 1, frozen.
extern const char *const kClampFirst;

// A drag on the centres that lets the lowest mode of a clamped fibre die out as fast as possible, and steps
// in which it is below 1e-10. `slower`: its frequency over the one without loads.
std::string drag_of(const Fibre &fibre, double length, double slower = 1.0);
long steps_to_rest(const Fibre &fibre, double length, double slower = 1.0);

Scene fibre_scene(const Fibre &fibre);

// On two ranks: 500 steps, a restart file `half` in `folder`, 500 more; from the file these come to the same bits, in
// the last frame of `columns`, which is returned. `thermo`: commands of output.
Snapshot expect_same_bits_from_half(const DeckFolder &folder, const Scene &scene,
                                    const std::string &columns, const std::string &thermo = "");
// What rods and fibres are after a step.
extern const char *const kStateColumns;

spherocylinder::MassProperties properties_of(const Rod &rod, int shared_ends);

// Of a chain's k-th of n rods.
int shared_ends(int k, int n);

struct Totals {
  Vec3 momentum{0.0, 0.0, 0.0}, angular_momentum{0.0, 0.0, 0.0};
};

// About the origin; one fibre, whose rods are all there is.
Totals totals_of(const std::vector<Rod> &rods);

void shake(std::vector<Rod> &rods, double speed, double omega, unsigned prime_seed);

// Curled fibres in a periodic box, which lie across subdomains and boundaries and touch each other.
Scene tangle(const std::string &keywords = "damping 0.1");

// Places apart by whole periods are the same.
double difference_in_period(const Scene &scene, const std::vector<Frame> &a,
                            const std::vector<Frame> &b);

}  // namespace decks
