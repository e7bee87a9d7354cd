#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Whole scenes timed, the plug-in beside its peers, rods glued of spheres or as many spheres, and beside
itself in other walls: how a scene begins, its timed runs in turns, its rows, the figure. The Snakefile calls it:
    speed.py start SCENE LAMBDA RODS --settings JSON --build DIR --folder DIR
    speed.py time SCENE LAMBDA RODS RANKS --settings JSON --build DIR --folder DIR --out CSV
and by hand, to put the cases of one table into another, in the place of those it has of them, and to count
the instructions of so many steps of rods, by valgrind, in each of a scene's walls:
    speed.py add CSV --to CSV
    speed.py count SCENE LAMBDA RODS STEPS --build DIR --folder DIR
"""
from __future__ import annotations

import argparse
import json
import math
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy
import pandas

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]

from bench import meshes, one_sphere  # noqa: E402
from studies.common import cases, plots, rows  # noqa: E402

DIAMETER, DENSITY = 0.01, 2700  # m, kg/m³; those of input/in.rods
STIFFNESS = 2.0e4               # N/m, times lambda; the same
MOST_PLACED = 2000              # rods of a gas; larger ones are copies of it
COPIES = {10: (5, 2, 1), 100: (5, 5, 4), 500: (10, 10, 5)}
COLUMNS = ["scene", "lambda", "rods", "ranks", "steps", "code", "us_per_rod_and_step", "us_min",
           "us_max", "peer_over_plugin", "contacts_per_rod", "memory_kB_per_rod", "peak_MB",
           "checksum", "load"]
ORDER = ["scene", "rods", "ranks", "lambda"]


@dataclass(frozen=True)
class Scene:
    side: bool = False     # the study's vessel, else periodic
    floor: bool = False
    poured: bool = False   # by in.fill, else from place_rods
    rests: bool = False    # the rods do, by in.settle, after they were poured
    until: str = "filling"  # which of the settings the filling lasts where they do not
    spheres: bool = False  # the peers are as many spheres, else glued rods
    settles: bool = False  # glued rods do, before they are timed
    skin: float = 0.8      # of the peer, in diameters: near the fastest of 0.1 to 1.6
    mesh: str = ""         # in the place of the walls, one that meshes.py writes
    beside: str = ""       # the same rods in another mesh, or in "primitive" walls
    lid: bool = False      # taken away from below the rods before they are timed
    quick: bool = False    # made as in.fill's quick bed


SCENES = {"bed": Scene(side=True, floor=True, poured=True, rests=True, settles=True, skin=0.2),
          "fill": Scene(side=True, floor=True, poured=True),
          "fill_wide": Scene(side=True, floor=True, poured=True),
          "settle": Scene(side=True, floor=True, poured=True, until="settling"),
          "gas": Scene(), "dilute": Scene(), "dense": Scene(),
          "periodic_bed": Scene(floor=True, settles=True, skin=0.2),
          "sphere_bed": Scene(side=True, floor=True, poured=True, rests=True, spheres=True),
          "mesh_bed": Scene(poured=True, rests=True, settles=True, skin=0.2, mesh="coarse",
                            beside="primitive"),
          "mesh_fine": Scene(poured=True, rests=True, mesh="fine", beside="coarse", quick=True),
          "drum": Scene(mesh="drum"), "hopper": Scene(mesh="hopper", lid=True)}


def solid(scene: str, aspect: int) -> float:
    return {"dilute": 0.5 / aspect, "dense": 0.15}.get(scene, 0.05)


def spheres_of(scene: str, aspect: int, count: int, settings: dict) -> list[int]:
    """Numbers of spheres of the glued rods: they touch, but in meshes, and they overlap by half."""
    if count > settings["largest_peer"]:
        return []
    return [2 * aspect - 1] if SCENES[scene].mesh else [aspect, 2 * aspect - 1]


def codes_of_rods(scene: str) -> list[str]:
    """The plug-in, and where it is timed beside itself."""
    return ["plugin", *([SCENES[scene].beside] if SCENES[scene].beside else [])]


def codes_of(scene: str, aspect: int, count: int, settings: dict) -> list[str]:
    if SCENES[scene].spheres:
        return ["plugin", *one_sphere.CODES]
    return [*codes_of_rods(scene), *map(str, spheres_of(scene, aspect, count, settings))]


def program_of(code: str) -> str:
    if code in one_sphere.CODES:
        return code
    return "liggghts" if code.isdigit() else "lmp"


def name_of(code: str) -> str:
    if code in one_sphere.CODES:
        return f"sphere {code}"
    if code.isdigit():
        return f"multisphere n={code}"
    return code if code == "plugin" else f"plugin {code}"


def link_all(folder: Path) -> None:
    decks = [*(HERE.parent / "input").glob("in.*"), *(HERE / "scenes").glob("in.*"),
             HERE.parent / "examples" / "multisphere" / "in.law"]
    cases.link_decks(folder, decks)


def vessel_diameter(scene: str, aspect: int, count: int) -> float:
    """The study's, which is of 500 rods of lambda 10 and 700 of others; wider for more, so that they come to
    lie as deep, those of mesh_fine as deep for their width (m)."""
    of_study = 500 if aspect == 10 else 700
    power = 1 / 3 if scene == "mesh_fine" else 1 / 2
    return (0.02 * aspect + 0.01) * max(1.0, count / of_study)**power


def variables(scene: str, aspect: int, count: int, code: str = "plugin") -> dict:
    s = SCENES[scene]
    digits = 3 if scene == "mesh_fine" else 12
    vessel = round(vessel_diameter(scene, aspect, count), digits) if s.poured else 0.01
    primitive = code == "primitive"
    mesh = "" if primitive else code if code in meshes.TILES else s.mesh
    return {"lambda": aspect, "rods": count, "vessel_diameter": vessel,
            "has_side": int(s.side or primitive), "has_floor": int(s.floor or primitive),
            "has_gravity": int(s.floor or bool(s.mesh)), "mesh": mesh or "none",
            "meshes": "drum parts" if mesh == "drum" else mesh or "none",
            "n_meshes": 2 if mesh == "drum" else int(bool(mesh)),
            "from": "restart.start" if code == "plugin" else f"restart.{code}"}


def peer_variables(scene: str, aspect: int, count: int, n: int, folder: Path) -> dict:
    values = variables(scene, aspect, count)
    box = (folder / f"peer.{n}.box").read_text()
    return {**values, "rods": f"peer.{n}", "rod_mass": re.search(r"rod_mass index (\S+)", box)[1],
            "kn": STIFFNESS * aspect, "skin": SCENES[scene].skin * DIAMETER}


def start(scene: str, aspect: int, count: int, settings: dict, build: Path, folder: Path) -> None:
    """Leaves what the timed runs begin with: restart.start, and of the peers restart.peer.N or
    spheres.data; and restart.CODE of the same rods in other walls."""
    s, values = SCENES[scene], variables(scene, aspect, count)
    shutil.rmtree(folder, ignore_errors=True)
    link_all(folder)

    def lmp(deck, **more):
        cases.run_deck(folder, f"in.{deck}", {**values, **more}, build=build)

    if s.poured:
        filling = settings["poured" if s.rests else s.until]
        lmp("fill", out=".", fill_time=filling, total_time=settings["rested"], limit_fill=0,
            dump_every=10_000_000, seed=settings["seed"], quick=int(s.quick))
        if s.rests:
            cases.run_deck(folder, "in.settle", {"out": ".", "limit_settle": 0,
                                                 "dump_every": 10_000_000}, build=build)
        poured = {"from": "restart.settle" if s.rests else "restart.fill"}
        lmp("start_bed", **{**variables(scene, aspect, count, "primitive"), **poured}, seconds=0)
        for mesh in meshes.TILES.keys() & {s.mesh, s.beside}:
            meshes.write(mesh, folder, values["vessel_diameter"] / 2,
                         bed_top(folder / "dump.start") + aspect * DIAMETER / 2)
        # Each in its own walls: springs of contacts with a mesh are those of its triangles. The plug-in's last.
        for code in reversed(codes_of_rods(scene)) if s.mesh else ():
            walls = variables(scene, aspect, count, code)
            lmp("start_bed", **{**walls, **poured}, seconds=settings["peer_settled"])
            (folder / "restart.start").rename(folder / walls["from"])
    elif s.mesh:
        meshes.write(s.mesh, folder)
        lmp("start_machine", box=meshes.BOXES[s.mesh], placed=meshes.PLACED[s.mesh],
            seed=settings["seed"], seconds=settings["moved"][s.mesh], opened=settings["opened"],
            has_floor=int(s.lid))
    else:
        times = max(1, count // MOST_PLACED)
        cases.run_tool("place_rods", "--lambda", aspect, "--solid", solid(scene, aspect),
                       "--rods", count // times, "--copies", *COPIES.get(times, (times, 1, 1)),
                       "--seed", settings["seed"], *(["--floor"] if s.floor else []),
                       "--out", folder / "gas.data", build=build)
        lmp("start_gas", seconds=settings["fallen"] if s.floor else 0)
        (folder / "gas.data").unlink()
    placed = int((folder / "dump.start").read_text().splitlines()[3])
    if placed != count:
        raise cases.CaseError(f"only {placed} rods could be placed")
    if s.spheres:
        one_sphere.settle(folder, count, settings)
        return
    # Above a bed and beside its vessel the box is cut off: bins there cost memory and time.
    fit = [] if s.mesh and not s.poured else ["--fit", str(aspect * DIAMETER)]
    for n in spheres_of(scene, aspect, count, settings):
        prefix = f"peer.{n}"
        subprocess.run([cases.program_path("rods_to_multisphere", build), "dump.start",
                        "--spheres", str(n), *fit, "--out", prefix],
                       cwd=folder, check=True, stdout=subprocess.DEVNULL)
        cases.run_deck(folder, "in.start_spheres",
                       {**peer_variables(scene, aspect, count, n, folder),
                        "seconds": settings["peer_settled"] if s.settles else 0},
                       program="liggghts", name=f"start_{n}")
        (folder / f"{prefix}.bodies").unlink()


def available_kB() -> int:
    text = Path("/proc/meminfo").read_text()
    return int(re.search(r"^MemAvailable:\s*(\d+)", text, re.MULTILINE)[1])


def measured(peak: Path) -> tuple:
    """Words under which each rank of a run adds its largest resident memory (kB) to a file. What
    asks for more memory than there is ends with an error, not by the machine's choice of a process."""
    found = shutil.which("time")
    if not found:
        raise cases.CaseError("the program time is not there: scripts/setup --studies installs it")
    peak.unlink(missing_ok=True)
    most = available_kB() * 1024 * 9 // 10
    return ("prlimit", f"--as={most}:", found, "-a", "-o", peak.resolve(), "-f", "%M")


def idle_kB(program: str, build: Path, folder: Path) -> int:
    """Of a program that has loaded its libraries and run one command."""
    (folder / "in.idle").unlink(missing_ok=True)
    (folder / "in.idle").write_text("print ready\n")
    peak = folder / "peak.idle"
    cases.run_deck(folder, "in.idle", program=program, build=build, under=measured(peak))
    return int(peak.read_text())


def bed_top(dump: Path) -> float:
    """Of the rods' centres (m), in dump.start."""
    return pandas.read_csv(dump, sep=r"\s+", skiprows=9, header=None)[6].max()


def checksum(dump: Path) -> float:
    """Sum of id (x + y + z) / sum of id, in diameters: one number that every coordinate is part
    of."""
    table = pandas.read_csv(dump, sep=r"\s+", skiprows=9, header=None, names=["id", "x", "y", "z"],
                            float_precision="round_trip")
    return (table["id"] * (table["x"] + table["y"] + table["z"])).sum() / table["id"].sum() / DIAMETER


def time_once(code: str, scene: str, aspect: int, count: int, ranks: int, settings: dict,
              build: Path, folder: Path) -> dict:
    """One timed run of "plugin", of it in other walls, of a code for spheres, or of a number of spheres a
    rod."""
    own, peers = settings["steps"][scene]
    peak = folder / "peak"
    is_rods = code in codes_of_rods(scene)
    if is_rods:
        run = cases.run_deck(folder, "in.time_plugin",
                             {**variables(scene, aspect, count, code), "steps": own}, ranks=ranks,
                             build=build, under=measured(peak), name=f"time_{code}")
    elif code in one_sphere.CODES:
        run = cases.run_deck(folder, "in.time_one_sphere",
                             {**one_sphere.variables(code, count, settings), "steps": peers},
                             program=code, ranks=ranks, under=measured(peak), name=f"time_{code}")
    else:
        run = cases.run_deck(folder, "in.time_spheres",
                             {**peer_variables(scene, aspect, count, int(code), folder),
                              "steps": peers}, program="liggghts", ranks=ranks,
                             under=measured(peak), name=f"time_{code}")
    log = run.log.read_text(errors="replace")
    result = {"seconds": float(re.search(r"^Loop time of (\S+)", log, re.MULTILINE)[1]),
              "steps": own if is_rods else peers, "command": run.command,
              "peak_kB": sum(map(int, peak.read_text().split())),
              "checksum": checksum(folder / "dump.final"), "contacts": math.nan}
    if is_rods:
        result["contacts"] = float(cases.read_log(run.log)[0]["contacts"].iloc[-1])
    elif code in one_sphere.CODES:
        result["contacts"] = one_sphere.contacts(run.log)
    (folder / "dump.final").unlink()
    return result


def rows_of(runs: dict[str, list[dict]], scene: str, aspect: int, count: int, ranks: int,
            idle: dict[str, int], load: float) -> list[dict]:
    """A row a code from its runs, which took turns."""
    result = []
    for code, of_code in runs.items():
        us = [1e6 * r["seconds"] / r["steps"] / count for r in of_code]
        own = [1e6 * r["seconds"] / r["steps"] / count for r in runs["plugin"]]
        last = of_code[-1]
        idle_of_code = idle[program_of(code)] * ranks
        result.append({
            "scene": scene, "lambda": aspect, "rods": count, "ranks": ranks,
            "steps": last["steps"], "code": name_of(code),
            "us_per_rod_and_step": f"{numpy.median(us):.4g}", "us_min": f"{min(us):.4g}",
            "us_max": f"{max(us):.4g}",
            # Of each turn, then the median: what slows the machine for a while slows both.
            "peer_over_plugin": f"{numpy.median([a / b for a, b in zip(us, own)]):.4g}",
            "contacts_per_rod": last["contacts"],
            "memory_kB_per_rod": f"{(last['peak_kB'] - idle_of_code) / count:.2f}",
            "peak_MB": f"{last['peak_kB'] / 1024:.1f}", "checksum": f"{last['checksum']:.12g}",
            "load": f"{load:.2f}", "command": last["command"]})
    return result


def time_case(scene: str, aspect: int, count: int, ranks: int, settings: dict, build: Path,
              folder: Path) -> list[dict]:
    link_all(folder)
    load = os.getloadavg()[0]
    codes = codes_of(scene, aspect, count, settings)
    idle = {program: idle_kB(program, build, folder) for program in set(map(program_of, codes))}
    runs: dict[str, list[dict]] = {code: [] for code in codes}
    for _ in range(settings["turns"]):
        for code in codes:
            runs[code].append(
                time_once(code, scene, aspect, count, ranks, settings, build, folder))
    table = rows_of(runs, scene, aspect, count, ranks, idle, load)
    return [{**row, **rows.provenance(row["command"], settings["seed"])} for row in table]


def count_instructions(scene: str, aspect: int, count: int, steps: int, build: Path,
                       folder: Path) -> None:
    """Prints those a rod and step of the rods, in each of the scene's walls."""
    link_all(folder)
    for code in codes_of_rods(scene):
        found, _ = cases.run_counted(folder, "in.time_plugin",
                                     {**variables(scene, aspect, count, code), "steps": steps},
                                     build=build, name=f"count_{code}", copies_as_loops=True)
        print(f"{scene} {aspect} {count} {name_of(code)}: {found / (steps * count):.1f}", flush=True)


def add_rows(part: Path, table: Path) -> None:
    """Puts the rows of `part` into `table`, in the place of those of the same cases; what else is
    there stays as it is written."""
    texts = []
    for path in (table, part):
        if not path.exists():
            raise cases.CaseError(f"{path} is not there")
        texts.append(pandas.read_csv(path, dtype=str, keep_default_na=False))
    kept, new = texts
    if list(kept.columns) != list(new.columns):
        raise cases.CaseError(f"{part} and {table} have other columns")
    timed = set(new[ORDER].itertuples(index=False, name=None))
    others = [case not in timed for case in kept[ORDER].itertuples(index=False, name=None)]
    both = pandas.concat([kept[others], new])
    rows.write_rows(table, both.sort_values(
        ORDER, kind="stable",
        key=lambda column: column if column.name == "scene" else column.astype(int)))


def figure(table: pandas.DataFrame, stem: Path | str) -> None:
    """Microseconds a rod and step of one core against the aspect ratio; bars: extremes of the
    runs."""
    fig, ax = plots.new_figure(160, 95)
    one = table[table["ranks"] == 1]
    lines = [("settled bed", one[one["scene"] == "bed"], "blue", True)]
    for count, colour in ((2000, "vermilion"), (20000, "green"), (200000, "purple")):
        lines.append((f"gas of {count:,}", one[(one["scene"] == "gas") & (one["rods"] == count)],
                      colour, count == 2000))
    for name, of_scene, colour, with_peers in lines:
        glued = of_scene["code"].str.extract(r"n=(\d+)")[0].astype(float)
        kinds = [("rods", of_scene["code"] == "plugin", "-", "o")]
        if with_peers:
            kinds += [("λ spheres", glued == of_scene["lambda"], plots.DASHES[1], "s"),
                      ("2λ − 1 spheres", glued == 2 * of_scene["lambda"] - 1, plots.DASHES[2], "D")]
        for kind, chosen, dash, marker in kinds:
            points = of_scene[chosen].sort_values("lambda")
            if points.empty:
                continue
            us = points["us_per_rod_and_step"]
            ax.errorbar(points["lambda"], us, yerr=[us - points["us_min"], points["us_max"] - us],
                        color=plots.COLOURS[colour], linestyle=dash, marker=marker, capsize=2,
                        markerfacecolor=None if kind == "rods" else "white",
                        label=f"{name}: {kind}")
    ax.set(xscale="log", yscale="log", xlabel="aspect ratio λ",
           ylabel="µs a rod and step, one core")
    ticks = sorted(set(one["lambda"]))
    ax.set_xticks(ticks, [str(t) for t in ticks])
    ax.minorticks_off()
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    plots.save(fig, stem)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="work", required=True)
    for name, last in (("start", []), ("time", ["ranks"]), ("count", ["steps"])):
        command = commands.add_parser(name)
        command.add_argument("scene", choices=SCENES)
        for number in ("aspect", "rods", *last):
            command.add_argument(number, type=int)
        if name != "count":
            command.add_argument("--settings", type=json.loads, required=True)
        command.add_argument("--build", type=Path, required=True)
        command.add_argument("--folder", type=Path, required=True)
        if name == "time":
            command.add_argument("--out", type=Path, required=True)
    command = commands.add_parser("add")
    command.add_argument("part", type=Path)
    command.add_argument("--to", type=Path, required=True)
    given = parser.parse_args()
    if given.work == "add":
        try:
            add_rows(given.part, given.to)
        except cases.CaseError as error:
            sys.exit(f"speed.py: {error}")
        return
    try:
        if given.work == "start":
            start(given.scene, given.aspect, given.rods, given.settings, given.build, given.folder)
        elif given.work == "count":
            count_instructions(given.scene, given.aspect, given.rods, given.steps, given.build,
                               given.folder)
        else:
            rows.write_rows(given.out, time_case(given.scene, given.aspect, given.rods, given.ranks,
                                                 given.settings, given.build, given.folder))
    except cases.CaseError as error:
        sys.exit(f"{given.scene} {given.aspect} {given.rods}: {error}")


if __name__ == "__main__":
    main()
