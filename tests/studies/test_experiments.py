# SPDX-License-Identifier: GPL-2.0-or-later
"""studies/experiments: its measures against closed forms, its smallest run, its page."""
import math

import numpy as np
import pandas
import pytest

from conftest import ROOT, measured_numbers
from studies.common.rows import read_rows
from studies.experiments import beds, capsules, columns, measures, page

STUDY = ROOT / "studies/experiments"


def rods_at(places, axes=None, half=0.05, radius=0.005):
    places = np.asarray(places, float)
    axes = np.broadcast_to((0.0, 0.0, 1.0) if axes is None else axes, places.shape)
    return pandas.DataFrame({
        "id": np.arange(1, len(places) + 1), "x": places[:, 0], "y": places[:, 1],
        "z": places[:, 2], "radius": radius, "half": half, "ux": axes[:, 0], "uy": axes[:, 1],
        "uz": axes[:, 2]})


# --- Columns and heaps. --------------------------------------------------------------------------

def test_rods_of_a_dump_are_those_of_its_last_frame(tmp_path):
    c = math.sqrt(0.5)   # axis along x: z turned by 90 degrees about y
    frame = ("ITEM: TIMESTEP\n{0}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n"
             "0 1\nITEM: ATOMS id x y z shapex shapez quat1 quat2 quat3 quat4 c_contacts \n"
             "2 0.{0} 0 0.3 0.005 0.05 {1} 0 {1} 0 3\n1 0 0 0 0.005 0.05 1 0 0 0 0\n")
    path = tmp_path / "dump"
    path.write_text(frame.format(1, c) + frame.format(2, c))
    rods = measures.read_rods(path)
    assert list(rods["id"]) == [1, 2] and rods["x"][1] == 0.2 and list(rods["contacts"]) == [0, 3]
    every = measures.read_rods(path, every=True)
    assert list(every["frame"]) == [0, 0, 1, 1] and list(every["x"]) == [0, 0.1, 0, 0.2]
    assert rods.loc[1, ["ux", "uy", "uz"]].to_numpy(float) == pytest.approx([1, 0, 0])


# A heap of short upright rods that is a cylinder, then a cone of the radius a: of the cone's solid
# 3 x² - 2 x³ lie within x a, of the cylinder's x². Their mean heights are H/2 and H/4.
def test_run_out_of_a_known_heap():
    rng = np.random.default_rng(3)
    n, column, cone = 40_000, 0.1, 0.25

    def heap(radius, rise):
        angle, height = rng.uniform(0, 2 * np.pi, n), rng.uniform(0, 1, n) * rise(radius)
        return rods_at(np.c_[radius * np.cos(angle), radius * np.sin(angle), height], half=0.005)

    before = heap(column * np.sqrt(rng.uniform(0, 1, n)), lambda r: 0.4 + 0 * r)
    # Distance of a point of a cone: beta-distributed, r (1 - r).
    after = heap(cone * rng.beta(2, 2, n), lambda r: 0.2 * (1 - r / cone))
    found = measures.collapse(before, after)
    inside = np.roots([-2, 3, 0, -measures.RUN_OUT_PART])
    inside = inside[(inside > 0) & (inside < 1)].real[0]
    assert found["height"] == pytest.approx(0.4, rel=1e-2)
    assert found["lost"] == pytest.approx(1 - 0.25 * 0.2 / (0.5 * 0.4), abs=1e-2)
    expected = cone * inside / (column * math.sqrt(measures.RUN_OUT_PART)) - 1
    assert found["run_out"] == pytest.approx(expected, rel=1e-2)


def test_a_column_that_stays_and_rods_that_roll_away():
    before = rods_at([(0.01 * k, 0, 0.1) for k in range(-10, 11)])
    after = before.assign(contacts=1)
    assert measures.collapse(before, after)["run_out"] == pytest.approx(0)
    assert measures.collapse(before, after)["lost"] == pytest.approx(0)
    after.loc[0, ["x", "contacts"]] = [-50.0, 0]
    found = measures.collapse(before, after)
    assert found["alone"] == pytest.approx(1 / 21) and abs(found["run_out"]) < 0.05


# Horizontal rods: mean distance of the pieces of one through the axis is half its half length.
def test_solid_is_spread_along_the_rods():
    radius, height = measures.solid(rods_at([(0, 0, 0.2)], (1.0, 0.0, 0.0)))
    assert radius.mean() == pytest.approx((0.05 - 0.005 * 2 / 3) / 2)
    assert (height == pytest.approx(0.2)) and radius.shape == (1, measures.PIECES)


def test_critical_heights_are_found_again():
    rng = np.random.default_rng(7)
    heights = rng.uniform(0, 1.2, 1000)
    falls = rng.uniform(size=1000) < np.clip((heights - 0.25) / 0.5, 0, 1)
    found = measures.critical_heights(heights, falls)
    assert found["solid_below"] == pytest.approx(0.25, abs=0.06)
    assert found["falls_above"] == pytest.approx(0.75, abs=0.06)
    assert found["solid_below_low"] <= 0.25 + 0.02 and found["falls_above_high"] >= 0.75 - 0.02
    assert measures.critical_heights(heights, np.full(1000, True)) == {}
    sharp = measures.critical_heights(heights, heights > 0.5)
    assert sharp["solid_below"] == pytest.approx(0.5, abs=0.06)
    assert sharp["solid_below_low"] < 0.5 < sharp["falls_above_high"]


def test_exponent_of_a_power():
    x = np.array([0.3, 0.7, 1.1, 2.0])
    assert measures.exponent(x, 3 * x ** 1.2) == pytest.approx((1.2, 0), abs=1e-12)
    assert all(map(math.isnan, measures.exponent(x[:2], x[:2])))


# Twice as high a column of as loose a bed has twice the rods.
def test_number_of_rods():
    once, twice = (columns.number_of_rods(12, 1, h) for h in (1, 2))
    assert twice == pytest.approx(2 * once, abs=1)


# --- Contacts. -----------------------------------------------------------------------------------

COLUMNS = ["i", "j", *beds.COLUMNS]


def table_of(rows, names):
    return pandas.DataFrame(rows, columns=names, dtype=float).astype(
        {name: int for name in names if name in ("i", "j")})


def touch(i, j, normal, place, tangential=(0, 0, 0)):
    return [i, j, *normal, *tangential, *place]


# A rod flat on the floor: two contacts, which balance height and one torque. On four: two of them
# are redundant. One that lies in a corner of three walls: each contact its equation.
def test_independent_equations_of_single_rods():
    rod = rods_at([(0, 0, 0.005)], (1.0, 0.0, 0.0))
    none = table_of([], COLUMNS)
    for at, rank in (((-0.045, 0.045), 2), ((-0.045, -0.02, 0.02, 0.045), 2), ((0.01,), 1)):
        walls = table_of([touch(1, 0, (0, 0, 2), (x, 0, 0)) for x in at], COLUMNS).drop(columns="j")
        assert measures.independent_equations(none, walls, rod) == rank
    corner = table_of([touch(1, 0, n, (x, 0.0, 0)) for n, x in (
        ((0, 0, 1), -0.045), ((0, 0, 1), 0.045), ((0, 3, 0), -0.045), ((0, 1, 0), 0.045),
        ((1, 0, 0), -0.05))], COLUMNS).drop(columns="j")
    assert measures.independent_equations(none, corner, rod) == 5


# Rods that hang together by contacts in general position: 5 equations each without walls, less the
# 6 of the whole, which no contact between them can push or turn.
def test_isostatic_counts():
    rng = np.random.default_rng(11)
    n = 12
    axes = rng.normal(size=(n, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    rods = rods_at(rng.uniform(-0.05, 0.05, (n, 3)), axes)
    rows = []
    for i, j in rng.permutation([(i, j) for i in range(n) for j in range(i)]):
        # Normal forces meet both axes, as those of contacts of round rods do.
        p, q = (rods.loc[k, ["x", "y", "z"]].to_numpy(float) + rng.uniform(-0.05, 0.05) * axes[k]
                for k in (i, j))
        rows.append(touch(i + 1, j + 1, (p - q) / np.linalg.norm(p - q), (p + q) / 2))
    none = table_of([], COLUMNS).drop(columns="j")
    few, all_of_them = table_of(rows[:25], COLUMNS), table_of(rows, COLUMNS)
    assert measures.independent_equations(few, none, rods) == 25
    assert measures.independent_equations(all_of_them, none, rods) == 5 * n - 6
    counted = measures.bearing(few, none, rods, 0)
    assert counted["of_bearing"] == counted["forces"] == counted["equations"] == 25 / n
    assert counted["contacts"] == 50 / n


def test_sliding_contacts_have_one_unknown_less():
    rods = rods_at([(0, 0, 0), (0, 0.01, 0)])
    pairs = table_of([touch(1, 2, (0, 1, 0), (0, 0, 0), (0.2, 0, 0)),
                      touch(1, 2, (0, 1, 0), (0, 0, 0), (0.1, 0, 0))], COLUMNS)
    counted = measures.bearing(pairs, table_of([], COLUMNS).drop(columns="j"), rods, 0.2)
    assert counted["sliding"] == 0.5 and counted["forces"] == 2.5 and counted["equations"] == 6


def test_contacts_inside_are_those_of_the_inner_cylinder():
    rods = rods_at([(0, 0, 0.5), (0.08, 0, 0.5), (0, 0.02, 0.95), (0, 0, 1)])
    pairs = table_of([touch(1, j, (1, 0, 0), (0, 0, 0)) for j in (2, 3)], COLUMNS)
    assert measures.contacts_inside(pairs, rods, 0.1) == 2    # of rod 1 alone
    assert measures.contacts_inside(pairs, rods, 0.11) == 1.5  # and of rod 2


# A triangle with a tail of two: the tail goes, then what hung on it.
def test_rattlers_go_one_after_another():
    pairs = [(0, 1), (1, 2), (2, 0), (2, 3), (3, 4)]
    assert measures.without_rattlers(6, pairs, 2) == (3, 2.0)
    assert measures.without_rattlers(6, pairs, 3)[0] == 0


# Two bodies of two spheres that touch at two places, and one that touches nothing.
def test_contacts_of_glued_spheres():
    spheres = pandas.DataFrame({"mol": [1, 1, 2, 2, 3, 3], "x": [0, 1, 0, 1, 9, 10.0],
                                "y": [0, 0, 0.99, 0.99, 0, 0], "z": 0.0, "radius": 0.5})
    assert beds.sphere_contacts(spheres) == (1, 2)


def test_gap_for_a_number_of_contacts():
    row = {"nearer_0.01": 6.0, "nearer_0.1": 8.0}
    assert page.gap_for(row, [0.01, 0.1], 7.0) == pytest.approx(math.sqrt(0.001))
    assert math.isnan(page.gap_for(row, [0.01, 0.1], 9.0))


# --- Walls. --------------------------------------------------------------------------------------

# Thin rods thrown at random, of which those that would cross the wall are left out.
def test_solid_beside_a_wall():
    rng = np.random.default_rng(13)
    centre, c = rng.uniform(0, 3, 50_000), rng.uniform(0, 1, 50_000)
    kept = centre > c / 2
    pieces = centre[kept, None] + c[kept, None] * (np.arange(40) + 0.5 - 20) / 40
    counts, edges = np.histogram(pieces, np.arange(0, 1.01, 0.1))
    core = np.histogram(pieces, [1, 2])[0][0]
    middle = (edges[1:] + edges[:-1]) / 2
    assert 10 * counts[1:] / core == pytest.approx(measures.beside_a_wall(middle[1:]), abs=0.03)
    assert measures.beside_a_wall([1, 5]) == pytest.approx([1, 1])
    # Headings from the normal: c along it, the rest in any direction about it.
    across = np.cos(rng.uniform(0, 2 * np.pi, c.size)) * np.sqrt(1 - c * c)
    order = (c * c - across ** 2) / (c * c + across ** 2)
    for x in (0.1, 0.3, 0.45, 0.8):
        near = kept & (abs(centre - x) < 0.03)
        assert order[near].mean() == pytest.approx(measures.order_beside_a_wall(x), abs=0.08)


def test_a_value_is_first_reached_between_bins():
    x = np.arange(0.05, 2, 0.1)
    order = measures.order_beside_a_wall(x)
    assert measures.first_reached(x, order, -0.1) == pytest.approx(0.45)
    order[3] = np.nan
    assert measures.first_reached(x, order, -0.1) == pytest.approx(0.45)
    assert measures.first_reached(x, order, -2) == x[0]
    assert math.isnan(measures.first_reached(x, order, 1))


# 0 of n and n of n are not without error; Wilson's formula by hand for 1 of 4.
def test_interval_of_a_part():
    assert page.wilson(0, 3) == pytest.approx((0, 0.25)) and page.wilson(3, 3)[1] == 1
    assert page.wilson(1, 4) == pytest.approx((0.3 - 0.2, 0.3 + 0.2))


def test_layers_of_known_profiles():
    x = np.arange(0.05, 2, 0.1)
    table = pandas.DataFrame([
        {"lambda": 5.0, "seed": seed, "kind": kind, "distance": d, "value": v} for seed in (1, 2)
        for kind, values in (("vf", 0.4 * np.minimum(1, 0.2 + 1.6 * x)),
                             ("radial_order", measures.order_beside_a_wall(x)))
        for d, v in zip(x, values)])
    row, = page.layers(table)
    assert row["core"] == pytest.approx(0.4) and row["cases"] == 2
    assert row["layer"] == pytest.approx(0.75 / 1.6, abs=0.02)
    assert row["order_layer"] == pytest.approx(0.45)


# --- Dense packings. -----------------------------------------------------------------------------

def test_jammed_where_overlaps_begin():
    solid = np.linspace(0.5, 0.8, 301)
    overlaps = np.maximum(0, 2.5 * (solid - 0.64))
    assert measures.jammed(solid, overlaps, 0.02, 0.08) == pytest.approx(0.64)
    assert math.isnan(measures.jammed(solid, overlaps, 5, 6))


def test_capsules_jam_on_the_way(tmp_path, programs):
    row = capsules.packing(tmp_path, 1.3, 40, 1e-3, 86028121, programs)
    assert 0.5 < row["solid_fraction"] < 0.74 and row["contacts_all"] > 3


# --- Shear. --------------------------------------------------------------------------------------

# Axes at known angles in the plane of flow, whichever way they are read, and out of it.
@pytest.mark.parametrize("angle", [-60, 0, 15, 44])
def test_alignment_of_a_known_set(angle):
    tilts = np.radians(angle + np.array([-20, 20, -5, 5, 0]))
    sign = np.array([1, -1, 1, -1, 1])
    y = np.full(5, 0.3)
    axes = np.c_[sign * np.cos(tilts), y, sign * np.sin(tilts)]
    found, order = measures.alignment(rods_at(np.zeros((5, 3)), axes))
    assert found == pytest.approx(angle)
    assert order == pytest.approx(np.cos(2 * np.radians([20, 20, 5, 5, 0])).mean())


def test_slope_of_angles_over_the_decades_of_a_rate():
    table = pandas.DataFrame({"limits": "none", "lambda": 3.0, "rate": [0.1, 1, 10, -1],
                              "alignment_deg": [14, 15, 16, 90.0], "order": 0.8})
    row, = page.shear(table)
    assert row["slope"] == pytest.approx((1, 0), abs=1e-9) and row["layers"] == 3
    assert row["alignment"][0] == pytest.approx(15)


# --- The study. ----------------------------------------------------------------------------------

def test_published_numbers_have_a_source():
    table = read_rows(STUDY / "literature.csv")
    assert table["source"].str.len().min() > 10 and table["printed"].notna().all()
    assert not table.duplicated(["experiment", "quantity"]).any()


def test_the_smallest_run(study, tmp_path):
    done = study("experiments", "smoke=1")
    assert done.returncode == 0, done.stdout
    results = tmp_path / "results"
    contacts = read_rows(results / "contacts.csv").set_index("friction")
    # Not one contact of a bed without friction is redundant.
    assert contacts.loc[0, "forces"] <= contacts.loc[0, "equations"] + 0.05 <= 5.05
    assert contacts.loc[0.2, "forces"] > 6
    columns_ = read_rows(results / "collapse.csv").sort_values("height")
    fallen, limited = (columns_[columns_["limits"] == limits] for limits in ("none", "study"))
    assert list(fallen["collapsed"])[0] == 0 and list(fallen["collapsed"])[-1] == 1
    # Rods that may not turn do not fall over.
    assert limited["lost"].max() < fallen["lost"].max()
    layers = read_rows(results / "shear.csv")
    assert (layers["rate"] > 0).any() and layers["alignment_deg"].between(-90, 90).all()
    text = (results / "README.md").read_text()
    for name in ("contacts", "wall", "collapse", "standing", "capsules", "shear"):
        assert f"]({name}.png)" in text and (results / f"{name}.svg").exists()


def test_one_experiment_alone(study):
    done = study("experiments", "smoke=1", "experiments=[capsules]", options=["-n"])
    assert done.returncode == 0 and "rule column" not in done.stdout, done.stdout
    done = study("experiments", "smoke=1", "experiments=[soup]", options=["-n"])
    assert done.returncode != 0 and "experiments must be among contacts, wall" in done.stdout
    done = study("experiments", "smoke=1", "contacts_rods=[20,30]", options=["-n"])
    assert done.returncode != 0 and "a number for each of contacts_lambdas" in done.stdout


def test_the_kept_page_is_that_of_the_kept_tables(kept_page_is_made_again):
    kept_page_is_made_again("experiments")


def test_templates_hold_no_measured_numbers():
    # Of the decks: restitution.
    assert measured_numbers(STUDY / "README.md.j2") <= {"0.5"}
