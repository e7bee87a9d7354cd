# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms of the failures. One contact of stiffness k and damping ratio β, at which the mass
m_eff moves with a frequency ω = √(k/m_eff), is integrated with the step dt; h = ω dt, and h = 2 is
the limit of a spring without damping, dt_c. The scheme is that of all of LIGGGHTS's contacts: the
force is made of the overlap of now and of the velocity half a step ago,

    v' = (1 − 2βh) v − h x        x' = x + h v'        (x in units of v/ω)

Nothing here is taken from the plug-in.
"""
from __future__ import annotations

import functools
import math

import numpy as np

from studies.common.settling import DIAMETER, GRAVITY
from studies.speed_accuracy.rods import damping_ratio, properties


def lightest_mass(aspect: float) -> float:
    """Effective mass of the lightest contact along its normal: two rods end to end at right angles
    to the line of their centres, 1/m_eff = 2 (1/m + a²/I_t), a the arm of the end of an axis. Thin
    rods: m/8."""
    rod = properties(aspect)
    return 0.5 / (1.0 / rod.mass + (0.5 * rod.height) ** 2 / rod.across)


def over_thin(aspect: float) -> float:
    """Its limit of the step over that of thin rods, by which steps are told: √(8 m_eff/m)."""
    return math.sqrt(8.0 * lightest_mass(aspect) / properties(aspect).mass)


def damping_at_ends(aspect: float, restitution: float, effective_mass: bool = True) -> float:
    """β of the lightest contact. Damped for the mass of whole rods, m/2, it is that of a central
    hit times √(m/2 / m_eff): twice as much for thin rods."""
    beta = damping_ratio(restitution) if restitution < 1 else 0.0
    if effective_mass:
        return beta
    return beta * math.sqrt(0.5 * properties(aspect).mass / lightest_mass(aspect))


def stable_limit(beta: float) -> float:
    """Largest dt/dt_c at which a contact that lasts stays bounded: the roots of z² − (2 − 2βh −
    h²) z + 1 − 2βh lie in the unit circle as long as h² + 4βh < 4."""
    return math.sqrt(1.0 + beta ** 2) - beta


def gain_onset(beta: float) -> float:
    """Least dt/dt_c at which a hit can gain energy: one that is met in one step and left in the
    next, having gone in by a whole one, ends with −v' = (h² + 2βh − 1) v > v."""
    return 0.5 * (math.sqrt(2.0 + beta ** 2) - beta)


@functools.lru_cache
def mean_onset(beta: float) -> float:
    """Least dt/dt_c above which hits gain energy on average over all phases between hit and step,
    by the scheme."""
    phases = (np.arange(2000) + 0.5) / 2000
    low, high = gain_onset(beta), 1.5
    for _ in range(30):
        middle = 0.5 * (low + high)
        energy = np.mean(restitution_of_hit(2.0 * middle, beta, phases) ** 2)
        low, high = (low, middle) if energy > 1.0 else (middle, high)
    return 0.5 * (low + high)


def restitution_of_hit(h: float, beta: float, phase) -> np.ndarray:
    """Velocity after a hit over that before, by the scheme. phase: the part of its first step by
    which the hit has gone in, from 0 to 1. NaN: not out within 10,000 steps."""
    phase = np.asarray(phase, dtype=float)
    v, x = np.ones_like(phase), h * phase
    out = np.full_like(phase, np.nan)
    for _ in range(10_000):
        inside = np.isnan(out)
        if not inside.any():
            break
        v = np.where(inside, (1.0 - 2.0 * beta * h) * v - h * x, v)
        x = np.where(inside, x + h * v, x)
        out = np.where(inside & (x <= 0), -v, out)
    return out


def largest_overlap(speed: float, mass: float, stiffness: float, beta: float) -> float:
    """Of a damped hit, m: v/ω · exp(−β/√(1−β²) · arccos β)."""
    omega = math.sqrt(stiffness / mass)
    return speed / omega * math.exp(-beta / math.sqrt(1.0 - beta ** 2) * math.acos(beta))


def speed_through(stiffness: float, aspect: float, restitution: float, diameter: float) -> float:
    """Speed at which two rods end on end are driven as deep as a whole diameter, so that their axes
    cross."""
    beta = damping_at_ends(aspect, restitution)
    mass = lightest_mass(aspect)
    return diameter / largest_overlap(1.0, mass, stiffness * aspect, beta)


def fall_time(aspect: float) -> float:
    """Of a rod that tips over from near upright, about its lower end: some of √(2 L/(3 g)), the
    time in which its tilt grows e-fold (s)."""
    return 3.0 * math.sqrt(2.0 * aspect * DIAMETER / (3.0 * GRAVITY))
