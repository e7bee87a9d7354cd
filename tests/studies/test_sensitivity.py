# SPDX-License-Identifier: GPL-2.0-or-later
"""studies/sensitivity: its cases, differences and figures, and its smallest run from end to end."""
import math
import re

import numpy
import pandas
import pytest
import yaml

from conftest import ROOT, measured_numbers
from studies.common import settling
from studies.common.rows import PROVENANCE, read_rows
from studies.sensitivity import figures, page, variations

STUDY = ROOT / "studies/sensitivity"
CONFIG = yaml.safe_load((STUDY / "config.yaml").read_text())


# --- Cases. --------------------------------------------------------------------------------------

def test_cases_of_the_kept_config():
    found = variations.cases_of(CONFIG["factors"], [])
    names = [(case.factor, case.level) for case in found]
    assert names[0] == ("base", "base") and len(set(names)) == len(names)
    by = {(case.factor, case.level): case for case in found}
    assert by["friction_of_rods", "0"].given == {"friction": 0, "friction_wall": 0.2}
    assert by["friction_with_limits", "0.4"].against == "0.2"
    assert by["softened", "0.003"].value == 0.003 and math.isnan(by["pour", "gentle"].value)
    assert len(variations.cases_of(CONFIG["factors"], ["pour"])) == 2


@pytest.mark.parametrize("factors, only, words", [
    ({"a": {"variable": "friction", "values": [0]}}, ["b"], r"only must be among a \(got b\)"),
    ({"a": {"variable": "fiction", "values": [0]}}, [], "a: fiction is no variable of input/in.rods"),
    ({"a": {"variable": "friction"}}, [], "a must have either levels or values"),
    ({"a": {"levels": {"x/y": {}}}}, [], r"named by letters, digits, _ and . \(got x/y\)"),
    ({"a": {"variable": "friction", "values": [0], "against": 1}}, [], "a has no level 1 to be")])
def test_wrong_cases_are_refused(factors, only, words):
    with pytest.raises(ValueError, match=words):
        variations.cases_of(factors, only)


def test_variables_of_the_decks():
    def given(quick=True, **more):
        return variations.deck_variables(20, 7, {"friction": 0.2, **more}, quick, 10)
    plain = given()
    assert plain["vessel_diameter"] == "0.41" and plain["rods"] == 700 and "dt" not in plain
    assert plain["limit_fill"] == plain["limit_settle"] == 0
    assert "limit_fill" not in given(limits="study")
    # As many rods over the floor's area.
    assert float(given(vessel_times=2)["vessel_diameter"]) == pytest.approx(0.82)
    assert given(vessel_times=2)["rods"] == 2800 and given(rods_times=0.5)["rods"] == 350
    # The step over √(m/k) stays that of the decks.
    for quick, step in ((True, 5e-5), (False, 2e-5)):
        softer = given(quick, stiffness_times=0.01)
        assert float(softer["stiffness"]) == 0.01 * settling.STIFFNESS
        assert float(softer["dt"]) == pytest.approx(10 * step)
    assert re.search(r"variable dt +index 2.0e-5", settling.DECKS[0].read_text())
    assert '"variable dt index 5.0e-5"' in settling.DECKS[0].read_text()
    assert given(softened_times=0.1) == plain   # poured as the base case
    # The highest rods have landed: √(2 · 20/9.81) = 2.02 s.
    assert float(given(vessel_height=20)["fill_time"]) > 2.02
    assert "taps" not in given(taps=3)
    assert given(gentle=1, rods=33)["rods"] == 30


# --- Differences. --------------------------------------------------------------------------------

def beds_of(*kinds, count=4, scatter=0.01):
    """Beds of (factor, level, against, times), V_f about 1/λ times that."""
    random = numpy.random.default_rng(3)
    return pandas.DataFrame([
        {"factor": factor, "level": level, "value": math.nan, "against": against,
         "lambda": aspect, "seed": seed,
         **{name: times / aspect * (1 + scatter * random.normal())
            for name in variations.QUANTITIES}}
        for factor, level, against, times in kinds for aspect in (10.0, 20.0)
        for seed in range(count)])


def test_differences_from_the_base_case():
    table = variations.effects(beds_of(
        ("base", "base", "", 1.0), ("x", "more", "", 1.2), ("x", "same", "", 1.0),
        ("limited", "0.2", "0.2", 0.5), ("limited", "0", "0.2", 0.6)), 0.03)
    by = table.set_index(["factor", "level", "quantity", "lambda"])
    assert set(table["lambda"]) == {0, 10, 20}
    together = by.loc["x", "more", "vf_inner", 0.0]
    assert together["difference"] == pytest.approx(0.2, abs=0.02) and together["differs"] == 1
    assert together["low"] < 0.2 < together["high"] and together["beds"] == 8
    same = by.loc["x", "same", "vf_inner", 0.0]
    assert same["differs"] == 0 and same["alike"] == 1
    # Against its own level 0.2, which is compared with none.
    assert by.loc["limited", "0", "vf_inner", 0.0]["difference"] == pytest.approx(0.2, abs=0.02)
    assert ("limited", "0.2") not in set(zip(table["factor"], table["level"]))


# Two samples (a), (b): the relative difference b/a - 1 has the variance (s_b² + (b/a)² s_a²)/(n a²),
# and with equal parts of it Welch's 2 (n - 1) degrees of freedom.
def test_the_interval_is_that_of_welch():
    a, b = [0.98, 1.00, 1.02], [0.98, 1.00, 1.02]
    table = pandas.DataFrame([
        {"factor": factor, "level": factor, "value": math.nan, "against": "", "lambda": 10.0,
         "seed": i, **{name: v for name in variations.QUANTITIES}}
        for factor, values in (("base", a), ("x", b)) for i, v in enumerate(values)])
    row = variations.effects(table, 0.03).iloc[0]
    width = 2.776445 * math.sqrt(2 * 0.02 ** 2 / 3)   # Student's t of 97.5 % for 4
    assert row["difference"] == pytest.approx(0) and row["high"] == pytest.approx(width, rel=1e-6)


# A single bed has no scatter: nothing is told of it.
def test_single_beds_are_left_out():
    single = beds_of(("base", "base", "", 1.0), ("x", "more", "", 2.0), count=1)
    table = variations.effects(single, 0.03)
    assert len(table) == 0 and "difference" in table


# By hand for λ = 20, z = 10.5, s = π/4: V_p = 19/4 + 1/6, V_ex = 361/2 + 38 + 4/3.
def test_random_contacts():
    bed = pandas.DataFrame([{"lambda": 20.0, "contacts": 10.5, "mean_sin_gamma": math.pi / 4}])
    assert variations.expected(bed).iloc[0] == pytest.approx(0.2348370, abs=1e-6)


# V_f = 0.3 - 0.1/width at each width.
def test_vessel_without_end():
    beds = pandas.DataFrame([
        {"factor": "vessel", "lambda": 10.0, "lengths_wide": wide,
         "vf_inner": 0.3 - 0.1 / wide + shift, "vf_bulk": math.nan} for wide in (1.5, 2.0, 4.0) for shift in (-0.01, 0.01)])
    line, = page.bulk(beds)
    assert line[:2] == ["10", "3"] and line[2].startswith("0.3000 ±")
    assert line[3] == "0.0" and line[6] == "–"


# --- Figures and page. ---------------------------------------------------------------------------

def test_the_base_case_is_a_point_of_each_series():
    beds = beds_of(("base", "base", "", 1.0), ("friction", "0", "", 1.2))
    beds = beds.assign(vf_parkhouse_kelly=0.1)
    beds.loc[beds["factor"] == "friction", "value"] = 0.0
    points = figures.mean_points(figures.with_base(beds[beds["lambda"] == 10], "friction"), "value")
    assert [x for x, *_ in points] == [0.0, 0.2]
    assert points[0][1] == pytest.approx(1.2, rel=0.03) and points[1][1] == pytest.approx(1, rel=0.03)
    # The decks' own values of what the base case does not set.
    text = settling.DECKS[0].read_text()
    for variable, factor in (("restitution", "restitution"), ("vessel_height", "drop_height"),
                             ("friction", "friction")):
        default = re.search(rf"^variable {variable} +index (\S+)", text, re.MULTILINE).group(1)
        assert float(default) == figures.BASE_VALUES[factor]


def test_templates_hold_no_measured_numbers():
    # Of the intervals, and settings of the decks: friction, restitution, lengths of a spread.
    assert measured_numbers(STUDY / "README.md.j2") <= {"95", "0.2", "0.5", "0.7", "1.3"}


def test_the_kept_page_is_that_of_the_kept_tables(kept_page_is_made_again):
    kept_page_is_made_again("sensitivity")


def test_the_smallest_run(study, tmp_path):
    done = study("sensitivity", "smoke=1")
    assert done.returncode == 0, done.stdout
    results = tmp_path / "results"
    beds = variations.read_beds(results / "beds.csv").set_index(["factor", "level", "seed"])
    assert len(beds) == 5 * 2 and beds.index.is_unique
    for column in PROVENANCE:
        assert column in beds.reset_index() and beds.reset_index()[column].notna().all()
    seed = beds.index[0][2]
    base, soft, tapped, wide = (beds.loc[key + (seed,)] for key in (
        ("base", "base"), ("softened", "0.1"), ("taps", "1"), ("vessel", "1.5")))
    # Overlaps of a bed at rest are its weight over the stiffness.
    assert 3 < soft["overlap_mean"] / base["overlap_mean"] < 30
    fill, settle = soft["command"].split(" && ")
    assert "-var stiffness 2000" in settle and "stiffness" not in fill
    assert "in.tap" in tapped["command"] and tapped["steps"] > base["steps"]
    assert wide["lengths_wide"] == pytest.approx(1.5 * base["lengths_wide"])
    assert wide["rods"] == round(30 * 1.5 ** 2)
    walls = read_rows(results / "walls.csv")
    assert set(walls["factor"]) == {"base", "vessel"} and (walls["region_m3"] > 0).all()
    # All solid is in some bin: V_f times its volume adds up to the rods'.
    own = walls[(walls["factor"] == "base") & (walls["seed"] == seed)]
    rods = 30 * settling.mass_of(5) / settling.DENSITY
    assert (own["vf"] * own["region_m3"]).sum() == pytest.approx(rods, rel=0.2)

    effects = variations.read_effects(results / "effects.csv")
    text = (results / "README.md").read_text()
    assert "This is the smoke version" in text
    for _, row in effects[(effects["quantity"] == "vf_inner") & (effects["lambda"] == 0)].iterrows():
        assert f"{100 * row['difference']:+.1f} %".replace("-", "−") in text, row
    for name in figures.DRAWN:
        assert (results / f"{name}.png").exists()


@pytest.mark.parametrize("setting, words", [
    ("seeds=1", "sensitivity: seeds must be a whole number from 2 to 8 (got 1)"),
    ("only=[fiction]", "sensitivity: only must be among friction, "),
    ("there=1", "there=1 finds no bed")])
def test_wrong_settings_are_refused(study, setting, words):
    done = study("sensitivity", setting, cores=1)
    assert done.returncode != 0 and words in done.stdout, done.stdout
