# SPDX-License-Identifier: GPL-2.0-or-later
"""studies/minimal and what it shares with the beds of studies/speed_accuracy."""
import math
import re

import numpy as np
import pandas
import pytest

from conftest import ROOT, measured_numbers
from studies.common import cases, settling
from studies.common.rows import read_rows
from studies.minimal import advice, features, page
from studies.speed_accuracy import beds

STUDY = ROOT / "studies/minimal"


# --- Settling. -----------------------------------------------------------------------------------

# Mass by thin discs along the axis; the limit of two rods end to end at right angles to the line of
# their centres: 1/m_eff = 2 (1/m + (L/2)²/I) ≈ 8/m, of a thin rod.
def test_mass_and_time_step_limit():
    radius, half = 0.005, 0.15
    edges = np.linspace(-half, half, 200_001)
    z = np.abs(0.5 * (edges[1:] + edges[:-1]))
    r2 = radius ** 2 - np.maximum(0.0, z - (half - radius)) ** 2
    mass = 2700 * math.pi * r2.sum() * (edges[1] - edges[0])
    assert settling.mass_of(30) == pytest.approx(mass, rel=1e-7)
    effective = 1 / (2 * (1 / mass + half ** 2 / (mass * (2 * half) ** 2 / 12)))
    assert settling.time_step_limit(30) == pytest.approx(2 * math.sqrt(effective / 6e5), rel=1e-6)


# The decks take the ceiling of a time over the step.
@pytest.mark.parametrize("aspect", [3, 10, 30])
@pytest.mark.parametrize("fraction", [0.045, 0.36, 0.54])
def test_time_steps_divide_the_time_of_filling(aspect, fraction):
    step = settling.time_step(aspect, 2e4, fraction)
    steps = settling.FILL_TIME / step
    assert math.ceil(steps) == round(steps)
    assert step <= fraction * settling.time_step_limit(aspect) * (1 + 1e-9)


def test_vessels_of_the_decks():
    text = settling.DECKS[0].read_text()
    for aspect, (vessel, rods) in settling.VESSELS.items():
        assert re.search(rf'lambda}} == {aspect:g}" then &\n  "variable vessel_diameter index '
                         rf'{vessel}" &\n  "variable rods index {rods}"', text)
        assert vessel == pytest.approx(settling.DIAMETER * (2 * aspect + 1))


# --- Equivalence. --------------------------------------------------------------------------------

def runs_of(shift, scatter, count=30):
    rng = np.random.default_rng(5)
    result = []
    for aspect in (10, 20):
        for way in ("today", "quick"):
            for seed in range(count):
                factor = (shift if way == "quick" else 1) * (1 + scatter * rng.normal())
                result.append({"limits": "none", "lambda": aspect, "way": way, "seed": seed,
                               **{q: factor * aspect for q in advice.QUANTITIES}})
    return pandas.DataFrame(result)


def test_equivalence_is_shown_refused_or_left_open():
    alike = pandas.DataFrame(advice.equivalences(runs_of(1.0, 0.01), 0.03))
    assert list(alike["lambda"].unique()) == [10, 20, 0] and alike["equivalent"].all()
    assert (alike["beds_today"] == [30] * 8 + [60] * 4).all()
    apart = pandas.DataFrame(advice.equivalences(runs_of(1.05, 0.01), 0.03))
    assert not apart["equivalent"].any() and (apart["low"] > 0.03).all()
    few = pandas.DataFrame(advice.equivalences(runs_of(1.0, 0.05, 3), 0.03))
    assert not few["equivalent"].any() and ((few["low"] < 0.03) & (few["high"] > -0.03)).all()


# --- Beds of the chart. --------------------------------------------------------------------------

def test_error_of_beds_against_the_reference():
    reference = {"rule": "spread", "stiffness": 10, "fraction": 0.18}
    common = {"lambda": 10, "method": "rods", "n": 0, "rule": "spread", "rested": 1, "divided_by": 1,
              "overlap_max": 0.01, "overlap_ever": 0.2, "end_time_s": 3, "command": "lmp",
              "version": "x", "machine": "y", "vf_whole": 0.3, "elevation_deg": 20.0, "contacts": 6}
    table = pandas.DataFrame(
        [{**common, "stiffness": 10.0, "time_step_over_limit": 0.18, "seed": s, "cpu_s": 30,
          "vf_inner": v} for s, v in enumerate((0.40, 0.42, 0.44))] +
        [{**common, "stiffness": 1.0, "time_step_over_limit": 0.36, "seed": s, "cpu_s": c,
          "vf_inner": v} for s, (v, c) in enumerate(((0.41, 5), (0.43, 7), (0.45, 6)))])
    charted = beds.charted(table, reference)
    inner = charted[charted["quantity"] == "inner"].iloc[0]
    assert len(charted) == 4
    assert (inner["cost"], inner["cost_min"], inner["cost_max"]) == (6, 5, 7)
    assert inner["error"] == pytest.approx(0.01 / 0.42)
    # Standard error of either mean: 0.02/√3.
    assert inner["error_high"] - inner["error"] == pytest.approx(0.02 * math.sqrt(2 / 3) / 0.42)
    assert inner["error_low"] == 0


# A straight line through the means hits the limit that the beds were made with.
def test_limits_of_stiff_contacts_and_many_spheres():
    reference = {"rule": "spread", "stiffness": 10, "fraction": 0.18}
    table = []
    for k, overlap in ((1.0, 6e-4), (10.0, 6e-5)):
        for seed, scatter in enumerate((-0.01, 0.0, 0.01)):
            table.append({"lambda": 10, "method": "rods", "n": 0, "rule": "spread", "stiffness": k,
                          "time_step_over_limit": 0.18, "divided_by": 1, "overlap_mean": overlap,
                          "seed": seed, "vf_inner": 0.44 + 20 * overlap + scatter})
    for n, divided in ((10, 1), (19, 2), (19, 1)):   # the last is not at the stiffness of a crossing
        for seed, scatter in enumerate((-0.02, 0.02)):
            table.append({"lambda": 10, "method": "multisphere", "n": n, "rule": "nominal",
                          "stiffness": 1.0, "time_step_over_limit": 0.36, "divided_by": divided,
                          "overlap_mean": 0.1, "seed": seed, "vf_inner":
                          0.45 + 0.1 * beds.groove(10, n) + scatter + (divided * n == 19)})
    others = {"vf_whole": 0.4, "elevation_deg": 20.0, "contacts": 6.0}   # without scatter: no limit
    lines = beds.limits(pandas.DataFrame(table).assign(**others), reference)
    cells = lines[0]
    assert [line[3][:5] for line in lines[1:]] in (['–'] * 3, ['0.400', '–', '–'])
    # All cases together: two of variance 0.01² and 2 degrees of freedom, three of 2·0.02² and 1, so that
    # beds scatter by 0.02. Errors of the limits by the arms of the line.
    stiff = math.hypot(10 / 9, 1 / 9) * 0.02 / math.sqrt(3)
    deep, shallow = beds.groove(10, 10), beds.groove(10, 19)
    smooth = 0.02 / math.sqrt(2) * math.hypot(deep, shallow) / (deep - shallow)
    assert cells[:2] == ["V_f, inner cylinder", "10"]
    assert cells[2] == f"0.441 ± {0.02 / math.sqrt(3):.3f}"
    assert cells[3] == f"0.440 ± {stiff:.3f}" and cells[5] == f"0.450 ± {smooth:.3f}"
    assert cells[7] == "2, 2"


# Against the decks' default, whose mean is 0.4; beds of all cases scatter by 0.004: Student's 95 % of 6 degrees
# of freedom is 1.943.
def test_which_settings_keep_the_bed():
    table = []
    for (stiffness, step), mean in (((1.0, 0.09), 0.40), ((1.0, 0.22), 0.402), ((0.1, 0.22), 0.42)):
        for seed, scatter in enumerate((-0.004, 0.0, 0.004)):
            table.append({"lambda": 10, "method": "rods", "n": 0, "rule": "spread",
                          "stiffness": stiffness, "time_step_over_limit": step, "divided_by": 1,
                          "seed": seed, **{q: mean + scatter for q in beds.QUANTITIES}})
    found = beds.kept(pandas.DataFrame(table)).set_index(["stiffness", "step", "quantity"])
    assert (found["lambda"] == 10).all()
    row = found.loc[(1.0, 0.22, "vf_inner")]
    width = 1.943 * 0.004 * math.sqrt(2 / 3) / 0.4
    assert (row["low"], row["high"]) == (pytest.approx(0.005 - width, abs=1e-5),
                                         pytest.approx(0.005 + width, abs=1e-5))
    assert row["kept"] and not found.loc[(0.1, 0.22, "vf_inner"), "kept"]
    assert beds.kept_lines(found.reset_index())[1][:5] == ["1", "0.22", "10", "3",
                                                           "**−1.1 to +2.1**"]
    # Without beds of the default there is nothing to be kept.
    assert beds.kept(pandas.DataFrame(table[3:])).empty


# A bed that ends in an error of LIGGGHTS is a row, and a line of its own on the page.
def test_a_bed_that_does_not_stand_is_a_row(tmp_path):
    def settle(folder):
        raise cases.DeckError("ERROR on proc 0: rods 1 and 2 overlap by 0.3, so that (a.cpp:80)",
                              "lmp -in in.fill", "in a folder")

    case = {"lambda": 10, "method": "rods", "n": 0, "rule": "spread", "stiffness": 0.1,
            "time_step_over_limit": 0.22, "divided_by": 1}
    beds.write_bed(tmp_path / "bed.csv", case, 10, 1000117, None, settle)
    runs = read_rows(tmp_path / "bed.csv")
    assert beds.standing(runs).empty
    assert beds.fallen_lines(runs) == [
        ["10", "rods, spread contact, stiffness × 0.1, step 0.22", "1 of 1",
         "rods 1 and 2 overlap by 0.3"]]


# --- Features. -----------------------------------------------------------------------------------

def test_features_of_a_scene_as_commands():
    bed = features.SCENES["bed"]
    text = features.commands(bed, {})
    assert "model linear tangential history surface spherocylinder\n" in text
    assert "cohesion" not in text and "limit/omega" not in text and "dump" not in text
    text = features.commands(bed, features.CHANGES["cohesion sjkr"])
    assert text.count("cohesion sjkr") == 3 and "cohesionEnergyDensity" in text
    text = features.commands(bed, features.CHANGES["all off by name"])
    assert "cohesion off rolling_friction off surface spherocylinder" in text
    text = features.commands(features.SCENES["spheres"], features.CHANGES["stock spheres in lmp"])
    assert "spherocylinder" not in text and "nve/sphere\n" in text


def test_changes_against_the_scene_as_it_is():
    counted = pandas.DataFrame([
        {"scene": "gas", "change": "as it is", "instructions": 100.0, "megabytes": 1.0},
        {"scene": "gas", "change": "cohesion sjkr", "instructions": 150.0, "megabytes": 1.5}]).assign(
            command="lmp -in in.cost -log log.memory", version="a", machine="one")
    timed = counted[["scene", "change", "version", "machine"]].assign(
        microseconds=2.0, microseconds_min=1.0, microseconds_max=3.0, times=1.0, turns=3,
        command="lmp -in in.cost -log log.time")
    for times in ([], [timed]):
        table = features.together([counted], times)
        assert list(table["instructions_times"]) == [1.0, 1.5]
        assert list(table["megabytes_more"]) == [0.0, 0.5]
    assert (table["command"] == "lmp -in in.cost -log log.memory && lmp -in in.cost -log log.time").all()
    assert (table["machine"] == "one").all() and "version" in table and len(table) == 2
    # Timed on another machine: told. Of another plug-in, of a scene or a timing: refused.
    table = features.together([counted], [timed.assign(machine="two")])
    assert (table["machine"] == "one, timed on two").all()
    for counts, times in (([counted, counted.assign(scene="bed", version="b")], [timed]),
                          ([counted], [timed.assign(version="b")])):
        with pytest.raises(cases.CaseError, match=r"of 2 versions of the plug-in \(a, b\): make all of them"):
            features.together(counts, times)


# --- Page. ---------------------------------------------------------------------------------------

def test_settings_of_the_decks():
    found = page.deck_settings()
    assert found["step_times"] == pytest.approx(2.5)
    assert found["default_time"] == 10 and found["quick_time"] == 3
    assert 0.21 < found["step_fraction"] < 0.23


def test_the_kept_page_is_that_of_the_kept_tables(kept_page_is_made_again):
    assert (STUDY / "README.md").exists()
    kept_page_is_made_again("minimal")


def test_templates_hold_no_measured_numbers():
    # Of the tests: a level of 5 %, intervals of 90 %.
    assert measured_numbers(STUDY / "README.md.j2") <= {"5", "90"}


def test_the_smallest_run(study, tmp_path):
    done = study("minimal", "smoke=1")
    assert done.returncode == 0, done.stdout
    results = tmp_path / "results"
    table = read_rows(results / "features.csv").set_index(["scene", "change"])
    # Names that switch off what is off anyway: only the commands are longer.
    assert table.loc[("gas", "all off by name"), "instructions_times"] == pytest.approx(1, abs=1e-3)
    assert table.loc[("gas", "all off by name"), "megabytes_more"] == 0
    assert (table["microseconds"] > 0).all()
    typed = table.loc[("gas", "as it is"), "command"].split(" && ")
    assert [re.search(r"-log (\S+)", part).group(1) for part in typed] == \
        ["log.start", "log.memory", "log.callgrind", "log.time"]
    assert typed[2].startswith("valgrind --tool=callgrind --callgrind-out-file=callgrind.out ")
    runs = read_rows(results / "fresh_beds.csv")
    assert list(runs["way"]) == ["quick", "quick", "today", "today"]
    assert (runs["rested"] == 1).all() and (runs["version"].nunique() == 1)
    seconds = read_rows(results / "seconds.csv")
    seconds = seconds.set_index("way")
    assert seconds.loc["full", "command"].count("lmp -in in.rest ") == 2
    assert seconds.loc["quick", "end_time_s"] <= 3 < 10 and (seconds["rested"] == 1).all()
    assert (table.loc["spheres", "contacts"].dropna() >= 0).all()
    assert "A settled bed in fewer seconds" in (results / "README.md").read_text()


def test_a_bed_that_fails_says_why(tmp_path, programs):
    with pytest.raises(cases.CaseError, match="limits must be study or none"):
        settling.settle_rods(tmp_path, 5, 1000003, limits="some", build=programs)
