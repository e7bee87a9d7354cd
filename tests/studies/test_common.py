# SPDX-License-Identifier: GPL-2.0-or-later
"""studies/common: runs, logs, rows, statistics, pages."""
import concurrent.futures
import hashlib
import math
import os
import sys

import numpy
import pandas
import pytest
from PIL import Image

from conftest import ROOT
from studies.common import cases, pages, plots, rows, statistics


# 1, 2, 3, 6: mean 3, squares about it 4 + 1 + 0 + 9 = 14, error sqrt(14/(4 3)).
def test_mean_and_standard_error():
    mean, error = statistics.mean_and_error([6, 1, 3, 2])
    assert mean == pytest.approx(3)
    assert error == pytest.approx(math.sqrt(14 / 12))
    assert statistics.mean_and_error([7])[0] == 7
    assert math.isnan(statistics.mean_and_error([7])[1])


# Two samples of mean 2 and variance 1 each: error sqrt(2/3)/2 of the mean, 4 degrees of freedom, t of
# 95 % 2.131847; two such pairs: error of their mean sqrt(1/12), 8 degrees, 1.859548 (tables).
def test_equivalence():
    pair = ([1, 2, 3], [3, 1, 2])
    one = statistics.equivalence([pair], bound=0.871)
    assert one.difference == pytest.approx(0)
    assert one.high == pytest.approx(2.131847 * math.sqrt(2 / 3) / 2, rel=1e-6)
    assert one.low == pytest.approx(-one.high) and one.equivalent
    assert not statistics.equivalence([pair], bound=0.870).equivalent
    two = statistics.equivalence([pair, pair], bound=0.54)
    assert two.high == pytest.approx(1.859548 * math.sqrt(1 / 12), rel=1e-6)
    assert two.equivalent and not statistics.equivalence([pair, pair], bound=0.53).equivalent
    apart = statistics.equivalence([pair, ([1, 2, 3], [2, 3, 4])], bound=0.1)
    assert apart.difference == pytest.approx(0.25) and not apart.equivalent
    # Paired: of b − a = 2, −1, −1 at equal means √3 of scatter, Student's 95 % of 2 degrees of freedom.
    both = statistics.equivalence([pair], bound=1.5, paired=True)
    assert both.high == pytest.approx(2.919986 * math.sqrt(3 / 3) / 2, rel=1e-6)
    same = statistics.equivalence([([1, 2, 3], [1.1, 2.2, 3.3])], bound=0.11, paired=True)
    assert (same.low, same.high) == (pytest.approx(0.1), pytest.approx(0.1)) and same.equivalent
    with pytest.raises(ValueError, match="and as many"):
        statistics.equivalence([([1, 2, 3], [1, 2])], bound=1, paired=True)
    with pytest.raises(ValueError, match="two values or more of each"):
        statistics.equivalence([([1], [2, 3])], bound=1)
    with pytest.raises(ValueError, match="must be > 0"):
        statistics.equivalence([([1, 2], [2, 3])], bound=0)


# Of samples of which the second has a mean 2 % larger, nine in ten intervals hold the 2 %; half of
# the others lie on either side.
def test_intervals_hold_the_difference_as_often_as_they_say():
    random, rounds, below, above = numpy.random.default_rng(7), 2000, 0, 0
    for _ in range(rounds):
        pairs = [(scale * random.normal(1.0, 0.04, 6), scale * random.normal(1.02, 0.06, 9))
                 for scale in (0.4, 6.0)]
        found = statistics.equivalence(pairs, bound=0.03)
        below += found.high < 0.02
        above += found.low > 0.02
    scatter = math.sqrt(0.05 * 0.95 / rounds)
    assert abs(below / rounds - 0.05) < 4 * scatter and abs(above / rounds - 0.05) < 4 * scatter


# y = 1 + 2 x, hit by all; of equal errors e at x = 1, 2, 3 the limit's is e sqrt(1/3 + 4/2).
def test_limit_of_a_line():
    limit, error, chi = statistics.limit_of_line([1, 2, 3], [3, 5, 7], [0.1, 0.1, 0.1])
    assert limit == pytest.approx(1) and error == pytest.approx(0.1 * math.sqrt(1 / 3 + 2))
    assert chi == pytest.approx(0, abs=1e-20)
    # A value that counts for nothing: the line of the others, for which error and limit are known.
    limit, error, chi = statistics.limit_of_line([1, 2, 3], [3, 5, 99], [0.1, 0.2, 1e6])
    assert limit == pytest.approx(1) and error == pytest.approx(math.hypot(0.2, 0.2))
    assert math.isnan(statistics.limit_of_line([1, 2], [3, 5], [1, 1])[2])
    for x, errors in (([1], [1]), ([1, 1], [1, 1]), ([1, 2], [1, 0])):
        with pytest.raises(ValueError, match="a line needs"):
            statistics.limit_of_line(x, x, errors)


# Jobs of a study may be threads of one process; tick labels and formulas are of several figures.
def test_figures_are_drawn_in_threads(tmp_path):
    def draw(k):
        for n in range(3):
            figure, axes = plots.new_figure(60, 40)
            axes.loglog([1e-3, 1e3], [1, 1e5 + k])
            axes.set_xlabel(f"$(r_{n} - r_{k})/r_i$")
            plots.save(figure, tmp_path / f"figure_{k}_{n}")

    with concurrent.futures.ThreadPoolExecutor(8) as threads:
        list(threads.map(draw, range(8)))
    assert len(list(tmp_path.glob("*.png"))) == 24


def test_pareto_front():
    assert statistics.pareto_front([1, 2, 2, 3, 4], [5, 3, 2, 2, 1]) == [0, 2, 4]
    assert statistics.pareto_front([1, 2], [math.nan, 3]) == [1]


LOG = """some words
Step KinEng contacts contacts contacts
       0  1.5  0  0.1 0.2
WARNING: something happened
      10  2.5  1  0.3 nan
Loop time of 0.5 on 1 procs for 10 steps with 1 atoms
Step Temp
      10  7
Loop time of 0.25 on 1 procs for 0 steps with 1 atoms
"""


def test_read_log(tmp_path):
    path = tmp_path / "log"
    path.write_text(LOG)
    first, second = cases.read_log(path)
    assert list(first.columns) == ["Step", "KinEng", "contacts", "contacts.2", "contacts.3"]
    assert list(first["Step"]) == [0, 10]
    assert first["contacts.2"].iloc[1] == 0.3
    assert math.isnan(first["contacts.3"].iloc[1])
    assert second["Temp"].iloc[0] == 7
    path.write_text("nothing\n")
    with pytest.raises(cases.CaseError, match="has no table"):
        cases.read_log(path)


def test_failures_are_seen():
    assert cases.failure("all well\n", 0) is None
    assert cases.failure("x\nERROR: in.rods: rods must be > 0 (got 0)\n", 0) == \
        "ERROR: in.rods: rods must be > 0 (got 0)"
    assert cases.failure("SIGINT/SIGTERM caught - quitting on first occasion.", 0) == \
        "stopped by a signal"
    assert cases.failure("", -9) == "ended by signal 9"
    assert cases.failure("a\nb\n", 3) == "exit code 3: b"


def test_run_deck(tmp_path, programs):
    deck = tmp_path / "in.words"
    deck.write_text("print 'lambda ${lambda}'\nif '${lambda} < 1' then &\n"
                    "  \"print 'ERROR: lambda must be >= 1'\" quit\n")
    run = cases.run_deck(tmp_path, "in.words", {"lambda": 10}, build=programs)
    assert run.command == "lmp -in in.words -log log.words -var lambda 10"
    assert "lambda 10" in run.log.read_text()
    assert run.loop_seconds == 0 and run.cpu_seconds > 0
    with pytest.raises(cases.CaseError, match=r"^ERROR: lambda must be >= 1 \(in "):
        cases.run_deck(tmp_path, "in.words", {"lambda": 0}, build=programs)
    with pytest.raises(cases.CaseError, match="lmp is not there: scripts/build makes it"):
        cases.run_deck(tmp_path, "in.words", build=tmp_path)


# All ranks' processor time is counted; each of two ranks runs the deck's loop.
def test_run_deck_on_two_ranks(tmp_path, programs):
    cases.link_decks(tmp_path, [ROOT / "tests/studies/tiny/in.rod"])
    run = cases.run_deck(tmp_path, "in.rod", {"steps": 20}, ranks=2, build=programs, name="two")
    assert run.command == \
        "mpirun -np 2 --oversubscribe --bind-to none lmp -in in.rod -log log.two -var steps 20"
    assert "on 2 procs for 20 steps" in run.log.read_text()
    assert run.loop_seconds > 0 and run.cpu_seconds > 0
    assert list(cases.read_log(run.log)[0]["Step"]) == [0, 5, 10, 15, 20]


# A rod of 2700 kg/m³, D = 0.01 m, L = 0.1 m that flies at 1 m/s: half its mass in J.
def test_energy_of_the_smallest_study(tmp_path, programs):
    run = cases.run_deck(tmp_path, ROOT / "tests/studies/tiny/in.rod", build=programs)
    mass = 2700 * math.pi * (0.01 ** 2 / 4 * 0.09 + 0.01 ** 3 / 6)
    assert cases.last_table(run.log, ["ke"])["ke"].iloc[-1] == pytest.approx(mass / 2, rel=1e-6)
    assert run.command == "lmp -in tests/studies/tiny/in.rod -log log.rod"  # no path of a machine
    with pytest.raises(cases.CaseError, match="log.rod has no column speed \\(its columns are: Step"):
        cases.last_table(run.log, ["speed"])


def test_tools_tell_what_is_wrong(tmp_path, programs):
    (tmp_path / "dump").write_text("nothing\n")
    with pytest.raises(cases.CaseError, match="^rod_packing: .*dump"):
        cases.measure_bed(tmp_path / "dump", 0.1, programs)


def test_rows(tmp_path):
    rows.write_rows(tmp_path / "a.csv", [{"k": 2, "x": 1 / 3}, {"k": 1, "x": 2.0}])
    rows.write_rows(tmp_path / "b.csv", pandas.DataFrame({"k": [1], "x": [1e-20]}))
    rows.collect([tmp_path / "a.csv", tmp_path / "b.csv"], tmp_path / "c.csv", by=["k"])
    assert (tmp_path / "c.csv").read_text() == "k,x\n1,2\n1,1e-20\n2,0.3333333333\n"


def test_provenance():
    text = (ROOT / "input/in.rods").read_bytes()
    assert rows.sum_of("input/in.rods") == \
        hashlib.sha256(b"input/in.rods\0" + text).hexdigest()[:12]
    row = rows.provenance("lmp -in in.fill", 86028121)
    assert list(row) == list(rows.PROVENANCE)
    assert len(row["version"]) == 12
    assert "core" in row["machine"]


# What is no more there would have the same sum for ever.
def test_a_sum_of_nothing_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError, match="postproc/nothing is not there"):
        rows.sum_of("src_plugin", "postproc/nothing")


# Each file that the linker gives a program is in the stamps, by what is included from it on.
def test_stamps_are_of_all_that_a_program_is_made_of():
    for tool in (ROOT / "postproc/tools").glob("*.cpp"):
        draws = tool.stem in ("rod_render", "rod_vtk")
        folders = rows.DRAWING_SOURCES if draws else rows.MEASURING_SOURCES
        for path in cases.made_of(tool.stem)[tool.stem] - {tool}:
            assert any(path.is_relative_to(ROOT / folder) for folder in folders), (tool.stem, path)
    packing, picture = (cases.made_of(name)[name] for name in ("rod_packing", "rod_render"))
    assert {ROOT / "postproc/measures/packing_measures.cpp", ROOT / "postproc/io/line_source.cpp",
            ROOT / "postproc/solid/overlap_volume.cpp", ROOT / "src_plugin/core/numbers.h"} <= packing
    assert ROOT / "postproc/pictures/view.cpp" in picture - packing
    assert ROOT / "src_plugin/core/linear_law.h" in \
        cases.made_of("lmp")["libspherocylinder.so"] - packing   # of the plug-in alone


def test_a_program_older_than_its_sources_is_refused(tmp_path):
    def write(name, text, time):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        os.utime(path, (time, time))

    write("postproc/tools/rod_x.cpp", '#include "measures/x.h"\n', 10)
    write("postproc/measures/x.h", "", 10)
    write("postproc/measures/x.cpp", '#include "measures/x.h"\n#include "core/y.h"\n', 10)
    write("src_plugin/core/y.h", "", 10)
    write("src_plugin/core/of_the_plugin.h", "", 30)

    def reason(program):
        return cases.why_not_to_be_run(program, tmp_path / "b", tmp_path)
    assert reason("rod_x") == f"{tmp_path}/b/rod_x is not there: scripts/build makes it"
    write("b/rod_x", "", 20)
    assert reason("rod_x") is None
    write("src_plugin/core/y.h", "", 21)
    assert reason("rod_x") == \
        f"src_plugin/core/y.h is newer than {tmp_path}/b/rod_x: scripts/build makes it anew"
    write("b/lmp", "", 20)
    assert reason("lmp") == f"{tmp_path}/b/libspherocylinder.so is not there: scripts/build makes it"
    write("b/libspherocylinder.so", "", 20)
    assert reason("lmp").startswith("src_plugin/core/of_the_plugin.h is newer than ")
    write("b/libspherocylinder.so", "", 40)
    assert reason("lmp") is None
    write("src_plugin/loader/lmp.cpp", "", 30)   # which the plug-in is not made of
    assert reason("lmp").startswith("src_plugin/loader/lmp.cpp is newer than ")


def test_numbers_of_pages():
    assert [pages.figure(x) for x in (0.000123456, 45.64, 12345, 0.9999, 0)] == \
        ["0.000123", "45.6", "12300", "1.00", "0"]
    assert pages.power(6.1e-6) == "6·10⁻⁶"
    # With the sign for minus, not a hyphen.
    assert (pages.power(-4e-6), pages.fixed(-0.18, 2), pages.figure(-45.64)) == (
        "−4·10⁻⁶", "−0.18", "−45.6")
    assert pages.with_error((0.34567, 0.0032)) == "0.3457 ± 0.0032"
    assert pages.with_error((0.34567, math.nan)) == "0.3457"


def test_a_page_needs_all_its_values(tmp_path):
    template = tmp_path / "p.md.j2"
    template.write_text("{{ a | figure(2) }}\n")
    pages.render(template, tmp_path / "p.md", {"a": 0.1234})
    assert (tmp_path / "p.md").read_text() == "0.12\n"
    with pytest.raises(Exception, match="'a' is undefined"):
        pages.render(template, tmp_path / "p.md", {})


def test_a_page_takes_its_pictures_in(tmp_path):
    noise = numpy.random.default_rng(1).integers(0, 256, (400, 300, 3), dtype=numpy.uint8)
    Image.fromarray(noise).save(tmp_path / "large.png")
    template = tmp_path / "p.html.j2"
    template.write_text('{% extends "page.html.j2" %}{% block content %}'
                        '{{ picture(path, "a < b", widest=100) }}{{ table(["x"], [["<i>"]]) }}{% endblock %}')
    pages.html_page(template, tmp_path / "p.html", {"title": "T", "path": tmp_path / "large.png"})
    text = (tmp_path / "p.html").read_text()
    assert '<img alt="a &lt; b" src="data:image/webp;base64,' in text and "<td>&lt;i&gt;</td>" in text
    template.write_text("{{ 'x' * 2000001 }}")
    with pytest.raises(ValueError, match="would have 2000001 bytes, more than 2000000"):
        pages.html_page(template, tmp_path / "q.html", {})
    assert not (tmp_path / "q.html").exists()
    pages.shrink(tmp_path / "large.png", tmp_path / "small.png", 60)
    assert Image.open(tmp_path / "small.png").size == (60, 80)


def test_figures_are_the_same_each_time(tmp_path, monkeypatch):
    monkeypatch.setattr(plots, "PDF", True)
    for stem in ("a", "b"):
        figure, axes = plots.new_figure(80, 60)
        axes.errorbar([1, 2], [1, 2], plots.errors([0.1, math.nan]), label="λ")
        axes.legend()
        plots.save(figure, tmp_path / stem)
    for ending in (".svg", ".png", ".pdf"):
        assert (tmp_path / f"a{ending}").read_bytes() == (tmp_path / f"b{ending}").read_bytes(), ending
    assert Image.open(tmp_path / "a.png").size == (629, 472)  # of 200 a 25.4 mm
    assert plots.errors([math.nan]) is None


def test_a_study_runs_and_is_not_run_again(study, tmp_path):
    done = study("tests/studies/tiny", "smoke=1")
    assert done.returncode == 0, done.stdout
    assert (tmp_path / "results/README.md").read_text() == "0.01025 J after 10 steps\n"
    assert (tmp_path / "results/energy.svg").exists()
    stamp = ROOT / "build/studies/plugin.version"
    before = stamp.stat().st_mtime_ns
    assert "Nothing to be done" in study("tests/studies/tiny", "smoke=1").stdout
    assert stamp.stat().st_mtime_ns == before
    # From the kept table alone; without one there is nothing to draw.
    (tmp_path / "results/README.md").unlink()
    kept = study("tests/studies/tiny", "smoke=1", "kept=1")
    assert kept.returncode == 0 and "rule page" in kept.stdout and "rule run" not in kept.stdout
    # A PDF on request, also where all else is made.
    assert not (tmp_path / "results/energy.pdf").exists()
    printed = study("tests/studies/tiny", "smoke=1", "kept=1", "pdf=1")
    assert printed.returncode == 0 and (tmp_path / "results/energy.pdf").exists(), printed.stdout
    (tmp_path / "results/README.md").unlink()
    (tmp_path / "results/energy.csv").unlink()
    lost = study("tests/studies/tiny", "smoke=1", "kept=1")
    assert lost.returncode != 0 and "energy.csv" in lost.stdout
    # On a cluster, here one whose queue is the shell.
    far = study("tests/studies/tiny", "smoke=1", options=["--cluster", "sh", "--jobs", 2])
    assert far.returncode == 0 and (tmp_path / "results/energy.csv").exists(), far.stdout
    refused = study("tests/studies/tiny", "smoke=1", "steps=0")
    assert refused.returncode != 0 and "tiny: steps must be a whole number >= 1 (got 0)" in refused.stdout


# A job that is a process of its own has the folder in which snakemake was started first on its path.
def test_no_study_hides_a_module_of_python():
    for path in (ROOT / "studies").glob("*/*.py"):
        if path.parent.name != "common":
            assert path.stem not in sys.stdlib_module_names, path


# Rows with their commands apart are those with them.
def test_commands_apart(tmp_path):
    table = pandas.DataFrame({"x": [1.5, 2.5, 3.5], "command": ["lmp -in a", "b, c", "lmp -in a"]})
    path = tmp_path / "rows.csv"
    rows.write_rows_and_commands(path, table)
    assert path.read_text() == "x,command\n1.5,0\n2.5,1\n3.5,0\n"
    assert rows.commands_beside(path).read_text() == 'number,command\n0,lmp -in a\n1,"b, c"\n'
    pandas.testing.assert_frame_equal(rows.read_rows(path), table)
