// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {

// Makes the stock pair_style gran and fix wall/gran understand `model linear` and
// `surface spherocylinder`, with each of LIGGGHTS's contact models. Once a process.
void register_contact_styles();

}  // namespace LAMMPS_NS
