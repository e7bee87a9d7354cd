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

DECKS = [*settling.DECKS, cases.ROOT / "input" / "in.collapse"]
STEP = 5.0e-5        # s, a fifth of the limit of two rods end to end
LOOSE = 0.6          # of V_f by random isotropic contacts: to choose a number of rods
RISE = 2             # heights come out up to so many times those aimed at
SETTLE_TIME = 3.0    # s after all have landed, at most
FALL_TIMES = 14      # after the removal, in sqrt(length/g): 1.5 s for 12 cm
LIMITS = {"none": (0.0, 0.0), "study": (4 * math.pi, 0.2 * math.pi)}   # on omega: filling, then


def number_of_rods(aspect: float, radius: float, height: float) -> int:
    """For about that height; both over the length of a rod."""
    volume = settling.mass_of(aspect) / settling.DENSITY
    length = aspect * settling.DIAMETER
    return max(5, round(LOOSE * random_contacts(aspect, math.pi / 4) * math.pi * radius ** 2
                        * height * length ** 3 / volume))


def tenths(time: float) -> float:
    """So long or a little longer: a whole number of steps, and of frames."""
    return math.ceil(10 * time) / 10


def column(folder: Path | str, aspect: float, radius: float, height: float, friction: float,
           limits: str, seed: int, build) -> dict:
    """A row of one column."""
    folder = Path(folder)
    length = aspect * settling.DIAMETER
    number = number_of_rods(aspect, radius, height)
    volume = settling.mass_of(aspect) / settling.DENSITY
    # They start so thinly that each finds a place.
    start = number * volume / (math.pi * (radius * length) ** 2 * min(0.08, 0.6 / aspect)) + length
    # No rod gets further than with all the speed that the fall from the top would give it.
    fall = tenths(FALL_TIMES * math.sqrt(length / settling.GRAVITY))
    reach = length + fall * math.sqrt(2 * settling.GRAVITY * (RISE * height + 0.5) * length)
    landed = tenths(math.sqrt(2 * start / settling.GRAVITY))
    total = landed + SETTLE_TIME
    first, then = LIMITS[limits]
    variables = {
        "lambda": f"{aspect:g}", "vessel_diameter": f"{2 * radius * length:g}", "rods": number,
        "vessel_height": f"{start:.4g}", "friction": f"{friction:g}", "seed": seed,
        "limit_fill": first, "limit_settle": then, "dt": STEP, "skin_diameters": 10,
        "fill_time": f"{landed:g}", "total_time": f"{total:g}", "stop_at_rest": 1,
        "thermo_every": 2000, "dump_every": round(total / STEP)}
    cases.link_decks(folder, DECKS)
    runs = [cases.run_deck(folder, deck, variables, build=build)
            for deck in ("in.fill", "in.settle")]
    runs.append(cases.run_deck(folder, "in.collapse", variables | {
        "reach": f"{reach:.4g}", "collapse_time": f"{fall:g}", "limit_collapse": then,
        "dump_every": round(fall / STEP)}, build=build))
    before, after = (measures.read_rods(folder / f"dump.{name}") for name in ("settle", "collapse"))
    found = measures.collapse(before, after)
    rested = {name: int(re.search(r"at rest since step", run.log.read_text()) is not None)
              for name, run in zip(("column_rested", "heap_rested"), runs[1:])}
    return {"lambda": aspect, "radius": radius, "friction": friction, "limits": limits,
            "rods": number, **found, "height": found["height"] / length,
            "collapsed": int(found["lost"] > measures.LOST),
            **rested, "cpu_s": sum(run.cpu_seconds for run in runs),
            **provenance(" && ".join(run.command for run in runs), seed)}
