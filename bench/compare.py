#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Two builds of the plug-in on the same scenes, in turns: what a change costs or saves.
    compare.py BEFORE AFTER [--scenes bed gas] [--turns 5] [--longer 4] [--folder DIR] [--out CSV]
    compare.py BEFORE AFTER --count 100 ...
BEFORE and AFTER are folders of programs, as build/release. A row a case: microseconds a rod and step of
both, and how many times those of BEFORE those of AFTER are, the median over the turns, in each of which
they run one after the other, in either order: on a machine that does nothing else. With --count
instructions of so many steps instead, by valgrind, once each whatever --turns and --longer are: nearly the
same on machines of a kind at any time, and blind to what memory costs. (valgrind has no AVX-512: loops of
eight at a time run as those of four.)"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy
import yaml

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]

from bench import speed  # noqa: E402
from studies.common import cases, rows  # noqa: E402

SETTINGS = yaml.safe_load((HERE / "config.yaml").read_text())
CASES = [("bed", 10, 500), ("bed", 20, 700), ("bed", 30, 700), ("fill", 10, 500), ("fill", 30, 700),
         ("gas", 3, 2000), ("gas", 10, 2000), ("gas", 30, 2000), ("gas", 100, 2000),
         ("dilute", 30, 2000), ("dense", 10, 2000), ("periodic_bed", 30, 2000),
         ("mesh_bed", 10, 500), ("drum", 3, 600), ("hopper", 3, 1000)]


def counts(scene: str, aspect: int, count: int, builds: dict[str, Path], steps: int,
           folder: Path) -> dict:
    instructions, sums = {}, {}
    for name, build in builds.items():
        found, _ = cases.run_counted(folder, "in.time_plugin",
                                     {**speed.variables(scene, aspect, count), "steps": steps},
                                     build=build.resolve(), name=f"count_{name}",
                                     copies_as_loops=True)
        instructions[name] = found / (steps * count)
        sums[name] = speed.checksum(folder / "dump.final")
    return {"scene": scene, "lambda": aspect, "rods": count, "steps": steps,
            "instructions_before": f"{instructions['before']:.1f}",
            "instructions_after": f"{instructions['after']:.1f}",
            "after_over_before": f"{instructions['after'] / instructions['before']:.4f}",
            "same_end": sums["before"] == sums["after"]}


def compare(scene: str, aspect: int, count: int, given: argparse.Namespace) -> dict:
    builds = {"before": given.before, "after": given.after}
    settings = {**SETTINGS, "largest_peer": 0}
    settings["steps"] = {name: [given.longer * own, peers]
                         for name, (own, peers) in settings["steps"].items()}
    folder = given.folder / f"{scene}_{aspect}_{count}"
    if not (folder / "restart.start").exists():
        speed.start(scene, aspect, count, settings, given.before, folder)
    speed.link_all(folder)
    if given.count:
        return counts(scene, aspect, count, builds, given.count, folder)
    us: dict[str, list[float]] = {name: [] for name in builds}
    sums = {}
    for turn in range(given.turns):
        for name in sorted(builds, reverse=turn % 2 == 0):
            run = speed.time_once("plugin", scene, aspect, count, 1, settings,
                                  builds[name].resolve(), folder)
            us[name].append(1e6 * run["seconds"] / run["steps"] / count)
            sums[name] = run["checksum"]
    ratios = [a / b for a, b in zip(us["after"], us["before"])]
    return {"scene": scene, "lambda": aspect, "rods": count, "turns": given.turns,
            "us_before": f"{numpy.median(us['before']):.4g}",
            "us_after": f"{numpy.median(us['after']):.4g}",
            "after_over_before": f"{numpy.median(ratios):.4g}", "least": f"{min(ratios):.4g}",
            "most": f"{max(ratios):.4g}", "same_end": sums["before"] == sums["after"]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    scenes = sorted({scene for scene, _, _ in CASES})
    parser.add_argument("before", type=Path)
    parser.add_argument("after", type=Path)
    parser.add_argument("--scenes", nargs="+", default=scenes, choices=scenes)
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--longer", type=int, default=4, help="times the steps of bench/config.yaml")
    parser.add_argument("--count", type=int, default=0, metavar="STEPS",
                        help="count instructions of so many steps in place of timing")
    parser.add_argument("--folder", type=Path, default=HERE.parent / "build/studies/compare")
    parser.add_argument("--out", type=Path)
    given = parser.parse_args()
    for build in (given.before, given.after):
        if not (build / "lmp").exists():
            parser.error(f"{build} must be a folder with the program lmp, as build/release")
    table = []
    try:
        for scene, aspect, count in CASES:
            if scene not in given.scenes:
                continue
            table.append(compare(scene, aspect, count, given))
            print(" ".join(f"{name} {value}" for name, value in table[-1].items()), flush=True)
    except cases.CaseError as error:
        sys.exit(f"compare: {error}")
    if given.out:
        rows.write_rows(given.out, table)


if __name__ == "__main__":
    main()
