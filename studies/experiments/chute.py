# SPDX-License-Identifier: GPL-2.0-or-later
"""Rods that flow down a chute: their alignment, by layers, which shear at different rates."""
from __future__ import annotations

import math
from pathlib import Path

import numpy

from studies.common import cases, settling
from studies.common.rows import provenance
from studies.experiments import measures

DECK = Path(__file__).with_name("in.chute")
START = 0.2               # part of the volume that is rods before they fall
STEP = 5.0e-5             # s
LAYERS = (0.15, 0.3, 0.45, 0.6, 0.75, 0.9)   # of the rods that flow, from below
BLOCKS = 4                # of the frames, for the error
LIMITS = {"none": 0.0, "study": 0.2 * math.pi}


def flow(folder: Path | str, aspect: float, number: int, angle: float, friction: float, limits: str,
         time: float, frames: int, seed: int, build) -> list[dict]:
    """Rows of the layers. `number` of rods in each of three cubes, one above the other."""
    folder = Path(folder)
    cases.link_decks(folder, [DECK])
    cases.run_tool("place_rods", "--lambda", aspect, "--solid", START, "--rods", number, "--copies",
                   1, 1, 3, "--speed", 0, "--floor", "--seed", seed, "--out", folder / "rods.data",
                   build=build)
    run = cases.run_deck(folder, DECK, {
        "rods": "rods.data", "diameter": settling.DIAMETER, "stiffness": settling.STIFFNESS,
        "friction": f"{friction:g}", "base": 1.2 * settling.DIAMETER, "angle": f"{angle:g}",
        "limit": LIMITS[limits], "dt": STEP, "settle_time": 0.4, "flow_time": f"{time:g}",
        "frames": frames}, build=build)
    table = measures.read_rods(folder / "dump.flow", every=True)
    edges = table["z"].quantile(LAYERS).to_numpy()
    result = []
    for low, high in zip(edges[:-1], edges[1:]):
        layer = table[table["z"].between(low, high)]
        rate, speed = numpy.polyfit(layer["z"] - layer["z"].mean(), layer["vx"], 1)
        parts = numpy.array_split(layer["frame"].unique(), BLOCKS)
        angles = [measures.alignment(layer[layer["frame"].isin(part)])[0] for part in parts]
        result.append({
            "lambda": aspect, "angle": angle, "friction": friction, "limits": limits,
            "height": layer["z"].mean() / settling.DIAMETER, "rate": rate, "speed": speed,
            "alignment_deg": numpy.mean(angles),
            "alignment_error": numpy.std(angles, ddof=1) / math.sqrt(BLOCKS),
            "order": measures.alignment(layer)[1], "cpu_s": run.cpu_seconds,
            **provenance(run.command, seed)})
    return result
