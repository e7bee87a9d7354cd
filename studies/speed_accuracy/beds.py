# SPDX-License-Identifier: GPL-2.0-or-later
"""Settled beds: one run as a row, and the rows that are charted."""
from __future__ import annotations

import math
import re
import shutil
from pathlib import Path

import numpy as np
import pandas

from studies.common import settling
from studies.common.cases import DeckError
from studies.common.pages import figure, fixed, with_error
from studies.common.rows import provenance, write_rows
from studies.common.statistics import limit_of_line, mean_and_error

QUANTITIES = {"vf_inner": "inner", "vf_whole": "whole", "elevation_deg": "elevation",
              "contacts": "contacts"}
CASE = ["lambda", "method", "n", "rule", "stiffness", "time_step_over_limit"]
SMALL_STEP = 1.5   # a step of at most so many times the reference's counts as small
SPHERES_STEP = 0.36   # of glued spheres, of which the limit in n is taken
NAMES = {"inner": "V_f, inner cylinder", "whole": "V_f, whole vessel", "elevation": "mean elevation",
         "contacts": "contacts a rod"}


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
    """Writes the row of a bed of true rods. As for its peer, the skin of the host's lists is one that
    serves rods in their fall."""
    row = {"lambda": aspect, "method": "rods", "n": 0, "rule": rule, "stiffness": stiffness,
           "time_step_over_limit": fraction, "divided_by": 1}
    write_bed(path, row, aspect, seed, build, lambda folder: settling.settle_rods(
        folder, aspect, seed, stiffness, fraction, rule, total_time=time, number=number or None,
        skin=10.0, build=build))


def spheres(path, aspect, seed, spacing, contacts, fraction, time, number, deck, build) -> None:
    """Writes the row of a bed of rods glued of spheres."""
    row = {"lambda": aspect, "method": "multisphere",
           "n": 1 + math.ceil(2.0 * (aspect - 1.0) / spacing - 1e-9),
           "rule": "nominal" if contacts == 1 else "adapted", "stiffness": 1.0,
           "time_step_over_limit": fraction, "divided_by": contacts}
    write_bed(path, row, aspect, seed, build, lambda folder: settling.settle_spheres(
        folder, aspect, seed, spacing, deck, contacts, fraction=fraction, total_time=time,
        number=number or None, build=build))


def write_bed(path, row: dict, aspect, seed, build, settle) -> None:
    """The row of a bed that `settle(folder)` makes. One that ends in an error of LIGGGHTS is a row
    that says so: its settings are not to be used."""
    try:
        bed = settle(folder_of(path))
    except DeckError as error:
        ended = re.sub(r" \(\S+:\d+\)$", "", error.reason)   # file and line of the source
        write_rows(path, [row | {"rested": 0, "ended": ended, **provenance(error.command, seed)}])
        return
    write_rows(path, [row | {"ended": "", **settling.measure(bed, aspect, seed, build)}])
    tidy(folder_of(path), bed.dump)


def standing(runs: pandas.DataFrame) -> pandas.DataFrame:
    """Beds that did not end in an error."""
    return runs[runs["ended"].fillna("") == ""] if "ended" in runs else runs


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
    result, runs = [], standing(runs)
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


def label(case: dict | pandas.Series) -> str:
    """What a case is, for a table."""
    step = f"step {case['time_step_over_limit']:g}"
    if case["method"] == "rods":
        rule = "spread contact" if case["rule"] == "spread" else "single contact"
        return f"rods, {rule}, stiffness × {case['stiffness']:g}, {step}"
    divided = "" if case["divided_by"] == 1 else f", divided by {case['divided_by']:g}"
    return f"{case['n']:.0f} spheres{divided}, {step}"


def groove(aspect: float, n: int) -> float:
    """How deep the grooves between the spheres of a rod are, over the diameter."""
    half = min(1.0, (aspect - 1.0) / (n - 1))   # half the spacing, over the radius
    return 0.5 * (1.0 - math.sqrt(1.0 - half ** 2))


def bed_lines(runs: pandas.DataFrame) -> list[list[str]]:
    """A line a case: what its beds are like and cost."""
    lines = []
    for (aspect, *_), part in standing(runs).groupby([*CASE, "divided_by"], sort=False):
        first = part.iloc[0]
        cells = [f"{aspect:g}", label(first), str(len(part))]
        for name, decimals in (("vf_inner", 3), ("vf_whole", 3), ("elevation_deg", 1),
                               ("contacts", 2)):
            cells.append(with_error(mean_and_error(part[name]), decimals))
        ever = part["overlap_ever"].max()
        cells += [fixed(100 * part["overlap_max"].max(), 1),
                  fixed(100 * ever, 0), figure(part["cpu_s"].median(), 2),
                  f"{part['rested'].sum():.0f} of {len(part)}"]
        lines.append(cells)
    return lines


def cheapest(charted_rows: pandas.DataFrame) -> list[list[str]]:
    """For V_f of the inner cylinder: the cheapest case of each method whose error, with its standard
    error, is below 10 and 3 %."""
    lines = []
    inner = charted_rows[charted_rows["quantity"] == "inner"]
    for aspect, part in inner.groupby("lambda"):
        for level in (0.10, 0.03):
            cells = [f"{aspect:g}", f"{100 * level:g} %"]
            costs = []
            for method in ("rods", "multisphere"):
                good = part[(part["method"] == method) & (part["error_high"] <= level)]
                best = good.loc[good["cost"].idxmin()] if len(good) else None
                cells.append("none tried" if best is None
                             else f"{label(best)}: {figure(best['cost'], 2)} s")
                costs.append(math.nan if best is None else best["cost"])
            cells.append(figure(costs[1] / costs[0], 2) if costs[0] > 0 else "–")
            lines.append(cells)
    return lines


def scatter_of(runs: pandas.DataFrame) -> float:
    """Standard deviation of V_f, inner cylinder, from bed to bed of a case: of one method and aspect
    ratio all cases together, of few beds each. NaN without a case of two."""
    squares = [(len(part) - 1, part["vf_inner"].var(ddof=1))
               for _, part in runs.groupby([*CASE, "divided_by"]) if len(part) > 1]
    freedom = sum(n for n, _ in squares)
    return math.sqrt(sum(n * square for n, square in squares) / freedom) if freedom else math.nan


def limit(cases, scatter: float, place) -> tuple[float, float, float]:
    """V_f of the inner cylinder where `place` of a case is 0, its standard error, and chi squared a
    degree of freedom, by a line through the means of the cases; NaN of fewer than two of them."""
    points = [(place(part), part["vf_inner"].mean(), scatter / math.sqrt(len(part)))
              for _, part in cases]
    if len(points) < 2 or not scatter > 0:
        return math.nan, math.nan, math.nan
    return limit_of_line(*zip(*points))


def limits(runs: pandas.DataFrame, reference: dict) -> list[list[str]]:
    """The reference beside two limits: of stiff contacts, where rods no longer overlap, and of glued
    spheres where the grooves between them, which get as shallow as n is large, are gone."""
    lines, runs = [], standing(runs)
    for aspect in sorted(runs["lambda"].unique()):
        here = runs[runs["lambda"] == aspect]
        there = reference_of(runs, aspect, reference)
        if there.empty:
            continue
        small = reference["fraction"] * SMALL_STEP
        rods = here[(here["method"] == "rods") & (here["rule"] == reference["rule"])
                    & (here["time_step_over_limit"] <= small)]
        # A crossing's contacts, as many as spheres are in a diameter, have its stiffness together.
        crossing = (2.0 * (aspect - 1.0) / (here["n"] - 1.0)).rdiv(2.0).round(6)
        spheres = here[(here["method"] == "multisphere") & (here["divided_by"] == crossing)
                       & (here["time_step_over_limit"] == SPHERES_STEP)]
        stiff = limit(rods.groupby(["stiffness", "time_step_over_limit"]), scatter_of(rods),
                      lambda part: part["overlap_mean"].mean())
        smooth = limit(spheres.groupby("n"),
                       scatter_of(here[here["method"] == "multisphere"]),
                       lambda part: groove(aspect, int(part["n"].iloc[0])))
        wanted = mean_and_error(there["vf_inner"])
        cells = [f"{aspect:g}", with_error(wanted, 3)]
        for value, error, chi in (stiff, smooth):
            away = math.hypot(error, wanted[1])
            cells += ["–", "–"] if math.isnan(value) else [
                with_error((value, error), 3) + ("" if math.isnan(chi) else f" ({fixed(chi, 1)})"),
                f"{100 * (value / wanted[0] - 1):+.1f} ± {100 * away / wanted[0]:.1f} %"
                .replace("-", "−")]
        lines.append(cells)
    return lines


def fallen_lines(runs: pandas.DataFrame) -> list[list[str]]:
    """A line a case of which beds ended in an error: how many, and the first's reason."""
    lines = []
    for (aspect, *_), part in runs.groupby([*CASE, "divided_by"], sort=False):
        fallen = part.drop(standing(part).index)
        if len(fallen):
            reason = re.sub(r"^ERROR( on proc \d+)?: ", "", fallen.iloc[0]["ended"])
            lines.append([f"{aspect:g}", label(part.iloc[0]), f"{len(fallen)} of {len(part)}",
                          reason.split(", so that")[0]])
    return lines


def page_values(runs: pandas.DataFrame, charted_rows: pandas.DataFrame, reference: dict,
                results: str) -> dict:
    fallen, runs = fallen_lines(runs), standing(runs)
    spheres = runs[runs["method"] == "multisphere"]
    return {"fallen": fallen, "beds": bed_lines(runs), "cheapest": cheapest(charted_rows),
            "limits": limits(runs, reference), "results": results,
            "machine": " and ".join(sorted(runs["machine"].unique())),
            "aspects": ", ".join(f"{a:g}" for a in sorted(runs["lambda"].unique())),
            "quantities": [(f"bed_{q}", NAMES[q]) for q in NAMES
                           if q in set(charted_rows["quantity"])],
            "reference": label({**reference, "method": "rods",
                                "time_step_over_limit": reference["fraction"]}),
            "spheres_rested": int(spheres["rested"].sum()), "spheres_beds": len(spheres),
            "rods_rested": int((runs["method"] == "rods").mul(runs["rested"]).sum()),
            "rods_beds": int((runs["method"] == "rods").sum())}
