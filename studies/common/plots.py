# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of one look, as files that are the same each time."""
from __future__ import annotations

import threading
from pathlib import Path

import matplotlib
import matplotlib.colors
import matplotlib.figure
import matplotlib.style
import numpy

matplotlib.style.use(Path(__file__).with_name("rods.mplstyle"))

# Okabe and Ito (2008): they differ for every kind of colour vision. Yellow is left out: it is too
# light for lines on white.
COLOURS = {"black": "#000000", "orange": "#E69F00", "sky_blue": "#56B4E9", "green": "#009E73",
           "blue": "#0072B2", "vermilion": "#D55E00", "purple": "#CC79A7", "grey": "#696969"}
CYCLE = [COLOURS[name] for name in ("blue", "vermilion", "green", "purple", "orange", "sky_blue",
                                    "black")]
MARKERS = ["o", "s", "D", "^", "v", "P", "X"]
DASHES = ["-", (0, (5, 2)), (0, (1, 1.2)), (0, (5, 1.5, 1, 1.5))]

PDF = False   # whether save writes STEM.pdf too: --config pdf=1

_DRAWING = threading.Lock()

# What differs between two runs of matplotlib is left out of its files.
_METADATA = {".png": {"Software": None}, ".svg": {"Date": None, "Creator": None},
             ".pdf": {"CreationDate": None, "Creator": None, "Producer": None}}


def new_figure(width_mm: float = 160, height_mm: float = 110, rows: int = 1, columns: int = 1,
               **options):
    """Figure and axes (an array if there are several), of the size printed. Jobs that are threads
    can each have one: nothing of a figure is kept by pyplot."""
    figure = matplotlib.figure.Figure(figsize=(width_mm / 25.4, height_mm / 25.4))
    return figure, figure.subplots(rows, columns, **options)


def errors(values):
    """For errorbar: None if none of the values is a number, which errorbar does not stand."""
    values = numpy.asarray(values, dtype=float)
    return values if numpy.isfinite(values).any() else None


def endings() -> list[str]:
    return [".svg", ".png"] + [".pdf"] * PDF


def save(figure, stem: Path | str) -> None:
    """Writes STEM.svg and STEM.png, on request STEM.pdf. One figure at a time, whatever the thread:
    matplotlib's reader of formulas, as tick labels of logarithmic axes are, is one for all."""
    stem = Path(stem)
    stem.parent.mkdir(parents=True, exist_ok=True)
    with _DRAWING:
        for ending in endings():
            figure.savefig(stem.with_name(stem.name + ending), metadata=_METADATA[ending])


def for_letters(colour: str) -> str:
    """Darker, of the same hue, since letters are thinner than curves."""
    red, green, blue = (0.6 * part for part in matplotlib.colors.to_rgb(colour))
    return matplotlib.colors.to_hex((red, green, blue))
