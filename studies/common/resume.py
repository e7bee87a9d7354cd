# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck that was killed goes on from the newer of the restart files that it writes in turn."""
from __future__ import annotations

import hashlib
import math
import re
import zlib
from dataclasses import replace
from pathlib import Path

from . import cases

MARK = re.compile(rb"closing bytes (\d{20}) check ([0-9a-f]{8})\nend of file\n\Z")


def step_of_whole_restart(path: Path | str) -> int | None:
    """The step of a restart file whose closing mark is right; None if it is cut or is none."""
    try:
        content = Path(path).read_bytes()
    except OSError:
        return None
    mark = MARK.search(content[-100:])
    if not mark:
        return None
    checked = len(content) - 100 + mark.start(2) if len(content) > 100 else mark.start(2)
    if zlib.crc32(content[:checked]) != int(mark[2], 16):
        return None
    step = re.match(rb"spherocylinder \S+ step (\d+)\n", content[int(mark[1]):])
    return int(step[1]) if step else None


def newest_restart(folder: Path, name: str) -> tuple[int, str] | None:
    """Step and name of the newer whole one of restart.NAME.a and .b."""
    files = [f"restart.{name}.{letter}" for letter in "ab"]
    steps = [(step_of_whole_restart(folder / file), file) for file in files]
    return max(((step, file) for step, file in steps if step is not None), default=None)


def cut_dump(path: Path, step: int) -> None:
    """Leaves the frames before `step` in a dump, which the run that goes on writes anew from there."""
    if not path.exists():
        return
    frames = re.split(r"(?m)^(?=ITEM: TIMESTEP$)", path.read_text())
    kept = [frame for frame in frames if frame.strip() and int(frame.split("\n", 2)[1] or step) < step]
    path.write_text("".join(kept))


def run_deck(folder: Path | str, deck: str, variables: dict | None = None, **options) -> cases.Run:
    """cases.run_deck of a deck of `input` that knows `go_on`. What a killed run of the same words, decks and plug-in
    left in the folder is gone on with; the seconds of such a run are not known."""
    folder, variables = Path(folder), variables or {}
    name = re.sub(r"^in\.", "", deck)
    build = Path(options.get("build") or cases.DEFAULT_BUILD).resolve()
    decks = sorted(path for path in folder.glob("in.*") if path.name != "in.case")
    inputs = [*decks, build / "libspherocylinder.so"]
    if name == "settle":   # what it reads of the stage before
        inputs += [folder / "in.case", folder / "restart.fill"]
    key = hashlib.sha256(repr(sorted(map(str, variables.items()))).encode() +
                         b"".join(path.read_bytes() for path in inputs if path.exists())).hexdigest()
    begun = folder / f"begun.{name}"
    newest = newest_restart(folder, name)
    if newest and begun.exists() and begun.read_text().strip() == key:
        step, file = newest
        cut_dump(folder / f"dump.{name}", step)
        run = cases.run_deck(folder, deck, variables | {"go_on": 1, "from": file}, **options)
        run = replace(run, loop_seconds=math.nan, cpu_seconds=math.nan)
    else:
        for letter in "ab":
            (folder / f"restart.{name}.{letter}").unlink(missing_ok=True)
        begun.write_text(key + "\n")
        run = cases.run_deck(folder, deck, variables, **options)
    for path in (begun, *(folder / f"restart.{name}.{letter}" for letter in "ab")):
        path.unlink(missing_ok=True)
    return run
