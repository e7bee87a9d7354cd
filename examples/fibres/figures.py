# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure: beds against the stiffness of their fibres, and the bed that is pressed; and pictures of beds."""
from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy
import pandas
from PIL import Image

from examples.fibres import beds
from studies.common import cases, pages, plots, settling
from studies.common.statistics import mean_and_error

C = plots.COLOURS


def of_one_kind(found: pandas.DataFrame, aspect: float) -> pandas.DataFrame:
    """The beds at rest of the number of segments of which there are most, and rods."""
    part = found[(found["lambda"] == aspect) & (found["rested"] == 1)]
    fibres = part[numpy.isfinite(part["bending"])]
    return part[(part["segments"] == fibres["segments"].mode().iloc[0]) | ~numpy.isfinite(part["bending"])]


def against_stiffness(axes, found: pandas.DataFrame, quantity: str, label: str) -> None:
    """Means and errors of beds at rest; rods as a band of their error across."""
    for i, aspect in enumerate(sorted(found["lambda"].unique())):
        part = of_one_kind(found, aspect)
        groups = [(bending, *mean_and_error(one[quantity])) for bending, one in part.groupby("bending")]
        soft = [group for group in groups if math.isfinite(group[0])]
        x, y, error = (numpy.array(values) for values in zip(*soft))
        style = {"color": plots.CYCLE[i], "marker": plots.MARKERS[i]}
        axes.errorbar(x, y, yerr=plots.errors(error), label=f"λ = {aspect:g}", capsize=2, **style)
        for _, mean, wide in [group for group in groups if math.isinf(group[0])]:
            axes.axhline(mean, color=plots.CYCLE[i], linestyle=plots.DASHES[1], linewidth=0.9)
            if math.isfinite(wide):
                axes.axhspan(mean - wide, mean + wide, color=plots.CYCLE[i], alpha=0.15, linewidth=0)
    axes.set(xscale="log", xlabel="B = EI/(m g L²)", ylabel=label)
    axes.grid(True)


def pressed(axes, loops: pandas.DataFrame) -> None:
    for i, (value, loop) in enumerate(loops.groupby("yield_curvature")):
        name = "elastic joints" if value == 0 else f"joints yield at {value:g}/L"
        axes.plot(1000 * loop["height_m"], loop["force_N"], color=plots.CYCLE[i], linewidth=0.7, label=name)
    axes.set(xlabel="height of the plate (mm)", ylabel="force on it (N)")
    cycled = loop["height_m"].loc[loop["height_m"].idxmin():].max()   # the way down to the bed bears next to nothing
    axes.set_xlim(1000 * (loop["height_m"].min() - 0.02 * cycled), 1100 * cycled)
    axes.set_ylim(bottom=0)
    axes.legend()
    axes.grid(True)


def work(axes, cycles: pandas.DataFrame) -> None:
    for i, (value, part) in enumerate(cycles.groupby("yield_curvature")):
        groups = [(cycle, *mean_and_error(one["lost_J"])) for cycle, one in part.groupby("cycle")]
        x, y, error = (numpy.array(values) for values in zip(*groups))
        name = "elastic joints" if value == 0 else f"joints yield at {value:g}/L"
        axes.errorbar(x, y, yerr=plots.errors(error), color=plots.CYCLE[i], marker=plots.MARKERS[i], capsize=2,
                      label=name)
        if value > 0:
            taken = [one["yielded_J"].mean() for _, one in part.groupby("cycle")]
            axes.plot(x, taken, color=plots.CYCLE[i], linestyle=plots.DASHES[2], label="of it by yielding")
    axes.set(xlabel="cycle", ylabel="work that is lost (J)", xticks=sorted(cycles["cycle"].unique()))
    axes.set_ylim(bottom=0)
    axes.legend()
    axes.grid(True)


def draw(found: pandas.DataFrame, cycles: pandas.DataFrame, loops: pandas.DataFrame, folder: Path) -> None:
    figure, axes = plots.new_figure(170, 170, 3, 2)
    scaled = found.assign(vf_lambda=found["vf_inner"] * found["lambda"])
    against_stiffness(axes[0, 0], scaled, "vf_lambda", "V_f · λ, inner cylinder")
    against_stiffness(axes[0, 1], found, "contacts", "contacts a fibre")
    against_stiffness(axes[1, 0], found, "elevation_deg", "segments' elevation (°)")
    against_stiffness(axes[1, 1], found, "elevation_ends_deg", "end-to-end elevation (°)")
    axes[0, 0].legend(title="dashed: rods")
    pressed(axes[2, 0], loops)
    work(axes[2, 1], cycles)
    plots.save(figure, folder / "fibres")


def render(folder: Path, told: dict, lambdas: list[str], seed: int, out: str, build) -> None:
    """The stiffest and the softest bed of the first λ beside each other, coloured by elevation."""
    aspect = lambdas[0]
    bed = told[aspect]
    with tempfile.TemporaryDirectory() as place:
        pictures = []
        dumps = [folder / f"{aspect}_{bending}_n{bed['segments']}_s{seed}" / "dump.settle" for bending in bed["bendings"]]
        dumps = [dump for dump in dumps if dump.exists()]
        for name, dump in (("stiff", dumps[0]), ("soft", dumps[-1])):
            path = Path(place, f"{name}.png")
            cases.run_tool("rod_render", dump, "--out", path, "--vessel-radius", float(bed["vessel"]) / 2,
                           "--vessel-height", 1.2 * float(aspect) * settling.DIAMETER, "--size", "1000x900",
                           "--no-colour-bar", build=build)
            pictures.append(Image.open(path).convert("RGB"))
        both = Image.new("RGB", (sum(p.width for p in pictures), pictures[0].height), "white")
        for i, picture in enumerate(pictures):
            both.paste(picture, (i * picture.width, 0))
        both.save(Path(place, "both.png"))
        pages.shrink(Path(place, "both.png"), out, 1200, 128)
