# SPDX-License-Identifier: GPL-2.0-or-later
"""The table of scripts/run, from the folders of its cases: table.py SUMMARY.csv FOLDER..."""
from __future__ import annotations

import re
import sys
from pathlib import Path

from studies.common import cases, rows
from studies.packing import beds

# Headings, units, columns, formats.
SHOWN = [("lambda", "", "lambda", "6d"), ("limits", "", "limits", ">6s"), ("seed", "", "seed", "9d"),
         ("Vf_whole", "", "vf_whole", "8.4f"), ("Vf_inner", "", "vf_inner", "8.4f"),
         ("theory", "", "vf_theory", "8.4f"), ("elevation", "deg", "mean_elevation_deg", "9.2f"),
         ("contacts", "per rod", "contacts_per_rod", "8.2f"),
         ("overlap", "max/D", "largest_overlap_over_diameter", "9.4f"),
         ("momentary", "max/D", "momentary_overlap_over_diameter", "9.4f"),
         ("energy", "J", "energy_J", "9.1e"), ("time", "s", "wall_s", "6d")]


def row_of(folder: Path) -> dict:
    aspect, limits, seed = re.fullmatch(r"lambda(\d+)_limits_(\w+)_seed(\d+)", folder.name).groups()
    measured = {**rows.read_rows(folder / "order.csv").iloc[-1],
                **rows.read_rows(folder / "packing.csv").iloc[-1]}
    return {"lambda": int(aspect), "limits": limits, "seed": int(seed),
            **{ours: measured[theirs] for theirs, ours in beds.MEASURES.items()},
            **beds.log_values(folder / "log.fill", folder / "log.settle"),
            "wall_s": int((folder / "wall_seconds").read_text())}


def main(summary: str, *folders: str) -> None:
    table = [row_of(Path(folder)) for folder in folders]
    rows.write_rows(summary, table)
    widths = [re.match(r">?(\d+)", form).group(1) for *_, form in SHOWN]
    for texts in zip(*[(heading, unit) for heading, unit, *_ in SHOWN]):
        print(" ".join(f"{text:>{width}}" for text, width in zip(texts, widths)))
    for row in table:
        print(" ".join(f"{row[column]:{form}}" for _, _, column, form in SHOWN))


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except (cases.CaseError, OSError) as error:
        sys.exit(f"run: {error}")
