# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page says, from the tables."""
from __future__ import annotations

import math

import pandas

from studies.common import settling
from studies.common.pages import figure, fixed, power, with_error
from studies.common.statistics import mean_and_error
from studies.speed_accuracy.rods import damping_ratio
from studies.stability import theory
from studies.stability.figures import METHODS, title_of, worst
from studies.stability.states import STATES

STAND = ("rests", "moves")   # nothing is wrong with these


def stands_up_to(part: pandas.DataFrame) -> float:
    """Largest step up to which all beds of all smaller ones stand, 0 if those of the least do
    not."""
    largest = 0.0
    for step, cell in sorted(part.groupby("fraction"), key=lambda pair: pair[0]):
        if not cell["state"].isin(STAND).all():
            break
        largest = step
    return largest


def number(value: float) -> str:
    return f"{value:g}" if value else "none"


def largest_step(part: pandas.DataFrame) -> str:
    """A dash where there is no bed."""
    return "–" if part.empty else number(stands_up_to(part))


def step_lines(beds: pandas.DataFrame) -> list[list[str]]:
    """A line a method: the largest step that each λ stands."""
    part = beds[beds["map"] == "steps"]
    aspects = sorted(part["lambda"].unique())
    return [[title_of(method)] + [largest_step(rows[rows["lambda"] == a]) for a in aspects]
            for method, rows in part.groupby("method", sort=False)]


def energy_lines(beds: pandas.DataFrame, name: str) -> list[list[str]]:
    """What moves at the end, as the rods are by default: a line a step."""
    part = beds[(beds["map"] == name) & (beds["method"] == "ours")]
    aspects = sorted(part["lambda"].unique())
    lines = []
    for step, rows in part.groupby("fraction"):
        cells = [f"{step:g}"]
        for a in aspects:
            cell = rows[rows["lambda"] == a]
            state = worst(cell["state"]) if len(cell) else "–"
            moving = f", {power(cell['kinetic'].max())}" if state not in ("lost", "–") else ""
            cells.append(state + moving)
        lines.append(cells)
    return lines


def remedy_lines(beds: pandas.DataFrame) -> list[list[str]]:
    """A line a method: of its beds at each step, how many stand, and what became of the others."""
    part = beds[beds["map"] == "remedies"]
    lines = []
    for method, rows in part.groupby("method", sort=False):
        cells = [title_of(method)]
        for step in sorted(part["fraction"].unique()):
            cell = rows[rows["fraction"] == step]
            if cell.empty:
                cells.append("–")
                continue
            good = int(cell["state"].isin(STAND).sum())
            worse = worst(cell["state"])
            cells.append(f"{good} of {len(cell)}" + ("" if good == len(cell) else f", {worse}"))
        lines.append(cells)
    return lines


def alone(beds: pandas.DataFrame) -> dict:
    """Of the remedies: the step up to which rods as they are by default stand, and which single
    remedies do as well, which not, and what stands with none."""
    part = beds[beds["map"] == "remedies"]
    up_to = {method: stands_up_to(rows) for method, rows in part.groupby("method", sort=False)}
    ours, plain = up_to.pop("ours", 0.0), up_to.pop("plain", 0.0)
    names = [(title_of(method).removeprefix("plain, "), step) for method, step in up_to.items()]
    return {"ours": number(ours), "plain": number(plain),
            "good": [name for name, step in names if 0 < ours <= step],
            "bad": [f"{name} ({number(step)})" for name, step in names if step < ours]}


def cost_lines(costs: pandas.DataFrame) -> list[list[str]]:
    """What beds of the decks' size are like at their end."""
    lines = []
    for method, rows in costs.groupby("method", sort=False):
        cells = [title_of(method), worst(rows["state"])]
        for name, decimals in (("vf_inner", 4), ("vf_whole", 4), ("mean_elevation_deg", 1),
                               ("contacts", 2), ("height", 1)):
            cells.append(with_error(mean_and_error(rows[name].dropna()), decimals))
        cells += [power(rows["kinetic"].max()), fixed(100 * rows["overlap_mean"].mean(), 2),
                  figure(rows["removed"].mean(), 3), figure(rows["end_s"].max(), 3)]
        lines.append(cells)
    return lines


def hit_lines(hits: pandas.DataFrame) -> list[list[str]]:
    lines = []
    for (method, e), rows in hits.groupby(["method", "restitution"], sort=False):
        grow = rows[rows["energy_most"] > 1]["fraction"]
        calm = rows[rows["energy_most"] <= 1]["fraction"]
        lines.append([title_of(method), f"{e:g}", fixed(rows["damping"].iloc[0], 3),
                      fixed(rows["onset"].iloc[0], 3),
                      fixed(theory.mean_onset(rows["damping"].iloc[0]), 3),
                      f"{calm[calm < grow.min()].max():g}, {grow.min():g}" if len(grow) and e < 1
                      else "–", power(rows["worst_difference"].max())])
    return lines


def spin_lines(spin: pandas.DataFrame) -> list[list[str]]:
    plain = spin[spin["rotation"] == "plain"]
    return [[f"{row['lambda']:g}", f"{row['fraction']:g}", figure(row["rate"], 4),
             figure(row["expected"], 4), figure(math.log(2) / row["rate"], 2)]
            for _, row in plain.iterrows()]


def slow_lines(slow: pandas.DataFrame) -> list[list[str]]:
    """V_f after so many seconds, and at the end."""
    lines = []
    for method, rows in slow.groupby("method", sort=False):
        cells = [title_of(method)]
        last = rows.groupby("seed").tail(1)
        for time in (2.0, 5.0, 10.0, 20.0):
            near = rows[(rows["time_s"] - time).abs() < 0.3]
            cells.append(fixed(near["vf_inner"].mean(), 4) if len(near) else "–")
        rested = last["rested_at_s"]
        cells += [fixed(last["vf_inner"].mean(), 4),
                  figure(rested.mean(), 3) if rested.notna().all() else "no",
                  power(last["torque"].max())]
        lines.append(cells)
    return lines


def values_along(beds: pandas.DataFrame, name: str, x: str) -> list[str]:
    return [f"{v:g}" for v in sorted(beds[beds["map"] == name][x].unique())]


def deepest(beds: pandas.DataFrame) -> list[list[str]]:
    """Of the beds of the impact map: the speed of the fall, overlap expected of two rods end on end
    and found, and what became of it."""
    part = beds[(beds["map"] == "impact") & (beds["method"] == "ours")]
    lines = []
    for _, row in part.sort_values(["stiffness", "speed"], ascending=[False, True]).iterrows():
        speed = math.sqrt(row["speed"] ** 2 + 2 * settling.GRAVITY * row["fall"])
        through = theory.speed_through(row["stiffness"] * settling.STIFFNESS, row["lambda"],
                                       row["restitution"], settling.DIAMETER)
        lines.append([f"{row['stiffness']:g}", figure(speed, 2), figure(speed / through, 2),
                      fixed(row["overlap_ever"], 2), f"{row['passed_pairs']:.0f}", row["state"]])
    return lines


def glued_lines(beds: pandas.DataFrame) -> list[list[str]]:
    part = beds[beds["map"] == "glued"]
    return [[f"{aspect:g}", "true rod" if n == 0 else f"{n:.0f} spheres",
             number(stands_up_to(rows)), number(rows[rows["state"] == "lost"]["fraction"].min()
                                               if (rows["state"] == "lost").any() else 0)]
            for (aspect, n), rows in part.groupby(["lambda", "spheres"])]


def values(tables: dict[str, pandas.DataFrame]) -> dict:
    beds, costs, slow, hits, spin = (tables[name] for name in
                                     ("beds", "costs", "slow", "hits", "spin"))
    steps = beds[beds["map"] == "steps"]
    tall = beds[beds["map"] == "tall"]
    ours = steps[steps["method"] == "ours"]
    by_aspect = [stands_up_to(rows) for _, rows in ours.groupby("lambda")]
    first_bad = ours[~ours["state"].isin(STAND)]["fraction"]
    lost = ours[ours["state"].isin(("lost", "grows", "passes"))]["fraction"]
    beta = damping_ratio(0.5)
    return {
        "beds_number": len(beds), "states": [[s, STATES[s]] for s in reversed(STATES)],
        "aspects": [f"{a:g}" for a in sorted(steps["lambda"].unique())],
        "rods": int(steps["rods"].max()) if len(steps) else 0,
        "step_lines": step_lines(beds), "energy_lines": energy_lines(beds, "steps"),
        "tall_lines": energy_lines(beds, "tall"),
        "tall_aspects": values_along(beds, "tall", "lambda"),
        "tall": {name: [f"{v:g}" for v in tall[name].unique()] for name in ("rods", "fall")},
        "tall_contacts": [tall[tall["state"] == "rests"]["contacts"].min(),
                          tall[tall["state"] == "rests"]["contacts"].max()],
        "tall_overlaps": [100 * tall[tall["state"] == "rests"]["overlap_mean"].min(),
                          100 * tall[tall["state"] == "rests"]["overlap_mean"].max()],
        "tall_ever": [tall[tall["state"] == "rests"]["overlap_ever"].min(),
                      tall[tall["state"] == "rests"]["overlap_ever"].max()],
        "remedy_lines": remedy_lines(beds),
        "alone": alone(beds),
        "remedy_steps": values_along(beds, "remedies", "fraction"),
        "remedy_aspect": values_along(beds, "remedies", "lambda"),
        "cost_lines": cost_lines(costs), "hit_lines": hit_lines(hits),
        "spin_lines": spin_lines(spin), "slow_lines": slow_lines(slow),
        "slow_end": figure(slow["time_s"].max(), 3) if len(slow) else "–",
        "deepest": deepest(beds), "glued_lines": glued_lines(beds),
        "stands": {"least": min(by_aspect, default=math.nan),
                   "bad": first_bad.min() if len(first_bad) else math.nan,
                   "worse": lost.min() if len(lost) else math.nan},
        "stand": {method: largest_step(steps[steps["method"] == method]) for method in METHODS},
        "whole_restitution": math.exp(-2 * math.pi * beta / math.sqrt(1 - 4 * beta ** 2)),
        # ½ k δ² over m g D at δ = D/10, k = 2·10⁴ λ N/m, of λ = 30.
        "free_energy": 0.5 * settling.STIFFNESS * 30 * (0.1 * settling.DIAMETER) ** 2
        / (settling.mass_of(30) * settling.GRAVITY * settling.DIAMETER),
        "lying": 0.5 * math.pi / (0.2 * math.pi), "tumble": theory.fall_time(30),
        "onset": theory.gain_onset(beta), "onset_mean": theory.mean_onset(beta),
        "onset_elastic": theory.gain_onset(0.0), "damping": beta,
        "bounded": theory.stable_limit(beta),
        "onset_whole": theory.gain_onset(2 * beta), "bounded_whole": theory.stable_limit(2 * beta),
        "machine": " and ".join(sorted(beds["machine"].dropna().unique())) if len(beds) else "–",
        "core_minutes": beds["cpu_s"].sum() / 60 if len(beds) else 0.0,
    }
