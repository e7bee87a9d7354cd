# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page and the figures are made of: means over the cases of each experiment's table."""
from __future__ import annotations

from math import isfinite, nan, sqrt
from pathlib import Path

import numpy
import pandas

from studies.common import pages, rows, statistics
from studies.experiments import measures

FEW_CONTACTS, MANY_CONTACTS = 4, 10   # a rod in the bulk, by counting: with friction, without
NEAR_CORE, LAST_ORDER = 0.95, 0.1     # where a wall's layer ends
BREAKS = (1.0, 1.5, 2.0)              # of the law of the run-out, height over radius
FLOWING = 0.01                        # 1/s: layers that shear less rest
BINS = numpy.arange(0, 2.01, 0.2)     # of the heights for a figure


def means(table: pandas.DataFrame, keys: list[str], names: list[str]) -> pandas.DataFrame:
    """A row for each case of `keys`: `cases`, their number, each name's mean and NAME_error."""
    result = []
    for _, group in table.groupby(keys if len(keys) > 1 else keys[0], sort=True):
        row = group.iloc[0][keys].to_dict() | {"cases": len(group)}
        for name in names:
            row[name], row[f"{name}_error"] = statistics.mean_and_error(group[name].dropna())
        result.append(row)
    return pandas.DataFrame(result)


# --- Contacts. -----------------------------------------------------------------------------------

def gaps_of(table: pandas.DataFrame) -> list[float]:
    return sorted(float(name[len("nearer_"):]) for name in table if name.startswith("nearer_"))


def gap_for(row, gaps, wanted: float) -> float:
    """Gap, in diameters, below which `wanted` others lie a rod: straight between the logarithms;
    NaN outside."""
    counts = [row[f"nearer_{gap:g}"] for gap in gaps]
    if not counts or not counts[0] <= wanted <= counts[-1]:
        return nan
    return float(numpy.exp(numpy.interp(wanted, counts, numpy.log(gaps))))


def contacts(table: pandas.DataFrame, wanted: float = nan) -> pandas.DataFrame:
    """Means over beds; `gap` is that for `wanted` contacts a rod."""
    table = table.copy()
    gaps = gaps_of(table)
    table["implied"] = 2 * table["implied_half_contacts"]
    table["gap"] = [gap_for(row, gaps, wanted) for row in table.to_dict("records")]
    for name in ("contacts_inside", "of_bearing", "sliding", "forces", "equations", "places"):
        if name not in table:
            table[name] = nan
    return means(table, ["method", "limits", "friction", "lambda"],
                 ["contacts", "contacts_inside", "implied", "of_bearing", "sliding", "forces",
                  "equations", "vf_inner", "gap", "places", *[f"nearer_{gap:g}" for gap in gaps]])


def contacts_rows(table: pandas.DataFrame, wanted: float) -> list[list[str]]:
    def pair(row, name, digits):
        return pages.with_error((row[name], row[f"{name}_error"]), digits)

    def counted(row):
        # Two rods glued of spheres touch at several of them.
        spheres = f" ({row['places']:.2f} of spheres)" if isfinite(row["places"]) else ""
        return pair(row, "contacts", 2) + spheres
    return [[row["method"], row["limits"], f"{row['friction']:g}", f"{row['lambda']:g}",
             row["cases"], pair(row, "vf_inner", 3), counted(row),
             pair(row, "contacts_inside", 2), pair(row, "implied", 2), pages.fixed(row["gap"], 3),
             pair(row, "of_bearing", 2), pages.fixed(row["forces"], 2),
             pages.fixed(row["equations"], 2), pages.fixed(100 * row["sliding"], 0)]
            for row in contacts(table, wanted).to_dict("records")]


# --- Wall. ---------------------------------------------------------------------------------------

def wall_profile(table: pandas.DataFrame, aspect: float, kind: str) -> pandas.DataFrame:
    chosen = table[(table["lambda"] == aspect) & (table["kind"] == kind)].copy()
    chosen["distance"] = chosen["distance"].round(6)
    return means(chosen, ["lambda", "distance"], ["value"])


def layers(table: pandas.DataFrame) -> list[dict]:
    """Of each aspect ratio: where V_f first reaches NEAR_CORE of the core's, which begins a length
    off the wall, and where the order is down to LAST_ORDER."""
    found = []
    for (aspect, seed), bed in table.sort_values("distance").groupby(["lambda", "seed"]):
        kinds = {kind: rows_of for kind, rows_of in bed.groupby("kind")}
        fractions, order = kinds["vf"], kinds["radial_order"]
        core = fractions.loc[fractions["distance"] >= 1, "value"].mean()
        found.append({"lambda": aspect, "core": core, "layer": measures.first_reached(
            fractions["distance"], fractions["value"], NEAR_CORE * core),
            "order_layer": measures.first_reached(order["distance"], order["value"], -LAST_ORDER)})
    return means(pandas.DataFrame(found), ["lambda"],
                 ["layer", "core", "order_layer"]).to_dict("records")


def layer_rows(table: pandas.DataFrame) -> list[list[str]]:
    return [[f"{row['lambda']:g}", row["cases"], *(
        pages.with_error((row[name], row[f"{name}_error"]), digits)
        for name, digits in (("core", 3), ("layer", 2), ("order_layer", 2)))]
        for row in layers(table)]


# --- Columns. ------------------------------------------------------------------------------------

def critical(table: pandas.DataFrame) -> list[dict]:
    """Critical heights of each kind of column, of the radius that most of them have."""
    usual = table[table["radius"] == table["radius"].mode().iloc[0]]
    return [{"lambda": aspect, "friction": friction, "limits": limits, "columns": len(kind),
             "collapsed": int(kind["collapsed"].sum()), "tallest": kind["height"].max(),
             **{f"at_{part:g}": int((kind["lost"] > part).sum()) for part in (0.2, 0.5)},
             **measures.critical_heights(kind["height"], kind["collapsed"])}
            for (limits, aspect, friction), kind in usual.groupby(["limits", "lambda", "friction"])]


def critical_rows(table: pandas.DataFrame) -> list[list[str]]:
    def height(row, name):
        if name not in row:   # all of them did the same
            return "–"
        return f"{row[name]:.2f} ({row[name + '_low']:.2f} to {row[name + '_high']:.2f})"
    return [[f"{row['lambda']:g}", f"{row['friction']:g}", row["limits"], row["columns"],
             row["collapsed"], f"{row['at_0.2']}, {row['at_0.5']}", pages.fixed(row["tallest"], 2),
             height(row, "solid_below"), height(row, "falls_above")] for row in critical(table)]


def run_out(table: pandas.DataFrame) -> pandas.DataFrame:
    """Columns without limits that have collapsed, with `ratio`, height over radius."""
    fallen = table[(table["limits"] == "none") & (table["collapsed"] == 1)
                   & (table["run_out"] > 0)].copy()
    fallen["ratio"] = fallen["height"] / fallen["radius"]
    return fallen


def exponents(table: pandas.DataFrame) -> list[dict]:
    """Of the run-out below and above each break, of the largest friction and the aspect ratio with
    tall columns; `alone`: largest part of single rods that rolled away."""
    fallen = run_out(table)
    if fallen.empty:
        return []
    fallen = fallen[fallen["friction"] == fallen["friction"].max()]
    found = []
    for at in BREAKS:
        low, high = fallen[fallen["ratio"] < at], fallen[fallen["ratio"] >= at]
        found.append({"break": at, "low_columns": len(low), "high_columns": len(high),
                      "low": measures.exponent(low["ratio"], low["run_out"]),
                      "high": measures.exponent(high["ratio"], high["run_out"]),
                      "high_whole": measures.exponent(high["ratio"], 1 + high["run_out"])})
    return found


def exponent_rows(table: pandas.DataFrame) -> list[list[str]]:
    return [[f"{row['break']:g}", row["low_columns"], pages.with_error(row["low"], 2),
             row["high_columns"], pages.with_error(row["high"], 2),
             pages.with_error(row["high_whole"], 2)] for row in exponents(table)]


def wilson(yes: int, of: int) -> tuple[float, float]:
    """Interval of a part, one standard error to each side (Wilson 1927): within 0 and 1."""
    middle = (yes + 0.5) / (of + 1)
    half = sqrt(yes * (of - yes) / of + 0.25) / (of + 1)
    return middle - half, middle + half


def probability(table: pandas.DataFrame) -> pandas.DataFrame:
    """Part of the columns that collapse by bins of the height, with its interval."""
    result = []
    for case, kind in table.groupby(["limits", "lambda", "friction"]):
        of_bin = numpy.digitize(kind["height"], BINS)
        for k in numpy.unique(of_bin):
            inside = kind[of_bin == k]
            low, high = wilson(int(inside["collapsed"].sum()), len(inside))
            result.append({"limits": case[0], "lambda": case[1], "friction": case[2],
                           "height": inside["height"].mean(), "columns": len(inside),
                           "part": inside["collapsed"].mean(), "low": low, "high": high})
    return pandas.DataFrame(result)


def standing(table: pandas.DataFrame) -> pandas.DataFrame:
    return means(table, ["friction", "lambda"], ["height", "lost", "collapsed", "rods"])


def standing_rows(table: pandas.DataFrame) -> list[list[str]]:
    return [[f"{row['friction']:g}", f"{row['lambda']:g}", row["cases"],
             pages.with_error((row["height"], row["height_error"]), 2),
             pages.with_error((row["lost"], row["lost_error"]), 2),
             f"{row['collapsed'] * row['cases']:.0f}"]
            for row in standing(table).to_dict("records")]


# --- Capsules. -----------------------------------------------------------------------------------

def densest(table: pandas.DataFrame) -> dict:
    """The largest solid fraction of the slowest compression."""
    found = capsules(table)
    slowest = found[found["rate"] == found["rate"].min()]
    return slowest.loc[slowest["solid_fraction"].idxmax()].to_dict()


def capsules(table: pandas.DataFrame) -> pandas.DataFrame:
    return means(table, ["rate", "lambda"], ["solid_fraction", "contacts", "rattlers"])


def capsules_rows(table: pandas.DataFrame) -> list[list[str]]:
    return [[pages.power(row["rate"]), f"{row['lambda']:g}", row["cases"],
             pages.with_error((row["solid_fraction"], row["solid_fraction_error"]), 4),
             pages.with_error((row["contacts"], row["contacts_error"]), 2),
             pages.fixed(100 * row["rattlers"], 1)]
            for row in capsules(table).to_dict("records")]


# --- Shear. --------------------------------------------------------------------------------------

def sheared(table: pandas.DataFrame) -> pandas.DataFrame:
    return table[table["rate"] > FLOWING]


def shear(table: pandas.DataFrame) -> list[dict]:
    """For each kind of rods: layers, range of their rates, mean angle, slope over the decades of
    the rate, mean order. Layers that rest are left out."""
    found = []
    for (limits, aspect), kind in sheared(table).groupby(["limits", "lambda"]):
        found.append({"limits": limits, "lambda": aspect, "layers": len(kind),
                      "slowest": kind["rate"].min(), "fastest": kind["rate"].max(),
                      "alignment": statistics.mean_and_error(kind["alignment_deg"]),
                      "slope": measures.slope(numpy.log10(kind["rate"]), kind["alignment_deg"]),
                      "order": statistics.mean_and_error(kind["order"])})
    return found


def shear_rows(table: pandas.DataFrame) -> list[list[str]]:
    return [[f"{row['lambda']:g}", row["limits"], row["layers"],
             f"{row['slowest']:.2g} to {row['fastest']:.2g}", pages.with_error(row["alignment"], 1),
             pages.with_error(row["slope"], 1), pages.with_error(row["order"], 2)]
            for row in shear(table)]


# --- The page. -----------------------------------------------------------------------------------

def words(items, last: str = " and ") -> str:
    items = [str(item) for item in items]
    return last.join([", ".join(items[:-1]), items[-1]]) if len(items) > 1 else items[0]


def summary(read: dict[str, pandas.DataFrame], theirs: dict) -> list[list[str]]:
    """Experiment, what was found there, what here, and the verdict; of all experiments."""
    def range_of(numbers, digits):
        low, high = (f"{edge:.{digits}f}" for edge in (min(numbers), max(numbers)))
        return low if low == high else f"{low} to {high}"
    beds = contacts(read["contacts"], theirs["contacts", "contacts"])
    rods = beds[(beds["method"] == "rods") & (beds["limits"] == "none") & (beds["friction"] == 0.2)]
    limited = beds[(beds["method"] == "rods") & (beds["limits"] == "study")]
    spheres = beds[beds["method"] != "rods"].iloc[0]
    beside = rods[rods["lambda"] == spheres["lambda"]].iloc[0]
    walls = layers(read["wall"])
    columns = critical(read["collapse"])
    rough = [row for row in columns if row["friction"] == 0.5 and row["limits"] == "none"]
    smooth = [row for row in columns if row["friction"] == 0.2 and row["limits"] == "none"]
    with_limit = [row for row in columns if row["limits"] != "none"]
    rests = standing(read["standing"])
    stand = {friction: min((row["lambda"] for row in kind.to_dict("records")
                            if row["collapsed"] == 0), default=nan)
             for friction, kind in rests.groupby("friction")}
    best, angles = densest(read["capsules"]), shear(read["shear"])
    free = [row for row in angles if row["limits"] == "none"]
    run_outs = exponents(read["collapse"])[0]
    return [
        ["contacts a rod, implied by V_f", f"{2 * theirs['contacts', 'half_contacts']:g}",
         f"{range_of(rods['implied'], 1)} at friction 0.2, where rods do touch "
         f"{range_of(rods['contacts'], 1)}; with the limits {range_of(limited['implied'], 1)}",
         "agrees at λ = 10, less for longer rods, where theirs is one number; no count of contacts"],
        ["contacts a rod, measured", f"{theirs['contacts', 'contacts']:g}",
         f"{range_of(rods['contacts'], 1)} at friction 0.2, "
         f"{range_of(beds[beds['friction'] == 0]['contacts'], 1)} without friction",
         f"not reproduced; so many lie nearer than {range_of(rods['gap'].dropna(), 2)} D at friction "
         "0.2, of the longest rods not within 0.3 D"],
        ["wall layer (lengths)", f"{theirs['wall', 'layer']:g}",
         f"order up to {range_of([row['order_layer'] for row in walls], 2)}",
         "agrees, as geometry alone does (0.45); V_f is that of the core much nearer"],
        ["columns: solid below, fall above (lengths)",
         f"{theirs['collapse', 'solid_below']:g}, {theirs['collapse', 'falls_above']:g}",
         f"{range_of([row['solid_below'] for row in rough], 2)}, "
         f"{range_of([row['falls_above'] for row in rough], 2)} at friction 0.5; fall above "
         f"{range_of([row['falls_above'] for row in smooth], 2)} at 0.2; with the limits "
         f"{with_limit[0]['collapsed']} of {with_limit[0]['columns']} have fallen after 1.6 s",
         "falls above agrees at friction 0.5, solid below is lower; friction decides; at the limits' "
         "0.2π rad/s a rod turns by 58 degrees in that time: they answer another question"],
        ["run-out exponents", f"{theirs['collapse', 'exponent_low']:g}, "
         f"{theirs['collapse', 'exponent_high']:g}",
         f"{pages.with_error(run_outs['low'], 2)}, {pages.with_error(run_outs['high'], 2)}",
         "not told apart: no break is seen, errors are large"],
        ["piles stand from λ", f"{theirs['standing', 'stands_from']:g}",
         "; ".join(f"{aspect:g} at friction {friction:g}" for friction, aspect in stand.items()),
         "agrees for friction 0.35 to 0.5"],
        ["densest capsules", f"{theirs['capsules', 'solid_fraction']:g} at λ = "
         f"{theirs['capsules', 'aspect']:g}",
         f"{best['solid_fraction']:.3f} at {best['lambda']:g}",
         "2 % less, and still rising the slower they are compressed; 1.45 and 1.6 are not told apart"],
        ["angle in shear", "level over the rate, smaller for longer rods",
         ", ".join(f"{pages.with_error(row['alignment'], 1)}° for λ = {row['lambda']:g}" for row in free)
         + "; by decade " + ", ".join(f"{pages.with_error(row['slope'], 1)}°" for row in free),
         "agrees within the one decade that a chute has"],
        ["glued spheres, V_f", "–",
         f"{pages.with_error((spheres['vf_inner'], spheres['vf_inner_error']), 3)} against "
         f"{pages.with_error((beside['vf_inner'], beside['vf_inner_error']), 3)} of true rods "
         f"(λ = {spheres['lambda']:g}, friction 0.2)",
         "bumps do not make up for friction: denser"]]


def values(tables: dict[str, str], literature: Path | str, mode: str = "full") -> dict:
    """tables: paths by the names of the experiments; those left out are left out of the page."""
    published = rows.read_rows(literature)
    theirs = {(row["experiment"], row["quantity"]): row["value"]
              for row in published.to_dict("records")}

    def value(row):
        return f"{row['value']:g}" + (f" ± {row['error']:g}" if isfinite(row["error"]) else "")
    told: dict = {
        "literature": [[row["experiment"], row["quantity"].replace("_", " "), value(row),
                        row["printed"], row["not_printed"], row["source"]]
                       for row in published.fillna({"not_printed": ""}).to_dict("records")],
        "theirs": theirs,
        "near_core": NEAR_CORE, "last_order": LAST_ORDER,
        "geometry": (1 - LAST_ORDER) / 2, "lost": measures.LOST, "part": measures.RUN_OUT_PART}
    read = {name: rows.read_rows(path) for name, path in tables.items()}
    told |= {name: None for name in ("contacts", "wall", "collapse", "standing", "capsules",
                                  "shear")}
    if "contacts" in read:
        told["contacts"] = contacts_rows(read["contacts"], theirs["contacts", "contacts"])
    if "wall" in read:
        told["wall"] = layer_rows(read["wall"])
    if "collapse" in read:
        alone = run_out(read["collapse"])["alone"]
        told["collapse"] = {"alone": alone.max() if len(alone) else nan}
        told["collapse_rows"] = critical_rows(read["collapse"])
        told["exponent_rows"] = exponent_rows(read["collapse"])
    if "standing" in read:
        told["standing"] = True
        told["standing_rows"] = standing_rows(read["standing"])
    if "capsules" in read:
        told["capsules"] = True
        told["capsules_rows"] = capsules_rows(read["capsules"])
        told["densest"] = densest(read["capsules"])
    if "shear" in read:
        told["shear"] = shear_rows(read["shear"])
    told["summary"] = summary(read, theirs) if mode == "full" and len(read) == 6 else None
    everything = pandas.concat(read.values())
    return told | {"versions": words(sorted(everything["version"].unique())),
                   "machines": words(sorted(everything["machine"].unique()))}
