# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of rods that lose their cylinder."""
from __future__ import annotations

import math
import re
from pathlib import Path

from studies.common import cases, settling
from studies.common.rows import provenance
from studies.experiments import measures
from studies.packing.measures import random_contacts

DECK = Path(__file__).with_name("in.column")
DECKS = [*settling.DECKS[:2], DECK]
LOOSE = 0.6          # of the solid fraction of random isotropic contacts: to choose a number of rods
FALL_TIMES = 14      # after the removal, in sqrt(length/g): 1.5 s for 12 cm
RISE = 2             # heights come out up to so many times those aimed at
LIMITS = {"none": (0.0, 0.0), "study": (4 * math.pi, 0.2 * math.pi)}   # on omega, before and after


def number_of_rods(aspect: float, radius: float, height: float) -> int:
    """For about that height; both over the length of a rod."""
    volume = settling.mass_of(aspect) / settling.DENSITY
    length = aspect * settling.DIAMETER
    return max(5, round(LOOSE * random_contacts(aspect, math.pi / 4) * math.pi * radius ** 2
                        * height * length ** 3 / volume))


def column(folder: Path | str, aspect: float, radius: float, height: float, friction: float,
           limits: str, seed: int, build) -> dict:
    """A row of one column."""
    folder = Path(folder)
    length = aspect * settling.DIAMETER
    number = number_of_rods(aspect, radius, height)
    volume = settling.mass_of(aspect) / settling.DENSITY
    # They start so thinly that each finds a place.
    start = number * volume / (math.pi * (radius * length) ** 2 * min(0.08, 0.6 / aspect)) + length
    fall_time = FALL_TIMES * math.sqrt(length / settling.GRAVITY)
    # No rod gets further than with all the speed that the fall from the top would give it.
    room = radius * length + length + fall_time * math.sqrt(
        2 * settling.GRAVITY * (RISE * height + 0.5) * length)
    first, then = LIMITS[limits]
    cases.link_decks(folder, DECKS)
    run = cases.run_deck(folder, DECK, {
        "lambda": f"{aspect:g}", "vessel_diameter": f"{2 * radius * length:g}", "rods": number,
        "vessel_height": f"{start:.4g}", "room": f"{room:.4g}",
        "friction": f"{friction:g}", "seed": seed, "limit_fill": first, "limit_settle": then,
        "settle_time": f"{math.sqrt(2 * start / settling.GRAVITY) + 3:.3g}",
        "collapse_time": f"{fall_time:.3g}"}, build=build)
    before, after = (measures.read_rods(folder / f"dump.{name}") for name in ("column", "heap"))
    found = measures.collapse(before, after)
    rested = re.findall(r"^(\w+) at rest: (\d)$", run.log.read_text(), re.MULTILINE)
    return {"lambda": aspect, "radius": radius, "friction": friction, "limits": limits,
            "rods": number, **found, "height": found["height"] / length,
            "collapsed": int(found["lost"] > measures.LOST),
            **{f"{name}_rested": int(value) for name, value in rested},
            "cpu_s": run.cpu_seconds, **provenance(run.command, seed)}
