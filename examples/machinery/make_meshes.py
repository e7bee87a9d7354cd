#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the meshes of these examples as STL files, named after what they are.

    ./make_meshes.py [--facets 48] [--orifice 0.05] [--slope 30]    # facets: a multiple of the six lifters

Lengths in m; both sides of a triangle are walls.
"""
import argparse
from pathlib import Path

import numpy as np

LIFTERS = 6  # of the drum, each on an edge of its side


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


def tiled(a, b, c, d, along: int, across: int) -> list[np.ndarray]:
    """The plane quad a b c d in along x across pairs of triangles, along from a to b."""
    a, b, c, d = (np.array(corner, float) for corner in (a, b, c, d))

    def at(u: float, v: float) -> np.ndarray:
        return (1 - u) * ((1 - v) * a + v * d) + u * ((1 - v) * b + v * c)

    triangles = []
    for i in range(along):
        for j in range(across):
            u, v = (i / along, (i + 1) / along), (j / across, (j + 1) / across)
            triangles += quad(at(u[0], v[0]), at(u[1], v[0]), at(u[1], v[1]), at(u[0], v[1]))
    return triangles


def upright(x0, y0, x1, y1, low, high) -> list[np.ndarray]:
    """A vertical plate over the line from (x0, y0) to (x1, y1)."""
    return quad((x0, y0, low), (x1, y1, low), (x1, y1, high), (x0, y0, high))


def level(x0, x1, y0, y1, z) -> list[np.ndarray]:
    return quad((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))


def tray(x0, x1, y0, y1, floor, rim) -> list[np.ndarray]:
    """A box without a lid."""
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    sides = [upright(*one, *next_one, floor, rim)
             for one, next_one in zip(corners, corners[1:] + corners[:1])]
    return level(x0, x1, y0, y1, floor) + sum(sides, [])


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


def drum_parts(facets: int, radius=0.1, length=0.1, lifters=LIFTERS, lifter=0.015) -> list[np.ndarray]:
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


def chute(slope: float, length=0.35, width=0.06, side=0.025, end=0.05) -> list[np.ndarray]:
    """A trough that falls in x by the slope (degrees) to (0, 0, end), of small tiles for its wear."""
    angle = np.radians(slope)
    down = np.array([np.cos(angle), 0.0, -np.sin(angle)])
    out = np.array([np.sin(angle), 0.0, np.cos(angle)])
    foot = np.array([[0.0, y, end] for y in (-width / 2, width / 2)])
    head = foot - length * down
    triangles = tiled(head[0], foot[0], foot[1], head[1], 28, 5)
    for low, high in zip(foot, head):
        triangles += tiled(high, low, low + side * out, high + side * out, 28, 2)
    return triangles


def belt_rails() -> list[np.ndarray]:
    """What stands still about two belts: rails, a plate behind either, a box at the end."""
    return (upright(-0.25, -0.03, 0.0, -0.03, 0.1, 0.13) + upright(-0.25, 0.03, 0.0, 0.03, 0.1, 0.13)
            + upright(-0.25, -0.03, -0.25, 0.03, 0.1, 0.13)
            + upright(-0.02, -0.05, -0.02, 0.2, 0.04, 0.09) + upright(0.12, -0.05, 0.12, 0.2, 0.04, 0.13)
            + upright(-0.02, -0.05, 0.12, -0.05, 0.04, 0.09)
            + tray(-0.025, 0.125, 0.205, 0.32, -0.02, 0.03))


def trough() -> list[np.ndarray]:
    """Floor at z = 0.1, open at x = 0."""
    return (level(-0.2, 0.0, -0.03, 0.03, 0.1)
            + upright(-0.2, -0.03, 0.0, -0.03, 0.1, 0.14) + upright(-0.2, 0.03, 0.0, 0.03, 0.1, 0.14)
            + upright(-0.2, -0.03, -0.2, 0.03, 0.1, 0.18))


def roller(radius=0.009, corners=6, width=0.054, x=-0.06, z=0.128) -> list[np.ndarray]:
    """A bar of six sides across a trough."""
    front, back = (ring(radius, y, corners) for y in (-width / 2, width / 2))
    triangles = lying(between(front, back) + disc(front) + disc(back))
    return [triangle + (x, 0.0, z) for triangle in triangles]


def vane(radius=0.02, height=0.03, foot=0.012) -> list[np.ndarray]:
    """Two plates that cross in the z axis."""
    return (upright(-radius, 0.0, radius, 0.0, foot, foot + height)
            + upright(0.0, -radius, 0.0, radius, foot, foot + height))


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
    parser.add_argument("--slope", type=float, default=30, help="of the chute (degrees)")
    arguments = parser.parse_args()
    if arguments.facets < LIFTERS or arguments.facets % LIFTERS:
        parser.error(f"--facets must be a multiple of {LIFTERS}, the number of lifters (got {arguments.facets})")
    if not 0 < arguments.orifice < 0.12:
        parser.error(f"--orifice must be > 0 and less than the hopper's width 0.12 (got {arguments.orifice:g})")
    if not 0 <= arguments.slope < 90:
        parser.error(f"--slope must be from 0 to less than 90 (got {arguments.slope:g})")
    write("hopper.stl", hopper(arguments.facets, arguments.orifice))
    write("drum.stl", drum(arguments.facets))
    write("drum_parts.stl", drum_parts(arguments.facets))
    write("press.stl", press())
    write("blade.stl", blade())
    write("chute.stl", chute(arguments.slope))
    write("chute_bin.stl", tray(-0.03, 0.15, -0.045, 0.045, 0.0, 0.04))
    write("chute_gate.stl", upright(0.006, -0.05, 0.006, 0.05, 0.0, 0.12))
    write("belt.stl", level(-0.25, 0.0, -0.035, 0.035, 0.1))
    write("cross_belt.stl", level(-0.03, 0.13, -0.06, 0.2, 0.04))
    write("belt_rails.stl", belt_rails())
    write("trough.stl", trough())
    write("trough_gate.stl", upright(-0.13, -0.029, -0.13, 0.029, 0.107, 0.18))
    write("roller.stl", roller())
    write("flap.stl", upright(0.04, -0.04, 0.04, 0.04, 0.02, 0.06))
    write("bins.stl", tray(-0.04, 0.12, -0.05, 0.05, -0.03, 0.05)
          + upright(0.04, -0.05, 0.04, 0.05, -0.03, 0.018))
    write("vane.stl", vane())


if __name__ == "__main__":
    main()
