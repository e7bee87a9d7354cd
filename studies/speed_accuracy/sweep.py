# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs one scene with one code over stiffnesses, time steps, rules and numbers of spheres, and times
again, in turns and alone on the machine, what came out best.

    sweep.py run  SCENE LAMBDA --code rods|spheres --work DIR --out rows.csv ...
    sweep.py time SCENE LAMBDA rods.csv spheres.csv --work DIR --out rows.csv ...
"""
from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from studies.common import rows as common_rows  # noqa: E402
from studies.common.cases import CaseError  # noqa: E402
from studies.common.statistics import pareto_front  # noqa: E402
from studies.speed_accuracy import codes  # noqa: E402
from studies.speed_accuracy.rods import RADIUS  # noqa: E402
from studies.speed_accuracy.scenes import SCENES, Scene, build  # noqa: E402

DECKS_STIFFNESS = 2.0e4  # N/m times the aspect ratio, of the decks in input/
RULES = {"rods": ("spread", "single"), "spheres": ("nominal", "adapted")}
METHODS = {"rods": "rods", "spheres": "multisphere"}
KEY = ["method", "n", "rule", "stiffness", "time_step_over_limit"]
# What may have so many times the work of other cases: the softest contact with the largest step, so that
# most numbers of spheres have a case; free rods, whose error is that of the step alone.
SOFTEST_WORK, FREE_WORK = 20, 8


@dataclass(frozen=True)
class Variant:
    """A code with its rule: spread or single contact of rods; stiffness and damping of spheres as of
    one contact (nominal), or shared by the contacts there will be and for the mass that moves there
    (adapted)."""
    code: str
    rule: str
    n: int = 0  # spheres a rod


def spheres_of(aspect: float, spacing: float) -> int:
    return len(codes.sphere_places(aspect * 2 * RADIUS, spacing * RADIUS))


def copies_of(variant: Variant, given: argparse.Namespace) -> int:
    """Fewer where a copy has many spheres, and where it is free: the cost is that of one copy."""
    if given.scene == "precession":
        return min(11, given.copies)
    if given.scene == "gas":
        return given.copies
    if variant.code == "rods":
        return given.copies
    least = min(22, given.copies)  # of each type of `incline` two
    return int(np.clip(given.spheres / variant.n, least, max(least, given.copies // 2)))


def share_of(scene: Scene, variant: Variant) -> float:
    """By which a contact's stiffness and damping are divided."""
    return scene.contacts(variant.n) if variant.rule == "adapted" else 1.0


def case_of(scene: Scene, variant: Variant, stiffness: float, fraction: float) -> codes.Case:
    """`stiffness` over that of the decks; `fraction` of 2 √(m_eff/k), m_eff that of one end of a rod
    and k of all contacts there will be."""
    k = stiffness * DECKS_STIFFNESS * scene.aspect
    contacts = scene.contacts(variant.n) if variant.code == "spheres" else 1.0
    total = k if variant.rule == "adapted" else k * contacts
    step = fraction * 2.0 * np.sqrt(scene.least_mass / total)
    steps = scene.frames * int(np.ceil(scene.duration / step / scene.frames))
    share = share_of(scene, variant)
    mass = scene.mean_mass if variant.rule == "adapted" else scene.nominal_mass
    damping = codes.contact_damping(scene, k, mass)
    return codes.Case(k / share, damping[0] / share, damping[1] / share, scene.duration / steps, steps)


def work_of(scene: Scene, variant: Variant, steps: int) -> float:
    """Particles times steps; a particle that touches nothing counts a tenth."""
    if not scene.stiff:
        return 0.1 * steps * max(1, variant.n) * len(scene.start.position)
    if variant.code == "rods":
        return steps * (len(scene.start.position) + len(scene.fixed_position))
    fixed = len(scene.fixed_position) * scene.fixed_length / scene.rod.length
    return steps * variant.n * (len(scene.start.position) + fixed)


def prepare(scene: Scene, variant: Variant, spacing: float, folder: Path) -> None:
    if variant.code == "rods":
        codes.write_rods(scene, folder)
    else:
        codes.place_spheres(scene, folder, codes.write_spheres(scene, folder, spacing * RADIUS))


def interval(errors: np.ndarray, seed: int) -> tuple[float, float, float]:
    """Root mean square over the copies and its 95 % interval, by drawing copies again."""
    rng = np.random.default_rng(seed)
    squares = errors**2
    drawn = np.sqrt(np.mean(rng.choice(squares, (400, len(squares))), axis=1))
    return float(np.sqrt(np.mean(squares))), *map(float, np.quantile(drawn, [0.025, 0.975]))


def rows_of(scene: Scene, name: str, variant: Variant, fraction: float, case: codes.Case,
            outcome: codes.Outcome | str, given: argparse.Namespace) -> list[dict]:
    row = {"scene": name, "lambda": scene.aspect, "method": METHODS[variant.code], "n": variant.n,
           "rule": variant.rule, "stiffness": case.stiffness, "time_step_over_limit": fraction}
    more = {"copies": scene.copies, "steps": case.steps, "turns": 1, "ended": "",
            **common_rows.provenance(given.command, given.seed)}
    nothing = dict.fromkeys(("cost", "cost_min", "cost_max", "error", "error_low", "error_high"),
                            np.nan)
    if isinstance(outcome, str):
        return [row | nothing | {"quantity": ""} | more | {"ended": outcome}]
    cost = outcome.seconds / scene.duration / scene.copies
    result = []
    for quantity, errors in scene.errors(outcome.frames).items():
        if not np.all(np.isfinite(errors)):
            result.append(row | nothing | {"quantity": quantity} | more | {"ended": "no number"})
            continue
        error, low, high = interval(errors, given.seed)
        result.append(row | {"cost": cost, "cost_min": cost, "cost_max": cost, "error": error,
                             "error_low": low, "error_high": high, "quantity": quantity} | more)
    return result


def variants(given: argparse.Namespace) -> list[tuple[Variant, float]]:
    """With the spacing of the spheres in radii."""
    if given.code == "rods":
        return [(Variant("rods", rule), 0.0) for rule in RULES["rods"]]
    return [(Variant("spheres", rule, spheres_of(given.aspect, spacing)), spacing)
            for spacing in given.spacings for rule in RULES["spheres"]]


def cases_of(scene: Scene, variant: Variant,
             given: argparse.Namespace) -> list[tuple[float, codes.Case]]:
    """Fractions ascend within a stiffness. A stiffness that has no part in the scene is one."""
    stiffnesses = given.stiffnesses if scene.stiff else [1.0]
    cases = []
    for stiffness in stiffnesses:
        for fraction in sorted(given.fractions):
            case = case_of(scene, variant, stiffness, fraction)
            cheapest = (stiffness, fraction) == (min(stiffnesses), max(given.fractions))
            factor = SOFTEST_WORK if cheapest else 1 if scene.stiff else FREE_WORK
            if work_of(scene, variant, case.steps) <= given.most_work * factor:
                cases.append((fraction, case))
    return cases


def same_as_nominal(scene: Scene, variant: Variant) -> bool:
    if variant.rule != "adapted":
        return variant.rule == "single" and not len(scene.fixed_position) and not scene.pairs
    return (scene.contacts(variant.n) == 1.0 and scene.mean_mass == scene.nominal_mass) \
        or not scene.stiff


def run(given: argparse.Namespace) -> list[dict]:
    rows, scenes = [], {}
    for variant, spacing in variants(given):
        copies = copies_of(variant, given)
        if copies not in scenes:
            scenes[copies] = build(given.scene, given.aspect, copies, given.seed)
        scene = scenes[copies]
        if same_as_nominal(scene, variant):
            continue
        cases = cases_of(scene, variant, given)
        if not cases:
            continue
        folder = given.work / f"{variant.code}_{variant.n}_{variant.rule}"
        prepare(scene, variant, spacing, folder)
        outcomes = codes.run_cases(scene, folder, variant.code, [c for _, c in cases], given.build,
                                   spread="on" if variant.rule == "spread" else "off")
        for (fraction, case), outcome in zip(cases, outcomes):
            rows += rows_of(scene, given.scene, variant, fraction, case, outcome, given)
        codes.clean(folder)
    return rows


def front(table: pandas.DataFrame) -> pandas.DataFrame:
    """Rows on the Pareto front of either method, of each scene, aspect ratio and quantity. The cheapest
    case below any error is one of them."""
    kept = []
    for _, part in table.groupby(["scene", "lambda", "quantity", "method"]):
        kept.append(part.iloc[pareto_front(part["cost"], part["error"])])
    return pandas.concat(kept) if kept else table.iloc[:0]


def best(table: pandas.DataFrame) -> pandas.DataFrame:
    """The cases that are on a front by any quantity."""
    kept = {tuple(row[KEY]) for _, row in front(table).iterrows()}
    return pandas.DataFrame(sorted(kept, key=str), columns=KEY)


def time_again(given: argparse.Namespace) -> pandas.DataFrame:
    """All rows of the scene, each case on a front with the median of given.turns costs: costs that
    change move the fronts, so that it goes on until no case on them has not been timed here."""
    table = pandas.concat([common_rows.read_rows(p) for p in given.rows], ignore_index=True)
    table = table[(table["scene"] == given.scene) & (table["lambda"] == given.aspect)]
    table = table.reset_index(drop=True).astype({"cost": float, "cost_min": float, "cost_max": float})
    table["ended"] = table["ended"].fillna("")
    if "timed_version" not in table:
        table["timed_version"] = ""
    table["timed_version"] = table["timed_version"].fillna("").astype(str)
    version = common_rows.provenance(given.command, given.seed)["version"]
    timed: set[tuple] = set()
    while True:
        chosen = best(table[table["error"] < 1.0])
        chosen = chosen[[tuple(row) not in timed for row in chosen.itertuples(index=False)]]
        if chosen.empty:
            return table
        costs = costs_in_turns(chosen, given)
        timed |= {tuple(row) for row in chosen.itertuples(index=False)}
        for index, row in table.iterrows():
            turns = costs.get(tuple(row[KEY]))
            if turns and np.isfinite(row["cost"]):
                table.loc[index, ["cost", "cost_min", "cost_max"]] = (np.median(turns), min(turns),
                                                                      max(turns))
                table.loc[index, "turns"] = len(turns)
                table.loc[index, "timed_version"] = version
                swept = row["command"].split(" && ")[0]
                table.loc[index, "command"] = f"{swept} && {given.command}"


def costs_in_turns(chosen: pandas.DataFrame, given: argparse.Namespace) -> dict[tuple, list[float]]:
    """Of each case given.turns costs. Codes take turns."""
    groups, scenes = [], {}
    spacing_of = {spheres_of(given.aspect, s): s for s in given.spacings}
    for (method, n, rule), part in chosen.groupby(["method", "n", "rule"]):
        code = next(c for c, m in METHODS.items() if m == method)
        variant = Variant(code, rule, int(n))
        copies = copies_of(variant, given)
        if copies not in scenes:
            scenes[copies] = build(given.scene, given.aspect, copies, given.seed)
        folder = given.work / f"{code}_{n}_{rule}"
        prepare(scenes[copies], variant, spacing_of.get(variant.n, 0.0), folder)
        cases = [(row, case_of(scenes[copies], variant,
                               row["stiffness"] * share_of(scenes[copies], variant)
                               / (DECKS_STIFFNESS * given.aspect), row["time_step_over_limit"]))
                 for _, row in part.iterrows()]
        groups.append((variant, scenes[copies], folder, cases))
    costs: dict[tuple, list[float]] = {}
    for _ in range(given.turns):
        for variant, scene, folder, cases in groups:
            outcomes = codes.run_cases(scene, folder, variant.code, [c for _, c in cases],
                                       given.build, spread="on" if variant.rule == "spread" else "off")
            for (row, _), outcome in zip(cases, outcomes):
                if not isinstance(outcome, str):
                    costs.setdefault(tuple(row[KEY]), []).append(
                        outcome.seconds / scene.duration / scene.copies)
    for _, _, folder, _ in groups:
        codes.clean(folder)
    return costs


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["run", "time"])
    parser.add_argument("scene", choices=sorted(SCENES))
    parser.add_argument("aspect", type=float, metavar="LAMBDA")
    parser.add_argument("rows", nargs="*", type=Path, help="CSV files of `run`, to be timed")
    parser.add_argument("--code", choices=sorted(RULES), default="rods")
    parser.add_argument("--work", type=Path, required=True, help="folder of its own")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--build", type=Path, default=None)
    parser.add_argument("--copies", type=int, default=100)
    parser.add_argument("--spheres", type=int, default=2000, help="in all, about")
    parser.add_argument("--spacings", type=float, nargs="+", default=[2, 1, 0.5, 0.25],
                        help="of the spheres, in radii")
    parser.add_argument("--stiffnesses", type=float, nargs="+", default=[1.0],
                        help="over that of the decks in input/")
    parser.add_argument("--fractions", type=float, nargs="+", default=[0.1],
                        help="time steps over the limit")
    parser.add_argument("--most-work", type=float, default=1e7,
                        help="particles times steps of a case; larger ones are left out")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--seed", type=int, default=86028121)
    given = parser.parse_args()
    given.command = common_rows.typed(sys.argv)
    return given


def main() -> int:
    given = arguments()
    try:
        table = run(given) if given.what == "run" else time_again(given)
        common_rows.write_rows(given.out, table)
    except CaseError as error:
        print(f"sweep.py: {given.scene}, lambda {given.aspect:g}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
