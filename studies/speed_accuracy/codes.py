# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene as files for the two codes, their runs, and the rods they leave."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from studies.common.cases import CaseError, failure, program_path
from studies.speed_accuracy.rods import DENSITY, DIAMETER, RADIUS, damping_ratio, quaternion
from studies.speed_accuracy.scenes import Scene, State, omega_of

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Case:
    """Of one run: stiffness and damping of one contact, step and number of steps."""
    stiffness: float
    damping: float        # of stock spheres, kg/s; the plug-in has the restitution instead
    sliding_damping: float
    step: float
    steps: int


@dataclass(frozen=True)
class Outcome:
    seconds: float  # of one core, for the steps alone
    frames: list[State]


# --- Files. --------------------------------------------------------------------------------------

def bounds(scene: Scene) -> np.ndarray:
    """The box: a rod's length around all that is there, and what it can fly; or the period."""
    if scene.period > 0.0:
        return np.tile([-0.5 * scene.period, 0.5 * scene.period], (3, 1))
    places = np.concatenate([scene.start.position, scene.fixed_position])
    speed = np.max(np.linalg.norm(scene.start.velocity, axis=1)) + np.linalg.norm(scene.gravity) * scene.duration
    margin = scene.rod.length + 1.5 * speed * scene.duration + 4 * DIAMETER
    box = np.stack([places.min(axis=0) - margin, places.max(axis=0) + margin], axis=1)
    if scene.floor:
        box[2, 0] = -2 * DIAMETER
    return box


def lines_of(rows) -> str:
    return "".join(" ".join(f"{v:.15g}" if isinstance(v, float) else str(v) for v in row) + "\n"
                   for row in rows)


def header(scene: Scene, atoms: int, types: int) -> str:
    faces = "".join(f"{lo:.15g} {hi:.15g} {c}lo {c}hi\n" for (lo, hi), c in zip(bounds(scene), "xyz"))
    return f"rods\n\n{atoms} atoms\n{types} atom types\n{faces}\nAtoms\n\n"


def kinds(scene: Scene) -> int:
    """Of rods that move."""
    return len(scene.friction) if scene.friction else 1


def highest_type(scene: Scene) -> int:
    return kinds(scene) + (len(scene.fixed_position) > 0)


def moving_types(scene: Scene) -> np.ndarray:
    return np.ones(len(scene.start.position), int) if scene.types is None else scene.types


def write_setting(scene: Scene, folder: Path) -> None:
    size = float(np.linalg.norm(scene.gravity))
    direction = scene.gravity / size if size > 0 else np.array([0.0, 0.0, -1.0])
    values = {"has_fixed": int(len(scene.fixed_position) > 0), "types": highest_type(scene),
              "has_floor": int(scene.floor), "frames": scene.frames, "gravity": size,
              **dict(zip(("gx", "gy", "gz"), map(float, direction)))}
    face = "p" if scene.period > 0.0 else "f"
    (folder / "setting").write_text(f'variable faces string "{face} {face} {face}"\n' + "".join(f"variable {name} index {value:.15g}\n"
                                            for name, value in values.items()))


def write_materials(scene: Scene, folder: Path, names: dict[str, str]) -> None:
    """`names`: property and value or variable, the same for all pairs of types; and the friction."""
    types = highest_type(scene)
    text = "".join(f"fix {name} all property/global {name} peratomtypepair {types} "
                   + " ".join([value] * types**2) + "\n" for name, value in names.items())
    if scene.friction:
        # Of a pair: that of the lower type, since the floor has the first and fixed rods the last.
        friction = scene.friction + [scene.friction[-1]]
        pairs = [friction[max(i, j)] if scene.floor else friction[min(i, j)]
                 for i in range(types) for j in range(types)]
        text += (f"fix friction all property/global coefficientFriction peratomtypepair {types} "
                 + " ".join(f"{mu:.15g}" for mu in pairs) + "\n")
    (folder / "materials").write_text(text)


def write_rods(scene: Scene, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    start, fixed = scene.start, len(scene.fixed_position)
    moving = len(start.position)
    atoms = [(k + 1, int(t), DIAMETER, scene.rod.length, DENSITY, *map(float, x), *map(float, u))
             for k, (t, x, u) in enumerate(zip(moving_types(scene), start.position, start.axis))]
    atoms += [(moving + k + 1, highest_type(scene), DIAMETER, scene.fixed_length, DENSITY,
               *map(float, x), *map(float, u))
              for k, (x, u) in enumerate(zip(scene.fixed_position, scene.fixed_axis))]
    omega = omega_of(scene.rod, start)
    velocities = [(k + 1, *map(float, v), *map(float, w))
                  for k, (v, w) in enumerate(zip(start.velocity, omega))]
    velocities += [(moving + k + 1, 0, 0, 0, 0, 0, 0) for k in range(fixed)]
    (folder / "rods.data").write_text(header(scene, len(atoms), highest_type(scene))
                                      + lines_of(atoms) + "\nVelocities\n\n" + lines_of(velocities))
    write_setting(scene, folder)
    write_materials(scene, folder, {"kn": "${kn}", "kt": "${kt}",
                                    "coefficientRestitution": f"{scene.restitution:.15g}"})


def sphere_places(length: float, spacing: float) -> np.ndarray:
    """Along the axis, from the rod's centre: evenly from end to end, at most `spacing` apart."""
    half = 0.5 * (length - DIAMETER)
    return np.linspace(-half, half, 1 + int(np.ceil(2.0 * half / spacing - 1e-9)))


def write_spheres(scene: Scene, folder: Path, spacing: float) -> int:
    """The same rods glued of spheres; gives the number of spheres a rod."""
    folder.mkdir(parents=True, exist_ok=True)
    along = sphere_places(scene.rod.length, spacing)
    (folder / "spheres.body").write_text(
        lines_of((0, 0, float(z), RADIUS) for z in along))
    fixed = (scene.fixed_position[:, None]
             + sphere_places(scene.fixed_length, spacing)[None, :, None] * scene.fixed_axis[:, None]
             if len(scene.fixed_position) else np.zeros((0, 0, 3))).reshape(-1, 3)
    atoms = [(k + 1, highest_type(scene), DIAMETER, DENSITY, *map(float, x))
             for k, x in enumerate(fixed)]
    (folder / "fixed.data").write_text(header(scene, len(atoms), highest_type(scene))
                                       + lines_of(atoms))
    box = " ".join(f"{x:.15g}" for x in bounds(scene).ravel())
    (folder / "box").write_text(
        f"read_data {folder.resolve()}/fixed.data\n" if atoms else
        f"region box block {box} units box\ncreate_box {highest_type(scene)} box\n")
    # insert/pack knows no point: a region a nanometre wide.
    poses, width = [], 1e-9
    omega, turn = omega_of(scene.rod, scene.start), quaternion(scene.start.axis)
    for k, x in enumerate(scene.start.position):
        region = " ".join(f"{c:.15g} {c + width:.15g}" for c in x)
        poses.append(f"region r{k} block {region} units box volume_limit 1e-100\n"
                     f"fix i{k} all insert/pack seed 32452867 "
                     f"distributiontemplate rods{moving_types(scene)[k]} "
                     f"insert_every once verbose no overlapcheck no all_in no orientation constant "
                     + " ".join(f"{c:.15g}" for c in turn[k]) + " vel constant "
                     + " ".join(f"{c:.15g}" for c in scene.start.velocity[k]) + " omega constant "
                     + " ".join(f"{c:.15g}" for c in omega[k])
                     + f" region r{k} ntry_mc 1001 particles_in_region 1\n")
    (folder / "poses").write_text("".join(poses))
    rod = scene.rod
    (folder / "templates").write_text("".join(
        f"fix template{t} all particletemplate/multisphere 15485863 atom_type {t} "
        f"density constant {DENSITY} nspheres {len(along)} ntry 1000 "
        f"spheres file {folder.resolve()}/spheres.body scale 1.0 mass {rod.mass:.15g} "
        f"inertia_tensor {rod.across:.15g} 0 0 {rod.across:.15g} 0 {rod.axial:.15g} "
        f"use_density type {t}\n"
        f"fix rods{t} all particledistribution/discrete 32452843 1 template{t} 1.0\n"
        for t in range(1, kinds(scene) + 1)))
    write_setting(scene, folder)
    write_materials(scene, folder, {"kn": "${kn}", "kt": "${kt}", "gamman_abs": "${gn}",
                                    "gammat_abs": "${gt}"})
    return len(along)


# --- Runs. ---------------------------------------------------------------------------------------

def bin_width(scene: Scene, spheres: int) -> float:
    """Not so many bins that an empty box costs more than what is in it, and never below the least
    that LIGGGHTS chooses by itself."""
    volume = float(np.prod(np.diff(bounds(scene), axis=1)))
    return max(0.5 * DIAMETER, (volume / (4.0 * spheres)) ** (1 / 3))


def start_program(command: list[str], folder: Path, name: str) -> str | None:
    """Runs it; why it failed, or None. Leaves log.NAME and screen.NAME."""
    folder = folder.resolve()
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_ess_singleton_isolated="1")
    with tempfile.TemporaryDirectory(prefix="mpi") as session, \
            open(folder / f"screen.{name}", "wb") as screen:
        environment["OMPI_MCA_orte_tmpdir_base"] = session
        done = subprocess.run([*command, "-log", str(folder / f"log.{name}")], cwd=folder,
                              env=environment, stdin=subprocess.DEVNULL, stdout=screen,
                              stderr=subprocess.STDOUT)
    return failure((folder / f"screen.{name}").read_text(errors="replace"), done.returncode)


def place_spheres(scene: Scene, folder: Path, n: int) -> None:
    values = {"folder": folder.resolve(), "tangential": "history" if scene.friction else "off",
              "bin": bin_width(scene, n * len(scene.start.position))}
    command = [program_path("liggghts"), "-in", str(HERE / "in.spheres_place")]
    for name, value in values.items():
        command += ["-var", name, str(value)]
    reason = start_program(command, folder, "place")
    if reason:
        raise CaseError(f"{reason} (placing glued rods in {folder}; all of it in screen.place)")


def run_cases(scene: Scene, folder: Path, code: str, cases: list[Case], build: Path, *,
              spread: str = "on") -> list[Outcome | str]:
    """Each case's outcome, or why it did not stand: one process as long as none fails, since most
    cases are shorter than the start of a program."""
    folder = folder.resolve()
    outcomes: list[Outcome | str] = []
    while len(outcomes) < len(cases):
        first, todo = len(outcomes), cases[len(outcomes):]
        values = {"case": list(range(first, len(cases))),
                  "every": [c.steps // scene.frames if scene.frames > 1 else 10**9 for c in todo], "kn": [c.stiffness for c in todo],
                  "kt": [2.0 / 7.0 * c.stiffness for c in todo], "dt": [c.step for c in todo],
                  "steps": [c.steps for c in todo], "folder": [folder],
                  "tangential": ["history" if scene.friction else "off"]}
        if code == "rods":
            values["spread"] = [spread]
            command = [program_path("lmp", build), "-in", str(HERE / "in.rods_scene")]
        else:
            values["gn"] = [c.damping for c in todo]
            values["gt"] = [c.sliding_damping for c in todo]
            spheres = (folder / "spheres.body").read_text().count("\n")
            values["skin"] = [scene.skin * DIAMETER]
            values["bin"] = [bin_width(scene, spheres * len(scene.start.position))]
            command = [program_path("liggghts"), "-in", str(HERE / "in.spheres_scene")]
        for name, given in values.items():
            command += ["-var", name, *map(str, given)]
        (folder / "times").unlink(missing_ok=True)
        reason = start_program(command, folder, code)
        text = (folder / f"log.{code}").read_text(errors="replace")
        loops = core_seconds(folder / "times")
        read = read_rods if code == "rods" else read_spheres
        for k in range(first, len(cases)):
            dump = folder / f"dump.{code}.{k}"
            if k - first < len(loops) and dump.exists():
                outcomes.append(Outcome(loops[k - first], [read(t) for t in tables_of(dump)]))
                dump.unlink()
            else:
                break
        if reason is None and len(outcomes) == len(cases):
            break
        if reason is None:
            raise CaseError(f"{folder}: {len(outcomes) - first} of {len(todo)} cases left a result")
        if not began(text):
            raise CaseError(f"{reason} (in {folder}; all of it in screen.{code})")
        outcomes.append(reason)
    return outcomes


def core_seconds(path: Path) -> list[float]:
    """Of each run that ended: three lines of /proc/PID/schedstat, before and after a run of no step
    and after the run; the first number is what the program had of a core, in ns."""
    counts = [int(line.split()[0]) for line in path.read_text().splitlines()] if path.exists() else []
    triples = zip(counts[::3], counts[1::3], counts[2::3])
    return [1e-9 * max(end - begin - (begin - idle), 0.1 * (end - begin))
            for idle, begin, end in triples]


def began(log: str) -> bool:
    """Whether a run got as far as its first line of output: what fails before is no instability."""
    return re.search(r"^\s*Step", log, re.MULTILINE) is not None


def tables_of(dump: Path) -> list[np.ndarray]:
    """The rows of each frame but that of the start."""
    frames: list[list[list[str]]] = []
    lines = iter(dump.read_text().splitlines())
    step, reading = 0, False
    for line in lines:
        if line.startswith("ITEM: TIMESTEP"):
            step = int(next(lines))
        if line.startswith("ITEM:"):
            reading = step > 0 and line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES"))
            if reading:
                frames.append([])
        elif reading:
            frames[-1].append(line.split())
    return [np.array(frame, float) for frame in frames]


def read_rods(t: np.ndarray) -> State:
    w, x, y, z = t[:, 10:14].T
    axis = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), w**2 - x**2 - y**2 + z**2], axis=1)
    return State(t[:, 1:4], t[:, 4:7], t[:, 7:10], axis)


def read_spheres(t: np.ndarray) -> State:
    t = t[np.argsort(t[:, 0])]
    # The body's axes are in the order in which LIGGGHTS found its principal moments.
    least = np.argmin(t[0, 19:22])
    return State(t[:, 1:4], t[:, 4:7], t[:, 7:10], t[:, 10 + 3 * least:13 + 3 * least])


def contact_damping(scene: Scene, stiffness: float, mass: float) -> tuple[float, float]:
    """Normal and tangential, kg/s, of one contact at which `mass` moves."""
    beta = damping_ratio(scene.restitution) if scene.restitution < 1.0 else 0.0
    normal = 2.0 * beta * np.sqrt(stiffness * mass)
    return normal, normal * np.sqrt(2.0 / 7.0)


def clean(folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
