#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What a joint costs: of ours, beside a chain of beads of LAMMPS. From the project's folder, on a machine that does
nothing else:

    /usr/bin/python3 bench/fibres.py --turns 5

Fibres apart from each other, at rest: each code with its joints, and with as many rods or beads that are free, in
turns; a joint costs the difference of the medians. A
chain with n joints of stiffness EI/h bends as any other with as many, LAMMPS's as ours: the errors of both are those
of the discrete chain (docs/fix_joint_spherocylinder.md), so that costs a joint are costs at equal error. Beads of
one diameter that touch, which a chain with contacts would want, have lambda joints.
"""
from __future__ import annotations

import argparse
import shutil
import statistics
import sys
from pathlib import Path

import numpy
import pandas

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(ROOT)]

from studies.common import cases  # noqa: E402

DIAMETER, DENSITY, LAMBDA, SEGMENTS = 0.01, 2700.0, 30, 8  # m, kg/m3
MODULUS = 1e8                                              # Pa
SPACE = 3.0                                                # of a fibre's length, a side of its cube


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fibres", type=int, default=1000)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "fibres_bench")
    parser.add_argument("--out", type=Path, default=Path("fibres.csv"))
    return parser.parse_args()


def write_chains(path: Path, fibres: int, beads: int, distance: float, side: float) -> None:
    """Straight chains on a lattice, along x."""
    random = numpy.random.default_rng(15485863)
    across = int(numpy.ceil(numpy.sqrt(fibres)))
    mass = DENSITY * numpy.pi * DIAMETER**2 / 4 * distance
    lines = ["Chains", "", f"{fibres * beads} atoms", f"{fibres * (beads - 1)} bonds",
             f"{fibres * (beads - 2)} angles", "1 atom types", "1 bond types", "1 angle types", "",
             *(f"0.0 {side:.15g} {axis}lo {axis}hi" for axis in "xyz"), "", "Masses", "",
             f"1 {mass:.15g}", "", "Atoms", ""]
    for i in range(fibres * beads):
        chain, bead = divmod(i, beads)
        y, z = ((k + 0.5) * side / across for k in divmod(chain, across))
        x = random.uniform(0.1, 0.2) * DIAMETER if bead == 0 else x + distance
        lines.append(f"{i + 1} {chain + 1} 1 {x:.15g} {y:.15g} {z:.15g}")
    firsts = [chain * beads + bead + 1 for chain in range(fibres) for bead in range(beads - 1)]
    lines += ["", "Bonds", "", *(f"{k} 1 {i} {i + 1}" for k, i in enumerate(firsts, 1))]
    firsts = [chain * beads + bead + 1 for chain in range(fibres) for bead in range(beads - 2)]
    lines += ["", "Angles", "", *(f"{k} 1 {i} {i + 1} {i + 2}" for k, i in enumerate(firsts, 1))]
    path.write_text("\n".join(lines) + "\n")


def seconds(build: Path, folder: Path, deck: str, program: str, variables: dict, number: int) -> float:
    """The loop time of the number-th run in the log."""
    cases.run_deck(folder, deck, variables, program=program, build=build)
    times = [float(line.split()[3]) for line in (folder / f"log.{deck.removeprefix('in.')}").read_text().splitlines()
             if line.startswith("Loop time of")]
    return times[number]


def free_fibres(given: argparse.Namespace, code: str) -> list[dict]:
    length = (LAMBDA + 1) * DIAMETER
    distance = (length - DIAMETER) / SEGMENTS
    side = length * SPACE * given.fibres ** (1 / 3)
    folder = given.folder / code
    folder.mkdir(parents=True, exist_ok=True)
    inertia, area = numpy.pi * DIAMETER**4 / 64, numpy.pi * DIAMETER**2 / 4
    joints = SEGMENTS - 1
    dt = 0.1 * distance * (DENSITY / MODULUS) ** 0.5
    values = {"steps": given.steps, "dt": dt}
    if code == "ours":
        shutil.copy(HERE / "scenes" / "in.fibres", folder)
        deck, program = "in.fibres", "lmp"
        values |= {"side": side, "length": length, "segments": SEGMENTS, "fibres": given.fibres,
                   "modulus": MODULUS}
        per_fibre, number = SEGMENTS, 1
    else:
        shutil.copy(HERE / "scenes" / "in.chain_lammps", folder)
        deck, program = "in.chain_lammps", "lammps"
        write_chains(folder / "chains.data", given.fibres, joints + 2, distance, side)
        values |= {"half_stretch": 0.5 * MODULUS * area / distance, "distance": distance,
                   "half_bend": 0.5 * MODULUS * inertia / distance, "cutoff": 4 * distance}
        per_fibre, number = joints + 2, 0
    times = {joined: [] for joined in (1, 0)}
    for turn in range(given.turns):
        print(f"fibres: {code}, turn {turn + 1} of {given.turns}", flush=True)
        for joined in times:
            times[joined].append(seconds(given.build, folder, deck, program,
                                         {**values, "joints": joined}, number))
    medians = {joined: statistics.median(found) for joined, found in times.items()}
    steps = given.steps * given.fibres
    return [{"case": f"{code}: a joint", "ns": 1e9 * (medians[1] - medians[0]) / steps / joints},
            {"case": f"{code}: a fibre of {joints} joints", "ns": 1e9 * medians[1] / steps},
            {"case": f"{code}: its {per_fibre} parts without joints", "ns": 1e9 * medians[0] / steps}]


def main() -> None:
    given = arguments()
    found = free_fibres(given, "ours") + free_fibres(given, "lammps")
    table = pandas.DataFrame(found)
    table["ns"] = table["ns"].round(1)
    table.to_csv(given.out, index=False)
    print(table.to_string(index=False))


if __name__ == "__main__":
    try:
        main()
    except cases.CaseError as error:
        sys.exit(f"fibres: {error}")
