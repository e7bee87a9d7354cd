# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes: where many copies of one small event begin, and what is known of how they end.

A scene's answer is a closed form; for `row` it is a slow calculation of its own, and of `gas` it is that hard
rods keep their energy of motion. The error is the root mean square over the copies of what a code misses,
over that of the answer.
"""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Callable

import numpy as np

from studies.speed_accuracy.rods import (DENSITY, DIAMETER, RADIUS, Properties, angular_momentum, damping_ratio, free_axis,
                  inverse_mass, properties, segment_distance)

GRAVITY = 9.81
UP = np.array([0.0, 0.0, 1.0])
SOFTEST = 2.0e3  # N/m times the aspect ratio: a tenth of the stiffness of the decks in input/


@dataclass
class State:
    """Of the rods that move, in their order: a row a rod."""
    position: np.ndarray
    velocity: np.ndarray
    momentum: np.ndarray  # angular
    axis: np.ndarray      # of either sign


@dataclass
class Scene:
    aspect: float
    start: State
    duration: float                # s
    # Quantity: what each copy (the gas: each frame) misses, relative; of the frames, the last at the end.
    errors: Callable[[list[State]], dict[str, np.ndarray]]
    restitution: float = 0.5
    friction: list[float] | None = None  # of the atom types of rods that move; None: frictionless
    types: np.ndarray | None = None      # of the rods that move, from 1
    fixed_position: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    fixed_axis: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    fixed_length: float = 0.0      # m
    floor: bool = False
    gravity: np.ndarray = field(default_factory=lambda: np.zeros(3))
    copies: int = 0
    contacts: Callable[[int], float] = lambda n: 1.0  # at once, of a rod of n glued spheres
    nominal_mass: float = 0.0      # what moves at a contact through the centres, kg
    mean_mass: float = 0.0         # what moves at the contacts of this scene, in the mean, kg
    least_mass: float = 0.0        # of a contact of one rod's end, kg: sets the limit of the step
    skin: float = 0.5              # of the peer's lists, diameters
    stiff: bool = True             # whether the stiffness matters
    pairs: bool = False            # whether rods that move touch each other
    frames: int = 1                # read during the run
    period: float = 0.0            # of a periodic cube about the origin, m; 0: none

    @property
    def rod(self) -> Properties:
        return properties(self.aspect)


def end_mass(rod: Properties, partners: int) -> float:
    """The least effective mass: of one rod's end, or of two rods end to end off their centres."""
    return 1.0 / (partners * (1.0 / rod.mass + (0.5 * rod.height) ** 2 / rod.across))


def contact_time(mass: float, stiffness: float, restitution: float) -> float:
    beta = damping_ratio(restitution) if restitution < 1.0 else 0.0
    return np.pi * np.sqrt(mass / stiffness / (1.0 - beta**2))


def unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def grid(count: int, width: float, depth: float, height: float = 0.0) -> np.ndarray:
    """Places of `count` copies, about a square seen from above; a cube if `height` is given."""
    if height > 0.0:
        layers = max(1, round((count * width * depth) ** (1 / 3) / height ** (2 / 3)))
    else:
        layers = 1
    a_layer = -(-count // layers)
    columns = max(1, round(np.sqrt(a_layer * depth / width)))
    n = np.arange(count)
    places = np.stack([n % a_layer % columns * width, n % a_layer // columns * depth,
                       n // a_layer * height], axis=1)
    if layers == 1:
        places[:, 2] = 0.0
        return places - 0.5 * (places.max(axis=0) + places.min(axis=0))
    return places - 0.5 * (places.max(axis=0) + places.min(axis=0))


def energy_norm(rod: Properties, velocity: np.ndarray, momentum: np.ndarray) -> np.ndarray:
    """√(m v² + L²/I_t): a change of motion in the measure of its energy."""
    return np.sqrt(rod.mass * np.sum(velocity**2, axis=-1)
                   + np.sum(momentum**2, axis=-1) / rod.across)


def kinetic_energy(rod: Properties, state: State) -> np.ndarray:
    """Of each rod."""
    along = np.sum(state.momentum * state.axis, axis=1)
    return 0.5 * (rod.mass * np.sum(state.velocity**2, axis=1)
                  + (np.sum(state.momentum**2, axis=1) - along**2) / rod.across
                  + along**2 / rod.axial)


def relative(missed: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    return missed / np.sqrt(np.mean(wanted**2))


def impulse_errors(rod: Properties, start: State, velocity: np.ndarray, momentum: np.ndarray,
                   copy: np.ndarray | None = None) -> Callable[[list[State]], dict[str, np.ndarray]]:
    """Errors of the changes of velocity and angular momentum by an impact, as one number."""
    copy = np.arange(len(velocity)) if copy is None else copy

    def a_copy(values):
        return np.sqrt(np.bincount(copy, values**2))

    def errors(frames: list[State]) -> dict[str, np.ndarray]:
        end = frames[-1]
        missed = energy_norm(rod, end.velocity - start.velocity - velocity,
                             end.momentum - start.momentum - momentum)
        return {"impulse": relative(a_copy(missed), a_copy(energy_norm(rod, velocity, momentum)))}
    return errors


def resting(axis: np.ndarray, velocity: np.ndarray, position: np.ndarray) -> State:
    """Rods that do not turn."""
    return State(position, velocity, np.zeros_like(position), axis)


def free_end_height(rod: Properties, start: State, times: np.ndarray) -> np.ndarray:
    """The lower of both ends of free rods at each of `times` after the start: (times, rods)."""
    axis = np.stack([free_axis(rod, start.axis, start.momentum, t) for t in times])
    centre = start.position[None, :, 2] + times[:, None] * start.velocity[None, :, 2]
    return centre - 0.5 * rod.height * np.abs(axis[..., 2])


# --- Impacts: no friction, no weight. ------------------------------------------------------------

def wall(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """A rod comes down on one end on a floor.

    K = 1/m + |a × n|²/I_t, J = (1 + e) v/K, Δv = J n/m, ΔL = a × n J, with the arm a of the end.
    """
    rod, e = properties(aspect), 0.5
    duration = 3.0 * contact_time(rod.mass, SOFTEST * aspect, e)
    found: list[tuple] = []
    while len(found) < copies:
        elevation, turn = np.radians(rng.uniform(15, 80)), rng.uniform(-0.3, 0.3)
        axis = np.array([np.cos(elevation) * np.cos(turn), np.cos(elevation) * np.sin(turn),
                         np.sin(elevation)])
        speed, touch = rng.uniform(0.5, 1.5), rng.uniform(0.02, 0.3) * duration
        arm = -0.5 * rod.height * axis
        impulse = (1.0 + e) * speed / inverse_mass(rod, arm, UP)
        after = State(np.array([[0.0, 0.0, RADIUS - arm[2]]]),
                      np.array([[0.0, 0.0, impulse / rod.mass - speed]]),
                      np.cross(arm, UP)[None] * impulse, axis[None])
        times = np.linspace(0.0, duration, 200)[1:]
        if np.all(free_end_height(rod, after, times) > RADIUS):  # nothing touches again
            found.append((axis, speed, touch, arm, impulse))
    axis, speed, touch, arm, impulse = (np.array(values) for values in zip(*found))
    velocity = -speed[:, None] * UP
    position = grid(copies, rod.length + 2 * DIAMETER, 0.4 * rod.length + 2 * DIAMETER)
    position[:, 2] = RADIUS - arm[:, 2] + speed * touch
    start = resting(axis, velocity, position)
    change = impulse[:, None] * UP / rod.mass, impulse[:, None] * np.cross(arm, UP)
    return Scene(aspect, start, duration, impulse_errors(rod, start, *change), e, floor=True,
                 copies=copies, nominal_mass=rod.mass,
                 mean_mass=float(np.mean(1.0 / inverse_mass(rod, arm, UP))),
                 least_mass=end_mass(rod, 1))


def crossed(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """A rod hits one at rest, crossing it anywhere along both.

    1/m_eff = Σ (1/m + |a × n|²/I_t), J = (1 + e) v m_eff along the common perpendicular n.
    """
    rod, e = properties(aspect), 0.5
    half = 0.5 * rod.height
    duration = 3.0 * contact_time(0.5 * rod.mass, SOFTEST * aspect, e)
    found: list[tuple] = []
    while len(found) < copies:
        a = unit(rng.normal(size=3))
        b = unit(rng.normal(size=3))
        sine = np.linalg.norm(np.cross(a, b))
        if sine < 0.5:
            continue
        normal = np.cross(a, b) / sine  # from the struck rod b to a
        arms = rng.uniform(-0.9, 0.9, 2)[:, None] * half * np.stack([a, b])
        speed, touch = rng.uniform(0.5, 1.5), rng.uniform(0.02, 0.3) * duration
        impulse = (1.0 + e) * speed / np.sum(inverse_mass(rod, arms, normal))
        sign = np.array([[1.0], [-1.0]])
        change = sign * impulse * normal / rod.mass, sign * impulse * np.cross(arms, normal)
        centre = DIAMETER * normal + arms[1] - arms[0]  # of a at the touch, as seen from b
        far = np.inf
        for t in np.linspace(0.1, 1.0, 40) * duration:
            axes = free_axis(rod, np.stack([a, b]), change[1], t)
            moved = centre + t * (change[0][0] - speed * normal - change[0][1])
            far = min(far, segment_distance(moved, axes[0], half, 0 * moved, axes[1], half))
        if far > DIAMETER:  # they do not meet again
            found.append((np.stack([a, b]), speed * normal, centre, touch, change, arms, impulse,
                          speed))
    place = grid(copies, 1.6 * rod.length + 0.02, 1.6 * rod.length + 0.02, 1.6 * rod.length + 0.02)
    axis = np.concatenate([f[0] for f in found])
    velocity = np.concatenate([np.stack([-f[1], 0 * f[1]]) for f in found])
    offset = np.concatenate([np.stack([f[2] + f[3] * f[1], 0 * f[1]]) for f in found])
    start = resting(axis, velocity, np.repeat(place, 2, axis=0) + offset)
    change = [np.concatenate([f[4][k] for f in found]) for k in (0, 1)]
    copy = np.repeat(np.arange(copies), 2)
    mean_mass = np.mean([f[6] / (1.0 + e) / f[7] for f in found])
    return Scene(aspect, start, duration, impulse_errors(rod, start, *change, copy), e,
                 copies=copies, nominal_mass=0.5 * rod.mass, mean_mass=float(mean_mass),
                 least_mass=end_mass(rod, 2), pairs=True)


def flat(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """A rod lands flat on a floor: Δv = (1 + e) v, no spin."""
    rod, e = properties(aspect), 0.5
    duration = 3.0 * contact_time(rod.mass, SOFTEST * aspect, e)
    turn, speed = rng.uniform(-0.3, 0.3, copies), rng.uniform(0.5, 1.5, copies)
    touch = rng.uniform(0.02, 0.3, copies) * duration
    axis = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    position = grid(copies, rod.length + 2 * DIAMETER, 0.4 * rod.length + 2 * DIAMETER)
    position[:, 2] = RADIUS + speed * touch
    start = resting(axis, -speed[:, None] * UP, position)
    change = (1.0 + e) * speed[:, None] * UP
    return Scene(aspect, start, duration, impulse_errors(rod, start, change, 0 * change), e,
                 floor=True, copies=copies, contacts=lambda n: n, nominal_mass=rod.mass,
                 mean_mass=rod.mass, least_mass=end_mass(rod, 1))


def parallel(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """A rod lands on a fixed one parallel to it, the normal n up to 20 degrees off the vertical:
    Δv = (1 + e) v cos ψ n, no spin. They are parallel to 10⁻⁶ rad, as no two rods are exactly."""
    rod, e = properties(aspect), 0.5
    duration = 3.0 * contact_time(rod.mass, SOFTEST * aspect, e)
    lean, speed = np.radians(rng.uniform(-20, 20, copies)), rng.uniform(0.5, 1.5, copies)
    touch = rng.uniform(0.02, 0.3, copies) * duration
    normal = np.stack([0 * lean, np.sin(lean), np.cos(lean)], axis=1)
    axis = unit(np.array([1.0, 0.0, 0.0]) + rng.normal(scale=1e-6, size=(copies, 3)))
    below = grid(copies, 2.0 * rod.length, 6 * DIAMETER)
    below[:, 2] += 0.5
    position = below + DIAMETER * normal + (speed * touch)[:, None] * UP
    start = resting(axis, -speed[:, None] * UP, position)
    change = ((1.0 + e) * speed * np.cos(lean))[:, None] * normal
    return Scene(aspect, start, duration, impulse_errors(rod, start, change, 0 * change), e,
                 fixed_position=below + rng.uniform(-1, 1, (copies, 1)) * DIAMETER * [1, 0, 0],
                 fixed_axis=np.tile([1.0, 0.0, 0.0], (copies, 1)),
                 fixed_length=rod.length + 4 * DIAMETER, copies=copies, contacts=lambda n: n,
                 nominal_mass=rod.mass, mean_mass=rod.mass, least_mass=end_mass(rod, 1))


def row_places(rod: Properties) -> np.ndarray:
    """Where the rods of a row stand, from the row's middle."""
    count = int(np.clip(rod.height / DIAMETER / 2, 2, 5))
    return (np.arange(count) - 0.5 * (count - 1)) * 1.1 * DIAMETER


def elastic_supports(rod: Properties, supports: np.ndarray, speed: float) -> tuple[float, float]:
    """Velocity and angular velocity of a rod that fell on springs at `supports` from its centre.

    m z'' = Σ k δ, I_t θ'' = Σ k δ x, δ = max(0, −z − x θ): velocity Verlet in units of √(m/k), until
    nothing touches. The stiffness has no part in the result.
    """
    inertia, dt = rod.across / rod.mass, 1e-3
    z = theta = rate = 0.0
    v = -speed

    def forces():
        overlap = np.maximum(0.0, -z - supports * theta)
        return np.sum(overlap), np.sum(overlap * supports) / inertia

    force, torque = forces()
    for _ in range(100_000):
        v, rate = v + 0.5 * dt * force, rate + 0.5 * dt * torque
        z, theta = z + dt * v, theta + dt * rate
        force, torque = forces()
        v, rate = v + 0.5 * dt * force, rate + 0.5 * dt * torque
        if force == 0.0 and np.all(v + supports * rate > 0.0):
            return v, rate
    raise ArithmeticError(f"a rod on supports at {supports} does not come off them")


def row(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """A rod lands flat across a row of fixed parallel rods, off its centre; elastic.

    The rod on springs of equal stiffness where it crosses the row's rods.
    """
    rod = properties(aspect)
    duration = 3.0 * contact_time(rod.mass, SOFTEST * aspect, 1.0)
    places = row_places(rod)
    room = 0.5 * rod.height - places.max()
    shift = rng.uniform(0.1, 0.5, copies) * min(room, 0.5 * rod.height)
    speed, touch = rng.uniform(0.5, 1.5, copies), rng.uniform(0.02, 0.3, copies) * duration
    turn = rng.uniform(-0.15, 0.15, copies)
    across = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    middle = grid(copies, 1.6 * rod.length, max(4.5 * DIAMETER, 0.35 * rod.length))
    middle[:, 2] += 0.5
    fixed = (middle[:, None] + places[None, :, None] * [1, 0, 0]
             + rng.uniform(-0.5, 0.5, (copies, len(places), 1)) * DIAMETER * [0, 1, 0])
    position = middle - shift[:, None] * across + (DIAMETER + speed * touch)[:, None] * UP
    start = resting(across, -speed[:, None] * UP, position)
    # Supports at (shift cos(turn) + place)/cos(turn) along the rod from its centre.
    after = np.array([elastic_supports(rod, s + places / np.cos(t), v)
                      for s, t, v in zip(shift, turn, speed)])
    velocity = (after[:, :1] + speed[:, None]) * UP
    # Up at x > 0 is a turn about across × up.
    momentum = rod.across * after[:, 1:] * np.cross(across, UP)
    return Scene(aspect, start, duration, impulse_errors(rod, start, velocity, momentum), 1.0,
                 fixed_position=fixed.reshape(-1, 3),
                 fixed_axis=np.tile([0.0, 1.0, 0.0], (fixed.size // 3, 1)),
                 fixed_length=4 * DIAMETER, copies=copies,
                 contacts=lambda n: len(places), nominal_mass=rod.mass, mean_mass=rod.mass,
                 least_mass=end_mass(rod, 1))


# --- Friction. -----------------------------------------------------------------------------------

def coulomb_errors(start: State, acceleration: float, frictional: float, duration: float):
    """Of the speed gained along x, over that which friction takes."""
    def errors(frames: list[State]) -> dict[str, np.ndarray]:
        end = frames[-1]
        gained = end.velocity[:, 0] - start.velocity[:, 0]
        return {"friction": np.abs(gained - acceleration * duration) / (frictional * duration)}
    return errors


def slide_along(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """A rod slides down a groove of two fixed rods parallel to it, slope b, half angle α = 45°:
    a = g (sin b − μ cos b/sin α)."""
    rod, slope, half, mu = properties(aspect), np.radians(30), np.radians(45), 0.2
    duration, load = 0.1, GRAVITY * np.cos(slope) / np.sin(half)
    gain = GRAVITY * np.sin(slope) - mu * load
    speed = rng.uniform(0.1, 0.4, copies)
    travel = 0.4 * duration + 0.5 * gain * duration**2
    place = grid(copies, rod.length + travel + 5 * DIAMETER, 6 * DIAMETER)
    fixed = []
    for side in (-1.0, 1.0):
        shift = np.array([0.5 * travel, 0, 0]) + rng.uniform(-1, 1, (copies, 1)) * RADIUS * [1, 0, 0]
        fixed.append(place + shift - DIAMETER * np.array([0, side * np.cos(half), np.sin(half)]))
    start = resting(np.tile([1.0, 0, 0], (copies, 1)), speed[:, None] * [1, 0, 0], place)
    return Scene(aspect, start, duration, coulomb_errors(start, gain, mu * load, duration),
                 friction=[mu], fixed_position=np.concatenate(fixed),
                 fixed_axis=np.tile([1.0, 0, 0], (2 * copies, 1)),
                 fixed_length=round((rod.length + travel) / DIAMETER + 2.5) * DIAMETER,
                 gravity=GRAVITY * np.array([np.sin(slope), 0, -np.cos(slope)]),
                 copies=copies, contacts=lambda n: n, nominal_mass=rod.mass, mean_mass=rod.mass,
                 least_mass=end_mass(rod, 1))


def slide_across(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """A rod slides along its axis down a slope b of fixed rods that cross it, three or more below
    it: a = g (sin b − μ cos b), however the load is shared among them."""
    rod, slope, mu, duration = properties(aspect), np.radians(30), 0.2, 0.1
    load = GRAVITY * np.cos(slope)
    gain = GRAVITY * np.sin(slope) - mu * load
    speed = rng.uniform(0.1, 0.4, copies)
    travel = 0.4 * duration + 0.5 * gain * duration**2
    pitch = max(DIAMETER, 0.25 * rod.height)
    count = int(np.ceil((rod.height + travel) / pitch)) + 2
    place = grid(copies, count * pitch + rod.length, 5 * DIAMETER)
    along = (np.arange(count)[None, :] + rng.uniform(-0.5, 0.5, (copies, 1))) * pitch \
        - 0.5 * rod.height
    fixed = (place[:, None] + along[..., None] * [1, 0, 0] - DIAMETER * UP
             + rng.uniform(-0.5, 0.5, (copies, count, 1)) * DIAMETER * [0, 1, 0])
    start = resting(np.tile([1.0, 0, 0], (copies, 1)), speed[:, None] * [1, 0, 0], place)
    return Scene(aspect, start, duration, coulomb_errors(start, gain, mu * load, duration),
                 friction=[mu], fixed_position=fixed.reshape(-1, 3),
                 fixed_axis=np.tile([0.0, 1, 0], (fixed.size // 3, 1)), fixed_length=3 * DIAMETER,
                 gravity=GRAVITY * np.array([np.sin(slope), 0, -np.cos(slope)]),
                 copies=copies, contacts=lambda n: 4.0, nominal_mass=rod.mass, mean_mass=rod.mass,
                 least_mass=end_mass(rod, 1))


def incline(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """Rods along a plane's slope b, friction from 0.5 to 1.5 tan b: at rest from μ = tan b on, below
    it v = g (sin b − μ cos b) t."""
    rod, slope, duration = properties(aspect), np.radians(30), 0.1
    friction = list(np.tan(slope) * np.linspace(0.5, 1.5, 11))
    types = np.arange(copies) % len(friction) + 1
    free = GRAVITY * np.sin(slope) * duration
    wanted = np.maximum(0.0, free - np.array(friction)[types - 1] * GRAVITY * np.cos(slope)
                        * duration)
    place = grid(copies, rod.length + 5 * DIAMETER, 3 * DIAMETER)
    place[:, 2] = RADIUS
    start = resting(np.tile([1.0, 0, 0], (copies, 1)), np.zeros((copies, 3)), place)

    def errors(frames: list[State]) -> dict[str, np.ndarray]:
        end = frames[-1]
        return {"speed": np.abs(end.velocity[:, 0] - wanted) / free}
    return Scene(aspect, start, duration, errors, friction=friction, types=types, floor=True,
                 gravity=GRAVITY * np.array([np.sin(slope), 0, -np.cos(slope)]), copies=copies,
                 contacts=lambda n: n, nominal_mass=rod.mass, mean_mass=rod.mass,
                 least_mass=end_mass(rod, 1))


def rolling(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """Thrown sideways along two fixed rods that it lies across, a rod slides, then rolls: from
    t = v/(μ g (1 + 1/κ)) on with v/(1 + κ), κ = I_a/(m r²). Friction 0.5."""
    rod, mu, duration = properties(aspect), 0.5, 0.1
    kappa = rod.axial / rod.mass / RADIUS**2
    speed = rng.uniform(0.2, 0.6, copies)
    reach = 0.6 * duration
    place = grid(copies, rod.length + 3 * DIAMETER, reach + 5 * DIAMETER)
    fixed = []
    for arm in (-0.3, 0.3):
        shift = rng.uniform(-0.5, 0.5, (copies, 1)) * DIAMETER * [0, 1, 0]
        fixed.append(place + shift + np.array([arm * rod.height, 0.5 * reach, -DIAMETER]))
    start = resting(np.tile([1.0, 0, 0], (copies, 1)), speed[:, None] * [0, 1, 0], place)
    lost = speed * kappa / (1.0 + kappa)

    def errors(frames: list[State]) -> dict[str, np.ndarray]:
        end = frames[-1]
        missed = start.velocity[:, 1] - end.velocity[:, 1] - lost
        return {"speed": relative(np.abs(missed), lost)}
    return Scene(aspect, start, duration, errors, friction=[mu],
                 fixed_position=np.concatenate(fixed),
                 fixed_axis=np.tile([0.0, 1, 0], (2 * copies, 1)),
                 fixed_length=round(reach / DIAMETER + 4) * DIAMETER, gravity=-GRAVITY * UP,
                 copies=copies, contacts=lambda n: 2.0, nominal_mass=rod.mass, mean_mass=rod.mass,
                 least_mass=end_mass(rod, 1))


def spin_down(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """Turning about the vertical on two fixed rods at ± x below it, a rod crosses them at x/cos ψ from
    its centre: I_t ω²/2 = μ m g x ∫ dψ/cos ψ, so that it stops at ψ = gd(I_t ω²/(2 μ m g x))."""
    rod, mu = properties(aspect), 0.2
    x = 0.3 * rod.height
    angle = rng.uniform(0.1, 0.4, copies)
    slowing = mu * rod.mass * GRAVITY * x
    spin = np.sqrt(2.0 * slowing * np.arctanh(np.sin(angle)) / rod.across)
    duration = 1.5 * float(np.max(spin)) * rod.across / slowing
    place = grid(copies, rod.length + 3 * DIAMETER, 0.5 * rod.length + 5 * DIAMETER)
    fixed = []
    for side in (-1.0, 1.0):
        shift = rng.uniform(-0.5, 0.5, (copies, 1)) * DIAMETER * [0, 1, 0]
        fixed.append(place + shift + np.array([side * x, 0.0, -DIAMETER]))
    start = resting(np.tile([1.0, 0, 0], (copies, 1)), np.zeros((copies, 3)), place)
    start.momentum = rod.across * spin[:, None] * UP

    def errors(frames: list[State]) -> dict[str, np.ndarray]:
        end = frames[-1]
        turned = np.abs(np.arctan2(end.axis[:, 1] * np.sign(end.axis[:, 0]),
                                   np.abs(end.axis[:, 0])))
        return {"angle": relative(np.abs(turned - angle), angle)}
    return Scene(aspect, start, duration, errors, friction=[mu],
                 fixed_position=np.concatenate(fixed),
                 fixed_axis=np.tile([0.0, 1, 0], (2 * copies, 1)),
                 fixed_length=round(0.3 * rod.height * 0.9 / DIAMETER + 4) * DIAMETER,
                 gravity=-GRAVITY * UP, copies=copies, contacts=lambda n: 2.0,
                 nominal_mass=rod.mass, mean_mass=rod.mass, least_mass=end_mass(rod, 1))


# --- Free motion. --------------------------------------------------------------------------------

def precession(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """A free rod turns a hundred times about its angular momentum L at |L|/I_t. Errors: of the axis's
    direction, as a part of a turn, and of the energy of rotation."""
    rod, turns, rate = properties(aspect), 100.0, 300.0
    duration = turns * 2.0 * np.pi / rate
    direction, axis = unit(rng.normal(size=(copies, 3))), np.zeros((copies, 3))
    # A spin about the axis of at most thrice the rate of precession, and no cone without one.
    cosine = np.minimum(0.95, rod.axial / rod.across * rng.uniform(0.2, 3.0, copies))
    across = unit(np.cross(direction, unit(rng.normal(size=(copies, 3)))))
    axis = cosine[:, None] * direction + np.sqrt(1.0 - cosine**2)[:, None] * across
    momentum = rod.across * rate * direction
    place = grid(copies, rod.length + 3 * DIAMETER, rod.length + 3 * DIAMETER,
                 rod.length + 3 * DIAMETER)
    start = State(place, np.zeros((copies, 3)), momentum, axis)
    wanted = free_axis(rod, axis, momentum, duration)

    def errors(frames: list[State]) -> dict[str, np.ndarray]:
        end = frames[-1]
        # The sign of a measured axis may be lost: the turn is told to half a turn at best.
        sine = np.linalg.norm(np.cross(end.axis, wanted), axis=1)
        phase = np.arctan2(sine, np.sum(end.axis * wanted, axis=1)) / (2.0 * np.pi)
        return {"phase": phase, "energy": np.abs(kinetic_energy(rod, end) / kinetic_energy(rod, start) - 1.0)}
    return Scene(aspect, start, duration, errors, copies=copies, nominal_mass=0.5 * rod.mass,
                 mean_mass=0.5 * rod.mass, least_mass=end_mass(rod, 2), stiff=False)


def separate(aspect: float, count: int, period: float, rng: np.random.Generator) -> State:
    """Rods at random places and of random directions that do not touch, in a periodic cube of twice
    their length or more."""
    half = 0.5 * (aspect - 1.0) * DIAMETER
    places, axes = np.zeros((0, 3)), np.zeros((0, 3))
    while len(places) < count:
        place, axis = rng.uniform(-0.5, 0.5, 3) * period, unit(rng.normal(size=3))
        between = place - places
        between -= period * np.round(between / period)
        gap = segment_distance(between, np.broadcast_to(axis, between.shape), half, 0 * between, axes,
                               half)
        free = np.all(gap > 1.05 * DIAMETER)
        if free:
            places, axes = np.vstack([places, place]), np.vstack([axes, axis])
    return resting(axes, np.zeros_like(places), places)


def gas(aspect: float, copies: int, rng: np.random.Generator) -> Scene:
    """An elastic frictionless gas, 5 % of the volume solid, of rods that do not turn at first and
    meet three times each or so. Hard rods keep their energy of motion; soft ones lend it to the
    springs of the rods that touch."""
    rod, solid = properties(aspect), 0.05
    number = solid * DENSITY / rod.mass  # a volume
    copies = max(copies, int(np.ceil(number * (2.0 * rod.length) ** 3)))
    period = (copies / number) ** (1 / 3)
    start = separate(aspect, copies, period, rng)
    start.velocity = rng.normal(scale=3**-0.5, size=(copies, 3))
    start.velocity -= start.velocity.mean(axis=0)
    # A rod sweeps about its mean width πDL/4 + ... twice over.
    rate = number * np.sqrt(2.0) * np.pi / 2.0 * DIAMETER * (rod.length + DIAMETER)
    before = 0.5 * rod.mass * np.sum(start.velocity**2)

    def errors(frames: list[State]) -> dict[str, np.ndarray]:
        energy = np.array([np.sum(kinetic_energy(rod, f)) for f in frames])
        return {"energy": np.abs(energy / before - 1.0)}
    return Scene(aspect, start, 3.0 / rate, errors, 1.0, copies=copies, nominal_mass=0.5 * rod.mass,
                 mean_mass=0.5 * rod.mass, least_mass=end_mass(rod, 2), pairs=True, frames=20,
                 period=period)


SCENES = {"wall": wall, "crossed": crossed, "flat": flat, "parallel": parallel, "row": row,
          "slide_along": slide_along, "slide_across": slide_across, "incline": incline,
          "rolling": rolling, "spin_down": spin_down, "precession": precession, "gas": gas}


def omega_of(rod: Properties, state: State) -> np.ndarray:
    along = np.sum(state.momentum * state.axis, axis=1, keepdims=True)
    return state.momentum / rod.across \
        + (1.0 / rod.axial - 1.0 / rod.across) * along * state.axis


def build(name: str, aspect: float, copies: int, seed: int) -> Scene:
    return SCENES[name](aspect, copies, np.random.default_rng([seed, round(1000 * aspect)]))


def first(scene: Scene, copies: int) -> int:
    """How many of the rods that move belong to the first `copies` copies."""
    return len(scene.start.position) // scene.copies * copies


__all__ = ["SCENES", "Scene", "State", "build", "angular_momentum", "omega_of"]
