# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page says, from the CSV files and config.yaml."""
from __future__ import annotations

import functools

import numpy as np
import pandas

from studies.common.rows import read_rows
from studies.speed_accuracy import chart, rods, scenes, sweep


def span(table: pandas.DataFrame, column: str) -> dict:
    return {"least": f"{table[column].min():g}", "most": f"{table[column].max():g}"}


@functools.lru_cache
def wall(aspect: float, copies: int, seed: int) -> scenes.Scene:
    """Kept, since it takes a second."""
    return scenes.build("wall", aspect, copies, seed)


def restitution_missed(aspect: float, copies: int, seed: int, rule: str) -> float:
    """The error of the impulse at a wall by one damping for contacts of all effective masses m_eff:
    each parts with e' = exp(−π ζ'/√(1 − ζ'²)), ζ' = ζ √(m/m_eff), instead of e."""
    scene = wall(aspect, copies, seed)
    arm = 0.5 * scene.rod.height * scene.start.axis
    mass = 1.0 / rods.inverse_mass(scene.rod, arm, scenes.UP)
    given = scene.nominal_mass if rule == "nominal" else scene.mean_mass
    zeta = rods.damping_ratio(scene.restitution) * np.sqrt(given / mass)
    parted = np.exp(-np.pi * zeta / np.sqrt(1.0 - zeta**2))
    size = scene.start.velocity[:, 2] * np.sqrt(mass)  # of the impulse, in the measure of energy
    return float(np.sqrt(np.mean(((parted - scene.restitution) * size) ** 2)
                         / np.mean(((1.0 + scene.restitution) * size) ** 2)))


def wall_errors(table: pandas.DataFrame) -> list[list[str]]:
    """A line an aspect ratio and rule: what glued rods miss at a wall and what the restitution makes
    of it, of as many copies as each case had, in the mean over the cases."""
    part = chart.standing(table[(table["scene"] == "wall") & (table["method"] == "multisphere")])
    lines = []
    for (aspect, rule), cases in part.groupby(["lambda", "rule"]):
        expected = {copies: restitution_missed(aspect, int(copies), int(cases["seed"].iloc[0]), rule)
                    for copies in cases["copies"].unique()}
        lines.append([f"{aspect:g}", rule, chart.percent(cases["error"].min()),
                      chart.percent(cases["error"].median()),
                      chart.percent(cases["copies"].map(expected).mean())])
    return lines


def copies_of(events: pandas.DataFrame) -> dict:
    """How many copies the cases have, of rods and of glued rods, and the rods of a gas."""
    gas = events["scene"] == "gas"
    rods = events[~gas & (events["method"] == "rods")]
    glued = events[~gas & (events["method"] != "rods")]
    return {"rods": span(rods, "copies"), "glued": span(glued, "copies"),
            "gas": span(events[gas], "copies") if gas.any() else None}


def timed_once(events: pandas.DataFrame) -> dict:
    """Of the points on the fronts, from which the answers are taken, how many have one turn alone."""
    front = sweep.front(chart.standing(events))
    return {"all": len(front), "once": int((front["turns"] < 2).sum())}


def values(charted, summary, config: dict, mode: str, results: str) -> dict:
    """`charted`: CSV files of rows, the scenes' first; `results`: their folder, as seen from the
    page."""
    rows, events, table = chart.read(charted), read_rows(charted[0]), read_rows(summary)
    headings, lines = chart.summary_table(table)
    ours, theirs = table["rods_cost"].notna(), table["multisphere_cost"].notna()
    beds, alone = table["scene"].map(chart.is_bed), ours & (table["multisphere_state"] == "not reached")
    floor = table["multisphere_at_floor"] == 1
    ratio = table.loc[ours & theirs, "rods_are_cheaper"]
    near = table[ours & theirs & (table["rods_are_cheaper"] <= 2.0)]
    aspects = sorted(events["lambda"].unique(), key=lambda a: abs(a - 10.0))
    by_number = chart.by_number(events, aspects[0])
    lost = (events["ended"].fillna("") != "") | ~(events["error"] < 1.0)
    stiff = events.assign(over=events["stiffness"] / events["lambda"] / 2.0e4)
    nominal = stiff[stiff["rule"] == "nominal"]
    return {
        "mode": mode, "results": results, "beds": bool(rows["scene"].map(chart.is_bed).any()),
        "headings": headings, "lines": lines,
        "charts": [{"name": chart.name_of(scene, quantity), "title": chart.title_of(scene, quantity),
                    "quantity": chart.QUANTITIES.get(quantity, quantity)}
                   for scene, quantity in chart.charts_of(rows)],
        "machine": " and ".join(sorted(events["machine"].dropna().unique())),
        "seed": " and ".join(map(str, events["seed"].unique())),
        "copies": copies_of(events), "timed": timed_once(events), "turns": int(events["turns"].max()),
        "questions": len(table), "both_reach": len(ratio),
        "only_rods": int(alone.sum()), "only_rods_floor": int((alone & floor).sum()),
        "only_rods_so_far": int((alone & ~floor & ~beds).sum()),
        "only_rods_beds": int((alone & beds).sum()),
        "spheres_open": int((ours & (table["multisphere_state"] == "not resolved")).sum()),
        "not_resolved": int((table["cheapest"] == "not resolved").sum()),
        "fewest_cases": chart.FEWEST_CASES, "fewest_beds": chart.FEWEST_BEDS,
        "floor_cost": f"1/{1 / chart.FLOOR_COST:g}", "floor_error": 100 * (chart.FLOOR_ERROR - 1),
        "rods_win": int((table["cheapest"] == "rods").sum()),
        "spheres_win": int((table["cheapest"] == "multisphere").sum()),
        "neither": int((table["cheapest"] == "neither").sum()),
        "median_times": f"1/{chart.times(ratio.median())}" if len(ratio) else "–",
        "lost": [{"scene": chart.title_of(row["scene"], row["quantity"]),
                  "lambda": f"{row['lambda']:g}",
                  "error": chart.percent(row["error"]), "words": chart.words(row)}
                 for _, row in table[table["cheapest"] == "multisphere"].iterrows()],
        "enough": [f"{chart.title_of(row['scene'], row['quantity'])}, λ = {row['lambda']:g}, "
                   f"{chart.percent(row['error'])} %" for _, row in near.iterrows()],
        "wall_errors": wall_errors(events), "by_number": by_number, "by_number_aspect": f"{aspects[0]:g}",
        "cases": len(events), "rods_cases": int((events["method"] == "rods").sum()),
        "lost_rods": int((lost & (events["method"] == "rods")).sum()),
        "lost_spheres": int((lost & (events["method"] != "rods")).sum()),
        "rods_stiffness": span(stiff[stiff["method"] == "rods"], "over"),
        "spheres_stiffness": span(nominal, "over"),
        "rods_step": span(events[events["method"] == "rods"], "time_step_over_limit"),
        "spheres_step": span(events[events["method"] == "multisphere"], "time_step_over_limit"),
        "most_work": float(config["spheres_work"]), "rods_work": float(config["rods_work"]),
        "softest_work": sweep.SOFTEST_WORK, "free_work": sweep.FREE_WORK,
    }
