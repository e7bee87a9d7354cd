#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Strong and weak scaling of one scene over ranks and threads: a table and a figure, on a workstation or a
cluster. From the project's folder:

    /usr/bin/python3 bench/scaling.py --scene gas --lambda 30 --rods 20000 --ranks 1 2 --threads 1 2
    /usr/bin/python3 bench/scaling.py --scene gas --lambda 10 --rods 20000 --weak --ranks 1 8 64 --threads 8 \\
        --launch "srun -n {ranks} -c {threads}"

`--weak`: so many rods for each thread of each rank, else so many in all. Each case is run --turns times, in
turns with the others; the median counts, and cases are over the first one.
"""
from __future__ import annotations

import argparse
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy
import pandas
import yaml

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(ROOT)]

from bench import speed  # noqa: E402
from studies.common import cases, plots, rows  # noqa: E402

LAUNCH = "mpirun -np {ranks} --bind-to none"
SEEN = {"pairs": r"^Pair\s+time \(%\) = (\S+)", "messages": r"^Comm\s+time \(%\) = (\S+)"}


def positive(text: str) -> int:
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"must be a whole number > 0 (got {text})")
    return int(text)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", choices=speed.SCENES, default="gas")
    parser.add_argument("--lambda", dest="aspect", type=positive, default=30)
    parser.add_argument("--rods", type=positive, default=20000)
    parser.add_argument("--ranks", type=positive, nargs="+", default=[1])
    parser.add_argument("--threads", type=positive, nargs="+", default=[1])
    parser.add_argument("--weak", action="store_true")
    parser.add_argument("--turns", type=positive, default=3)
    parser.add_argument("--steps", type=positive, default=500)
    parser.add_argument("--launch", default=LAUNCH,
                        help=f"words before the program, default '{LAUNCH}'; of one rank none")
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "scaling")
    parser.add_argument("--out", type=Path, default=Path("scaling.csv"))
    given = parser.parse_args()
    if given.weak and given.scene not in ("gas", "dilute", "dense"):
        parser.error(f"--weak wants a gas, dilute or dense (got {given.scene})")
    return given


def begun(given: argparse.Namespace, rods: int) -> Path:
    """The folder of the starting state, made if it is not there."""
    folder = given.folder.resolve() / f"{given.scene}_{given.aspect}_{rods}"
    if not (folder / "restart.start").exists():
        print(f"scaling: {rods} rods of lambda {given.aspect} are placed", flush=True)
        settings = {**yaml.safe_load((HERE / "config.yaml").read_text()), "largest_peer": 0}
        speed.start(given.scene, given.aspect, rods, settings, given.build, folder)
    speed.link_all(folder)
    return folder


def run_once(given: argparse.Namespace, folder: Path, rods: int, ranks: int, threads: int) -> dict:
    launch = shlex.split(given.launch.format(ranks=ranks, threads=threads)) if ranks > 1 else []
    values = {**speed.variables(given.scene, given.aspect, rods), "steps": given.steps}
    command = [*launch, cases.program_path("lmp", given.build), "-in", "in.time_plugin", "-log",
               "log.scaling"]
    for name, value in values.items():
        command += ["-var", name, str(value)]
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(command, cwd=folder, env=environment, text=True, errors="replace", capture_output=True)
    log = folder / "log.scaling"
    text = log.read_text(errors="replace") if log.exists() else ""
    found = re.search(r"^Loop time of (\S+)", text, re.MULTILINE)
    if done.returncode != 0 or not found:
        errors = re.findall(r"^.*ERROR.*$", done.stdout + done.stderr, re.MULTILINE)
        raise cases.CaseError(f"{ranks} ranks of {threads} threads: "
                              f"{errors[0] if errors else 'no Loop time in the log'} ({folder})")
    parts = {name: re.search(pattern, text, re.MULTILINE) for name, pattern in SEEN.items()}
    return {"seconds": float(found[1]),
            "command": shlex.join(command).replace(str(ROOT) + "/", ""),
            **{name: float(part[1]) if part else numpy.nan for name, part in parts.items()}}


def table_of(given: argparse.Namespace, runs: dict) -> pandas.DataFrame:
    table = []
    for (ranks, threads, count), of_case in runs.items():
        seconds = numpy.array([run["seconds"] for run in of_case])
        first = numpy.array([run["seconds"] for run in next(iter(runs.values()))])
        # As many rods on each are to take as long; as many in all a part of it.
        ratio = float(numpy.median(first / seconds))
        us = 1e6 * seconds / given.steps
        table.append({
            "scene": given.scene, "lambda": given.aspect, "rods": count,
            "kind": "weak" if given.weak else "strong", "ranks": ranks, "threads": threads,
            "steps": given.steps, "us_per_step": f"{numpy.median(us):.5g}",
            "us_min": f"{us.min():.5g}", "us_max": f"{us.max():.5g}",
            "times_faster": f"{ratio * (count / next(iter(runs))[2]):.4g}",
            "pair_seconds": f"{numpy.median([run['pairs'] for run in of_case]):.4g}",
            "comm_seconds": f"{numpy.median([run['messages'] for run in of_case]):.4g}",
            **rows.provenance(of_case[-1]["command"], 0)})
    return pandas.DataFrame(table)


def draw(table: pandas.DataFrame, stem: Path) -> None:
    figure, axes = plots.new_figure(120, 85)
    for n, (threads, kind) in enumerate(table.groupby("threads")):
        cores = kind["ranks"] * kind["threads"]
        axes.plot(cores, kind["times_faster"].astype(float), marker=plots.MARKERS[n],
                  color=plots.CYCLE[n], label=f"{threads} threads a rank")
    most = (table["ranks"] * table["threads"]).max()
    axes.plot([1, most], [1, most], color="gray", linewidth=1, linestyle=plots.DASHES[1])
    axes.set(xscale="log", yscale="log", xlabel="cores", ylabel="times faster than the first case")
    axes.legend()
    plots.save(figure, stem)


def main() -> None:
    given = arguments()
    todo = [(ranks, threads, given.rods * (ranks * threads if given.weak else 1))
            for threads in given.threads for ranks in given.ranks]
    runs: dict = {case: [] for case in todo}
    try:
        for turn in range(given.turns):
            for case in todo:
                ranks, threads, count = case
                runs[case].append(run_once(given, begun(given, count), count, ranks, threads))
                print(f"scaling: turn {turn + 1} of {given.turns}, {ranks} ranks of {threads} "
                      f"threads, {count} rods: {runs[case][-1]['seconds']:.3f} s", flush=True)
    except cases.CaseError as error:
        sys.exit(f"scaling: {error}")
    table = table_of(given, runs)
    rows.write_rows(given.out, table)
    draw(table, given.out.with_suffix(""))
    print(table[["ranks", "threads", "rods", "us_per_step", "times_faster"]].to_string(index=False))


if __name__ == "__main__":
    main()
