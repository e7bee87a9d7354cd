// SPDX-License-Identifier: GPL-2.0-or-later
// Two slow methods for the distance of two segments, neither sharing a formula with the core.
#pragma once

#include "core/capsule.h"

// Quadruple precision where the compiler has it. On 64-bit ARM long double is that already.
#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Wide;
#else
typedef long double Wide;
#endif

// Minimum over the nine faces of the rectangle |s| <= h_i, |t| <= h_j (inside, four edges, four
// corners) of f(s, t) = |c_i + s u - c_j - t v|^2. Axes are taken as stored, not as unit vectors.
//
// In quadruple precision the determinant (u.u)(v.v) - (u.v)^2 of axes 1e-12 apart still has ten
// digits; what s then lacks is a shift along a valley that rises by the angle squared, below 1e-20
// of a length. Below angles of 1e-16 the edges alone are right to 1e-16 of a length.
long double distance_by_faces(const spherocylinder::Segment &i, const spherocylinder::Segment &j);

// Ternary search over s of the convex function min_t |p(s) - q(t)|, in long double.
long double distance_by_search(const spherocylinder::Segment &i, const spherocylinder::Segment &j);
