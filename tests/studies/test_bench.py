# SPDX-License-Identifier: GPL-2.0-or-later
"""bench/Snakefile: rows from runs in turns, the smallest run of the graph, the page from the kept table."""
import argparse
import math
import re
import sys
from pathlib import Path

import numpy
import pandas
import pytest

from bench import compare, meshes, one_sphere, page, speed
from studies.common import cases, pages
from studies.common.rows import PROVENANCE, read_rows

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "bench" / "results" / "speed.csv"


def run_of(seconds, steps, peak_kB, contacts=math.nan):
    return {"seconds": seconds, "steps": steps, "peak_kB": peak_kB, "contacts": contacts,
            "checksum": 1.5, "command": "lmp"}


# Times a rod and step by hand. The machine is half as fast in the second turn: the ratios of the
# turns, 4, 5 and 4.5, do not see it, those of the medians would be 5.
def test_rows_of_three_turns():
    runs = {"plugin": [run_of(s, 1000, 40_000, 3.0) for s in (0.1, 0.2, 0.1)],
            "19": [run_of(s, 100, 90_000) for s in (0.04, 0.1, 0.045)]}
    own, peer = speed.rows_of(runs, "bed", 10, 500, 1, {"lmp": 30_000, "liggghts": 20_000}, 0.25)
    assert own["code"] == "plugin" and peer["code"] == "multisphere n=19"
    assert [float(own[c]) for c in ("us_per_rod_and_step", "us_min", "us_max")] == [0.2, 0.2, 0.4]
    assert float(peer["us_per_rod_and_step"]) == pytest.approx(0.9)
    assert float(own["peer_over_plugin"]) == 1
    assert float(peer["peer_over_plugin"]) == 4.5
    assert own["contacts_per_rod"] == 3.0 and math.isnan(peer["contacts_per_rod"])
    assert float(own["memory_kB_per_rod"]) == 20  # 10,000 kB above the idle program
    assert float(peer["memory_kB_per_rod"]) == 140
    assert list(own)[:len(speed.COLUMNS)] == speed.COLUMNS


# Two ranks load the program twice.
def test_idle_memory_of_each_rank():
    runs = {"plugin": [run_of(1.0, 100, 100_000, 0.0)]}
    [row] = speed.rows_of(runs, "gas", 10, 1000, 2, {"lmp": 30_000, "liggghts": 0}, 0.0)
    assert float(row["memory_kB_per_rod"]) == 40


def test_checksum(tmp_path):
    dump = tmp_path / "dump"
    dump.write_text("head\n" * 9 + "1 0.1 0.2 0.3\n3 0.4 0.5 0.6\n")
    assert speed.checksum(dump) == pytest.approx((0.6 + 3 * 1.5) / 4 / 0.01)


# 5 % solid; dilute: as many contacts a rod as λ = 10, which go with λ times the solid part.
def test_solid_parts():
    for aspect in (10, 30, 100):
        assert speed.solid("dilute", aspect) * aspect == pytest.approx(speed.solid("gas", 10) * 10)
    assert speed.spheres_of("gas", 30, 2000, {"largest_peer": 2000}) == [30, 59]
    assert speed.spheres_of("gas", 30, 2001, {"largest_peer": 2000}) == []


# From end to end; a second time nothing is timed again.
def test_smallest_run(study, tmp_path):
    done = study("bench/", "smoke=1", "scenes=[bed,gas,sphere_bed]")
    assert done.returncode == 0, done.stdout
    table = read_rows(tmp_path / "results" / "speed.csv")
    assert list(table.columns) == speed.COLUMNS + list(PROVENANCE)
    cases = table[["scene", "lambda", "rods", "ranks", "code"]].values.tolist()
    assert cases == [["bed", 10, 20, 1, code] for code in
                     ("plugin", "multisphere n=10", "multisphere n=19")] + \
        [["gas", 5, 80, ranks, code] for ranks in (1, 2) for code in
         ("plugin", "multisphere n=5", "multisphere n=9")] + [["gas", 5, 160, 1, "plugin"]] + \
        [["sphere_bed", 10, 30, 1, code] for code in ("plugin", "sphere liggghts", "sphere lammps")]
    assert (table["us_min"] <= table["us_per_rod_and_step"]).all()
    assert (table["us_per_rod_and_step"] <= table["us_max"]).all()
    assert (table["us_min"] > 0).all()
    own = table[table["code"] == "plugin"]
    assert (own["peer_over_plugin"] == 1).all() and own["contacts_per_rod"].notna().all()
    # The codes begin alike, and do not go far in 40 steps: the mean of x + y + z over spheres and rods
    # differs by the numbers they have only. Of the plug-in one and two ranks end at the same places.
    gas = table[(table["scene"] == "gas") & (table["rods"] == 80)]
    of_code = gas.groupby("code")["checksum"]
    assert (of_code.max() - of_code.min() < 1e-6).all()
    assert set(table["seed"]) == {86028121}
    assert (tmp_path / "results" / "speed.svg").stat().st_size > 1000

    # The two codes read the same bed, which is at rest: no sphere moves, all touch alike.
    spheres = table[table["code"].str.startswith("sphere ")]
    assert spheres["checksum"].max() - spheres["checksum"].min() < 1e-6
    assert spheres["contacts_per_rod"].nunique() == 1
    assert 3 < spheres["contacts_per_rod"].iloc[0] < 6

    again = study("bench/", "smoke=1", "scenes=[bed,gas,sphere_bed]")
    assert again.returncode == 0 and "Nothing to be done" in again.stdout, again.stdout


# Rods in flight: the same state beside primitives, in the mesh, and glued.
def test_smallest_run_of_meshes(study, tmp_path):
    done = study("bench/", "smoke=1", "scenes=[mesh_bed,drum,hopper]")
    assert done.returncode == 0, done.stdout
    table = read_rows(tmp_path / "results" / "speed.csv")
    assert table[["scene", "lambda", "rods", "code"]].values.tolist() == [
        *(["drum", 3, 20, code] for code in ("plugin", "multisphere n=5")),
        *(["hopper", 3, 20, code] for code in ("plugin", "multisphere n=5")),
        *(["mesh_bed", 10, 20, code] for code in ("plugin", "plugin primitive", "multisphere n=19"))]
    assert (table["us_min"] > 0).all()
    assert table[table["code"].str.startswith("plugin")]["contacts_per_rod"].notna().all()


def facets_of(stl):
    """Corners of the triangles of a text STL."""
    numbers = [line.split()[1:] for line in stl.read_text().splitlines() if "vertex" in line]
    return numpy.array(numbers, float).reshape(-1, 3, 3)


# Plates and floor of a coarse and a fine tube lie in the same planes: areas of either by hand, of a polygon of 64
# sides about the circle of radius r, 128 r tan(π/64) h, and of the square about it.
def test_tubes_of_few_and_many_triangles_are_one_surface(tmp_path):
    radius, height = 0.1, 0.3
    for mesh, number in (("coarse", 1010), ("fine", 99698)):
        meshes.write(mesh, tmp_path, radius, height)
        corners = facets_of(tmp_path / f"{mesh}.stl")
        assert len(corners) == number
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        areas = numpy.linalg.norm(normals, axis=1) / 2
        floor = (corners[:, :, 2] == 0).all(axis=1)
        assert areas[~floor].sum() == pytest.approx(128 * radius * math.tan(math.pi / 64) * height)
        assert areas[floor].sum() == pytest.approx((2 * radius / math.cos(math.pi / 64))**2)
        unit = normals[~floor] / (2 * areas[~floor, None])
        apart = abs((unit * corners[~floor, 0]).sum(axis=1))
        assert apart == pytest.approx(numpy.full(len(apart), radius), rel=1e-6)


@pytest.mark.parametrize("scene, found", [
    ("bed", ["plugin", "10", "19"]), ("mesh_bed", ["plugin", "primitive", "19"]),
    ("mesh_fine", ["plugin", "coarse", "19"]), ("drum", ["plugin", "19"]),
    ("sphere_bed", ["plugin", "liggghts", "lammps"])])
def test_codes_of_a_scene(scene, found):
    assert speed.codes_of(scene, 10, 500, {"largest_peer": 2000}) == found
    programs = {"liggghts": "liggghts", "lammps": "lammps"}
    for code in found:
        assert speed.program_of(code) == ("liggghts" if code.isdigit() else programs.get(code, "lmp"))


# Of one rod at a wall the two surroundings are different decks: gravity in both, walls in one, a mesh in the other.
def test_variables_of_walls_and_of_meshes():
    names = ("has_side", "has_floor", "has_gravity", "n_meshes", "meshes", "from")

    def chosen(scene, code="plugin"):
        found = speed.variables(scene, 10, 500, code)
        return tuple(found[name] for name in names)

    assert chosen("gas") == (0, 0, 0, 0, "none", "restart.start")
    assert chosen("bed") == (1, 1, 1, 0, "none", "restart.start")
    assert chosen("mesh_bed") == (0, 0, 1, 1, "coarse", "restart.start")
    assert chosen("mesh_bed", "primitive") == (1, 1, 1, 0, "none", "restart.primitive")
    assert chosen("mesh_fine") == (0, 0, 1, 1, "fine", "restart.start")
    assert chosen("mesh_fine", "coarse") == (0, 0, 1, 1, "coarse", "restart.coarse")
    assert chosen("drum") == (0, 0, 1, 2, "drum parts", "restart.start")
    # The study's vessel; as much wider as 20 times the rods ask for.
    assert speed.variables("mesh_bed", 10, 500)["vessel_diameter"] == 0.21
    assert speed.variables("mesh_fine", 10, 10000)["vessel_diameter"] == 0.57


@pytest.mark.parametrize("settings, sentence", [
    (["scenes=[bad]"], "bench: scenes must be of bed, fill, fill_wide, settle, gas, dilute, dense, "
     "periodic_bed, sphere_bed, mesh_bed, mesh_fine, drum, hopper (got 'bad')"),
    (["sphere_gravity=0"], "bench: sphere_gravity must be a number >= 1 (got 0)"),
    (["sphere_settled=long"], "bench: sphere_settled must be a number >= 0 (got long)"),
    (["sphere_skin=0.1"], "bench: sphere_skin must be a mapping {KEY: VALUE} (got 0.1)"),
    (["sphere_skin={liggghts: 0.1, others: 0.1}"],
     "bench: sphere_skin may have liggghts, lammps (got others)"),
    (["sphere_skin={liggghts: 0.1, lammps: 0}"],
     "bench: sphere_skin of lammps must be a number >= 0.01 (got 0)"),
    (["turns=0"], "bench: turns must be a whole number > 0 (got 0)"),
    (["cases={bed: [[10,500]]}"], "bench: a case must be [lambda, rods, ranks]"),
    (["cases={bed: []}", "scenes=[bed]"], "bench: there are no cases of these scenes"),
])
def test_wrong_settings(study, settings, sentence):
    done = study("bench/", *settings, targets=["-n"])
    assert done.returncode != 0 and sentence in done.stdout, done.stdout


# Placed clear of the vessel and of each other: every distance against all others.
def test_spheres_are_placed_clear():
    count = 60
    centres = one_sphere.placed(count, 7)
    reach = (one_sphere.vessel_diameter(count) - one_sphere.DIAMETER) / 2
    assert (centres[:, 0]**2 + centres[:, 1]**2 <= reach**2).all()
    assert (centres[:, 2] >= one_sphere.DIAMETER / 2).all()
    apart = ((centres[:, None] - centres[None])**2).sum(axis=2)[~numpy.eye(count, dtype=bool)]
    assert (apart > one_sphere.DIAMETER**2).all()


def test_debians_lammps_is_missed_in_a_sentence(monkeypatch):
    monkeypatch.setenv("PATH", "")
    with pytest.raises(cases.CaseError, match="package lammps is not there: scripts/setup --studies"):
        cases.program_path("lammps")


CASE_HEAD = "scene,rods,ranks,lambda,code,us,machine\n"


# Cases of the part replace those of the table, other cases keep every digit and quote.
def test_adding_a_part_to_a_table(tmp_path):
    table, part = tmp_path / "kept.csv", tmp_path / "part.csv"
    kept = ['bed,500,1,10,plugin,0.27720000000001,"a, b"', "gas,2000,1,30,plugin,0.30,m",
            "gas,20000,1,3,plugin,,m"]
    table.write_text(CASE_HEAD + "\n".join(kept) + "\n")
    new = ["sphere_bed,500,1,10,plugin,0.1,m", "sphere_bed,500,1,10,sphere lammps,0.2,m",
           "gas,2000,1,30,plugin,0.4,m"]
    part.write_text(CASE_HEAD + "\n".join(new) + "\n")
    for _ in range(2):
        speed.add_rows(part, table)
        expected = [kept[0], new[2], kept[2], new[0], new[1]]
        assert table.read_text() == CASE_HEAD + "\n".join(expected) + "\n"
    part.write_text("scene,rods,ranks,lambda\n")
    with pytest.raises(cases.CaseError, match="have other columns"):
        speed.add_rows(part, table)
    with pytest.raises(cases.CaseError, match="none.csv is not there"):
        speed.add_rows(tmp_path / "none.csv", table)


# A rod beside spheres is told where the table has such rows, with their numbers, and only there.
def test_page_tells_of_spheres_where_they_were_timed(tmp_path):
    table = read_rows(KEPT)
    table = table[table["scene"] != "sphere_bed"]
    out = tmp_path / "README.md"
    pages.render(ROOT / "bench" / "README.md.j2", out, page.values(table))
    assert "price of a sphere" not in out.read_text()

    codes = [("plugin", 0.212, 5.98, 1), ("sphere liggghts", 0.363, 5.69, 1.71),
             ("sphere lammps", 0.171, 5.69, 0.81)]
    rows = [{**table.iloc[0].to_dict(), "scene": "sphere_bed", "lambda": aspect, "rods": count,
             "code": code, "us_per_rod_and_step": us, "contacts_per_rod": contacts,
             "peer_over_plugin": ratio}
            for aspect, count in ((10, 500), (30, 700)) for code, us, contacts, ratio in codes]
    pages.render(ROOT / "bench" / "README.md.j2", out,
                 page.values(pandas.concat([table, pandas.DataFrame(rows)], ignore_index=True)))
    section = out.read_text().split("### A rod for the price of a sphere")[1].split("\n##")[0]
    assert [line for line in section.splitlines() if line.startswith("|")][2:] == [
        "| 500 rods, λ = 10 | 0.21 | 6.0 | 1 |", "| 500 spheres, LIGGGHTS | 0.36 | 5.7 | 1.7 |",
        "| 500 spheres, LAMMPS | 0.17 | 5.7 | 0.81 |",
        "| 700 rods, λ = 30 | 0.21 | 6.0 | 1 |", "| 700 spheres, LIGGGHTS | 0.36 | 5.7 | 1.7 |",
        "| 700 spheres, LAMMPS | 0.17 | 5.7 | 0.81 |"]


# Rods in a mesh, where there are such rows: 1.25 times the primitives' step; glued rods take 5.1 times as long.
def test_page_tells_of_meshes_where_they_were_timed(tmp_path):
    table = read_rows(KEPT)
    table = table[~table["scene"].isin(["mesh_bed", "mesh_fine", "drum", "hopper"])]
    out = tmp_path / "README.md"
    pages.render(ROOT / "bench" / "README.md.j2", out, page.values(table))
    assert "### Meshes" not in out.read_text()

    rows = [{**table.iloc[0].to_dict(), "scene": "mesh_bed", "lambda": 10, "rods": 500, "code": code,
             "us_per_rod_and_step": us, "peer_over_plugin": ratio}
            for code, us, ratio in (("plugin", 0.41, 1), ("plugin primitive", 0.33, 0.8),
                                    ("multisphere n=19", 2.1, 5.1))]
    pages.render(ROOT / "bench" / "README.md.j2", out,
                 page.values(pandas.concat([table, pandas.DataFrame(rows)], ignore_index=True)))
    section = out.read_text().split("### Meshes")[1].split("## Post")[0]
    assert [line for line in section.splitlines() if line.startswith("|")][2:] == [
        "| `mesh_bed`, 500 rods, λ = 10 | 0.41 | 1.25 (plugin primitive) | 5.1 (multisphere n=19) |"]


# The page holds what its table does.
def test_page_is_made_of_the_kept_table(tmp_path):
    out = tmp_path / "README.md"
    pages.render(ROOT / "bench" / "README.md.j2", out, page.values(read_rows(KEPT)))
    assert out.read_text() == (ROOT / "bench" / "README.md").read_text()


def test_kept_figure_shows_the_kept_table(tmp_path):
    table = read_rows(KEPT)
    speed.figure(table, tmp_path / "speed")
    svg = (tmp_path / "speed.svg").read_text()
    assert svg == (ROOT / "bench" / "results" / "speed.svg").read_text()
    for label in ("settled bed: rods", "gas of 2,000: λ spheres", "gas of 200,000: rods"):
        assert label in svg or label.replace("λ", "&#955;") in svg


# "in the study's settled beds 4 and 12 times faster than λ touching spheres a rod for λ = 10 and 30, 8
# and 27 times faster than 2λ − 1 that overlap; in a gas of λ = 100 85 and 180 times"
def test_figures_of_the_main_page():
    table = read_rows(KEPT)
    table = table[table["ranks"] == 1]

    def times(scene, aspect, n):
        part = table[(table["scene"] == scene) & (table["lambda"] == aspect)
                     & (table["code"] == f"multisphere n={n}")]
        return float(part["peer_over_plugin"].iloc[0])

    text = " ".join((ROOT / "README.md").read_text().split())
    found = re.search(r"settled beds (\d+) and (\d+) times faster than λ touching spheres a rod for "
                      r"λ = 10 and 30, (\d+) and (\d+) times faster than 2λ − 1 that overlap; in a gas "
                      r"of λ = 100 (\d+) and (\d+) times", text)
    measured = [times("bed", 10, 10), times("bed", 30, 30), times("bed", 10, 19),
                times("bed", 30, 59), times("gas", 100, 100), times("gas", 100, 199)]
    assert [float(f"{value:.2g}") for value in measured] == \
        pytest.approx(list(map(float, found.groups())), rel=0.05)


def test_a_missing_row_is_said():
    table = read_rows(KEPT)
    with pytest.raises(ValueError, match="speed.csv has 0 rows of bed 11 500 1 plugin, wanted one"):
        page.values(table)["us"]("bed", 11, 500)


# A build and itself: the same instructions to the last few hundred (addresses differ), the same end.
def test_compare_a_build_with_itself(programs, tmp_path):
    given = argparse.Namespace(before=programs, after=programs, count=10, longer=1, turns=2,
                               folder=tmp_path)
    row = compare.compare("gas", 5, 80, given)
    assert float(row["after_over_before"]) == pytest.approx(1.0, abs=1e-3) and row["same_end"]
    assert 100 < float(row["instructions_before"]) < 20_000
    given.count = 0
    row = compare.compare("gas", 5, 80, given)
    assert row["same_end"] and float(row["least"]) <= float(row["after_over_before"])


def test_compare_wants_folders_of_programs(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["compare.py", str(tmp_path), str(tmp_path)])
    with pytest.raises(SystemExit):
        compare.main()
    assert f"{tmp_path} must be a folder with the program lmp, as build/release" in \
        capsys.readouterr().err
