# SPDX-License-Identifier: GPL-2.0-or-later
"""A figure for each experiment: ours, theirs, error bars."""
from __future__ import annotations

from pathlib import Path

import numpy
import pandas
from matplotlib import ticker

from studies.common import plots
from studies.experiments import measures, page

C, CYCLE, MARKERS = plots.COLOURS, plots.CYCLE, plots.MARKERS


def draw(experiment: str, table: pandas.DataFrame, literature: pandas.DataFrame,
         stem: Path | str) -> None:
    theirs = literature[literature["experiment"] == experiment].set_index("quantity")
    plots.save(globals()[f"{experiment}_figure"](table, theirs), stem)


def number(theirs, quantity) -> float:
    return float(theirs.loc[quantity, "value"])


def points(axes, x, y, errors, **style):
    axes.errorbar(x, y, plots.errors(errors), linestyle="none", capsize=2, **style)


def legend_below(axes, columns: int) -> None:
    axes.legend(fontsize=6.5, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=columns)


def plain_numbers(*axes) -> None:
    """On logarithmic axes of less than a decade or two: 0.5, 1, 2."""
    for axis in axes:
        axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        axis.set_minor_formatter(ticker.NullFormatter())


def contacts_figure(table, theirs):
    found = page.contacts(table)
    figure, (left, right) = plots.new_figure(170, 105, 1, 2)
    plain = found[(found["method"] == "rods") & (found["limits"] == "none")]
    frictions = sorted(found["friction"].unique())
    for n, (aspect, kind) in enumerate(plain.groupby("lambda")):
        x = [frictions.index(f) + 0.12 * (n - 1) for f in kind["friction"]]
        points(left, x, kind["contacts"], kind["contacts_error"], color=CYCLE[n], marker=MARKERS[n],
               label=f"λ = {aspect:g}, counted")
        points(left, x, kind["contacts_inside"], kind["contacts_inside_error"], color=CYCLE[n],
               marker="_", markersize=9, label="counted inside" if n == 0 else None)
        points(left, x, kind["implied"], kind["implied_error"], color=CYCLE[n], marker=MARKERS[n],
               markerfacecolor="white", label="implied by V$_f$" if n == 0 else None)
    others = found[(found["method"] != "rods") | (found["limits"] != "none")]
    for n, ((method, limits), kind) in enumerate(others.groupby(["method", "limits"])):
        x = [frictions.index(f) + 0.3 for f in kind["friction"]]
        points(left, x, kind["contacts"], kind["contacts_error"], color=C["grey"],
               marker=MARKERS[3 + n],
               label="rods, limits on ω" if method == "rods" else method)
    measured = number(theirs, "contacts")
    implied = 2 * number(theirs, "half_contacts")
    for value, text in ((page.MANY_CONTACTS, "counting: without friction"),
                        (page.FEW_CONTACTS, "counting: fewest with friction")):
        left.axhline(value, color=C["black"], linestyle=plots.DASHES[1], linewidth=0.8)
        left.text(-0.4, value + 0.08, text, fontsize=7)
    left.axhline(implied, color=C["grey"], linewidth=0.8)
    left.text(-0.4, implied + 0.08, "experiment: implied by V$_f$", fontsize=7)
    left.axhline(measured, color=C["grey"], linewidth=0.8)
    left.text(-0.4, measured - 0.32, "experiment: measured", fontsize=7)
    left.set(xticks=range(len(frictions)), xticklabels=[f"{f:g}" for f in frictions],
             xlim=(-0.5, len(frictions) - 0.4), ylim=(3.5, 11.5), xlabel="friction",
             ylabel="contacts a rod")
    legend_below(left, 2)

    gaps = page.gaps_of(table)
    longest = plain[plain["lambda"] == plain["lambda"].max()]
    for n, row in enumerate(longest.to_dict("records")):
        right.errorbar(gaps, [row[f"nearer_{g:g}"] for g in gaps],
                       plots.errors([row[f"nearer_{g:g}_error"] for g in gaps]), color=CYCLE[n],
                       marker=MARKERS[n], label=f"friction {row['friction']:g}")
    right.axhline(measured, color=C["grey"], linewidth=0.8)
    right.set(xscale="log", xlabel="gap below which rods count as touching (D)",
              ylabel=f"rods so near, λ = {plain['lambda'].max():g}")
    legend_below(right, 2)
    return figure


def wall_figure(table, theirs):
    figure, (left, right) = plots.new_figure(165, 80, 1, 2)
    x = numpy.linspace(0.001, 1.9, 300)
    left.plot(x, measures.beside_a_wall(x), color=C["grey"], linestyle=plots.DASHES[1],
              label="rods thrown at random")
    for n, aspect in enumerate(sorted(table["lambda"].unique())):
        profile = page.wall_profile(table, aspect, "vf")
        core = profile.loc[profile["distance"] >= 1, "value"].mean()
        left.errorbar(profile["distance"], profile["value"] / core,
                      plots.errors(profile["value_error"] / core), color=CYCLE[n],
                      marker=MARKERS[n], markersize=4, label=f"λ = {aspect:g}")
        order = page.wall_profile(table, aspect, "radial_order")
        right.errorbar(order["distance"], order["value"], plots.errors(order["value_error"]),
                       color=CYCLE[n], marker=MARKERS[n], markersize=4, label=f"λ = {aspect:g}")
    for axes in (left, right):
        axes.axvline(number(theirs, "layer"), color=C["black"], linewidth=0.8,
                     linestyle=plots.DASHES[2])
        axes.set(xlabel="distance from the side / length of a rod", xlim=(0, 2.1))
    left.text(number(theirs, "layer") + 0.03, 0.03, "Freeman et al.", fontsize=8)
    right.plot(x, measures.order_beside_a_wall(x), color=C["grey"], linestyle=plots.DASHES[1])
    left.set(ylabel="V$_f$ / that of the core", ylim=(0, None))
    right.set(ylabel="radial order: −1 along the wall", ylim=(-1.05, 1))
    left.legend(loc="center right")
    return figure


def collapse_figure(table, theirs):
    figure, (left, right) = plots.new_figure(170, 105, 1, 2)
    low, high = number(theirs, "solid_below"), number(theirs, "falls_above")
    left.plot([0, low, high, 2], [0, 0, 1, 1], color=C["black"], label="experiment, λ < 24")
    aspects, frictions = (sorted(table[name].unique()) for name in ("lambda", "friction"))

    def style(aspect, friction):
        return {"color": CYCLE[frictions.index(friction) % 7],
                "marker": MARKERS[aspects.index(aspect) % 7], "markersize": 5}

    parts = page.probability(table).groupby(["limits", "lambda", "friction"])
    for n, (case, kind) in enumerate(parts):
        limits, aspect, friction = case
        free = limits == "none"
        name = f"λ = {aspect:g}, friction {friction:g}" + ("" if free else ", limits on ω")
        points(left, kind["height"] + 0.008 * n, kind["part"],
               [kind["part"] - kind["low"], kind["high"] - kind["part"]], label=name,
               elinewidth=0.8, **(style(aspect, friction) if free else
                                  {"color": C["black"], "marker": "X", "markersize": 5}))
    left.set(xlabel="height of the column / length of a rod",
             ylabel="part of the columns that collapse", xlim=(0, 1.6), ylim=(-0.05, 1.05))
    legend_below(left, 2)

    fallen = page.run_out(table)
    for (aspect, friction, radius), kind in fallen.groupby(["lambda", "friction", "radius"]):
        usual = radius == table["radius"].mode().iloc[0]
        right.plot(kind["ratio"], kind["run_out"], linestyle="none", **style(aspect, friction),
                   **({} if usual else {"markerfacecolor": "white"}),
                   label=None if usual else
                   f"λ = {aspect:g}, friction {friction:g}, R = {radius:g} L")
    if len(fallen):
        middle = float(numpy.exp(numpy.log(fallen["ratio"]).mean()))
        level = float(numpy.exp(numpy.log(fallen["run_out"]).mean()))
        for quantity, ends in (("exponent_low", (0.4, 1)), ("exponent_high", (1, 3))):
            n = number(theirs, quantity)
            x = numpy.array(ends) * middle
            right.plot(x, level * (x / middle) ** n, color=C["black"],
                       linestyle=plots.DASHES[0 if quantity == "exponent_low" else 1],
                       label=f"experiment: slope {n:g}")
    right.set(xscale="log", yscale="log", xlabel="height / radius of the column",
              ylabel="run-out $(r_f - r_i)/r_i$")
    plain_numbers(right.xaxis, right.yaxis)
    legend_below(right, 1)
    return figure


def standing_figure(table, theirs):
    figure, axes = plots.new_figure(125, 85)
    for n, (friction, kind) in enumerate(page.standing(table).groupby("friction")):
        points(axes, kind["lambda"] + 0.4 * (n - 1), kind["lost"], kind["lost_error"],
               color=CYCLE[n], marker=MARKERS[n], label=f"friction {friction:g}")
        kinds = table[table["friction"] == friction]
        axes.plot(kinds["lambda"] + 0.4 * (n - 1), kinds["lost"], linestyle="none", marker="_",
                  color=CYCLE[n], alpha=0.6)
    axes.axvline(number(theirs, "stands_from"), color=C["black"], linewidth=0.8)
    axes.text(number(theirs, "stands_from") + 0.5, 0.93, "Desmond: stand", fontsize=8)
    axes.axhline(measures.LOST, color=C["grey"], linestyle=plots.DASHES[1], linewidth=0.8)
    axes.set(xlabel="aspect ratio λ", ylabel="height lost without the cylinder", ylim=(0, 1))
    axes.legend(loc="lower left")
    return figure


def capsules_figure(table, theirs):
    figure, axes = plots.new_figure(125, 85)
    found = page.capsules(table)
    for n, (rate, kind) in enumerate(found.groupby("rate", sort=True)):
        axes.errorbar(kind["lambda"], kind["solid_fraction"],
                      plots.errors(kind["solid_fraction_error"]), color=CYCLE[n], marker=MARKERS[n],
                      capsize=2, label=f"rate {rate:g}")
    value = theirs["value"], theirs["error"]
    axes.errorbar([value[0]["aspect"]], [value[0]["solid_fraction"]],
                  [value[1]["solid_fraction"]], [value[1]["aspect"]], color=C["black"], marker="*",
                  markersize=10, label="Imaz González et al.")
    axes.set(xlabel="aspect ratio λ", ylabel="solid fraction, densest disordered")
    axes.legend()
    return figure


def shear_figure(table, theirs):
    figure, axes = plots.new_figure(125, 85)
    sheared = page.sheared(table)
    for n, ((limits, aspect), kind) in enumerate(sheared.groupby(["limits", "lambda"])):
        name = f"λ = {aspect:g}" + ("" if limits == "none" else ", limit on ω")
        points(axes, kind["rate"], kind["alignment_deg"], kind["alignment_error"], color=CYCLE[n],
               marker=MARKERS[n], label=name)
        mean = kind["alignment_deg"].mean()
        axes.plot([kind["rate"].min(), kind["rate"].max()], [mean, mean], color=CYCLE[n],
                  linestyle=plots.DASHES[1], linewidth=1)
    axes.text(0.02, 0.02, f"Börzsönyi et al.: level over {number(theirs, 'decades'):g} decades",
              transform=axes.transAxes, fontsize=8)
    axes.set(xscale="log", xlabel="shear rate of the layer (1/s)", ylim=(0, None),
             ylabel="mean direction above the flow (degrees)")
    plain_numbers(axes.xaxis)
    axes.legend()
    return figure
