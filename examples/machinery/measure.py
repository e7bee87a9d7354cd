#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rates of hoppers from their tables, the dynamic angle of a drum from its dump, the way of a vane.

    ./measure.py hopper hopper_*.csv > rates.csv    # one of each orifice and pour
    ./measure.py drum dump.drum
    ./measure.py vane vane.csv
"""
import argparse
import csv
import sys
from pathlib import Path

import numpy as np

TIMESTEP = 2e-5  # s, of in.material


def rows(path: Path, columns: int) -> np.ndarray:
    try:
        table = np.array(list(csv.reader(path.open()))[1:], float)
    except (OSError, ValueError) as wrong:
        sys.exit(f"measure.py: {path} is no table of numbers with a title line ({wrong})")
    if not len(table):
        sys.exit(f"measure.py: {path} holds no rows (wanted a table of {columns} columns below a title line)")
    if table.shape[1] != columns:
        sys.exit(f"measure.py: {path} has {table.shape[1]} columns (wanted {columns})")
    return table


def rate(table: np.ndarray, since: float, until: float) -> float:
    """Rods a second that leave between two times (s) after the opening."""
    time = table[:, 1] - table[0, 1]
    part = table[(time >= since - 1e-6) & (time <= until + 1e-6)]
    if len(part) < 2:
        sys.exit(f"measure.py: {len(part)} rows from {since:g} to {until:g} s after the opening (wanted two or more)")
    return (part[0, 2] - part[-1, 2]) / (part[-1, 1] - part[0, 1])


def hopper(paths: list[Path], since: float, until: float) -> None:
    """Mean rates with the standard error over pours; below, D0 of rate^(2/5) = a (D - D0)."""
    rates: dict[float, list[float]] = {}
    for path in paths:
        table = rows(path, 3)
        rates.setdefault(table[0, 0], []).append(rate(table, since, until))
    print("orifice/m,pours,rods/s,standard error")
    for orifice, found in sorted(rates.items()):
        error = np.std(found, ddof=1) / np.sqrt(len(found)) if len(found) > 1 else np.nan
        print(f"{orifice:g},{len(found)},{np.mean(found):.0f},{error:.0f}")
    widths = np.repeat(sorted(rates), [len(rates[width]) for width in sorted(rates)])
    powers = np.concatenate([rates[width] for width in sorted(rates)]) ** 0.4
    if len(powers) < 4 or len(rates) < 2:
        return  # too few for a line and its error
    (slope, offset), spread = np.polyfit(widths, powers, 1, cov=True)
    gradient = np.array([offset / slope ** 2, -1 / slope])  # of D0 = -offset/slope
    error = np.sqrt(gradient @ spread @ gradient)
    print(f"# rate^(2/5) = {slope:.4g} (D - {-offset / slope:.4f} m); D0 +- {error:.4f} m, "
          f"factor +- {np.sqrt(spread[0, 0]):.2g}")


def frames(path: Path):
    """Step and table of each frame, by the names of its columns."""
    with path.open() as dump:
        while dump.readline():
            step = int(dump.readline())
            dump.readline()
            number = int(dump.readline())
            for _ in range(4):
                dump.readline()
            names = dump.readline().split()[2:]
            table = np.array([dump.readline().split() for _ in range(number)], float).reshape(number, len(names))
            yield step, dict(zip(names, table.T))


def places(rods: dict[str, np.ndarray], points: int = 7) -> np.ndarray:
    """Points along the axes of the rods, (x, z): a rod weighs the same everywhere."""
    w, x, y, z = (rods[f"quat{i}"] for i in (1, 2, 3, 4))
    axis = np.stack([2 * (x * z + w * y), w * w - x * x - y * y + z * z], axis=1)
    along = (np.arange(points) + 0.5) / points - 0.5
    ways = along[:, None, None] * 2 * rods["shapez"][None, :, None] * axis[None]
    return (np.stack([rods["x"], rods["z"]], axis=1)[None] + ways).reshape(-1, 2)


def surface(points: np.ndarray, cell: float = 0.005) -> float:
    """Angle (degrees) of the line where the mean density is half of the bed's: over the middle half of the chord."""
    angle = 0.0
    edges = np.arange(-0.1, 0.1 + cell / 2, cell)
    for _ in range(12):  # seen from a frame in which it is level
        c, s = np.cos(angle), np.sin(angle)
        turned = points @ np.array([[c, s], [-s, c]]).T
        density, _, _ = np.histogram2d(*turned.T, bins=(edges, edges))
        half = 0.5 * np.median(density[density > 0.3 * density.max()])
        middle = (edges[1:] + edges[:-1]) / 2
        found = []
        for x, column in zip(middle, density):
            filled = np.flatnonzero(column >= half)
            if abs(x) < 0.05 and len(filled) and filled[-1] + 1 < len(column):
                top = filled[-1]
                part = (column[top] - half) / max(column[top] - column[top + 1], 1e-30)
                found.append((x, middle[top] + cell * part))
        angle += np.arctan(np.polyfit(*np.array(found).T, 1)[0])
    return np.degrees(angle)


def drum(path: Path, since: float, parts: int) -> None:
    """Of all frames from since (s) after the first, and the standard error over parts of that time."""
    try:
        kept = [(step, places(rods)) for step, rods in frames(path)]
    except (OSError, ValueError, KeyError) as wrong:
        sys.exit(f"measure.py: {path} is no dump of in.drum ({wrong})")
    kept = [points for step, points in kept if (step - kept[0][0]) * TIMESTEP >= since]
    if parts < 2 or len(kept) < parts:
        sys.exit(f"measure.py: --parts must be from 2 to the number of frames from --since on, {len(kept)} (got {parts})")
    angles = [surface(np.concatenate(part)) for part in
              (kept[len(kept) * i // parts:len(kept) * (i + 1) // parts] for i in range(parts))]
    print("frames,angle/degrees,standard error")
    print(f"{len(kept)},{abs(surface(np.concatenate(kept))):.1f},{np.std(angles, ddof=1) / np.sqrt(parts):.1f}")


def vane(path: Path, rim: float = 0.02, speed: float = 0.01, gain: float = 1.0) -> None:
    """Angle (rad) that the servo's law gives: its rate goes by how far the torque is from the target."""
    time, _, mean, target = rows(path, 4).T
    rates = np.clip(gain * (target - mean) / target, -1, 1) * speed / rim
    print(f"angle/rad\n{np.sum(rates * np.diff(time, prepend=0.0)):.4f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="what", required=True)
    one = commands.add_parser("hopper")
    one.add_argument("tables", type=Path, nargs="+")
    one.add_argument("--since", type=float, default=0.2, help="s after the opening (default 0.2)")
    one.add_argument("--until", type=float, default=0.5, help="(default 0.5)")
    one = commands.add_parser("drum")
    one.add_argument("dump", type=Path)
    one.add_argument("--since", type=float, default=1.0, help="s of turning (default 1)")
    one.add_argument("--parts", type=int, default=6, help="(default 6)")
    one = commands.add_parser("vane")
    one.add_argument("table", type=Path)
    given = parser.parse_args()
    if given.what == "hopper":
        hopper(given.tables, given.since, given.until)
    elif given.what == "drum":
        drum(given.dump, given.since, given.parts)
    else:
        vane(given.table)


if __name__ == "__main__":
    main()
