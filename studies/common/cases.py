# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs decks, reads their logs and measures the beds they leave."""
from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
import shutil
import subprocess
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path

import pandas

from .rows import PLUGIN_SOURCES

ROOT = Path(__file__).resolve().parents[2]
DEFAULT_BUILD = ROOT / "build" / "release"


class CaseError(RuntimeError):
    """A program that failed, in one sentence."""


class DeckError(CaseError):
    """A run that ended in an error of LIGGGHTS: `reason` is its line, `command` what was typed."""

    def __init__(self, reason: str, command: str, where: str):
        super().__init__(f"{reason} ({where})")
        self.reason, self.command = reason, command


@dataclass(frozen=True)
class Run:
    loop_seconds: float  # of all `run` commands of the deck together, as LIGGGHTS gives them
    cpu_seconds: float   # user and system time of the program, of all ranks together
    log: Path
    command: str         # as typed, with paths from the project's folder on


def program_path(name: str, build: Path | str | None = None) -> str:
    """One of ours in `build`, the stock liggghts of the PATH, or lammps: Debian's, an lmp like ours."""
    if name == "lammps":
        return lammps_path()
    if name == "liggghts":
        found = shutil.which(name)
        if not found:
            raise CaseError("liggghts is not there: scripts/setup installs it")
        return found
    path = Path(build or DEFAULT_BUILD).resolve() / name
    if not path.exists():
        raise CaseError(f"{path} is not there: scripts/build makes it")
    return str(path)


def lammps_path() -> str:
    try:
        listed = subprocess.run(["dpkg-query", "-L", "lammps"], text=True,
                                capture_output=True).stdout
    except FileNotFoundError:
        listed = ""
    found = [line for line in listed.splitlines()
             if line.endswith("/bin/lmp") and Path(line).exists()]
    if not found:
        raise CaseError("Debian's package lammps is not there: scripts/setup --studies installs it")
    return found[0]


def with_included(source: Path, folders: list[Path]) -> set[Path]:
    """A source, the headers that it includes from the folders and, as those do, their .cpp files."""
    found: set[Path] = set()
    waiting = [source]
    while waiting:
        path = waiting.pop()
        if path in found or not path.exists():
            continue
        found.add(path)
        names = re.findall(r'^#include "(.+)"', path.read_text(), re.MULTILINE)
        waiting += [folder / name for name in names for folder in folders]
        waiting += [path.with_suffix(".cpp")] if path.suffix == ".h" else []
    return found


def made_of(program: str, root: Path = ROOT) -> dict[str, set[Path]]:
    """Files in the build's folder, each with its sources of ours: lmp loads the plug-in."""
    if program == "lmp":
        files = {path for folder in PLUGIN_SOURCES for path in (root / folder).rglob("*")
                 if path.suffix in (".h", ".cpp") and not path.stem.endswith("_main")}
        start = {path for path in files if path.name == "lmp.cpp"}
        return {"lmp": start, "libspherocylinder.so": files - start}
    return {program: with_included(root / "postproc" / "tools" / f"{program}.cpp",
                                   [root / "postproc", root / "src_plugin"])}


def why_not_to_be_run(program: str, build: Path, root: Path = ROOT) -> str | None:
    """A program that is missing, or older than its sources, in a sentence."""
    for name, sources in made_of(program, root).items():
        made = build / name
        if not made.exists():
            return f"{made} is not there: scripts/build makes it"
        for source in sorted(sources):
            if source.stat().st_mtime > made.stat().st_mtime:
                return f"{source.relative_to(root)} is newer than {made}: scripts/build makes it anew"
    return None


_RUNNING: set[subprocess.Popen] = set()   # decks, each in a thread
_STOPPED = threading.Event()


def stop_all() -> None:
    """Ends what run_deck runs in other threads; nothing more is begun."""
    _STOPPED.set()
    for process in list(_RUNNING):
        process.kill()


def run_deck(folder: Path | str, deck: Path | str, variables: dict | None = None,
             program: str = "lmp", ranks: int = 1, build: Path | str | None = None,
             name: str | None = None, under: tuple = ()) -> Run:
    """Runs a deck with `folder` as its working folder; leaves log.NAME and screen.NAME there, NAME
    being the deck's name without `in.` unless given. `under`: the words of a program under which
    each rank is run, as `time` or `prlimit`. Raises CaseError with the deck's ERROR line.
    """
    folder = Path(folder)
    deck = str(deck)
    name = name or re.sub(r"^in\.", "", Path(deck).name)
    log, screen = folder / f"log.{name}", folder / f"screen.{name}"
    start = program_path(program, build)
    command = [start, "-in", deck, "-log", log.name]
    for variable, value in (variables or {}).items():
        values = value if isinstance(value, (list, tuple)) else [value]
        command += ["-var", variable, *map(str, values)]
    spread = []
    if ranks > 1:
        spread = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none"]
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    # Single ranks of Open MPI share, and remove, one session folder; its path must be short.
    with tempfile.TemporaryDirectory(prefix="mpi") as session, open(screen, "wb") as out:
        environment["OMPI_MCA_orte_tmpdir_base"] = session
        if ranks == 1:
            environment["OMPI_MCA_ess_singleton_isolated"] = "1"
        if _STOPPED.is_set():
            raise CaseError("stopped by a signal")
        process = subprocess.Popen([*spread, *map(str, under), *command], cwd=folder,
                                   env=environment, stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=subprocess.STDOUT)
        _RUNNING.add(process)
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            raise
        finally:
            _RUNNING.discard(process)
        process.returncode = os.waitstatus_to_exitcode(status)
    text = screen.read_text(errors="replace")
    typed = shlex.join([program if word == start else word.replace(f"{ROOT}/", "")
                        for word in [*spread, *command]])
    reason = failure(text, process.returncode)
    if reason:
        where = f"in {folder}: {typed}; all of it in {screen}"
        if reason.startswith("ERROR"):
            raise DeckError(reason, typed, where)
        raise CaseError(f"{reason} ({where})")
    loops = [float(t) for t in re.findall(r"^Loop time of (\S+) on", text, re.MULTILINE)]
    return Run(sum(loops), usage.ru_utime + usage.ru_stime, log, typed)


@contextlib.contextmanager
def one_thread():
    """Programs that are run within have one thread, whatever OMP_NUM_THREADS is."""
    before = os.environ.get("OMP_NUM_THREADS")
    os.environ["OMP_NUM_THREADS"] = "1"
    try:
        yield
    finally:
        del os.environ["OMP_NUM_THREADS"]
        if before is not None:
            os.environ["OMP_NUM_THREADS"] = before


def run_counted(folder: Path | str, deck: Path | str, variables: dict | None = None,
                program: str = "lmp", build: Path | str | None = None,
                name: str | None = None, copies_as_loops: bool = False) -> tuple[int, str]:
    """Runs a deck on one rank of one thread: the instructions of its steps, not of what comes before and
    after, and the command as typed. Of a long copy valgrind counts each byte where the C library has one
    instruction repeat it; `copies_as_loops` has it copy by loops."""
    if not shutil.which("valgrind"):
        raise CaseError("the program valgrind is not there: scripts/setup --studies installs it")
    out = Path(folder) / "callgrind.out"
    under = ("valgrind", "--tool=callgrind", f"--callgrind-out-file={out.name}",
             "--toggle-collect=LAMMPS_NS::Verlet::run(int)")
    if copies_as_loops:
        settings = ":".join(f"glibc.cpu.x86_rep_{word}_threshold=1000000000"
                            for word in ("movsb", "stosb"))
        under = ("env", f"GLIBC_TUNABLES={settings}", *under)
    with one_thread():  # those that wait for others count, too
        run = run_deck(folder, deck, variables, program, build=build, name=name, under=under)
    found = re.search(r"^(?:totals|summary): (\d+)", out.read_text(), re.MULTILINE)
    out.unlink()
    if not found or int(found[1]) == 0:
        raise CaseError(f"callgrind counted nothing in {folder}")
    return int(found[1]), f"{shlex.join(under)} {run.command}"


def link_decks(folder: Path | str, decks) -> None:
    """Makes the folder and puts links to the decks there, so that one can include the other."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for deck in map(Path, decks):
        link = folder / deck.name
        link.unlink(missing_ok=True)
        link.symlink_to(deck.resolve())


def failure(screen: str, code: int) -> str | None:
    """Why a run failed, None if it did not. LIGGGHTS ends with 0 after a `quit` and after a
    signal."""
    error = re.search(r"^\s*(ERROR.*)$", screen, re.MULTILINE)
    if error:
        return error.group(1).strip()
    if "SIGINT/SIGTERM caught" in screen:
        return "stopped by a signal"
    if code < 0:
        return f"ended by signal {-code}"
    if code != 0:
        last = screen.strip().splitlines()[-1:] or ["no output"]
        return f"exit code {code}: {last[0]}"
    return None


def read_log(path: Path | str) -> list[pandas.DataFrame]:
    """The tables of a log, one a `run`. LIGGGHTS calls all values of a compute alike: the second
    column `contacts` becomes contacts.2, the third contacts.3."""
    tables: list[pandas.DataFrame] = []
    columns: list[str] = []
    rows: list[str] = []
    for line in Path(path).read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            columns, rows = unlike(words), []
        elif line.startswith("Loop time"):
            if columns:
                tables.append(table_of(columns, rows))
            columns = []
        elif columns and len(words) == len(columns) and words[0].isdigit():
            rows.append(" ".join(words))
    if columns and rows:
        tables.append(table_of(columns, rows))  # of a run that is not over
    if not tables:
        raise CaseError(f"{path} has no table")
    return tables


def last_table(path: Path | str, names: list[str]) -> pandas.DataFrame:
    """The last table of a log, which must have these columns."""
    table = read_log(path)[-1]
    for name in names:
        if name not in table:
            raise CaseError(f"{path} has no column {name} (its columns are: "
                            f"{' '.join(table.columns)})")
    return table


def unlike(names: list[str]) -> list[str]:
    seen: dict[str, int] = {}
    result = []
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        result.append(name if seen[name] == 1 else f"{name}.{seen[name]}")
    return result


def table_of(columns: list[str], rows: list[str]) -> pandas.DataFrame:
    return pandas.read_csv(io.StringIO("\n".join(rows)), sep=" ", names=columns,
                           float_precision="round_trip")


def run_tool(name: str, *arguments, build: Path | str | None = None) -> str:
    """Runs one of the rod_* programs; its output, or CaseError with its sentence."""
    done = subprocess.run([program_path(name, build), *map(str, arguments)], text=True,
                          stdin=subprocess.DEVNULL, capture_output=True)
    if done.returncode != 0:
        lines = (done.stderr.strip() or done.stdout.strip()).splitlines() or ["no output"]
        raise CaseError(lines[-1] if lines[-1].startswith(name) else f"{name}: {lines[-1]}")
    return done.stdout


def measure_bed(dump: Path | str, vessel_radius: float, build: Path | str | None = None,
                options: tuple = ()) -> dict:
    """Columns of rod_packing and of rod_orientation's summary, of the dump's last frame; those that
    both have are rod_packing's. `options` are for both programs."""
    with tempfile.TemporaryDirectory() as folder:
        packing, order = Path(folder, "packing.csv"), Path(folder, "order.csv")
        run_tool("rod_packing", dump, "--vessel-radius", vessel_radius, "--csv", packing, *options,
                 build=build)
        run_tool("rod_orientation", dump, "--summary-csv", order, *options, build=build)
        values: dict = {}
        for path in (order, packing):
            table = pandas.read_csv(path, float_precision="round_trip")
            values.update(table.iloc[-1].to_dict())
    return values


def measure_elevation(dump: Path | str, bins: int,
                      build: Path | str | None = None) -> pandas.DataFrame:
    """rod_orientation's distribution of the elevation, a row a bin."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "elevation.csv")
        run_tool("rod_orientation", dump, "--bins", bins, "--csv", path, build=build)
        return pandas.read_csv(path, float_precision="round_trip")
