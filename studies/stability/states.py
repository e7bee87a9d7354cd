# SPDX-License-Identifier: GPL-2.0-or-later
"""What became of a bed, from its log, its frames and its end: one of STATES, the worst that
holds."""
from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pandas

from studies.common import settling

# From bad to good.
STATES = {
    "lost": "rods left the vessel or the box, or positions became no numbers",
    "grows": "kinetic and potential energy of the bed together rise after the rods have landed",
    "passes": "rods have passed through each other",
    "jitters": "contacts chatter: forces never balance, but the bed gains no energy",
    "moves": "at the end of the time modelled rods still lie down, or bounce",
    "rests": "forces and torques balance; rods may roll about their own axes, which nothing stops",
}
LOST = r"Lost atoms|outside the cylinder|outside of the|Non-numeric|through|is not a number|nan"
RISE = 0.05        # of m g L a rod, that the energy must rise to be called growing
QUIET = 0.02       # largest net force on a rod over m g, and torque over m g L/2, of a bed at rest
LOUD = 0.2         # and force of one whose contacts chatter, unless its energy still falls;
HARD = 1.5         # whatever its energy does: more than the weight, which a rod in the air feels
STEADY = 0.5       # kinetic energy of the second half of the end over that of the first
END = 0.3          # s: what counts as the end of a run


def energies(table: pandas.DataFrame, aspect: float, rods: int) -> tuple[np.ndarray, np.ndarray]:
    """Kinetic, and kinetic with potential energy a rod, over m g D."""
    scale = settling.mass_of(aspect) * settling.GRAVITY * settling.DIAMETER
    kinetic = (table["moving"] + table["turning"]).to_numpy() / rods / scale
    return kinetic, kinetic + table["height"].to_numpy() / settling.DIAMETER


def largest_rise(values: np.ndarray) -> float:
    """Of a series above the least that came before."""
    finite = values[np.isfinite(values)]
    if finite.size == 0:
        return 0.0
    return float(np.max(finite - np.minimum.accumulate(finite)))


def state_of(table: pandas.DataFrame, aspect: float, rods: int, landed: float, rested: bool,
             failure: str | None, passed: int, braked: bool = False) -> str:
    """`table`: time, moving, turning (J of all rods), height (m, mean of the centres), force,
    torque (largest net ones of a rod over m g and m g L/2); `landed`: time from which no rod falls
    freely any more (s); `failure`: the sentence that ended the run; `braked`: a limit holds rods
    up, which leaves their forces out of balance without any chatter."""
    if failure is not None:
        if re.search(LOST, failure, re.IGNORECASE):
            return "lost"
        raise ValueError(f"a bed ended by '{failure}', which is no state of a bed")
    kinetic, total = energies(table, aspect, rods)
    if not np.isfinite(kinetic).all():
        return "lost"
    time = table["time"].to_numpy()
    after = time >= landed
    if total.max() > total[0] + RISE * aspect or largest_rise(total[after]) > RISE * aspect:
        return "grows"
    if passed > 0:
        return "passes"
    if rested:
        return "rests"
    end = time > time[-1] - END
    force, torque = (float(np.median(table[name].to_numpy()[end])) for name in ("force", "torque"))
    if force < QUIET and torque < QUIET:
        return "rests"
    half = time > time[-1] - 0.5 * END
    steady = kinetic[half].mean() > STEADY * kinetic[end & ~half].mean()
    return "jitters" if force > HARD or (force > LOUD and steady and not braked) else "moves"


# --- Rods that pass through each other. ---------------------------------------------------------

def numbers_of(path: Path | str, rows: int, columns: int) -> np.ndarray:
    """(frames, rows, columns) of a dump; frames with other numbers of rows are left out."""
    kept, lines = [], []

    def keep():
        if len(lines) == rows and len(lines[0].split()) == columns:
            kept.extend(lines)

    with open(path) as file:
        for line in file:
            if line.startswith("ITEM"):
                keep()
                lines = []
            else:
                lines.append(line)
    keep()
    return np.array(" ".join(kept).split(), dtype=float).reshape(-1, rows, columns)


def read_frames(path: Path | str, rods: int) -> tuple[np.ndarray, np.ndarray]:
    """Centres and axes, (frames, rods, 3), of a dump of x y z quat1 quat2 quat3 quat4 in the order
    of the ids."""
    t = numbers_of(path, rods, 7)
    w, x, y, z = np.moveaxis(t[..., 3:], -1, 0)
    axis = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), w**2 - x**2 - y**2 + z**2], axis=-1)
    return t[..., :3], axis


FRAMES = 100   # looked at together


def side(centre: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """(frames, rods, rods): (c_j − c_i) · (u_i × u_j), whose sign tells on which side the lines of
    two axes pass each other."""
    moment = np.cross(centre, axis)
    product = np.einsum("fia,fja->fij", axis, moment)
    # (c_j − c_i)·(u_i × u_j) = −u_i·(c_j × u_j) − u_j·(c_i × u_i)
    return -(product + np.swapaxes(product, 1, 2))


def passages(centre: np.ndarray, axis: np.ndarray, height: float) -> dict[tuple[int, int], int]:
    """How often the axes of each pair have gone through each other between two frames; `height`,
    that of the cylinder. Lines of axes change sides also beyond the ends of rods, and when rods
    turn past parallel: what counts is a change at which the lines meet within both rods. Rods are
    moved evenly between two frames."""
    found: dict[tuple[int, int], int] = {}
    if len(centre) < 2 or height <= 0:
        return found
    upper = np.triu(np.ones((centre.shape[1],) * 2, bool), 1)
    for first in range(0, len(centre) - 1, FRAMES):
        block = slice(first, first + FRAMES + 1)
        c, u = centre[block], axis[block]
        s = side(c, u)
        for f, i, j in np.argwhere(upper & (s[:-1] * s[1:] < 0)):
            part = s[f, i, j] / (s[f, i, j] - s[f + 1, i, j])
            place = (1 - part) * c[f] + part * c[f + 1]
            turned = (1 - part) * u[f] + part * u[f + 1]
            if meet(place[i], turned[i], place[j], turned[j], height):
                found[int(i), int(j)] = found.get((int(i), int(j)), 0) + 1
    return found


def meet(ci, ui, cj, uj, height: float) -> bool:
    """Whether the lines come together, nearer than a fifth of a diameter, within both cylinders."""
    ui, uj, d = ui / np.linalg.norm(ui), uj / np.linalg.norm(uj), cj - ci
    c = ui @ uj
    if 1.0 - c * c < 1e-6:
        return False
    along_i = (d @ ui - c * (d @ uj)) / (1.0 - c * c)
    along_j = (c * (d @ ui) - d @ uj) / (1.0 - c * c)
    if max(abs(along_i), abs(along_j)) > 0.5 * height:
        return False
    apart = np.linalg.norm(ci + along_i * ui - cj - along_j * uj)
    return bool(apart < 0.2 * settling.DIAMETER)


def passed(centre: np.ndarray, axis: np.ndarray, height: float) -> int:
    """Pairs of rods that are on the other side of each other for good: an odd number of times. Rods
    pushed back the way they came have been through twice."""
    return sum(n % 2 for n in passages(centre, axis, height).values())
