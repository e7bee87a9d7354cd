# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page says, from the CSV files and config.yaml."""
from __future__ import annotations

import pandas

from studies.common.rows import read_rows
from studies.speed_accuracy import chart


def span(table: pandas.DataFrame, column: str) -> dict:
    return {"least": f"{table[column].min():g}", "most": f"{table[column].max():g}"}


def values(charted, summary, config: dict, mode: str, results: str) -> dict:
    """`charted`: CSV files of rows, the scenes' first; `results`: their folder, as seen from the
    page."""
    rows, scenes, table = chart.read(charted), read_rows(charted[0]), read_rows(summary)
    headings, lines = chart.summary_table(table)
    ours, theirs = table["rods_cost"].notna(), table["multisphere_cost"].notna()
    ratio = table.loc[ours & theirs, "rods_are_cheaper"]
    near = table[ours & theirs & (table["rods_are_cheaper"] <= 2.0)]
    aspects = sorted(scenes["lambda"].unique(), key=lambda a: abs(a - 10.0))
    by_number = chart.by_number(scenes, aspects[0])
    lost = (scenes["ended"].fillna("") != "") | ~(scenes["error"] < 1.0)
    stiff = scenes.assign(over=scenes["stiffness"] / scenes["lambda"] / 2.0e4)
    nominal = stiff[stiff["rule"] == "nominal"]
    return {
        "mode": mode, "results": results,
        "headings": headings, "lines": lines,
        "charts": [{"name": chart.name_of(scene, quantity), "title": chart.title_of(scene, quantity),
                    "quantity": chart.QUANTITIES.get(quantity, quantity)}
                   for scene, quantity in chart.charts_of(rows)],
        "machine": " and ".join(sorted(scenes["machine"].dropna().unique())),
        "seed": " and ".join(map(str, scenes["seed"].unique())),
        "copies": int(scenes["copies"].max()), "turns": int(scenes["turns"].max()),
        "questions": len(table), "both_reach": len(ratio),
        "only_rods": int((ours & ~theirs).sum()),
        "rods_win": int((table["cheapest"] == "rods").sum()),
        "spheres_win": int((table["cheapest"] == "multisphere").sum()),
        "neither": int((table["cheapest"] == "neither").sum()),
        "median_times": f"1/{chart.times(ratio.median())}" if len(ratio) else "–",
        "lost": [{"scene": chart.title_of(row["scene"]), "lambda": row["lambda"],
                  "error": chart.percent(row["error"]), "words": chart.words(row)}
                 for _, row in table[table["cheapest"] == "multisphere"].iterrows()],
        "enough": [f"{chart.title_of(row['scene'])}, λ = {row['lambda']:g}, "
                   f"{chart.percent(row['error'])} %" for _, row in near.iterrows()],
        "by_number": by_number, "by_number_aspect": f"{aspects[0]:g}",
        "cases": len(scenes), "rods_cases": int((scenes["method"] == "rods").sum()),
        "lost_rods": int((lost & (scenes["method"] == "rods")).sum()),
        "lost_spheres": int((lost & (scenes["method"] != "rods")).sum()),
        "rods_stiffness": span(stiff[stiff["method"] == "rods"], "over"),
        "spheres_stiffness": span(nominal, "over"),
        "rods_step": span(scenes[scenes["method"] == "rods"], "time_step_over_limit"),
        "spheres_step": span(scenes[scenes["method"] == "multisphere"], "time_step_over_limit"),
        "most_work": float(config["spheres_work"]), "rods_work": float(config["rods_work"]),
    }
