# SPDX-License-Identifier: GPL-2.0-or-later
"""What is given by --config: a study refuses what it cannot use, in a sentence and before anything is run."""
import re

import pytest

from conftest import ROOT

STUDIES = sorted(path.parent.name for path in ROOT.glob("studies/*/Snakefile"))


def told(output):
    """What snakemake says beside the names of files that it reads."""
    lines = output.splitlines()
    return [line for line in lines if line != "WorkflowError:" and not line.startswith("Config file")]


@pytest.mark.parametrize("name, setting, words", [
    ("minimal", "fresh_seeds=abc", "fresh_seeds must be a whole number >= 1 (got abc)"),
    ("minimal", "rest_steps=0", "rest_steps must be a whole number >= 1 (got 0)"),
    ("minimal", "bed_turns=1.5", "bed_turns must be a whole number >= 1 (got 1.5)"),
    ("minimal", "number=2.5", "number must be a whole number >= 0 (got 2.5)"),
    ("minimal", "feature_seed=abc", "feature_seed must be a whole number >= 1 (got abc)"),
    ("minimal", "features=gas", "features must be a mapping {KEY: VALUE} (got gas)"),
    ("minimal", "features={gas: [nonsense]}",
     "features of gas must be a list that begins with as it is (got ['nonsense'])"),
    ("minimal", "features={gas: [as it is, nonsense]}", "features of gas must be among as it is, without"),
    ("speed_accuracy", "seed=abc", "seed must be a whole number >= 1 (got abc)"),
    ("speed_accuracy", "copies=2.5", "copies must be a whole number >= 1 (got 2.5)"),
    ("speed_accuracy", "rods_fractions=5", "rods_fractions must be a number from 1e-06 to 1 (got 5)"),
    ("speed_accuracy", "bed_seeds=abc", "bed_seeds must be a whole number >= 1 (got abc)"),
    ("speed_accuracy", "bed_rods=5", "each of bed_rods must be a mapping {KEY: VALUE} with rule, "
     "stiffness, fraction, seeds (got 5)"),
    ("speed_accuracy", "bed_rods=[{rule: some, stiffness: 1, fraction: 0.1, seeds: 1}]",
     "rule of bed_rods must be spread or single (got some)"),
    ("speed_accuracy", "bed_reference=5", "bed_reference must be a mapping {KEY: VALUE} (got 5)"),
    ("speed_accuracy", "beds_kept=1", "beds_kept=1 takes the beds of "),
    ("packing", "snapshots=abc", "snapshots must be a number >= 0 (got abc)"),
    ("packing", "variables=5", "variables must be a mapping {KEY: VALUE} (got 5)"),
    ("sensitivity", "factors=5", "factors must be a mapping {KEY: VALUE} (got 5)"),
    ("stability", "hit_phases=2.5", "hit_phases must be a whole number >= 1 (got 2.5)"),
    ("experiments", "spheres_spacings=abc", "spheres_spacings must be a number >= 0.001 (got abc)")])
def test_what_cannot_be_used_is_refused_in_a_sentence(study, name, setting, words):
    done = study(name, setting, options=["-n"], cores=1)
    assert done.returncode != 0
    assert len(told(done.stdout)) == 1 and told(done.stdout)[0].startswith(f"{name}: {words}"), done.stdout


@pytest.mark.parametrize("name", STUDIES)
def test_kept_tables_that_are_not_there_are_named(study, tmp_path, name):
    done = study(name, "kept=1", options=["-n"], cores=1)
    assert done.returncode != 0
    assert re.fullmatch(rf"{name}: kept=1 makes figures and pages of {tmp_path}/results/\w+\.csv, which is "
                        "not there: without kept=1 it is made", "\n".join(told(done.stdout))), done.stdout


def test_studies_are_listed():
    text = (ROOT / "studies/README.md").read_text()
    for name in STUDIES:
        assert f"[{name}]({name}" in text, name


# As the page has it: two sweeps of one scene, and no beds.
def test_one_scene_is_made_without_beds(study):
    page = (ROOT / "studies/speed_accuracy/README.md").read_text()
    settings = re.search(r"--config (scenes=wall .*?) +#", page).group(1).split()
    settings.remove("work=wall")
    done = study("speed_accuracy", *settings, options=["-n"])
    assert done.returncode == 0, done.stdout
    assert set(re.findall(r"^(?:local)?rule (\w+):", done.stdout, re.MULTILINE)) == {
        "all", "scene_sweep", "scene_timing", "scene_rows", "charts", "page"} and \
        done.stdout.count("rule scene_sweep:") == 2
