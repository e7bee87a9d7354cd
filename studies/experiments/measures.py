# SPDX-License-Identifier: GPL-2.0-or-later
"""What the experiments measure, of poses and contacts; each has a closed form in the tests."""
from __future__ import annotations

import io
import math
from pathlib import Path

import numpy
import pandas

PIECES = 20          # of a rod's axis, where its solid is counted
RUN_OUT_PART = 0.9   # of the solid lies within the radius that tells the run-out
LOST = 1 / 3         # of its height a column has lost that has collapsed


def read_frames(path: Path | str, items: str) -> list[pandas.DataFrame]:
    """The frames of a dump, ATOMS or ENTRIES, with its own names of columns."""
    head = f"ITEM: {items} "
    frames = []
    for part in Path(path).read_text().split(head)[1:]:
        names, _, values = part.split("ITEM: TIMESTEP")[0].partition("\n")
        frames.append(pandas.read_csv(io.StringIO(values), sep=r"\s+", names=names.split(),
                                      float_precision="round_trip"))
    return frames


def read_frame(path: Path | str, items: str) -> pandas.DataFrame:
    """The last one."""
    return read_frames(path, items)[-1]


def read_rods(path: Path | str, every: bool = False) -> pandas.DataFrame:
    """Last frame of a dump, or `every` one of them, told by `frame`: id, x, y, z, radius, half (of
    the total length), axis ux, uy, uz, and contacts and vx where the dump has c_contacts and vx; by
    ids in each frame."""
    frames = read_frames(path, "ATOMS")
    table = pandas.concat([frame.sort_values("id").assign(frame=k) for k, frame in
                           enumerate(frames if every else frames[-1:])], ignore_index=True)
    w, i, j, k = (table[f"quat{n}"] for n in (1, 2, 3, 4))
    rods = table[["frame", "id", "x", "y", "z"]].assign(
        radius=table["shapex"], half=table["shapez"],
        ux=2 * (i * k + w * j), uy=2 * (j * k - w * i), uz=w * w - i * i - j * j + k * k)
    for theirs, ours in (("c_contacts", "contacts"), ("vx", "vx")):
        if theirs in table:
            rods[ours] = table[theirs]
    return rods


# --- Columns and heaps. --------------------------------------------------------------------------

def solid(rods: pandas.DataFrame) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Distance from the z axis and height of the middles of equal pieces of all axes: the solid of
    slender rods, a row a rod."""
    s = (numpy.arange(PIECES) + 0.5) / PIECES * 2 - 1
    # A capsule has the volume of a cylinder with flat ends 2/3 D shorter than it.
    reach = s * (rods["half"] - rods["radius"] * 2 / 3).to_numpy()[:, None]
    x, y, z = (rods[a].to_numpy()[:, None] + reach * rods[f"u{a}"].to_numpy()[:, None]
               for a in "xyz")
    return numpy.hypot(x, y), z


def height(rods: pandas.DataFrame) -> float:
    """That of a cylinder with an even density whose solid has the same mean height."""
    return 2 * float(solid(rods)[1].mean())


def collapse(before: pandas.DataFrame, after: pandas.DataFrame) -> dict:
    """What became of a column: height before and lost part of it; run-out (r_f - r_i)/r_i with r
    the radius of RUN_OUT_PART of the solid, of the rods that touch another in the end; part of the
    rods that do not: single ones roll on, which nothing but rolling friction stops."""
    (r_before, z_before), (r_after, z_after) = solid(before), solid(after)
    heap = after["contacts"].to_numpy() > 0 if "contacts" in after else numpy.full(len(after), True)
    final = numpy.quantile(r_after[heap], RUN_OUT_PART) if heap.any() else numpy.nan
    return {"height": 2 * float(z_before.mean()),
            "lost": 1 - float(z_after.mean() / z_before.mean()),
            "run_out": float(final / numpy.quantile(r_before, RUN_OUT_PART)) - 1,
            "alone": float(1 - heap.mean())}


def critical_heights(heights, collapsed, steps: int = 81) -> dict:
    """Where the probability of a collapse leaves 0 and reaches 1, linear between (Trepanier and
    Franklin 2010), by the greatest likelihood; low and high ends of each within half a unit of its
    logarithm, one standard error. One in a hundred piles may do what it should not."""
    heights, collapsed = numpy.asarray(heights, float), numpy.asarray(collapsed, bool)
    if collapsed.all() or not collapsed.any():
        return {}
    grid = numpy.linspace(0, 1.2 * heights.max(), steps)
    likelihood = numpy.full((steps, steps), -numpy.inf)
    for a in range(steps):
        above = grid[a + 1:, None]
        p = numpy.clip((heights - grid[a]) / (above - grid[a]), 0.01, 0.99)
        likelihood[a, a + 1:] = numpy.log(numpy.where(collapsed, p, 1 - p)).sum(axis=1)
    near = likelihood >= likelihood.max() - 0.5
    low, high = numpy.nonzero(near)
    # Of many pairs alike, as where the two kinds do not mix, the middle.
    best = numpy.nonzero(likelihood >= likelihood.max() - 1e-9)
    return {"solid_below": grid[best[0]].mean(), "solid_below_low": grid[low.min()],
            "solid_below_high": grid[low.max()], "falls_above": grid[best[1]].mean(),
            "falls_above_low": grid[high.min()], "falls_above_high": grid[high.max()]}


def exponent(x, y) -> tuple[float, float]:
    """Of y ~ x^n by least squares of the logarithms, and its standard error."""
    return slope(numpy.log(numpy.asarray(x, float)), numpy.log(numpy.asarray(y, float)))


def slope(x, y) -> tuple[float, float]:
    """Of the straight line by least squares, and its standard error; NaN of fewer than three."""
    x, y = numpy.asarray(x, float), numpy.asarray(y, float)
    if x.size < 3 or numpy.ptp(x) == 0:
        return numpy.nan, numpy.nan
    off = x - x.mean()
    rise = (off * y).sum() / (off ** 2).sum()
    rest = y - y.mean() - rise * off
    return float(rise), float(numpy.sqrt((rest ** 2).sum() / (x.size - 2) / (off ** 2).sum()))


# --- Contacts. -----------------------------------------------------------------------------------

FULL_FRICTION = 0.999   # of friction times normal force: the contact slides or is about to
SMALLEST = 1e-11        # of the largest eigenvalue: no equation of its own


def bearing(pairs: pandas.DataFrame, walls: pandas.DataFrame, rods: pandas.DataFrame,
            friction: float) -> dict:
    """Counts of the contacts that bear. pairs: i, j, normal (nx, ny, nz) and tangential force (tx,
    ty, tz) on i, place (px, py, pz); walls: i and the same.

    contacts: of a rod, those of two rods counting for both; of_bearing: contacts, those at walls
    too, over rods; sliding: part of them with all their friction used; forces: components of
    forces that are free, and equations: independent ones of balance, both a rod."""
    every = pandas.concat([pairs.drop(columns="j"), walls], ignore_index=True)
    normal, tangential = (numpy.linalg.norm(every[list(names)], axis=1)
                          for names in (("nx", "ny", "nz"), ("tx", "ty", "tz")))
    of_bearing = len(every) / len(rods)
    found = {"contacts": 2 * len(pairs) / len(rods), "wall_contacts": len(walls) / len(rods),
             "of_bearing": of_bearing}
    if friction > 0:   # three components, of which the slider ties one
        sliding = float((tangential >= FULL_FRICTION * friction * normal).mean())
        return found | {"sliding": sliding, "forces": of_bearing * (3 - sliding), "equations": 6.0}
    return found | {"sliding": numpy.nan, "forces": of_bearing,
                    "equations": independent_equations(pairs, walls, rods) / len(rods)}


def independent_equations(pairs: pandas.DataFrame, walls: pandas.DataFrame,
                          rods: pandas.DataFrame) -> int:
    """Rank of the equations of balance, forces and torques of all rods, in the magnitudes of the
    normal forces. As many as contacts: not one of them is redundant, and no bed could have more of
    them but by chance. 5 a rod at most, for no normal force turns a rod about its axis; fewer where
    rods are free to slide."""
    place = {rod: k for k, rod in enumerate(rods["id"])}
    centre = rods[["x", "y", "z"]].to_numpy()
    lever = rods["half"].max()   # so that forces and torques are of one size
    matrix = numpy.zeros((6 * len(rods), len(pairs) + len(walls)))
    column = 0
    for table in (pairs, walls):
        force = table[["nx", "ny", "nz"]].to_numpy()
        normal = force / numpy.linalg.norm(force, axis=1)[:, None]
        points = table[["px", "py", "pz"]].to_numpy()
        for end, sign in (("i", 1), ("j", -1)):
            if end not in table:
                continue
            for k, rod in enumerate(table[end]):
                first = 6 * place[rod]
                arm = (points[k] - centre[place[rod]]) / lever
                matrix[first:first + 3, column + k] = sign * normal[k]
                matrix[first + 3:first + 6, column + k] = sign * numpy.cross(arm, normal[k])
        column += len(table)
    if not column:
        return 0
    gram = matrix.T @ matrix if column <= len(matrix) else matrix @ matrix.T
    eigenvalues = numpy.linalg.eigvalsh(gram)
    return int((eigenvalues > SMALLEST * eigenvalues[-1]).sum())


def contacts_inside(pairs: pandas.DataFrame, rods: pandas.DataFrame, radius: float) -> float:
    """Contacts with others of a rod whose centre lies in the cylinder inside the bed that has half
    its volume, as rod_packing's inner cylinder; NaN without one."""
    counts = pandas.concat([pairs["i"], pairs["j"]]).value_counts()
    part, top = 0.5 ** (1 / 3), rods["z"].max()
    inside = rods[(numpy.hypot(rods["x"], rods["y"]) <= part * radius)
                  & ((rods["z"] - top / 2).abs() <= part * top / 2)]
    return float(counts.reindex(inside["id"], fill_value=0).mean())


def without_rattlers(count: int, pairs: numpy.ndarray, least: int) -> tuple[int, float]:
    """Particles left after those with fewer than `least` contacts have been taken out again and
    again, and the mean number of contacts among them. pairs: indices, a row a contact."""
    pairs = numpy.asarray(pairs, int).reshape(-1, 2)
    stays = numpy.full(count, True)
    while True:
        of_each = numpy.bincount(pairs.ravel(), minlength=count)
        out = stays & (of_each < least)
        if not out.any():
            return int(stays.sum()), 2 * len(pairs) / max(1, int(stays.sum()))
        stays &= ~out
        pairs = pairs[stays[pairs].all(axis=1)]


# --- Walls. --------------------------------------------------------------------------------------

def beside_a_wall(distance_over_length):
    """Solid fraction over that far from the wall, for thin rods thrown at random of which those
    that would cross the wall are left out: a rod at the angle acos(c) to the wall's normal covers
    distances of c L evenly, its centre no nearer than c L/2; ∫ min(1, x/c) dc = x (1 - ln x)."""
    x = numpy.clip(numpy.asarray(distance_over_length, float), 1e-12, 1)
    return x * (1 - numpy.log(x))


def order_beside_a_wall(distance_over_length):
    """⟨cos 2(φ - φ_n)⟩ of such rods with their centres that far from an upright wall of normal φ_n:
    the component c along it is even from 0 to what fits, min(1, 2 x), and the mean over all turns
    about it is 2 c - 1."""
    return numpy.minimum(1, 2 * numpy.asarray(distance_over_length, float)) - 1


def first_reached(distance, value, wanted: float) -> float:
    """Where a profile first reaches a value, straight between the middles of bins; the first bin's
    middle if that does. Bins without a value are left out; NaN if none reaches it."""
    distance, value = numpy.asarray(distance, float), numpy.asarray(value, float)
    known = numpy.isfinite(value)
    distance, value = distance[known], value[known]
    if not (value >= wanted).any():
        return numpy.nan
    at = int(numpy.argmax(value >= wanted))
    if at == 0:
        return float(distance[0])
    return float(numpy.interp(wanted, value[at - 1:at + 1], distance[at - 1:at + 1]))


# --- Dense packings. -----------------------------------------------------------------------------

def jammed(solid_fraction, overlap_sum, low: float, high: float) -> float:
    """Solid fraction at which the overlaps of a particle, summed, start to grow: the straight line
    through those from `low` to `high` met with 0; springs are linear."""
    solid_fraction, overlap_sum = map(numpy.asarray, (solid_fraction, overlap_sum))
    chosen = (overlap_sum >= low) & (overlap_sum <= high)
    if chosen.sum() < 3:
        return numpy.nan
    rise, start = numpy.polyfit(solid_fraction[chosen], overlap_sum[chosen], 1)
    return float(-start / rise)


# --- Shear. --------------------------------------------------------------------------------------

def alignment(rods: pandas.DataFrame) -> tuple[float, float]:
    """Angle of the mean direction of the axes, as seen along y, from x towards z (degrees, -90 to
    90); and the order about it in that plane, 1 if all are seen under one angle."""
    along = float((rods["ux"] ** 2 - rods["uz"] ** 2).mean())
    across = float((2 * rods["ux"] * rods["uz"]).mean())
    seen = float((rods["ux"] ** 2 + rods["uz"] ** 2).mean())
    return math.degrees(0.5 * math.atan2(across, along)), math.hypot(along, across) / seen
