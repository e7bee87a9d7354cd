# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page tells, from the tables."""
from __future__ import annotations

import math

import numpy
import pandas

from examples.fibres import beds
from studies.common.pages import fixed, with_error
from studies.common.statistics import mean_and_error, student


def difference(part: pandas.DataFrame, quantity: str) -> tuple[float, float]:
    """Of the stiffest fibres' mean from the rods', over it, and half its 95 % interval (Welch)."""
    fibres = part[numpy.isfinite(part["bending"])]
    a = part[~numpy.isfinite(part["bending"])][quantity]
    b = fibres[fibres["bending"] == fibres["bending"].max()][quantity]
    if min(len(a), len(b)) < 2:
        return math.nan, math.nan
    errors = [a.var(ddof=1) / len(a), b.var(ddof=1) / len(b)]
    freedom = sum(errors) ** 2 / sum(e ** 2 / (len(x) - 1) for e, x in zip(errors, (a, b)))
    wide = student(0.975, freedom) * math.sqrt(sum(errors))
    return b.mean() / a.mean() - 1, wide / a.mean()


def bed_rows(found: pandas.DataFrame) -> list[list[str]]:
    rows = []
    for (aspect, segments, bending), part in found.groupby(["lambda", "segments", "bending"]):
        rest = part[part["rested"] == 1]
        rods = math.isinf(bending)
        rows.append([f"{aspect:g}", "rods" if rods else f"{bending:g}", "–" if rods else f"{segments:g}",
                     f"{len(rest)} of {len(part)}",
                     *(with_error(mean_and_error(rest[name]), places) for name, places in (
                         ("vf_inner", 4), ("vf_whole", 4), ("elevation_deg", 1), ("elevation_ends_deg", 1),
                         ("contacts", 2))),
                     "–" if rods else fixed(rest["stretch"].mean(), 3),
                     "–" if rods else fixed(rest["curvature"].mean(), 2)])
    return sorted(rows, key=lambda row: (float(row[0]), row[2], -(math.inf if row[1] == "rods" else float(row[1]))))


def limit_rows(found: pandas.DataFrame) -> list[list[str]]:
    rows = []
    for aspect, part in found[found["rested"] == 1].groupby("lambda"):
        row = [f"{aspect:g}", f"{part[numpy.isfinite(part['bending'])]['bending'].max():g}"]
        for name in beds.QUANTITIES:
            mean, wide = difference(part, name)
            row.append("–" if math.isnan(mean) else f"{100 * mean:+.1f} ± {100 * wide:.1f} %".replace("-", "−"))
        rows.append(row)
    return rows


def stiffest(found: pandas.DataFrame) -> list[dict]:
    """Of each λ: what its stiffest fibres are off the straight line, (curvature) L²/8 over D, and what rods overlap."""
    result = []
    for aspect, part in found[found["rested"] == 1].groupby("lambda"):
        rods = ~numpy.isfinite(part["bending"])
        bending = part[~rods]["bending"].max()
        result.append({"aspect": f"{aspect:g}", "bending": f"{bending:g}", "overlap": part[rods]["overlap_mean"].mean(),
                       "sag": part[part["bending"] == bending]["curvature"].mean() * aspect / 8})
    return result


def cycle_rows(cycles: pandas.DataFrame) -> list[list[str]]:
    rows = []
    for (value, cycle), part in cycles.groupby(["yield_curvature", "cycle"]):
        rows.append(["never" if value == 0 else f"{value:g}/L", f"{cycle:g}",
                     *(with_error(mean_and_error(part[name] * times), places) for name, times, places in (
                         ("force_max_N", 1, 1), ("height_touched_m", 1000, 1),
                         ("work_J", 1, 3), ("lost_J", 1, 3), ("lost_part", 100, 0), ("yielded_J", 1, 3)))])
    return rows


def first_and_last(cycles: pandas.DataFrame) -> list[dict]:
    """Of each kind of joint: what the first and the last cycle lose and bear, in the mean over beds."""
    result = []
    for value, part in cycles.groupby("yield_curvature"):
        mean = part.groupby("cycle")[["lost_J", "force_max_N", "lost_part", "yielded_J", "work_J"]].mean()
        first, last = mean.iloc[0], mean.iloc[-1]
        result.append({
            "value": value, "cycles": len(mean), "lost_first": first["lost_J"], "lost_last": last["lost_J"],
            "lost_times": first["lost_J"] / last["lost_J"], "force_times": last["force_max_N"] / first["force_max_N"],
            "part_first": 100 * first["lost_part"], "part_last": 100 * last["lost_part"],
            "yielded": 100 * mean["yielded_J"].sum() / mean["lost_J"].sum(),
            "yielded_first": 100 * first["yielded_J"] / mean["yielded_J"].sum() if value else math.nan})
    return result


def slower_than(cycles: pandas.DataFrame, slower: pandas.DataFrame) -> list[str]:
    """What is lost in each cycle with a slower plate from what is lost by the same bed otherwise, over the latter (%)."""
    same = cycles[(cycles["seed"] == slower["seed"].iloc[0]) & (cycles["yield_curvature"] == 0)].set_index("cycle")["lost_J"]
    part = slower.set_index("cycle")["lost_J"] / same - 1
    return [fixed(100 * value, 0) for value in part.dropna()]


def values(found: pandas.DataFrame, cycles: pandas.DataFrame, slower: pandas.DataFrame, mode: str, told: dict, press: dict) -> dict:
    rest = found[found["rested"] == 1]
    times = {}
    for aspect, part in rest.groupby("lambda"):
        mean = part[part["segments"] == part["segments"].where(part["segments"] > 1).mode().iloc[0]] \
            .groupby("bending")[list(beds.QUANTITIES)].mean()
        rods = part[~numpy.isfinite(part["bending"])][list(beds.QUANTITIES)].mean()
        times[f"{aspect:g}"] = {"softest": f"{mean.index[0]:g}", **(mean.iloc[0] / rods).to_dict()}
    alt = "V_f, contacts and elevation against the stiffness of the fibres, rods as bands; force of a plate against its " \
        "height, and work lost in each cycle"
    return {"mode": mode, "alt": alt, "beds": bed_rows(found), "limit": limit_rows(found), "stiffest": stiffest(found), "cycles": cycle_rows(cycles),
            "kinds": first_and_last(cycles), "slower": slower_than(cycles, slower), "told": told, "press": press, "times": times,
            "friction": found["friction"].iloc[0], "unrested": int((found["rested"] == 0).sum()), "number": len(found),
            "seeds": found["seed"].nunique(), "pressed": cycles["seed"].nunique(), "vessels": found.groupby("lambda")[["fibres", "lengths_wide"]].first(),
            "first_lambda": f"{found['lambda'].min():g}", "overlap": found["overlap_ever"].max(), "machine": found["machine"].iloc[0]}
