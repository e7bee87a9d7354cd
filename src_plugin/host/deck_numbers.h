// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace LAMMPS_NS {

class LAMMPS;

// A number that a deck gives, or an error, called by every rank: "who: what must be a number (got
// word)". `who` as in "Fix limit/omega (id lim)".
double deck_number(LAMMPS *lmp, const std::string &who, const std::string &what,
                   const std::string &word);
int deck_whole_number(LAMMPS *lmp, const std::string &who, const std::string &what,
                      const std::string &word);

// A quaternion typed by hand may be off unit length by what three digits cost; it is then
// normalised.
constexpr double kQuaternionTolerance = 1e-3;

// "Fix style (id id)", of a fix's command line.
std::string fix_and_id(char **arg);

}  // namespace LAMMPS_NS
