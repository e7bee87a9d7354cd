# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples of machinery: what measure.py finds where the answer is known, the numbers of the page against its
tables, films and pictures as small as they should be."""
import importlib.util
import re

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from conftest import ROOT

FOLDER = ROOT / "examples" / "machinery"
RESULTS = FOLDER / "results"


def program(name):
    spec = importlib.util.spec_from_file_location(name, FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


measure = program("measure")


# Rates of 9e5 (D - 0.012)^(5/2) rods a second: the fit finds the 12 mm.
def test_hoppers_that_follow_beverloo(tmp_path, capsys):
    time = np.arange(0, 0.605, 0.01)
    paths = []
    for orifice in (0.03, 0.04, 0.05, 0.06):
        left = 1000 - 9e5 * (orifice - 0.012) ** 2.5 * time
        paths.append(tmp_path / f"{orifice}.csv")
        np.savetxt(paths[-1], np.stack([np.full(len(time), orifice), 0.6 + time, left], axis=1), delimiter=",",
                   header="orifice/m,time/s,rods above", comments="")
    measure.hopper(paths, 0.2, 0.5)
    printed = capsys.readouterr().out
    assert "0.05,1,253,nan" in printed  # 9e5 0.038^(5/2)
    assert "(D - 0.0120 m)" in printed


# Its own output has the ending that a glob of tables has, and no rows yet.
@pytest.mark.parametrize("what", ["hopper", "vane"])
@pytest.mark.parametrize("text, told", [("", "holds no rows"), ("a,b,c\n", "holds no rows"),
                                        ("a,b\n1,2\n", "has 2 columns (wanted")])
def test_tables_without_rows(what, text, told, tmp_path):
    path = tmp_path / "rates.csv"
    path.write_text(text)
    with pytest.raises(SystemExit, match=re.escape(f"{path} {told}")):
        measure.hopper([path], 0.2, 0.5) if what == "hopper" else measure.vane(path)


# A drum of facets that its lifters do not come out evenly on.
@pytest.mark.parametrize("facets", [0, 3, 5, 7, 50])
def test_facets_that_lifters_do_not_divide(facets, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.argv", ["make_meshes.py", "--facets", str(facets)])
    with pytest.raises(SystemExit):
        program("make_meshes").main()
    assert f"--facets must be a multiple of 6, the number of lifters (got {facets})" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("facets", [6, 12, 54])
def test_a_drum_has_six_lifters(facets):
    meshes = program("make_meshes")
    assert len(meshes.drum_parts(facets)) == 2 * facets + 2 * 6


# Variables may stand before the deck's name; those of meshes go to these too.
def test_variables_of_films():
    film = program("film")
    own, variables = film.without_variables(
        ["-var", "slope", "25", "chute", "--every", "1", "-v", "height", "-0.1", "-var", "orifice", "0.04"])
    assert own == ["chute", "--every", "1"]
    assert variables == {"slope": "25", "height": "-0.1", "orifice": "0.04"}
    assert film.meshes_of(variables) == ["--orifice", "0.04", "--slope", "25"]
    with pytest.raises(SystemExit, match="-var out is for runs alone.*got 'sub'"):
        film.without_variables(["drum", "-var", "out", "sub"])
    with pytest.raises(SystemExit, match="-var wants a name and a value"):
        film.without_variables(["drum", "-var", "out"])


# A drum that is full below a line.
@pytest.mark.parametrize("angle", [-40.0, 10.0, 35.0])
def test_surface_of_a_full_part_of_a_circle(angle):
    rng = np.random.default_rng(15485863)
    points = rng.uniform(-0.1, 0.1, (400000, 2))
    slope = np.radians(angle)
    below = points[:, 1] * np.cos(slope) - points[:, 0] * np.sin(slope) < -0.02
    kept = points[below & (np.hypot(*points.T) < 0.1)]
    assert measure.surface(kept) == pytest.approx(angle, abs=0.3)


# A rod turned by 90 degrees about y lies along x.
def test_places_of_a_rod(tmp_path):
    dump = tmp_path / "dump"
    dump.write_text("ITEM: TIMESTEP\n500\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\n"
                    "ITEM: ATOMS id x y z shapez quat1 quat2 quat3 quat4\n"
                    "1 0.5 0 0.25 0.07 0.7071067811865476 0 0.7071067811865476 0\n")
    [(step, rods)] = measure.frames(dump)
    assert step == 500
    wanted = [(0.5 + 0.02 * i, 0.25) for i in range(-3, 4)]
    assert measure.places(rods) == pytest.approx(np.array(wanted), abs=1e-12)


# Three pictures, 40 ms each.
@pytest.mark.parametrize("ending", ["webp", "gif", "png"])
def test_film_of_three_pictures(ending, tmp_path):
    pictures = [tmp_path / f"{shade}.png" for shade in (10, 100, 200)]
    for path in pictures:
        Image.new("RGB", (20, 10), (int(path.stem), 0, 0)).save(path)
    film = tmp_path / f"film.{ending}"
    program("film").joined(pictures, film, 25, 60)
    with Image.open(film) as made:
        assert (made.n_frames, made.size) == (3, (20, 10))
        for number in range(3):
            made.seek(number)
            made.load()
            assert made.info["duration"] == 40
            assert made.convert("RGB").getpixel((5, 5))[0] == pytest.approx((10, 100, 200)[number], abs=8)


def test_film_takes_a_dump_apart(tmp_path):
    frame = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n0\n"
    (tmp_path / "dump").write_text("".join(frame.format(step) for step in (0, 500, 1000)))
    assert list(program("film").frames_of(tmp_path / "dump")) == [frame.format(step) for step in (0, 500, 1000)]


def numbers(text):
    return [float(number.replace(",", "")) for number in re.findall(r"(?<![\w.])\d[\d,]*(?:\.\d+)?", text)]


def cells(first):
    """Numbers of the row of the page's tables that begins with this."""
    text = (FOLDER / "README.md").read_text()
    [row] = re.findall(rf"^\| {re.escape(first)} \|(.*)$", text, re.MULTILINE)
    return [numbers(cell) for cell in row.split("|")[:-1]]


def table(name):
    return pd.read_csv(RESULTS / f"{name}.csv", comment="#")


def test_rows_of_the_page_with_closed_forms():
    for row in table("alone").itertuples(index=False):
        found = [numbers(cell) for cell in re.findall(
            rf"^\|[^|]*\| {re.escape(row.quantity)} \|([^|]*)\|([^|]*)\|$", (FOLDER / "README.md").read_text(),
            re.MULTILINE)[0]]
        assert found == [[row.found], [row.wanted]], row
        assert row.found == pytest.approx(row.wanted, rel=2e-3)


# By hand, for lambda = 3, r = 2.5 mm, mu = 0.4: a cylinder of length 4 r and a ball.
def test_closed_forms_of_the_table():
    g, mu, slope = 9.81, 0.4, np.radians(30)
    inertia = (4 / 2 + 8 / 15) / (4 + 4 / 3)   # over m r^2
    amplitude, omega = 1.5e-3, 40 * np.pi
    strength = amplitude * omega ** 2 / g
    thrown = amplitude * omega * np.sqrt(1 - strength ** -2)
    wanted = [g * (np.sin(slope) - mu * np.cos(slope)) * 0.2, g * np.sin(slope) * 0.2 / (1 + inertia), 0.5,
              1e3 * (1.2 * 0.5 ** 2 / (mu * g) - 0.5 ** 2 / (2 * mu * g)), 0.5 / (1 + 1 / inertia),
              1e3 * (amplitude * (1 + 1 / strength) + thrown ** 2 / (2 * g))]
    assert table("alone")["wanted"].to_numpy() == pytest.approx(wanted, rel=1e-4)  # times are whole steps


def between(rows, start, end):
    return rows[rows.iloc[:, 0].between(start, end)].mean()


# What is told of four runs, in words.
def test_runs_of_the_page():
    text = " ".join((FOLDER / "README.md").read_text().split())
    chute = table("chute").iloc[-1]
    assert f"after {chute.iloc[0]:g} s the gate has counted {chute.iloc[2]:g}, and {chute.iloc[3]:g} lie" in text
    belts = between(table("conveyor"), 0.7, 1.95)
    assert f"{belts.iloc[2]:.1f} rods on 80 mm" in text and f"theirs is {belts.iloc[3]:.3f} m/s" in text
    cross = between(table("conveyor"), 0.82, 1.95).iloc[4]
    assert f"they go at {cross:.3f} m/s" in text
    rows = table("trough")
    speed = between(rows, 0.6, 1.4).iloc[2]
    largest = 3e-3 * 40 * np.pi * np.cos(np.radians(30))
    assert f"at {speed:.2f} m/s, {speed / largest:.2f} of" in text
    assert f"into {rows.iloc[-1, 3]:g} and {rows.iloc[-1, 4]:g}" in text
    vane = table("vane")
    half = vane[np.isclose(vane.iloc[:, 0], 0.5)].iloc[0]
    assert f"{1e3 * half.iloc[2]:.1f} of {1e3 * half.iloc[3]:.1f} mN m at 0.5 s" in text
    last = vane.iloc[-1]
    assert f"bears {1e3 * last.iloc[2]:.1f} of {1e3 * last.iloc[3]:.0f} mN m" in text


# Of every fifth row.
def test_the_way_of_the_vane(capsys):
    measure.vane(RESULTS / "vane.csv")
    text = " ".join((FOLDER / "README.md").read_text().split())
    [told] = re.findall(r"it has turned by (\S+) rad", text)
    assert float(capsys.readouterr().out.split()[1]) == pytest.approx(float(told), rel=2e-3)


def test_rates_of_the_page():
    rates = table("hopper_rates")
    assert cells("orifice (mm)") == [[round(1000 * orifice)] for orifice in rates["orifice/m"]]
    assert cells("rods a second") == [[rate, error] for rate, error in zip(rates["rods/s"], rates["standard error"])]
    kept = (RESULTS / "hopper_rates.csv").read_text()
    offset, error = (1000 * float(number) for number in re.search(r"D - (\S+) m\); D0 \+- (\S+) m", kept).groups())
    assert f"{offset:.1f} ± {error:.1f} mm" in (FOLDER / "README.md").read_text()


def test_angle_of_the_page():
    angle = table("drum_angle").iloc[0]
    assert f"{angle['angle/degrees']:.1f} ± {angle['standard error']:.1f} degrees" in (FOLDER / "README.md").read_text()


def test_films_and_pictures_are_small():
    for path in RESULTS.glob("*.webp"):
        assert path.stat().st_size <= 900e3, path
    for path in RESULTS.glob("*.png"):
        assert path.stat().st_size <= 300e3, path


# Each deck has its picture, its film's view and its row.
def test_decks_are_all_there():
    decks = {path.name.removeprefix("in.") for path in FOLDER.glob("in.*")} - {"rods", "material"}
    assert decks == set(program("film").VIEWS)
    text = (FOLDER / "README.md").read_text()
    for deck in decks:
        assert (RESULTS / f"{deck}.png").exists(), deck
        assert f"| `in.{deck}` |" in text, deck
        assert f"(results/{deck}.png)" in text, deck
