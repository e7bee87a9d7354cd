# SPDX-License-Identifier: GPL-2.0-or-later
"""studies/stability: its closed forms, the states of beds, each provoked, and the smallest run."""
import math
from dataclasses import replace

import numpy as np
import pandas
import pytest

from conftest import ROOT, measured_numbers
from studies.common import cases, settling
from studies.common.rows import read_rows
from studies.speed_accuracy.rods import damping_ratio
from studies.stability import bed, figures, maps, page, states, theory

STUDY = ROOT / "studies/stability"


# --- Closed forms. ------------------------------------------------------------------------------

# 1/m_eff = 2 (1/m + a²/I_t): a thin rod with its arm L/2 and I_t = m L²/12 gives m/8, a sphere m/2.
def test_lightest_contact():
    assert theory.over_thin(1.0) == pytest.approx(2.0)
    assert theory.over_thin(1e4) == pytest.approx(1.0, rel=1e-4)
    doubled = 2 * damping_ratio(0.5)
    assert theory.damping_at_ends(1e4, 0.5, False) == pytest.approx(doubled, rel=1e-3)
    assert theory.damping_at_ends(1.0, 0.5, False) == pytest.approx(damping_ratio(0.5))


# The roots of the scheme's matrix, worked out as numbers.
@pytest.mark.parametrize("beta", [0.0, 0.1, 0.2155, 0.6])
def test_stable_limit_is_where_a_root_leaves_the_unit_circle(beta):
    def largest(h):
        c = 1 - 2 * beta * h
        return np.abs(np.linalg.eigvals([[c, -h], [h * c, 1 - h * h]])).max()
    h = 2 * theory.stable_limit(beta)
    assert largest(h * 0.999) <= 1 + 1e-12
    assert largest(h * 1.001) > 1


# Least step at which any of 4001 phases gains energy, by the recursion; with damping no hit of more
# steps does before.
@pytest.mark.parametrize("beta", [0.1, 0.2155, 0.6])
def test_gain_onset_is_where_the_first_hit_gains(beta):
    h, phases = 2 * theory.gain_onset(beta), np.linspace(0, 1, 4001)
    assert np.nanmax(theory.restitution_of_hit(h * 1.001, beta, phases)) > 1
    # Over all smaller steps: hits of two and more steps may come first where damping is weak.
    if beta > 0.2:
        for part in np.linspace(0.3, 0.999, 50):
            assert np.nanmax(theory.restitution_of_hit(h * part, beta, phases)) <= 1


# Small steps: e, and the largest overlap, of the damped oscillator, worked out step by step.
def test_hits_of_small_steps():
    beta, h = damping_ratio(0.5), 1e-4
    v, x, most = 1.0, 0.0, 0.0
    while x >= 0:
        v, x = v - h * (x + 2 * beta * v), x + h * (v - h * (x + 2 * beta * v))
        most = max(most, x)
    assert -v == pytest.approx(0.5, rel=1e-3)
    assert theory.restitution_of_hit(1e-3, beta, 0.5) == pytest.approx(0.5, rel=2e-3)
    assert theory.largest_overlap(1.0, 1.0, 1.0, beta) == pytest.approx(most, rel=1e-3)


# --- States. ------------------------------------------------------------------------------------

ASPECT, RODS = 10.0, 5
SCALE = settling.mass_of(ASPECT) * settling.GRAVITY * settling.DIAMETER * RODS


def series(kinetic, height, force=0.0, torque=0.0):
    """Of numbers over m g D a rod, and D."""
    time = np.linspace(0, 2, len(kinetic))
    return pandas.DataFrame({"time": time, "moving": np.asarray(kinetic) * SCALE, "turning": 0.0,
                             "height": np.asarray(height) * settling.DIAMETER,
                             "force": force, "torque": torque})


def state(table, rested=False, failure=None, passed=0, **others):
    return states.state_of(table, ASPECT, RODS, 0.5, rested, failure, passed, **others)


def test_states_of_series():
    quiet = np.full(200, 1e-9)
    falling = np.concatenate([np.linspace(100, 2, 50), np.full(150, 2.0)])
    assert state(series(quiet, falling), rested=True) == "rests"
    assert state(series(np.full(200, 1e-2), falling, 1e-3)) == "rests"      # rods that roll
    assert state(series(np.full(200, 1e-2), falling, 1e-3, 0.3)) == "moves"  # a rod that lies down
    assert state(series(quiet, falling, 3.0)) == "jitters"
    assert state(series(np.full(200, 1e-2), falling, 0.5)) == "jitters"
    assert state(series(np.full(200, 1e-2), falling, 0.5), braked=True) == "moves"
    # A rod that still bounces: in the air, and its energy falls.
    assert state(series(np.exp(-10 * np.linspace(0, 2, 200)), falling, 1.0)) == "moves"
    rising = np.concatenate([np.full(100, 0.1), np.linspace(0.1, 3.0, 100)])
    assert state(series(rising, falling), rested=True) == "grows"
    assert state(series(quiet, falling), rested=True, passed=1) == "passes"
    assert state(series(quiet, falling), failure="ERROR: Lost atoms: original 40") == "lost"
    assert state(series(np.full(200, math.nan), falling)) == "lost"
    with pytest.raises(ValueError, match="no state of a bed"):
        state(series(quiet, falling), failure="ERROR: Illegal fix command")


# --- Rods that pass each other. -----------------------------------------------------------------

def moved(places, axes):
    """(frames, 2, 3) of a rod that stays along x at the origin, and another."""
    n = len(places)
    still = np.zeros((n, 1, 3)), np.tile([1.0, 0, 0], (n, 1, 1))
    return (np.concatenate([still[0], np.asarray(places, float)[:, None]], axis=1),
            np.concatenate([still[1], np.asarray(axes, float)[:, None]], axis=1))


def test_passages():
    along_y, height = [0.0, 1.0, 0.0], 0.09
    down = [(0.01, 0.01, z) for z in (0.013, 0.007, 0.002, -0.004, -0.012)]
    assert states.passages(*moved(down, [along_y] * 5), height) == {(0, 1): 1}
    back = down[:4] + [(0.01, 0.01, z) for z in (0.003, 0.009)]
    assert states.passages(*moved(back, [along_y] * 6), height) == {(0, 1): 2}
    assert states.passed(*moved(back, [along_y] * 6), height) == 0
    # Beyond the end of the first rod, and beyond that of the second.
    beside = [(0.06, 0.01, z) for _, _, z in down]
    assert states.passages(*moved(beside, [along_y] * 5), height) == {}
    beside = [(0.01, 0.06, z) for _, _, z in down]
    assert states.passages(*moved(beside, [along_y] * 5), height) == {}
    # Past parallel, side by side.
    turns = [(math.cos(a), math.sin(a), 0.0) for a in (-0.2, -0.05, 0.05, 0.2)]
    assert states.passages(*moved([(0, 0, 0.01)] * 4, turns), height) == {}


def test_side_is_the_triple_product():
    rng = np.random.default_rng(3)
    centre, axis = rng.normal(size=(1, 4, 3)), rng.normal(size=(1, 4, 3))
    s = states.side(centre, axis)[0]
    for i in range(4):
        for j in range(4):
            expected = (centre[0, j] - centre[0, i]) @ np.cross(axis[0, i], axis[0, j])
            assert s[i, j] == pytest.approx(expected, abs=1e-12)


# --- Methods and points. ------------------------------------------------------------------------

def test_methods_by_name():
    assert bed.method_of("ours") == ((), "none")
    assert bed.method_of("ours-mass-search@4pi") == (("mass", "search"), "4pi")
    assert bed.method_of("plain+mass") == (("rotation", "search", "single"), "none")
    assert bed.method_of("plain")[0] == tuple(sorted(bed.PLAIN))
    for wrong in ("theirs", "ours-colour", "ours@9pi"):
        with pytest.raises(cases.CaseError, match="method"):
            bed.method_of(wrong)


def test_words_of_the_deck():
    words = bed.variables(bed.Point(without=("mass", "rotation", "search", "single", "memory")))
    assert words["keywords"] == "effective_mass off"
    assert words["pair_keywords"] == "sudden_overlap on search five_step spread_contact off"
    assert (words["rotation"], words["tangential"]) == ("rotation plain", "no_history")
    ours = bed.variables(bed.Point())
    assert (ours["keywords"], ours["rotation"], ours["limit_fill"]) == ("", "", "0")
    study = bed.variables(bed.Point(limit="study"))
    assert float(study["limit_fill"]) == pytest.approx(4 * math.pi)
    assert float(study["limit_settle"]) == pytest.approx(0.2 * math.pi)
    assert 0 < study["fill_steps"] < study["steps"] and ours["fill_steps"] == ours["steps"]


def test_jobs_of_a_map():
    assert maps.jobs("steps", {"lambdas": [1, 10], "methods": ["ours", "plain"]}) == [
        "steps/ours_1_s86028121", "steps/ours_10_s86028121", "steps/plain_1_s86028121",
        "steps/plain_10_s86028121"]
    assert [maps.spheres_of(10, kind) for kind in (0, 1, 2)] == [0, 10, 19]
    with pytest.raises(cases.CaseError, match="may have"):
        maps.jobs("steps", {"lambda": [1]})
    with pytest.raises(cases.CaseError, match="fractions of steps must be numbers"):
        maps.jobs("steps", {"lambdas": [1], "fractions": ["small"]})


# --- States provoked in beds. -------------------------------------------------------------------

SMALL = bed.Point(aspect=10, fraction=0.36, rods=20, drop=1.0)


@pytest.mark.parametrize("point, expected", [
    (SMALL, {"rests"}),
    (replace(SMALL, limit="0.2pi", aspect=20, time=1.0), {"moves"}),
    (replace(SMALL, fraction=0.72), {"jitters"}),
    (replace(SMALL, fraction=1.08), {"grows", "lost"}),
    (replace(SMALL, stiffness=0.001, aspect=3), {"lost"}),
])
def test_states_are_provoked(tmp_path, programs, point, expected):
    row = bed.run(tmp_path / "bed", point, programs)
    assert row["state"] in expected, row
    assert (row["state"] != "lost") == (row["ended_by"] == "")


# No side remembered, and a spring so soft that some rods go through each other in one of these
# beds, and not through the floor.
def test_rods_that_pass_are_found(tmp_path, programs):
    soft = replace(SMALL, fraction=0.18, stiffness=0.01, rods=40, drop=2.5, without=("memory",))
    rows = [bed.run(tmp_path / "bed", replace(soft, seed=seed), programs)
            for seed in (86028121, 67867967, 49979687)]
    assert any(row["state"] == "passes" and row["passed_pairs"] > 0 for row in rows), rows
    assert all(row["overlap_ever"] > 0.7 for row in rows)


def test_a_deck_that_is_wrong_is_no_state(tmp_path, programs):
    with pytest.raises(cases.CaseError, match="friction|Friction"):
        bed.run(tmp_path / "bed", replace(SMALL, friction=-1.0), programs)


def test_glued_rods_start_from_the_same_poses(tmp_path, programs):
    point = replace(SMALL, aspect=3, rods=10, time=0.05)
    table, known = bed.pour_glued(tmp_path / "a", replace(point, spheres=3), programs)
    rods, ours = bed.pour(tmp_path / "b", point, programs)
    assert known["centre"].shape[1:] == (10, 3)
    assert np.abs(known["centre"][0] - ours["centre"][0]).max() < 1e-4
    assert np.abs(np.abs(np.sum(known["axis"][0] * ours["axis"][0], axis=-1)) - 1).max() < 1e-6
    # Falling freely: the weight is the net force.
    assert table["force"].iloc[0] == pytest.approx(1.0, rel=1e-3)


# --- Page and figures. --------------------------------------------------------------------------

def test_largest_step_that_stands():
    part = pandas.DataFrame({"fraction": [0.1, 0.1, 0.2, 0.3, 0.4],
                             "state": ["rests", "moves", "rests", "jitters", "rests"]})
    assert page.stands_up_to(part) == 0.2
    assert page.stands_up_to(part[part["fraction"] > 0.2]) == 0
    assert figures.worst(part["state"]) == "jitters"
    assert page.largest_step(part) == "0.2" and page.largest_step(part[:0]) == "–"


def test_remedies_that_alone_do_as_well_as_all():
    beds = pandas.DataFrame(
        [{"map": "remedies", "method": method, "fraction": step, "state": state}
         for method, states in (("plain", "gg"), ("plain+mass", "rg"), ("plain+search", "rr"),
                                ("plain@4pi", "mm"), ("ours", "rr"))
         for step, letter in zip((0.1, 0.2), states)
         for state in [{"g": "grows", "r": "rests", "m": "moves"}[letter]]])
    found = page.alone(beds)
    assert (found["ours"], found["plain"]) == ("0.2", "none")
    assert found["good"] == ["search exact", "limit 4π"]
    assert found["bad"] == ["effective_mass on (0.1)"]
    assert page.alone(beds[:0])["good"] == []


def test_the_kept_page_is_that_of_the_kept_tables(kept_page_is_made_again):
    kept_page_is_made_again("stability")


@pytest.mark.skipif(not (STUDY / "README.md").exists(), reason="not kept")
def test_main_page():
    text = " ".join((ROOT / "README.md").read_text().split())
    beds = read_rows(STUDY / "results/beds.csv")
    ours = beds[(beds["map"] == "steps") & (beds["method"] == "ours")]
    up_to = min(page.stands_up_to(rows) for _, rows in ours.groupby("lambda"))
    first, last = ours["lambda"].min(), ours["lambda"].max()
    assert (f"Beds of aspect ratio {first:g} to {last:g} come to rest without any limit on the angular "
            f"velocity, with steps up to {up_to:g} of the stability limit") in text
    remedies = beds[beds["map"] == "remedies"]
    alone = {method: page.stands_up_to(rows) for method, rows in remedies.groupby("method")}
    assert [m for m in alone if m.startswith("plain+") and alone[m] >= alone["ours"]] == \
        ["plain+search"]
    assert alone["plain"] == 0 and "the exact search of contacts" in text



def test_templates_hold_no_measured_numbers():
    # Of the decks: a fall of 2.5 m into a vessel of 1.25 lengths; e; limits, and π/2 over one.
    assert measured_numbers(STUDY / "README.md.j2") <= {"2.5", "1.25", "0.5", "0.2"}


def test_wrong_config_ends_with_a_sentence(study):
    done = study("stability", "smoke=1", "bed_methods=[theirs]")
    assert done.returncode != 0 and "a method is ours or plain" in done.stdout, done.stdout


def test_the_smallest_run(study, tmp_path):
    done = study("stability", "smoke=1")
    assert done.returncode == 0, done.stdout
    results = tmp_path / "results"
    beds = read_rows(results / "beds.csv")
    steps = beds[beds["map"] == "steps"].set_index(["method", "fraction"])
    assert steps.loc[("ours", 0.36), "state"] == "rests"
    assert steps.loc[("ours", 1.08), "state"] in ("grows", "lost")
    hits = read_rows(results / "hits.csv")
    # Rods hardly turn in a hit, so that the scheme of one spring is theirs.
    assert (hits["worst_difference"] < 1e-5).all()
    assert ((hits["energy_most"] > 1) == (hits["fraction"] > hits["onset"])).all()
    spin = read_rows(results / "spin.csv")
    plain = spin[spin["rotation"] == "plain"]
    assert plain["rate"].to_numpy() == pytest.approx(plain["expected"].to_numpy(), rel=1e-3)
    assert (spin[spin["rotation"] == "exact"]["rate"].abs() < 1e-9).all()
    assert (read_rows(results / "costs.csv").set_index("method").loc["ours", "removed"]) == 0
    assert "Where methods fail" in (results / "README.md").read_text()
