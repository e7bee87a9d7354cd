# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of the features' costs and of the equivalence of beds."""
from __future__ import annotations

from pathlib import Path

import pandas

from studies.common import plots
from studies.minimal.advice import QUANTITIES
from studies.minimal.features import SCENES


def features(table: pandas.DataFrame, stem: Path | str) -> None:
    """Instructions of a step against those of the scene as it is, a panel a scene."""
    scenes = list(dict.fromkeys(table["scene"]))
    heights = [max(2, (table["scene"] == s).sum()) for s in scenes]
    figure, axes = plots.new_figure(160, 12 + 6.2 * sum(heights) + 9 * len(scenes), len(scenes), 1,
                                    sharex=True, squeeze=False, height_ratios=heights)
    for panel, scene in zip(axes[:, 0], scenes):
        part = table[table["scene"] == scene]
        rows = range(len(part))
        ratio = part["instructions_times"]
        colours = [plots.COLOURS["black"] if c == "as it is" else
                   plots.COLOURS["blue"] if r <= 1 else plots.COLOURS["vermilion"]
                   for c, r in zip(part["change"], ratio)]
        panel.hlines(rows, 1.0, ratio, colors=colours, linewidth=1.2)
        panel.scatter(ratio, rows, c=colours, s=16, zorder=3)
        if "times" in part and part["times"].notna().any():
            panel.scatter(part["times"], rows, marker="|", s=60, color=plots.COLOURS["orange"],
                          zorder=2)
        panel.set_yticks(rows, part["change"], fontsize=7.5)
        panel.set_ylim(len(part) - 0.4, -0.6)
        panel.axvline(1.0, color=plots.COLOURS["grey"], linewidth=0.7)
        panel.grid(True, axis="x")
        panel.set_title(SCENES[scene]["title"], loc="left", fontsize=8.5)
    timed = "; bars: time" if "times" in table else ""
    axes[-1][0].set_xlabel(f"dots: instructions of a step over those of the scene as it is{timed}\n"
                           "(blue: not more, red: more)", fontsize=8)
    plots.save(figure, stem)


def equivalence(table: pandas.DataFrame, stem: Path | str) -> None:
    """Difference of quick 1 from the default with its interval, and the bound; a line of panels for
    each kind of limits."""
    names, kinds = list(QUANTITIES), list(dict.fromkeys(table["limits"]))
    figure, axes = plots.new_figure(170, 14 + 46 * len(kinds), len(kinds), len(names), sharey=True,
                                    sharex="col", squeeze=False)
    aspects = sorted(table["lambda"].unique(), key=lambda a: a or float("inf"))
    for panel, name in zip(axes[0], names):
        panel.set_title(QUANTITIES[name], fontsize=8)
    for line, limits in zip(axes, kinds):
        for panel, name in zip(line, names):
            part = table[(table["quantity"] == name) & (table["limits"] == limits)]
            draw_equivalence(panel, part.set_index("lambda"), aspects)
        line[0].set_ylabel(f"limits: {limits}", fontsize=8)
        line[0].set_yticks(range(len(aspects)),
                           [f"λ = {a:g}" if a else "together" for a in aspects])
    for panel in axes[-1]:
        panel.set_xlabel("difference (%)\nblack: paired", fontsize=8)
    plots.save(figure, stem)


def draw_equivalence(panel, part: pandas.DataFrame, aspects: list[float]) -> None:
    bound = 100 * part["bound"].iloc[0] if len(part) else 0.0
    panel.axvspan(-bound, bound, color=plots.COLOURS["green"], alpha=0.13, linewidth=0)
    panel.axvline(0.0, color=plots.COLOURS["grey"], linewidth=0.7)
    for row, aspect in enumerate(aspects):
        if aspect not in part.index:
            continue
        d = 100 * part.loc[aspect, ["difference", "low", "high"]].astype(float)
        colour = plots.COLOURS["blue" if part.loc[aspect, "equivalent"] else "vermilion"]
        paired = 100 * part.loc[aspect, ["paired_low", "paired_high"]].astype(float)
        panel.plot(paired, [row + 0.22] * 2, color=plots.COLOURS["black"], linewidth=1.0)
        panel.errorbar([d["difference"]], [row],
                       xerr=[[d["difference"] - d["low"]], [d["high"] - d["difference"]]],
                       marker="o", markersize=4, color=colour)
    panel.set_ylim(len(aspects) - 0.5, -0.5)
