# SPDX-License-Identifier: GPL-2.0-or-later
"""What README.md.j2 asks for: numbers of speed.csv."""
from __future__ import annotations

import pandas


def values(table: pandas.DataFrame) -> dict:
    def row(scene: str, aspect: int, count: int, ranks: int = 1, code: str = "plugin") -> pandas.Series:
        found = table[(table["scene"] == scene) & (table["lambda"] == aspect) &
                      (table["rods"] == count) & (table["ranks"] == ranks) & (table["code"] == code)]
        if len(found) != 1:
            raise ValueError(f"speed.csv has {len(found)} rows of {scene} {aspect} {count} {ranks} "
                             f"{code}, wanted one")
        return found.iloc[0]

    def us(*case) -> float:
        return row(*case)["us_per_rod_and_step"]

    def times_slower(scene: str, aspect: int, count: int, spheres: int) -> float:
        return row(scene, aspect, count, 1, f"multisphere n={spheres}")["peer_over_plugin"]

    return {"row": row, "us": us, "times_slower": times_slower,
            "machines": sorted(set(table["machine"]))}
