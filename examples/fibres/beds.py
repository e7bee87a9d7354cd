# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds of fibres, poured by the decks of input/ as rods are, and what a plate needs that presses them."""
from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy
import pandas

from studies.common import cases, settling
from studies.common.rows import provenance, read_rows, write_rows

PRESS = [Path(__file__).with_name(name) for name in ("in.press", "plate.stl")]
RIGID = "rigid"   # the level of B of rods

# Of a bed: the name in the tables, and the words of the page.
QUANTITIES = {"vf_inner": "V_f, inner cylinder", "vf_whole": "V_f, whole vessel",
              "elevation_deg": "elevation of segments", "elevation_ends_deg": "of the line from end to end",
              "contacts": "contacts a fibre"}


def level(bending: str) -> float:
    """B of a level; of rods infinite."""
    return math.inf if bending == RIGID else float(bending)


def variables_of(aspect: float, bending: str, segments: int, seed: int, told: dict, friction: float,
                 quick: bool) -> dict:
    """Of in.fill and in.settle; `told`: the bed of config.yaml."""
    drop = math.sqrt(2.0 * float(told["height"]) / settling.GRAVITY)
    variables = {
        "lambda": f"{aspect:g}", "seed": seed, "vessel_diameter": f"{told['vessel']:g}",
        "vessel_height": f"{told['height']:g}", "rods": told["rods"], "friction": f"{friction:g}",
        "limit_fill": 0, "limit_settle": 0, "fill_time": f"{drop + 0.2:.3g}",
        "total_time": f"{told['total_time']:g}", "quick": int(quick), "stop_at_rest": 1,
        "dump_every": 5000, "skin_diameters": 10}
    if bending != RIGID:
        variables |= {"segments": segments, "bending": bending}
        variables |= {name: told[name] for name in ("rest_energy",) if name in told}
    return variables


def table_of(tool: str, dump: Path, *options, build, option: str = "--csv") -> dict:
    """The last row of what a post-processor tells of a bed."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "table.csv")
        cases.run_tool(tool, dump, *options, option, path, build=build)
        return pandas.read_csv(path).iloc[-1].to_dict()


def measured(dump: Path, vessel: float, length: float, fibres: bool, build) -> dict:
    """Fractions, elevations, contacts and shapes; what only fibres have is empty for rods."""
    walls = ("--vessel-radius", vessel / 2)
    packing = table_of("rod_packing", dump, *walls, build=build)
    touch = table_of("rod_contacts", dump, *walls, build=build)
    order = table_of("rod_orientation", dump, build=build, option="--summary-csv")
    ends = order
    if fibres:
        ends = table_of("rod_orientation", dump, "--by", "fibre", build=build, option="--summary-csv")
    number = touch["fibres"] if fibres else touch["rods"]
    return {
        "vf_inner": packing["vf_inner"], "vf_whole": packing["vf_whole"],
        "elevation_deg": order["mean_elevation_deg"], "elevation_ends_deg": ends["mean_elevation_deg"],
        "contacts": touch["contacts_per_fibre" if fibres else "contacts_per_rod"],
        "contacts_with_walls": touch[f"contacts_per_{'fibre' if fibres else 'rod'}_with_walls"],
        "touched": touch["fibres_touched_per_fibre"] if fibres else math.nan,
        "self_contacts": touch["self_contacts"] / number if fibres else 0.0,
        "stretch": order["end_to_end_over_contour"] if fibres else 1.0,
        "curvature": order["mean_curvature_per_m"] * length if fibres else 0.0,
        "overlap_mean": touch["overlap_mean_diameters"], "overlap_max": touch["overlap_max_diameters"]}


def bed(path: str, aspect: float, bending: str, segments: int, seed: int, told: dict, friction: float,
        quick: bool, build) -> None:
    """Writes the row of a bed; dump.settle and restart.settle stay beside it, in a folder."""
    folder = Path(path).resolve().with_suffix("")
    variables = variables_of(aspect, bending, segments, seed, told, friction, quick)
    settled = settling.pour_and_settle(folder, variables, build)
    fibres = bending != RIGID
    last = cases.read_log(folder / "log.settle")[-1].iloc[-1]
    row = measured(settled.dump, float(told["vessel"]), aspect * settling.DIAMETER, fibres, build)
    weight = told["rods"] * settling.mass_of(aspect) * settling.GRAVITY * settling.DIAMETER
    write_rows(path, [{
        "lambda": aspect, "segments": segments if fibres else 1, "bending": level(bending), "friction": friction,
        "seed": seed, "fibres": told["rods"], "lengths_wide": told["vessel"] / (aspect * settling.DIAMETER),
        "rested": int(settled.rested), "end_time_s": settled.end_time, "steps": settled.steps,
        "cpu_s": settled.cpu_seconds, **row, "overlap_ever": settled.largest_overlap,
        "kinetic_over_mgd": last["energy"] / weight,
        "joints_over_mgd": last["joints"] / weight if fibres else 0.0,
        **{name: value for name, value in provenance(settled.command, seed).items() if name != "seed"}}])
    for old in [*folder.glob("restart.fill*"), *folder.glob("dump.fill*")]:
        old.unlink()


def press(path: str, bed_folder: str, settings: dict, yield_curvature: float, seed: int, build) -> None:
    """Presses the bed that is there; writes the rows of its cycles and, to PATH.loop.csv, of the plate's way."""
    folder = Path(path).resolve().with_suffix("")
    cases.link_decks(folder, [*settling.DECKS, *PRESS])
    for name in ("in.case", "restart.settle"):
        link = folder / name
        link.unlink(missing_ok=True)
        link.symlink_to(Path(bed_folder).resolve() / name)
    run = cases.run_deck(folder, "in.press", {
        "strain": f"{settings['strain']:g}", "cycles": settings["cycles"], "speed": f"{settings['speed']:g}",
        "yield_curvature": f"{yield_curvature:g}"}, build=build)
    loop = pandas.read_csv(folder / "press.csv")
    told = {"lambda": float(settings["lambda"]), "bending": float(settings["bending"]),
            "yield_curvature": yield_curvature, "seed": seed}
    found = cycles_of(loop, int(settings["cycles"]))
    origin = {name: value for name, value in provenance(run.command, seed).items() if name != "seed"}
    write_rows(path, found.assign(**told, **origin)[[*told, *found.columns, *origin]])
    kept = loop[["height_m", "force_N", "joints_J", "yielded_J"]].applymap(lambda value: float(f"{value:.5g}"))
    write_rows(Path(path).with_suffix(".loop.csv"), kept.assign(**told)[[*told, *kept.columns]])


def cycles_of(loop: pandas.DataFrame, cycles: int) -> pandas.DataFrame:
    """A row a cycle, which begins where the plate stands highest (the first: where it comes to the bed): work done on
    the bed on the way down, what comes back, what is lost; largest force; height from which on the force stays above a
    tenth of that on the way down; what joints took by yielding."""
    height, force = loop["height_m"].to_numpy(), loop["force_N"].to_numpy()
    low = lowest(height, cycles)
    starts = [0] + [a + int(numpy.argmax(height[a:b])) for a, b in zip(low, low[1:])] + [len(height) - 1]
    rows = []
    for number, (first, turn, last) in enumerate(zip(starts, low, starts[1:]), 1):
        down, up = slice(first, turn + 1), slice(turn, last + 1)
        done = -numpy.trapz(force[down], height[down])
        back = numpy.trapz(force[up], height[up])
        most = float(force[down].max())
        light = numpy.flatnonzero(force[down] <= 0.1 * most)
        rows.append({
            "cycle": number, "work_J": done, "returned_J": back, "lost_J": done - back, "lost_part": 1 - back / done,
            "force_max_N": most, "height_low_m": float(height[turn]),
            "height_touched_m": float(height[min(first + light.max(initial=-1) + 1, turn)]),
            "yielded_J": float(loop["yielded_J"].iloc[last] - loop["yielded_J"].iloc[first]),
            "joints_change_J": float(loop["joints_J"].iloc[last] - loop["joints_J"].iloc[first])})
    return pandas.DataFrame(rows)


def lowest(height: numpy.ndarray, cycles: int) -> list[int]:
    """Where the plate turns at the lower end."""
    turned = [i for i in range(1, len(height) - 1) if height[i] <= height[i - 1] and height[i] < height[i + 1]]
    if len(turned) != cycles:
        raise cases.CaseError(f"the plate turned {len(turned)} times at the lower end (wanted {cycles})")
    return turned


def read_beds(path: str) -> pandas.DataFrame:
    return read_rows(path).sort_values(["lambda", "segments", "bending", "seed"], ignore_index=True)
