# SPDX-License-Identifier: GPL-2.0-or-later
"""One bed: poured and settled by the decks in `input`, measured, drawn."""
from __future__ import annotations

import re
from pathlib import Path

from studies.common import cases, resume, rows

ROOT = Path(__file__).resolve().parents[2]
DECKS = [ROOT / "input" / f"in.{name}" for name in ("rods", "contact", "fill", "settle")]
ELEVATION_BINS = 12

# Columns of rod_packing and rod_orientation that are kept, and their names in beds.csv.
MEASURES = {"vf_whole": "vf_whole", "vf_inner": "vf_inner", "vf_parkhouse_kelly": "vf_theory",
            "vf_random_contact_measured": "vf_random_contacts",
            "mean_elevation_deg": "mean_elevation_deg", "mean_sin_gamma": "mean_sin_gamma",
            "nematic_order": "nematic_order"}


def deck_variables(path: Path | str) -> dict[str, float]:
    """The `index` variables of a deck that are numbers; of several lines the first counts, as in
    LIGGGHTS. Lines within an `if` are not seen."""
    found: dict[str, float] = {}
    for name, value in re.findall(r"^variable\s+(\S+)\s+index\s+(\S+)", Path(path).read_text(),
                                  re.MULTILINE):
        try:
            found.setdefault(name, float(value))
        except ValueError:
            pass
    return found


def pour(folder: Path | str, aspect: str, friction: str, limits: str, seed: int, variables: dict,
         build) -> dict:
    """Fills and settles; the row of what was run and of what the logs tell."""
    cases.link_decks(folder, DECKS)
    given = {"lambda": aspect, "seed": seed, **variables, "friction": friction}
    if limits == "none":
        given.update(limit_fill=0, limit_settle=0)
    fill = resume.run_deck(folder, "in.fill", given, build=build)
    settle = resume.run_deck(folder, "in.settle", given, build=build)
    case = deck_variables(Path(folder) / "in.case")
    return {
        "lambda": aspect, "friction": friction, "limits": limits, "seed": seed,
        "rods": int(case["rods"]), "vessel_diameter_m": case["vessel_diameter"],
        "dt_s": case["dt"], **log_values(fill.log, settle.log),
        "cpu_s": round(fill.cpu_seconds + settle.cpu_seconds, 1),
        **rows.provenance(f"{fill.command} && {settle.command}", seed),
        "decks": rows.sum_of(*DECKS)}


def log_values(fill: Path, settle: Path) -> dict:
    """What the last line of log.settle tells, and the largest overlap of both logs."""
    # in.contact: contacts a rod, mean and largest overlap now, largest in any step of the stage.
    names = ["time", "energy", "contacts", "contacts.2", "contacts.3", "contacts.4"]
    filling, settling = (cases.last_table(log, names) for log in (fill, settle))
    last = settling.iloc[-1]
    return {"time_s": last["time"], "contacts_per_rod": last["contacts"],
            "mean_overlap_over_diameter": last["contacts.2"],
            "largest_overlap_over_diameter": last["contacts.3"],
            "momentary_overlap_over_diameter": max(filling["contacts.4"].max(),
                                                   settling["contacts.4"].max()),
            "energy_J": last["energy"]}


def measure(dump: Path | str, run: dict, build) -> tuple[dict, object]:
    """The bed's row: `run` with the measures of its last frame; and its distribution of elevation."""
    values = cases.measure_bed(dump, run["vessel_diameter_m"] / 2, build)
    key = {name: run[name] for name in ("lambda", "friction", "limits", "seed")}
    row = {**key, **{ours: values[theirs] for theirs, ours in MEASURES.items()},
           **{name: value for name, value in run.items() if name not in key},
           "measured_by": rows.sum_of(*MEASURED_BY)}
    elevation = cases.measure_elevation(dump, ELEVATION_BINS, build)
    for position, (name, value) in enumerate(key.items()):
        elevation.insert(position, name, value)
    return row, elevation


MEASURED_BY = (*rows.MEASURING_SOURCES, "postproc/tools/rod_packing.cpp",
               "postproc/tools/rod_orientation.cpp")


def render_options(run: dict) -> list:
    return ["--vessel-radius", run["vessel_diameter_m"] / 2, "--timestep", run["dt_s"]]


def size(across: int, high: int, letters: int, scale: float) -> list:
    return ["--size", f"{round(across * scale)}x{round(high * scale)}",
            "--font-size", int(letters * scale)]


def snapshot_style(top: float, scale: float) -> list:
    return ["--top", top, "--view", "side", *size(600, 1800, 19, scale), "--no-colour-bar"]


def bed_style(top: float, cut: bool, scale: float) -> list:
    return ["--top", top, *size(1200, 1000, 34, scale), *(["--cut", "--view", "side"] if cut else [])]


def draw(dump: Path | str, out: Path | str, options: list, build, across: int) -> None:
    """rod_render's picture, made at most `across` pixels wide with few colours, to be kept."""
    from studies.common import pages  # needs what scripts/run does without
    whole = Path(out).with_name(f"unfinished_{Path(out).name}")
    whole.parent.mkdir(parents=True, exist_ok=True)
    cases.run_tool("rod_render", dump, *options, "--out", whole, build=build)
    pages.shrink(whole, out, across)
    whole.unlink()
