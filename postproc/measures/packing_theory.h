// SPDX-License-Identifier: GPL-2.0-or-later
// Solid fractions that theory gives for random packings of rods.
#pragma once

namespace spherocylinder {

// <|sin gamma|> over pairs of axes, gamma the angle between them.
constexpr double kIsotropicSinGamma = 0.78539816339744831;   // pi/4
constexpr double kHorizontalSinGamma = 0.63661977236758134;  // 2/pi, axes at random in a plane

// Half the mean number of contacts of a rod: 5.25 -+ 0.03 measured for poured rods (Desmond &
// Franklin, Phys. Rev. E 73 (2006) 031306).
constexpr double kHalfContactsPerRod = 5.25;

// Aspect ratios from which on the theories, which are for slender rods, are given: where the first
// has its maximum, e, and where the second comes below the densest packing for any direction. Below
// them the functions give NaN, as for a value above the densest packing.
constexpr double kParkhouseKellyFrom = 2.71828182845904524;
constexpr double kRandomContactsFrom = 5.0;

// The densest known packing of equal capsules, all parallel: hexagonal layers of touching
// cylinders, whose round ends fit into each other as in a close packing of spheres (pi/sqrt 18 at
// lambda = 1):
//   pi/sqrt 12 (x + 2/3)/(x + sqrt(2/3)),  x = lambda - 1.
double densest_fraction(double aspect_ratio);

// 2 ln(lambda)/lambda, lambda = total length / diameter (Parkhouse & Kelly, Proc. R. Soc. Lond. A
// 451 (1995) 737).
double parkhouse_kelly_fraction(double aspect_ratio);

// Random contact equation V_f = 2 c V_p/V_ex (Philipse, Langmuir 12 (1996) 1127) for capsules with
// cylinder part x = lambda - 1 diameters long, volumes in units of pi D^3:
//   V_p = x/4 + 1/6,  V_ex = (2 s/pi) x^2 + 2 x + 4/3,  s = <|sin gamma|>.
// For beds of nearly parallel rods, whose contacts are not random, it exceeds what space there is.
double random_contact_fraction(double aspect_ratio, double mean_sin_gamma,
                               double half_contacts = kHalfContactsPerRod);

}  // namespace spherocylinder
