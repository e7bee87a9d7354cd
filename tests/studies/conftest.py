# SPDX-License-Identifier: GPL-2.0-or-later
"""What all tests of the studies share."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

# The build whose programs are tested; ctest tells it.
PROGRAMS = Path(os.environ.get("PROGRAM_FOLDER", ROOT / "build" / "release"))


@pytest.fixture
def programs() -> Path:
    return PROGRAMS


@pytest.fixture
def study(tmp_path):
    """study("packing", "smoke=1", "seeds=2") runs a study's graph with its work and results in
    tmp_path, results in tmp_path/results; gives snakemake's exit code and output."""
    def run(folder, *settings, targets=(), cores=2, options=()):
        folder = ROOT / folder if "/" in folder else ROOT / "studies" / folder
        command = ["/usr/bin/snakemake", "-s", folder / "Snakefile", "--cores", cores, "--force-use-threads",
                   *targets, *options,
                   "--config", f"build={PROGRAMS}", f"work={tmp_path}", *settings]
        return subprocess.run([str(word) for word in command], cwd=tmp_path, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return run
