# SPDX-License-Identifier: GPL-2.0-or-later
"""A rod's mass properties, its free motion and distances, for the closed forms of the scenes.

Nothing here is taken from the plug-in: the scenes' answers are independent of it.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

DIAMETER = 0.01   # m
DENSITY = 2700.0  # kg/m³
RADIUS = 0.5 * DIAMETER


@dataclass(frozen=True)
class Properties:
    height: float   # of the cylinder, m
    mass: float     # kg
    axial: float    # moment of inertia about the axis, kg m²
    across: float   # about a line at right angles to it through the centre, kg m²

    @property
    def length(self) -> float:
        return self.height + DIAMETER


def properties(aspect: float) -> Properties:
    """Of a cylinder with two hemispheres, `aspect` diameters long in all."""
    h, r = (aspect - 1.0) * DIAMETER, RADIUS
    cylinder, ends = DENSITY * np.pi * r**2 * h, DENSITY * 4.0 / 3.0 * np.pi * r**3
    across = (cylinder * (h**2 / 12 + r**2 / 4)
              + ends * (0.4 * r**2 + h**2 / 4 + 0.375 * h * r))
    return Properties(h, cylinder + ends, (cylinder / 2 + 0.4 * ends) * r**2, across)


def damping_ratio(restitution: float) -> float:
    """Of the oscillator that parts at zero overlap with this restitution."""
    return -np.log(restitution) / np.hypot(np.pi, np.log(restitution))


def inverse_mass(rod: Properties, arm: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """1/m + |a × n|²/I_t: how much a point of the axis gives way to a unit impulse along n."""
    return 1.0 / rod.mass + np.sum(np.cross(arm, normal) ** 2, axis=-1) / rod.across


def turned(vector: np.ndarray, direction: np.ndarray, angle) -> np.ndarray:
    """`vector` turned about the unit vector `direction` by `angle` (Rodrigues' formula)."""
    angle = np.asarray(angle)[..., None]
    along = np.sum(direction * vector, axis=-1, keepdims=True)
    return (np.cos(angle) * vector + np.sin(angle) * np.cross(direction, vector)
            + (1.0 - np.cos(angle)) * along * direction)


def angular_momentum(rod: Properties, omega: np.ndarray, axis: np.ndarray) -> np.ndarray:
    along = np.sum(omega * axis, axis=-1, keepdims=True)
    return rod.across * omega + (rod.axial - rod.across) * along * axis


def free_axis(rod: Properties, axis: np.ndarray, momentum: np.ndarray, time) -> np.ndarray:
    """The axis of a free rod after `time`: it goes round the angular momentum L at |L|/I_t."""
    size = np.linalg.norm(momentum, axis=-1)
    direction = momentum / np.where(size > 0, size, 1.0)[..., None]
    return turned(axis, direction, size / rod.across * time)


def quaternion(axis: np.ndarray) -> np.ndarray:
    """(w, x, y, z) of a rotation that takes z to each axis."""
    w = np.sqrt(0.5 * np.maximum(0.0, 1.0 + axis[:, 2]))
    q = np.stack([w, -axis[:, 1], axis[:, 0], np.zeros(len(axis))], axis=1)
    q[:, 1:3] /= np.where(w > 1e-8, 2.0 * w, 1.0)[:, None]
    q[w <= 1e-8] = [0.0, 1.0, 0.0, 0.0]
    return q / np.linalg.norm(q, axis=1)[:, None]


def segment_distance(centre_a, axis_a, half_a, centre_b, axis_b, half_b) -> np.ndarray:
    """Distance of pairs of segments: the least of the lines' common point, if it is inside both,
    and of the four ends against the other segment."""
    between = centre_a - centre_b
    cosine = np.sum(axis_a * axis_b, axis=-1)
    along_a, along_b = np.sum(between * axis_a, axis=-1), np.sum(between * axis_b, axis=-1)
    sine2 = np.maximum(1.0 - cosine**2, 1e-300)

    def gap(s, t):
        return np.linalg.norm(between + s[..., None] * axis_a - t[..., None] * axis_b, axis=-1)

    s = (cosine * along_b - along_a) / sine2
    t = (along_b - cosine * along_a) / sine2
    inside = (np.abs(s) <= half_a) & (np.abs(t) <= half_b)
    least = np.where(inside, gap(s, t), np.inf)
    for sign in (-1.0, 1.0):
        end = np.full_like(along_a, sign * half_a)
        least = np.minimum(least, gap(end, np.clip(along_b + cosine * end, -half_b, half_b)))
        end = np.full_like(along_a, sign * half_b)
        least = np.minimum(least, gap(np.clip(cosine * end - along_a, -half_a, half_a), end))
    return least
