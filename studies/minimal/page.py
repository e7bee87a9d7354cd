# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page says, from the CSV files."""
from __future__ import annotations

import re

import pandas

from studies.common import settling
from studies.common.pages import figure, with_error
from studies.common.rows import read_rows
from studies.minimal.advice import QUANTITIES
from studies.minimal.features import SCENES


def percent(value: float, decimals: int = 1) -> str:
    return f"{100 * value:+.{decimals}f} %".replace("-", "−")


def feature_lines(table: pandas.DataFrame) -> list[list[str]]:
    lines = []
    for _, row in table.iterrows():
        first = row["change"] == "as it is"
        time = ""
        if "microseconds" in row and row["microseconds"] == row["microseconds"]:
            time = f"{figure(row['microseconds'], 2)}"
        lines.append([f"**{SCENES[row['scene']]['title']}**" if first else row["change"],
                      figure(row["instructions"], 4),
                      "" if first else percent(row["instructions_times"] - 1, 2),
                      time, figure(row["megabytes"], 3),
                      *([figure(row["contacts"], 2)] if "contacts" in table else [])])
    return lines


def bed_lines(runs: pandas.DataFrame) -> list[list[str]]:
    lines = []
    for (limits, aspect, quick), part in runs.groupby(["limits", "lambda", runs["way"] == "quick"]):
        cells = [limits, f"{aspect:g}", "quick 1" if quick else "default", str(len(part))]
        for name, decimals in (("vf_inner", 4), ("vf_whole", 4), ("elevation_deg", 1),
                               ("contacts", 2)):
            error = part[name].std(ddof=1) / len(part) ** 0.5 if len(part) > 1 else float("nan")
            cells.append(with_error((part[name].mean(), error), decimals))
        lines.append(cells + [f"{part['rested'].sum():.0f} of {len(part)}",
                              figure(part["end_time_s"].median(), 2),
                              figure(part["cpu_s"].median(), 2)])
    return lines


def rested_words(runs: pandas.DataFrame, way: str) -> str:
    """12, 12 and 5 of 12, by λ."""
    found = runs[runs["way"] == way].groupby("lambda")["rested"]
    counts = [str(int(n)) for n in found.sum()]
    return f"{', '.join(counts[:-1])} and {counts[-1]}" if len(counts) > 1 else counts[0]


def saved(runs: pandas.DataFrame) -> str:
    """Seconds of the default ended at rest, and of quick 1, by λ."""
    medians = runs.groupby(["lambda", "way"])["cpu_s"].median().unstack()
    return ", ".join(f"{figure(m['today'], 2)} to {figure(m['quick'], 2)} s (λ = {a:g})"
                     for a, m in medians.iterrows())


def timed_beds(seconds: pandas.DataFrame, runs: pandas.DataFrame) -> list[dict]:
    """Of each λ's bed that was timed: when it ended by the default, and where that is among the default's
    beds of all seeds."""
    result = []
    for _, row in seconds[seconds["way"] == "full"].iterrows():
        others = runs[(runs["way"] == "today") & (runs["lambda"] == row["lambda"])
                      & (runs["limits"] == row["limits"])]["end_time_s"]
        if len(others):
            result.append({"aspect": f"{row['lambda']:g}", "end": figure(row["end_time_s"], 3),
                           "median": figure(others.median(), 3),
                           "later": int((others > row["end_time_s"]).sum()), "beds": len(others)})
    return result


def shifted(table: pandas.DataFrame) -> list[str]:
    """Differences whose paired interval has no 0."""
    found = table[(table["paired_low"] > 0) | (table["paired_high"] < 0)]
    return [f"{QUANTITIES[row['quantity']]}, "
            f"{'λ = ' + format(row['lambda'], 'g') if row['lambda'] else 'all λ together'}: "
            f"{percent(row['difference'])} ({percent(row['paired_low'])} to {percent(row['paired_high'])})"
            for _, row in found.iterrows()]


def equivalence_lines(table: pandas.DataFrame) -> list[list[str]]:
    return [[row["limits"], f"{row['lambda']:g}" if row["lambda"] else "together", QUANTITIES[row["quantity"]],
             f"{row['beds_today']:.0f}, {row['beds_quick']:.0f}", percent(row["difference"]),
             f"{percent(row['low'])} to {percent(row['high'])}",
             f"{percent(row['paired_low'])} to {percent(row['paired_high'])}",
             "yes" if row["equivalent"] else "not shown"] for _, row in table.iterrows()]


def second_lines(table: pandas.DataFrame) -> list[list[str]]:
    lines = []
    for (aspect, limits), part in table.groupby(["lambda", "limits"]):
        part = part.set_index("way")
        ends = [figure(part.loc[way, "end_time_s"], 2)
                + ("" if part.loc[way, "rested"] else ", not at rest") for way in ("full", "quick")]
        lines.append([f"{aspect:g}", limits, figure(part.loc["full", "seconds"], 3),
                      figure(part.loc["quick", "seconds"], 3), *ends,
                      figure(part.loc["quick", "times_fewer"], 2)])
    return lines


def contact_lines(table: pandas.DataFrame) -> str:
    """Of each scene as it is."""
    if "contacts" not in table:
        return ""
    first = table[table["change"] == "as it is"]
    return ", ".join(f"{SCENES[row['scene']]['title']} {figure(row['contacts'], 2)}"
                     for _, row in first.iterrows())


def off_costs(table: pandas.DataFrame) -> dict:
    """What is switched off by name, and stock spheres in a program with the plug-in."""
    by = table.set_index(["scene", "change"])
    named = [abs(by.loc[(s, "all off by name"), "instructions_times"] - 1)
             for s in SCENES if (s, "all off by name") in by.index]
    more = [abs(by.loc[(s, "all off by name"), "megabytes_more"])
            for s in SCENES if (s, "all off by name") in by.index]
    result = {"instructions": max(named), "megabytes": max(more)}
    stock = ("spheres", "stock spheres in liggghts"), ("spheres", "stock spheres in lmp")
    if all(key in by.index for key in stock):
        a, b = by.loc[stock[0]], by.loc[stock[1]]
        result |= {"plugin": b["instructions"] / a["instructions"] - 1,
                   "plugin_megabytes": b["megabytes"] - a["megabytes"],
                   "as_rods": by.loc[("spheres", "as it is"), "instructions"] / a["instructions"]}
    return result


def deck_settings() -> dict:
    """What in.rods says of the default and of quick 1."""
    text = settling.DECKS[0].read_text()
    of_quick = text[text.index('"${quick} == 1"'):]
    default, quick = ({name: float(re.search(rf"^ *\"?variable {name}\s+index ([\d.e+-]+){ending}",
                                             part, re.MULTILINE).group(1))
                       for name in ("dt", "total_time")}
                      for part, ending in ((text, r"\s*$"), (of_quick, '"')))
    return {"step_times": quick["dt"] / default["dt"], "default_time": default["total_time"],
            "quick_time": quick["total_time"],
            "step_fraction": quick["dt"] / settling.time_step_limit(20.0)}


def values(runs, equivalence, seconds, features, bound: float) -> dict:
    runs, equivalence, seconds, features = map(
        read_rows, (runs, equivalence, seconds, features))
    beds = runs[runs["way"] == "quick"]
    shown = equivalence[equivalence["equivalent"] == 1]
    return {
        "features": feature_lines(features), "off": off_costs(features),
        "beds": bed_lines(runs), "equivalence": equivalence_lines(equivalence),
        "seconds": second_lines(seconds), "bound": 100 * bound,
        "shown": len(shown), "asked": len(equivalence), "shifted": shifted(equivalence),
        "timed_beds": timed_beds(seconds, runs), "saved": saved(runs),
        "rested": {way: rested_words(runs, way) for way in ("today", "quick")},
        "aspects": ", ".join(f"{a:g}" for a in sorted(runs["lambda"].unique())),
        "beds_each": int(runs.groupby(["lambda", "limits", "way"]).size().max()),
        "contacts": contact_lines(features),
        "machine": " and ".join(sorted({machine for table in (runs, seconds, features)
                                        for machine in table.get("machine", []) if machine == machine})),
        "turns": int(seconds["turns"].iloc[0]) if len(seconds) else 0,
        **deck_settings(),
        "not_rested": int((beds["rested"] == 0).sum()), "quick_beds": len(beds),
        "today_beds": len(runs) - len(beds),
        "overlap_ever": 100 * runs.groupby(runs["way"] == "quick")["overlap_ever"].max(),
        "particles": int(features["particles"].iloc[0]), "steps": int(features["steps"].iloc[0]),
    }
