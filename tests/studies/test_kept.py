# SPDX-License-Identifier: GPL-2.0-or-later
"""What the repository keeps of the studies: tables that are there, whole commands, numbers of the main page and
of the templates, points of the figures."""
import re

import numpy as np
import pytest

from conftest import ROOT, measured_numbers
from studies.common import plots
from studies.common.rows import PROVENANCE, read_rows
from studies.minimal import figures
from studies.speed_accuracy import chart

RESULTS = {name: ROOT / "studies" / name / "results" for name in (
    "packing", "minimal", "speed_accuracy", "experiments")}
SCENES = RESULTS["speed_accuracy"] / "scenes.csv"


@pytest.mark.parametrize("name, tables", [
    ("packing", ["beds", "elevation", "settings"]),
    ("minimal", ["fresh_beds", "equivalence", "seconds", "features"]),
    ("speed_accuracy", ["scenes", "bed_runs", "beds", "summary"]),
    ("experiments", ["contacts", "wall", "collapse", "standing", "capsules", "shear"])])
def test_results_are_kept(name, tables):
    for table in tables:
        rows = read_rows(RESULTS[name] / f"{table}.csv")
        assert len(rows)
        if table not in ("elevation", "settings", "equivalence", "summary"):   # made of rows of the others
            assert not rows[list(PROVENANCE)].isna().any().any(), table


# Of the whole sweep, not of the program that runs it alone.
def test_commands_of_kept_rows_are_whole():
    rows = read_rows(SCENES)
    for option in ("--stiffnesses", "--fractions", "--most-work", "--seed", "--work", "--out"):
        assert rows["command"].str.contains(f" {option} ").all()
    assert (rows["command"].str.contains(" && .*sweep.py time .* --turns ") == (rows["turns"] > 1)).all()
    beds = read_rows(RESULTS["speed_accuracy"] / "bed_runs.csv")
    glued = beds.loc[beds["method"] == "multisphere", "command"]
    assert glued.str.contains(" && rods_to_multisphere .* && liggghts ").all()
    seconds = read_rows(RESULTS["minimal"] / "seconds.csv")
    counted = seconds[(seconds["way"] == "full") & (seconds["rested"] == 1)]
    assert len(counted) and (counted["command"].str.count("in.rest ") == 2).all()


NUMBERS = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven",
           "twelve", "thirteen", "fourteen"]


# "Error against cost in twelve scenes with a known outcome"
def test_scenes_of_the_main_page():
    text = " ".join((ROOT / "README.md").read_text().split())
    word = re.search(r"!\[Error against cost in (\w+) scenes with a known outcome", text).group(1)
    assert NUMBERS.index(word) == read_rows(SCENES)["scene"].nunique()


# "With the study's limits on top it is 16, 32 and 47 % below; with these limits and no friction 2 % above, ..."
def test_packings_of_the_main_page():
    text = " ".join((ROOT / "README.md").read_text().split())
    beds = read_rows(RESULTS["packing"] / "beds.csv")
    away = 100 * (beds["vf_inner"] / beds["vf_theory"] - 1)
    mean = away.groupby([beds["limits"], beds["friction"], beds["lambda"]]).mean()
    a, b, c = (f"{-mean['study', 0.2, aspect]:.0f}" for aspect in (10, 20, 30))
    assert f"With the study's limits on top it is {a}, {b} and {c} % below" in text
    a, b, c = (mean["study", 0, aspect] for aspect in (10, 20, 30))
    assert a > 0 > max(b, c)
    assert f"no friction {a:.0f} % above, {-b:.0f} and {-c:.0f} % below" in text


# "without any, V_f lies 19 to 26 % above 2 ln λ/λ, without any between rods alone 9 to 22 % above, ..."
def test_friction_of_the_main_page():
    text = " ".join((ROOT / "README.md").read_text().split())
    beds = read_rows(ROOT / "studies/sensitivity/results/beds.csv")
    away = 100 * (beds["vf_inner"] / beds["vf_parkhouse_kelly"] - 1)
    mean = away.groupby([beds["factor"], beds["level"].astype(str), beds["lambda"]]).mean()
    both, rods = mean["friction", "0"], mean["friction_of_rods", "0"]
    assert f"without any, V_f lies {both.min():.0f} to {both.max():.0f} % above" in text
    assert f"between rods alone {rods.min():.0f} to {rods.max():.0f} % above" in text


# What they hold themselves: intervals of 95 and 90 %, a gas of 5 %, e = 0.5, errors of 100 % and of the
# questions asked, a diameter of 0.01 m, the decks' step of 0.09.
@pytest.mark.parametrize("name, allowed", [
    ("README.md.j2", {"95", "5", "0.5", "100", "0.01"}), ("beds.md.j2", {"3", "90", "0.09"})])
def test_templates_hold_no_measured_numbers(name, allowed):
    assert measured_numbers(ROOT / "studies/speed_accuracy" / name) <= allowed


@pytest.fixture
def drawn(monkeypatch):
    """drawn(draw, *arguments): the panels of the figure that draw saves."""
    def panels(draw, *arguments):
        kept = []
        with monkeypatch.context() as patch:
            patch.setattr(plots, "save", lambda figure, stem: kept.append(figure))
            draw(*arguments, "nowhere")
        return kept[0].axes

    return panels


def points_of(panel):
    """All that is drawn as a point or a corner of a line, in the units of the axes."""
    lines = [line.get_xydata() for line in panel.lines]
    dots = [np.asarray(found.get_offsets()) for found in panel.collections
            if found.get_offset_transform() == panel.transData]
    return np.vstack([part for part in lines + dots if len(part)])


def holds(points, x, y):
    return np.isclose(points, [x, y], rtol=1e-9, atol=1e-12).all(axis=1).any()


def test_points_of_a_chart(drawn):
    rows = read_rows(SCENES)
    wall = rows[(rows["scene"] == "wall") & (rows["quantity"] == "impulse")]
    panels = drawn(chart.chart, wall, "wall", "impulse")
    shown = wall[wall["error"].between(chart.lowest_of(wall), 1, inclusive="left")]
    for panel, aspect in zip(panels, sorted(wall["lambda"].unique())):
        here, points = shown[shown["lambda"] == aspect], points_of(panel)
        assert len(here) > 20
        for row in here.itertuples():
            assert holds(points, row.cost, row.error), row
        assert panel.get_xscale() == panel.get_yscale() == "log"


def test_points_of_the_features(drawn):
    rows = read_rows(RESULTS["minimal"] / "features.csv")
    panels = drawn(figures.features, rows)
    for panel, scene in zip(panels, dict.fromkeys(rows["scene"])):
        here, points = rows[rows["scene"] == scene], points_of(panel)
        assert [text.get_text() for text in panel.get_yticklabels()] == list(here["change"])
        for place, row in zip(panel.get_yticks(), here.itertuples()):
            assert holds(points, row.instructions_times, place), row
            if "times" in rows:
                assert holds(points, row.times, place), row


def test_points_of_the_equivalence(drawn):
    rows = read_rows(RESULTS["minimal"] / "equivalence.csv")
    points = np.vstack([points_of(panel) for panel in drawn(figures.equivalence, rows)])
    for row in rows.itertuples():
        assert np.isclose(points[:, 0], 100 * row.difference, rtol=1e-9).any(), row
