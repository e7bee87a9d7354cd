# SPDX-License-Identifier: GPL-2.0-or-later
"""A bed at rest of spheres, each a particle of its own: the peers of scene sphere_bed."""
from __future__ import annotations

import math
from pathlib import Path

import numpy
import pandas

from studies.common import cases

CODES = ("liggghts", "lammps")  # the programs, as cases.program_path knows them
DIAMETER, DENSITY = 0.01, 2700  # m, kg/m³; those of input/in.rods
PLACED_SOLID = 0.2              # of the spheres that are to fall
FALLING_SKIN = 0.2              # in diameters
FRICTION = 0.2                  # of the timed runs; that of input/in.rods


def vessel_diameter(count: int) -> float:
    """About as wide as the bed is high."""
    return round(count ** (1 / 3)) * DIAMETER


def placed(count: int, seed: int) -> numpy.ndarray:
    """Centres of spheres placed at random in the vessel, clear of it and of each other."""
    vessel = vessel_diameter(count)
    radius = (vessel - DIAMETER) / 2
    height = count * DIAMETER**3 / 6 / PLACED_SOLID / (vessel**2 / 4)
    random = numpy.random.default_rng(seed)
    centres = numpy.empty((count, 3))
    found = 0
    while found < count:
        place = random.uniform([-radius, -radius, DIAMETER / 2], [radius, radius, height])
        apart = ((centres[:found] - place)**2).sum(axis=1) > DIAMETER**2
        if math.hypot(place[0], place[1]) < radius and apart.all():
            centres[found] = place
            found += 1
    return centres


def write_data(path: Path, centres: numpy.ndarray) -> None:
    """For read_data of both codes; type 1, and type 2 for walls."""
    side = vessel_diameter(len(centres)) / 2 + DIAMETER
    top = centres[:, 2].max() + DIAMETER
    lines = ["Spheres", "", f"{len(centres)} atoms", "2 atom types", "",
             f"{-side} {side} xlo xhi", f"{-side} {side} ylo yhi", f"{-DIAMETER} {top} zlo zhi", "",
             "Atoms", ""]
    lines += [f"{i} 1 {DIAMETER} {DENSITY} {x:.15g} {y:.15g} {z:.15g}"
              for i, (x, y, z) in enumerate(centres, 1)]
    path.write_text("\n".join(lines) + "\n")


def variables(code: str, count: int, settings: dict) -> dict:
    """Of in.one_sphere in a timed run."""
    return {"code": code, "data": "spheres.data", "friction": FRICTION,
            "skin": settings["sphere_skin"][code] * DIAMETER,
            "gravity": settings["sphere_gravity"], "vessel_diameter": vessel_diameter(count)}


def settle(folder: Path, count: int, settings: dict) -> None:
    """Leaves spheres.data: at rest, without friction, so that no spring is missing in a run that
    begins with positions alone."""
    write_data(folder / "placed.data", placed(count, settings["seed"]))
    cases.run_deck(folder, "in.start_one_sphere",
                   {**variables("liggghts", count, settings), "data": "placed.data", "friction": 0,
                    "skin": FALLING_SKIN * DIAMETER, "seconds": settings["sphere_settled"]},
                   program="liggghts")
    dump = folder / "dump.start"
    at_rest = pandas.read_csv(dump, sep=r"\s+", skiprows=9, header=None,
                              float_precision="round_trip")
    write_data(folder / "spheres.data", at_rest[[1, 2, 3]].to_numpy())
    dump.unlink()
    (folder / "placed.data").unlink()


def contacts(log: Path) -> float:
    """A sphere's, from the end of a timed run: each counts at both spheres, walls' do not."""
    return float(cases.read_log(log)[-1].iloc[-1, -1])
