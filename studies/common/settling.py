# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds of rods poured and settled until they rest, by the decks of input/, and of rods glued of
spheres from the same poses: what they cost and what they are like."""
from __future__ import annotations

import math
import re
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import pandas

from . import cases
from .rows import provenance, typed

ROOT = cases.ROOT
DECKS = [ROOT / "input" / name for name in ("in.rods", "in.contact", "in.fill", "in.settle")]
TAP = ROOT / "input" / "in.tap"
LAW = ROOT / "examples" / "multisphere" / "in.law"

DIAMETER, DENSITY, GRAVITY = 0.01, 2700.0, 9.81
STIFFNESS = 2.0e4       # N/m times lambda, of the decks
FILL_TIME = 2.0         # s
WINDOW = math.sqrt(20.0 * DIAMETER / GRAVITY)   # s, and
REST_ENERGY = 1e-5      # over m g D, of fix rest/spherocylinder
# Vessel (m) and number of rods where in.rods has none: two rod lengths and a diameter wide, as those
# it has are.
VESSELS = {10.0: (0.21, 500), 20.0: (0.41, 700), 30.0: (0.61, 700)}
OTHER_NUMBER = 400


def vessel_of(aspect: float, number: int | None = None) -> tuple[float, int]:
    """Diameter (m), and the number of rods unless it is given."""
    diameter, usual = VESSELS.get(float(aspect), (DIAMETER * (2.0 * aspect + 1.0), OTHER_NUMBER))
    return diameter, number or usual


def mass_of(aspect: float) -> float:
    """Of a rod (kg): cylinder and two hemispheres."""
    radius = 0.5 * DIAMETER
    return DENSITY * math.pi * radius ** 2 * DIAMETER * (aspect - 1.0 + 2.0 / 3.0)


def time_step_limit(aspect: float, stiffness: float = STIFFNESS) -> float:
    """2 sqrt(m_eff/k) of two rods end to end off their centres, m_eff = m/8 (s)."""
    return 2.0 * math.sqrt(mass_of(aspect) / 8.0 / (stiffness * aspect))


def time_step(aspect: float, stiffness: float, fraction: float) -> float:
    """That fraction of the limit, or a little less: FILL_TIME is a whole number of steps."""
    steps = math.ceil(FILL_TIME / (fraction * time_step_limit(aspect, stiffness)))
    return FILL_TIME / steps * (1.0 + 1e-12)   # so that its ceiling is `steps` for sure


@dataclass(frozen=True)
class Settled:
    dump: Path          # its last frame is the bed at rest, as rods
    cpu_seconds: float
    wall_seconds: float      # of the steps, without what comes before and after
    steps: int
    end_time: float     # s
    rested: bool
    largest_overlap: float   # over D, of any step; NaN if it is not known
    command: str


def bed_variables(aspect: float, seed: int, limits: str = "none",
                  number: int | None = None) -> dict:
    vessel, number = vessel_of(aspect, number)
    variables = {"lambda": f"{aspect:g}", "seed": seed, "vessel_diameter": f"{vessel:g}",
                 "rods": number}
    if limits == "none":
        variables |= {"limit_fill": 0, "limit_settle": 0}
    elif limits != "study":
        raise cases.CaseError(f"limits must be study or none (got {limits})")
    return variables


def pour_and_settle(folder: Path | str, variables: dict, build=None,
                    settling: dict | None = None) -> Settled:
    """in.fill, then in.settle; both are given the same variables, but for those in `settling`."""
    folder = Path(folder)
    cases.link_decks(folder, DECKS)
    fill = cases.run_deck(folder, "in.fill", variables, build=build)
    settle = cases.run_deck(folder, "in.settle", variables | (settling or {}), build=build)
    tables = [cases.read_log(run.log)[-1] for run in (fill, settle)]
    last = tables[1].iloc[-1]
    rested = re.search(r"at rest since step \d+", settle.log.read_text()) is not None
    return Settled(folder / "dump.settle", fill.cpu_seconds + settle.cpu_seconds,
                   fill.loop_seconds + settle.loop_seconds, int(last["Step"]),
                   float(last["time"]), rested,
                   float(max(table.iloc[-1]["contacts.4"] for table in tables)),
                   f"{fill.command} && {settle.command}")


def tap(folder: Path | str, bed: Settled, variables: dict, build=None) -> Settled:
    """in.tap on the bed that pour_and_settle left in `folder`; `rested` and `end_time` stay its own."""
    folder = Path(folder)
    cases.link_decks(folder, [TAP])
    run = cases.run_deck(folder, "in.tap", variables, build=build)
    last = cases.read_log(run.log)[-1].iloc[-1]
    return replace(bed, dump=folder / "dump.tap", cpu_seconds=bed.cpu_seconds + run.cpu_seconds,
                   wall_seconds=bed.wall_seconds + run.loop_seconds,
                   steps=bed.steps + int(last["Step"]),
                   largest_overlap=max(bed.largest_overlap, float(last["contacts.4"])),
                   command=f"{bed.command} && {run.command}")


def settle_rods(folder: Path | str, aspect: float, seed: int, stiffness: float = 1.0,
                fraction: float | None = None, rule: str = "spread", limits: str = "none",
                total_time: float = 10.0, rest: bool = True, number: int | None = None,
                skin: float | None = None, build=None) -> Settled:
    """A bed of true rods. stiffness: over that of the decks; fraction: time step over its limit,
    None for the decks' own step; rule: spread or single contact; skin: of LIGGGHTS's lists, in
    diameters, None for the decks' own."""
    spring = stiffness * STIFFNESS
    step = time_step(aspect, spring, fraction) if fraction else 2.0e-5
    variables = bed_variables(aspect, seed, limits, number) | {
        "stiffness": f"{spring:g}", "dt": f"{step:.17g}", "total_time": f"{total_time:g}",
        "stop_at_rest": int(rest), "spread_contact": {"spread": "on", "single": "off"}[rule],
        "thermo_every": round(0.1 / step),
        "dump_every": round(total_time / step)}
    if skin is not None:
        variables["skin_diameters"] = f"{skin:g}"
    return pour_and_settle(folder, variables, build)


def settle_spheres(folder: Path | str, aspect: float, seed: int, spacing: float, deck: Path | str,
                   contacts: float = 1.0, stiffness: float = 1.0, fraction: float = 0.09,
                   total_time: float = 4.0, number: int | None = None, build=None) -> Settled:
    """The same bed of rods glued of spheres `spacing` radii apart, by the stock liggghts; stiffness
    and damping of a contact divided by `contacts`. The time step is over the limit of the rods."""
    folder = Path(folder)
    spring = stiffness * STIFFNESS
    step = time_step(aspect, spring, fraction)
    cases.link_decks(folder / "start", DECKS)
    cases.link_decks(folder, [deck, LAW])
    # The poses as they are placed: after one step of a picosecond.
    start = cases.run_deck(folder / "start", "in.fill", bed_variables(aspect, seed, number=number) | {
        "dt": "1e-12", "fill_time": "1e-12", "dump_every": 1}, build=build)
    glue = ("--spacing", spacing, "--density", DENSITY, "--out")
    cases.run_tool("rods_to_multisphere", folder / "start" / "dump.fill", *glue, folder / "peer",
                   build=build)
    for name in ("peer.bodies", "peer.box"):   # paths from the folder of the run
        path = folder / name
        path.write_text(path.read_text().replace(f"{folder}/", ""))
    vessel, number = vessel_of(aspect, number)
    run = cases.run_deck(folder, Path(deck).name, {
        "rods": "peer", "vessel_radius": f"{vessel / 2:g}", "kn": f"{spring * aspect:.10g}",
        "contacts": f"{contacts:g}", "dt": f"{step:.17g}",
        "rest_energy": f"{REST_ENERGY * number * mass_of(aspect) * GRAVITY * DIAMETER:.10g}",
        "window": f"{WINDOW:.6g}", "fall_time": 1.6, "total_time": f"{total_time:g}",
        "dump": "dump.bodies"}, program="liggghts")
    tables = cases.read_log(run.log)
    last = tables[-1].iloc[-1]
    rods = folder / "dump.rods"
    cases.run_tool("multisphere_to_rods", folder / "dump.bodies", "--out", rods, build=build)
    steps = int(last["Step"])
    command = " && ".join([
        f"(cd start && {start.command})",
        typed(["rods_to_multisphere", "start/dump.fill", *glue, "peer"]), run.command,
        typed(["multisphere_to_rods", "dump.bodies", "--out", "dump.rods"])])
    return Settled(rods, run.cpu_seconds, run.loop_seconds, steps, steps * step,
                   steps * step < total_time - 0.011, math.nan, command)


def measure(bed: Settled, aspect: float, seed: int, build=None, vessel: float | None = None,
            more: tuple = ()) -> dict:
    """A row of the settled bed. vessel: diameter (m), where it is not that of the decks; more: further
    columns of rod_packing and rod_orientation."""
    vessel = vessel or vessel_of(aspect)[0]
    values = cases.measure_bed(bed.dump, vessel / 2, build)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "contacts.csv")
        cases.run_tool("rod_contacts", bed.dump, "--vessel-radius", vessel / 2, "--csv", path,
                       build=build)
        touch = pandas.read_csv(path).iloc[-1]
    return {"rested": int(bed.rested), "end_time_s": bed.end_time, "steps": bed.steps,
            "cpu_s": bed.cpu_seconds, "vf_whole": values["vf_whole"],
            "vf_inner": values["vf_inner"], "elevation_deg": values["mean_elevation_deg"],
            "contacts": touch["contacts_per_rod"],
            "overlap_mean": touch["overlap_mean_diameters"],
            "overlap_max": touch["overlap_max_diameters"],
            "overlap_ever": bed.largest_overlap, **{name: values[name] for name in more},
            **provenance(bed.command, seed)}
