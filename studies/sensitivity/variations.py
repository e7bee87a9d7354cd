# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases of config.yaml, a factor at a time; a bed of each; differences from the base case."""
from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from pathlib import Path

import pandas

from studies.common import cases, settling
from studies.common.rows import read_rows, write_rows
from studies.common.statistics import equivalence

OWN = ("limits", "stiffness_times", "softened_times", "vessel_times",
       "rods_times")   # not of the decks
KEYS = ("variable", "values", "levels", "with", "against")   # of a factor
TAPS = ("taps", "tap_strength", "tap_frequency", "tap_time")
QUANTITIES = {"vf_inner": "V_f, inner cylinder", "vf_whole": "V_f, whole vessel",
              "elevation_deg": "mean elevation", "contacts": "contacts a rod"}
MORE = ("mean_sin_gamma", "vf_bulk", "vf_parkhouse_kelly")
STEP = {True: 5.0e-5, False: 2.0e-5}   # s, of the decks, with quick 1 and without
PROFILED = "vessel"   # the factor whose beds have their V_f by distance from the walls kept
BASE = "base"


@dataclass(frozen=True)
class Case:
    factor: str
    level: str
    given: dict = field(hash=False)
    value: float = math.nan    # of the factor's variable, if it has one
    against: str = ""          # level of the factor that it is compared with; none: the base case


def of_decks() -> set[str]:
    """The variables that in.rods and in.tap have."""
    texts = "".join(path.read_text() for path in (settling.DECKS[0], settling.TAP))
    return set(re.findall(r"\bvariable (\w+) +index", texts))


def cases_of(factors: dict, only: list[str]) -> list[Case]:
    """Raises ValueError with a sentence if they cannot be used."""
    unknown = [name for name in only if name not in factors]
    if unknown:
        raise ValueError(f"only must be among {', '.join(factors)} (got {unknown[0]})")
    known = of_decks() | set(OWN)
    result = [Case(BASE, BASE, {})]
    for factor, told in factors.items():
        if only and factor not in only:
            continue
        if ("levels" in told) == ("values" in told):
            raise ValueError(f"factor {factor} must have either levels or values")
        shared = told.get("with", {})
        if "levels" in told:
            levels = {str(level): (given, math.nan) for level, given in told["levels"].items()}
        else:
            if "variable" not in told:
                raise ValueError(f"factor {factor} must have the variable of its values")
            for value in told["values"]:
                if not isinstance(value, (int, float)):
                    raise ValueError(f"factor {factor}: values must be numbers (got {value})")
            levels = {f"{value:g}": ({told["variable"]: value}, float(value))
                      for value in told["values"]}
        against = str(told.get("against", ""))
        if against and against not in levels:
            raise ValueError(f"factor {factor} has no level {against} to be compared with")
        for level, (given, value) in levels.items():
            if not re.fullmatch(r"[\w.]+", level):
                raise ValueError(f"factor {factor}: a level is named by letters, digits, _ and . "
                                 f"(got {level})")
            given = {**shared, **given}
            for name in given:
                if name not in known:
                    raise ValueError(f"factor {factor}: {name} is no variable of input/in.rods or "
                                     "input/in.tap")
            result.append(Case(factor, level, given, value, against))
    return result


def deck_variables(aspect: float, seed: int, given: dict, quick: bool, total_time: float) -> dict:
    """Of in.fill and in.settle; `given`: those of the base case and of the case."""
    given = dict(given)
    wider, more, stiffer = (float(given.pop(name, 1.0)) for name in
                            ("vessel_times", "rods_times", "stiffness_times"))
    number = given.pop("rods", None)
    variables = settling.bed_variables(aspect, seed, given.pop("limits", "none"), number)
    vessel = wider * float(variables["vessel_diameter"])
    variables |= {"vessel_diameter": f"{vessel:g}",
                  "rods": round(variables["rods"] * wider ** 2 * more),
                  "total_time": f"{total_time:g}", "stop_at_rest": 1, "skin_diameters": 10, "quick": int(quick)}
    if stiffer != 1.0:
        spring = stiffer * settling.STIFFNESS
        variables |= {"stiffness": f"{spring:g}",
                      "dt": f"{STEP[quick] / math.sqrt(stiffer):.6g}"}
    if "vessel_height" in given and "fill_time" not in given:   # until the highest have come down
        fall = math.sqrt(2.0 * float(given["vessel_height"]) / settling.GRAVITY)
        given["fill_time"] = f"{max(settling.FILL_TIME, fall + 0.5):g}"
    if "gentle" in given:                                       # layers of as many rods
        layers = int(given.get("layers", 10))
        variables["rods"] = layers * round(variables["rods"] / layers)
    given.pop("softened_times", None)
    return variables | {name: value for name, value in given.items() if name not in TAPS}


def bed(path, case: Case, base: dict, aspect: float, seed: int, quick: bool, total_time: float,
        build) -> None:
    """Writes the row of a bed, and beside it PATH.wall.csv, V_f by distance from the walls, of those
    that are profiled; of its files only the logs stay."""
    folder = Path(path).resolve().with_suffix("")
    given = {**base, **case.given}
    variables = deck_variables(aspect, seed, given, quick, total_time)
    softer = {"stiffness": f"{given['softened_times'] * settling.STIFFNESS:g}"} \
        if "softened_times" in given else {}
    settled = settling.pour_and_settle(folder, variables, build, softer)
    if "taps" in given:
        settled = settling.tap(folder, settled, {n: given[n] for n in TAPS if n in given}, build)
    vessel = float(variables["vessel_diameter"])
    row = settling.measure(settled, aspect, seed, build, vessel, MORE)
    told = {"factor": case.factor, "level": case.level, "value": case.value, "lambda": aspect,
            "seed": seed}
    length = aspect * settling.DIAMETER
    write_rows(path, [{**told, "against": case.against, "rods": variables["rods"],
                       "lengths_wide": vessel / length,
                       **{name: v for name, v in row.items() if name != "seed"}}])
    if case.factor in (PROFILED, BASE):
        prefix = folder / "profile"
        cases.run_tool("rod_packing", settled.dump, "--vessel-radius", vessel / 2,
                       "--profiles", prefix, "--bin", length / 8, build=build)
        wall = pandas.read_csv(f"{prefix}_wall.csv")
        write_rows(Path(path).with_suffix(".wall.csv"), wall.assign(
            **told, lengths_wide=vessel / length, low=wall["low_m"] / length,
            high=wall["high_m"] / length)[[*told, "lengths_wide", "low", "high", "region_m3",
                                           "vf"]])
    for old in [*folder.glob("restart.*"), *folder.glob("dump.*"), *folder.glob("profile*")]:
        old.unlink()


def compared(beds: pandas.DataFrame, factor: str, against: str) -> pandas.DataFrame:
    """The beds that those of a factor are compared with."""
    if against:
        return beds[(beds["factor"] == factor) & (beds["level"] == against)]
    return beds[beds["factor"] == BASE]


def effects(beds: pandas.DataFrame, bound: float) -> pandas.DataFrame:
    """For each factor, level and quantity, of each λ and of all together (lambda 0): the relative
    difference from the base case, its 95 % interval, whether it is one, and whether it is surely
    smaller than `bound`. A level without two beds of a λ, or whose base case has not, is left out
    there."""
    result = []
    varied = beds[beds["factor"] != BASE]
    for (factor, level), part in varied.groupby(["factor", "level"], sort=False):
        against = part["against"].iloc[0]
        if level == against:
            continue
        other = compared(beds, factor, against)
        for quantity in QUANTITIES:
            pairs = {}
            for aspect, of_aspect in part.groupby("lambda"):
                a = other[other["lambda"] == aspect][quantity]
                if min(len(a), len(of_aspect)) >= 2:
                    pairs[aspect] = (a, of_aspect[quantity])
            sets = {aspect: [pair] for aspect, pair in pairs.items()}
            if pairs:
                sets[0.0] = list(pairs.values())
            for aspect, pair in sets.items():
                found = equivalence(pair, bound, alpha=0.025)
                result.append({
                    "factor": factor, "level": level, "value": part["value"].iloc[0],
                    "lambda": aspect, "quantity": quantity, "lambdas": len(pair),
                    "beds_base": sum(len(a) for a, _ in pair),
                    "beds": sum(len(b) for _, b in pair),
                    "difference": found.difference, "low": found.low, "high": found.high,
                    "differs": int(found.low > 0 or found.high < 0),
                    "alike": int(found.equivalent)})
    return pandas.DataFrame(result, columns=[
        "factor", "level", "value", "lambda", "quantity", "lambdas", "beds_base", "beds",
        "difference", "low", "high", "differs", "alike"])


def with_texts(table: pandas.DataFrame) -> pandas.DataFrame:
    """Levels as texts, also where all of them look like numbers."""
    texts = {name: [f"{x:g}" if isinstance(x, float) else str(x) for x in table[name].fillna("")]
             for name in ("level", "against") if name in table}
    return table.assign(**texts)


def read_beds(path: Path | str) -> pandas.DataFrame:
    return with_texts(read_rows(path))


def read_effects(path: Path | str) -> pandas.DataFrame:
    return with_texts(read_rows(path))


def expected(beds: pandas.DataFrame) -> pandas.Series:
    """V_f = z V_p/V_ex of random contacts (Philipse 1996) for the z contacts a rod and s = ⟨|sin γ|⟩ of
    each bed, of capsules with a cylinder of x = λ - 1 diameters, in units of π D³: V_p = x/4 + 1/6,
    V_ex = (2 s/π) x² + 2 x + 4/3."""
    x = beds["lambda"] - 1.0
    excluded = 2 * beds["mean_sin_gamma"] / math.pi * x ** 2 + 2 * x + 4 / 3
    return beds["contacts"] * (x / 4 + 1 / 6) / excluded
