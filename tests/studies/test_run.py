# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/run from end to end, in a copy of what it reads, with an lmp that pours few rods."""
import os
import shutil
import signal
import subprocess
import time
from concurrent.futures import Future

import pytest

from conftest import ROOT
from studies.common import rows
from studies.packing import pour_all

FEW_RODS = "-var rods 60 -var vessel_height 2 -var fill_time 0.7 -var total_time 1.4"


@pytest.fixture
def copy(tmp_path, programs):
    for folder in ("scripts", "input", "studies/common", "studies/packing"):
        shutil.copytree(ROOT / folder, tmp_path / folder,
                        ignore=shutil.ignore_patterns("results", "__pycache__", "dump.*", "restart*"))
    (tmp_path / "scripts/setup").write_text("#!/bin/sh\n")
    (tmp_path / "scripts/build").write_text("#!/bin/sh\necho \"$*\" >built\n")
    (tmp_path / "build/release").mkdir(parents=True)
    (tmp_path / "build/release/libspherocylinder.so").symlink_to(programs / "libspherocylinder.so")
    for name in ("rod_packing", "rod_orientation", "rod_render"):
        tool = tmp_path / "build/release" / name
        tool.write_text(f'#!/bin/sh\necho "$OMP_NUM_THREADS" >>{tmp_path}/threads\n'
                        f'exec {programs / name} "$@"\n')
        tool.chmod(0o755)
    lmp(tmp_path, f'echo "$*" >>{tmp_path}/calls\nexec {programs}/lmp "$@" {FEW_RODS}\n')
    return tmp_path


def lmp(copy, text):
    path = copy / "build/release/lmp"
    path.write_text("#!/bin/sh\n" + text)
    path.chmod(0o755)


def run(copy, *arguments):
    return subprocess.run([copy / "scripts/run", *arguments], text=True, capture_output=True)


def test_makes_a_table_and_pictures_once(copy):
    done = run(copy, "10", "--out", copy / "beds", "--jobs", "2")
    assert done.returncode == 0, done.stdout + done.stderr
    # What is used and nothing else, least of all tests.
    assert (copy / "built").read_text() == \
        "release lmp spherocylinder rod_packing rod_orientation rod_render\n"
    assert len((copy / "calls").read_text().splitlines()) == 4
    # Cases at once share the processors, with all of their programs.
    threads = os.environ.get("OMP_NUM_THREADS") or str(pour_all.threads_of_each(2, 2))
    assert (copy / "threads").read_text().split() == 6 * [threads]
    table = rows.read_rows(copy / "beds/summary.csv")
    assert list(table["limits"]) == ["study", "none"] and list(table["lambda"]) == [10, 10]
    folder = copy / "beds/lambda10_limits_none_seed86028121"
    assert (folder / "bed.png").exists() and (folder / "orientation.csv").exists()
    measured = rows.read_rows(folder / "packing.csv").iloc[-1]
    assert table["vf_inner"][1] == measured["vf_inner"]
    lines = [line for line in done.stdout.splitlines() if not line.startswith("run:")]
    assert lines[0].split()[:5] == ["lambda", "limits", "seed", "Vf_whole", "Vf_inner"]
    assert lines[3].split()[:5] == \
        ["10", "none", "86028121", f"{measured['vf_whole']:.4f}", f"{measured['vf_inner']:.4f}"]

    again = run(copy, "10", "--out", copy / "beds")
    assert again.returncode == 0 and again.stdout.count("is finished, kept") == 2
    assert len((copy / "calls").read_text().splitlines()) == 4
    with open(copy / "input/in.rods", "a") as deck:
        deck.write("# changed\n")
    other = run(copy, "10", "--out", copy / "beds")
    assert other.returncode == 2
    assert "was made with other decks or another plug-in: move it away" in other.stderr


@pytest.mark.parametrize("wanted, jobs, processors, threads", [
    (2, 2, 2, 1), (2, 8, 8, 4), (6, 8, 8, 1), (1, 8, 8, 8), (0, 8, 8, 8), (2, 1, 4, 4), (4, 4, 2, 1)])
def test_processors_are_divided(wanted, jobs, processors, threads):
    assert pour_all.threads_of_each(wanted, jobs, processors) == threads


def test_a_case_that_fails_is_named(copy, programs):
    lmp(copy, f'case "$*" in *limit_fill*) set -- "$@" -var friction -1 ;; esac\n'
              f'exec {programs}/lmp "$@" {FEW_RODS}\n')
    done = run(copy, "--out", copy / "beds", "--jobs", "2")
    assert done.returncode == 1
    assert "run: lambda10_limits_none_seed86028121 failed: ERROR: in.rods: friction must be >= 0 (got -1) " \
        in done.stderr
    assert done.stderr.endswith("run: failed: lambda10_limits_none_seed86028121\n")
    assert (copy / "beds/lambda10_limits_study_seed86028121/wall_seconds").exists()
    assert not (copy / "beds/lambda10_limits_none_seed86028121/wall_seconds").exists()


# Its programs end with it, and what it began is not taken for finished; two at once are refused.
def test_stopped_by_a_signal(copy):
    lmp(copy, f"echo $$ >>{copy}/processes\nexec sleep 100\n")
    process = subprocess.Popen([copy / "scripts/run", "--out", copy / "beds", "--jobs", "1"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not (copy / "processes").exists() or not (copy / "processes").read_text():
        time.sleep(0.1)
    second = run(copy, "--out", copy / "beds")
    assert second.returncode == 2
    assert f"run: another run works in {copy}/beds: wait until it has ended" in second.stderr
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=60) != 0
    for number in (copy / "processes").read_text().split():
        with pytest.raises(ProcessLookupError):
            os.kill(int(number), 0)
    assert not list((copy / "beds").glob("*/wall_seconds"))


# A case that is killed goes on from the newer of its two restart files, to the same bed.
def test_a_killed_case_goes_on(copy, programs):
    every = "-var restart_every 2000 -var dump_every 5000 -var thermo_every 1000"
    lmp(copy, f"exec {programs}/lmp \"$@\" {FEW_RODS} {every}\n")
    assert run(copy, "--out", copy / "whole", "--jobs", "2").returncode == 0
    lmp(copy, f'echo "$*" >>{copy}/calls\n'
              f'case "$*" in *"go_on 1"*) ;; *in.settle*) (sleep 0.1; while [ ! -s restart.settle.b ]; do '
              f"sleep 0.01; done; kill -9 $$) & ;; esac\n"
              f"exec {programs}/lmp \"$@\" {FEW_RODS} {every}\n")
    killed = run(copy, "--out", copy / "beds", "--jobs", "2")
    assert killed.returncode == 1
    done = run(copy, "--out", copy / "beds", "--jobs", "2")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "-var from restart.settle." in (copy / "calls").read_text()
    for folder in (copy / "whole").glob("lambda*"):
        there = copy / "beds" / folder.name
        assert (there / "dump.settle").read_text() == (folder / "dump.settle").read_text()
        assert (there / "packing.csv").read_text() == (folder / "packing.csv").read_text()
        assert not list(there.glob("restart.*.[ab]"))


def test_whole_restart_files_are_told(copy, tmp_path, programs):
    from studies.common import resume
    subprocess.run([programs / "lmp", "-in", "in.fill", "-log", "log.fill", *FEW_RODS.split()],
                   cwd=copy / "input", check=True, stdout=subprocess.DEVNULL)
    whole = (copy / "input/restart.fill").read_bytes()
    path = tmp_path / "file"
    path.write_bytes(whole)
    assert resume.step_of_whole_restart(path) == 35000
    assert resume.step_of_whole_restart(tmp_path / "none") is None
    changed = bytearray(whole)
    changed[len(whole) // 2] ^= 1
    for wrong in (b"", whole[:-1], whole[:-500], whole[1:], bytes(changed), whole + b" "):
        path.write_bytes(wrong)
        assert resume.step_of_whole_restart(path) is None


@pytest.mark.parametrize("arguments, words", [
    (["--seeds", "11"], "run: --seeds must be 1 to 10 (got '11')"),
    (["--jobs", "0"], "run: --jobs must be a whole number > 0 (got '0')"),
    (["--out"], "run: --out wants a folder"),
    (["15"], "run: expected lambda 10, 20 or 30 or an option (got '15')")])
def test_wrong_options(arguments, words):
    done = subprocess.run([ROOT / "scripts/run", *arguments], text=True, capture_output=True)
    assert done.returncode == 2 and words in done.stderr
    assert len(done.stderr.splitlines()) == 1


# How far the cases are that run or have ended, of three of which each has 500000 steps.
def test_progress(tmp_path, capsys, monkeypatch):
    folders = [tmp_path / name for name in ("a", "b", "c")]
    for folder, stage, step in ((folders[0], "settle", 500000), (folders[1], "fill", 25000)):
        folder.mkdir()
        (folder / f"log.{stage}").write_text(f"Step Atoms\n0 1\n{step} 1\n")
    jobs = {Future(): folder for folder in folders}
    first, second, _ = jobs
    first.set_result(None)
    second.set_running_or_notify_cancel()
    monkeypatch.setattr(pour_all.time, "monotonic", lambda: 170.0)
    pour_all.tell_progress(jobs, 100.0)
    assert capsys.readouterr().out == \
        "run: 1 cases to begin, 1 running, 35 % of the steps, 70 s so far, 130 s left\n"


def test_scripts_fit_on_a_screen():
    lines = {path.name: len(path.read_text().splitlines()) for path in (ROOT / "scripts").iterdir()}
    assert max(lines.values()) <= 60 and sum(lines.values()) < 250, lines
