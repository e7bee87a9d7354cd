# SPDX-License-Identifier: GPL-2.0-or-later
"""What scripts/run does when all is built: pours, settles, measures and draws beds, several at a time, and
tells them in a table: pour_all.py FOLDER JOBS SEEDS LAMBDA..."""
from __future__ import annotations

import fcntl
import hashlib
import os
import re
import shutil
import signal
import sys
import time
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from pathlib import Path

from studies.common import cases, resume, rows
from studies.packing import beds

BUILD = cases.DEFAULT_BUILD
SEEDS = [86028121, 49979687, 67867967, 104395301, 122949823, 141650939, 160481183, 179424673,
         198491317, 217645177]
FINISHED = "wall_seconds"   # the file of a case that is written last
EVERY = 10.0                # s between two lines of progress

# Headings, units, columns, formats.
SHOWN = [("lambda", "", "lambda", "6d"), ("limits", "", "limits", ">6s"), ("seed", "", "seed", "9d"),
         ("Vf_whole", "", "vf_whole", "8.4f"), ("Vf_inner", "", "vf_inner", "8.4f"),
         ("theory", "", "vf_theory", "8.4f"), ("elevation", "deg", "mean_elevation_deg", "9.2f"),
         ("contacts", "per rod", "contacts_per_rod", "8.2f"),
         ("overlap", "max/D", "largest_overlap_over_diameter", "9.4f"),
         ("momentary", "max/D", "momentary_overlap_over_diameter", "9.4f"),
         ("energy", "J", "energy_J", "9.1e"), ("time", "s", "wall_s", "6d")]


def named(folder: Path) -> tuple[str, ...]:
    return re.fullmatch(r"lambda(\d+)_limits_(\w+)_seed(\d+)", folder.name).groups()


def row_of(folder: Path) -> dict:
    aspect, limits, seed = named(folder)
    measured = {**rows.read_rows(folder / "order.csv").iloc[-1],
                **rows.read_rows(folder / "packing.csv").iloc[-1]}
    return {"lambda": int(aspect), "limits": limits, "seed": int(seed),
            **{ours: measured[theirs] for theirs, ours in beds.MEASURES.items()},
            **beds.log_values(folder / "log.fill", folder / "log.settle"),
            "wall_s": int((folder / FINISHED).read_text())}


def show(table: list[dict]) -> None:
    widths = [re.match(r">?(\d+)", form).group(1) for *_, form in SHOWN]
    for texts in zip(*[(heading, unit) for heading, unit, *_ in SHOWN]):
        print(" ".join(f"{text:>{width}}" for text, width in zip(texts, widths)))
    for row in table:
        print(" ".join(f"{row[column]:{form}}" for _, _, column, form in SHOWN))


def pour(folder: Path, maker: str) -> None:
    """One case from nothing, or on from where it was cut off."""
    begin = time.monotonic()
    aspect, limits, seed = named(folder)
    made_by = folder / "made_by"
    if not (made_by.exists() and made_by.read_text().strip() == maker):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for deck in beds.DECKS:
            shutil.copy(deck, folder)
        made_by.write_text(maker + "\n")
    given = {"lambda": aspect, "seed": seed}
    if limits == "none":
        given |= {"limit_fill": 0, "limit_settle": 0}
    if resume.step_of_whole_restart(folder / "restart.fill") is None:
        resume.run_deck(folder, "in.fill", given, build=BUILD)
    if resume.step_of_whole_restart(folder / "restart.settle") is None:
        resume.run_deck(folder, "in.settle", given, build=BUILD)
    dump = folder / "dump.settle"
    radius = beds.deck_variables(folder / "in.case")["vessel_diameter"] / 2
    vessel = ("--vessel-radius", f"{radius:.10g}")
    for name, program, *options in (
            ("packing", "rod_packing", *vessel, "--csv", folder / "packing.csv"),
            ("orientation", "rod_orientation", "--bins", 12, "--csv", folder / "orientation.csv",
             "--summary-csv", folder / "order.csv"),
            ("picture", "rod_render", *vessel, "--out", folder / "bed.png")):
        (folder / f"{name}.txt").write_text(cases.run_tool(program, dump, *options, build=BUILD))
    (folder / FINISHED).write_text(f"{time.monotonic() - begin:.0f}\n")


def steps_of(folder: Path) -> float:
    for stage in ("settle", "fill"):
        try:
            return cases.last_table(folder / f"log.{stage}", ["Step"])["Step"].max()
        except (OSError, cases.CaseError):
            pass   # nothing yet
    return 0.0


def tell_progress(jobs: dict[Future, Path], began: float) -> None:
    deck = beds.deck_variables(beds.DECKS[0])
    steps = sum(steps_of(folder) for job, folder in jobs.items() if job.running() or job.done())
    part, past = steps / (len(jobs) * deck["total_time"] / deck["dt"]), time.monotonic() - began
    left = f"{past / part - past:.0f}" if part else "..."
    running = sum(job.running() for job in jobs)
    waiting = sum(not (job.running() or job.done()) for job in jobs)
    print(f"run: {waiting} cases to begin, {running} running, {100 * part:.0f} % of the steps, "
          f"{past:.0f} s so far, {left} s left", flush=True)


def pour_all(folders: list[Path], jobs_at_once: int, maker: str) -> list[str]:
    """The names of cases that failed, of which each is told at once."""
    failed: list[str] = []
    with ThreadPoolExecutor(jobs_at_once) as threads:
        began = shown = time.monotonic()
        jobs = {threads.submit(pour, folder, maker): folder for folder in folders}
        waiting = set(jobs)
        try:
            while waiting:
                done, waiting = wait(waiting, timeout=1.0, return_when=FIRST_COMPLETED)
                for job in done:
                    error = job.exception()
                    if error:
                        failed.append(jobs[job].name)
                        print(f"run: {jobs[job].name} failed: {error}", file=sys.stderr, flush=True)
                if time.monotonic() - shown >= EVERY:
                    tell_progress(jobs, began)
                    shown = time.monotonic()
        except BaseException:
            threads.shutdown(wait=False, cancel_futures=True)
            cases.stop_all()
            raise
    return failed


def threads_of_each(wanted: int, jobs_at_once: int, processors: int | None = None) -> int:
    processors = processors or len(os.sched_getaffinity(0))
    return max(1, processors // max(1, min(wanted, jobs_at_once)))


def kept(folder: Path, maker: str) -> bool:
    if not (folder / FINISHED).exists():
        return False
    if (folder / "made_by").read_text().strip() != maker:
        refuse(f"{folder} was made with other decks or another plug-in: move it away or give another folder")
    print(f"run: {folder.name} is finished, kept", flush=True)
    return True


def refuse(sentence: str) -> None:
    print(f"run: {sentence}", file=sys.stderr)
    sys.exit(2)


def main(out: str, jobs: str, seeds: str, *aspects: str) -> None:
    def stop(*_) -> None:
        sys.exit(130)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    folder = Path(out)
    lock = os.open(folder, os.O_RDONLY)
    try:   # two at once would remove each other's runs
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        refuse(f"another run works in {out}: wait until it has ended")
    made_of = [*beds.DECKS, BUILD / "libspherocylinder.so"]
    maker = hashlib.sha256(b"".join(path.read_bytes() for path in made_of)).hexdigest()
    folders = [folder / f"lambda{aspect}_limits_{limits}_seed{seed}" for seed in SEEDS[:int(seeds)]
               for aspect in aspects for limits in ("study", "none")]
    wanted = [path for path in folders if not kept(path, maker)]
    # Processors that no case has are threads of the others: what comes out does not depend on it.
    os.environ.setdefault("OMP_NUM_THREADS", str(threads_of_each(len(wanted), int(jobs))))
    failed = pour_all(wanted, int(jobs), maker)
    if failed:
        print(f"run: failed: {' '.join(failed)}", file=sys.stderr)
        sys.exit(1)
    table = [row_of(path) for path in folders]
    rows.write_rows(folder / "summary.csv", table)
    show(table)
    print(f"run: table in {out}/summary.csv; pictures and the rest in {out}/lambda*/")


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except (cases.CaseError, OSError) as error:
        sys.exit(f"run: {error}")
