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
from studies.common.statistics import limit_of_line, mean_and_error, student
from studies.speed_accuracy import chart

QUANTITIES = {"vf_inner": "inner", "vf_whole": "whole", "elevation_deg": "elevation",
              "contacts": "contacts"}
CASE = ["lambda", "method", "n", "rule", "stiffness", "time_step_over_limit"]
SMALL_STEP = 1.5   # a step of at most so many times the reference's counts as small
SPHERES_STEP = 0.36   # of glued spheres, of which the limit in n is taken
DECKS_STEP, QUICK_STEP = 0.09, 0.22   # of the decks' default and of quick 1, over the limit
BOUND = 0.03       # within which a setting keeps the bed
NAMES = {"inner": "V_f, inner cylinder", "whole": "V_f, whole vessel", "elevation": "mean elevation",
         "contacts": "contacts a rod"}


def jobs(config: dict, aspects: list[str], seeds: list) -> list[tuple[str, tuple]]:
    """Names of the beds that config.yaml plans, those of most worth for their time first, each with
    its case, as in the rows."""
    rods = [config["bed_reference"], *(config["bed_rods"] or [])]
    spheres = list(config["bed_spheres"] or [])
    kinds = [(f"rods_{c['rule']}_k{c['stiffness']:g}_f{c['fraction']:g}", c) for c in rods] + [
        (f"spheres_{c['spacing']:g}r_c{c['contacts']:g}_f{c['fraction']:g}", c) for c in spheres]
    return [(f"{aspect}_{name}_s{seed}", case_of(float(aspect), kind))
            for k, seed in enumerate(seeds) for aspect in aspects for name, kind in kinds
            if k < int(kind["seeds"]) and float(aspect) in kind.get("lambdas", [float(aspect)])]


def case_of(aspect: float, kind: dict) -> tuple:
    """Of an entry of config.yaml: λ, method, n, rule, stiffness, step, divided_by."""
    if "rule" in kind:
        return (aspect, "rods", 0, kind["rule"], float(kind["stiffness"]), float(kind["fraction"]), 1.0)
    return (aspect, "multisphere", spheres_of(aspect, kind["spacing"]), rule_of(kind["contacts"]), 1.0,
            float(kind["fraction"]), float(kind["contacts"]))


def spheres_of(aspect: float, spacing: float) -> int:
    return 1 + math.ceil(2.0 * (aspect - 1.0) / spacing - 1e-9)


def rule_of(contacts: float) -> str:
    return "nominal" if contacts == 1 else "adapted"


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
           "n": spheres_of(aspect, spacing), "rule": rule_of(contacts), "stiffness": 1.0,
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


def scatter_of(runs: pandas.DataFrame, quantity: str) -> tuple[float, int]:
    """Standard deviation of a quantity from bed to bed of a case, of all cases together, since each
    has few beds, and its degrees of freedom; NaN without a case of two beds. Of one λ: beds of rods and
    of glued spheres scatter alike."""
    groups = [part[quantity] for _, part in runs.groupby([*CASE, "divided_by"]) if len(part) > 1]
    freedom = sum(len(values) - 1 for values in groups)
    squares = sum((len(values) - 1) * values.var(ddof=1) for values in groups)
    return (math.sqrt(squares / freedom) if freedom else math.nan), freedom


def compare(values: pandas.Series, limit: pandas.Series, scatter: float) -> tuple[float, float]:
    """Relative difference of the means and its standard error, of beds that scatter so much."""
    wanted = limit.mean()
    return (values.mean() - wanted) / wanted, \
        scatter * math.sqrt(1 / len(values) + 1 / len(limit)) / wanted


def cut(rested: pandas.Series) -> bool:
    """Whether so many beds were ended before they were at rest that their median cost is a lower
    bound."""
    return 2 * int((rested == 0).sum()) >= len(rested)


def charted(runs: pandas.DataFrame, reference: dict) -> pandas.DataFrame:
    """A row a case and quantity: error against the reference with its standard error, and the core
    seconds until rest. Beds that never rest cost what they ran, which is less than to rest."""
    result, runs = [], standing(runs)
    for aspect in sorted(runs["lambda"].unique()):
        limit = reference_of(runs, aspect, reference)
        if limit.empty:
            continue
        here = runs[runs["lambda"] == aspect]
        for case, part in here.groupby(CASE, sort=False):
            if part["seed"].isin(limit["seed"]).all() and len(part) == len(limit) and \
                    part.index.equals(limit.index):
                continue   # the reference itself
            for quantity, name in QUANTITIES.items():
                bias, error = compare(part[quantity], limit[quantity],
                                      scatter_of(here, quantity)[0])
                cost = part["cpu_s"]
                result.append({
                    "scene": "bed", **dict(zip(CASE, case)), "cost": float(cost.median()),
                    "cost_min": float(cost.min()), "cost_max": float(cost.max()),
                    "error": abs(bias), "error_low": max(0.0, abs(bias) - error),
                    "error_high": abs(bias) + error, "quantity": name, "bias": bias,
                    "standard_error": error, "beds": len(part), "ended": "",
                    "rested": int(part["rested"].sum()),
                    "cost_is_least": int(cut(part["rested"])),
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


def bed_lines(runs: pandas.DataFrame, planned: dict[tuple, int]) -> list[list[str]]:
    """A line a case: what its beds are like and cost."""
    lines = []
    for case, part in standing(runs).groupby([*CASE, "divided_by"], sort=False):
        first, here = part.iloc[0], runs[runs["lambda"] == case[0]]
        cells = [f"{case[0]:g}", label(first), f"{len(part)} of {max(planned.get(case, 0), len(part))}"]
        for name, decimals in (("vf_inner", 3), ("vf_whole", 3), ("elevation_deg", 1),
                               ("contacts", 2)):
            error = scatter_of(standing(here), name)[0] / math.sqrt(len(part))
            cells.append(with_error((part[name].mean(), error), decimals))
        ever = part["overlap_ever"].max()
        cost = figure(part["cpu_s"].median(), 2)
        cells += [fixed(100 * part["overlap_max"].max(), 1), fixed(100 * ever, 0),
                  f"≥ {cost}" if cut(part["rested"]) else cost,
                  f"{part['rested'].sum():.0f} of {len(part)}"]
        lines.append(cells)
    return lines


def cheapest(charted_rows: pandas.DataFrame) -> list[list[str]]:
    """For V_f of the inner cylinder: the cheapest case of each method whose error, with its standard
    error, is below 10 and 3 %."""
    lines = []
    inner = charted_rows[charted_rows["quantity"] == "inner"]
    for aspect, part in inner.groupby("lambda"):
        for level in chart.BED_LEVELS:
            cells = [f"{aspect:g}", f"{100 * level:g} %"]
            found = [chart.answer(part, method, level) for method in ("rods", "multisphere")]
            for state, best in found:
                cells.append(state if best is None else
                             f"{label(best)}: {'≥ ' * int(best['cost_is_least'])}"
                             f"{figure(best['cost'], 2)} s")
            ours, theirs = (best for _, best in found)
            cells.append("–" if ours is None or theirs is None else
                         chart.ratio_of(theirs["cost"] / ours["cost"], ours["cost_is_least"],
                                        theirs["cost_is_least"]))
            lines.append(cells)
    return lines


def limit(cases, quantity: str, scatter: float, place) -> tuple[float, float, float]:
    """A quantity where `place` of a case is 0, its standard error, and chi squared a degree of freedom,
    by a line through the means of the cases; NaN of fewer than two of them."""
    points = [(place(part), part[quantity].mean(), scatter / math.sqrt(len(part)))
              for _, part in cases]
    if len(points) < 2 or not scatter > 0:
        return math.nan, math.nan, math.nan
    return limit_of_line(*zip(*points))


def limits_of(here: pandas.DataFrame, quantity: str, reference: dict) -> list[tuple]:
    """Of the beds of one λ, limit() of stiff contacts and of many spheres, and of either the number of
    beds of each case on its line."""
    small = reference["fraction"] * SMALL_STEP
    rods = here[(here["method"] == "rods") & (here["rule"] == reference["rule"])
                & (here["time_step_over_limit"] <= small)]
    # A crossing's contacts, as many as spheres are in a diameter, have its stiffness together.
    crossing = (2.0 * (here["lambda"] - 1.0) / (here["n"] - 1.0)).rdiv(2.0).round(6)
    spheres = here[(here["method"] == "multisphere") & (here["divided_by"] == crossing)
                   & (here["time_step_over_limit"] == SPHERES_STEP)]
    scatter = scatter_of(here, quantity)[0]
    stiff = rods.groupby(["stiffness", "time_step_over_limit"])
    smooth = spheres.groupby("n")
    return [(limit(stiff, quantity, scatter, lambda part: part["overlap_mean"].mean()),
             list(stiff.size())),
            (limit(smooth, quantity, scatter, lambda part: groove(part["lambda"].iloc[0],
                                                                  int(part["n"].iloc[0]))),
             list(smooth.size()))]


def limits(runs: pandas.DataFrame, reference: dict) -> list[list[str]]:
    """The reference beside two limits: of stiff contacts, where rods no longer overlap, and of glued
    spheres where the grooves between them, which get as shallow as n is large, are gone."""
    lines, runs = [], standing(runs)
    for quantity, decimals in (("vf_inner", 3), ("vf_whole", 3), ("elevation_deg", 1), ("contacts", 2)):
        for aspect in sorted(runs["lambda"].unique()):
            here, there = runs[runs["lambda"] == aspect], reference_of(runs, aspect, reference)
            if there.empty:
                continue
            wanted = there[quantity].mean()
            own = scatter_of(here, quantity)[0] / math.sqrt(len(there))
            cells = [NAMES[QUANTITIES[quantity]], f"{aspect:g}", with_error((wanted, own), decimals)]
            for (value, error, chi), beds in limits_of(here, quantity, reference):
                away = math.hypot(error, own)
                cells += ["–", "–", "–"] if math.isnan(value) else [
                    with_error((value, error), decimals) + ("" if math.isnan(chi) else
                                                            f" ({fixed(chi, 1)})"),
                    signed(value / wanted - 1, 1) + f" ± {fixed(100 * away / wanted, 1)} %",
                    ", ".join(map(str, beds))]
            del cells[5]   # of the rods' line: it is in the table of all beds
            lines.append(cells)
    return lines


def signed(value: float, decimals: int) -> str:
    """In per cent, with its sign."""
    return f"{100 * value:+.{decimals}f}".replace("-", "−")


def kept(runs: pandas.DataFrame) -> pandas.DataFrame:
    """For each stiffness and step of rods with spread contacts: relative difference of each quantity from
    the decks' default, its 90 % interval, and whether that lies within ±BOUND; for each λ, and for all λ
    together (0), where it is the mean of the differences."""
    rods = standing(runs)
    result, own = [], {}
    for aspect, here in rods.groupby("lambda"):
        ours = here[(here["method"] == "rods") & (here["rule"] == "spread")]
        decks = (ours["stiffness"] == 1) & (ours["time_step_over_limit"] == DECKS_STEP)
        for key, part in ours[~decks].groupby(["stiffness", "time_step_over_limit"]):
            for quantity in QUANTITIES:
                scatter, freedom = scatter_of(here, quantity)
                if decks.any() and freedom:
                    bias, error = compare(part[quantity], ours.loc[decks, quantity], scatter)
                    own.setdefault((*key, quantity), []).append(
                        (aspect, len(part), bias, error, freedom))
    for (stiffness, step, quantity), found in own.items():
        together = (0.0, sum(f[1] for f in found), float(np.mean([f[2] for f in found])),
                    math.sqrt(sum(f[3] ** 2 for f in found)) / len(found),
                    sum(f[3] ** 2 for f in found) ** 2 / sum(f[3] ** 4 / f[4] for f in found)
                    if any(f[3] for f in found) else math.inf)
        for aspect, beds, bias, error, freedom in [*found, *([together] if len(found) > 1 else [])]:
            width = student(0.95, freedom) * error
            result.append({"stiffness": stiffness, "step": step, "quantity": quantity, "lambda": aspect,
                           "lambdas": len(found), "beds": beds, "difference": bias,
                           "low": bias - width, "high": bias + width,
                           "kept": max(abs(bias - width), abs(bias + width)) < BOUND})
    return pandas.DataFrame(result)


def kept_lines(table: pandas.DataFrame) -> list[list[str]]:
    """A line a setting and λ; bold what is shown to be kept."""
    lines = []
    for (stiffness, step, aspect), part in table.groupby(["stiffness", "step", "lambda"], sort=True):
        cells = [f"{stiffness:g}", f"{step:g}",
                 f"{aspect:g}" if aspect else f"{part['lambdas'].iloc[0]} together",
                 str(part["beds"].iloc[0])]
        by = part.set_index("quantity")
        for quantity in QUANTITIES:
            row = by.loc[quantity]
            text = f"{signed(row['low'], 1)} to {signed(row['high'], 1)}"
            cells.append(f"**{text}**" if row["kept"] else text)
        lines.append((stiffness, step, aspect or math.inf, cells))
    return [cells for *_, cells in sorted(lines, key=lambda line: line[:3])]


def kept_words(table: pandas.DataFrame) -> list[str]:
    """Of each quantity the largest step at the decks' stiffness, and the softest contact, that keep it,
    of all λ that have such beds."""
    words = []
    for quantity, name in QUANTITIES.items():
        good = table[(table["quantity"] == quantity) & (table["lambda"] == 0) & table["kept"]]
        steps = good.loc[good["stiffness"] == 1, "step"]
        soft = good.loc[good["stiffness"] < 1]
        words.append(f"{NAMES[name]}: " + (f"step {steps.max():g}" if len(steps) else "no larger step")
                     + ", " + (f"stiffness × {soft['stiffness'].min():g}" if len(soft)
                               else "no softer contact"))
    return words


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


def apart(runs: pandas.DataFrame, reference: dict, quantity: str = "elevation_deg") -> list[str]:
    """λ at which every case of rods with spread contacts lies to one side of the reference by more than
    the standard error of the difference."""
    found = []
    for aspect, here in standing(runs).groupby("lambda"):
        limit = reference_of(runs, aspect, reference)
        cases = here[(here["method"] == "rods") & (here["rule"] == "spread")
                     & ~here.index.isin(limit.index)].groupby(CASE)
        away = [compare(part[quantity], limit[quantity], scatter_of(here, quantity)[0])
                for _, part in cases if len(limit)]
        if len(away) > 1 and (all(b > e for b, e in away) or all(b < -e for b, e in away)):
            found.append((f"{aspect:g}", min(abs(b) for b, _ in away), max(abs(b) for b, _ in away)))
    return [f"λ = {a}: {100 * low:.0f} to {100 * high:.0f} %" for a, low, high in found]


def against_most(runs: pandas.DataFrame) -> dict | None:
    """The largest λ's beds of most spheres that overlap along the rod, and rods with the step of quick 1
    beside them."""
    runs = standing(runs)
    spheres = runs[(runs["method"] == "multisphere") & (runs["n"] > runs["lambda"])]
    if spheres.empty:
        return None
    part = spheres[spheres["lambda"] == spheres["lambda"].max()]
    part = part[part["n"] == part["n"].max()]
    aspect = part["lambda"].iloc[0]
    rods = runs[(runs["lambda"] == aspect) & (runs["method"] == "rods") & (runs["rule"] == "spread")
                & (runs["stiffness"] == 1) & (runs["time_step_over_limit"] == QUICK_STEP)]
    if rods.empty:
        return None
    seconds, ours = part["cpu_s"].median(), rods["cpu_s"].median()
    return {"aspect": f"{aspect:g}", "n": int(part["n"].iloc[0]), "beds": len(part),
            "rested": int(part["rested"].sum()), "seconds": figure(seconds, 2),
            "rods_beds": len(rods), "rods_seconds": figure(ours, 2), "times": figure(seconds / ours, 2),
            "at_least": cut(part["rested"])}


def few(runs: pandas.DataFrame) -> dict:
    """Numbers of cases by their number of beds."""
    sizes = standing(runs).groupby([*CASE, "divided_by"]).size()
    return {"cases": len(sizes), "one": int((sizes == 1).sum()), "most": int((sizes == sizes.max()).sum()),
            "largest": int(sizes.max()), "least": chart.FEWEST_BEDS}


def missing_lines(runs: pandas.DataFrame, planned: dict[tuple, int]) -> list[list[str]]:
    """Cases that are planned and of which no bed is there."""
    there = set(runs.groupby([*CASE, "divided_by"]).groups)
    return [f"λ = {case[0]:g}: {label(dict(zip([*CASE, 'divided_by'], case)))}"
            for case in planned if case not in there]


def page_values(runs: pandas.DataFrame, charted_rows: pandas.DataFrame, reference: dict,
                results: str, planned: dict[tuple, int], end: float) -> dict:
    """planned: beds that config.yaml asks for of each case; end: s, of beds that do not rest."""
    made = len(runs)
    limits_found, kept_found = limits(runs, reference), kept(runs)
    fallen, all_runs, runs = fallen_lines(runs), runs, standing(runs)
    spheres = runs[runs["method"] == "multisphere"]
    return {"fallen": fallen, "beds": bed_lines(runs, planned), "cheapest": cheapest(charted_rows),
            "limits": limits_found, "kept": kept_lines(kept_found) if len(kept_found) else [],
            "kept_words": kept_words(kept_found) if len(kept_found) else [],
            "bound": 100 * BOUND, "elevation_apart": apart(runs, reference),
            "most": against_most(runs), "few": few(runs), "made": made,
            "planned": sum(planned.values()), "missing": missing_lines(all_runs, planned),
            "end": end, "results": results,
            "machine": " and ".join(sorted(runs["machine"].unique())),
            "aspects": ", ".join(f"{a:g}" for a in sorted(runs["lambda"].unique())),
            "quantities": [(f"bed_{q}", NAMES[q]) for q in NAMES
                           if q in set(charted_rows["quantity"])],
            "reference": label({**reference, "method": "rods",
                                "time_step_over_limit": reference["fraction"]}),
            "spheres_rested": int(spheres["rested"].sum()), "spheres_beds": len(spheres),
            "rods_rested": int((runs["method"] == "rods").mul(runs["rested"]).sum()),
            "rods_beds": int((runs["method"] == "rods").sum())}
