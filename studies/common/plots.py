# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of one look, as files that are the same each time."""
from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

plt.style.use(Path(__file__).with_name("rods.mplstyle"))

# Okabe and Ito (2008): they differ for every kind of colour vision. Yellow is left out: it is too
# light for lines on white.
COLOURS = {"black": "#000000", "orange": "#E69F00", "sky_blue": "#56B4E9", "green": "#009E73",
           "blue": "#0072B2", "vermilion": "#D55E00", "purple": "#CC79A7", "grey": "#696969"}
CYCLE = [COLOURS[name] for name in ("blue", "vermilion", "green", "purple", "orange", "sky_blue",
                                    "black")]
MARKERS = ["o", "s", "D", "^", "v", "P", "X"]
DASHES = ["-", (0, (5, 2)), (0, (1, 1.2)), (0, (5, 1.5, 1, 1.5))]

# What differs between two runs of matplotlib is left out of its files.
_METADATA = {".png": {"Software": None}, ".svg": {"Date": None, "Creator": None},
             ".pdf": {"CreationDate": None, "Creator": None, "Producer": None}}


def new_figure(width_mm: float = 160, height_mm: float = 110, rows: int = 1, columns: int = 1,
               **options):
    """Figure and axes (an array if there are several), of the size printed."""
    return plt.subplots(rows, columns, figsize=(width_mm / 25.4, height_mm / 25.4), **options)


def save(figure, stem: Path | str, pdf: bool = False) -> None:
    """Writes STEM.svg and STEM.png, on request STEM.pdf, and closes the figure."""
    stem = Path(stem)
    stem.parent.mkdir(parents=True, exist_ok=True)
    for ending in (".svg", ".png") + ((".pdf",) if pdf else ()):
        figure.savefig(stem.with_name(stem.name + ending), metadata=_METADATA[ending])
    plt.close(figure)
