# SPDX-License-Identifier: GPL-2.0-or-later
"""What each feature of a scene costs: instructions and time of a step, memory."""
from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy
import pandas

from studies.common import cases
from studies.common.rows import provenance, write_rows

HERE = Path(__file__).resolve().parent
DECK = HERE / "in.cost"
VESSEL = 0.105   # m, radius

# A scene: the size of its particles and their surroundings, and its own features.
SCENES = {
    "gas": {"title": "frictionless gas", "aspect": 10, "vessel": 0, "speed": 0.5,
            "features": {}},
    "bed": {"title": "frictional bed", "aspect": 10, "vessel": VESSEL, "speed": 0,
            "features": {"tangential": "history", "gravity": True}},
    "cohesive": {"title": "cohesive bed", "aspect": 10, "vessel": VESSEL, "speed": 0,
                 "features": {"tangential": "history", "cohesion": "sjkr", "gravity": True}},
    "spheres": {"title": "spheres only", "aspect": 1, "vessel": 0.03, "speed": 0,
                "features": {"tangential": "history", "gravity": True}},
    "study": {"title": "the study's bed, λ = 30", "aspect": 30, "vessel": 0.305, "speed": 0,
              "features": {"tangential": "history", "gravity": True, "limit": 0.2 * 3.14159265,
                           "output": True}},
}
# A change of a scene: the features it has instead. What is named `off` costs nothing if all of its
# numbers are those of the scene as it is.
FIRST = "as it is"   # what the others are compared with
CHANGES = {
    FIRST: {},
    "without friction": {"tangential": "off"},
    "friction without history": {"tangential": "no_history"},
    "friction with history": {"tangential": "history"},
    "spread contact off": {"spread": "off"},
    "cohesion off": {"cohesion": None},
    "cohesion sjkr": {"cohesion": "sjkr"},
    "rolling friction cdt": {"rolling": "cdt"},
    "rolling friction epsd2": {"rolling": "epsd2"},
    "limit/omega": {"limit": 12.566},
    "without limit/omega": {"limit": None},
    "fix rest": {"rest": True},
    "one wall more": {"walls": True},
    "outputs": {"output": True},
    "without outputs": {"output": None},
    "all off by name": {"named": True},
    "as rods, hooke/stiffness": {"model": "hooke/stiffness"},
    "stock spheres in lmp": {"model": "hooke/stiffness", "atoms": "sphere"},
    "stock spheres in liggghts": {"model": "hooke/stiffness", "atoms": "sphere",
                                  "program": "liggghts"},
}


def commands(scene: dict, change: dict) -> str:
    """The deck's part that has the features."""
    has = {"model": "linear", "tangential": "off", "spread": None, "cohesion": None,
           "rolling": None, "limit": None, "rest": False, "walls": False, "output": False,
           "named": False, "gravity": False, "atoms": "spherocylinder",
           **scene["features"], **change}
    kn = 2.0e4 * scene["aspect"]
    lines = [f"fix kn all property/global kn peratomtypepair 1 {kn:g}"]
    rods = has["atoms"] == "spherocylinder"
    if has["model"] == "linear":
        lines += [f"fix kt all property/global kt peratomtypepair 1 {kn * 2 / 7:g}",
                  "fix en all property/global coefficientRestitution peratomtypepair 1 0.5"]
    else:
        rate = 0.4309 * (kn / 0.00071) ** 0.5   # e = 0.5 of two spheres of 1.4 g
        lines += [f"fix kt all property/global kt peratomtypepair 1 {kn * 2 / 7:g}",
                  f"fix gn all property/global gamman peratomtypepair 1 {rate:g}",
                  f"fix gt all property/global gammat peratomtypepair 1 {rate:g}"]
    if has["tangential"] != "off":
        lines += ["fix mu all property/global coefficientFriction peratomtypepair 1 0.2"]
    if has["cohesion"]:
        lines += ["fix co all property/global cohesionEnergyDensity peratomtypepair 1 1.0e4"]
    if has["rolling"]:
        lines += ["fix ro all property/global coefficientRollingFriction peratomtypepair 1 0.05"]
    models = f"model {has['model']} tangential {has['tangential']}"
    for keyword, name in (("cohesion", has["cohesion"]), ("rolling_friction", has["rolling"])):
        models += f" {keyword} {name or 'off'}" if name or has["named"] else ""
    if rods:
        models += " surface spherocylinder"
    keywords = f" spread_contact {has['spread']}" if has["spread"] else ""
    if has["named"]:
        keywords += " spread_contact on sudden_overlap off"
    lines += [f"pair_style gran {models}{keywords}", "pair_coeff * *"]
    if scene["vessel"]:
        lines += [f"fix floor all wall/gran {models} primitive type 1 zplane 0.0",
                  f"fix side all wall/gran {models} primitive type 1 zcylinder "
                  f"{scene['vessel']:g} 0.0 0.0"]
    if has["walls"]:
        lines += [f"fix below all wall/gran {models} primitive type 1 zplane -0.04"]
    if has["gravity"]:
        lines += ["fix gravity all gravity 9.81 vector 0.0 0.0 -1.0"]
    lines += [f"fix motion all nve/{'spherocylinder' if rods else 'sphere'}"]
    if has["limit"]:
        lines += [f"fix limit all limit/omega {has['limit']:g}"]
    if has["rest"]:
        lines += ["fix rested all rest/spherocylinder 100 energy 1e-300"]
    if has["output"]:   # as the decks of input/ have it: a log line in 5000 steps, a frame in 25000
        lines += ["compute contacts all contact/spherocylinder",
                  "compute erotate all erotate/spherocylinder",
                  "thermo_style custom step atoms ke c_erotate c_contacts[1] c_contacts[3] cpu",
                  "dump frames all custom 25000 dump.frames id x y z quat1 quat2 quat3 quat4 "
                  "c_contacts"]
    return "\n".join(lines) + "\n"


def variables(scene: dict, change: dict, number: int, seed: int, steps: int, start: int) -> dict:
    aspect, vessel = scene["aspect"], scene["vessel"]
    length = 0.01 * aspect
    solid = 7.854e-7 * (aspect - 1 / 3)   # volume of a rod (m^3)
    if vessel:
        # A tenth solid where they are placed: they fall from a height that they fill.
        drop = number * solid / (0.02 * 3.1416 * vessel ** 2) + 2 * length
        box, height, boundary = vessel + length, drop + length, "f"
    else:
        # 5 % solid; rods are placed half a length from its faces.
        side = max((number * solid / 0.05) ** (1 / 3), 3 * length)
        drop, box, height, boundary = 1.0, side / 2, side - 0.05, "p"
    atoms = change.get("atoms", "spherocylinder")
    return {"atoms": atoms, "spheres": int(atoms == "sphere"), "boundary": boundary,
            "box": f"{box:.6g}", "height": f"{height:.6g}", "rods": number, "seed": seed,
            "length": f"{length:g}", "vessel": vessel, "drop": f"{drop:.6g}",
            "speed": scene["speed"], "features": "features", "dt": "2e-5", "steps": steps,
            "start": start}


def megabytes(log: Path) -> float:
    """What LIGGGHTS says its arrays, lists and fixes take."""
    found = re.findall(r"^Memory usage per processor = (\S+) Mbytes", log.read_text(), re.MULTILINE)
    return float(found[-1])


def contacts(folder: Path, scene: dict, change: dict, values: dict, build) -> float:
    """Contacts a rod of the bed whose steps are counted; NaN of stock spheres."""
    if change.get("atoms", "spherocylinder") != "spherocylinder":
        return numpy.nan
    run = cases.run_deck(folder, "in.cost", values | {"steps": 1, "contacts": 1}, build=build,
                         name="contacts")
    return float(cases.read_log(run.log)[-1].iloc[-1]["pairs[1]"])


def count(path, name: str, names: list[str], number: int, seed: int, start_steps: int,
          counted_steps: int, build) -> None:
    """Writes a row a change of a scene: instructions a particle and step, and memory."""
    scene = SCENES[name]
    result = []
    for label in names:
        change = CHANGES[label]
        folder = Path(path).resolve().with_suffix("") / re.sub(r"\W+", "_", label)
        shutil.rmtree(folder, ignore_errors=True)
        cases.link_decks(folder, [DECK])
        (folder / "features").write_text(commands(scene, change))
        program = change.get("program", "lmp")
        start = cases.run_deck(folder, "in.cost", variables(scene, change, number, seed, start_steps, 1),
                               program=program, build=build, name="start")
        values = variables(scene, change, number, seed, counted_steps, 0)
        run = cases.run_deck(folder, "in.cost", values, program=program, build=build, name="memory")
        touching = contacts(folder, scene, change, values, build)
        instructions, counting = cases.run_counted(folder, "in.cost", values, program, build,
                                                   name="callgrind")
        result.append({"scene": name, "change": label, "particles": number,
                       "steps": counted_steps,
                       "instructions": instructions / (number * counted_steps),
                       "megabytes": megabytes(run.log), "contacts": touching,
                       **provenance(f"{start.command} && {run.command} && {counting}", seed)})
    write_rows(path, result)


def time(path, name: str, names: list[str], folder, number: int, seed: int, steps: int, turns: int,
         build) -> None:
    """Writes the microseconds a particle and step of each change, in turns, from the restarts of
    `count` in `folder`."""
    scene = SCENES[name]
    seconds: dict[str, list[float]] = {label: [] for label in names}
    commands_of = {}
    for _ in range(turns):
        for label in names:
            change = CHANGES[label]
            case = Path(folder).resolve() / re.sub(r"\W+", "_", label)
            run = cases.run_deck(case, "in.cost", variables(scene, change, number, seed, steps, 0),
                                 program=change.get("program", "lmp"), build=build, name="time")
            seconds[label].append(run.loop_seconds)
            commands_of[label] = run.command
    first = seconds[names[0]]
    scale = 1e6 / (number * steps)
    write_rows(path, [{
        "scene": name, "change": label, "microseconds": scale * numpy.median(values),
        "microseconds_min": scale * min(values), "microseconds_max": scale * max(values),
        "times": numpy.median([v / f for v, f in zip(values, first)]), "turns": turns,
        **provenance(commands_of[label], seed)} for label, values in seconds.items()])


def together(counted: list[pandas.DataFrame], timed: list[pandas.DataFrame]) -> pandas.DataFrame:
    """One table: what each change adds to its scene as it is. Of one plug-in, or it would be compared
    with another one."""
    versions = sorted({str(version) for part in (*counted, *timed) for version in part["version"]})
    if len(versions) > 1:
        raise cases.CaseError(f"features are compared that are of {len(versions)} versions of the plug-in "
                              f"({', '.join(versions)}): make all of them anew, with "
                              "--forcerun feature_counts")
    table = pandas.concat(counted, ignore_index=True)
    first = table.groupby("scene")[["instructions", "megabytes"]].transform("first")
    table["instructions_times"] = table["instructions"] / first["instructions"]
    table["megabytes_more"] = table["megabytes"] - first["megabytes"]
    if timed:
        keep = ["scene", "change", "microseconds", "microseconds_min", "microseconds_max", "times",
                "turns", "command", "machine"]
        table = table.merge(pandas.concat(timed)[keep], on=["scene", "change"], how="left",
                            suffixes=("", "_timed"))
        has, also = table["command_timed"].notna(), table["machine_timed"].fillna(table["machine"])
        table.loc[has, "command"] += " && " + table["command_timed"]
        table.loc[also != table["machine"], "machine"] += ", timed on " + also
        table = table.drop(columns=["command_timed", "machine_timed"])
    return table
