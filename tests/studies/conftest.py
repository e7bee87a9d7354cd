# SPDX-License-Identifier: GPL-2.0-or-later
"""What all tests of the studies share."""
import os
import re
import shutil
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


@pytest.fixture
def kept_page_is_made_again(study, tmp_path):
    """kept_page_is_made_again("minimal"): from its kept tables a study makes the page that is kept."""
    def make(name):
        folder = ROOT / name if "/" in name else ROOT / "studies" / name
        if not (folder / "README.md").exists():
            pytest.skip("no page is kept yet")
        shutil.copytree(folder / "results", tmp_path / "results")
        done = study(name, "kept=1", "pdf=1")
        assert done.returncode == 0, done.stdout
        for path in tmp_path.glob("results/*.svg"):
            assert path.with_suffix(".pdf").exists(), path
        kept = (folder / "README.md").read_text()
        assert (tmp_path / "results/README.md").read_text() == kept.replace("](results/", "](")

    return make


def measured_numbers(template):
    """Decimal numbers and percentages that a page's template holds outside code and expressions."""
    told_apart = re.compile(r"\{\{.*?\}\}|\{%.*?%\}|`[^`]*`|```.*?```", re.DOTALL)
    text = told_apart.sub(" ", template.read_text())
    return set(re.findall(r"(?<![\w.])\d+\.\d+|\d+(?= ?%)", text))
