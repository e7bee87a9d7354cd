// SPDX-License-Identifier: GPL-2.0-or-later
// printf-style errors and warnings through LIGGGHTS's Error. Each is one sentence that says who, what,
// the value seen and the value wanted.
#pragma once

namespace LAMMPS_NS {

class LAMMPS;

// `all`: called by every rank; `one`: by any rank.
[[noreturn]] void rod_error_all(LAMMPS *lmp, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
[[noreturn]] void rod_error_one(LAMMPS *lmp, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Printed by the calling rank.
void rod_warning(LAMMPS *lmp, const char *format, ...) __attribute__((format(printf, 2, 3)));

}  // namespace LAMMPS_NS
