# SPDX-License-Identifier: GPL-2.0-or-later
"""Two scenes with a known outcome: rods that hit end on end, and a rod that turns freely."""
from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from studies.common import cases, settling
from studies.common.rows import provenance, write_rows
from studies.speed_accuracy.rods import damping_ratio, properties
from studies.stability import bed, theory

HITS, SPIN = (Path(__file__).resolve().with_name(name) for name in ("in.hits", "in.spin"))
ARM = 0.98        # of the contact, over half the length of the axis: within both rods
DEEP = 1e-4       # largest overlap over the diameter: rods do not turn noticeably in a hit
SPIN_OMEGA = (30.0, 400.0)   # rad/s at first, across the axis and along it


def data_file(path: Path, aspect: float, rods: list[tuple], box) -> None:
    """rods: centre, axis, velocity and angular velocity of each."""
    length = aspect * settling.DIAMETER
    lines = ["rods", "", f"{len(rods)} atoms", "1 atom types"]
    lines += [f"{low:.10g} {high:.10g} {c}lo {c}hi" for c, (low, high) in zip("xyz", box)]
    number = " ".join
    lines += ["", "Atoms", ""]
    lines += [f"{k} 1 {settling.DIAMETER:.15g} {length:.15g} {settling.DENSITY:.15g} "
              + number(f"{c:.15g}" for c in (*x, *u)) for k, (x, u, _, _) in enumerate(rods, 1)]
    lines += ["", "Velocities", ""]
    lines += [f"{k} " + number(f"{c:.15g}" for c in (*v, *w))
              for k, (_, _, v, w) in enumerate(rods, 1)]
    path.write_text("\n".join(lines) + "\n")


# --- Hits. --------------------------------------------------------------------------------------

def mass_at(aspect: float) -> float:
    """m_eff of these hits."""
    rod = properties(aspect)
    return 0.5 / (1.0 / rod.mass + (ARM * 0.5 * rod.height) ** 2 / rod.across)


def hit_damping(aspect: float, restitution: float, method: str) -> float:
    """β at the contact: that of e, or that of e for whole rods."""
    beta = damping_ratio(restitution) if restitution < 1 else 0.0
    if method == "ours":
        return beta
    return beta * math.sqrt(0.5 * properties(aspect).mass / mass_at(aspect))


def phases_of(number: int) -> np.ndarray:
    """Evenly over a step."""
    return (np.arange(number) + 0.5) / number


def hit(folder: Path, aspect: float, fraction: float, restitution: float, method: str, number: int,
        build) -> tuple[np.ndarray, str]:
    """Restitution of `number` hits with other phases; fraction: of the step over 2 √(m_eff/k)."""
    folder.mkdir(parents=True, exist_ok=True)
    rod, mass = properties(aspect), mass_at(aspect)
    stiffness = settling.STIFFNESS * aspect
    omega = math.sqrt(stiffness / mass)
    step, speed = fraction * 2.0 / omega, DEEP * settling.DIAMETER * omega
    arm, apart = ARM * 0.5 * rod.height, 2.0 * rod.length
    rods = []
    for k, phase in enumerate(phases_of(number)):
        # Before the step in which they first touch they still have 1 - phase of it to go.
        gap, y = (2.0 + 1.0 - phase) * speed * step, apart * k
        rods.append(((0, y, 0), (1, 0, 0), (0, 0, 0.5 * speed), (0, 0, 0)))
        rods.append(((arm, y - arm, settling.DIAMETER + gap), (0, 1, 0), (0, 0, -0.5 * speed),
                     (0, 0, 0)))
    box = np.array([[-rod.length, 2 * rod.length], [-2 * rod.length, apart * number + rod.length],
                    [-0.2, 0.2]])
    data_file(folder / "rods.data", aspect, rods, box)
    steps = 5 + math.ceil(20 * math.pi / (2 * fraction))
    run = cases.run_deck(folder, HITS, {
        "stiffness": f"{stiffness:.17g}", "restitution": restitution, "dt": f"{step:.17g}",
        "steps": steps, "keywords": "" if method == "ours" else bed.PARTS["mass"]["keywords"]},
        build=build)
    lines = (folder / "dump.after").read_text().splitlines()
    vz = np.array([line.split()[1] for line in lines[-2 * number:]], dtype=float)
    impulse = rod.mass * (vz[1::2] + 0.5 * speed)
    return impulse / (mass * speed) - 1.0, run.command


def hits(path, aspect: float, fractions, restitution: float, method: str, number: int,
         build) -> None:
    """Writes a row a step: most and mean energy after over before, measured and by the scheme."""
    folder = Path(path).resolve().with_suffix("")
    beta, rows = hit_damping(aspect, restitution, method), []
    for fraction in fractions:
        measured, command = hit(folder, aspect, fraction, restitution, method, number, build)
        expected = theory.restitution_of_hit(2.0 * fraction, beta, phases_of(number))
        rows.append({
            "lambda": aspect, "method": method, "restitution": restitution, "fraction": fraction,
            "damping": beta, "energy_most": float(np.max(measured ** 2)),
            "energy_mean": float(np.mean(measured ** 2)),
            "expected_most": float(np.max(expected ** 2)),
            "expected_mean": float(np.mean(expected ** 2)),
            "worst_difference": float(np.max(np.abs(measured - expected))),
            "onset": theory.gain_onset(beta), "bounded": theory.stable_limit(beta),
            **provenance(command, "none")})
    write_rows(path, rows)


# --- A free rod. --------------------------------------------------------------------------------

def doubling(aspect: float, step: float) -> float:
    """Growth of the energy across the axis with rotation plain, 1/s: Ω² dt/2."""
    rod = properties(aspect)
    return 0.5 * ((1.0 - rod.axial / rod.across) * SPIN_OMEGA[1]) ** 2 * step


def spin(path, aspect: float, fractions, rotation: str, seconds: float, build) -> None:
    """Writes a row a step: growth of the rotational energy, measured and expected."""
    folder = Path(path).resolve().with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    rod, rows = properties(aspect), []
    across, axial = SPIN_OMEGA
    data_file(folder / "rod.data", aspect, [((0, 0, 0), (0, 0, 1), (0, 0, 0), (across, 0, axial))],
              np.tile([-rod.length, rod.length], (3, 1)))
    for fraction in fractions:
        step = fraction * settling.time_step_limit(aspect)
        steps = math.ceil(seconds / step)
        run = cases.run_deck(folder, SPIN, {
            "rotation": f"rotation {rotation}", "steps": steps, "dt": f"{step:.17g}",
            "every": max(1, steps // 20)}, build=build)
        table = cases.read_log(run.log)[-1]
        start, end = table.iloc[0], table.iloc[-1]
        fixed = 0.5 * rod.axial * axial ** 2
        rate = math.log((end["turning"] - fixed) / (start["turning"] - fixed)) / end["time"]
        rows.append({"lambda": aspect, "rotation": rotation, "fraction": fraction, "step_s": step,
                     "energy_times": end["turning"] / start["turning"], "time_s": end["time"],
                     "rate": rate, "expected": doubling(aspect, step) if rotation == "plain" else 0,
                     **provenance(run.command, "none")})
    write_rows(path, rows)
