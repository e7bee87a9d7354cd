# SPDX-License-Identifier: GPL-2.0-or-later
"""Meshes of the scenes that have one: tubes of 64 plates on a tiled floor, in few triangles and in many, and
the drum and the hopper of examples/machinery, twice as large, for rods twice as thick."""
from __future__ import annotations

from pathlib import Path

import numpy

from examples.machinery import make_meshes

PLATES, FACETS = 64, 48
# A tube's tiles: across a plate, along it, of the floor each way. 1,000 and 100,000 triangles, in the same planes.
TILES = {"coarse": (1, 6, 11), "fine": (4, 150, 107)}
# Of a machine: its box, and where rods are placed.
BOXES = {"drum": "-0.22 0.22 -0.12 0.12 -0.22 0.22", "hopper": "-0.13 0.13 -0.13 0.13 -0.6 0.62"}
PLACED = {"drum": "cylinder y 0.0 0.0 0.16 -0.09 0.09", "hopper": "cylinder z 0.0 0.0 0.11 0.14 0.6"}


def tube(radius: float, height: float, across: int, along: int, floor: int) -> list[numpy.ndarray]:
    """Its plates touch the cylinder of that radius from outside; the floor, z = 0, is a square about it."""
    half = radius / numpy.cos(numpy.pi / PLATES)
    low, high = (make_meshes.ring(half, z, PLATES) for z in (0.0, height))
    triangles = []
    for corners in zip(low, numpy.roll(low, -1, 0), numpy.roll(high, -1, 0), high):
        triangles += make_meshes.tiled(*corners, across, along)
    return triangles + make_meshes.tiled((-half, -half, 0), (half, -half, 0), (half, half, 0),
                                         (-half, half, 0), floor, floor)


def write(mesh: str, folder: Path, radius: float = 0.0, height: float = 0.0) -> None:
    """MESH.stl, of a drum drum_parts.stl as well. A tube no higher than four radii: tiles are no slivers then."""
    if mesh in TILES:
        triangles = tube(radius, min(height, 4 * radius), *TILES[mesh])
    elif mesh == "drum":
        triangles = make_meshes.drum(FACETS, 0.2, 0.2)
        make_meshes.write(folder / "drum_parts.stl",
                          make_meshes.drum_parts(FACETS, 0.2, 0.2, lifter=0.03))
    else:
        triangles = make_meshes.hopper(FACETS, 0.1, 0.12, 0.12, 0.6)
    make_meshes.write(folder / f"{mesh}.stl", triangles)
