# SPDX-License-Identifier: GPL-2.0-or-later
"""What README.md.j2 asks for: numbers of speed.csv."""
from __future__ import annotations

import pandas

from bench import speed


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

    def beside_spheres() -> list[dict]:
        """The cases of sphere_bed: the row of the rods, and of the spheres of each code."""
        of_scene = table[(table["scene"] == "sphere_bed") & (table["ranks"] == 1)]
        return [{"rods": row("sphere_bed", aspect, count),
                 "codes": [(name, row("sphere_bed", aspect, count, 1, f"sphere {code}"))
                           for code, name in (("liggghts", "LIGGGHTS"), ("lammps", "LAMMPS"))]}
                for (aspect, count), _ in of_scene.groupby(["lambda", "rods"])]

    def in_meshes() -> list[dict]:
        """The cases of scenes with a mesh: the row of the rods, those in other walls and those glued."""
        names = [name for name, scene in speed.SCENES.items() if scene.mesh]
        of_scenes = table[table["scene"].isin(names)]
        return [{"rods": row(scene, aspect, count),
                 **{kind: [r for _, r in rows.iterrows() if r["code"].startswith(f"{kind} ")]
                    for kind in ("plugin", "multisphere")}}
                for (scene, aspect, count), rows in of_scenes.groupby(["scene", "lambda", "rods"])]

    return {"beside_spheres": beside_spheres(), "in_meshes": in_meshes(), "row": row, "us": us, "times_slower": times_slower,
            "machines": sorted(set(table["machine"]))}
