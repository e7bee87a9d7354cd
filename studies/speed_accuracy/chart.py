# SPDX-License-Identifier: GPL-2.0-or-later
"""Charts of error against cost, one a scene, their small multiples, and the table that says which
method reaches an error at the least cost.

Rows: scene, lambda, method ("rods" or "multisphere"), n, rule, stiffness, time_step_over_limit, cost,
cost_min, cost_max, error, error_low, error_high, quantity; errors relative, costs in core seconds a
simulated second (beds: see their page). The same for the scenes and the settled beds; rows of beds have
as well `beds`, their number, and `cost_is_least`, 1 where they were ended before they were at rest.
"""
from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas
from matplotlib import patheffects
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator

from studies.common import plots
from studies.common.pages import power
from studies.common.rows import read_rows
from studies.common.statistics import pareto_front

LEVELS = (0.10, 0.03, 0.01, 0.003)
BED_LEVELS = (0.10, 0.03)  # a bed scatters by 2 to 4 % with its seed
FEWEST_BEDS = 3            # of a case that may be the answer to a question
# A method has reached a floor where FEWEST_CASES or more of it were run and those of at most a third of the
# largest cost are within a quarter of its least error.
FEWEST_CASES, FLOOR_COST, FLOOR_ERROR = 20, 1 / 3, 1.25
TITLES = {"wall": "one end hits a floor", "crossed": "two crossed rods",
          "flat": "flat on a floor", "parallel": "along a parallel rod",
          "row": "across a row of rods", "slide_along": "sliding in a groove of rods",
          "slide_across": "sliding over a row of rods", "incline": "incline, about its threshold",
          "rolling": "rolling on two rods", "spin_down": "spinning down on two rods",
          "precession": "free precession, 100 turns", "gas": "elastic gas", "bed": "settled bed"}
QUANTITIES = {"impulse": "impulse", "friction": "impulse of friction", "speed": "final speed",
              "angle": "angle turned", "phase": "phase, of one turn", "energy": "energy",
              "inner": "V_f, inner cylinder", "whole": "V_f, whole vessel",
              "elevation": "mean elevation", "contacts": "contacts a rod"}
# The spacings of glued spheres, widest first, whatever n that makes.
SPHERE_COLOURS = ["orange", "vermilion", "purple", "black"]
SPHERE_MARKERS = ["s", "D", "^", "v"]
ROD_COLOUR = "blue"
POINTS = 72 / 25.4  # a mm


def read(paths) -> pandas.DataFrame:
    return pandas.concat([read_rows(path) for path in paths], ignore_index=True)


def name_of(scene: str, quantity: str) -> str:
    """Of a chart's files."""
    return f"{scene}_{quantity}"


def title_of(scene: str, quantity: str = "") -> str:
    """With the quantity where a scene has several that do not speak for themselves."""
    title = TITLES.get(scene, scene.replace("_", " "))
    return f"{title}: {QUANTITIES.get(quantity, quantity)}" if quantity and is_bed(scene) else title


def is_bed(scene: str) -> bool:
    return scene.startswith("bed")


def levels_of(scene: str) -> tuple[float, ...]:
    return BED_LEVELS if is_bed(scene) else LEVELS


def charts_of(rows: pandas.DataFrame) -> list[tuple[str, str]]:
    """(scene, quantity) in the order of TITLES, then of the rows."""
    found = list(dict.fromkeys(zip(rows["scene"], rows["quantity"].fillna(""))))
    order = {name: k for k, name in enumerate(TITLES)}
    return sorted(((s, q) for s, q in found if q),
                  key=lambda chart: order.get(chart[0], len(order)))


def standing(rows: pandas.DataFrame) -> pandas.DataFrame:
    """Rows with a cost and an error below 1: beyond it nothing of the scene is left."""
    return rows[(rows["error"] < 1.0) & (rows["cost"] > 0.0)]


def answer(rows: pandas.DataFrame, method: str, level: float) -> tuple[str, pandas.Series | None]:
    """"reached", with the cheapest case of a method that has an error of at most `level`; "not reached"; or
    "not resolved". Of beds, whose error is a bias of few seeds, the error with its standard error must be
    below the level, and FEWEST_BEDS be there; where only the error without it is, or beds are too few,
    nothing is resolved."""
    here = rows[rows["method"] == method]
    beds = here["scene"].map(is_bed).astype(bool)
    enough = ~beds | (here.get("beds", FEWEST_BEDS) >= FEWEST_BEDS)
    good = here[enough & (here["error_high"].where(beds, here["error"]) <= level)]
    if len(good):
        return "reached", good.loc[good["cost"].idxmin()]
    return ("not resolved" if len(open_cases(here, level)) else "not reached"), None


def open_cases(rows: pandas.DataFrame, level: float) -> pandas.DataFrame:
    """Beds that may be below the level or not: by their standard error, or as they are too few."""
    beds = rows["scene"].map(is_bed).astype(bool)
    few = rows.get("beds", pandas.Series(FEWEST_BEDS, index=rows.index)) < FEWEST_BEDS
    return rows[beds & (rows["error_low"] <= level) & (few | (rows["error_high"] > level))]


def at_floor(rows: pandas.DataFrame) -> bool:
    """Whether more cost no longer lowers the error of a method's cases."""
    cheap = rows[rows["cost"] <= FLOOR_COST * rows["cost"].max()]
    return len(rows) >= FEWEST_CASES and bool(
        cheap["error"].min() <= FLOOR_ERROR * rows["error"].min())


def summary(rows: pandas.DataFrame) -> pandas.DataFrame:
    """A row for each scene, quantity, aspect ratio and error: who is cheapest, by how many times; the
    least error of either method where it does not get there."""
    result = []
    for scene, quantity in charts_of(rows):
        part = standing(rows[(rows["scene"] == scene) & (rows["quantity"] == quantity)])
        for aspect in sorted(part["lambda"].unique()):
            here = part[part["lambda"] == aspect]
            result += [answers(here, level) | {"lambda": aspect} for level in levels_of(scene)]
    return pandas.DataFrame(result)


def answers(here: pandas.DataFrame, level: float) -> dict:
    """The row of the summary of one scene, quantity and aspect ratio for an error."""
    row = {"scene": here["scene"].iloc[0], "quantity": here["quantity"].iloc[0], "lambda": 0.0,
           "error": level}
    found = {}
    for name in ("rods", "multisphere"):
        cases = here[here["method"] == name]
        state, best = answer(here, name, level)
        found[name] = (state, best)
        row |= {f"{name}_state": state, f"{name}_cost": np.nan if best is None else best["cost"],
                f"{name}_rule": "" if best is None else best["rule"],
                f"{name}_least_error": cases["error"].min(), f"{name}_cases": len(cases),
                f"{name}_cost_is_least": 0 if best is None else int(best.get("cost_is_least", 0) == 1)}
    ours, theirs = (best for _, best in found.values())
    row["multisphere_n"] = 0 if theirs is None else int(theirs["n"])
    row["multisphere_at_floor"] = int(at_floor(here[here["method"] == "multisphere"])
                                      and not is_bed(row["scene"]))
    row["rods_are_cheaper"] = np.nan if ours is None or theirs is None \
        else theirs["cost"] / ours["cost"]
    row["cheapest"] = verdict(here, level, found)
    return row


def verdict(here: pandas.DataFrame, level: float, found: dict) -> str:
    """The method that is cheapest; not resolved if what is open could be cheaper still."""
    costs = {m: best["cost"] for m, (_, best) in found.items() if best is not None}
    open_ = {m: open_cases(here[here["method"] == m], level)["cost"].min() for m in found}
    if not costs:
        return "not resolved" if any(state == "not resolved" for state, _ in found.values()) \
            else "neither"
    first = min(costs, key=lambda m: costs[m])
    other = next(m for m in found if m != first)
    return "not resolved" if open_[other] < costs[first] else first


def times(ratio: float) -> str:
    """Three digits at most: 0.8, 4.2, 37, 1200."""
    if ratio >= 100:
        return f"{float(f'{ratio:.2g}'):.0f}"
    return f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.2g}"


def ratio_of(ratio: float, ours_cut, theirs_cut) -> str:
    """How many times, with ≥ where the dearer one was ended before it was at rest, ≤ where the cheaper one
    was, and ≈ where both were, after the same time."""
    sign = {(0, 1): "≥ ", (1, 0): "≤ ", (1, 1): "≈ "}.get((int(ours_cut), int(theirs_cut)), "")
    return sign + times(ratio)


def words(row) -> str:
    """What the summary says of one error, for a table."""
    states = row["rods_state"], row["multisphere_state"]
    spheres = f"n = {row['multisphere_n']:.0f}"
    if states == ("reached", "reached"):
        cuts = row["rods_cost_is_least"], row["multisphere_cost_is_least"]
        if row["rods_are_cheaper"] >= 1.0:
            text = f"rods {ratio_of(row['rods_are_cheaper'], *cuts)} × ({spheres})"
        else:
            text = f"spheres, {spheres}, {ratio_of(1.0 / row['rods_are_cheaper'], *cuts[::-1])} ×"
        return text if row["cheapest"] != "not resolved" else f"{text}, not resolved"
    if states[0] == "reached":
        if states[1] == "not resolved":
            return "rods; spheres not resolved"
        return "only rods" if row["multisphere_at_floor"] or is_bed(row["scene"]) \
            else "only rods so far"
    if states[1] == "reached":
        return f"spheres, {spheres}; rods not resolved" if states[0] == "not resolved" \
            else f"only spheres, {spheres}"
    return "not resolved" if "not resolved" in states else "neither"


def percent(value: float) -> str:
    """0.3, 1, 10; of small ones a power of ten; a dash for no number."""
    value = 100.0 * value
    if not np.isfinite(value):
        return "–"
    if value and abs(value) < 1e-3:
        return power(value)
    return f"{value:.2g}" if value < 10 else f"{value:.0f}"


def by_number(rows: pandas.DataFrame, aspect: float) -> tuple[list[str], list[list[str]]]:
    """Least errors in per cent at one aspect ratio, of rods and of each number of spheres."""
    rows = standing(rows[(rows["lambda"] == aspect) & ~rows["scene"].map(is_bed)])
    numbers = sorted(rows.loc[rows["method"] == "multisphere", "n"].unique())
    lines = []
    for scene, quantity in charts_of(rows):
        part = rows[(rows["scene"] == scene) & (rows["quantity"] == quantity)]
        least = part.groupby(["method", "n"])["error"].min()
        lines.append([f"{title_of(scene)} ({QUANTITIES.get(quantity, quantity)})",
                      percent(least.get(("rods", 0), np.nan)),
                      *[percent(least.get(("multisphere", n), np.nan)) for n in numbers]])
    return ["scene", "rods", *[f"n = {n:.0f}" for n in numbers]], lines


# --- Drawing. ------------------------------------------------------------------------------------

def spacing_index(n: int, aspect: float) -> int:
    """0 for touching spheres, 1 for spacing r, ...: n − 1 = (λ − 1) 2^index."""
    if aspect <= 1:
        return 0
    return int(np.clip(round(np.log2((n - 1) / (aspect - 1))), 0, len(SPHERE_COLOURS) - 1))


def style_of(method: str, n: int, rule: str, aspect: float) -> dict:
    full = rule in ("spread", "adapted")
    if method == "rods":
        colour, marker = plots.COLOURS[ROD_COLOUR], "o"
    else:
        index = spacing_index(n, aspect)
        colour, marker = plots.COLOURS[SPHERE_COLOURS[index]], SPHERE_MARKERS[index]
    return {"marker": marker, "markeredgecolor": colour, "color": colour,
            "markerfacecolor": colour if full else "none", "markeredgewidth": 0.8}


def draw_front(axes, rows: pandas.DataFrame, method: str) -> list[tuple[str, float, float, str]]:
    """The front of a method as a stair: what is reached at a cost. Gives the labels of its points."""
    part = rows[rows["method"] == method]
    if part.empty:
        return []
    front = part.iloc[pareto_front(part["cost"], part["error"])]
    colour = plots.COLOURS[ROD_COLOUR if method == "rods" else "vermilion"]
    axes.step(front["cost"], np.maximum(front["error"], 1e-30), where="post", color=colour,
              linewidth=1.6, alpha=0.75, linestyle="-" if method == "rods" else (0, (5, 2)), zorder=2)
    named: dict[str, tuple] = {}
    for _, row in front.iterrows():
        name = "rods" if method == "rods" else f"n={row['n']:.0f}"
        named.setdefault(name, (name, row["cost"], row["error"], plots.for_letters(colour)))
    return list(named.values())


def places_of(x, y, limits, size) -> np.ndarray:
    """Points of the paper, from the panel's lower left corner, of values on log axes."""
    (left, right), (low, high) = limits
    return np.stack([size[0] * np.log(np.asarray(x) / left) / np.log(right / left),
                     size[1] * np.log(np.asarray(y) / low) / np.log(high / low)], axis=-1)


def draw_labels(axes, labels, rows: pandas.DataFrame, size) -> None:
    """Labels where they cover fewest points, no other label and nothing outside. size: of the panel, in
    points."""
    limits, letters = (axes.get_xlim(), axes.get_ylim()), 6.5
    low = limits[1][0]
    others = places_of(rows["cost"], np.maximum(rows["error"], low), limits, size)
    below = others[rows["error"].to_numpy() < low]   # arrows, which are longer than points
    others = np.concatenate([others, below + [0.0, 5.0], below + [0.0, 10.0]])
    taken: list[np.ndarray] = []
    for name, cost, error, colour in labels:
        at = places_of(cost, max(error, low), limits, size)
        box = np.array([0.72 * letters * len(name), 1.1 * letters])
        best = None
        for away in (5.0, 10.0, 15.0, 20.0):
            for across, up in ((1, 1), (-1, 1), (1, -1), (-1, -1), (0, 1), (0, -1), (1, 0), (-1, 0)):
                middle = at + np.array([across, up]) * (0.5 * box + (away if 0 in (across, up)
                                                                      else 0.6 * away))
                corner = middle - 0.5 * box
                outside = np.any(corner < 1) or np.any(corner + box > np.array(size) - 1)
                on_label = any(np.all(np.abs(middle - m) < box) for m in taken)
                hidden = np.sum(np.all(np.abs(others - middle) < 0.5 * box + 2.0, axis=1))
                score = 1000 * outside + 200 * on_label + 10 * hidden + 1.2 * away + 0.1 * (up < 0)
                if best is None or score < best[0]:
                    best = (score, middle)
        taken.append(best[1])
        text = axes.annotate(name, (cost, max(error, low)), xytext=tuple(best[1] - at),
                             textcoords="offset points", fontsize=letters, color=colour, ha="center",
                             va="center", zorder=6, annotation_clip=False)
        text.set_path_effects([patheffects.withStroke(linewidth=1.8, foreground="white")])


def draw_arrows(axes, rows: pandas.DataFrame, aspect: float, low: float) -> None:
    """Down from the edge where an error is below the axis; to the right where a cost is a lower bound."""
    for _, row in rows.iterrows():
        colour = style_of(row["method"], int(row["n"]), row["rule"], aspect)["color"]
        props = {"arrowstyle": "->", "color": colour, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
        if row["error"] < low:
            axes.annotate("", (row["cost"], low), xytext=(0, 11), textcoords="offset points",
                          arrowprops=props)
        elif row.get("cost_is_least", 0) == 1:
            axes.annotate("", (row["cost"], row["error"]), xytext=(12, 0),
                          textcoords="offset points", arrowprops=props | {"arrowstyle": "<-"})


def draw_panel(axes, rows: pandas.DataFrame, aspect: float, *, size: tuple[float, float],
               low: float = 1e-5) -> None:
    """Error against cost of one scene and aspect ratio, on an axis from `low` to 150 %."""
    rows = standing(rows)
    for (method, n, rule), part in rows[rows["error"] >= low].groupby(["method", "n", "rule"]):
        error = part["error"]
        bars = [np.clip(error - part["error_low"], 0, 0.999 * error),
                np.clip(part["error_high"] - error, 0, None)]
        sideways = [np.clip(part["cost"] - part["cost_min"], 0, None),
                    np.clip(part["cost_max"] - part["cost"], 0, None)]
        axes.errorbar(part["cost"], error, yerr=bars, xerr=sideways, linestyle="none",
                      markersize=3.2, elinewidth=0.5, alpha=0.8, zorder=3,
                      rasterized=True,  # thousands of points make an SVG large
                      **style_of(method, int(n), rule, aspect))
    labels = [label for method in ("multisphere", "rods") for label in draw_front(axes, rows, method)]
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(low, 1.5)
    # Room for labels and arrows at the sides.
    least, most = rows["cost_min"].min(), rows["cost_max"].max()
    room = max(1.15, (most / least) ** 0.06)
    axes.set_xlim(least / room, most * room ** 1.5)
    ticks(axes)
    draw_arrows(axes, rows, aspect, low)
    draw_labels(axes, labels, rows, size)
    axes.grid(True, which="major", linewidth=0.4, alpha=0.5)


def ticks(axes) -> None:
    """Of the costs: 1, 2, 5 a decade where there are few decades."""
    left, right = axes.get_xlim()
    if right / left < 100:
        subs = (1, 2, 5) if right / left < 20 else (1, 3)
        axes.xaxis.set_major_locator(LogLocator(subs=subs))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_minor_formatter(NullFormatter())


def note(table: pandas.DataFrame) -> str:
    """At which cost the errors are had, in two lines."""
    texts = [f"{percent(row['error'])} %: {words(row)}" for _, row in table.iterrows()]
    a_line = -(-len(texts) // 2)
    return "\n".join(";   ".join(texts[k:k + a_line]) for k in range(0, len(texts), a_line))


def legend_of(figure, rows: pandas.DataFrame) -> None:
    """Of what is there."""
    rows = standing(rows)
    rules, entries = set(rows["rule"]), []
    names = {"spread": "rods, spread contact", "single": "rods, single contact"}
    entries += [Line2D([], [], linestyle="none", markersize=4, label=names[rule],
                       **style_of("rods", 0, rule, 10)) for rule in names if rule in rules]
    spheres = rows[rows["method"] == "multisphere"]
    there = {spacing_index(int(n), aspect) for n, aspect in zip(spheres["n"], spheres["lambda"])}
    for k, spacing in enumerate(("2r", "r", "r/2", "r/4")):
        if k in there:
            entries.append(Line2D([], [], linestyle="none", markersize=4,
                                  label=f"spheres every {spacing}",
                                  **style_of("multisphere", 1 + 2**k * 9, "adapted", 10)))
    if "nominal" in rules:
        entries.append(Line2D([], [], linestyle="none", markersize=4, label="spheres, hollow: nominal",
                              marker="h", color=plots.COLOURS["grey"], markerfacecolor="none",
                              markeredgewidth=0.8))
    lines = -(-len(entries) // 4)
    room = (4.0 + 4.5 * lines) / 25.4 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0.0, room, 1.0, 1.0 - room))
    figure.legend(handles=entries, loc="lower center", ncols=4, fontsize=7, frameon=False)


def chart(rows: pandas.DataFrame, scene: str, quantity: str, stem: Path | str) -> None:
    """The chart of one scene, a panel an aspect ratio."""
    part = rows[(rows["scene"] == scene) & (rows["quantity"] == quantity)]
    aspects = sorted(part["lambda"].unique())
    columns = min(2, len(aspects))
    lines = -(-len(aspects) // columns)
    figure, axes = plots.new_figure(180, 66 * lines + 22, lines, columns, squeeze=False,
                                    sharey=True)
    figure.set_layout_engine("constrained")
    table = summary(part)
    low = lowest_of(part)
    for k, aspect in enumerate(aspects):
        panel = axes[k // columns][k % columns]
        draw_panel(panel, part[part["lambda"] == aspect], aspect, low=low,
                   size=(POINTS * (165 / columns - 6), POINTS * 46))
        panel.set_title(note(table[table["lambda"] == aspect]), fontsize=6.8, linespacing=1.3,
                        loc="right")
        panel.set_title(f"λ = {aspect:g}", fontsize=9, loc="left")
    for panel in axes.flat[len(aspects):]:
        panel.set_axis_off()
    for panel in axes[:, 0]:
        panel.set_ylabel(f"error of the {QUANTITIES.get(quantity, quantity)}", fontsize=8)
    for k in range(columns):
        last = [panel for panel in axes.flat[:len(aspects)][k::columns]][-1]
        last.set_xlabel(cost_label(scene), fontsize=8)
    figure.suptitle(title_of(scene, quantity), fontsize=10)
    legend_of(figure, part)
    plots.save(figure, stem)


def cost_label(scene: str) -> str:
    if is_bed(scene):
        return "core seconds to rest (→: or more)"
    return "core seconds a simulated second and copy"


def lowest_of(rows: pandas.DataFrame) -> float:
    """Where the axis of errors begins: about a decade below the least error of glued spheres or 10⁻⁴, unless
    no error is that low."""
    good = standing(rows)
    theirs = good.loc[good["method"] == "multisphere", "error"].min()
    lowest = min(1e-3, theirs if np.isfinite(theirs) else 1e-3)
    return max(1e-8, 0.5 * 10.0 ** np.floor(np.log10(lowest) - 1.0), 0.4 * good["error"].min())


def combined(rows: pandas.DataFrame, aspect: float, stem: Path | str) -> None:
    """Small multiples: the fronts of all scenes at one aspect ratio (beds: at the nearest)."""
    charts = [c for c in charts_of(standing(rows))
              if not (c[0] == "precession" and c[1] == "energy")]
    columns = 4
    lines = -(-len(charts) // columns)
    figure, axes = plots.new_figure(220, 48 * lines + 22, lines, columns, squeeze=False)
    figure.set_layout_engine("constrained")
    drawn = []
    for panel, (scene, quantity) in zip(axes.flat, charts):
        part = rows[(rows["scene"] == scene) & (rows["quantity"] == quantity)]
        nearest = min(part["lambda"].unique(), key=lambda a: abs(np.log(a / aspect)))
        here = part[part["lambda"] == nearest]
        drawn.append(here)
        draw_panel(panel, here, nearest, low=3e-5 if not is_bed(scene) else 5e-4,
                   size=(POINTS * 44, POINTS * 32))
        shown = f", λ = {nearest:g}" if nearest != aspect else ""
        panel.set_title(title_of(scene, quantity) + shown, fontsize=8)
        panel.tick_params(labelsize=6.5)
    for panel in axes.flat[len(charts):]:
        panel.set_axis_off()
    for panel in axes[:, 0]:
        panel.set_ylabel("error", fontsize=7.5)
    # Below the last panel of each unit in a column.
    for kind, label in ((False, "core seconds a simulated second"), (True, "core seconds to rest (→: or more)")):
        for k in range(columns):
            panels = [panel for panel, (scene, _) in list(zip(axes.flat, charts))[k::columns]
                      if is_bed(scene) == kind]
            if panels:
                panels[-1].set_xlabel(label, fontsize=7)
    figure.suptitle(f"Error against cost, λ = {aspect:g}: down and left is better", fontsize=10)
    legend_of(figure, pandas.concat(drawn))
    plots.save(figure, stem)


def summary_table(table: pandas.DataFrame) -> tuple[list[str], list[list[str]]]:
    """Headings and lines of the summary, a line a scene, quantity and aspect ratio."""
    headings = ["scene", "λ", *[f"{percent(level)} %" for level in LEVELS],
                "rods' least error, %", "spheres', %"]
    lines = []
    for (scene, quantity, aspect), part in table.groupby(["scene", "quantity", "lambda"], sort=False):
        by_level = {row["error"]: words(row) for _, row in part.iterrows()}
        first = part.iloc[0]
        lines.append([f"{title_of(scene)} ({QUANTITIES.get(quantity, quantity)})", f"{aspect:g}",
                      *[by_level.get(level, "–") for level in LEVELS],
                      percent(first["rods_least_error"]), percent(first["multisphere_least_error"])])
    return headings, lines
