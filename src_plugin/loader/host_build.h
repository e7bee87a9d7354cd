// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace spherocylinder {

// How the host was built otherwise than the one this plug-in was compiled for, whose version text may be
// the same ("it is built with superquadrics"); empty if nothing is found. Asked of a LAMMPS object
// that has only just been made.
std::string foreign_build(LAMMPS_NS::LAMMPS *lmp);

}  // namespace spherocylinder
