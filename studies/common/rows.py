# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of results: where they come from, writing and collecting them."""
from __future__ import annotations

import hashlib
import os
import re
import shlex
from pathlib import Path
from typing import Iterable

import pandas

ROOT = Path(__file__).resolve().parents[2]
PLUGIN_SOURCES = ("src_plugin",)
# Of the post-processors: what measures, and what draws.
MEASURING_SOURCES = ("postproc/cli", "postproc/io", "postproc/measures", "postproc/solid",
                     "src_plugin/core")
DRAWING_SOURCES = (*MEASURING_SOURCES, "postproc/pictures")
PROVENANCE = ("command", "seed", "version", "machine")


def sum_of(*parts: Path | str) -> str:
    """Check sum of files and of what folders hold, the same on every machine: twelve digits. A part
    that is not there is an error: nothing would be the same for ever."""
    total = hashlib.sha256()
    for part in parts:
        part = ROOT / part
        if not part.exists():
            raise FileNotFoundError(f"{part} is not there: no check sum of it")
        files = [part] if part.is_file() else sorted(p for p in part.rglob("*") if p.is_file())
        for path in files:
            total.update(path.relative_to(ROOT).as_posix().encode() + b"\0")
            total.update(path.read_bytes())
    return total.hexdigest()[:12]


def version() -> str:
    """Which plug-in: the check sum of its sources."""
    return sum_of(*PLUGIN_SOURCES)


def machine() -> str:
    """The processor and how many cores of it there are."""
    name = "unknown processor"
    try:
        found = re.search(r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(),
                          re.MULTILINE)
        name = " ".join(found.group(1).split()) if found else name
    except OSError:
        pass
    cores = len(os.sched_getaffinity(0))
    return f"{name}, {cores} core{'s' if cores != 1 else ''}"


def typed(words: Iterable) -> str:
    """A command as it can be typed, without the place of the project's folder."""
    return shlex.join(str(word).replace(f"{ROOT}/", "") for word in words)


def provenance(command: str, seed: int | str) -> dict:
    return {"command": command, "seed": seed, "version": version(), "machine": machine()}


def write_rows(path: Path | str, rows: pandas.DataFrame | Iterable[dict]) -> None:
    """CSV, whole or not at all; numbers with ten digits."""
    table = rows if isinstance(rows, pandas.DataFrame) else pandas.DataFrame(list(rows))
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".new")
    table.to_csv(unfinished, index=False, float_format="%.10g", lineterminator="\n")
    unfinished.replace(path)


def commands_beside(path: Path | str) -> Path:
    """Where the commands of a table stand that were written apart."""
    return Path(path).with_name(f"{Path(path).stem}_commands.csv")


def write_rows_and_commands(path: Path | str, table: pandas.DataFrame) -> None:
    """For tables of which many rows have one long command: they have its number, and the commands are a
    table of their own beside it. read_rows puts them together again."""
    numbers, commands = pandas.factorize(table["command"])
    write_rows(commands_beside(path), pandas.DataFrame({"number": range(len(commands)),
                                                        "command": commands}))
    write_rows(path, table.assign(command=numbers))


def read_rows(path: Path | str) -> pandas.DataFrame:
    table = pandas.read_csv(path, float_precision="round_trip", comment="#")
    if commands_beside(path).exists():
        commands = pandas.read_csv(commands_beside(path)).set_index("number")["command"]
        table["command"] = table["command"].map(commands)
    return table


def together(paths: Iterable[Path | str]) -> pandas.DataFrame:
    return pandas.concat([read_rows(p) for p in paths], ignore_index=True)


def collect(paths: Iterable[Path | str], path: Path | str, by: list[str] | None = None) -> None:
    """Puts the rows of many files into one, in the order of the columns `by`, else of the files."""
    table = together(paths)
    if by:
        table = table.sort_values(by, kind="stable", ignore_index=True)
    write_rows(path, table)
