# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds by the decks' default and by what the decks advise (quick 1), and whether they are alike."""
from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy
import pandas

from studies.common import cases, settling
from studies.common.rows import provenance, write_rows
from studies.common.statistics import equivalence

REST_DECK = Path(__file__).resolve().with_name("in.rest")
QUANTITIES = {"vf_inner": "V_f, inner cylinder", "vf_whole": "V_f, whole vessel",
              "elevation_deg": "mean elevation", "contacts": "contacts a rod"}


def settle(folder, aspect: float, seed: int, way: str, limits: str, number: int, build):
    """way: `today`, the decks' default, ended at rest, or `quick`."""
    if way == "today":
        return settling.settle_rods(folder, aspect, seed, limits=limits, number=number or None,
                                    build=build)
    return settling.pour_and_settle(
        folder, settling.bed_variables(aspect, seed, limits, number or None) | {"quick": 1}, build)


def bed(path, aspect: float, seed: int, way: str, limits: str, number: int, build) -> None:
    """Writes the row of a bed; of its files only the logs stay."""
    folder = Path(path).resolve().with_suffix("")
    settled = settle(folder, aspect, seed, way, limits, number, build)
    write_rows(path, [{"lambda": aspect, "limits": limits, "way": way,
                       **settling.measure(settled, aspect, seed, build)}])
    for old in folder.glob("restart.*"):
        old.unlink()


def default_to_its_end(folder: Path, aspect: float, seed: int, limits: str, number: int,
                       rest_steps: int, build) -> tuple[float, settling.Settled]:
    """Processor seconds of the decks' default. Steps of a bed at rest are all alike: `rest_steps` of
    them are run, and what is left to 10 s counted at their cost."""
    bed = settle(folder, aspect, seed, "today", limits, number, build)
    left = round((10.0 - bed.end_time) / 2.0e-5)
    if left <= 0:
        return bed.cpu_seconds, bed
    cases.link_decks(folder, [REST_DECK])
    one, more = (cases.run_deck(folder, REST_DECK.name, settling.bed_variables(
        aspect, seed, limits, number or None) | {"steps": steps}, build=build)
        for steps in (1, rest_steps + 1))
    return (bed.cpu_seconds + left * (more.cpu_seconds - one.cpu_seconds) / rest_steps,
            replace(bed, command=f"{bed.command} && {one.command} && {more.command}"))


def seconds(path, aspect: float, seed: int, limits_timed: list[str], turns: int, number: int,
            rest_steps: int, build) -> None:
    """Writes the processor seconds (user and system) to a settled bed by the decks' default and by
    quick 1, in turns."""
    folder = Path(path).resolve().with_suffix("")
    took: dict[tuple, list[float]] = {}
    last: dict[tuple, settling.Settled] = {}   # a bed is the same in each turn
    for _ in range(turns):
        for limits in limits_timed:
            full, last[limits, "full"] = default_to_its_end(
                folder / f"{limits}_full", aspect, seed, limits, number, rest_steps, build)
            quick = settle(folder / f"{limits}_quick", aspect, seed, "quick", limits, number, build)
            last[limits, "quick"] = quick
            took.setdefault((limits, "full"), []).append(full)
            took.setdefault((limits, "quick"), []).append(quick.cpu_seconds)
    write_rows(path, [{
        "lambda": aspect, "limits": limits, "way": way, "seconds": numpy.median(values),
        "seconds_min": min(values), "seconds_max": max(values), "turns": turns,
        "rested": int(last[limits, way].rested), "end_time_s": last[limits, way].end_time,
        "times_fewer": numpy.median(
            [f / v for f, v in zip(took[limits, "full"], values)]),
        **provenance(last[limits, way].command, seed)} for (limits, way), values in took.items()])


def equivalences(runs: pandas.DataFrame, bound: float) -> list[dict]:
    """For each kind of limits and aspect ratio, and for all ratios together (0), whether quick 1 gives
    the same means as the default within `bound`: relative, 90 % confidence intervals, as two one-sided
    tests of 5 % have. Together: the mean of the differences of all ratios. Beds of one seed fall alike:
    the paired interval leaves out the scatter that they share."""
    result = []
    for limits, beds in runs.groupby("limits", sort=False):
        aspects = sorted(beds["lambda"].unique())
        for aspect, parts in [*((a, [a]) for a in aspects), (0.0, aspects)]:
            for quantity in QUANTITIES:
                pairs = [tuple(part.loc[part["way"] == way].sort_values("seed")[quantity]
                               for way in ("today", "quick"))
                         for part in (beds[beds["lambda"] == a] for a in parts)]
                found, paired = (equivalence(pairs, bound, paired=p) for p in (False, True))
                result.append({
                    "limits": limits, "lambda": aspect, "quantity": quantity,
                    "beds_today": sum(len(a) for a, _ in pairs),
                    "beds_quick": sum(len(b) for _, b in pairs), "difference": found.difference,
                    "low": found.low, "high": found.high, "paired_low": paired.low,
                    "paired_high": paired.high, "bound": bound,
                    "equivalent": int(found.equivalent)})
    return result
