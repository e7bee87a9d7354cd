# SPDX-License-Identifier: GPL-2.0-or-later
"""Charts of error against cost, one a scene, their small multiples, and the table that says which
method reaches an error at the least cost.

Rows: scene, lambda, method ("rods" or "multisphere"), n, rule, stiffness, time_step_over_limit, cost,
cost_min, cost_max, error, error_low, error_high, quantity; errors relative, costs in core seconds a
simulated second (beds: see their page). The same for the scenes and the settled beds.
"""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas
from matplotlib.ticker import NullFormatter

from studies.common import plots
from studies.common.pages import power
from studies.common.rows import read_rows
from studies.common.statistics import pareto_front

LEVELS = (0.10, 0.03, 0.01, 0.003)
BED_LEVELS = (0.10, 0.03)  # a bed scatters by 2 to 4 % with its seed
TITLES = {"wall": "one end hits a floor", "crossed": "two crossed rods",
          "flat": "flat on a floor", "parallel": "along a parallel rod",
          "row": "across a row of rods", "slide_along": "sliding in a groove of rods",
          "slide_across": "sliding over a row of rods", "incline": "incline, about its threshold",
          "rolling": "rolling on two rods", "spin_down": "spinning down on two rods",
          "precession": "free precession, 100 turns", "gas": "elastic gas", "bed": "settled bed"}
QUANTITIES = {"impulse": "impulse", "friction": "impulse of friction", "speed": "final speed",
              "angle": "angle turned", "phase": "phase (turns)", "energy": "energy",
              "inner": "V_f, inner cylinder", "whole": "V_f, whole vessel",
              "elevation": "mean elevation", "contacts": "contacts a rod"}
# The spacings of glued spheres, widest first, whatever n that makes.
SPHERE_COLOURS = ["orange", "vermilion", "purple", "black"]
SPHERE_MARKERS = ["s", "D", "^", "v"]
ROD_COLOUR = "blue"


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


@dataclass(frozen=True)
class Best:
    cost: float
    error: float
    n: int
    rule: str


def cheapest(rows: pandas.DataFrame, method: str, level: float) -> Best | None:
    """The cheapest case of a method with an error of at most `level`; of a bed, whose error is a
    bias of few seeds, with its standard error."""
    error = rows["error_high"].where(rows["scene"].map(is_bed), rows["error"])
    good = rows[(rows["method"] == method) & (error <= level)]
    if good.empty:
        return None
    row = good.loc[good["cost"].idxmin()]
    return Best(float(row["cost"]), float(row["error"]), int(row["n"]), str(row["rule"]))


def summary(rows: pandas.DataFrame) -> pandas.DataFrame:
    """A row for each scene, quantity, aspect ratio and error: who is cheapest, by how many times; the
    least error of either method where it does not get there."""
    result = []
    for scene, quantity in charts_of(rows):
        part = standing(rows[(rows["scene"] == scene) & (rows["quantity"] == quantity)])
        for aspect in sorted(part["lambda"].unique()):
            here = part[part["lambda"] == aspect]
            least = {m: here.loc[here["method"] == m, "error"].min()
                     for m in ("rods", "multisphere")}
            for level in levels_of(scene):
                ours, theirs = (cheapest(here, m, level) for m in ("rods", "multisphere"))
                row = {"scene": scene, "quantity": quantity, "lambda": aspect, "error": level}
                for name, best in (("rods", ours), ("multisphere", theirs)):
                    row |= {f"{name}_cost": best.cost if best else np.nan,
                            f"{name}_rule": best.rule if best else "",
                            f"{name}_least_error": least[name]}
                row["multisphere_n"] = theirs.n if theirs else 0
                row["rods_are_cheaper"] = theirs.cost / ours.cost if ours and theirs else np.nan
                row["cheapest"] = verdict(ours, theirs)
                result.append(row)
    return pandas.DataFrame(result)


def verdict(ours: Best | None, theirs: Best | None) -> str:
    if ours is None and theirs is None:
        return "neither"
    if ours is None or (theirs is not None and theirs.cost < ours.cost):
        return "multisphere"
    return "rods"


def times(ratio: float) -> str:
    """Three digits at most: 0.8, 4.2, 37, 1200."""
    if ratio >= 100:
        return f"{float(f'{ratio:.2g}'):.0f}"
    return f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.2g}"


def words(row) -> str:
    """What the summary says of one error, for a table."""
    if row["cheapest"] == "neither":
        return "neither"
    if row["cheapest"] == "multisphere":
        if not np.isfinite(row["rods_are_cheaper"]):
            return f"only spheres, n = {row['multisphere_n']:.0f}"
        return f"spheres, n = {row['multisphere_n']:.0f}, {times(1.0 / row['rods_are_cheaper'])} ×"
    if not np.isfinite(row["rods_are_cheaper"]):
        return "only rods"
    return f"rods {times(row['rods_are_cheaper'])} × (n = {row['multisphere_n']:.0f})"


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


def draw_front(axes, rows: pandas.DataFrame, method: str, label: bool, floor: float) -> None:
    """The front of a method as a stair: what is reached at a cost."""
    part = rows[rows["method"] == method]
    if part.empty:
        return
    front = part.iloc[pareto_front(part["cost"], part["error"])]
    colour = plots.COLOURS[ROD_COLOUR if method == "rods" else "vermilion"]
    axes.step(front["cost"], np.maximum(front["error"], floor), where="post", color=colour,
              linewidth=1.6, alpha=0.75, linestyle="-" if method == "rods" else (0, (5, 2)), zorder=2)
    if not label:
        return
    named = set()
    for _, row in front.iterrows():
        name = "rods" if method == "rods" else f"n={row['n']:.0f}"
        if name not in named:
            axes.annotate(name, (row["cost"], max(row["error"], floor)), xytext=(3, 3),
                          textcoords="offset points", fontsize=6.5,
                          color=plots.for_letters(colour))
        named.add(name)


def draw_panel(axes, rows: pandas.DataFrame, aspect: float, *, points: bool = True,
               label: bool = True, floor: float = 1e-5, room: float = 1.0) -> None:
    """Error against cost of one scene and aspect ratio. Errors below `floor` are drawn at it; the axis
    ends at `room` times 150 %."""
    rows = standing(rows)
    if points:
        for (method, n, rule), part in rows.groupby(["method", "n", "rule"]):
            style = style_of(method, int(n), rule, aspect)
            error = np.maximum(part["error"], floor)
            bars = [np.clip(error - part["error_low"], 0, 0.999 * error),
                    np.clip(part["error_high"] - error, 0, None)]
            sideways = [np.clip(part["cost"] - part["cost_min"], 0, None),
                        np.clip(part["cost_max"] - part["cost"], 0, None)]
            axes.errorbar(part["cost"], error, yerr=bars, xerr=sideways, linestyle="none",
                          markersize=3.2, elinewidth=0.5, alpha=0.8, zorder=3,
                          rasterized=True, **style)  # thousands of points make an SVG large
    for method in ("multisphere", "rods"):
        draw_front(axes, rows, method, label, floor)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(0.5 * floor, 1.5 * room)
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(True, which="major", linewidth=0.4, alpha=0.5)


def note(axes, table: pandas.DataFrame) -> None:
    """In a corner: at which cost the errors are had."""
    lines = [f"{percent(row['error'])} %: {words(row)}" for _, row in table.iterrows()]
    axes.text(0.985, 0.98, "\n".join(lines), transform=axes.transAxes, ha="right", va="top",
              fontsize=6.2, linespacing=1.25,
              bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 1.5})


def legend_of(figure, rules: set[str]) -> None:
    from matplotlib.lines import Line2D
    entries = []
    names = {"spread": "rods, spread contact", "single": "rods, single contact"}
    entries += [Line2D([], [], linestyle="none", markersize=4, label=names[rule],
                       **style_of("rods", 0, rule, 10)) for rule in names if rule in rules]
    for k, spacing in enumerate(("2r", "r", "r/2", "r/4")):
        entries.append(Line2D([], [], linestyle="none", markersize=4, label=f"spheres every {spacing}",
                              **style_of("multisphere", 1 + 2**k * 9, "adapted", 10)))
    entries.append(Line2D([], [], linestyle="none", markersize=4, label="hollow: nominal",
                          **style_of("multisphere", 10, "nominal", 10)))
    room = 13.0 / 25.4 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0.0, room, 1.0, 1.0 - room))
    figure.legend(handles=entries, loc="lower center", ncols=4, fontsize=7, frameon=False)


def chart(rows: pandas.DataFrame, scene: str, quantity: str, stem: Path | str) -> None:
    """The chart of one scene, a panel an aspect ratio."""
    part = rows[(rows["scene"] == scene) & (rows["quantity"] == quantity)]
    aspects = sorted(part["lambda"].unique())
    columns = min(2, len(aspects))
    lines = -(-len(aspects) // columns)
    figure, axes = plots.new_figure(180, 68 * lines + 22, lines, columns, squeeze=False,
                                    sharey=True)
    figure.set_layout_engine("constrained")
    table = summary(part)
    floor = floor_of(part)
    for k, aspect in enumerate(aspects):
        panel = axes[k // columns][k % columns]
        draw_panel(panel, part[part["lambda"] == aspect], aspect, floor=floor,
                   room=10.0)
        panel.set_title(f"λ = {aspect:g}", fontsize=9)
        note(panel, table[table["lambda"] == aspect])
    for panel in axes.flat[len(aspects):]:
        panel.set_axis_off()
    for panel in axes[:, 0]:
        panel.set_ylabel(f"error of the {QUANTITIES.get(quantity, quantity)}", fontsize=8)
    for k in range(columns):
        axes[-1][k].set_xlabel(cost_label(scene), fontsize=8)
    figure.suptitle(title_of(scene, quantity), fontsize=10)
    legend_of(figure, set(part["rule"]))
    plots.save(figure, stem)


def cost_label(scene: str) -> str:
    if is_bed(scene):
        return "core seconds to a bed at rest"
    return "core seconds a simulated second and copy"


def floor_of(rows: pandas.DataFrame) -> float:
    """What is below it is drawn on it: a decade below the least error of glued spheres or 10⁻⁴."""
    good = standing(rows)
    theirs = good.loc[good["method"] == "multisphere", "error"].min()
    lowest = min(1e-3, theirs if np.isfinite(theirs) else 1e-3)
    return max(1e-8, 10.0 ** np.floor(np.log10(lowest) - 1.0), 0.5 * good["error"].min())


def combined(rows: pandas.DataFrame, aspect: float, stem: Path | str) -> None:
    """Small multiples: the fronts of all scenes at one aspect ratio (beds: at the nearest)."""
    charts = [c for c in charts_of(standing(rows))
              if not (c[0] == "precession" and c[1] == "energy")]
    columns = 4
    lines = -(-len(charts) // columns)
    figure, axes = plots.new_figure(220, 47 * lines + 14, lines, columns, squeeze=False)
    figure.set_layout_engine("constrained")
    for panel, (scene, quantity) in zip(axes.flat, charts):
        part = rows[(rows["scene"] == scene) & (rows["quantity"] == quantity)]
        nearest = min(part["lambda"].unique(), key=lambda a: abs(np.log(a / aspect)))
        here = part[part["lambda"] == nearest]
        draw_panel(panel, here, nearest, floor=1e-4 if not is_bed(scene) else 1e-3)
        shown = f", λ = {nearest:g}" if nearest != aspect else ""
        panel.set_title(title_of(scene, quantity) + shown, fontsize=8)
        panel.tick_params(labelsize=6.5)
    for panel in axes.flat[len(charts):]:
        panel.set_axis_off()
    for panel in axes[:, 0]:
        panel.set_ylabel("error", fontsize=7.5)
    for k in range(columns):
        below = [(panel, scene) for panel, (scene, _) in list(zip(axes.flat, charts))[k::columns]]
        if below:
            below[-1][0].set_xlabel("core seconds" if is_bed(below[-1][1]) else
                                    "core seconds a simulated second", fontsize=7)
    legend_of(figure, set(rows["rule"]))
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
