# SPDX-License-Identifier: GPL-2.0-or-later
"""Maps: which points they have, their rows, and beds of the decks' size."""
from __future__ import annotations

import itertools
import math
import tempfile
from dataclasses import replace
from pathlib import Path

import pandas

from studies.common import cases
from studies.common.rows import provenance, write_rows
from studies.stability import bed, states

LISTS = {"lambdas": None, "methods": ["ours"], "fractions": [0.18], "restitutions": [0.5],
         "frictions": [0.2], "stiffnesses": [1.0], "speeds": [0.0], "spheres": [0],
         "rods": [40], "drops": [2.5], "seeds": [86028121]}


def number(name: str, given, least: float) -> float:
    try:
        value = float(given)
    except (TypeError, ValueError):
        value = math.nan
    if not least <= value < math.inf:
        raise cases.CaseError(f"{name} must be numbers >= {least:g} (got {given})")
    return value


def checked(name: str, given: dict) -> dict:
    """The lists of a map, with the defaults of those left out; CaseError for what is no map."""
    unknown = set(given) - set(LISTS)
    if unknown or "lambdas" not in given:
        raise cases.CaseError(f"{name} must have lambdas and may have {', '.join(list(LISTS)[1:])} "
                              f"(got {', '.join(given)})")
    lists = {key: given.get(key, default) for key, default in LISTS.items()}
    for key, values in lists.items():
        if not isinstance(values, list) or not values:
            raise cases.CaseError(f"{key} of {name} must be a list (got {values})")
        if key not in ("methods", "seeds"):
            lists[key] = [number(f"{key} of {name}", value, 1.0 if key == "lambdas" else 0.0)
                          for value in values]
    for method in lists["methods"]:
        bed.method_of(method)
    return lists


def jobs(name: str, given: dict) -> list[str]:
    """A job is a method, an aspect ratio and a seed."""
    lists = checked(name, given)
    return [f"{name}/{method}_{aspect:g}_s{seed}" for seed, method, aspect in
            itertools.product(lists["seeds"], lists["methods"], lists["lambdas"])]


def spheres_of(aspect: float, kind: int) -> int:
    """None, λ, or 2 λ − 1 spheres a rod: two or one radius apart."""
    return 0 if kind == 0 else max(2, round(kind * (aspect - 1)) + 1)


def run_job(path, name: str, given: dict, method: str, aspect: float, seed: int, build) -> None:
    """Writes the rows of a job."""
    lists = checked(name, given)
    without, limit = bed.method_of(method)
    rows = []
    for fraction, e, mu, k, v, n, rods, drop in itertools.product(
            lists["fractions"], lists["restitutions"], lists["frictions"], lists["stiffnesses"],
            lists["speeds"], lists["spheres"], lists["rods"], lists["drops"]):
        point = bed.Point(aspect=float(aspect), fraction=fraction, without=without, limit=limit,
                          stiffness=k, restitution=e, friction=mu, speed=v, seed=seed,
                          spheres=spheres_of(aspect, n), rods=int(rods), drop=drop)
        with tempfile.TemporaryDirectory(dir=Path(path).parent) as folder:
            row = bed.run(Path(folder).resolve() / "bed", point, build)
        # The command's folder is gone; what is given by -var makes it again.
        rows.append({"map": name, "method": method if not point.spheres else "glued", **row})
    write_rows(path, rows)


# --- Beds of the decks' size. -------------------------------------------------------------------

def large(config: dict, method: str, seed: int, **others) -> bed.Point:
    without, limit = bed.method_of(method)
    return replace(bed.Point(
        aspect=float(config["bed_lambda"]), fraction=float(config["bed_fraction"]), without=without,
        limit=limit, rods=int(config["bed_rods"]), vessel=float(config["bed_vessel"]), frames=False,
        drop=float(config["bed_drop"]), time=float(config["bed_time"]), seed=seed), **others)


def cost_bed(path, config: dict, method: str, seed: int, build) -> None:
    """Writes the row of a bed of the decks' size: what it is like at its end."""
    point = large(config, method, seed)
    folder = Path(path).resolve().with_suffix("")
    row = bed.run(folder, point, build)
    if not row["ended_by"]:
        measured = cases.measure_bed(folder / "dump.last", 0.5 * point.vessel, build)
        row |= {name: measured[name] for name in ("vf_inner", "vf_whole", "mean_elevation_deg")}
    else:
        row |= {"vf_inner": math.nan, "vf_whole": math.nan, "mean_elevation_deg": math.nan}
    write_rows(path, [{"method": method, **row}])


def slow_bed(path, config: dict, method: str, seed: int, build) -> None:
    """Writes a row a measurement: V_f, elevation and what still moves, against time."""
    point = large(config, method, seed, time=float(config["slow_time"]))
    folder = Path(path).resolve().with_suffix("")
    values = bed.variables(point)
    every = max(1, round(float(config["slow_every"]) / float(values["dt"])))
    folder.mkdir(parents=True, exist_ok=True)
    run = cases.run_deck(folder, bed.DECK, values | {"history_every": every}, build=build)
    table, _, rested = bed.series(folder / "log.bed")
    kinetic, _ = states.energies(table, point.aspect, point.rods)
    measured = folder / "packing.csv"
    cases.run_tool("rod_packing", folder / "dump.bed", "--frame", "all", "--vessel-radius",
                   f"{0.5 * point.vessel:g}", "--csv", measured, build=build)
    packing = pandas.read_csv(measured)
    packing["time"] = packing["step"] * float(values["dt"])
    packing = packing[packing["time"] > bed.landing_time(point)]
    rows = []
    for _, frame in packing.iterrows():
        near = (table["time"] - frame["time"]).abs().idxmin()
        rows.append({"method": method, "lambda": point.aspect, "time_s": frame["time"],
                     "vf_inner": frame["vf_inner"], "vf_whole": frame["vf_whole"],
                     "kinetic": kinetic[table.index.get_loc(near)],
                     "torque": table.loc[near, "torque"],
                     "rested_at_s": table["time"].iloc[-1] if rested else math.nan,
                     **provenance(run.command, seed)})
    (folder / "dump.bed").unlink()
    write_rows(path, rows)
