# SPDX-License-Identifier: GPL-2.0-or-later
"""examples/fibres: cases, work of cycles, figure and page, and its smallest run from end to end."""
import math
import re

import numpy
import pandas
import pytest
import yaml

from conftest import ROOT, measured_numbers
from examples.fibres import beds, page
from studies.common import cases, settling
from studies.common.rows import PROVENANCE, read_rows

STUDY = ROOT / "examples/fibres"
CONFIG = yaml.safe_load((STUDY / "config.yaml").read_text())


def test_variables_of_the_decks():
    told = CONFIG["beds"][30]
    soft = beds.variables_of(30, "0.01", 8, 7, told, 0.2, True)
    rods = beds.variables_of(30, beds.RIGID, 8, 7, told, 0.2, True)
    assert soft == rods | {"segments": 8, "bending": "0.01"}
    # The highest have landed.
    assert float(soft["fill_time"]) > math.sqrt(2 * told["height"] / settling.GRAVITY)
    known = set(re.findall(r"\bvariable (\w+) +index", settling.DECKS[0].read_text()))
    assert set(soft) <= known
    assert math.isinf(beds.level(beds.RIGID)) and beds.level("0.01") == 0.01


# A bed that pushes by 5 N/m of depth below 1 m on the way down, and by 3 N/m on the way up: between 1 m and 0.8 m
# 5/2 0.2^2 J are done and 3/2 0.2^2 J come back; by yielding 0.01 J a cycle.
def test_work_of_cycles():
    ways = 3 * (list(numpy.linspace(1.0, 0.8, 201)[:-1]) + list(numpy.linspace(0.8, 1.0, 201)[:-1])) + [1.0]
    height = numpy.array([1.1, 1.05] + ways)
    upwards = numpy.append(numpy.diff(height) > 0, True)
    upwards[numpy.isclose(height, 0.8)] = False
    force = numpy.where(upwards, 3.0, 5.0) * numpy.clip(1.0 - height, 0.0, None)
    loop = pandas.DataFrame({"height_m": height, "force_N": force, "joints_J": 0.0,
                             "yielded_J": numpy.linspace(0.0, 0.03, len(height))})
    found = beds.cycles_of(loop, 3)
    assert list(found["cycle"]) == [1, 2, 3]
    assert found["work_J"].to_numpy() == pytest.approx(0.1, rel=1e-3)
    assert found["returned_J"].to_numpy() == pytest.approx(0.06, rel=1e-2)   # the corner at the lower end
    assert found["lost_part"].to_numpy() == pytest.approx(0.4, abs=0.01)
    assert found["force_max_N"].to_numpy() == pytest.approx(1.0)
    assert found["height_low_m"].to_numpy() == pytest.approx(0.8)
    # A tenth of 1 N: 0.02 m below.
    assert found["height_touched_m"].to_numpy() == pytest.approx(0.98, abs=0.0021)
    assert found["yielded_J"].sum() == pytest.approx(0.03)
    with pytest.raises(cases.CaseError, match=r"turned 3 times at the lower end \(wanted 2\)"):
        beds.cycles_of(loop, 2)


# Means 1 and 1.1, each of variance 0.01 over 2: 0.1 ± t (2 freedoms: 4.303) 0.1.
def test_difference_from_rods():
    spread = 0.1 / math.sqrt(2.0)
    part = pandas.DataFrame([{"bending": bending, "vf_inner": mean + side * spread}
                             for bending, mean in ((math.inf, 1.0), (10.0, 1.1), (0.1, 7.0)) for side in (-1, 1)])
    mean, wide = page.difference(part, "vf_inner")
    assert mean == pytest.approx(0.1) and wide == pytest.approx(4.302653 * 0.1, rel=1e-5)


def test_templates_hold_no_measured_numbers():
    for template in STUDY.glob("*.j2"):
        # Of the intervals, of an isotropic bed, defaults of the press.
        assert measured_numbers(template) <= {"95", "32.7", "0.2", "0.25", "0.4"}, template


def test_the_kept_page_is_that_of_the_kept_tables(kept_page_is_made_again):
    kept_page_is_made_again("examples/fibres")


def test_kept_results_are_small():
    for path in (STUDY / "results").glob("*"):
        assert path.stat().st_size < (300_000 if path.suffix in (".png", ".svg") else 200_000), path


def test_the_smallest_run(study, tmp_path):
    done = study("examples/fibres", "smoke=1")
    assert done.returncode == 0, done.stdout
    results = tmp_path / "results"
    found = beds.read_beds(results / "beds.csv")
    assert len(found) == 3 * 2 and found["rested"].isin([0, 1]).all()
    for column in PROVENANCE:
        assert column in found and found[column].notna().all()
    assert set(found["segments"]) == {1, 4}
    rods, soft = found[numpy.isinf(found["bending"])], found[found["bending"] == 0.01]
    assert (rods["curvature"] == 0).all() and (soft["curvature"] > 0.1).all()
    assert (soft["stretch"] < 1).all() and (soft["contacts"] > 0).all()
    # What was lost in a cycle is the work less what came back; elastic joints take nothing for good.
    cycles = read_rows(results / "cycles.csv")
    assert len(cycles) == 2 * 2 * 2
    assert cycles["lost_J"].to_numpy() == pytest.approx((cycles["work_J"] - cycles["returned_J"]).to_numpy())
    assert (cycles["work_J"] > 0).all() and (cycles["lost_part"] < 1).all()
    assert (cycles.loc[cycles["yield_curvature"] == 0, "yielded_J"] == 0).all()
    first = cycles[(cycles["yield_curvature"] > 0) & (cycles["cycle"] == 1)]
    assert (first["yielded_J"] > 0).all()
    assert list(read_rows(results / "slower.csv")["cycle"]) == [1, 2]
    assert "This is the smoke version" in (results / "README.md").read_text()
    assert (results / "fibres.png").exists()


@pytest.mark.parametrize("wrong, words", [
    ({"strain": 1}, "strain must be > 0 and < 1 (got 1)"), ({"cycles": 0}, "cycles must be >= 1 (got 0)"),
    ({"speed": 0}, "speed and approach must be > 0 (got 0 and 0.4)"),
    ({"yield_curvature": -1}, "yield_curvature must be >= 0 and samples >= 1 (got -1 and 60)"),
    ({"segments": 1}, "segments must be >= 2, a bed of fibres (got 1)")])
def test_wrong_presses_are_refused(programs, tmp_path, wrong, words):
    cases.link_decks(tmp_path, [*settling.DECKS, *beds.PRESS])
    (tmp_path / "in.case").write_text("variable segments index 4\n")
    with pytest.raises(cases.DeckError) as refused:
        cases.run_deck(tmp_path, "in.press", wrong, build=programs)
    assert refused.value.reason == f"ERROR: in.press: {words}"


@pytest.mark.parametrize("setting, words", [
    ("lambdas=[40]", "lambdas must be among 30, 100, the beds that are told (got 40)"),
    ("there=1", "there=1 finds no beds"),
    ("seeds=1", "seeds must be a whole number from 2 to 5 (got 1)")])
def test_wrong_settings_are_refused(study, setting, words):
    done = study("examples/fibres", setting, cores=1)
    assert done.returncode != 0 and words in done.stdout, done.stdout
