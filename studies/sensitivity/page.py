# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page says, from the CSV files."""
from __future__ import annotations

import pandas

from studies.common import settling
from studies.common.pages import fixed, with_error
from studies.common.statistics import limit_of_line, mean_and_error
from studies.packing.measures import HALF_CONTACTS, STUDY_FRICTION
from studies.packing.page import words
from studies.sensitivity import variations
from studies.sensitivity.figures import NUMBERS, level_name

LINE = "vessel"    # the factor whose V_f is followed to a vessel without end


def percent(value: float) -> str:
    return f"{100 * value:+.1f} %".replace("-", "−")


def interval(one) -> str:
    return f"{percent(one['low'])} to {percent(one['high'])}"


def together(effects: pandas.DataFrame) -> pandas.DataFrame:
    """A row a level, all λ together: columns QUANTITY.difference and so on."""
    part = effects[effects["lambda"] == 0]
    wide = part.set_index(["factor", "level", "quantity"])[["difference", "low", "high", "differs",
                                                            "alike", "beds"]].unstack("quantity")
    wide.columns = [f"{quantity}.{name}" for name, quantity in wide.columns]
    return wide


def without_references(wide: pandas.DataFrame, beds: pandas.DataFrame) -> pandas.DataFrame:
    """Without levels that are there for others of their factor to be compared with: they are cases of
    another factor."""
    against = beds[["factor", "against"]].dropna().drop_duplicates()
    references = {(factor, f"{level:g}" if isinstance(level, float) else str(level))
                  for factor, level in against.itertuples(index=False)}
    return wide[[(factor, str(level)) not in references for factor, level in wide.index]]


def effect_lines(wide: pandas.DataFrame) -> list[list[str]]:
    lines = []
    for (factor, level), row in wide.iterrows():
        marked = [percent(row[f"{name}.difference"]) if row[f"{name}.differs"] == 1 else
                  f"({percent(row[f'{name}.difference'])})"
                  for name in ("vf_whole", "elevation_deg", "contacts")]
        lines.append([level_name(factor, level), f"{row['vf_inner.beds']:.0f}",
                      percent(row["vf_inner.difference"]),
                      f"{percent(row['vf_inner.low'])} to {percent(row['vf_inner.high'])}", *marked])
    return lines


def by_aspect(effects: pandas.DataFrame) -> list[list[str]]:
    """V_f of the inner cylinder of each λ."""
    part = effects[(effects["quantity"] == "vf_inner") & (effects["lambda"] > 0)]
    aspects = sorted(part["lambda"].unique())
    lines = []
    for (factor, level), rows in part.groupby(["factor", "level"], sort=False):
        of = {row["lambda"]: row for row in rows.to_dict("records")}
        lines.append([level_name(factor, level), *(
            f"{percent(of[a]['difference'])} ({interval(of[a])})" if a in of else "–"
            for a in aspects)])
    return lines


def base_lines(beds: pandas.DataFrame) -> list[list[str]]:
    lines = []
    for aspect, part in beds[beds["factor"] == variations.BASE].groupby("lambda"):
        lines.append([f"{aspect:g}", str(len(part)), *(
            with_error(mean_and_error(part[name]), decimals) for name, decimals in (
                ("vf_inner", 4), ("vf_whole", 4), ("elevation_deg", 1), ("contacts", 2))),
            fixed(part["vf_parkhouse_kelly"].mean(), 4)])
    return lines


def law(beds: pandas.DataFrame) -> list[dict]:
    """V_f of the inner cylinder over that of random contacts, of all beds of a λ."""
    ratio = beds["vf_inner"] / variations.expected(beds)
    return [{"aspect": aspect, "beds": len(part), "mean": part.mean(), "scatter": part.std(ddof=1),
             "scatter_before": (beds["vf_inner"][part.index].std(ddof=1) /
                                beds["vf_inner"][part.index].mean())}
            for aspect, part in ratio.groupby(beds["lambda"])]


def bulk(beds: pandas.DataFrame) -> list[list[str]]:
    """V_f of the inner cylinder on a line in rod lengths over the vessel's diameter, followed to 0,
    beside that of the widest vessel and of its bulk."""
    lines = []
    part = beds[beds["factor"].isin((variations.BASE, LINE))]
    for aspect, of_aspect in part.groupby("lambda"):
        x, y, errors = [], [], []
        for wide, group in of_aspect.groupby("lengths_wide"):
            mean, error = mean_and_error(group["vf_inner"])
            if error > 0:
                x, y, errors = [*x, 1 / wide], [*y, mean], [*errors, error]
        if len(x) < 2:
            continue
        limit, error, chi = limit_of_line(x, y, errors)
        widest = of_aspect[of_aspect["lengths_wide"] == of_aspect["lengths_wide"].max()]
        lines.append([f"{aspect:g}", f"{len(x)}", with_error((limit, error)), fixed(chi, 1),
                      fixed(widest["lengths_wide"].iloc[0], 1),
                      with_error(mean_and_error(widest["vf_inner"])),
                      with_error(mean_and_error(widest["vf_bulk"].dropna()))])
    return lines


def missing(beds: pandas.DataFrame, cases) -> list[str]:
    """Factors of which no bed is there, and levels that others lack at all aspect ratios or at some."""
    aspects = sorted(beds["lambda"].unique())
    made = {(factor, level): sorted(kind["lambda"].unique()) for (factor, level), kind
            in beds.groupby(["factor", beds["level"].astype(str)])}
    there, told = {factor for factor, _ in made}, []
    for factor, level in cases:
        name = factor.replace("_", " ")
        found = made.get((factor, level), [])
        lacks = [f"{a:g}" for a in aspects if a not in found]
        if factor not in there:
            told += [name] * (name not in told)
        elif lacks:
            told.append(f"{name} {level.replace('_', ' ')}" +
                        (f" at λ = {words(lacks)}" if found else ""))
    return told


def values(beds: pandas.DataFrame, effects: pandas.DataFrame, bound: float, mode: str,
           cases: list[tuple[str, str]]) -> dict:
    wide = without_references(together(effects), beds)
    differs = wide["vf_inner.differs"] == 1
    ordered = wide.reindex(wide["vf_inner.difference"].abs().sort_values(ascending=False).index)
    alike = [level_name(*key) for key, row in wide.iterrows() if row["vf_inner.alike"]]
    up, down = (ordered[(ordered["vf_inner.differs"] == 1) &
                        (sign * ordered["vf_inner.difference"] > 0)] for sign in (1, -1))
    base = beds[beds["factor"] == variations.BASE]
    return {
        "mode": mode, "bound": 100 * bound, "beds": beds["command"].nunique(),
        "aspects": words(f"{a:g}" for a in sorted(beds["lambda"].unique())),
        "each": f"{base.groupby('lambda').size().min():.0f}",
        "friction": STUDY_FRICTION, "asked": len(wide), "differ": int(differs.sum()),
        "by_chance": 0.05 * len(wide),
        "numbers": any(factor in set(beds["factor"]) for factor, *_ in NUMBERS),
        "not_there": words(missing(beds, cases)),
        "up": effect_lines(up), "down": effect_lines(down),
        "open": effect_lines(ordered[(ordered["vf_inner.differs"] == 0)]),
        "alike": words(alike), "by_aspect": by_aspect(effects),
        "aspect_list": [f"{a:g}" for a in sorted(set(effects["lambda"]) - {0.0})],
        "base_lines": base_lines(beds), "law": law(beds), "bulk": bulk(beds),
        "literature_contacts": 2 * HALF_CONTACTS,
        "not_rested": int((beds["rested"] == 0).sum()),
        "limited_not_rested": words(
            f"{level_name(*key)} {int((part == 0).sum())} of {len(part)}"
            for key, part in beds.groupby(["factor", "level"], sort=False)["rested"]
            if (part == 0).any()),
        "overlap_ever": 100 * base["overlap_ever"].max(), "rest_energy": settling.REST_ENERGY,
        "cpu_s": beds["cpu_s"].median(),
        "versions": words(sorted(beds["version"].astype(str).unique())),
        "machines": words(sorted(beds["machine"].unique()))}
