# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures: all effects, friction, what is a number, all beds against random contacts, walls."""
from __future__ import annotations

from pathlib import Path

import numpy
import pandas

from studies.common import plots
from studies.common.statistics import mean_and_error
from studies.sensitivity import variations

DRAWN = ("effects", "friction", "numbers", "contacts", "walls")
C = plots.COLOURS
# Series of the figure of friction: factor, words, colour, marker, and whether the base case is one of
# its points.
FRICTIONS = [("friction", "rods and walls", C["vermilion"], "s", True),
             ("friction_of_rods", "rods alone, walls as the base", C["green"], "D", True),
             ("friction_of_walls", "walls alone, rods as the base", C["purple"], "^", True),
             ("friction_with_limits", "rods and walls, study's limits on ω", C["blue"], "o", False)]
# Panels of the figure of numbers: factor, label of its axis, the column of beds.csv that is drawn
# there, and whether the axis is logarithmic.
NUMBERS = [("stiffness", "mean overlap / D", "overlap_mean", True),
           ("restitution", "restitution", "value", False),
           ("drop_height", "height over which rods start (m)", "value", False),
           ("taps", "taps", "value", False),
           ("vessel", "rod lengths across the vessel", "lengths_wide", False),
           ("depth", "number of rods / base", "value", False)]
# Values of the base case where they are drawn; those of overlap and width are its beds' own.
BASE_VALUES = {"restitution": 0.5, "drop_height": 10.0, "taps": 0.0, "depth": 1.0, "friction": 0.2,
               "friction_of_rods": 0.2, "friction_of_walls": 0.2}


def level_name(factor: str, level: str) -> str:
    return f"{factor}: {level}".replace("_", " ")


def mean_points(beds: pandas.DataFrame, column: str) -> list[tuple[float, float, float]]:
    """x, mean V_f of the inner cylinder over 2 ln λ/λ, and its error, of each level."""
    points = []
    for _, part in beds.groupby(["factor", "level"]):
        mean, error = mean_and_error(part["vf_inner"] / part["vf_parkhouse_kelly"])
        points.append((float(part[column].mean()), mean, error))
    return sorted(points)


def with_base(beds: pandas.DataFrame, factor: str, base: bool = True) -> pandas.DataFrame:
    """Beds of a factor, and those of the base case at their value of it."""
    own = beds[beds["factor"] == factor]
    if not base or not len(own):
        return own
    common = beds[beds["factor"] == variations.BASE].assign(
        value=BASE_VALUES.get(factor, numpy.nan))
    return pandas.concat([own, common])


def line(axes, points, **style) -> None:
    if points:
        x, y, errors = zip(*points)
        axes.errorbar(x, y, plots.errors(errors), linewidth=1.1, markersize=4.5, **style)


def effects_figure(effects: pandas.DataFrame):
    """Difference of V_f of the inner cylinder, all λ together, a line a level."""
    part = effects[(effects["quantity"] == "vf_inner") & (effects["lambda"] == 0)]
    figure, axes = plots.new_figure(160, 25 + 4.6 * max(4, len(part)))
    for row, one in enumerate(part.to_dict("records")):
        colour = C["vermilion"] if one["differs"] else C["grey"]
        axes.errorbar([100 * one["difference"]], [row], marker="o", markersize=4, color=colour,
                      xerr=[[100 * (one["difference"] - one["low"])],
                            [100 * (one["high"] - one["difference"])]])
    axes.axvline(0.0, color=C["grey"], linewidth=0.7)
    names = [level_name(*key) for key in zip(part["factor"], part["level"])]
    axes.set_yticks(range(len(part)), names, fontsize=7.5)
    axes.set_ylim(len(part) - 0.4, -0.6)
    axes.grid(True, axis="x")
    axes.set_xlabel("difference of V_f of the inner cylinder from the base case (%), 95 % interval")
    return figure


def friction_figure(beds: pandas.DataFrame):
    aspects = sorted(beds["lambda"].unique())
    figure, all_axes = plots.new_figure(170, 80, 1, len(aspects), sharey=True, squeeze=False)
    for axes, aspect in zip(all_axes[0], aspects):
        for factor, words, colour, marker, base in FRICTIONS:
            part = with_base(beds[beds["lambda"] == aspect], factor, base)
            line(axes, mean_points(part, "value"), color=colour, marker=marker, label=words)
        axes.axhline(1.0, color=C["black"], linewidth=0.8)
        axes.set(title=f"λ = {aspect:g}", xlabel="coefficient of friction")
        axes.grid(True)
    all_axes[0][0].set_ylabel("V_f of the inner cylinder over 2 ln λ/λ")
    all_axes[0][0].set_ylim(bottom=0)   # room for the key
    all_axes[0][-1].legend(loc="lower left", fontsize=6.5)
    return figure


def numbers_figure(beds: pandas.DataFrame):
    # Softened or stiff from the first on: one axis, the overlap.
    beds = beds.assign(factor=beds["factor"].replace("softened", "stiffness"))
    there = set(beds["factor"])
    panels = [panel for panel in NUMBERS if panel[0] in there] or NUMBERS[:1]
    columns = min(3, len(panels))
    lines = -(-len(panels) // columns)
    figure, all_axes = plots.new_figure(170, 12 + 58 * lines, lines, columns, sharey=True,
                                        squeeze=False)
    flat = list(all_axes.flat)
    for axes in flat[len(panels):]:
        axes.set_visible(False)
    for axes, (factor, words, column, logarithmic) in zip(flat, panels):
        for i, (aspect, of_aspect) in enumerate(with_base(beds, factor).groupby("lambda")):
            line(axes, mean_points(of_aspect, column), color=plots.CYCLE[i], marker=plots.MARKERS[i],
                 label=f"λ = {aspect:g}")
        if logarithmic:
            axes.set_xscale("log")
        axes.set_xlabel(words, fontsize=8)
        axes.axhline(1.0, color=C["black"], linewidth=0.8)
        axes.grid(True)
    for axes in all_axes[:, 0]:
        axes.set_ylabel("V_f inner over 2 ln λ/λ", fontsize=8)
    flat[0].legend()
    return figure


def contacts_figure(beds: pandas.DataFrame):
    """V_f λ against contacts a rod, and V_f against random contacts at the beds' own number and
    orientation; a point a bed."""
    figure, (left, right) = plots.new_figure(170, 85, 1, 2)
    for i, (aspect, part) in enumerate(beds.groupby("lambda")):
        style = {"color": plots.CYCLE[i], "marker": plots.MARKERS[i], "linestyle": "none",
                 "markersize": 3, "label": f"λ = {aspect:g}"}
        left.plot(part["contacts"], part["vf_inner"] * aspect, **style)
        right.plot(variations.expected(part), part["vf_inner"], **style)
    top = 1.05 * max(beds["vf_inner"].max(), variations.expected(beds).max())
    right.plot([0, top], [0, top], color=C["black"], linewidth=0.8)
    left.set(xlabel="contacts a rod", ylabel="V_f of the inner cylinder times λ")
    right.set(xlabel="V_f by the random contact equation", ylabel="V_f of the inner cylinder",
              xlim=(0, top), ylim=(0, top))
    left.legend()
    for axes in (left, right):
        axes.grid(True)
    return figure


def walls_figure(walls: pandas.DataFrame):
    """V_f by distance from the nearer of wall and floor, over rod lengths, a line a width of the
    vessel."""
    aspects = sorted(walls["lambda"].unique())
    figure, all_axes = plots.new_figure(170, 75, 1, len(aspects), squeeze=False)
    for axes, aspect in zip(all_axes[0], aspects):
        for i, (wide, part) in enumerate(walls[walls["lambda"] == aspect].groupby("lengths_wide")):
            groups = part.groupby("low")
            middle = [(low + of_bin["high"].mean()) / 2 for low, of_bin in groups]
            points = [(x, *mean_and_error(of_bin["vf"])) for x, (_, of_bin) in zip(middle, groups)]
            line(axes, points, color=plots.CYCLE[i % len(plots.CYCLE)],
                 marker=plots.MARKERS[i % len(plots.MARKERS)], label=f"{wide:.2g} lengths wide")
        axes.set(title=f"λ = {aspect:g}", xlabel="distance / rod length")
        axes.set_ylim(bottom=0)
        axes.axvline(0.5, color=C["grey"], linewidth=0.7)
        axes.grid(True)
    all_axes[0][0].set_ylabel("V_f")
    all_axes[0][-1].legend(loc="lower right", fontsize=6.5)
    return figure


def draw_all(beds: pandas.DataFrame, walls: pandas.DataFrame, effects: pandas.DataFrame,
             folder: Path) -> None:
    for name, figure in (("effects", effects_figure(effects)), ("friction", friction_figure(beds)),
                         ("numbers", numbers_figure(beds)), ("contacts", contacts_figure(beds)),
                         ("walls", walls_figure(walls))):
        plots.save(figure, folder / name)
