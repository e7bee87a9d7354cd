# SPDX-License-Identifier: GPL-2.0-or-later
"""What the pages of the study are filled with, all from its CSV files."""
from __future__ import annotations

from pathlib import Path

import pandas

from studies.common import pages, rows, settling
from studies.packing import beds as drawing
from studies.packing import figures, measures

# Not told as settings: they differ from bed to bed or say nothing of them.
OF_A_BED = ("lambda", "seed", "vessel_diameter", "rods", "friction", "layers", "drop", "types")


def settings(variables: dict, config: dict, shown_seed: str) -> pandas.DataFrame:
    """The variables of in.rods that all beds share, and what is drawn."""
    told = {name: value for name, value in variables.items()
            if name not in OF_A_BED and float(value) != 0}
    told = {name: f"{float(value):.10g}" for name, value in told.items()}
    told["snapshots"] = " ".join(f"{float(t):g}" for t in config["snapshots"])
    for name in ("height_of_snapshots", "height_of_bed", "picture_scale"):
        told[name] = f"{float(config[name]):g}"
    told["shown_seed"] = shown_seed
    return pandas.DataFrame({"variable": list(told), "value": list(told.values())})


def words(items, last: str = " and ") -> str:
    items = [str(item) for item in items] or [""]
    return last.join([", ".join(items[:-1]), items[-1]]) if len(items) > 1 else items[0]


def percent(parts) -> str:
    """12, 15 and 19 %"""
    return words(f"{100 * part:.0f}" for part in parts) + " %"


def of_limits(means: pandas.DataFrame, limits: str) -> pandas.DataFrame:
    """Of the study's friction."""
    return figures.of_kind(means, measures.STUDY_FRICTION, limits).set_index("lambda").sort_index()


# What the study states, and the column of measures.verdicts that tells whether it holds.
STATEMENTS = {"stable": "beds come to rest", "flat": "most rods are near horizontal",
              "close": "the two measures of V_f are close",
              "slightly": "V_f is slightly below 2 ln λ/λ"}


def where(part: pandas.DataFrame, column: str) -> str:
    """yes, no, or at which λ."""
    held = part[part[column]]["lambda"]
    if len(held) in (0, len(part)):
        return "yes" if len(held) else "no"
    return f"at λ = {words(f'{a:g}' for a in held)}"


def above_and_below(parts) -> str:
    """16 and 32 % below, or with the sign of each where it is above."""
    return words(f"{-100 * part:+.0f}".replace("-", "−") for part in parts) + " %"


def verdict(table: pandas.DataFrame) -> dict:
    """Rows of the table of statements; and, of settings in words: under which all of them hold at all λ;
    of the study's own the statements that hold and those that do not; those nearest to its V_f."""
    lines, everything, own, away = [], [], {}, {}
    for friction, limits in figures.kinds_of(table):
        part = figures.of_kind(table, friction, limits).sort_values("lambda")
        name = figures.kind_name(friction, limits)
        lines.append([name, where(part, "stable"),
                      f"{where(part, 'flat')} ({percent(part['level'])})",
                      f"{where(part, 'close')} ({above_and_below(part['apart'])})",
                      f"{where(part, 'slightly')} ({above_and_below(part['below'])})"])
        if part[list(STATEMENTS)].to_numpy().all():
            everything.append(name)
        if (friction, limits) == (measures.STUDY_FRICTION, "study"):
            own = {column: bool(part[column].all()) for column in STATEMENTS}
        away[name] = (part["below"].abs().max(), above_and_below(part["below"]))
    nearest = min(away, key=lambda name: away[name][0])
    return {"lines": lines, "all_hold": words(everything),
            "holds": words(STATEMENTS[column] for column, held in own.items() if held),
            "fails": words(STATEMENTS[column] for column, held in own.items() if not held),
            "nearest": nearest, "nearest_away": away[nearest][1],
            "near": away[nearest][0] <= measures.SLIGHTLY, "only_one": len(lines) == 1}


def findings(beds: pandas.DataFrame, means: pandas.DataFrame) -> dict:
    """What the beds with the study's limits and with none tell beside each other."""
    study, none = of_limits(means, "study"), of_limits(means, "none")
    without = beds[(beds["limits"] == "none") & (beds["friction"] == measures.STUDY_FRICTION)]
    return {
        "without": len(without),
        "least_energy": without["energy_J"].min(), "most_energy": without["energy_J"].max(),
        "lowered_by": percent(1 - study["vf_inner"] / none["vf_inner"]),
        "steeper_by": (study["mean_elevation_deg"] - none["mean_elevation_deg"]).mean(),
        "study_below_theory": percent(1 - study["vf_inner"] / study["vf_theory"]),
        "none_below_theory": percent(1 - none["vf_inner"] / none["vf_theory"]),
        "none_below_random": percent(1 - none["vf_inner"] / none["vf_expected"]),
        "aspects": words(f"{a:g}" for a in none.index)}


def without_friction(means: pandas.DataFrame) -> dict | None:
    """What friction does, under the study's limits: beds with none beside those with the study's."""
    limited = means[means["limits"] == "study"].set_index("lambda")
    none, some = (limited[limited["friction"] == f] for f in (0, measures.STUDY_FRICTION))
    both = none.index.intersection(some.index)
    if both.empty:
        return None
    none, some = none.loc[both], some.loc[both]
    return {"denser_by": percent(none["vf_inner"] / some["vf_inner"] - 1),
            "to_theory": above_and_below(1 - none["vf_inner"] / none["vf_theory"]),
            "contacts": words(f"{c:.1f}" for c in none["contacts_per_rod"]),
            "contacts_with": words(f"{c:.1f}" for c in some["contacts_per_rod"])}


def overlaps(means: pandas.DataFrame) -> dict:
    return {"least_mean": 100 * means["mean_overlap_over_diameter"].min(),
            "most_mean": 100 * means["mean_overlap_over_diameter"].max(),
            "settled": 100 * means["largest_overlap_over_diameter"].max(),
            "ever": 100 * means["momentary_overlap_over_diameter"].max()}


def rows_of_means(means: pandas.DataFrame, full: bool) -> list[list[str]]:
    """Texts of the table of means: of the README, or with all columns of the HTML page."""
    def pair(row, name, decimals):
        return pages.with_error((row[name], row[f"{name}_error"]), decimals)
    return [[f"{row['lambda']:g}", f"{row['friction']:g}", row["limits"], *([row["beds"]] if full else []),
             pair(row, "vf_inner", 4), pair(row, "vf_whole", 4), pages.fixed(row["vf_theory"], 4),
             pair(row, "vf_random_contacts", 4) if full
             else pages.fixed(row["vf_random_contacts"], 3),
             pair(row, "mean_elevation_deg", 1), pair(row, "nematic_order", 3),
             pair(row, "contacts_per_rod", 2),
             *([pages.fixed(row["largest_overlap_over_diameter"], 4),
                pages.power(row["energy_J"], 2)] if full else [])]
            for row in means.to_dict("records")]


def rows_of_beds(beds: pandas.DataFrame) -> list[list[str]]:
    return [[f"{row['lambda']:g}", f"{row['friction']:g}", row["limits"], row["seed"],
             *(pages.fixed(row[name], decimals) for name, decimals in (
                 ("vf_inner", 4), ("vf_whole", 4), ("vf_random_contacts", 4),
                 ("mean_elevation_deg", 2), ("mean_sin_gamma", 4), ("contacts_per_rod", 2),
                 ("mean_overlap_over_diameter", 5), ("largest_overlap_over_diameter", 4),
                 ("momentary_overlap_over_diameter", 3))),
             pages.power(row["energy_J"], 2), row["version"], row["decks"], row["measured_by"]]
            for row in beds.to_dict("records")]


def values(results: Path, literature: Path | str, mode: str) -> dict:
    beds = measures.read_beds(results / "beds.csv")
    means = measures.packing_means(beds)
    distributions = rows.read_rows(results / "elevation.csv")
    elevation = measures.elevation_means(distributions)
    published = measures.read_literature(literature)
    table = rows.read_rows(results / "settings.csv")
    setting = dict(zip(table["variable"], table["value"].astype(str)))
    _, left_out = figures.packing_figure(means, published)
    limits_there = figures.limits_of(means)
    kinds = figures.kinds_of(means)
    means["order"] = [kinds.index(kind) for kind in zip(means["friction"], means["limits"])]
    means = means.sort_values(["lambda", "order"], ignore_index=True)
    own = figures.of_kind(beds, kinds[0][0], limits_there[-1])
    one_of_each = beds.drop_duplicates("lambda")
    shown = own[(own["lambda"] == own["lambda"].max()) &
                (own["seed"].astype(str) == setting["shown_seed"])].iloc[0]
    fewest = means["beds"].min()
    snapshots = [float(t) for t in setting["snapshots"].split()]
    top, of_bed, scale = (float(setting[name]) for name in
                          ("height_of_snapshots", "height_of_bed", "picture_scale"))

    def options(style):
        return " ".join(map(str, style + drawing.render_options(shown)))
    both = {(measures.STUDY_FRICTION, limits) for limits in figures.LIMITS} <= set(kinds)
    return {
        "title": "Packing of sphero-cylinders of aspect ratio " +
                 words(f"{a:g}" for a in one_of_each["lambda"]),
        "mode": mode, "folder": results, "setting": setting,
        "beds": beds.to_dict("records"), "means": means.to_dict("records"),
        "kinds": [{"name": figures.kind_name(*kind), "picture": figures.picture(*kind),
                   "cut": figures.picture(*kind, "_cut")} for kind in kinds],
        "kinds_told": "; ".join(figures.kind_name(*kind) for kind in kinds),
        "has_others": any(friction != measures.STUDY_FRICTION for friction, _ in kinds),
        "study_friction": measures.STUDY_FRICTION,
        "frictionless": without_friction(means),
        "verdict": verdict(measures.verdicts(beds, means, distributions)),
        "slightly": 100 * measures.SLIGHTLY, "close": 100 * measures.CLOSE,
        "near_horizontal": measures.NEAR_HORIZONTAL_DEG, "rest_energy": settling.REST_ENERGY,
        "aspects": words(f"{a:g}" for a in one_of_each["lambda"]),
        "rods": words(one_of_each["rods"]),
        "vessels": words(f"{d:g}" for d in one_of_each["vessel_diameter_m"]),
        "dt": beds["dt_s"].iloc[0], "time": beds["time_s"].max(),
        "beds_each": figures.beds_in_words(means["beds"]), "fewest": fewest,
        "shown": shown.to_dict(), "snapshots": snapshots,
        "frames": [round(t / shown["dt_s"]) for t in snapshots],
        "snapshot_options": options(drawing.snapshot_style(top, scale)),
        "bed_options": options(drawing.bed_style(of_bed, False, scale)),
        "cut_options": options(drawing.bed_style(of_bed, True, scale)),
        "rows_of_means": rows_of_means(means, False),
        "full_rows_of_means": rows_of_means(means, True), "rows_of_beds": rows_of_beds(beds),
        "isotropic_rods": elevation["isotropic_rods"].min(),
        "found": findings(beds, means) if both else None, "overlap": overlaps(means),
        "isotropic_deg": measures.ISOTROPIC_ELEVATION_DEG, "half_contacts": measures.HALF_CONTACTS,
        "horizontal_order": measures.HORIZONTAL_ORDER,
        "published": published.to_dict("records"), "left_out": left_out,
        "untimed": int(beds["cpu_s"].isna().sum()),
        "versions": words(sorted(beds["version"].unique())),
        "machines": words(sorted(beds["machine"].unique())),
        "decks": words(sorted(beds["decks"].unique())),
        "measured_by": words(sorted(beds["measured_by"].unique()))}
