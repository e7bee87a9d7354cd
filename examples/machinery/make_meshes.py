#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the meshes of these examples as STL files: hopper.stl, drum.stl, drum_parts.stl,
press.stl, blade.stl.

    ./make_meshes.py [--facets 48] [--orifice 0.05]

Lengths in m; both sides of a triangle are walls.
"""
import argparse
from pathlib import Path

import numpy as np


def ring(radius: float, height: float, facets: int, turned: float = 0.0) -> np.ndarray:
    angles = 2.0 * np.pi * (np.arange(facets) + turned) / facets
    return np.stack([radius * np.cos(angles), radius * np.sin(angles),
                     np.full(facets, height)], axis=1)


def between(lower: np.ndarray, upper: np.ndarray, rows: int = 1) -> list[np.ndarray]:
    """The band between two rings of as many points, in rows of about square pairs of triangles."""
    triangles = []
    for row in range(rows):
        low, high = (lower + (upper - lower) * part / rows for part in (row, row + 1))
        for a, b, c, d in zip(low, np.roll(low, -1, 0), np.roll(high, -1, 0), high):
            triangles += [np.array([a, b, c]), np.array([a, c, d])]
    return triangles


def disc(rim: np.ndarray) -> list[np.ndarray]:
    centre = rim.mean(axis=0)
    return [np.array([centre, a, b]) for a, b in zip(rim, np.roll(rim, -1, 0))]


def quad(a, b, c, d) -> list[np.ndarray]:
    return [np.array([a, b, c], float), np.array([a, c, d], float)]


def hopper(facets: int, orifice: float, radius=0.06, cone=0.06, height=0.3) -> list[np.ndarray]:
    """A cone on an orifice, a cylinder on the cone."""
    side = 2.0 * np.pi * radius / facets
    return (between(ring(orifice / 2, 0.0, facets), ring(radius, cone, facets),
                    max(1, round(np.hypot(cone, radius - orifice / 2) / side)))
            + between(ring(radius, cone, facets), ring(radius, height, facets),
                      round((height - cone) / side)))


def lying(triangles: list[np.ndarray]) -> list[np.ndarray]:
    """What was about z, about y."""
    return [triangle[:, [1, 2, 0]] for triangle in triangles]


def drum(facets: int, radius=0.1, length=0.1) -> list[np.ndarray]:
    """The side of a drum about the y axis: one smooth surface."""
    side = 2.0 * np.pi * radius / facets
    front, back = (ring(radius, z, facets) for z in (-length / 2, length / 2))
    return lying(between(front, back, round(length / side)))


def drum_parts(facets: int, radius=0.1, length=0.1, lifters=6, lifter=0.015) -> list[np.ndarray]:
    """Its end plates, and lifters that stand on its side."""
    front, back = (ring(radius, z, facets) for z in (-length / 2, length / 2))
    triangles = disc(front) + disc(back)
    inwards = np.array([1.0 - lifter / radius, 1.0 - lifter / radius, 1.0])
    step = facets // lifters
    for foot_front, foot_back in zip(front[::step], back[::step]):
        triangles += quad(foot_front, foot_back, foot_back * inwards, foot_front * inwards)
    return lying(triangles)


def press(side=0.1) -> list[np.ndarray]:
    """A square plate at z = 0."""
    h = side / 2
    return quad((-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0))


def blade(radius=0.048, height=0.03, thickness=0.004, foot=0.004) -> list[np.ndarray]:
    """A paddle across the z axis: a closed box, pitched by 45 degrees."""
    corners = np.array([(x, y, z) for x in (-radius, radius) for y in (-0.5, 0.5) for z in (0, 1)],
                       float) * (1.0, thickness, height)
    corners[:, 1] += corners[:, 2]  # pitched
    corners[:, 2] += foot
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return [triangle for face in faces for triangle in quad(*corners[list(face)])]


def write(name: str, triangles: list[np.ndarray]) -> None:
    with Path(name).open("w") as out:
        out.write(f"solid {Path(name).stem}\n")
        for corners in triangles:
            normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
            normal /= np.linalg.norm(normal)
            out.write("facet normal {:.9g} {:.9g} {:.9g}\n outer loop\n".format(*normal))
            for corner in corners:
                out.write("  vertex {:.9g} {:.9g} {:.9g}\n".format(*corner))
            out.write(" endloop\nendfacet\n")
        out.write(f"endsolid {Path(name).stem}\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--facets", type=int, default=48, help="round a circle (default 48)")
    parser.add_argument("--orifice", type=float, default=0.05, help="of the hopper (m)")
    arguments = parser.parse_args()
    write("hopper.stl", hopper(arguments.facets, arguments.orifice))
    write("drum.stl", drum(arguments.facets))
    write("drum_parts.stl", drum_parts(arguments.facets))
    write("press.stl", press())
    write("blade.stl", blade())


if __name__ == "__main__":
    main()
