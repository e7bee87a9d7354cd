// SPDX-License-Identifier: GPL-2.0-or-later
// What must hold before a run with rods, checked at each run's start. Each failure is one sentence
// that says who, what, the value seen and the value wanted. Styles of LIGGGHTS that do not know rods:
// loader/host_styles.h.
#pragma once

#include <vector>

namespace LAMMPS_NS {

class AtomVecSpherocylinder;
class LAMMPS;

// printf-style errors through LIGGGHTS's Error. `all`: called by every rank; `one`: by any rank.
[[noreturn]] void rod_error_all(LAMMPS *lmp, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
[[noreturn]] void rod_error_one(LAMMPS *lmp, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Printed by the calling rank.
void rod_warning(LAMMPS *lmp, const char *format, ...) __attribute__((format(printf, 2, 3)));

// A quaternion typed by hand may be off unit length by what three digits cost; it is then
// normalised.
constexpr double kQuaternionTolerance = 1e-3;

// The rods' atom style, or an error that names `who` if the simulation has another one.
AtomVecSpherocylinder &rods_of(LAMMPS *lmp, const char *who);

// How a pair style finds its contacts: values of keywords that are no on or off.
struct SearchKeywords {
  double close_skin = 0.0;  // a length (m), 0 for `auto`
  bool five_step = false;   // search five_step
};

// Arguments of a pair style or wall without these keywords.
std::vector<char *> args_without_search(LAMMPS *lmp, int nargs, char **args, SearchKeywords &search);

void check_atom_style_is_alone(LAMMPS *lmp);

// Each rod has a size; its mass and inertia follow a density that was changed from outside.
void check_rods_are_whole(LAMMPS *lmp, AtomVecSpherocylinder &rods);

// Whether the box is so short that two rods may touch through two images at a time; `warn` says so.
bool check_rods_fit_periodic_box(LAMMPS *lmp, bool warn);

// Called by all ranks whenever rods go from rank to rank, when the histories of contacts are with
// their rods.
void check_pairs_touch_once(LAMMPS *lmp);

// LIGGGHTS's property matrices end at the highest type that was in use when the run began.
void check_types_have_properties(LAMMPS *lmp, int highest);

// Without our surface model the stock pair and wall would use the rods' bounding spheres.
void check_contact_styles_know_rods(LAMMPS *lmp);

// Of contact models with a tangential force: friction would push with a coefficient < 0.
void check_friction(LAMMPS *lmp);

}  // namespace LAMMPS_NS
