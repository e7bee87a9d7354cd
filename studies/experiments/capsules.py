# SPDX-License-Identifier: GPL-2.0-or-later
"""Dense packings of short capsules without friction, by a box that shrinks."""
from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy
import pandas

from studies.common import cases, settling
from studies.common.rows import provenance
from studies.experiments import measures

DECK = Path(__file__).with_name("in.compress")
STIFFNESS = 2.0e4                 # N/m; all that counts is the rate in units of sqrt(m/k)
FIRST, LAST = 0.3, 0.78           # solid fraction
STEP = 0.15                       # in sqrt(m/k): 0.11 of the limit of two spheres
FRAMES = 300
WINDOW = (0.02, 0.08)             # of the overlaps of a particle, summed, over D
LEAST_CONTACTS = 4                # that hold a particle


def packing(folder: Path | str, aspect: float, number: int, rate: float, seed: int,
            build) -> dict:
    folder = Path(folder)
    mass = settling.mass_of(aspect)
    unit = math.sqrt(mass / STIFFNESS)
    step, strain_rate = STEP * unit, rate / unit
    steps = math.ceil((1 - (FIRST / LAST) ** (1 / 3)) / (strain_rate * step))
    every = max(1, steps // FRAMES)
    cases.link_decks(folder, [DECK])
    cases.run_tool("place_rods", "--lambda", aspect, "--solid", FIRST, "--rods", number, "--speed",
                   0, "--seed", seed, "--out", folder / "gas.data", build=build)
    run = cases.run_deck(folder, DECK, {
        "rods": "gas.data", "diameter": settling.DIAMETER, "stiffness": STIFFNESS,
        "dt": f"{step:.10g}", "rate": f"{strain_rate:.10g}", "steps": steps, "every": every},
        build=build)
    table = cases.last_table(run.log, ["Volume", "contacts", "contacts.2"])
    solid = number * mass / settling.DENSITY / table["Volume"]
    overlaps = table["contacts"] * table["contacts.2"]
    fraction = measures.jammed(solid, overlaps, *WINDOW)
    # Contacts where the line begins, which is still soft by WINDOW[0] only.
    at = int(numpy.argmax(overlaps >= WINDOW[0]))
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch, "contacts.csv")
        cases.run_tool("rod_contacts", folder / "dump.pressed", "--frame",
                       int(table["Step"].iloc[at]), "--contacts-csv", path, build=build)
        pairs = pandas.read_csv(path)[["id_i", "id_j"]].to_numpy() - 1
    left, contacts = measures.without_rattlers(number, pairs, LEAST_CONTACTS)
    return {"lambda": aspect, "rods": number, "rate": rate, "solid_fraction": fraction,
            "contacts_all": table["contacts"].iloc[at], "contacts": contacts,
            "rattlers": 1 - left / number, "cpu_s": run.cpu_seconds,
            **provenance(run.command, seed)}
