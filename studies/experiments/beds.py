# SPDX-License-Identifier: GPL-2.0-or-later
"""Poured beds, for their contacts and their wall layers."""
from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy
import pandas

from studies.common import cases, settling
from studies.common.rows import provenance
from studies.experiments import measures
from studies.packing.measures import HALF_CONTACTS, random_contacts

FORCES = Path(__file__).with_name("in.forces")
SPHERES_DECK = cases.ROOT / "studies" / "speed_accuracy" / "in.bed_spheres"
COLUMNS = ["nx", "ny", "nz", "tx", "ty", "tz", "px", "py", "pz"]


def settle(folder: Path, aspect: float, number: int, friction: float, limits: str, seed: int,
           time: float, build, vessel: float | None = None) -> settling.Settled:
    variables = settling.bed_variables(aspect, seed, limits, number) | {
        "quick": 1, "friction": f"{friction:g}", "total_time": f"{time:g}"}
    if vessel:
        variables["vessel_diameter"] = f"{vessel:.10g}"
    return settling.pour_and_settle(folder, variables, build)


def forces(folder: Path, build) -> tuple[pandas.DataFrame, pandas.DataFrame]:
    """Contacts of the settled bed in `folder`, of pairs and at walls, for measures.bearing."""
    cases.link_decks(folder, [FORCES])
    cases.run_deck(folder, FORCES.name, build=build)
    pairs, walls = (measures.read_frame(folder / f"dump.{name}", "ENTRIES")
                    for name in ("pairs", "walls"))
    pairs.columns = ["i", "j", *COLUMNS]
    walls.columns = ["end", "i", *COLUMNS]
    return pairs, walls.drop(columns="end")


def contacts(folder: Path | str, aspect: float, number: int, friction: float, limits: str,
             seed: int, time: float, gaps: list[float], build) -> dict:
    """A row of one bed."""
    folder = Path(folder)
    bed = settle(folder, aspect, number, friction, limits, seed, time, build)
    vessel, _ = settling.vessel_of(aspect)
    pairs, walls = forces(folder, build)
    rods = measures.read_rods(bed.dump)
    counted = measures.bearing(pairs, walls, rods, friction)
    counted["contacts_inside"] = measures.contacts_inside(pairs, rods, vessel / 2)
    return {"lambda": aspect, "method": "rods", "friction": friction, "limits": limits,
            "rods": number, "end_time_s": bed.end_time, "rested": int(bed.rested), **counted,
            **of_dump(bed.dump, vessel / 2, aspect, gaps, build),
            **provenance(bed.command, seed)}


def of_dump(dump: Path, radius: float, aspect: float, gaps: list[float], build) -> dict:
    """V_f, what random contacts make of it, and how many rods are nearer than each gap."""
    values = cases.measure_bed(dump, radius, build)
    half = HALF_CONTACTS * values["vf_inner"] / random_contacts(aspect, values["mean_sin_gamma"])
    row = {"vf_inner": values["vf_inner"], "elevation_deg": values["mean_elevation_deg"],
           "mean_sin_gamma": values["mean_sin_gamma"], "implied_half_contacts": half}
    with tempfile.TemporaryDirectory() as scratch:
        for gap in gaps:
            path = Path(scratch, "near.csv")
            cases.run_tool("rod_contacts", dump, "--gap", gap, "--csv", path, build=build)
            row[f"nearer_{gap:g}"] = pandas.read_csv(path).iloc[-1]["contacts_per_rod"]
    return row


def contacts_of_spheres(folder: Path | str, aspect: float, number: int, spacing: float, seed: int,
                        time: float, gaps: list[float], build) -> dict:
    """The same of rods glued of spheres; contacts: rods that touch by their spheres."""
    folder = Path(folder)
    bed = settling.settle_spheres(folder, aspect, seed, spacing, SPHERES_DECK, fraction=0.36,
                                  total_time=time, number=number, build=build)
    vessel, _ = settling.vessel_of(aspect)
    touching, places = sphere_contacts(measures.read_frame(folder / "dump.bodies", "ATOMS"))
    return {"lambda": aspect, "method": f"spheres {spacing:g} r apart", "friction": 0.2,
            "limits": "none", "rods": number, "end_time_s": bed.end_time,
            "rested": int(bed.rested), "contacts": 2 * touching / number,
            "places": 2 * places / number,
            **of_dump(bed.dump, vessel / 2, aspect, gaps, build), **provenance(bed.command, seed)}


def sphere_contacts(spheres: pandas.DataFrame) -> tuple[int, int]:
    """Pairs of bodies that touch, and pairs of spheres by which they do. Spheres are alike."""
    from scipy.spatial import cKDTree
    tree = cKDTree(spheres[["x", "y", "z"]].to_numpy())
    pairs = tree.query_pairs(2 * spheres["radius"].max(), output_type="ndarray")
    bodies = spheres["mol"].to_numpy()[pairs]
    bodies = numpy.sort(bodies[bodies[:, 0] != bodies[:, 1]], axis=1)
    return len(numpy.unique(bodies, axis=0)), len(bodies)


def wall(folder: Path | str, aspect: float, friction: float, vessel: float, depth: float, seed: int,
         build) -> list[dict]:
    """Rows of one bed in a wide vessel, one a distance from its side; vessel: diameter, and depth
    of the bed about, over the length of a rod."""
    folder = Path(folder)
    length = aspect * settling.DIAMETER
    volume = settling.mass_of(aspect) / settling.DENSITY
    fraction = 0.9 * random_contacts(aspect, math.pi / 4)
    number = round(fraction * math.pi / 4 * vessel ** 2 * depth * length ** 3 / volume)
    bed = settle(folder, aspect, number, friction, "none", seed, 3.0, build, vessel * length)
    radius, width = vessel * length / 2, 0.1 * length
    cases.run_tool("rod_packing", bed.dump, "--vessel-radius", radius, "--bin", width,
                   "--profiles", folder / "profile", build=build)
    cases.run_tool("rod_orientation", bed.dump, "--vessel-radius", radius, "--wall", "side",
                   "--wall-width", width, "--wall-csv", folder / "order.csv", build=build)
    shells = pandas.read_csv(folder / "profile_radius.csv")
    order = pandas.read_csv(folder / "order.csv")
    middle = (radius - (shells["low_m"] + shells["high_m"]) / 2) / length
    return [{"lambda": aspect, "friction": friction, "rods": number, "kind": kind,
             "distance": d, "value": v, "rested": int(bed.rested),
             **provenance(bed.command, seed)}
            for kind, distances, values in (
                ("vf", middle, shells["vf"]),
                ("radial_order", (order["distance_low_m"] + order["distance_high_m"]) / 2 / length,
                 order["radial_order"]),
                ("elevation_deg", (order["distance_low_m"] + order["distance_high_m"]) / 2 / length,
                 order["mean_elevation_deg"]))
            for d, v in sorted(zip(distances, values)) if d > 0]
