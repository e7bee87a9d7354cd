# SPDX-License-Identifier: GPL-2.0-or-later
"""Settled beds: one run as a row, and the rows that are charted."""
from __future__ import annotations

import math
import shutil
from pathlib import Path

import numpy as np
import pandas

from studies.common import settling
from studies.common.rows import write_rows
from studies.common.statistics import mean_and_error

QUANTITIES = {"vf_inner": "inner", "vf_whole": "whole", "elevation_deg": "elevation",
              "contacts": "contacts"}
CASE = ["lambda", "method", "n", "rule", "stiffness", "time_step_over_limit"]


def folder_of(path: str | Path) -> Path:
    return Path(path).resolve().with_suffix("")


def tidy(folder: Path, kept: Path) -> None:
    """Of a bed's files only its last frame and logs stay."""
    for path in folder.rglob("*"):
        if path.name.startswith(("restart.", "dump.bodies", "peer.")):
            path.unlink()
    if not kept.exists():
        raise FileNotFoundError(kept)
    shutil.rmtree(folder / "start", ignore_errors=True)


def rods(path, aspect, seed, rule, stiffness, fraction, time, number, build) -> None:
    """Writes the row of a bed of true rods."""
    bed = settling.settle_rods(folder_of(path), aspect, seed, stiffness, fraction, rule,
                               total_time=time, number=number or None, build=build)
    write_rows(path, [{"lambda": aspect, "method": "rods", "n": 0, "rule": rule,
                       "stiffness": stiffness, "time_step_over_limit": fraction, "divided_by": 1,
                       **settling.measure(bed, aspect, seed, build)}])
    tidy(folder_of(path), bed.dump)


def spheres(path, aspect, seed, spacing, contacts, fraction, time, number, deck, build) -> None:
    """Writes the row of a bed of rods glued of spheres."""
    bed = settling.settle_spheres(folder_of(path), aspect, seed, spacing, deck, contacts,
                                  fraction=fraction, total_time=time, number=number or None,
                                  build=build)
    n = 1 + math.ceil(2.0 * (aspect - 1.0) / spacing - 1e-9)
    write_rows(path, [{"lambda": aspect, "method": "multisphere", "n": n,
                       "rule": "nominal" if contacts == 1 else "adapted", "stiffness": 1.0,
                       "time_step_over_limit": fraction, "divided_by": contacts,
                       **settling.measure(bed, aspect, seed, build)}])
    tidy(folder_of(path), bed.dump)


def reference_of(runs: pandas.DataFrame, aspect: float, reference: dict) -> pandas.DataFrame:
    """Runs of the stiffest contact with a small step, of one aspect ratio."""
    return runs[(runs["lambda"] == aspect) & (runs["method"] == "rods")
                & (runs["rule"] == reference["rule"])
                & (runs["stiffness"] == float(reference["stiffness"]))
                & (runs["time_step_over_limit"] == float(reference["fraction"]))]


def compare(values: pandas.Series, limit: pandas.Series) -> tuple[float, float]:
    """Relative difference of the means and its standard error. Both are indexed by seed."""
    mean, error = mean_and_error(values)
    wanted, wanted_error = mean_and_error(limit)
    if len(values) == 1:   # the scatter of the reference stands for that of one bed
        error = float(limit.std(ddof=1)) if len(limit) > 1 else math.nan
    return (mean - wanted) / wanted, math.hypot(error, wanted_error) / wanted


def charted(runs: pandas.DataFrame, reference: dict) -> pandas.DataFrame:
    """A row a case and quantity: error against the reference with its standard error, and the core
    seconds until rest. Beds that never rest cost what they ran."""
    result = []
    for aspect in sorted(runs["lambda"].unique()):
        limit = reference_of(runs, aspect, reference)
        if limit.empty:
            continue
        for case, part in runs[runs["lambda"] == aspect].groupby(CASE, sort=False):
            if part["seed"].isin(limit["seed"]).all() and len(part) == len(limit) and \
                    part.index.equals(limit.index):
                continue   # the reference itself
            for quantity, name in QUANTITIES.items():
                bias, error = compare(part.set_index("seed")[quantity],
                                      limit.set_index("seed")[quantity])
                cost = part["cpu_s"]
                result.append({
                    "scene": "bed", **dict(zip(CASE, case)), "cost": float(cost.median()),
                    "cost_min": float(cost.min()), "cost_max": float(cost.max()),
                    "error": abs(bias), "error_low": max(0.0, abs(bias) - error),
                    "error_high": abs(bias) + error, "quantity": name, "bias": bias,
                    "standard_error": error, "beds": len(part),
                    "ended": "" if part["rested"].all() else "not at rest",
                    "divided_by": float(part["divided_by"].iloc[0]),
                    "overlap_max": float(part["overlap_max"].max()),
                    "overlap_ever": float(part["overlap_ever"].max()),
                    "end_time_s": float(np.mean(part["end_time_s"])),
                    "command": part["command"].iloc[0],
                    "seed": " ".join(str(s) for s in sorted(part["seed"])),
                    "version": part["version"].iloc[0], "machine": part["machine"].iloc[0]})
    return pandas.DataFrame(result)
