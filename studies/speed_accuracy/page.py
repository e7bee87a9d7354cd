# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page says, from the CSV files."""
from __future__ import annotations

import pandas

from studies.common.rows import read_rows
from studies.speed_accuracy import chart


def values(charted, summary) -> dict:
    rows = chart.read(charted)
    table = read_rows(summary)
    headings, lines = chart.summary_table(table)
    reached = table[table["rods_cost"].notna()]
    both = reached[reached["multisphere_cost"].notna()]
    return {
        "headings": headings, "lines": lines,
        "charts": [{"name": chart.name_of(scene, quantity), "title": chart.title_of(scene),
                    "quantity": chart.QUANTITIES.get(quantity, quantity)}
                   for scene, quantity in chart.charts_of(rows)],
        "machine": " and ".join(sorted(rows["machine"].dropna().unique())),
        "seed": rows["seed"].iloc[0], "version": rows["version"].iloc[0],
        "questions": len(table),
        "only_rods": int((reached["multisphere_cost"].isna()).sum()),
        "rods_win": int((both["rods_are_cheaper"] >= 1.0).sum()),
        "spheres_win": int((both["rods_are_cheaper"] < 1.0).sum()
                           + (table["rods_cost"].isna() & table["multisphere_cost"].notna()).sum()),
        "neither": int((table["cheapest"] == "neither").sum()),
        "median_times": float(both["rods_are_cheaper"].median()),
        "lost": [{"scene": chart.title_of(row["scene"]), "lambda": row["lambda"],
                  "error": chart.percent(row["error"]), "words": chart.words(row)}
                 for _, row in table[table["cheapest"] == "multisphere"].iterrows()],
        "cases": len(rows), "ended": int(rows["ended"].fillna("").ne("").sum())
        if "ended" in rows else 0,
    }
