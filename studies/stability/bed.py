# SPDX-License-Identifier: GPL-2.0-or-later
"""One point of a map: a small bed poured and settled by in.bed, and what became of it."""
from __future__ import annotations

import math
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy
import pandas

from studies.common import cases, settling
from studies.common.rows import provenance
from studies.stability import states

HERE = Path(__file__).resolve().parent
DECK, GLUED = HERE / "in.bed", HERE / "in.glued"
TURN = 2.0 * math.pi

# Each part of the method, as the plug-in has it, and what it can be replaced by.
PARTS = {
    "mass": {"keywords": "effective_mass off"},      # damping by the mass of whole rods
    "rotation": {"rotation": "rotation plain"},
    "search": {"pair_keywords": "search five_step"},
    "single": {"pair_keywords": "spread_contact off"},
    "memory": {"tangential": "no_history"},
}
# What a method is made of: the parts that are replaced, and the limit on the angular velocity while
# rods fall and after (rad/s).
LIMITS = {
    "none": (0.0, 0.0, "total"),
    "4pi": (2 * TURN, 2 * TURN, "total"),
    "4pi_transverse": (2 * TURN, 2 * TURN, "transverse"),
    "0.2pi": (0.1 * TURN, 0.1 * TURN, "total"),
    "0.2pi_transverse": (0.1 * TURN, 0.1 * TURN, "transverse"),
    "study": (2 * TURN, 0.1 * TURN, "total"),
    "study_transverse": (2 * TURN, 0.1 * TURN, "transverse"),
}
PLAIN = ("mass", "rotation", "search", "single")   # all that a first program of rods does plainly


@dataclass(frozen=True)
class Point:
    aspect: float = 30.0
    fraction: float = 0.18       # time step over the limit of thin rods
    without: tuple = ()          # of PARTS
    limit: str = "none"
    stiffness: float = 1.0       # over that of the decks
    restitution: float = 0.5
    friction: float = 0.2
    speed: float = 0.0           # with which rods are thrown down (m/s)
    rods: int = 40
    drop: float = 2.5            # m
    vessel: float = 0.0          # diameter (m), 0: that of the maps
    time: float = 0.0            # s, 0: that of the maps
    seed: int = 86028121
    rest: bool = True            # ends once the rods rest
    frames: bool = True          # looks for rods that pass through each other
    spheres: int = 0             # glued, a rod; 0: a true rod


def method_of(name: str) -> tuple[tuple, str]:
    """Parts that are replaced and the limit, of a name such as `ours`, `ours-mass-search`, `plain`,
    `plain+mass` or `ours@0.2pi`."""
    name, _, limit = name.partition("@")
    words = re.split(r"([+-])", name)
    if words[0] not in ("ours", "plain") or (limit or "none") not in LIMITS:
        raise cases.CaseError(f"a method is ours or plain with -part or +part and @limit, parts "
                              f"{', '.join(PARTS)}, limits {', '.join(LIMITS)} (got {name}"
                              f"{'@' + limit if limit else ''})")
    without = set(PLAIN if words[0] == "plain" else ())
    for sign, part in zip(words[1::2], words[2::2]):
        if part not in PARTS:
            raise cases.CaseError(f"a part of a method is one of {', '.join(PARTS)} (got {part})")
        without = without - {part} if sign == "+" else without | {part}
    return tuple(sorted(without)), limit or "none"


def vessel_of(point: Point) -> float:
    """Diameter (m): 1.25 rod lengths, and 6 diameters at least."""
    return point.vessel or settling.DIAMETER * max(1.25 * point.aspect, 6.0)


def landing_time(point: Point) -> float:
    """When the highest rod has come down (s)."""
    g, v = settling.GRAVITY, point.speed
    return (math.sqrt(v * v + 2 * g * point.drop) - v) / g


def time_of(point: Point) -> float:
    """Rods land, and lie down in some of √(L/g)."""
    tumble = math.sqrt(point.aspect * settling.DIAMETER / settling.GRAVITY)
    return point.time or max(2.5, landing_time(point) + 12.0 * tumble)


def variables(point: Point) -> dict:
    """Of in.bed."""
    step = point.fraction * settling.time_step_limit(point.aspect,
                                                     point.stiffness * settling.STIFFNESS)
    fill, settle, part = LIMITS[point.limit]
    steps = math.ceil(time_of(point) / step)
    words = {"tangential": "history", "keywords": [], "pair_keywords": ["sudden_overlap on"],
             "rotation": []}
    for name in point.without:
        for key, value in PARTS[name].items():
            if key == "tangential":
                words[key] = value
            else:
                words[key].append(value)
    return {
        "lambda": f"{point.aspect:g}", "rods": point.rods, "seed": point.seed,
        "diameter": settling.DIAMETER, "density": settling.DENSITY,
        "vessel": f"{0.5 * vessel_of(point):.10g}", "drop": f"{point.drop:g}",
        "speed": f"{point.speed:g}", "stiffness": f"{point.stiffness * settling.STIFFNESS:g}",
        "restitution": f"{point.restitution:g}", "friction": f"{point.friction:g}",
        "dt": f"{step:.17g}", "steps": steps,
        "fill_steps": steps if fill == settle else min(steps,
                                                       math.ceil(landing_time(point) / step)),
        "tangential": words["tangential"], "keywords": " ".join(words["keywords"]),
        "pair_keywords": " ".join(words["pair_keywords"]), "rotation": " ".join(words["rotation"]),
        "limit_fill": f"{fill:.17g}", "limit_settle": f"{settle:.17g}", "limit_part": part,
        "rest": int(point.rest), "thermo_every": max(1, round(0.01 / step)),
        "dump_every": max(1, round(0.002 / step)), "frames": int(point.frames), "start": 0,
        "history_every": 0}


def series(log: Path) -> tuple[pandas.DataFrame, float, bool]:
    """All of the run's lines, the largest overlap of any step over D, and whether the bed
    rested."""
    tables = [t for t in cases.read_log(log) if "height" in t]
    tables = [t.set_axis(["step", "time", "atoms", "moving", "turning", "height", "contacts",
                          "overlap_mean", "overlap_max", "overlap_ever", "force", "torque",
                          "rested", "cpu"], axis=1) for t in tables]
    table = pandas.concat(tables, ignore_index=True).drop_duplicates("step", keep="first")
    return table, float(max(t["overlap_ever"].max() for t in tables)), \
        bool(max(t["rested"].max() for t in tables) > 0)


def attempt(folder: Path, deck: Path | str, values: dict, build,
            program: str = "lmp") -> tuple[str | None, str, float]:
    """Runs a deck; the sentence that ended it, if it was no mistake, the command and the
    seconds."""
    try:
        done = cases.run_deck(folder, deck, values, program=program, build=build)
        return None, done.command, done.cpu_seconds
    except cases.DeckError as error:
        log = folder / f"log.{Path(deck).name.removeprefix('in.')}"
        if not log.exists() or not re.search(r"^ *Step .*height", log.read_text(errors="replace"),
                                             re.MULTILINE):
            raise   # it did not come to the first step
        return error.reason, error.command, math.nan


def pour(folder: Path | str, point: Point, build) -> tuple[pandas.DataFrame, dict]:
    """Runs a point: its series, and what is known of it beside the series."""
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    failure, command, seconds = attempt(folder, DECK, variables(point), build)
    table, ever, rested = series(folder / "log.bed")
    centre, axis = states.read_frames(folder / "dump.frames", point.rods) if point.frames \
        else (numpy.zeros((0, 0, 3)),) * 2
    removed = re.findall(r"^limit: (\S+) J", (folder / "log.bed").read_text(errors="replace"),
                         re.MULTILINE)
    last = table.iloc[-1]
    return table, {
        "failure": failure, "command": command, "cpu_s": seconds, "rested": rested,
        "centre": centre, "axis": axis, "removed": sum(map(float, removed)),
        "contacts": last["contacts"], "overlap_mean": last["overlap_mean"],
        "overlap_max": last["overlap_max"], "overlap_ever": ever}


def pour_glued(folder: Path | str, point: Point, build) -> tuple[pandas.DataFrame, dict]:
    """The same of rods glued of spheres, from the same poses, damped for the mass of whole rods as
    the stock program does. It tells no torques, overlaps and contacts of rods."""
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    cases.link_decks(folder, [settling.LAW, GLUED])
    values = variables(point)
    cases.run_deck(folder, DECK, values | {"start": 1}, build=build, name="start")
    spacing = 2.0 * (point.aspect - 1.0) / (point.spheres - 1)
    cases.run_tool("rods_to_multisphere", folder / "dump.placed", "--spacing", f"{spacing:.12g}",
                   "--density", settling.DENSITY, "--out", folder / "peer", build=build)
    for name in ("peer.bodies", "peer.box"):   # paths from the folder of the run
        path = folder / name
        path.write_text(path.read_text().replace(f"{folder}/", ""))
    failure, command, seconds = attempt(folder, GLUED.name, {
        "rods": "peer", "kn": f"{point.stiffness * settling.STIFFNESS * point.aspect:.10g}",
        **{name: values[name] for name in ("vessel", "dt", "steps", "thermo_every", "dump_every",
                                           "restitution", "friction")}}, build, "liggghts")
    table = cases.read_log(folder / "log.glued")[-1]
    weight = settling.mass_of(point.aspect) * settling.GRAVITY
    parts = [name for name in table if name.startswith(("most", "least"))]
    table = table.set_axis([name.lower() for name in table], axis=1).assign(
        force=table[parts].abs().max(axis=1) / weight, torque=0.0)
    centre, axis = glued_frames(folder / "dump.frames", point.rods)
    return table, {
        "failure": failure, "command": command, "cpu_s": seconds, "rested": False,
        "centre": centre, "axis": axis, "removed": 0.0,
        **{name: math.nan for name in ("contacts", "overlap_mean", "overlap_max", "overlap_ever")}}


def glued_frames(path: Path, rods: int) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Centres and axes of in.glued's bodies: of the three the axis is that of the least moment."""
    t = states.numbers_of(path, rods, 15)
    least = int(numpy.argmin(t[0, 0, 12:15]))
    return t[..., :3], t[..., 3 + 3 * least:6 + 3 * least]


def run(folder: Path | str, point: Point, build) -> dict:
    """Runs a point and gives its row."""
    table, known = (pour_glued if point.spheres else pour)(folder, point, build)
    through = states.passed(known["centre"], known["axis"],
                            (point.aspect - 1.0) * settling.DIAMETER)
    landed = landing_time(point) + 0.05
    state = states.state_of(table, point.aspect, point.rods, landed, known["rested"],
                            known["failure"], through, point.limit != "none")
    kinetic, total = states.energies(table, point.aspect, point.rods)
    end = table["time"] > table["time"].iloc[-1] - states.END
    last = table.iloc[-1]
    scale = point.rods * settling.mass_of(point.aspect) * settling.GRAVITY * settling.DIAMETER
    return {
        "lambda": point.aspect, "fraction": point.fraction, "spheres": point.spheres,
        "restitution": point.restitution, "friction": point.friction,
        "stiffness": point.stiffness, "speed": point.speed, "rods": point.rods, "fall": point.drop,
        "state": state,
        "end_s": last["time"], "kinetic": float(kinetic[end].mean()),
        "energy_rise": states.largest_rise(total[table["time"] >= landed]),
        "passed_pairs": through, "force": float(table["force"][end].median()),
        "contacts": known["contacts"], "overlap_mean": known["overlap_mean"],
        "overlap_max": known["overlap_max"], "overlap_ever": known["overlap_ever"],
        "height": last["height"] / settling.DIAMETER, "removed": known["removed"] / scale,
        "ended_by": known["failure"] or "", "cpu_s": known["cpu_s"],
        **provenance(known["command"], point.seed)}
