# SPDX-License-Identifier: GPL-2.0-or-later
"""Maps of states, and the curves beside them."""
from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from studies.common import plots
from studies.stability import theory
from studies.stability.states import STATES

NAMES = ("map", "steps", "remedies", "others", "scenes", "slow")
# Told apart by lightness, too, and by a sign: colour blind or in print.
COLOURS = {"rests": "#CFE8F7", "moves": "#F5E6A8", "jitters": "#E69F00", "passes": "#CC79A7",
           "grows": "#A63603", "lost": "#262626"}
SIGNS = {"rests": "", "moves": "·", "jitters": "~", "passes": "×", "grows": "▲", "lost": "■"}
METHODS = {
    "ours": "as it is", "plain": "all parts plain", "ours-mass": "damping by the rods' mass",
    "ours-rotation": "rotation plain", "ours-search": "search five_step",
    "ours-single": "spread_contact off", "ours-memory": "tangential no_history",
    "ours@4pi": "limit 4π", "ours@4pi_transverse": "limit 4π, transverse",
    "ours@0.2pi": "limit 0.2π", "ours@0.2pi_transverse": "limit 0.2π, transverse",
    "ours@study": "limit 4π, then 0.2π", "ours@study_transverse": "4π, then 0.2π, transverse",
    "plain+mass": "plain, effective_mass on", "plain+rotation": "plain, rotation exact",
    "plain+search": "plain, search exact", "plain+single": "plain, spread_contact on",
    "plain@4pi": "plain, limit 4π", "plain@4pi_transverse": "plain, 4π transverse",
    "plain@0.2pi": "plain, limit 0.2π", "plain@0.2pi_transverse": "plain, 0.2π transverse",
    "glued": "glued spheres"}


def title_of(method: str) -> str:
    return METHODS.get(method, method)


def worst(states) -> str:
    """Of several beds."""
    return next(state for state in STATES if state in set(states))


def place(values: list[float], wanted: float) -> float:
    """Of a number on an axis whose places are 0, 1, 2 … at `values`: between them by logarithms."""
    logs = np.log([max(v, 1e-9) for v in values])
    return float(np.interp(math.log(wanted), logs, range(len(values))))


def draw_map(panel, part: pandas.DataFrame, x: str, y: str, title: str) -> tuple[list, list]:
    """A cell a combination: the worst state of its beds."""
    xs, ys = sorted(part[x].unique()), sorted(part[y].unique())
    for (vx, vy), cell in part.groupby([x, y]):
        state = worst(cell["state"])
        i, j = xs.index(vx), ys.index(vy)
        panel.add_patch(Rectangle((i - 0.5, j - 0.5), 1, 1, facecolor=COLOURS[state],
                                  edgecolor="white", linewidth=0.8))
        panel.text(i, j, SIGNS[state], ha="center", va="center", fontsize=8,
                   color="white" if state in ("lost", "grows") else "black")
    panel.set_xlim(-0.5, len(xs) - 0.5)
    panel.set_ylim(-0.5, len(ys) - 0.5)
    panel.set_xticks(range(len(xs)), [f"{v:g}" for v in xs], fontsize=7)
    panel.set_yticks(range(len(ys)), [f"{v:g}" for v in ys], fontsize=7)
    panel.tick_params(length=0)
    panel.set_title(title, fontsize=8)
    return xs, ys


def legend(figure, states, lines=()) -> None:
    handles = [Patch(facecolor=COLOURS[s], edgecolor="#888888", linewidth=0.4,
                     label=f"{s} {SIGNS[s]}".strip()) for s in reversed(STATES) if s in set(states)]
    handles += [Line2D([], [], color="black", linestyle=style, linewidth=1.2, label=text)
                for style, text in lines]
    columns = 4
    lines = math.ceil(len(handles) / columns)
    high = (4.5 * lines + 2) / 25.4 / figure.get_figheight()
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 1 - high))
    figure.legend(handles=handles, loc="upper center", ncols=columns, fontsize=7.5,
                  handlelength=1.8, columnspacing=1.2, borderaxespad=0.2)


def nothing(panel) -> None:
    panel.set_axis_off()
    panel.text(0.5, 0.5, "none of these beds was run", ha="center", transform=panel.transAxes)


def grid(number: int, width: float, height: float, columns: int = 2):
    lines = max(1, math.ceil(number / columns))
    figure, axes = plots.new_figure(width, 14 + height * lines, lines, columns, squeeze=False)
    panels = list(axes.flat)
    for panel in panels[max(number, 1):]:
        panel.set_axis_off()
    return figure, panels


LINES = (("-", "a hit can gain energy"), ("--", "it gains on average"))


def draw_steps(beds: pandas.DataFrame, stem: Path, only: tuple[str, ...] = ()) -> None:
    """λ against the step, a panel a method, with the steps at which hits gain energy. `only`: these of
    the methods."""
    part = beds[beds["map"] == "steps"]
    if only:
        part = part[part["method"].isin(only)]
    methods = list(dict.fromkeys(part["method"]))
    figure, panels = grid(len(methods), 165, 46)
    if not methods:
        nothing(panels[0])
    for panel, method in zip(panels, methods):
        rows = part[part["method"] == method]
        xs, ys = draw_map(panel, rows, "lambda", "fraction", title_of(method))
        plain = "plain" in method or "mass" in method
        for style, onset in (("-", theory.gain_onset), ("--", theory.mean_onset)):
            steps = [theory.over_thin(a) * onset(theory.damping_at_ends(a, 0.5, not plain))
                     for a in xs]
            panel.plot(range(len(xs)), [place(ys, s) for s in steps], color="black",
                       linewidth=1.2, linestyle=style)
    for panel in panels[:len(methods)]:
        panel.set_xlabel("λ", fontsize=8)
    for panel in panels[::2]:
        panel.set_ylabel("dt / dt_c", fontsize=8)
    legend(figure, part["state"], LINES)
    plots.save(figure, stem)


def draw_remedies(beds: pandas.DataFrame, stem: Path) -> None:
    """Method against step for one λ; a sign a bed."""
    part = beds[beds["map"] == "remedies"]
    figure, panels = grid(1, 165, 78, 1)
    panel = panels[0]
    if part.empty:
        nothing(panel)
        plots.save(figure, stem)
        return
    methods, steps = list(dict.fromkeys(part["method"])), sorted(part["fraction"].unique())
    for (method, step), cell in part.groupby(["method", "fraction"]):
        i, j = steps.index(step), methods.index(method)
        wide = 1.0 / len(cell)
        for k, state in enumerate(cell.sort_values("seed")["state"]):
            left = i - 0.5 + k * wide
            panel.add_patch(Rectangle((left, j - 0.5), wide, 1, facecolor=COLOURS[state],
                                      edgecolor="none"))
            panel.text(left + 0.5 * wide, j, SIGNS[state], ha="center", va="center", fontsize=8,
                       color="white" if state in ("lost", "grows") else "black")
        panel.add_patch(Rectangle((i - 0.5, j - 0.5), 1, 1, facecolor="none", edgecolor="white",
                                  linewidth=1.5))
    panel.set_xlim(-0.5, len(steps) - 0.5)
    panel.set_ylim(len(methods) - 0.5, -0.5)
    panel.set_xticks(range(len(steps)), [f"{s:g}" for s in steps])
    panel.set_yticks(range(len(methods)), [title_of(m) for m in methods])
    panel.tick_params(length=0)
    panel.set_xlabel("dt / dt_c")
    panel.set_title(f"λ = {part['lambda'].iloc[0]:g}, a sign for each of "
                    f"{part['seed'].nunique()} beds", fontsize=8.5)
    legend(figure, part["state"])
    plots.save(figure, stem)


def draw_others(beds: pandas.DataFrame, stem: Path) -> None:
    """Restitution and step, speed and stiffness, friction and λ, glued spheres."""
    panels_of = []
    for name, x, y in (("damping", "restitution", "fraction"), ("impact", "speed", "stiffness"),
                       ("friction", "lambda", "friction")):
        part = beds[beds["map"] == name]
        panels_of += [(part[part["method"] == m], x, y, title_of(m))
                      for m in dict.fromkeys(part["method"])]
    part = beds[beds["map"] == "glued"]
    for aspect in sorted(part["lambda"].unique()):
        panels_of.append((part[part["lambda"] == aspect], "spheres", "fraction",
                          f"glued spheres, λ = {aspect:g}"))
    names = {"restitution": "restitution", "fraction": "dt / dt_c",
             "spheres": "spheres (0: true rod)", "speed": "thrown down with (m/s)",
             "stiffness": "stiffness / decks'", "lambda": "λ", "friction": "friction"}
    figure, panels = grid(len(panels_of), 165, 48)
    if not panels_of:
        nothing(panels[0])
    for panel, (rows, x, y, title) in zip(panels, panels_of):
        xs, ys = draw_map(panel, rows, x, y, title)
        panel.set_xlabel(names[x], fontsize=8)
        panel.set_ylabel(names[y], fontsize=8)
        if x == "restitution":
            aspect, ours = rows["lambda"].iloc[0], "mass" not in rows["method"].iloc[0]
            for style, onset in (("-", theory.gain_onset), ("--", theory.mean_onset)):
                steps = [theory.over_thin(aspect) * onset(theory.damping_at_ends(aspect, e, ours))
                         for e in xs]
                panel.plot(range(len(xs)), [place(ys, s) for s in steps], color="black",
                           linewidth=1.2, linestyle=style)
    states = set().union(*(set(rows["state"]) for rows, *_ in panels_of)) if panels_of else ()
    legend(figure, states, LINES)
    plots.save(figure, stem)


def draw_scenes(hits: pandas.DataFrame, spin: pandas.DataFrame, stem: Path) -> None:
    """Energy of hits after over before; growth of the energy of a free rod."""
    figure, (left, right) = plots.new_figure(165, 75, 1, 2)
    cases = hits[hits["method"] == "ours"].groupby("restitution") if len(hits) else []
    for colour, marker, (e, rows) in zip(plots.CYCLE, plots.MARKERS, cases):
        beta = rows["damping"].iloc[0]
        steps = np.linspace(rows["fraction"].min(), rows["fraction"].max(), 300)
        phases = (np.arange(64) + 0.5) / 64
        most = [np.max(theory.restitution_of_hit(2 * s, beta, phases) ** 2) for s in steps]
        left.plot(steps, most, color=colour, linewidth=1)
        left.plot(rows["fraction"], rows["energy_most"], marker, color=colour, markersize=4,
                  label=f"e = {e:g}")
        left.axvline(theory.gain_onset(beta), color=colour, linewidth=0.8, linestyle=":")
    left.axhline(1.0, color=plots.COLOURS["grey"], linewidth=0.8)
    left.set_yscale("log")
    left.set_ylim(1e-3, 100)
    left.set_xlabel("dt / 2 √(m_eff/k)")
    left.set_ylabel("energy after / before, most of all phases")
    left.set_title("hits end on end; curves: the scheme", fontsize=8.5)
    left.legend()
    for rotation, marker in (("plain", "o"), ("exact", "s")):
        rows = spin[spin["rotation"] == rotation] if len(spin) else spin
        for colour, (aspect, part) in zip(plots.CYCLE, rows.groupby("lambda") if len(rows) else []):
            label = f"{rotation}, λ = {aspect:g}"
            right.plot(1e6 * part["step_s"], part["rate"].abs().clip(lower=1e-13), marker,
                       color=colour, markersize=4.5, label=label,
                       markerfacecolor=colour if rotation == "plain" else "white")
            if rotation == "plain":
                right.plot(1e6 * part["step_s"], part["expected"], color=colour, linewidth=1)
    right.set_xscale("log")
    right.set_yscale("log")
    right.set_ylim(1e-14, 1e2)
    right.set_xlabel("time step (µs)")
    right.set_ylabel("|growth of its energy| (1/s)")
    right.set_title("a free rod; lines: Ω² dt/2", fontsize=8.5)
    right.legend(fontsize=7, loc="center right")
    plots.save(figure, stem)


def draw_slow(slow: pandas.DataFrame, stem: Path) -> None:
    """V_f of the inner cylinder against time, beds with and without a limit."""
    figure, panel = plots.new_figure(120, 75)
    methods = list(dict.fromkeys(slow["method"]))
    for colour, dash, method in zip(plots.CYCLE, plots.DASHES, methods):
        for k, (_, part) in enumerate(slow[slow["method"] == method].groupby("seed")):
            panel.plot(part["time_s"], part["vf_inner"], color=colour, linestyle=dash,
                       label=title_of(method) if k == 0 else None)
            rested = part["rested_at_s"].iloc[0]
            if rested == rested:
                panel.plot(part["time_s"].iloc[-1], part["vf_inner"].iloc[-1], "o", color=colour)
    panel.set_xlabel("time since the rods were let go (s)")
    panel.set_ylabel("V_f, inner cylinder")
    panel.grid(True)
    if methods:
        panel.legend(title="dot: at rest", title_fontsize=8)
        panel.set_title(f"λ = {slow['lambda'].iloc[0]:g}", fontsize=8.5)
    plots.save(figure, stem)


def draw(tables: dict[str, pandas.DataFrame], folder: Path) -> None:
    draw_steps(tables["beds"], folder / "map", ("ours", "plain"))
    draw_steps(tables["beds"], folder / "steps")
    draw_remedies(tables["beds"], folder / "remedies")
    draw_others(tables["beds"], folder / "others")
    draw_scenes(tables["hits"], tables["spin"], folder / "scenes")
    draw_slow(tables["slow"], folder / "slow")
