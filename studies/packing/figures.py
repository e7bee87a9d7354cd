# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures 3 and 4: solid fraction against aspect ratio, distribution of the elevation."""
from __future__ import annotations

import numpy
import pandas

from studies.common import plots
from studies.packing import measures

C = plots.COLOURS
LIMITS = {"study": "limits of the study on ω", "none": "no limit on ω"}
STYLE_OF_LIMITS = {"study": (C["blue"], "o"), "none": (C["vermilion"], "s")}
LARGEST_ASPECT = 40


def beds_in_words(counts) -> str:
    least, most = min(counts), max(counts)
    if least != most:
        return f"{least} to {most} beds"
    return "one bed" if most == 1 else f"{most} beds"


def limits_of(means: pandas.DataFrame) -> list[str]:
    return [limits for limits in LIMITS if limits in set(means["limits"])]


def kinds_of(means: pandas.DataFrame) -> list[tuple[float, str]]:
    """Friction and limits of the kinds of beds there are, the study's friction first."""
    there = set(zip(means["friction"], means["limits"]))
    return sorted(there, key=lambda kind: (kind[0] != measures.STUDY_FRICTION, kind[0],
                                           list(LIMITS).index(kind[1])))


def kind_name(friction: float, limits: str) -> str:
    return f"{LIMITS[limits]}, friction {friction:g}"


def picture(friction, limits: str, cut: str = "") -> str:
    """The file of a bed's picture."""
    return f"figure2_friction{float(friction):g}_{limits}{cut}.png"


def of_kind(means: pandas.DataFrame, friction: float, limits: str) -> pandas.DataFrame:
    return means[(means["friction"] == friction) & (means["limits"] == limits)]


def spread(heights: list[float], apart: float) -> list[float]:
    """The heights moved up until they are `apart`, in their order from below."""
    placed: dict[int, float] = {}
    floor = -numpy.inf
    for i in sorted(range(len(heights)), key=heights.__getitem__):
        placed[i] = max(heights[i], floor)
        floor = placed[i] + apart
    return [placed[i] for i in range(len(heights))]


def theory_curves(largest: float) -> list[tuple]:
    """Name, λ, V_f, colour, dashes."""
    def random(sin_gamma):
        x = numpy.linspace(measures.RANDOM_CONTACTS_FROM, largest, 200)
        return x, measures.random_contacts(x, sin_gamma)
    x = numpy.linspace(measures.PARKHOUSE_KELLY_FROM, largest, 200)
    return [("Parkhouse & Kelly", x, measures.parkhouse_kelly(x), C["black"], plots.DASHES[0]),
            ("random, horizontal", *random(measures.HORIZONTAL_SIN_GAMMA), C["green"],
             plots.DASHES[1]),
            ("random, isotropic", *random(measures.ISOTROPIC_SIN_GAMMA), C["purple"],
             plots.DASHES[3])]


def expected_curve(kind: pandas.DataFrame) -> tuple:
    """Random contacts for the beds' own <|sin γ|>, which is taken as linear in λ between them."""
    kind = kind[kind["vf_expected"].notna()].sort_values("lambda")
    if len(kind) < 2:
        return numpy.array([]), numpy.array([])
    x = numpy.linspace(kind["lambda"].min(), kind["lambda"].max(), 200)
    return x, measures.random_contacts(x, numpy.interp(x, kind["lambda"], kind["mean_sin_gamma"]))


def packing_figure(means: pandas.DataFrame, literature: pandas.DataFrame):
    """The figure, and a sentence for each published value beyond its axes."""
    largest = max(LARGEST_ASPECT, 1.1 * means["lambda"].max())
    figure, axes = plots.new_figure(165, 110)
    axes.set(xlim=(0, largest), ylim=(0, 0.8), xlabel="aspect ratio λ = total length / diameter",
             ylabel="solid volume fraction")

    curves = theory_curves(largest)
    heights = spread([fractions[-1] for _, _, fractions, _, _ in curves], 0.031)
    for (name, x, fractions, colour, dashes), height in zip(curves, heights):
        axes.plot(x, fractions, color=colour, linestyle=dashes, zorder=1)
        axes.text(1.012 * largest, height, name, color=plots.for_letters(colour), va="center",
                  fontsize=8)

    for friction, limits in kinds_of(means):
        kind = of_kind(means, friction, limits)
        colour, marker = STYLE_OF_LIMITS[limits]
        filled = {} if friction == measures.STUDY_FRICTION else {"markerfacecolor": "white"}
        axes.plot(*expected_curve(kind), color=colour, linestyle=plots.DASHES[2], linewidth=1.1,
                  zorder=1)
        axes.plot(kind["lambda"], kind["vf_expected"], linestyle="none", marker="_", markersize=13,
                  markeredgewidth=2, color=colour, zorder=2)
        axes.errorbar(kind["lambda"], kind["vf_inner"], plots.errors(kind["vf_inner_error"]), linestyle="none",
                      marker=marker, color=colour, zorder=3, **filled,
                      label=f"{kind_name(friction, limits)}, {beds_in_words(kind['beds'])}"
                            f"{' each' if len(kind) > 1 else ''}")
    expected, = axes.plot([], [], linestyle=plots.DASHES[2], marker="_", markersize=11, markeredgewidth=2,
                          color=C["black"], linewidth=1.1)
    own_handles, own_labels = axes.get_legend_handles_labels()

    left_out = []
    for i, (label, points) in enumerate(literature.groupby("label", sort=False)):
        inside = (points["lambda"] <= largest) & (points["vf"] <= 0.8)
        for _, point in points[~inside].iterrows():
            left_out.append(f"{label} at λ = {point['lambda']:g}, V_f = {point['vf']:g} is beyond "
                            f"the axes")
        if inside.any():
            points = points[inside]
            axes.errorbar(points["lambda"], points["vf"], plots.errors(points["vf_error"]),
                          linestyle="none", marker=["^", "D", "v", "P"][i % 4], color=C["grey"], label=label)
    handles, labels = axes.get_legend_handles_labels()
    n = len(own_handles)
    axes.legend([*handles[:n], expected, *handles[n:]],
                [*labels[:n], "random contacts at these beds' orientation", *labels[n:]],
                loc="upper right")
    return figure, left_out


def elevation_figure(means: pandas.DataFrame):
    """Rods per solid angle over that of isotropic rods; a panel for each friction and limits, a line of
    them for each friction."""
    kinds = kinds_of(means)
    frictions = list(dict.fromkeys(friction for friction, _ in kinds))
    columns = len(limits_of(means))
    aspects = sorted(means["lambda"].unique())
    figure, all_axes = plots.new_figure(165 if columns > 1 else 100, 95 * len(frictions),
                                        len(frictions), columns, sharey=True, squeeze=False)
    for axes in all_axes.flat:   # of kinds that are not there
        axes.set_visible(False)
    for friction, limits in kinds:
        axes = all_axes[frictions.index(friction)][limits_of(means).index(limits)]
        axes.set_visible(True)
        panel = of_kind(means, friction, limits)
        widest = panel.loc[panel["isotropic_scatter"].idxmax()]
        scatter = widest["isotropic_scatter"]
        axes.axhspan(1 - scatter, 1 + scatter, color=C["grey"], alpha=0.25, linewidth=0, zorder=0)
        axes.axhline(1, color=C["grey"], linestyle=plots.DASHES[1], linewidth=1, zorder=0)
        axes.text(0.99, 1 + scatter + 0.05, f"±1 s.d. of {widest['isotropic_rods']:.0f} isotropic "
                  "rods", ha="right", color=plots.for_letters(C["grey"]), fontsize=8)
        for aspect, kind in panel.groupby("lambda"):
            i = aspects.index(aspect)
            low, high = (numpy.sin(numpy.radians(kind[name])) for name in ("low_deg", "high_deg"))
            # Error bars of several kinds stand beside each other.
            x = (low + high) / 2 + 0.006 * (i - (len(aspects) - 1) / 2)
            axes.errorbar(x, kind["density"], plots.errors(kind["error"]), color=plots.CYCLE[i],
                          marker=plots.MARKERS[i], linewidth=1.1, markersize=4.5,
                          label=f"λ = {aspect:g}, {beds_in_words(kind['beds'])}")
        ticks = [0, 10, 20, 30, 40, 50, 60, 90]
        axes.set_xticks(numpy.sin(numpy.radians(ticks)), [f"{t}°" for t in ticks])
        axes.set(xlim=(0, 1), title=kind_name(friction, limits),
                 xlabel="elevation (equal lengths: equal solid angle)")
        axes.legend(loc="upper right")
    tops = (means["density"] + means["error"].fillna(0)).max()
    for line in all_axes:
        line[0].set(ylim=(0, 1.05 * max(tops, 1.5)), ylabel="rods per solid angle / isotropic")
    return figure
