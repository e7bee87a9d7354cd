// SPDX-License-Identifier: GPL-2.0-or-later
// Solid fractions that theory gives for random packings of rods.
#pragma once

namespace spherocylinder {

// <|sin gamma|> over pairs of axes, gamma the angle between them.
constexpr double isotropic_sin_gamma = 0.78539816339744831;   // pi/4
constexpr double horizontal_sin_gamma = 0.63661977236758134;  // 2/pi, axes at random in a plane

// Half the mean number of contacts of a rod: 5.25 -+ 0.03 measured for poured rods (Desmond &
// Franklin, Phys. Rev. E 73 (2006) 031306).
constexpr double half_contacts_per_rod = 5.25;

// 2 ln(lambda)/lambda, lambda = total length / diameter (Parkhouse & Kelly, Proc. R. Soc. Lond. A
// 451 (1995) 737).
double parkhouse_kelly_fraction(double aspect_ratio);

// Random contact equation V_f = 2 c V_p/V_ex (Philipse, Langmuir 12 (1996) 1127) for capsules with
// cylinder part x = lambda - 1 diameters long, volumes in units of pi D^3:
//   V_p = x/4 + 1/6,  V_ex = (2 s/pi) x^2 + 2 x + 4/3,  s = <|sin gamma|>.
// Meant for long rods; at lambda = 1 it gives c/4 and means nothing.
double random_contact_fraction(double aspect_ratio, double mean_sin_gamma,
                               double half_contacts = half_contacts_per_rod);

}  // namespace spherocylinder
